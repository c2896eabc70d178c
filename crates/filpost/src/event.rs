//! Events: what a run tells its observers while it goes.

use fil_cl::{Record, Vocabulary};
use fil_diag::Diag;
use fil_post::Origin;

use crate::listing::ListingRules;
use crate::report::Report;
use crate::tally::{Motion, Tally};

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
    #[doc(hidden)]
    /// A motion was carried out. It comes before the blocks of its record.
    Motion(Motion),
    #[doc(hidden)]
    /// A record and all it has caused are over. A line of a listing that was made of it
    /// goes through the script's macro first, where it has one.
    #[non_exhaustive]
    RecordDone {
        /// The macro for lines of listings (_LSTWT).
        lines: LineEditor<'a>,
        /// Which lines a listing has, by the machine's settings of this moment.
        rules: ListingRules,
    },
    /// The program is complete.
    End(RunEnd<'a>),
}

/// What a run has counted, at its end.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct RunEnd<'a> {
    #[doc(hidden)]
    /// Lengths, times and tools.
    pub tally: &'a Tally,
    /// Warnings and the unit, among others; its counts are those of `blocks` and `bytes`.
    pub report: &'a Report,
    /// Blocks written.
    pub blocks: u64,
    /// Bytes written.
    pub bytes: u64,
}

/// Edits lines of a listing as the script wants them.
#[derive(Clone, Copy)]
pub struct LineEditor<'a>(pub(crate) Option<&'a dyn Fn(&mut String)>);

impl LineEditor<'_> {
    /// Edits a line; an empty one is to be left out. An error of the script stops the run
    /// behind the event.
    pub fn edit(&self, line: &mut String) {
        if let Some(edit) = self.0 {
            edit(line);
        }
    }

    /// True where the script edits lines.
    pub(crate) fn is_in_use(&self) -> bool {
        self.0.is_some()
    }
}

impl std::fmt::Debug for LineEditor<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("LineEditor")
    }
}

/// An observer of one run.
pub(crate) type Observer<'o> = Box<dyn FnMut(Event<'_>) + Send + 'o>;
