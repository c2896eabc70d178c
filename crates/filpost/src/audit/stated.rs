//! Who has stated the modes that the blocks of a program count on: the post, which knows what it
//! leaves unsaid then, or an author's text.

use fil_nc::dialect::{Dialect, Family, Function, Group};
use fil_nc::text::read_block;

use super::align::Pair;
use super::made::{Made, TEXT, Word};

/// The groups of functions that the effect of a block hangs on.
const GROUPS: [Group; 4] = [Group::Motion, Group::Units, Group::Feed, Group::Positions];

/// Functions of Klartext that say what F counts.
const FEEDS_OF_KLARTEXT: [i64; 2] = [136, 137];

/// The last statement of a group at a line, until the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Statement {
    by_author: bool,
    /// It says that axis words are increments.
    increments: bool,
}

/// Statements of a program, in its order.
pub(super) struct Stated<'d> {
    dialect: &'d Dialect,
    /// For each group the lines at which its statement becomes another one.
    groups: [Vec<(u32, Statement)>; GROUPS.len()],
}

impl<'d> Stated<'d> {
    pub fn new(dialect: &'d Dialect) -> Self {
        Stated { dialect, groups: Default::default() }
    }

    /// Takes up the blocks of a record.
    pub fn record(&mut self, pairs: &[Pair<'_>]) {
        for pair in pairs {
            if let Pair::Same(_, made) | Pair::Changed(_, made) | Pair::Added(made) = pair {
                made.words.iter().for_each(|word| self.word(made, word));
            }
        }
    }

    fn word(&mut self, made: &Made, word: &Word) {
        match word.letter {
            'G' | 'M' => self.function(made, &word.text, word.is_spelt),
            TEXT => {
                let Ok(block) = read_block(word.text.as_bytes(), "text", made.nc_line) else {
                    return;
                };
                for word in block.words.iter().filter(|word| b"GM".contains(&word.letter)) {
                    let text = format!("{}{}", char::from(word.letter), word.number.value());
                    self.function(made, &text, made.cause.record != 0);
                }
            }
            _ => {}
        }
    }

    fn function(&mut self, made: &Made, text: &str, by_author: bool) {
        let Some(number) = text.get(1..).and_then(|number| number.parse::<f64>().ok()) else {
            return;
        };
        let tenths = (number * 10.0).round() as i64;
        let is_klartext = self.dialect.family == Family::Klartext;
        let (group, increments) = match text.as_bytes()[0] {
            b'G' => {
                let Some(function) = self.dialect.function(tenths) else { return };
                (function.group(), function == Function::Positions { absolute: false })
            }
            _ if is_klartext && FEEDS_OF_KLARTEXT.contains(&(tenths / 10)) => (Group::Feed, false),
            _ => return,
        };
        let Some(at) = GROUPS.iter().position(|known| *known == group) else { return };
        let statement = Statement { by_author, increments };
        let statements = &mut self.groups[at];
        if statements.last().is_none_or(|(_, last)| *last != statement) {
            statements.push((made.nc_line, statement));
        }
    }

    /// The post has stated last what a block counts on: it means what the block does. What axis
    /// words do it means only where they are increments, which lead on from another place.
    pub fn is_meant(&self, group: Group, line: u32) -> bool {
        let Some(at) = GROUPS.iter().position(|known| *known == group) else { return false };
        let statements = &self.groups[at];
        let behind = statements.partition_point(|(first, _)| *first <= line);
        let last = behind.checked_sub(1).map(|at| statements[at].1);
        last.is_some_and(|last| !last.by_author && (group != Group::Positions || last.increments))
    }
}
