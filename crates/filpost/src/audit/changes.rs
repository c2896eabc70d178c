//! What authors changed: blocks that differ from those of the post alone, by who made them.

use std::collections::HashMap;
use std::io::{Read, Seek};

use super::align::Pair;
use super::made::{Blocks, Made, Word};
use super::{Author, Change, What};

/// Changes that are listed, and places of one that are.
const LISTED: usize = 50;
const PLACES: usize = 8;

/// Blocks of one change whose text is shown.
const SHOWN: usize = 3;

/// Letters of axes that turn, and of those that move along.
const TURNS: &str = "ABC";
const MOVES: &str = "XYZUVW";

/// Records that sections took without any effect on the post, each with its section.
pub(super) type Taken = Vec<(u32, u16)>;

/// Collects changes.
pub(super) struct Changes {
    /// Those of the program.
    taken: Taken,
    /// Records of INSERT, that the reference left out.
    inserts: Vec<u32>,
    list: Vec<Change>,
    more: u64,
    known: HashMap<(Author, Key), usize>,
    /// The last author who changed something, for what follows from it.
    last: Option<Author>,
    /// The last value of each axis that turns.
    turned: HashMap<char, String>,
    /// The change that turned an axis which nothing has turned since.
    held: Vec<(usize, char)>,
}

/// What makes two changes one.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Key {
    Number(char),
    Turned(char),
    Texts(Vec<String>, Vec<String>),
}

impl Changes {
    pub fn new(taken: Taken, inserts: Vec<u32>) -> Self {
        Changes {
            taken,
            inserts,
            list: Vec::new(),
            more: 0,
            known: HashMap::new(),
            last: None,
            turned: HashMap::new(),
            held: Vec::new(),
        }
    }

    /// All of them, and how many more there are.
    pub fn finish(mut self) -> (Vec<Change>, u64) {
        for (index, _) in self.held {
            if let What::Turned { stays, .. } = &mut self.list[index].what {
                *stays = true;
            }
        }
        (self.list, self.more)
    }

