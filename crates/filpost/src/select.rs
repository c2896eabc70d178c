//! Choosing the post of a CL file from its `MACHIN/name,n`.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use fil_cl::{Record, Vocabulary, Word, reader, record::kind, words as w};

use crate::error::Error;
use crate::files;
use crate::ready;

/// Records looked at for MACHIN.
const LOOK: usize = 200;

/// The post a CL file asks for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
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

/// What a CL file says in `MACHIN/name,n`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Machin {
    /// The name.
    pub name: String,
    /// The number; 1 when there is none.
    pub number: u32,
}

/// The post a CL file asks for; see [`for_machin`].
///
/// # Errors
/// A CL file that can't be read as far as MACHIN.
pub fn choose(cl: &Path, folders: &[PathBuf]) -> Result<Choice, Error> {
    let input = File::open(cl).map_err(|error| files::cant_read(cl, &error))?;
    let machin = machin(input, &cl.display().to_string(), reader::Options::default())?;
    let beside = cl.parent().map(Path::to_path_buf).unwrap_or_default();
    let folders: Vec<PathBuf> = std::iter::once(beside).chain(folders.iter().cloned()).collect();
    Ok(for_machin(machin.as_ref(), &folders))
}

/// The post that MACHIN asks for: a ready post of that name; `name.pNN` (and
/// `name.fNN`) in one of `folders`; else the generic lathe for UNCL…, the
/// generic mill for all others.
pub fn for_machin(machin: Option<&Machin>, folders: &[PathBuf]) -> Choice {
    let Some(Machin { name, number }) = machin else {
        return Choice::Ready(ready::GENERIC_MILL);
    };
    if let Some(post) = ready::find(name) {
        return Choice::Ready(post.name);
    }
    for folder in folders {
        if let Some(option_file) = find_file(folder, name, 'p', *number) {
            let fil = find_file(folder, name, 'f', *number);
            return Choice::OptionFile { option_file, fil };
        }
    }
    let lathe = name.to_ascii_uppercase().starts_with("UNCL");
    Choice::Ready(if lathe { ready::GENERIC_LATHE } else { ready::GENERIC_MILL })
}

/// The first MACHIN among the first records; `name` is what messages show, `options` say
/// how the text is read.
///
/// # Errors
/// A CL text that can't be read as far as MACHIN.
pub fn machin(
    input: impl Read,
    name: &str,
    options: reader::Options,
) -> Result<Option<Machin>, Error> {
    let mut reader = reader::Reader::new(input, name, options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    for _ in 0..LOOK {
        let more = reader.read(&mut vocabulary, &mut record).map_err(Error::Run)?;
        if !more {
            break;
        }
        if record.kind == kind::POST && record.major == w::MACHIN {
            let name = match record.data.first() {
                Some(Word::Minor(word)) => vocabulary.name(*word).to_string(),
                Some(word @ Word::Text { .. }) => record.text_of(*word).trim().to_string(),
                _ => return Ok(None),
            };
            let number = match record.data.get(1) {
                Some(Word::Number(number)) if (0.0..100.0).contains(number) => *number as u32,
                _ => 1,
            };
            return Ok(Some(Machin { name, number }));
        }
    }
    Ok(None)
}

/// `name.fNN` beside an option file `name.pNN`.
pub fn fil_beside(option_file: &Path) -> Option<PathBuf> {
    let name = option_file.file_stem()?.to_str()?;
    let ending = option_file.extension()?.to_str()?;
    let number = ending.strip_prefix(['p', 'P'])?.parse().ok()?;
    find_file(option_file.parent()?, name, 'f', number)
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
