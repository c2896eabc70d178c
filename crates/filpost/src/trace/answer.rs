//! What an answer says.

use serde::Serialize;

use super::run_files::Role;

/// Which file of the run was asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Asked {
    /// The NC program.
    Nc,
    /// The CL file.
    Cl,
    /// A FIL file.
    Fil,
}

impl From<Role> for Asked {
    fn from(role: Role) -> Self {
        match role {
            Role::Nc => Asked::Nc,
            Role::Cl => Asked::Cl,
            Role::Fil(_) => Asked::Fil,
        }
    }
}

/// The answer to a question about a line.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    /// What was asked about.
    pub asked: Asked,
    /// The file asked about.
    pub file: String,
    /// The line asked about.
    pub line: u64,
    /// The text of that line of FIL.
    pub excerpt: Option<String>,
    /// The record at that line of the CL file.
    pub record: Option<Record>,
    /// The record was taken by these sections without any effect on the post.
    pub taken: Vec<Taken>,
    /// Lines of the NC program, with the words that belong to the answer.
    pub lines: Vec<Line>,
    /// How many lines there are in all.
    pub in_all: u64,
    /// Files of the run that are not where the map says; nothing of their text
    /// is shown.
    pub missing: Vec<String>,
}

/// A record of the CL file.
#[derive(Clone, Debug, Serialize)]
pub struct Record {
    /// Its number.
    pub number: u32,
    /// The line it starts on.
    pub line: u32,
    /// Its statement.
    pub statement: String,
    /// Its words from 1 on, as POSTF(7,n) counts them.
    #[serde(skip)]
    pub(super) words: Vec<String>,
}

impl Record {
    /// A word as it is shown; `None` for 0, the record as a whole.
    pub(super) fn word(&self, number: u16) -> Option<String> {
        self.words.get(usize::from(number).checked_sub(1)?).cloned()
    }
}

/// A record that a section took without effect.
#[derive(Clone, Debug, Serialize)]
pub struct Taken {
    /// Number of the record.
    pub record: u32,
    /// Key of the section.
    pub section: String,
}

/// A line of the NC program.
#[derive(Clone, Debug, Serialize)]
pub struct Line {
    /// Its number.
    pub number: u64,
    /// Its text, when the program is at hand.
    pub text: Option<String>,
    /// What made it.
    pub made: Made,
    /// Its words that belong to the answer.
    pub words: Vec<LineWord>,
}

/// A word of a line.
#[derive(Clone, Debug, Serialize)]
pub struct LineWord {
    /// Its letter; `_` for a text, `/` for the block-delete character, `#` for a
    /// sequence number.
    pub letter: char,
    /// Column, from 1.
    pub column: Option<usize>,
    /// Its text.
    pub text: Option<String>,
    /// The word of its record, as POSTF(7,n) counts; 0 for the record as a whole.
    pub word: u16,
    /// What that word of the CL record is.
    pub value: Option<String>,
    /// The word counts in a record that a FIL statement made.
    pub made_by_fil: bool,
    /// Its cause.
    pub made: Made,
}

/// What made a line or a word. Record 0 without FIL is the machine: its
/// settings ask for it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Made {
    /// Number of the CL record.
    pub record: u32,
    /// The CL file.
    pub cl: String,
    /// Line of the CL file.
    pub line: u32,
    /// The statement.
    pub statement: Option<String>,
    /// Key of the section that was running.
    pub section: Option<String>,
    /// The FIL call stack, innermost first.
    pub fil: Vec<Step>,
}

impl Made {
    /// True for what the machine's settings ask for.
    pub fn by_machine(&self) -> bool {
        self.record == 0 && self.fil.is_empty()
    }
}

/// A line of FIL on a call stack.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Step {
    /// The file.
    pub file: String,
    /// The line.
    pub line: u32,
    /// Its text, when the file is at hand.
    pub text: Option<String>,
}
