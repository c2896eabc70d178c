//! Choosing the post of a CL file from its `MACHIN/name,n`.

use std::fs::File;
use std::path::{Path, PathBuf};

use fil_cl::{Record, Vocabulary, Word, reader, record::kind, words as w};

use crate::error::Error;
use crate::ready;

/// Records looked at for MACHIN.
const LOOK: usize = 200;

/// The post a CL file asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Choice {
    /// A ready post.
    Ready(&'static str),
    /// An option file, and its FIL file where there is one.
    OptionFile {
        /// `name.pNN`
        option_file: PathBuf,
        /// `name.fNN`
        fil: Option<PathBuf>,
    },
}

/// The post `MACHIN/name,n` asks for: a ready post of that name; `name.pNN` (and
/// `name.fNN`) beside the CL file or in one of `folders`; else the generic
/// lathe for UNCL…, the generic mill for all others.
///
/// # Errors
/// A CL file that can't be read as far as MACHIN.
pub fn choose(cl: &Path, folders: &[PathBuf]) -> Result<Choice, Error> {
    let Some((name, number)) = machin(cl)? else {
        return Ok(Choice::Ready(ready::GENERIC_MILL));
    };
    if let Some(post) = ready::find(&name) {
        return Ok(Choice::Ready(post.name));
    }
    let beside = cl.parent().map(Path::to_path_buf).unwrap_or_default();
    for folder in std::iter::once(&beside).chain(folders) {
        if let Some(option_file) = find_file(folder, &name, 'p', number) {
            let fil = find_file(folder, &name, 'f', number);
            return Ok(Choice::OptionFile { option_file, fil });
        }
    }
    let lathe = name.to_ascii_uppercase().starts_with("UNCL");
    Ok(Choice::Ready(if lathe { ready::GENERIC_LATHE } else { ready::GENERIC_MILL }))
}

/// Name and number of the first MACHIN among the first records.
fn machin(cl: &Path) -> Result<Option<(String, u32)>, Error> {
    let input = File::open(cl).map_err(|error| {
        let message = format!("{}: {error}", cl.display());
        Error::setup(fil_diag::Diag::new(crate::RunCode::CantRead, message))
    })?;
    let name = cl.display().to_string();
    let mut reader = reader::Reader::new(input, &name, reader::Options::default());
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    for _ in 0..LOOK {
        let more = reader.read(&mut vocabulary, &mut record).map_err(Error::Run)?;
        if !more {
            break;
        }
        if record.kind == kind::POST && record.major == w::MACHIN {
            let text = match record.data.first() {
                Some(Word::Minor(word)) => vocabulary.name(*word).to_string(),
                Some(word @ Word::Text { .. }) => record.text_of(*word).trim().to_string(),
                _ => return Ok(None),
            };
            let number = match record.data.get(1) {
                Some(Word::Number(number)) if (0.0..100.0).contains(number) => *number as u32,
                _ => 1,
            };
            return Ok(Some((text, number)));
        }
    }
    Ok(None)
}

/// `name.pNN` in a folder, letters in any case.
fn find_file(folder: &Path, name: &str, ending: char, number: u32) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let wanted = format!("{name}.{ending}{number:02}");
    let mut found: Vec<PathBuf> = std::fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            path.file_name()
                .and_then(|file| file.to_str())
                .is_some_and(|file| file.eq_ignore_ascii_case(&wanted))
        })
        .collect();
    found.sort();
    found.into_iter().next()
}
