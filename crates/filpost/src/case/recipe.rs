//! What the program of a case is made of, and programs that cases share.

use std::collections::{BTreeMap, HashMap};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use fil_diag::Diag;
use fil_vm::{Limits, Moment};

use super::Case;
use crate::allow::levels_named;
use crate::builder::Builder;
use crate::error::{Error, RunCode};
use crate::files;
use crate::granted::Clock;
use crate::includes;
use crate::program::Program;

/// A file by its name for messages, with its text.
type Named = (String, String);

/// All that a case says about its program: equal recipes make the same program.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Recipe {
    ready: Option<String>,
    machine: Option<Named>,
    option_file: Option<Named>,
    fil: Vec<Named>,
    settings: Vec<String>,
    options: BTreeMap<String, String>,
    compat: Option<Named>,
    strict: bool,
    allow: Vec<String>,
    levels: BTreeMap<String, String>,
    read: Option<PathBuf>,
    clock: Option<String>,
    fuel: Option<u64>,
    debug: bool,
    /// Another text for a FIL file, one that INCLUD brings in too.
    changed: Option<Named>,
    /// Texts in place of files that INCLUD brings in, by their paths without links.
    unsaved: Vec<(PathBuf, String)>,
}

/// Texts that stand for files of a case: documents of an editor that are not saved yet, by
/// their paths without links.
pub type Unsaved = HashMap<PathBuf, String>;

/// The unsaved text of a file.
fn unsaved_text<'u>(unsaved: &'u Unsaved, path: &Path) -> Option<&'u String> {
    unsaved.get(&path.canonicalize().ok()?)
}

impl Recipe {
    /// Reads the files of a case.
    ///
    /// # Errors
    /// Files that can't be read.
    pub fn of(case: &Case) -> Result<Recipe, Error> {
        Recipe::reading(case, &|path| files::read_text(path, None))
    }

    /// The same with unsaved texts in place of their files.
    ///
    /// # Errors
    /// Files that can't be read.
    pub fn with_unsaved(case: &Case, unsaved: &Unsaved) -> Result<Recipe, Error> {
        let mut recipe = Recipe::reading(case, &|path| match unsaved_text(unsaved, path) {
            Some(text) => Ok(text.clone()),
            None => files::read_text(path, None),
        })?;
        recipe.unsaved = unsaved.iter().map(|(path, text)| (path.clone(), text.clone())).collect();
        recipe.unsaved.sort_unstable();
        Ok(recipe)
    }

    fn reading(
        case: &Case,
        read: &dyn Fn(&Path) -> Result<String, Error>,
    ) -> Result<Recipe, Error> {
        let text = |name: &String| {
            let text = read(&case.folder.join(name))?;
            Ok::<Named, Error>((name.clone(), text))
        };
        let script = |name: &String| {
            let path = plain(&case.folder.join(name));
            let text = read(&path)?;
            Ok::<Named, Error>((path.display().to_string(), text))
        };
        let file = &case.file;
        Ok(Recipe {
            ready: file.ready.clone(),
            machine: file.machine.as_ref().map(text).transpose()?,
            option_file: file.option_file.as_ref().map(text).transpose()?,
            fil: file.fil.iter().map(script).collect::<Result<_, _>>()?,
            settings: file.set.clone(),
            options: file.options.clone(),
            compat: file.compat.as_ref().map(text).transpose()?,
            strict: file.strict,
            allow: file.allow.clone(),
            levels: file.levels.clone(),
            read: file.read.as_ref().map(|folder| case.folder.join(folder)),
            clock: file.clock.clone(),
            fuel: file.fuel,
            debug: false,
            changed: None,
            unsaved: Vec::new(),
        })
    }

    /// The program.
    ///
    /// # Errors
    /// As [`Builder::build`].
    pub fn build(&self) -> Result<Program, Error> {
        let mut builder = Program::builder().strict(self.strict).debug(self.debug);
        for name in &self.allow {
            builder = builder.allow(crate::allowable(name).map_err(Error::setup)?);
        }
        let levels = self.levels.iter().map(|(name, level)| (name.as_str(), level.as_str()));
        builder = builder.levels(&levels_named(levels).map_err(Error::setup)?);
        if let Some(name) = &self.ready {
            builder = builder.ready(name);
        }
        if let Some((name, text)) = &self.machine {
            builder = builder.machine(name, text);
        }
        if let Some((name, text)) = &self.option_file {
            builder = builder.option_file(name, text);
        }
        for setting in &self.settings {
            builder = builder.set(setting);
        }
        for (name, value) in &self.options {
            builder = builder.option(name, value);
        }
        if let Some((name, text)) = &self.compat {
            builder = builder.compat(crate::read_compat(name, text).map_err(Error::setup)?);
        }
        if let Some(fuel) = self.fuel {
            builder = builder.limits(Limits { fuel, ..Limits::default() });
        }
        self.granted(self.with_fil(builder))?.build()
    }

