//! From a CL record to its section.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use fil_cl::Vocabulary;
use fil_cl::{Record, Word, WordId};

use crate::module::SectionId;

/// Finds the section of a record. A record without one costs one array look-up.
#[derive(Clone, Debug, Default)]
pub struct Matcher {
    /// By index of the major word: one past the position in `lists`, 0 for none.
    by_major: Vec<u16>,
    /// Sections of one major word, those with the most minor words first.
    lists: Vec<Vec<(Vec<WordId>, SectionId)>>,
    /// Sections by type and, where they name one, subtype.
    types: BTreeMap<(u32, Option<u32>), SectionId>,
    /// The section of all records that no other one takes.
    rest: Option<SectionId>,
    /// There are sections by type, or one of the rest.
    beyond_words: bool,
}

impl Matcher {
    /// Adds a section for a major word and the minor words right after it;
    /// gives the section that has this key already.
    pub(crate) fn add_words(
        &mut self,
        major: WordId,
        minors: Vec<WordId>,
        section: SectionId,
    ) -> Option<SectionId> {
        if self.by_major.len() <= major.index() {
            self.by_major.resize(major.index() + 1, 0);
        }
        let entry = &mut self.by_major[major.index()];
        if *entry == 0 {
            self.lists.push(Vec::new());
            *entry = self.lists.len() as u16;
        }
        let list = &mut self.lists[usize::from(*entry) - 1];
        if let Some((_, other)) = list.iter().find(|(known, _)| *known == minors) {
            return Some(*other);
        }
        let position = list.partition_point(|(known, _)| known.len() >= minors.len());
        list.insert(position, (minors, section));
        None
    }

    /// Adds a section for a type and subtype; gives the section that has this key already.
    pub(crate) fn add_types(
        &mut self,
        kind: u32,
        sub: Option<u32>,
        section: SectionId,
    ) -> Option<SectionId> {
        self.beyond_words = true;
        match self.types.entry((kind, sub)) {
            Entry::Occupied(other) => Some(*other.get()),
            Entry::Vacant(place) => {
                place.insert(section);
                None
            }
        }
    }

    /// Adds the section of all records that no other one takes; gives the one there is.
    pub(crate) fn add_rest(&mut self, section: SectionId) -> Option<SectionId> {
        self.beyond_words = true;
        match self.rest {
            Some(other) => Some(other),
            None => {
                self.rest = Some(section);
                None
            }
        }
    }

    /// The section of a record. A key of words beats a key of types, more minor
    /// words beat fewer, a subtype beats none, and any key beats ALL.
    #[inline]
    pub fn find(&self, record: &Record, vocab: &Vocabulary) -> Option<SectionId> {
        match self.by_major.get(record.major.index()) {
            Some(&entry) if entry != 0 => {
                let list = &self.lists[usize::from(entry) - 1];
                let fits = |minors: &[WordId]| {
                    record.data.len() >= minors.len()
                        && minors.iter().zip(&record.data).all(|(m, w)| *w == Word::Minor(*m))
                };
                let found = list.iter().find(|(minors, _)| fits(minors));
                found.map(|(_, section)| *section).or_else(|| self.find_beyond(record, vocab))
            }
            _ if !self.beyond_words => None,
            _ => self.find_beyond(record, vocab),
        }
    }

    fn find_beyond(&self, record: &Record, vocab: &Vocabulary) -> Option<SectionId> {
        let of = |sub| self.types.get(&(record.kind, sub)).copied();
        let value = record.value(3, vocab);
        let sub = value.map(|value| value as u32).filter(|sub| value == Some(f64::from(*sub)));
        sub.and_then(|sub| of(Some(sub))).or_else(|| of(None)).or(self.rest)
    }
}
