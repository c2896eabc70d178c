//! The open documents, and the files they are checked with.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use fil_ide::{Outline, Script, Text};
use filpost::{Included, files, includes};

use crate::cases::{Cases, is_script};
use crate::last_run::LastRun;
use crate::uri::path_of;

/// What a document is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A FIL file.
    Fil,
    /// A `machine.toml`.
    Machine,
    /// A CL file.
    Cl,
}

impl Kind {
    /// By the name of the document; what the editor says wins.
    pub fn of(uri: &str, language: &str) -> Option<Self> {
        match language {
            "fil" => return Some(Kind::Fil),
            "cl" | "ncl" => return Some(Kind::Cl),
            _ => {}
        }
        let name = uri.rsplit('/').next().unwrap_or(uri).to_ascii_lowercase();
        let end = name.rsplit('.').next().unwrap_or_default();
        let numbered = |letter: char| {
            end.strip_prefix(letter).is_some_and(|digits| {
                !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
            })
        };
        match end {
            "fil" => Some(Kind::Fil),
            "toml" if name.starts_with("machine") || language == "toml" && name != "case.toml" => {
                Some(Kind::Machine)
            }
            "ncl" | "cl" | "cls" | "apt" | "aptsource" | "clf" => Some(Kind::Cl),
            _ if numbered('f') => Some(Kind::Fil),
            _ => None,
        }
    }
}

/// An open document.
pub(crate) struct Document {
    pub kind: Option<Kind>,
    pub text: Text,
    /// As the editor sent it.
    pub raw: String,
    /// Changed since it was opened or saved.
    pub changed: bool,
}

/// All open documents.
#[derive(Default)]
pub(crate) struct Documents {
    open: HashMap<String, Document>,
    /// Analyses of FIL documents; thrown away with each change.
    scripts: HashMap<String, Script>,
    cases: Cases,
    /// The runs of cases, by their folders, until a file is saved.
    runs: HashMap<PathBuf, LastRun>,
    /// Symbols of the files that are not open, until a file on the disk changes.
    closed: Option<Vec<Symbols>>,
}

/// A file and its symbols.
pub(crate) type Symbols = (PathBuf, Vec<Outline>);

impl Documents {
    /// Documents of an editor that has a folder open.
    pub fn new(root: Option<PathBuf>) -> Self {
        Documents { cases: Cases::new(root), ..Documents::default() }
    }

    /// A document was opened or changed.
    pub fn set(&mut self, uri: &str, language: Option<&str>, text: &str) {
        let kind = match (language, self.open.get(uri)) {
            (Some(language), _) => Kind::of(uri, language),
            (None, Some(document)) => document.kind,
            (None, None) => Kind::of(uri, ""),
        };
        let changed = language.is_none();
        let document = Document { kind, text: Text::new(text), raw: text.to_string(), changed };
        self.open.insert(uri.to_string(), document);
        self.scripts.clear();
    }

    /// A document was saved.
    pub fn saved(&mut self, uri: &str) {
        if let Some(document) = self.open.get_mut(uri) {
            document.changed = false;
        }
    }

    /// A document was closed.
    pub fn close(&mut self, uri: &str) {
        self.open.remove(uri);
        self.scripts.clear();
    }

    /// Files on the disk may have changed.
    pub fn forget(&mut self) {
        self.cases.forget();
        self.scripts.clear();
        self.runs.clear();
        self.closed = None;
    }

    /// What a word held, or which record there was, when a line of a script ran last in its
    /// case. A document with changes that are not saved has none.
    pub fn last_run(&mut self, uri: &str, line: u32, word: &str) -> Option<String> {
        self.cases.look();
        let document = self.open.get(uri)?;
        let path = path_of(uri)?;
        if files::read_text(&path, None).ok()? != document.raw {
            return None;
        }
        let root = root_of(&path, &self.texts()).unwrap_or_else(|| path.clone());
        let case = self.cases.group_of(&root).case?;
        let run = self.runs.entry(case.clone()).or_insert_with(|| LastRun::of(&case));
        run.told(&path.canonicalize().ok()?, line + 1, word)
    }

    pub fn get(&self, uri: &str) -> Option<&Document> {
        self.open.get(uri)
    }

    /// All open FIL documents.
    pub fn scripts_open(&self) -> Vec<String> {
        let fil = self.open.iter().filter(|(_, document)| document.kind == Some(Kind::Fil));
        let mut found: Vec<String> = fil.map(|(uri, _)| uri.clone()).collect();
        found.sort_unstable();
        found
    }

    /// Symbols of the FIL files of the open folder and of what they include. They are read
    /// when they are first asked for.
    pub fn symbols_on_disk(&mut self) -> &[Symbols] {
        if self.closed.is_none() {
            self.closed = Some(symbols_of(&self.cases.scripts()));
        }
        self.closed.as_deref().unwrap_or_default()
    }

    /// The analysis of an open FIL document.
    pub fn script(&mut self, uri: &str) -> Option<&Script> {
        self.cases.look();
        let document = self.open.get(uri)?;
        if document.kind != Some(Kind::Fil) {
            return None;
        }
        if !self.scripts.contains_key(uri) {
            let script = self.analyze(uri, document);
            self.scripts.insert(uri.to_string(), script);
        }
        self.scripts.get(uri)
    }