    fn with_fil(&self, mut builder: Builder) -> Builder {
        let other = |name: &str| {
            self.changed.as_ref().filter(|(known, _)| known == name).map(|(_, text)| text.clone())
        };
        for (name, text) in &self.fil {
            builder = builder.fil(name, other(name).as_deref().unwrap_or(text));
        }
        let paths: Vec<PathBuf> = self.fil.iter().map(|(name, _)| PathBuf::from(name)).collect();
        let mut include = includes::beside(&paths, None);
        let changed = self.changed.clone();
        let unsaved: Unsaved = self.unsaved.iter().cloned().collect();
        builder.includes(move |from, name| {
            let mut included = include(from, name)?;
            if let Some(text) = unsaved_text(&unsaved, Path::new(&included.name)) {
                included.text.clone_from(text);
            }
            if let Some((_, text)) = changed.as_ref().filter(|(known, _)| *known == included.name) {
                included.text.clone_from(text);
            }
            Ok(included)
        })
    }

    /// The same with another text for a FIL file, and with less fuel: a change may make a
    /// loop without end.
    pub fn with_change(mut self, name: &str, text: String) -> Recipe {
        self.changed = Some((name.to_string(), text));
        self.fuel = Some(self.fuel.unwrap_or(FUEL_OF_CHANGED));
        self
    }

    fn granted(&self, mut builder: Builder) -> Result<Builder, Error> {
        if let Some(folder) = &self.read {
            builder = builder.grant_read(folder);
        }
        let Some(text) = &self.clock else { return Ok(builder) };
        let moment = Moment::parse(text).ok_or_else(|| {
            let message = format!("clock = '{text}' is no moment as 2026-01-31T12:00:00");
            Error::setup(Diag::new(RunCode::CaseFile, message))
        })?;
        Ok(builder.clock(Clock::Fixed(moment)))
    }
}

/// Fuel of a section whose FIL was changed to see whether a case notices.
const FUEL_OF_CHANGED: u64 = 2_000_000;

/// A path without `folder/..`, so that cases in two folders call a file that both
/// use by one name. A path that a link makes lead elsewhere stays as it is.
fn plain(path: &Path) -> PathBuf {
    let mut parts = PathBuf::new();
    for part in path.components() {
        let into_folder = matches!(parts.components().next_back(), Some(Component::Normal(_)));
        if part == Component::ParentDir && into_folder {
            parts.pop();
        } else {
            parts.push(part);
        }
    }
    let same = parts.canonicalize().ok().zip(path.canonicalize().ok());
    if same.is_some_and(|(one, other)| one == other) { parts } else { path.to_path_buf() }
}

/// A program that one thread builds while others may wait for it.
type Cell = Arc<OnceLock<Result<Program, Error>>>;

/// The programs of many cases: those with the same machine, FIL and options share
/// one, in all threads.
#[derive(Default)]
pub struct Programs {
    built: Mutex<HashMap<Recipe, Cell>>,
    debug: bool,
}

impl Programs {
    /// No program is built yet.
    pub fn new() -> Self {
        Programs::default()
    }

    /// The same, of debug builds (see [`Builder::debug`](crate::Builder::debug)).
    pub fn for_debugging() -> Self {
        Programs { debug: true, ..Programs::default() }
    }

    /// The program of a case.
    ///
    /// # Errors
    /// As [`Case::program`].
    pub fn get(&self, case: &Case) -> Result<Program, Error> {
        let recipe = Recipe { debug: self.debug, ..Recipe::of(case)? };
        // Nothing is left half done in the table, whoever panicked.
        let mut built = self.built.lock().unwrap_or_else(PoisonError::into_inner);
        let cell = Arc::clone(built.entry(recipe.clone()).or_default());
        drop(built);
        cell.get_or_init(|| recipe.build()).clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A case folder with these lines in its case.toml.
    fn case(root: &Path, name: &str, lines: &str) -> Case {
        let folder = root.join(name);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("part.ncl"), "UNITS / MM\nFINI\n").unwrap();
        let text = format!("cl = 'part.ncl'\norigin = 'made here'\n{lines}");
        std::fs::write(folder.join("case.toml"), text).unwrap();
        Case::load(&folder).unwrap()
    }

    #[test]
    fn cases_with_the_same_post_share_one_program() {
        let root = tempfile::tempdir().unwrap();
        std::fs::write(root.path().join("post.fil"), "XX=1\nFINI\n").unwrap();
        let lines = "ready = 'grbl'\nfil = ['../post.fil']\n";
        let one = case(root.path(), "one", lines);
        let two = case(root.path(), "two", lines);
        let other = case(root.path(), "other", &format!("{lines}set = ['seqno.increment=5']\n"));
        let programs = Programs::new();
        let [one, two, other] = [one, two, other].map(|case| programs.get(&case).unwrap());
        assert!(Arc::ptr_eq(&one.shared, &two.shared));
        assert!(!Arc::ptr_eq(&one.shared, &other.shared));
        assert_eq!(one.fil_files(), [root.path().join("post.fil").display().to_string()]);
    }

    #[test]
    fn a_post_that_is_wrong_is_wrong_for_each_case() {
        let root = tempfile::tempdir().unwrap();
        let programs = Programs::new();
        for name in ["one", "two"] {
            let case = case(root.path(), name, "ready = 'none'\n");
            assert_eq!(programs.get(&case).unwrap_err().diags()[0].code.name(), "E0703");
        }
    }
}
