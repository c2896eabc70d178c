//! The files of the studio's folder: listed, read, written, and none outside of it.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use cap_std::fs::{Dir, Metadata};
use filpost::{CodePage, Diag, Error, NewFile, PendingFiles, file_names, syntax};
use serde_json::{Value, json};

/// Most files that are listed.
const MOST_FILES: usize = 2000;

/// Deepest folder that is listed, counted from 0 for the studio's own.
const DEEPEST: usize = 5;

/// Longest file that is read or written, bytes.
const LONGEST: u64 = 64 << 20;

/// Longest name of a file, bytes.
const LONGEST_NAME: usize = 400;

/// Endings of new files: texts and bodies, and nothing that a system would start.
const ENDINGS: [&str; 13] =
    ["toml", "fil", "inc", "ncl", "cl", "apt", "cls", "cldata", "nc", "txt", "md", "h", MESH];

/// Ending of a body, which may be no text: its bytes are characters of the same number, U+0000 to U+00FF.
const MESH: &str = "stl";

/// The encoding of such a file.
const BYTES: &str = "bytes";

/// What a request for files is answered with: JSON, or why not in a sentence.
type Answer = Result<Value, String>;

/// The folder of the studio.
pub(crate) struct Folder {
    path: PathBuf,
    dir: Dir,
}

impl Folder {
    /// Opens a folder; makes it where it is not there.
    ///
    /// # Errors
    /// E0702 for a folder that can't be made, E0701 for one that can't be opened.
    pub fn open(path: &Path) -> Result<Folder, Error> {
        std::fs::create_dir_all(path).map_err(|error| filpost::files::cant_write(path, &error))?;
        let cant = |error| filpost::files::cant_read(path, &error);
        let path = filpost::files::plain(path.canonicalize().map_err(cant)?);
        let dir = Dir::open_ambient_dir(&path, cap_std::ambient_authority()).map_err(cant)?;
        Ok(Folder { path, dir })
    }

    /// Its name for people.
    pub fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// Answers a request for files; `None` where it is another one.
    pub fn answer(&self, request: &Value) -> Option<Value> {
        let answer = match request["do"].as_str()? {
            "files" => Ok(self.list()),
            "read" => self.read(request),
            "write" => self.write(request),
            "remove" => self.remove(request),
            _ => return None,
        };
        Some(answer.unwrap_or_else(|why| json!({ "refused": why })))
    }

    /// The files with their names from the folder on, in order.
    fn list(&self) -> Value {
        let mut found = Vec::new();
        list_below(&self.dir, "", 0, &mut found);
        let all = found.len() < MOST_FILES;
        found.sort_by(|a, b| a["name"].as_str().cmp(&b["name"].as_str()));
        json!({ "folder": self.name(), "files": found, "all": all })
    }

    fn read(&self, request: &Value) -> Answer {
        let name = named(request)?;
        let cant = |error| format!("{name} can't be read: {error}");
        let file = self.dir.open(name).map_err(cant)?;
        let metadata = file.metadata().map_err(cant)?;
        if !metadata.is_file() || metadata.len() > LONGEST {
            return Err(format!("{name} is no file of at most {} MB", LONGEST >> 20));
        }
        let bytes = self.dir.read(name).map_err(cant)?;
        if ending(name).as_deref() == Some(MESH) {
            let text: String = bytes.into_iter().map(char::from).collect();
            return Ok(json!({ "text": text, "encoding": BYTES, "stamp": stamp(&metadata) }));
        }
        if bytes.contains(&0) {
            return Err(format!("{name} is no text"));
        }
        let (text, encoding) = syntax::decode(&bytes, None).map_err(|diag| message(&diag))?;
        Ok(json!({ "text": text, "encoding": encoding, "stamp": stamp(&metadata) }))
    }

    /// Writes a file whole, in the encoding that it has. One that another program has changed
    /// since it was read is not replaced.
    fn write(&self, request: &Value) -> Answer {
        let name = named(request)?;
        let text = request["text"].as_str().ok_or("`text` is missing")?;
        let there = self.dir.symlink_metadata(name).ok();
        match &there {
            Some(metadata) if !metadata.is_file() => return Err(format!("{name} is no file")),
            None if !may_be_new(name) => {
                return Err(format!("a new file ends with one of .{}", ENDINGS.join(" .")));
            }
            _ => {}
        }
        if there.as_ref().map(stamp).as_deref() != request["stamp"].as_str() {
            return Ok(json!({ "changed": name }));
        }
        let bytes = encoded(text, request["encoding"].as_str())?;
        if bytes.len() as u64 > LONGEST {
            return Err(format!("{name} would be longer than {} MB", LONGEST >> 20));
        }
        self.make_parents(name)?;
        let written = NewFile::create_below(&self.path, Path::new(name)).and_then(|mut file| {
            let path = self.path.join(name);
            file.write_all(&bytes).map_err(|error| filpost::files::cant_write(&path, &error))?;
            let mut pending = PendingFiles::default();
            pending.add(file);
            pending.commit()
        });
        written.map_err(|error| error.diags().first().map(message).unwrap_or_default())?;
        let metadata = self.dir.symlink_metadata(name);
        Ok(json!({ "stamp": metadata.ok().as_ref().map(stamp) }))
    }