    /// Takes up the blocks of one record. Gives the first line of the program that differs.
    pub fn record<R: Read + Seek>(
        &mut self,
        program: &Blocks<'_, R>,
        pairs: &[Pair<'_>],
    ) -> Option<u32> {
        let mut first = None;
        let (mut left_out, mut added): (Vec<&Made>, Vec<&Made>) = (Vec::new(), Vec::new());
        for pair in pairs {
            match pair {
                Pair::LeftOut(made) => left_out.push(made),
                Pair::Added(made) => added.push(made),
                Pair::Same(_, made) => {
                    self.blocks(program, pairs, &mut left_out, &mut added);
                    self.follow(made);
                    continue;
                }
                Pair::Changed(reference, made) => {
                    self.blocks(program, pairs, &mut left_out, &mut added);
                    self.words(program, reference, made);
                    self.follow(made);
                }
            }
            if let Pair::Added(made) | Pair::Changed(_, made) = pair {
                first = first.or(Some(made.nc_line));
            }
        }
        self.blocks(program, pairs, &mut left_out, &mut added);
        first
    }

    /// Whole blocks that one of the runs has alone.
    fn blocks<R: Read + Seek>(
        &mut self,
        program: &Blocks<'_, R>,
        pairs: &[Pair<'_>],
        left_out: &mut Vec<&Made>,
        added: &mut Vec<&Made>,
    ) {
        let (left_out, added) = (std::mem::take(left_out), std::mem::take(added));
        let Some(cause) = added.first().or(left_out.first()).map(|made| made.cause) else { return };
        let of_added = added.first().map_or(0, |made| made.stack_of(made.words.first()));
        let of_record = || {
            let stacks = pairs.iter().filter_map(|pair| match pair {
                Pair::Same(_, made) | Pair::Changed(_, made) | Pair::Added(made) => {
                    Some(made.cause.stack)
                }
                Pair::LeftOut(_) => None,
            });
            stacks.into_iter().find(|stack| *stack != 0)
        };
        let stack = if added.is_empty() { of_record().unwrap_or(0) } else { of_added };
        let author = self.author(program, stack, cause.record);
        let place = (cause.line, added.first().map(|made| made.nc_line));
        let turns = added.iter().flat_map(|made| &made.words).filter(|word| {
            TURNS.contains(word.letter) && word.number().is_some() && left_out.is_empty()
        });
        let turns: Vec<Word> = turns.cloned().collect();
        for word in turns.iter().filter(|_| added.len() == 1 && !added[0].has(MOVES)) {
            let from = self.turned.insert(word.letter, word.text[1..].to_string());
            let what = What::Turned {
                letter: word.letter,
                from,
                to: word.text[1..].to_string(),
                stays: false,
                blocks: 0,
            };
            let index = self.add(author.clone(), Key::Turned(word.letter), place, what);
            self.held.retain(|(_, letter)| *letter != word.letter);
            self.held.extend(index.map(|index| (index, word.letter)));
        }
        if !turns.is_empty() && added.len() == 1 && !added[0].has(MOVES) {
            return;
        }
        let texts = |made: &[&Made]| made.iter().map(|made| made.text()).collect::<Vec<_>>();
        self.texts(author, place, texts(&left_out), texts(&added));
        added.iter().for_each(|made| self.follow(made));
    }

    /// A block that has other words.
    fn words<R: Read + Seek>(&mut self, program: &Blocks<'_, R>, reference: &Made, made: &Made) {
        let not_in = |one: &Made, other: &Made| {
            let lacks = |word: &&Word| !other.words.iter().any(|has| has.text == word.text);
            one.words.iter().filter(lacks).cloned().collect::<Vec<Word>>()
        };
        let (mut left_out, mut added) = (not_in(reference, made), not_in(made, reference));
        let place = (made.cause.line, Some(made.nc_line));
        let record = made.cause.record;
        for word in std::mem::take(&mut added) {
            let at = left_out
                .iter()
                .position(|before| before.letter == word.letter && !"GMO_/".contains(word.letter));
            let numbers = at.and_then(|at| left_out[at].number()).zip(word.number());
            let (Some(at), Some((from, to))) = (at, numbers) else {
                added.push(word);
                continue;
            };
            let before = left_out.remove(at);
            let author = self.author(program, made.stack_of(Some(&word)), record);
            let what = What::Number {
                letter: word.letter,
                from: before.text[1..].to_string(),
                to: word.text[1..].to_string(),
                by: Some(tidy(to - from)),
            };
            self.add(author, Key::Number(word.letter), place, what);
        }
        if left_out.is_empty() && added.is_empty() {
            return;
        }
        let author = self.author(program, made.stack_of(added.first()), record);
        let texts = |words: Vec<Word>| {
            let words: Vec<String> = words.into_iter().map(|word| word.text).collect();
            if words.is_empty() { Vec::new() } else { vec![words.join(" ")] }
        };
        self.texts(author, place, texts(left_out), texts(added));
    }

    fn texts(
        &mut self,
        author: Author,
        place: (u32, Option<u32>),
        mut from: Vec<String>,
        mut to: Vec<String>,
    ) {
        for texts in [&mut from, &mut to] {
            let more = texts.len().saturating_sub(SHOWN);
            if more > 0 {
                texts.truncate(SHOWN);
                texts.push(format!("… {more} more"));
            }
        }
        if self.moves(&author, place, (&from, &to)) {
            return;
        }
        let key = Key::Texts(from.clone(), to.clone());
        self.add(author, key, place, What::Blocks { from, to });
    }

    /// Blocks that the same author, or the post by what he has done, has put in or left out beside
    /// another place of a record, and that are left out or put in here: they have moved.
    fn moves(
        &mut self,
        author: &Author,
        place: (u32, Option<u32>),
        (from, to): (&[String], &[String]),
    ) -> bool {
        let Some(last) = self.list.last_mut() else { return false };
        let What::Blocks { from: left_out, to: put_in } = &mut last.what else { return false };
        let is_one = left_out.is_empty() != put_in.is_empty() && from.is_empty() != to.is_empty();
        let moves = is_one && left_out == to && put_in == from;
        let by_one = last.author == *author || matches!(last.author, Author::Post { .. });
        if !moves || last.count != 1 || last.cl_lines != [place.0] || !by_one {
            return false;
        }
        let texts = if to.is_empty() { from } else { to };
        let key = Key::Texts(left_out.clone(), put_in.clone());
        (*left_out, *put_in) = (texts.to_vec(), texts.to_vec());
        last.nc_lines.extend(place.1);
        let moved = Key::Texts(texts.to_vec(), texts.to_vec());
        let before = std::mem::replace(&mut last.author, author.clone());
        let index = self.known.remove(&(before, key));
        self.known.extend(index.map(|index| ((author.clone(), moved), index)));
        true
    }

    /// Who made a block, or left one out.
    fn author<R: Read + Seek>(
        &mut self,
        program: &Blocks<'_, R>,
        stack: u32,
        record: u32,
    ) -> Author {
        let map = &program.map;
        let stack = map.stack(fil_post::Cause { stack, ..fil_post::Cause::default() });
        let taken = || {
            let at = self.taken.binary_search_by_key(&record, |(record, _)| *record).ok()?;
            map.sections().get(usize::from(self.taken[at].1))
        };
        let author = if let Some(stack) = stack {
            let line = stack.lines.first();
            let file = line.and_then(|line| map.fil().get(usize::from(line.file)));
            Author::Script {
                place: file.zip(line).map(|(file, line)| (file.name.clone(), line.line)),
                section: map.section(stack).map(str::to_string),
            }
        } else if let Some(section) = taken() {
            Author::Script { place: None, section: Some(section.clone()) }
        } else if self.inserts.binary_search(&record).is_ok() {
            Author::Insert
        } else {
            return Author::Post { after: self.last.clone().map(Box::new) };
        };
        self.last = Some(author.clone());
        author
    }

    /// Adds a change, or one more place to a known one; gives its index where it is listed.
    fn add(
        &mut self,
        author: Author,
        key: Key,
        (cl_line, nc_line): (u32, Option<u32>),
        what: What,
    ) -> Option<usize> {
        let key = (author, key);
        let Some(index) = self.known.get(&key).copied() else {
            if self.list.len() == LISTED {
                self.more += 1;
                return None;
            }
            self.known.insert(key.clone(), self.list.len());
            self.list.push(Change {
                author: key.0,
                cl_lines: vec![cl_line],
                nc_lines: nc_line.into_iter().collect(),
                count: 1,
                what,
            });
            return Some(self.list.len() - 1);
        };
        let change = &mut self.list[index];
        change.count += 1;
        if change.cl_lines.len() < PLACES && !change.cl_lines.contains(&cl_line) {
            change.cl_lines.push(cl_line);
        }
        change.nc_lines.extend(nc_line.filter(|_| change.nc_lines.len() < PLACES));
        if let (What::Number { by, .. }, What::Number { by: again, .. }) = (&mut change.what, what)
            && *by != again
        {
            *by = None;
        }
        Some(index)
    }

    /// Where the axes that turn stand, and which of them an author has left turned.
    fn follow(&mut self, made: &Made) {
        for word in &made.words {
            if TURNS.contains(word.letter) && word.number().is_some() {
                self.turned.insert(word.letter, word.text[1..].to_string());
                self.held.retain(|(_, letter)| *letter != word.letter);
            }
        }
        if made.has(MOVES) {
            for (index, _) in &self.held {
                if let What::Turned { blocks, .. } = &mut self.list[*index].what {
                    *blocks += 1;
                }
            }
        }
    }
}

/// A difference without the dust of binary fractions.
fn tidy(value: f64) -> f64 {
    const STEPS: f64 = 1e6;
    (value * STEPS).round() / STEPS
}
