//! All that is posted: cases, CL files, tests and random programs.

use std::collections::{BTreeMap, HashMap};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use filpost::case::{Case, Programs};
use filpost::{Error, Program, Unit, cl};
use filpost_tests::words::Header;
use filpost_tests::{language, nc_cases};

use super::POSTS;
use super::outcome::{no_post, posted};
use super::random::Drawn;
use super::record::{Key, Record};

/// What a CL file is called in messages.
const CL_NAME: &str = "CL";

/// The post that comes with a program.
pub const OWN: &str = "own";

/// Something to post.
pub enum Input {
    /// A case of the corpus, as it says.
    Case(PathBuf),
    /// A CL file with a ready post.
    Ready {
        /// The file.
        cl: Arc<ClFile>,
        /// The name of the post.
        post: &'static str,
    },
    /// A file of `tests/words` with the machine of its header.
    Words(PathBuf),
    /// A test of the language suite.
    Language(PathBuf),
    /// A random program.
    Random(Drawn),
}

/// A CL file and how it is read.
pub struct ClFile {
    path: PathBuf,
    reading: cl::reader::Options,
    unit: Unit,
}

/// Everything below the root of a checkout, and random programs.
///
/// # Errors
/// A folder that can't be read.
pub fn all(root: &Path, programs: Vec<Drawn>) -> Result<Vec<(Key, Input)>, String> {
    // Cases name their CL files by way of other folders.
    let root = root.canonicalize().map_err(|error| format!("{}: {error}", root.display()))?;
    let mut inputs = Vec::new();
    corpus(&root.join("corpus"), &mut inputs)?;
    let words = root.join("tests/words");
    for path in of_ending(nc_cases::files_in(&words), "ncl") {
        with_ready_posts("words", &words, ClFile::plain(path.clone()), &mut inputs);
        inputs.push((key("words", &words, &path, OWN), Input::Words(path)));
    }
    let language = root.join("tests/language");
    for path in of_ending(nc_cases::files_in(&language), "fil") {
        inputs.push((key("language", &language, &path, OWN), Input::Language(path)));
    }
    for drawn in programs {
        let file = drawn.seed.to_string();
        let key = Key { suite: drawn.suite.clone(), file, post: OWN.into() };
        inputs.push((key, Input::Random(drawn)));
    }
    Ok(inputs)
}

fn of_ending(mut paths: Vec<PathBuf>, ending: &str) -> Vec<PathBuf> {
    paths.retain(|path| path.extension().is_some_and(|found| found == ending));
    paths
}

fn key(suite: &str, folder: &Path, path: &Path, post: &str) -> Key {
    let file = path.strip_prefix(folder).unwrap_or(path).to_string_lossy();
    // A record is words with blanks between them.
    let file = file.replace('\\', "/").replace(' ', "_");
    Key { suite: suite.into(), file, post: post.into() }
}

/// The cases, and each CL file below the folder with the ready posts.
fn corpus(folder: &Path, inputs: &mut Vec<(Key, Input)>) -> Result<(), String> {
    let mut files: BTreeMap<PathBuf, ClFile> = BTreeMap::new();
    for path in below(folder)? {
        if path.extension() == Some(OsStr::new("ncl")) {
            files.entry(path.clone()).or_insert_with(|| ClFile::plain(path));
        } else if path.file_name() == Some(OsStr::new("case.toml")) {
            let of_case = path.parent().unwrap_or(folder);
            inputs.push((key("corpus", folder, of_case, OWN), Input::Case(of_case.into())));
            if let Ok(case) = Case::load(of_case) {
                let cl = ClFile::of_case(&case);
                files.insert(cl.path.clone(), cl);
            }
        }
    }
    for cl in files.into_values() {
        with_ready_posts("corpus", folder, cl, inputs);
    }
    Ok(())
}

