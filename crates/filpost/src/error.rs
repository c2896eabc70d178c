//! What can go wrong in a run, beyond what the other crates name.

use fil_diag::{Code, Diag};

use crate::refusals::Refusals;

fil_diag::codes! {
    /// Codes of a run and of the files around it.
    #[non_exhaustive]
    pub enum RunCode {
        /// A file can't be read.
        CantRead = 701, Error, "file can't be read",
            "The file does not exist, or reading it failed.",
            "Check the name and the permissions of the file.";
        /// A file can't be written.
        CantWrite = 702, Error, "file can't be written",
            "The folder is read-only, the disk is full, or the output was closed.",
            "No file was left under the output name. Free some space or choose another folder.";
        /// No ready post of that name.
        NoReadyPost = 703, Error, "unknown ready post",
            "No ready post has this name.",
            "`filpost posts` lists the names; -m takes a machine.toml.";
        /// A compat file.
        CompatFile = 704, Error, "compat file can't be used",
            "The file that corrects POSTF numbers must be TOML with known operations.",
            "See the list of operations in docs/compat.md.";
        /// A case folder.
        CaseFile = 705, Error, "regression case can't be run",
            "A case is a folder with a case.toml that names its CL file and its expected output.",
            "Correct the line shown.";
        /// A file of a script outside of its folder.
        OutsideFolder = 706, Error, "file outside the granted folder",
            "A grant covers a folder and its subfolders; no name, `..` or link may lead out of it.",
            "Name the file relative to the folder, or grant another folder.";
        /// A line map.
        MapFile = 707, Error, "line map can't be used",
            "The line map is truncated, or was edited.",
            "Post the CL file again with --map.";
        /// A line map of another run.
        OtherRun = 708, Error, "line map of another run",
            "The map belongs to the files of its run; one of them has changed since.",
            "Post the CL file again with --map, or name the map that belongs to the program.";
        /// A question about a line that is not there.
        NoSuchLine = 709, Error, "no such line or column",
            "The file is shorter than the line or column asked for.",
            "Count lines from 1, columns in characters.";
        /// No line map for a question.
        NoMap = 710, Error, "no line map",
            "The map of OUT.nc is OUT.nc.map; that of a CL or FIL file is searched in its folder and in the current folder.",
            "Post the CL file with --map, or name the map with --map.";
        /// The embedding program has stopped the run.
        Cancelled = 711, Error, "run cancelled",
            "The program that embeds filpost stopped the run before its end.",
            "The output so far is not an NC program; run it again.";
        /// A record from memory that makes no sense.
        BadRecord = 712, Error, "record from memory can't be used",
            "A record built in memory must be one that a CL statement could be: known words, finite numbers, texts without control characters, a motion with its coordinates.",
            "Make the record with Record::statement, Record::goto or Record::text_command.";
        /// A code that can't be allowed.
        CannotAllow = 713, Error, "code has no level",
            "Only warnings and doubts have levels. A doubt is a finding that the post can carry out, but that may not be intended. Other errors can't be allowed.",
            "Correct what the error names.";
        /// MACHIN names no post.
        NoPost = 714, Error, "MACHIN names no post",
            "A CL file that names its machine is never posted for another one.",
            "Choose a post with -p or -m, or put the option file into the folder of the CL file or one named with --post-path.";
        /// A record as it is written that the post can't carry out.
        WrittenForm = 716, Error, "record is in the form of its CAM system",
            "With --raw-records sections see statements as they are written. The meaning of a changed record in Creo's form is not known.",
            "Write a new statement in Creo's form in the section, or run without --raw-records.";
        /// A program beyond the limit of the host.
        TooLong = 717, Error, "the program is too long",
            "The embedding program limits the size of a program, so that an endless loop does not fill the disk.",
            "Look for the loop that writes; an embedding program can raise `Limits::output_bytes`.";
        /// A post word in a macro that edits.
        WhileWriting = 718, Error, "not allowed in an editing macro",
            "The macro edits a block before it is written. Until then nothing else can be written, read or set.",
            "Change only the parameters of the macro; do the rest in a section.";
        /// PROGF changed what PROGF tells.
        OwnTotals = 719, Error, "the program's totals depend on themselves",
            "The script used totals of the first pass, but the program it wrote has other totals, so its header would be wrong.",
            "Use PROGF, TLISTF, OPERF and TOOLF(NEXT) only in texts, not in motions, tools, feeds or dwells.";
        /// A name that Windows does not allow.
        FileName = 720, Error, "invalid file name",
            "Windows reserves NUL, CON, AUX, PRN, COM1 and LPT1 with any extension, drops periods and blanks at the end of a name, and forbids some characters. Scripts can't use such names on any system, so a post works the same on each.",
            "Choose another name: letters, digits, `-`, `_`, and one extension.";
        /// A tool change that is no program by itself.
        ToolFile = 724, Error, "tool change is no program by itself",
            "With --each-tool every tool change has a program of its own. Here one goes on with what the tool before has begun, or the CL file joins the tools.",
            "Say it again behind LOADTL, such as SPINDL, COOLNT or CYCLE, or post the file in one program.";
        /// Statements after the end.
        AfterFini = 751, Warning, "records after FINI",
            "FINI ends the program; what comes after it is not posted.",
            "Remove the statements, or the FINI before them.";
        /// No FINI.
        NoFini = 752, Warning, "CL file without FINI",
            "The file may have been cut off; the program ends where the file ends.",
            "Export the CL file again if its end is missing.";
        /// Nothing posted.
        NoMotion = 753, Warning, "CL file without records",
            "There is nothing to post.",
            "Check that this is the CL file you meant.";
        /// A dialect was chosen that contradicts the text.
        OtherSigns = 757, Warning, "CL text contradicts the chosen dialect",
            "Only one CAM system writes this line, and the dialect of another was chosen; tool axes, cycles and texts may be read wrong.",
            "Choose the dialect of that system, or leave out --dialect.";
        /// A setting acts that no proven program decides, or a proven program comes out differently.
        Undecided = 758, Warning, "learned post is not proven here",
            "`filpost learn` found another value just as good: no proven program decides it. Here the setting changes the program. Or a proven program that the post was learned from comes out differently.",
            "Compare the block with a program of the old post; `filpost learn --check` takes that program as a further pair.";
    }
}

