//! The door between the machine and everything outside of it.

use fil_cl::Record;
use fil_cl::Vocabulary;
use fil_diag::Diag;

use crate::debug::Probe;
use crate::errors::RunCode;
use crate::functions::Returned;
use crate::machine::{Values, View};
use crate::moment::Moment;
use crate::totals::{TotalsOf, TotalsText, TotalsWord};

/// One of the three commons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CommonKind {
    /// INTCOM, integers; type 1 in POSTF.
    Int,
    /// RELCOM, reals; type 2.
    Rel,
    /// DBLCOM, doubles; type 3.
    Dbl,
}

impl CommonKind {
    /// The kind of POSTF's type argument.
    pub fn from_type(number: f64) -> Option<CommonKind> {
        match number {
            1.0 => Some(CommonKind::Int),
            2.0 => Some(CommonKind::Rel),
            3.0 => Some(CommonKind::Dbl),
            _ => None,
        }
    }
}

/// The FIL statement that acts, with the calls that led to it.
///
/// Without a macro call it owns no memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Site {
    /// Index of the file in [`Module::files`](crate::Module::files).
    pub file: u16,
    /// Line, 1-based.
    pub line: u32,
    /// File and line of the calls, innermost first.
    pub callers: Vec<(u16, u32)>,
}

impl Site {
    /// File and line of the statement and of the calls, innermost first.
    pub fn stack(&self) -> impl Iterator<Item = (u16, u32)> + Clone + '_ {
        std::iter::once((self.file, self.line)).chain(self.callers.iter().copied())
    }
}

/// What FILEF opens a file for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileMode {
    /// To read it line by line.
    Read,
    /// To write it anew.
    Write,
    /// To write at its end.
    Append,
}

/// Files of a script, where the host grants them. Units are 0 and 1.
///
/// The machine calls only what fits the state of the unit: it opens a unit that
/// is closed, reads and rewinds one that is open to read, writes to one that is
/// open to write. One file on both units is for the host to refuse or allow.
pub trait Files {
    /// Opens a file; false when it is to be read and there is none of that name.
    fn open(&mut self, unit: usize, mode: FileMode, name: &str) -> Result<bool, Box<Diag>>;

    /// Closes a file.
    fn close(&mut self, unit: usize) -> Result<(), Box<Diag>>;

    /// Goes back to the first line.
    fn rewind(&mut self, unit: usize) -> Result<(), Box<Diag>>;

    /// Deletes a file; false when there is none of that name.
    fn delete(&mut self, name: &str) -> Result<bool, Box<Diag>>;

    /// True when no line is left to read.
    fn at_end(&mut self, unit: usize) -> Result<bool, Box<Diag>>;

    /// The next line without its end; `None` when none is left.
    fn read_line(&mut self, unit: usize) -> Result<Option<String>, Box<Diag>>;

    /// Writes a line.
    fn write_line(&mut self, unit: usize, line: &str) -> Result<(), Box<Diag>>;
}

fn no_totals() -> Box<Diag> {
    RunCode::Missing.diag("numbers of the whole program are not known here")
}

/// What a machine asks of the program that runs it.
///
/// An error made here needs no FIL place: the machine adds the statement, the
/// calls and the record to it.
pub trait Host {
    /// Value of a common location; 999999 where it is EMPTY.
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64, Box<Diag>>;

    /// Stores in a common location; a warning that comes back gets the FIL place. EMPTY
    /// comes as [`Host::clear_common`].
    fn set_common(
        &mut self,
        kind: CommonKind,
        location: u32,
        value: f64,
    ) -> Result<Option<Box<Diag>>, Box<Diag>>;

    /// Makes a common location EMPTY; a warning as from [`Host::set_common`].
    fn clear_common(
        &mut self,
        kind: CommonKind,
        location: u32,
    ) -> Result<Option<Box<Diag>>, Box<Diag>>;

    /// Acts on a record: a post word in FIL, or the current record on POSTF(13).
    fn command(
        &mut self,
        record: &Record,
        vocab: &mut Vocabulary,
        site: &Site,
    ) -> Result<(), Box<Diag>>;

    /// Exchanges the values of the machine with those of the one that edits what the post
    /// writes; called before and after [`Host::command`] where FIL has such macros.
    fn exchange_values(&mut self, _values: &mut Values) {}

    /// Puts the next CL record that is no pseudo-comment into `record`; false at
    /// the end, with `record` left alone.
    fn next_record(
        &mut self,
        record: &mut Record,
        vocab: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>>;

    /// Goes to the record of that number; false when there is none, with `record` left alone.
    fn seek_record(
        &mut self,
        number: u32,
        record: &mut Record,
        vocab: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>>;

    /// Asked from time to time while FIL runs, and before each call that leaves
    /// it: an error stops the run.
    fn check_cancelled(&mut self) -> Result<(), Box<Diag>> {
        Ok(())
    }

    /// Told of each step of a debug build of the bytecode; an error stops the run.
    fn probe(&mut self, _probe: Probe<'_>, _view: &mut View<'_>) -> Result<(), Box<Diag>> {
        Ok(())
    }

    /// Takes a warning.
    fn warn(&mut self, diag: Diag);

    /// Turns the development listing on or off.
    fn trace(&mut self, on: bool);

    /// Value of a common location by its name; `None` where there is no such name.
    fn named_common(&mut self, _name: &str) -> Option<Result<f64, Box<Diag>>> {
        None
    }

    /// Value of an option of the post by its name; `None` where there is no such name.
    fn post_option(&mut self, _name: &str) -> Option<Result<Returned, Box<Diag>>> {
        None
    }

    /// The files of FILEF, TEXT/READ and WRITE/; `None` refuses them (E0321).
    fn files(&mut self) -> Option<&mut dyn Files> {
        None
    }

    /// The date and time of DATEF and TIMEF; `None` refuses them (E0322).
    fn now(&mut self) -> Option<Moment> {
        None
    }

    /// Runs the command of SPAWNF and gives its status, or a sentence why it
    /// can't; `None` refuses it (E0323).
    fn spawn(&mut self, _command: &str) -> Option<Result<f64, String>> {
        None
    }

    /// Diameter of the tool in use, in the unit of the CL file, without consuming anything;
    /// `None` where the CL file gives none.
    fn tool_diameter(&mut self, _vocab: &mut Vocabulary) -> Result<Option<f64>, Box<Diag>> {
        Ok(None)
    }

    /// A number of the whole program, of a tool or of an operation, from a first pass over
    /// the CL file; `None` where there is none.
    ///
    /// # Errors
    /// No first pass is possible; an entry or operation that there is not.
    fn totals(&mut self, _of: TotalsOf, _word: TotalsWord) -> Result<Option<f64>, Box<Diag>> {
        Err(no_totals())
    }

    /// A text from the first pass.
    ///
    /// # Errors
    /// As [`Host::totals`].
    fn totals_text(&mut self, _of: TotalsText) -> Result<String, Box<Diag>> {
        Err(no_totals())
    }

    /// Number of the tool of the next tool change; `None` after the last one.
    ///
    /// # Errors
    /// As [`Host::totals`].
    fn next_tool(&mut self) -> Result<Option<f64>, Box<Diag>> {
        Err(no_totals())
    }

    /// Coordinate 0 to 5 (X Y Z I J K) of the next or previous motion, or with 6
    /// whether it is a rapid move (1 or 0), without consuming anything; `None`
    /// where there is none.
    fn neighbour(
        &mut self,
        _next: bool,
        _coordinate: usize,
        _vocab: &mut Vocabulary,
    ) -> Result<Option<f64>, Box<Diag>> {
        Ok(None)
    }
}