/// All files below a folder, sorted.
fn below(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let (mut files, mut folders) = (Vec::new(), vec![folder.to_path_buf()]);
    while let Some(folder) = folders.pop() {
        let wrong = |error| format!("{}: {error}", folder.display());
        for entry in fs::read_dir(&folder).map_err(wrong)? {
            let path = entry.map_err(wrong)?.path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    Ok(files)
}

fn with_ready_posts(suite: &str, folder: &Path, cl: ClFile, inputs: &mut Vec<(Key, Input)>) {
    let cl = Arc::new(cl);
    for post in POSTS {
        let input = Input::Ready { cl: Arc::clone(&cl), post };
        inputs.push((key(suite, folder, &cl.path, post), input));
    }
}

impl ClFile {
    /// A file that nothing more is known of; without UNITS it is in millimetres.
    fn plain(path: PathBuf) -> ClFile {
        ClFile { path, reading: cl::reader::Options::default(), unit: Unit::Mm }
    }

    /// The file of a case, read as the case says.
    fn of_case(case: &Case) -> ClFile {
        let path = case.folder.join(&case.file.cl);
        let (dialect, raw) = (case.file.dialect, case.file.raw_records);
        ClFile {
            path: path.canonicalize().unwrap_or(path),
            reading: cl::reader::Options { dialect, raw, ..cl::reader::Options::default() },
            unit: case.file.units.unwrap_or(Unit::Mm),
        }
    }
}

/// A post that one thread builds while others may wait for it.
type Cell = Arc<OnceLock<Result<Program, Error>>>;

/// Posts that many inputs share: those of cases, and the ready ones.
#[derive(Default)]
pub struct Posts {
    of_cases: Programs,
    ready: Mutex<HashMap<&'static str, Cell>>,
}

impl Posts {
    fn ready(&self, name: &'static str) -> Result<Program, Error> {
        // Nothing is left half done in the table, whoever panicked.
        let mut ready = self.ready.lock().unwrap_or_else(PoisonError::into_inner);
        let cell = Arc::clone(ready.entry(name).or_default());
        drop(ready);
        cell.get_or_init(|| Program::builder().generic(name).build()).clone()
    }
}

impl Input {
    /// Posts it.
    pub fn posted(&self, posts: &Posts) -> Record {
        let record = match self {
            Input::Case(folder) => case(folder, posts),
            Input::Ready { cl, post } => ready(cl, posts.ready(post)),
            Input::Words(path) => words(path),
            Input::Language(path) => test(path),
            Input::Random(drawn) => random(drawn),
        };
        record.unwrap_or_else(|why| match why {
            Why::Post(error) => no_post(error.diags()),
            Why::Input => no_post(&[]),
        })
    }
}

/// Why there is nothing to run.
enum Why {
    /// The machine or its FIL is refused.
    Post(Error),
    /// A file can't be read, or has a header of another revision.
    Input,
}

impl From<Error> for Why {
    fn from(error: Error) -> Self {
        Why::Post(error)
    }
}

fn case(folder: &Path, posts: &Posts) -> Result<Record, Why> {
    let case = Case::load(folder)?;
    let (program, cl) = (posts.of_cases.get(&case)?, case.cl_text()?);
    Ok(posted(&program, || case.start(&program), (&cl, &case.file.cl)))
}

fn ready(cl: &ClFile, program: Result<Program, Error>) -> Result<Record, Why> {
    let (program, text) = (program?, fs::read(&cl.path).map_err(|_| Why::Input)?);
    let start = || program.start().cl_options(cl.reading).units(cl.unit);
    Ok(posted(&program, start, (&text, CL_NAME)))
}

fn words(path: &Path) -> Result<Record, Why> {
    let text = fs::read_to_string(path).map_err(|_| Why::Input)?;
    let program = Header::read(&text).map_err(|_| Why::Input)?.post()?;
    Ok(posted(&program, || program.start(), (text.as_bytes(), CL_NAME)))
}

fn test(path: &Path) -> Result<Record, Why> {
    let (program, _written, cl) = language::read(path).map_err(|_| Why::Input)?.post()?;
    let start = || program.start().cl_name(language::CL_NAME);
    Ok(posted(&program, start, (cl.as_bytes(), language::CL_NAME)))
}

fn random(drawn: &Drawn) -> Result<Record, Why> {
    let builder = Program::builder().generic(&drawn.ready);
    let program = drawn.settings.iter().fold(builder, |builder, one| builder.set(one)).build()?;
    Ok(posted(&program, || program.start(), (drawn.cl.as_bytes(), CL_NAME)))
}
