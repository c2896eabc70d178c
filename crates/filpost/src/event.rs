//! Events: what a run tells its observers while it goes.

use fil_cl::{Record, Vocabulary};
use fil_diag::Diag;
use fil_post::Origin;

/// An event of a run, in the order in which things happen.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Event<'a> {
    /// A CL record was read; nothing has been done with it yet.
    #[non_exhaustive]
    Record {
        /// The record.
        record: &'a Record,
        /// The words it names.
        vocabulary: &'a Vocabulary,
    },
    /// A FIL section has run.
    #[non_exhaustive]
    Section {
        /// Its key as FIL writes it (`CYCLE,DEEP`).
        key: &'a str,
        /// The number of the CL record it was run for.
        record: u32,
        /// The section gave the post nothing for the record.
        swallowed: bool,
        /// FIL has switched the development listing on (POSTF 24).
        traced: bool,
    },
    /// A block was written. The blocks of a record come after its section.
    #[non_exhaustive]
    Block {
        /// The block, without line end.
        text: &'a str,
        /// What made it.
        origin: &'a Origin,
    },
    /// A PPRINT was carried out whose text stays off the tape (`message.to_tape`).
    /// It comes before the blocks of its record.
    Message(&'a str),
    /// A warning; all of them are in the report as well.
    Warning(&'a Diag),
}

/// An observer of one run.
pub(crate) type Observer<'o> = Box<dyn FnMut(Event<'_>) + Send + 'o>;