    /// Makes the folders of a file. They are this folder's own: no link leads out of it.
    fn make_parents(&self, name: &str) -> Result<(), String> {
        match Path::new(name).parent().filter(|parent| !parent.as_os_str().is_empty()) {
            Some(parent) => self
                .dir
                .create_dir_all(parent)
                .map_err(|error| format!("the folder {} can't be made: {error}", parent.display())),
            None => Ok(()),
        }
    }

    fn remove(&self, request: &Value) -> Answer {
        let name = named(request)?;
        let metadata = self.dir.symlink_metadata(name).map_err(|error| error.to_string())?;
        if !metadata.is_file() {
            return Err(format!("{name} is no file"));
        }
        if Some(stamp(&metadata).as_str()) != request["stamp"].as_str() {
            return Ok(json!({ "changed": name }));
        }
        self.dir.remove_file(name).map_err(|error| format!("{name} can't be removed: {error}"))?;
        Ok(json!({}))
    }
}

/// Lists the files of a folder and of those in it. Hidden ones, links and what is no file are left out, and
/// folders that can't be read.
fn list_below(dir: &Dir, prefix: &str, depth: usize, found: &mut Vec<Value>) {
    let Ok(entries) = dir.entries() else { return };
    for entry in entries.flatten() {
        if found.len() >= MOST_FILES {
            return;
        }
        let (Ok(file_name), Ok(kind)) = (entry.file_name().into_string(), entry.file_type()) else {
            continue;
        };
        let name = format!("{prefix}{file_name}");
        if is_name(&name).is_err() {
            continue;
        }
        if kind.is_dir() && depth < DEEPEST {
            if let Ok(inner) = entry.open_dir() {
                list_below(&inner, &format!("{name}/"), depth + 1, found);
            }
        } else if kind.is_file()
            && let Ok(metadata) = entry.metadata()
        {
            found.push(json!({ "name": name, "size": metadata.len(), "stamp": stamp(&metadata) }));
        }
    }
}

/// The name of a request, checked.
fn named(request: &Value) -> Result<&str, String> {
    let name = request["name"].as_str().ok_or("`name` is missing")?;
    is_name(name)?;
    Ok(name)
}

/// Refuses what is no plain name below the folder: the parts are divided by `/`, none is hidden, and each can
/// be a name on every system.
fn is_name(name: &str) -> Result<(), String> {
    let shown = filpost::shown(name);
    if name.is_empty() || name.len() > LONGEST_NAME {
        return Err("a file has a name of at most 400 bytes".into());
    }
    for part in name.split('/') {
        if part.is_empty() || part.starts_with('.') || part.contains('\\') {
            return Err(format!("{shown} is no name of a file in this folder"));
        }
        if let Some(fault) = file_names::fault(part) {
            return Err(format!("{shown}: {fault}"));
        }
    }
    Ok(())
}

fn may_be_new(name: &str) -> bool {
    ending(name).is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

/// The ending of a name in small letters.
fn ending(name: &str) -> Option<String> {
    let ending = Path::new(name).extension().and_then(|ending| ending.to_str());
    ending.map(str::to_ascii_lowercase)
}

/// A text in an encoding; UTF-8 where none is named.
fn encoded(text: &str, encoding: Option<&str>) -> Result<Vec<u8>, String> {
    let Some(name) = encoding.filter(|name| !name.eq_ignore_ascii_case("UTF-8")) else {
        return Ok(text.as_bytes().to_vec());
    };
    if name == BYTES {
        let bytes = text.chars().map(u8::try_from).collect::<Result<_, _>>();
        return bytes.map_err(|_| "the text has more than bytes".into());
    }
    let page = CodePage::named(name).ok_or_else(|| format!("files in {name} can't be written"))?;
    match page.encode(text) {
        Ok(bytes) => Ok(bytes.into_owned()),
        Err(letter) => Err(format!("the text has `{letter}`, which {name} lacks")),
    }
}

/// What tells whether a file is still the one that was read.
fn stamp(metadata: &Metadata) -> String {
    let changed = metadata.modified().ok().map(cap_std::time::SystemTime::into_std);
    let since = changed.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    format!("{}-{}", metadata.len(), since.map_or(0, |since| since.as_nanos()))
}

fn message(diag: &Diag) -> String {
    format!("{}: {}", diag.code.name(), diag.message)
}
