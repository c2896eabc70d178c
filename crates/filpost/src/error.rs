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
            "Check the name and the rights of the file.";
        /// A file can't be written.
        CantWrite = 702, Error, "file can't be written",
            "The folder is read-only, the disk is full, or the output was closed.",
            "Nothing was left under the output name; make room or choose another folder.";
        /// No ready post of that name.
        NoReadyPost = 703, Error, "no ready post of that name",
            "The name is none of the posts inside filpost.",
            "Use one of the names listed, or give a machine.toml.";
        /// A compat file.
        CompatFile = 704, Error, "compat file can't be used",
            "The file that corrects POSTF numbers must be TOML with known operations.",
            "See the list of operations in docs/compat.md.";
        /// A case folder.
        CaseFile = 705, Error, "regression case can't be run",
            "A case is a folder with a case.toml that names its CL file and its expected output.",
            "Correct the line shown.";
        /// A file of a script outside of its folder.
        OutsideFolder = 706, Error, "file outside of the granted folder",
            "A script is granted a folder and what is below it; no name, `..` or link leads out of there.",
            "Name the file relative to the folder, or grant another folder.";
        /// A line map.
        MapFile = 707, Error, "line map can't be used",
            "A line map has its first and its last line, and each line between them names what came before.",
            "Post the CL file again with --map.";
        /// A line map of another run.
        OtherRun = 708, Error, "line map of another run",
            "The map tells the lines of the files it was written with; one of them has changed since.",
            "Post the CL file again with --map, or name the map that belongs to the program.";
        /// A question about a line that is not there.
        NoSuchLine = 709, Error, "there is no such place",
            "A question names a line of the NC program, the CL file or a FIL file, from 1; of the NC program a column too.",
            "Count lines from 1, columns in characters.";
        /// No line map for a question.
        NoMap = 710, Error, "no line map",
            "The map of OUT.nc is looked for as OUT.nc.map, that of a CL or FIL file among the maps in its folder and in the current one.",
            "Post the CL file with --map, or name the map with --map.";
        /// The embedding program has stopped the run.
        Cancelled = 711, Error, "run cancelled",
            "The program around filpost has stopped the run before its end.",
            "What was written until then is not an NC program; run it again.";
        /// A record from memory that makes no sense.
        BadRecord = 712, Error, "record from memory can't be used",
            "A record that a program hands over is as a statement would make it: words of the program's vocabulary, finite numbers, texts without control characters, motion with its coordinates.",
            "Make the record with Record::statement, Record::goto or Record::text_command.";
        /// A code that can't be allowed.
        CannotAllow = 713, Error, "code has no level",
            "Warnings have levels, and doubts: findings that can be carried out but may not be what is meant. Other errors stand.",
            "Correct what the error names.";
        /// MACHIN names no post.
        NoPost = 714, Error, "MACHIN names no post",
            "A program for another machine is worse than none, so a CL file that names its machine is posted for no other.",
            "Put the option file beside the CL file, name its folder with --post-path, or choose a post with -p or -m.";
        /// A record as it is written that the post can't carry out.
        WrittenForm = 716, Error, "record is in the form of its CAM system",
            "Sections see statements as they are written here; the post carries out what they mean in Creo's form, which is not known for a record that FIL has changed.",
            "Make the statement anew in the section, in Creo's form, or leave --raw-records out.";
        /// A program beyond the limit of the host.
        TooLong = 717, Error, "the program is too long",
            "The program around filpost has set how many bytes a program may have, so that a loop which never ends does not fill the disk.",
            "Look for the loop that writes; an embedding program can raise `Limits::output_bytes`.";
        /// A post word in a macro that edits.
        WhileWriting = 718, Error, "not while a block is written",
            "The macro is called with a block that is on its way to the tape: nothing else can be written, read or set before it is there.",
            "Change the parameters of the macro alone; do the rest in a section.";
        /// PROGF changed what PROGF tells.
        OwnTotals = 719, Error, "the program's totals depend on themselves",
            "A script asked for totals of the program before its motions came and was told what a first pass had counted; the program it then wrote comes to something else, so its header would be wrong.",
            "Use what PROGF, TLISTF, OPERF and TOOLF(NEXT) tell in texts alone, not in motions, tools, feeds or dwells.";
        /// A name that Windows does not allow.
        FileName = 720, Error, "no name for a file",
            "Windows takes NUL, CON, AUX, PRN, COM1 and LPT1 for devices whatever ending they have, leaves points and blanks at the end of a name out, and keeps some characters for itself: what is written there is lost or is another file. The files of scripts have such names on no system, as a post must do the same on each.",
            "Choose another name: letters, digits, `-`, `_`, and one ending.";
        /// Statements after the end.
        AfterFini = 751, Warning, "records after FINI",
            "FINI ends the program; what comes after it is not posted.",
            "Remove the statements, or the FINI before them.";
        /// No FINI.
        NoFini = 752, Warning, "CL file without FINI",
            "The file may have been cut off; the program ends where the file ends.",
            "Make the CL file again if its end is missing.";
        /// Nothing posted.
        NoMotion = 753, Warning, "CL file without records",
            "There is nothing to post.",
            "Check that this is the CL file you meant.";
        /// A dialect was chosen that contradicts the text.
        OtherSigns = 757, Warning, "CL text of another dialect than the one chosen",
            "A line of the text is written by one CAM system only, and the dialect of another was chosen; tool axes, cycles and texts may mean something else.",
            "Leave the choice out, or choose the dialect of that system.";
    }
}

/// Why a post could not be built or a run was given up. Nothing that was
/// written before the error may be used.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Error {
    /// The machine or the FIL files are not right; all that is wrong with them.
    Setup(Vec<Diag>),
    /// The run can't go on: files, a script, the embedding program.
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
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (index, diag) in self.diags().iter().enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{diag}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}

/// The tables of all codes, by number.
pub fn all_codes() -> Vec<&'static Code> {
    let tables: [&'static [Code]; 9] = [
        fil_machine::errors::MachineCode::ALL,
        fil_syntax::SyntaxCode::ALL,
        fil_vm::errors::CompileCode::ALL,
        fil_vm::errors::LintCode::ALL,
        fil_vm::errors::RunCode::ALL,
        fil_cl::errors::ClCode::ALL,
        fil_post::errors::PostCode::ALL,
        RunCode::ALL,
        fil_nc::errors::NcCode::ALL,
    ];
    let mut codes: Vec<_> = tables.into_iter().flatten().collect();
    codes.sort_by_key(|code| code.number);
    codes
}