    fn analyze(&self, uri: &str, document: &Document) -> Script {
        let Some(path) = path_of(uri) else {
            return Script::new(&[(uri, &document.raw)], uri, None, None);
        };
        let open = self.texts();
        let root = root_of(&path, &open).unwrap_or_else(|| path.clone());
        let group = self.cases.group_of(&root);
        let machine = group.commons();
        let read = |path: &PathBuf| {
            open.get(path)
                .cloned()
                .or_else(|| files::read_text(path, None).ok())
                .unwrap_or_default()
        };
        // A path may be written in two ways; names of an analysis are those of the group.
        let real = root.canonicalize().unwrap_or_else(|_| root.clone());
        let is_root = |file: &&PathBuf| **file == root || **file == real;
        let name = group.files.iter().find(is_root).unwrap_or(&root).display().to_string();
        let named: Vec<(String, String)> =
            group.files.iter().map(|file| (file.display().to_string(), read(file))).collect();
        let given: Vec<(&str, &str)> =
            named.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        let own = path.canonicalize().unwrap_or_else(|_| path.clone());
        // The name of an included file is known only once it has been included.
        let known = RefCell::new(None);
        let analyzed = |edited: &str| {
            let mut beside = includes::beside(&group.files, None);
            let mut loader = |from: &str, file: &str| -> Result<Included, String> {
                let mut included = beside(from, file)?;
                if let Ok(real) = Path::new(&included.name).canonicalize() {
                    if let Some(text) = open.get(&real) {
                        included.text.clone_from(text);
                    }
                    if real == own {
                        *known.borrow_mut() = Some(included.name.clone());
                    }
                }
                Ok(included)
            };
            Script::new(&given, edited, Some(&mut loader), machine.as_ref())
        };
        let script = analyzed(&name);
        let included = known.borrow().clone();
        match included.filter(|_| root != path) {
            Some(edited) => analyzed(&edited),
            None => script,
        }
    }

    /// Texts of changed documents by their paths without links. One that is as it was saved
    /// is read from its file: an editor may have read another code page into it.
    pub fn unsaved(&self) -> HashMap<PathBuf, String> {
        let changed = self.open.iter().filter(|(_, document)| document.changed);
        let of_file = changed.filter_map(|(uri, document)| {
            Some((path_of(uri)?.canonicalize().ok()?, document.raw.clone()))
        });
        of_file.collect()
    }

    /// The folder of the case that a document belongs to: one whose CL file, machine or FIL
    /// file it is, else the nearest one above with a case.toml.
    pub fn case_of(&mut self, uri: &str) -> Option<PathBuf> {
        self.cases.look();
        let path = path_of(uri)?;
        let root = root_of(&path, &self.texts()).unwrap_or_else(|| path.clone());
        let named = self.cases.group_of(&root).case.or_else(|| self.cases.case_with(&path));
        named.or_else(|| {
            let above = path.ancestors().skip(1).find(|folder| folder.join("case.toml").is_file());
            above.map(Path::to_path_buf)
        })
    }

    /// Texts of open FIL documents by their paths, real ones too.
    fn texts(&self) -> HashMap<PathBuf, String> {
        let mut found = HashMap::new();
        for (uri, document) in &self.open {
            let Some(path) = path_of(uri) else { continue };
            if let Ok(real) = path.canonicalize() {
                found.insert(real, document.raw.clone());
            }
            found.insert(path, document.raw.clone());
        }
        found
    }
}

/// Symbols of files and of those they include, each file once.
fn symbols_of(paths: &[PathBuf]) -> Vec<Symbols> {
    let mut found: Vec<Symbols> = Vec::new();
    let mut known: HashSet<PathBuf> = HashSet::new();
    for path in paths {
        if known.contains(path) {
            continue;
        }
        let Ok(text) = files::read_text(path, None) else { continue };
        let name = path.display().to_string();
        let mut loader = includes::beside(std::slice::from_ref(path), None);
        let script = Script::new(&[(&name, &text)], &name, Some(&mut loader), None);
        for (file, outline) in script.outlines() {
            let real = Path::new(file).canonicalize().unwrap_or_else(|_| PathBuf::from(file));
            if known.insert(real.clone()) {
                found.push((real, outline));
            }
        }
    }
    found
}

/// The file beside or above that includes this one: names of both are one name space.
fn root_of(path: &Path, open: &HashMap<PathBuf, String>) -> Option<PathBuf> {
    let own = path.file_name()?.to_str()?.to_ascii_uppercase();
    let folder = path.parent()?;
    for folder in [Some(folder), folder.parent()].into_iter().flatten() {
        let entries = std::fs::read_dir(folder).ok()?;
        let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        files.sort_unstable();
        for file in files {
            if file == path || !is_script(&file) {
                continue;
            }
            let text = open.get(&file).cloned().or_else(|| files::read_text(&file, None).ok());
            let includes = text.is_some_and(|text| {
                text.lines().any(|line| {
                    let line = line.trim().to_ascii_uppercase();
                    line.starts_with("INCLUD") && line.trim_end_matches('\'').ends_with(&own)
                })
            });
            if includes {
                return Some(file);
            }
        }
    }
    None
}