/// Why a post could not be built or a run was given up. Nothing that was
/// written before the error may be used.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Error {
    /// The machine or the FIL files are not right; all that is wrong with them.
    Setup(Vec<Diag>),
    /// The run can't go on: a file, a script, the embedding program, a description that can't be
    /// read.
    Run(Box<Diag>),
    /// The CL file was refused; all that is wrong with it.
    Refused(Box<Refusals>),
}

impl Error {
    /// The diagnostics, in the order of their places. Of a refused CL file each kind of
    /// error is here once; [`Error::refusals`] says how often it came.
    pub fn diags(&self) -> &[Diag] {
        match self {
            Error::Setup(diags) => diags,
            Error::Run(diag) => std::slice::from_ref(diag),
            Error::Refused(refusals) => refusals.diags(),
        }
    }

    /// What is wrong with a refused CL file; `None` for another error.
    pub fn refusals(&self) -> Option<&Refusals> {
        match self {
            Error::Refused(refusals) => Some(refusals),
            _ => None,
        }
    }

    /// True for a run that a [`CancelToken`](crate::CancelToken) has stopped.
    pub fn is_cancelled(&self) -> bool {
        let cancelled: &Code = RunCode::Cancelled.into();
        self.diags().iter().any(|diag| diag.code == cancelled)
    }

    /// An error of building with one diagnostic.
    pub(crate) fn setup(diag: impl Into<Box<Diag>>) -> Self {
        Error::Setup(vec![*diag.into()])
    }
}

impl std::fmt::Display for Error {
    /// For each diagnostic a line `E0501 part.ncl:3:1: message`, a line for each further
    /// place, a line for each note, such as the CL record and the FIL stack, and a line with the
    /// hint. No line end at the end.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (index, diag) in self.diags().iter().enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{diag}")?;
            for place in diag.spans.iter().skip(1) {
                write!(f, "\n  at {place}")?;
                if !place.label.is_empty() {
                    write!(f, ": {}", place.label)?;
                }
            }
            for note in &diag.notes {
                write!(f, "\n  note: {note}")?;
            }
            if !diag.advice().is_empty() {
                write!(f, "\n  hint: {}", diag.advice())?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Error {}

/// What is wrong with one thing that a host reads for a run: a level, a compat file, a tool, a stock.
impl From<Box<Diag>> for Error {
    fn from(diag: Box<Diag>) -> Self {
        Error::Run(diag)
    }
}

/// The codes of each crate.
const TABLES: [&[Code]; 10] = [
    fil_machine::errors::MachineCode::ALL,
    fil_syntax::SyntaxCode::ALL,
    fil_vm::errors::CompileCode::ALL,
    fil_vm::errors::LintCode::ALL,
    fil_vm::errors::RunCode::ALL,
    fil_cl::errors::ClCode::ALL,
    fil_post::errors::PostCode::ALL,
    RunCode::ALL,
    fil_nc::errors::NcCode::ALL,
    fil_stock::errors::StockCode::ALL,
];

const _: () = assert!(are_unique_beside(&[]), "two codes have one number");

/// True where no number comes twice in the tables of all crates and one more, for a crate that
/// has codes of its own: `const _: () = assert!(are_unique_beside(MyCode::ALL));`.
pub const fn are_unique_beside(more: &[Code]) -> bool {
    let mut is_taken = [false; 10_000];
    let mut table = 0;
    while table <= TABLES.len() {
        let codes = if table < TABLES.len() { TABLES[table] } else { more };
        let mut at = 0;
        while at < codes.len() {
            let number = codes[at].number as usize;
            if is_taken[number] {
                return false;
            }
            is_taken[number] = true;
            at += 1;
        }
        table += 1;
    }
    true
}

/// All codes of errors and warnings, by number.
pub fn all_codes() -> Vec<&'static Code> {
    let mut codes: Vec<_> = TABLES.into_iter().flatten().collect();
    codes.sort_by_key(|code| code.number);
    codes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_comes_twice_is_found() {
        assert!(are_unique_beside(&[]));
        assert!(!are_unique_beside(&fil_cl::ClCode::ALL[3..4]));
    }
}
