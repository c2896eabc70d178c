//! Files of the repository that are made or get a line.

use std::fs;
use std::path::{Path, PathBuf};

/// A checkout that is written to.
pub struct Tree {
    root: PathBuf,
    written: Vec<String>,
}

impl Tree {
    pub fn new(root: PathBuf) -> Self {
        Tree { root, written: Vec::new() }
    }

    /// The text of a file.
    ///
    /// # Errors
    /// It can't be read.
    pub fn read(&self, file: &str) -> Result<String, String> {
        fs::read_to_string(self.root.join(file)).map_err(|error| format!("{file}: {error}"))
    }

    /// True for a file or a folder that is there.
    pub fn has(&self, file: &str) -> bool {
        self.root.join(file).exists()
    }

    /// Makes a file.
    ///
    /// # Errors
    /// It is there already, or can't be written.
    pub fn create(&mut self, file: &str, text: &str) -> Result<(), String> {
        if self.has(file) {
            return Err(format!("{file} is there already"));
        }
        self.write(file, text)
    }

    fn write(&mut self, file: &str, text: &str) -> Result<(), String> {
        let path = self.root.join(file);
        let folder = path.parent().unwrap_or(Path::new(""));
        let made = fs::create_dir_all(folder).and_then(|()| fs::write(&path, text));
        made.map_err(|error| format!("{file}: {error}"))?;
        self.written.push(file.to_string());
        Ok(())
    }

    /// Changes the text of a file.
    ///
    /// # Errors
    /// The change is not possible, or the file can't be written.
    pub fn change(
        &mut self,
        file: &str,
        change: impl FnOnce(&str) -> Option<String>,
    ) -> Result<(), String> {
        let text = self.read(file)?;
        let changed = change(&text).ok_or_else(|| format!("{file} has no place for it"))?;
        self.write(file, &changed)
    }

    /// Files that were written, a line each.
    pub fn told(&self) -> String {
        self.written.iter().map(|file| format!("  {file}\n")).collect()
    }
}

/// A text with a line more: before the first line of a run that begins with `prefix` and comes later
/// in the alphabet, else behind the last of them. The run is the lines with the prefix right behind
/// one that contains `after`; without it, the first ones of the text.
pub fn with_line(text: &str, after: &str, prefix: &str, line: &str) -> Option<String> {
    let mut lines: Vec<&str> = text.lines().collect();
    let begin = match after {
        "" => 0,
        after => lines.iter().position(|found| found.contains(after))? + 1,
    };
    let first = begin + lines[begin..].iter().position(|found| found.starts_with(prefix))?;
    let run = lines[first..].iter().take_while(|found| found.starts_with(prefix)).count();
    let place = lines[first..first + run].iter().position(|found| *found > line).unwrap_or(run);
    lines.insert(first + place, line);
    Some(lines.join("\n") + "\n")
}

#[test]
fn a_line_goes_where_the_alphabet_has_it() {
    let text = "head\n- b\n- d\ntail\n- a\n";
    assert_eq!(with_line(text, "head", "- ", "- c").unwrap(), "head\n- b\n- c\n- d\ntail\n- a\n");
    assert_eq!(with_line(text, "", "- ", "- e").unwrap(), "head\n- b\n- d\n- e\ntail\n- a\n");
    assert_eq!(with_line(text, "nowhere", "- ", "- c"), None);
}
