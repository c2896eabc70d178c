//! A folder for a test, the command run in it, and small inputs.

use std::io::Write as _;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

pub const SMALL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
                     FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";

/// A CL file whose fourth line is refused after some output is due.
pub const WRONG: &str =
    "UNITS / MM\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nCYCLE / SIDEWAYS, 3\nFINI\n";

pub const NC: &str = "%\nO0007 (7)\nN10 G21 G90 G94 G17\nN20 T1 M6\nN30 S900 M3\n\
                  N40 G1 G43 X1. Y2. Z3. F200. H1\nN50 M30\n%\n";

/// A folder with the files of a test.
pub struct Folder(pub TempDir);

impl Folder {
    pub fn new() -> Folder {
        Folder(TempDir::new().expect("a folder for the test"))
    }

    pub fn with(self, name: &str, text: impl AsRef<[u8]>) -> Folder {
        let path = self.0.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder for the test");
        std::fs::write(path, text).expect("a file for the test");
        self
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_filpost"));
        command.args(arguments).current_dir(self.0.path());
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Ran {
        let output = self.command(arguments).stdin(Stdio::null()).output();
        Ran::of(output.expect("the command starts"))
    }

    pub fn run_with_input(&self, arguments: &[&str], input: &[u8]) -> Ran {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the command starts");
        let mut stdin = child.stdin.take().expect("a pipe");
        // A command that does not read its input closes the pipe.
        let _ = stdin.write_all(input);
        drop(stdin);
        Ran::of(child.wait_with_output().expect("the command ends"))
    }

    pub fn text(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.0.path().join(name)).ok()
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.path().join(name)).expect("the file is there")
    }

    pub fn folder(self, name: &str) -> Folder {
        std::fs::create_dir_all(self.0.path().join(name)).expect("a folder for the test");
        self
    }

    /// Names of all files, so that nothing forgotten stays unseen.
    pub fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(self.0.path())
            .expect("the folder is there")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}

/// How a run of the command ended.
#[derive(Debug)]
pub struct Ran {
    pub status: i32,
    pub out: String,
    pub err: String,
}

impl Ran {
    pub fn of(output: Output) -> Ran {
        Ran {
            status: output.status.code().expect("an exit status"),
            out: String::from_utf8(output.stdout).expect("UTF-8"),
            err: String::from_utf8(output.stderr).expect("UTF-8"),
        }
    }

    /// Status, standard output and standard error.
    pub fn seen(&self) -> (i32, &str, &str) {
        (self.status, &self.out, &self.err)
    }
}
