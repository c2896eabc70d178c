//! Cases of the folder that is open: which FIL files belong together, and for which machine.

use std::path::{Path, PathBuf};

use filpost::case::Case;
use filpost::{Commons, files, settings};

use crate::documents::Kind;

/// Folders below the open one that are looked into.
const DEPTH: usize = 6;
/// Cases that are read; a folder with more of them is a corpus, not a post.
const MOST: usize = 2000;

/// FIL files that are given together, in their order, and their machine.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Group {
    pub files: Vec<PathBuf>,
    pub machine: Option<PathBuf>,
    /// The folder of the case.
    pub case: Option<PathBuf>,
    /// The CL file of the case.
    pub cl: Option<PathBuf>,
}

/// What the cases of a folder say.
#[derive(Default)]
pub(crate) struct Cases {
    root: Option<PathBuf>,
    /// Read when they are first asked for.
    groups: Option<Vec<Group>>,
}

impl Cases {
    pub fn new(root: Option<PathBuf>) -> Self {
        Cases { root, groups: None }
    }

    /// Files on the disk may have changed.
    pub fn forget(&mut self) {
        self.groups = None;
    }

    /// Reads the cases, where they have not been read.
    pub fn look(&mut self) {
        if self.groups.is_none() {
            let mut groups = Vec::new();
            if let Some(root) = &self.root {
                walk(root, DEPTH, &mut groups);
            }
            // The case with the most files says the most of a name.
            groups.sort_by_key(|group| std::cmp::Reverse(group.files.len()));
            self.groups = Some(groups);
        }
    }

    /// The FIL files of the folder.
    pub fn scripts(&self) -> Vec<PathBuf> {
        let mut found = Vec::new();
        if let Some(root) = &self.root {
            scripts_below(root, DEPTH, &mut found);
        }
        found
    }

    /// The case whose CL file or machine a file is.
    pub fn case_with(&self, path: &Path) -> Option<PathBuf> {
        let real = path.canonicalize().ok()?;
        let mut groups = self.groups.iter().flatten();
        let named = groups.find(|group| {
            [&group.cl, &group.machine].into_iter().any(|file| file.as_ref() == Some(&real))
        });
        named?.case.clone()
    }

    /// The files that a FIL file is given with; itself where no case names it. The machine
    /// is that of the case, or the `machine.toml` beside the file.
    pub fn group_of(&self, path: &Path) -> Group {
        let real = path.canonicalize().ok();
        let named = |group: &&Group| real.as_ref().is_some_and(|real| group.files.contains(real));
        if let Some(group) = self.groups.iter().flatten().find(named) {
            return group.clone();
        }
        let machine = path.parent().map(|folder| folder.join("machine.toml"));
        let machine = machine.filter(|machine| machine.is_file());
        Group { files: vec![path.to_path_buf()], machine, ..Group::default() }
    }
}

impl Group {
    /// The machine, where it can be read.
    pub fn commons(&self) -> Option<Commons> {
        let path = self.machine.as_ref()?;
        let text = files::read_text(path, None).ok()?;
        settings::read_toml(&path.display().to_string(), &text).ok().map(|(commons, _)| commons)
    }
}

fn walk(folder: &Path, depth: usize, groups: &mut Vec<Group>) {
    if groups.len() >= MOST {
        return;
    }
    if folder.join("case.toml").is_file()
        && let Ok(case) = Case::load(folder)
    {
        groups.extend(of_case(&case));
    }
    for below in entries(folder).iter().filter(|path| is_looked_into(path)) {
        if depth > 1 {
            walk(below, depth - 1, groups);
        }
    }
}

/// What stands in a folder, by name.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort_unstable();
    paths
}

/// True for a folder of the user's own.
fn is_looked_into(path: &Path) -> bool {
    path.is_dir()
        && path.file_name().is_some_and(|name| {
            let name = name.to_string_lossy();
            !name.starts_with('.') && name != "target" && name != "node_modules"
        })
}

/// FIL files that are read for a search; each takes some milliseconds.
const MOST_SCRIPTS: usize = 500;
/// Bytes of a FIL file; a longer one is something else.
const LONGEST_SCRIPT: u64 = 2 << 20;

fn scripts_below(folder: &Path, depth: usize, found: &mut Vec<PathBuf>) {
    for path in entries(folder) {
        if found.len() >= MOST_SCRIPTS {
            return;
        }
        if depth > 1 && is_looked_into(&path) {
            scripts_below(&path, depth - 1, found);
        } else if is_script(&path) {
            found.extend(path.canonicalize());
        }
    }
}

/// True for a FIL file that can be read between two keystrokes.
pub fn is_script(path: &Path) -> bool {
    let name = path.display().to_string();
    let is_file = path.metadata().is_ok_and(|own| own.is_file() && own.len() <= LONGEST_SCRIPT);
    is_file && Kind::of(&name, "") == Some(Kind::Fil)
}

/// The files of a case; none of one that must be refused.
fn of_case(case: &Case) -> Option<Group> {
    if case.file.expect_error.is_some() {
        return None;
    }
    let real = |name: &String| case.folder.join(name).canonicalize().ok();
    let files: Option<Vec<PathBuf>> = case.file.fil.iter().map(real).collect();
    let machine = case.file.machine.as_ref().and_then(real);
    let (cl, case) = (real(&case.file.cl), Some(case.folder.clone()));
    Some(Group { files: files?, machine, case, cl })
}
