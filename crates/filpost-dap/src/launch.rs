//! What is debugged: a case, or a CL file with a post, and how a run of it starts.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use filpost::case::{Case, CaseFile, Programs};
use filpost::debug::SharedDebugger;
use filpost::{Error, Program};
use serde_json::{Map, Value};

use crate::breakpoints::{same_file, whole};
use crate::hook::Files;

/// A program and its CL file, ready to run any number of times.
pub struct Launched {
    case: Case,
    program: Program,
    cl: Vec<u8>,
    /// The files of a run.
    pub files: Files,
    /// The NC program whose lines have breakpoints, and where a run writes its program.
    pub nc: Option<PathBuf>,
    /// The run writes its program to `nc` when it ends well.
    pub writes: bool,
}

/// Keys that are not those of a case.
const OWN: &[&str] = &["case", "cwd", "nc", "output", "stopOnEntry", "noDebug"];

/// Makes ready what the client asks for: `case`, a folder with a case.toml; or the keys of a
/// case.toml (`cl`, `ready`, `machine`, `fil`, `set` …) with files as seen from `cwd`.
///
/// # Errors
/// What is wrong with the files, in sentences.
pub fn launch(arguments: &Value) -> Result<Launched, String> {
    let text = |key: &str| arguments.get(key).and_then(Value::as_str);
    let cwd = text("cwd").map_or_else(|| PathBuf::from("."), PathBuf::from);
    let case = match text("case") {
        Some(folder) => Case::load(&cwd.join(folder)).map_err(|error| sentences(&error))?,
        None => Case { file: case_file(arguments)?, folder: cwd.clone() },
    };
    let program = Programs::for_debugging().get(&case).map_err(|error| sentences(&error))?;
    let cl = case.cl_text().map_err(|error| sentences(&error))?;
    let names = program.fil_files();
    let fil = names.iter().map(|name| whole(Path::new(name))).collect();
    let files = Files { cl: whole(&case.folder.join(&case.file.cl)), fil, names };
    let output = text("output").map(|name| cwd.join(name));
    if let Some(output) = &output {
        let mut read = case.files().into_iter().chain(files.fil.iter().cloned());
        if let Some(taken) = read.find(|path| same_file(path, output)) {
            return Err(format!("output would write over {}", taken.display()));
        }
    }
    let last = text("nc").map(|name| cwd.join(name));
    let expected = case.file.expect.as_ref().map(|name| case.folder.join(name));
    let writes = output.is_some();
    Ok(Launched { nc: output.or(last).or(expected), case, program, cl, files, writes })
}

/// The keys of a case without its origin, which nothing needs here.
fn case_file(arguments: &Value) -> Result<CaseFile, String> {
    let mut keys = Map::new();
    keys.insert("origin".into(), "debugged".into());
    for (key, value) in arguments.as_object().into_iter().flatten() {
        // Clients add keys of their own; those of a case are all known.
        let is_own = OWN.contains(&key.as_str()) || key.starts_with("__");
        let is_of_client = ["name", "type", "request", "preLaunchTask", "presentation"];
        if !is_own && !is_of_client.contains(&key.as_str()) {
            keys.insert(key.clone(), value.clone());
        }
    }
    if !keys.contains_key("cl") {
        return Err("name a case (a folder with a case.toml), or a cl file with its post".into());
    }
    serde_json::from_value(Value::Object(keys)).map_err(|error| error.to_string())
}

/// An error as its messages.
pub fn sentences(error: &Error) -> String {
    let lines = error.diags().iter().map(ToString::to_string);
    lines.collect::<Vec<_>>().join("\n")
}

impl Launched {
    /// The program, for what there is to stop at.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Runs it to the end, or until the debugger stops it.
    ///
    /// # Errors
    /// As [`filpost::Run::stream`].
    pub fn run(&self, debugger: &SharedDebugger) -> Result<Vec<u8>, Error> {
        let mut nc = Vec::new();
        // What a script writes appears nowhere: this is no run for the shop.
        let run = self.case.start(&self.program).debug(debugger);
        run.run_pending(Cursor::new(&self.cl), &mut nc).map(|_| nc)
    }
}
