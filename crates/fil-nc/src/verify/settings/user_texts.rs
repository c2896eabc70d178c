//! The texts of the settings that stand in a program: at its start and end, around tool changes,
//! operations, work offsets, cycles and turns.

use fil_machine::locations as loc;
use fil_machine::user_blocks::{self, Around, UserBlocks};

use super::Settings;

impl Settings<'_> {
    /// The lines of the tape that stand in the settings: start and end of a program.
    pub fn own_blocks(&self) -> Vec<String> {
        [self.start_blocks(), self.end_blocks()].concat()
    }

    /// The lines at the start of a program that stand in the settings.
    pub fn start_blocks(&self) -> Vec<String> {
        user_blocks::START.read(self.commons)
    }

    /// The lines at the end of a program that stand in the settings.
    pub fn end_blocks(&self) -> Vec<String> {
        user_blocks::END.read(self.commons)
    }

    /// The blocks of a text of INSERT, which the machine's end-of-block character divides.
    pub fn blocks_of_text<'t>(&self, text: &'t str) -> impl Iterator<Item = &'t str> {
        let end = self.commons.read(loc::TAPE_END_OF_BLOCK_CHAR);
        text.split(move |c| Some(c) == end).map(str::trim).filter(|block| !block.is_empty())
    }

    /// The blocks that may stand around tool changes.
    pub fn blocks_around_changes(&self) -> Vec<String> {
        let kinds =
            [user_blocks::FIRST_CHANGE, user_blocks::OTHER_CHANGE, user_blocks::LAST_CHANGE];
        kinds.into_iter().flat_map(|kind| self.blocks_of(kind)).collect()
    }

    /// The blocks that may stand around operations, work offsets, cycles and turns.
    pub fn blocks_at_places(&self) -> Vec<String> {
        user_blocks::OWN.iter().flat_map(|(_, list, _)| self.blocks_of_list(*list)).collect()
    }

    /// The settings have such blocks.
    pub fn has_texts_at_places(&self) -> bool {
        user_blocks::OWN.iter().any(|(_, list, _)| list.is_on(self.commons))
    }

    /// The blocks of a list; an empty text stands for none.
    pub fn blocks_of_list(&self, list: UserBlocks) -> Vec<String> {
        let mut blocks = list.read(self.commons);
        blocks.retain(|block| !block.is_empty());
        blocks
    }

    /// The blocks that so many tool changes ask for.
    pub fn blocks_of_changes(&self, changes: usize) -> Vec<String> {
        let kind = |at: usize| match at {
            0 => user_blocks::FIRST_CHANGE,
            at if at + 1 == changes => user_blocks::LAST_CHANGE,
            _ => user_blocks::OTHER_CHANGE,
        };
        (0..changes).flat_map(|at| self.blocks_of(kind(at))).collect()
    }

    /// The blocks of one kind of tool change.
    fn blocks_of(&self, kind: Around) -> Vec<String> {
        self.blocks_around(kind).concat()
    }

    /// The blocks before and after one kind of tool change; where it has none, those of the others.
    pub fn blocks_around(&self, kind: Around) -> [Vec<String>; 2] {
        let Around { before, after } = user_blocks::OTHER_CHANGE;
        [(kind.before, before), (kind.after, after)].map(|(own, other)| {
            self.blocks_of_list(if own.is_on(self.commons) { own } else { other })
        })
    }
}
