//! Observers: an embedding program looks on while a run goes.

use fil_cl::{Record, Vocabulary};
use fil_post::Origin;

/// What a section did with its record.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectionEvent {
    /// Key of the section as FIL writes it (`CYCLE,DEEP`).
    pub key: String,
    /// The CL record it was run for.
    pub record: u32,
    /// The record had no effect on the post.
    pub swallowed: bool,
    /// FIL has switched the development listing on (POSTF 24).
    pub traced: bool,
}

/// Something an observer is told.
#[derive(Clone, Copy, Debug)]
pub enum WhatHappened<'a> {
    /// A record was read, before anything is done with it.
    Record(&'a Record, &'a Vocabulary),
    /// A section has run.
    Section(&'a SectionEvent),
    /// A block was written.
    Block {
        /// The block, without line end.
        text: &'a str,
        /// What made it.
        origin: &'a Origin,
    },
    /// A PPRINT was carried out whose text stays off the tape (`message.to_tape`).
    /// It comes before the blocks of its record.
    Message(&'a str),
}

/// An observer.
pub(crate) type Observer = Box<dyn FnMut(WhatHappened<'_>) + Send>;
