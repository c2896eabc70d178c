//! Reads of settings: which locations of the commons were read.
//!
//! Nothing is noted unless somebody asks ([`Commons::note_reads`](crate::Commons::note_reads)).
//! A copy of the commons notes its reads in the same place.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::commons::{DBL_LOCATIONS, INT_LOCATIONS, Kind, REL_LOCATIONS};

/// Bits of all locations.
const BITS: usize = INT_LOCATIONS + REL_LOCATIONS + DBL_LOCATIONS + 3;
const WORDS: usize = BITS.div_ceil(64);

/// The place of the first bit of a common.
const fn first_bit(kind: Kind) -> usize {
    match kind {
        Kind::Int => 0,
        Kind::Rel => INT_LOCATIONS + 1,
        Kind::Dbl => INT_LOCATIONS + REL_LOCATIONS + 2,
    }
}

/// Notes of reads, shared by the copies of commons.
#[derive(Clone)]
pub struct Reads {
    bits: Arc<[AtomicU64; WORDS]>,
}

impl Default for Reads {
    fn default() -> Reads {
        Reads { bits: Arc::new([const { AtomicU64::new(0) }; WORDS]) }
    }
}

impl fmt::Debug for Reads {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Reads").finish_non_exhaustive()
    }
}

impl Reads {
    /// Notes a read. `at` is a location of the common.
    pub(crate) fn note(&self, kind: Kind, at: usize) {
        let bit = first_bit(kind) + at;
        let word = &self.bits[bit / 64];
        let mask = 1 << (bit % 64);
        if word.load(Ordering::Relaxed) & mask == 0 {
            word.fetch_or(mask, Ordering::Relaxed);
        }
    }

    /// What was read since the last time, and forgets it.
    pub fn take(&self) -> ReadSet {
        ReadSet(self.bits.iter().map(|word| word.swap(0, Ordering::Relaxed)).collect())
    }
}

/// Locations that were read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadSet(Vec<u64>);

impl ReadSet {
    /// The location was read.
    pub fn has(&self, kind: Kind, location: u32) -> bool {
        let bit = first_bit(kind) + location as usize;
        self.0.get(bit / 64).is_some_and(|word| word & (1 << (bit % 64)) != 0)
    }

    /// Adds what another set has.
    pub fn add(&mut self, other: &ReadSet) {
        if self.0.len() < other.0.len() {
            self.0.resize(other.0.len(), 0);
        }
        self.0.iter_mut().zip(&other.0).for_each(|(word, other)| *word |= other);
    }

    /// Nothing was read.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|word| *word == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::locations as loc;

    #[test]
    fn reads_are_noted_once_asked_for_and_by_copies_too() {
        let mut commons = loc::default_commons();
        commons.read(loc::DWELL_CODE);
        let reads = commons.note_reads();
        assert!(reads.take().is_empty());
        let copy = commons.clone();
        copy.read(loc::DWELL_CODE);
        let read = reads.take();
        let dwell = u32::from(loc::DWELL_CODE.0);
        assert!(read.has(Kind::Int, dwell) && !read.has(Kind::Int, dwell + 1));
        assert!(!read.has(Kind::Dbl, dwell) && reads.take().is_empty());
    }
}
