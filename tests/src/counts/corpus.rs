//! The CL files whose items are changed, each with its machine.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::{env, fs};

use filpost::case::Case;
use filpost::cl::reader::{Options, Reader};
use filpost::cl::{Record, Vocabulary};
use filpost::{Error, Program, case};

use crate::posting::Prepared;
use crate::root;
use crate::words::Header;

/// A CL file and the machine it is posted for.
pub struct Part {
    /// What messages show.
    pub name: String,
    /// The CL text.
    pub cl: String,
    recipe: Recipe,
}

/// What a machine is made of.
enum Recipe {
    Case(Box<Case>),
    Words(Header),
    Ready(&'static str),
}

/// Machines for CL files that come without one.
const MACHINES: [&str; 3] = ["linuxcnc-mill", "fanuc-mill", "fanuc-lathe"];

impl Part {
    /// The machine, with a setting on top.
    ///
    /// # Errors
    /// Settings or scripts that make no post.
    pub fn machine(&self, setting: Option<&str>) -> Result<Prepared, Error> {
        let setting = setting.map(str::to_string);
        match &self.recipe {
            Recipe::Case(case) => {
                let mut case = case.clone();
                case.file.set.extend(setting);
                Ok(Prepared::of(case.program()?).with_dialect(case.file.dialect))
            }
            Recipe::Words(header) => {
                let mut header = header.clone();
                header.settings.extend(setting);
                header.post().map(Prepared::of)
            }
            Recipe::Ready(name) => {
                let mut builder = Program::builder().generic(name);
                if let Some(setting) = &setting {
                    builder = builder.set(setting);
                }
                builder.build().map(Prepared::of)
            }
        }
    }

    /// Lines of the statements that the dialect reads as without effect.
    pub fn inert_lines(&self) -> HashSet<usize> {
        let (mut words, mut record) = (Vocabulary::new(), Record::default());
        let mut reader = Reader::new(self.cl.as_bytes(), &self.name, Options::default());
        let mut lines = HashSet::new();
        while reader.read(&mut words, &mut record).is_ok_and(|more| more) {
            if record.inert {
                lines.insert(record.line as usize);
            }
        }
        lines
    }

    /// True when the post makes a program of it.
    fn posts(&self) -> bool {
        self.machine(None).is_ok_and(|machine| machine.post(&self.cl).is_ok())
    }
}

/// The cases of the corpus, the files of the suite of words, and CL files of the tests
/// and of other people; where the last are absent, the reason is printed. Files
/// that are refused are left out.
pub fn parts() -> Vec<Part> {
    let mut parts = cases();
    parts.extend(words());
    parts.retain(Part::posts);
    let data = env::var_os("FILPOST_DATA").map_or(root().join("../shared/data"), PathBuf::from);
    if !data.join("cl").is_dir() {
        println!("skipped: {} is not there", data.join("cl").display());
    }
    for folder in [root().join("tests/cl"), data.join("cl"), data.join("cl-more")] {
        parts.extend(files(&folder).iter().filter_map(|path| on_a_ready_post(path)));
    }
    parts
}

fn cases() -> Vec<Part> {
    let cases = case::find(&root().join("corpus")).expect("the corpus can be read");
    let part = |case: Case| {
        let name = case.folder.strip_prefix(root()).unwrap_or(&case.folder).display().to_string();
        let cl = fs::read_to_string(case.folder.join(&case.file.cl)).ok()?;
        Some(Part { name, cl, recipe: Recipe::Case(Box::new(case)) })
    };
    cases.into_iter().filter_map(part).collect()
}

fn words() -> Vec<Part> {
    let part = |path: &PathBuf| {
        let cl = fs::read_to_string(path).ok()?;
        let header = Header::read(&cl).ok()?;
        let name = path.strip_prefix(root()).unwrap_or(path).display().to_string();
        Some(Part { name, cl, recipe: Recipe::Words(header) })
    };
    files(&root().join("tests/words")).iter().filter_map(part).collect()
}

/// A CL file with the first ready post that takes it.
fn on_a_ready_post(path: &Path) -> Option<Part> {
    let cl = String::from_utf8_lossy(&fs::read(path).ok()?).into_owned();
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let parts = MACHINES.map(|machine| Part {
        name: format!("{file} on {machine}"),
        cl: cl.clone(),
        recipe: Recipe::Ready(machine),
    });
    parts.into_iter().find(Part::posts)
}

/// All files below a folder, sorted.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        let paths = entries.flatten().map(|entry| entry.path());
        let (inner, found): (Vec<_>, Vec<_>) = paths.partition(|path| path.is_dir());
        folders.extend(inner);
        files.extend(found);
    }
    files.sort();
    files
}
