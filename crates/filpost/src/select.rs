//! Choosing the post of a CL file: the one its `MACHIN/name,n` names, else a
//! generic one.

use std::io::Read;
use std::path::{Path, PathBuf};

use fil_cl::{Record, Vocabulary, Word, reader, record::kind, words as w};
use fil_diag::{Diag, TextSpan};

use crate::error::{Error, RunCode};
use crate::ready;
use crate::statement::statement_text;

/// Records looked at for MACHIN, and at least those before the first motion.
const LOOK: u32 = 200;

/// Records looked at where there is no motion.
const LOOK_WITHOUT_MOTION: u32 = 100_000;

/// The post of a CL file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Choice {
    /// A ready post that MACHIN names.
    Ready(&'static str),
    /// The option file `name.pNN` that MACHIN names; [`fil_beside`] gives its FIL file.
    #[non_exhaustive]
    OptionFile {
        /// The file.
        option_file: PathBuf,
    },
    /// A generic post, for a CL file without MACHIN.
    #[non_exhaustive]
    Generic {
        /// The ready post.
        name: &'static str,
        /// The word that says that the file is for a lathe.
        turning: Option<String>,
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

/// What the first records of a CL file say about its machine.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Asked {
    /// The first MACHIN.
    pub machin: Option<Machin>,
    /// The first word that only a lathe has.
    pub turning: Option<String>,
    /// Where MACHIN stands.
    place: Option<TextSpan>,
}

impl std::fmt::Display for Machin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "MACHIN/{},{}", self.name, self.number)
    }
}

/// The folder of a CL file, then the others.
pub fn beside_first(cl: &Path, folders: &[PathBuf]) -> Vec<PathBuf> {
    let beside = cl.parent().map(Path::to_path_buf).unwrap_or_default();
    std::iter::once(beside).chain(folders.iter().cloned()).collect()
}

/// The post of a CL file that asks for this: a ready post of the name in MACHIN;
/// `name.pNN` with `name.fNN` in one of `folders`. Without MACHIN it is the generic
/// lathe where a word says turning, else the generic mill.
///
/// # Errors
/// E0714 for a MACHIN that names no post, with the names that were looked for.
pub fn choose(asked: &Asked, folders: &[PathBuf]) -> Result<Choice, Error> {
    let Some(machin) = &asked.machin else {
        let turning = asked.turning.clone();
        let name = if turning.is_some() { ready::GENERIC_LATHE } else { ready::GENERIC_MILL };
        return Ok(Choice::Generic { name, turning });
    };
    if let Some(post) = ready::find(&machin.name) {
        return Ok(Choice::Ready(post.name));
    }
    for folder in folders {
        if let Some(option_file) = find_file(folder, &machin.name, 'p', machin.number) {
            return Ok(Choice::OptionFile { option_file });
        }
    }
    Err(Error::Run(no_post(machin, asked.place.clone(), folders)))
}

/// E0714 with all that was looked for.
fn no_post(machin: &Machin, place: Option<TextSpan>, folders: &[PathBuf]) -> Box<Diag> {
    let file = file_name(&machin.name, 'p', machin.number);
    let folders: Vec<String> = folders
        .iter()
        .map(|folder| match folder.as_os_str().is_empty() {
            true => "the current folder".into(),
            false => folder.display().to_string(),
        })
        .collect();
    let names: Vec<&str> = ready::READY.iter().map(|post| post.name).collect();
    let mut diag = Diag::new(RunCode::NoPost, format!("there is no post for {machin}"))
        .note(format!("looked for the option file {file} in {}", folders.join(", ")))
        .note(format!("looked for {} among the ready posts {}", machin.name, names.join(", ")));
    diag.spans.extend(place);
    Box::new(diag)
}

/// Refuses a CL file with another MACHIN than the one its post was chosen for: one that
/// comes late in the file, or a second machine. `machines` are those of
/// [`Report::machines`](crate::Report::machines) or of [`machines`].
///
/// # Errors
/// E0714
pub fn confirm(
    chosen_for: Option<&Machin>,
    machines: &[(Machin, u32)],
    cl_name: &str,
) -> Result<(), Error> {
    let other = machines.iter().find(|(machin, _)| Some(machin) != chosen_for);
    let Some((machin, line)) = other else { return Ok(()) };
    let was = match chosen_for {
        Some(first) => format!("the post was chosen for {first}"),
        None => "a generic post was chosen: no MACHIN before the moves".to_string(),
    };
    let diag = RunCode::NoPost.diag(format!("{machin} comes too late; {was}"));
    Err(Error::Run(Box::new(diag.at(TextSpan::line(cl_name, *line, machin.to_string())))))
}

/// What the first records of a CL text say; `name` is what messages show, `options` say
/// how the text is read.
///
/// # Errors
/// A CL text that can't be read so far; E0714 for a MACHIN without a name, or with
/// a number that no machine has.
pub fn asked(
    input: impl Read + Send,
    name: &str,
    options: reader::Options,
) -> Result<Asked, Error> {
    let options = reader::Options { raw: false, ..options };
    asked_of(reader::Reader::new(input, name, options), name)
}

fn asked_of(mut reader: reader::Reader<'_>, name: &str) -> Result<Asked, Error> {
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    let mut asked = Asked::default();
    let mut most = LOOK_WITHOUT_MOTION;
    while asked.machin.is_none() && reader.record_number() < most {
        match reader.read(&mut vocabulary, &mut record) {
            Ok(true) => {}
            Ok(false) => break,
            // What is wrong with a statement is said by the run, with all else.
            Err(diag) if !reader.resume() => return Err(Error::Run(diag)),
            Err(_) => continue,
        }
        if record.kind == kind::MOTION {
            most = LOOK;
        }
        if record.kind == kind::POST && record.major == w::MACHIN {
            let place = TextSpan::line(name, record.line, statement_text(&record, &vocabulary));
            asked.machin = Some(machin(&record, &vocabulary).map_err(|message| {
                Error::Run(Box::new(Diag::new(RunCode::NoPost, message).at(place.clone())))
            })?);
            asked.place = Some(place);
        }
        if asked.turning.is_none() {
            asked.turning = turning(&record, &vocabulary);
        }
    }
    Ok(asked)
}

/// The machines that the MACHIN records of a whole CL text name, each once, with the
/// line.
///
/// # Errors
/// A CL text that can't be read.
pub fn machines(
    input: impl Read + Send,
    name: &str,
    options: reader::Options,
) -> Result<Vec<(Machin, u32)>, Error> {
    let options = reader::Options { raw: false, ..options };
    machines_of(reader::Reader::new(input, name, options))
}

fn machines_of(mut reader: reader::Reader<'_>) -> Result<Vec<(Machin, u32)>, Error> {
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    let mut machines = Vec::new();
    while record.kind != kind::FINI
        && reader.read(&mut vocabulary, &mut record).map_err(Error::Run)?
    {
        note(&mut machines, &record, &vocabulary);
    }
    Ok(machines)
}

/// Adds the machine of a MACHIN record, unless it is known.
pub(crate) fn note(machines: &mut Vec<(Machin, u32)>, record: &Record, vocabulary: &Vocabulary) {
    if record.kind != kind::POST || record.major != w::MACHIN {
        return;
    }
    let Ok(machin) = machin(record, vocabulary) else { return };
    if machines.iter().all(|(known, _)| *known != machin) {
        machines.push((machin, record.line));
    }
}

/// The name and number of a MACHIN record; the text is what is wrong with them.
fn machin(record: &Record, vocabulary: &Vocabulary) -> Result<Machin, String> {
    let name = match record.data.first() {
        Some(Word::Minor(word)) => vocabulary.name(*word).to_string(),
        Some(word @ Word::Text { .. }) => record.text_of(*word).trim().to_string(),
        _ => String::new(),
    };
    if name.is_empty() {
        return Err("MACHIN names no machine".into());
    }
    let number = match record.data.get(1) {
        None | Some(Word::Empty) => 1,
        Some(Word::Number(number)) if (0.0..100.0).contains(number) && number.fract() == 0.0 => {
            *number as u32
        }
        _ => return Err("the number of a machine is a whole one, at most 99".into()),
    };
    Ok(Machin { name, number })
}

/// The word that says that a record is for a lathe.
fn turning(record: &Record, vocabulary: &Vocabulary) -> Option<String> {
    let major = vocabulary.name(record.major);
    if record.kind != kind::POST {
        return None;
    }
    let minor = record.data.iter().find_map(|word| match word {
        Word::Minor(word) if *word == w::TURN => Some(vocabulary.name(*word)),
        _ => None,
    });
    match (major, minor) {
        ("TURRET" | "THREAD", _) => Some(major.to_string()),
        (_, Some(minor)) => Some(format!("{major}/{minor}")),
        _ => None,
    }
}

/// `name.fNN` beside an option file `name.pNN`.
pub fn fil_beside(option_file: &Path) -> Option<PathBuf> {
    let name = option_file.file_stem()?.to_str()?;
    let ending = option_file.extension()?.to_str()?;
    let number = ending.strip_prefix(['p', 'P'])?.parse().ok()?;
    find_file(option_file.parent()?, name, 'f', number)
}

fn file_name(name: &str, ending: char, number: u32) -> String {
    format!("{name}.{ending}{number:02}")
}

/// `name.pNN` in a folder, letters in any case.
fn find_file(folder: &Path, name: &str, ending: char, number: u32) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let wanted = file_name(name, ending, number);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The choice for a CL text without any folder.
    fn choice(cl: &str) -> Result<Choice, Error> {
        choose(&asked(cl.as_bytes(), "part.ncl", reader::Options::default())?, &[])
    }

    /// The generic post of a CL text, and what says turning.
    fn generic(cl: &str) -> (&'static str, Option<String>) {
        match choice(cl).unwrap() {
            Choice::Generic { name, turning } => (name, turning),
            other => panic!("{other:?}"),
        }
    }

    fn refused(cl: &str) -> String {
        let error = choice(cl).unwrap_err();
        assert_eq!(error.diags()[0].code.name(), "E0714");
        let notes = error.diags()[0].notes.join("\n");
        format!("{error}\n{notes}")
    }

    #[test]
    fn machin_names_a_post_or_the_file_is_refused() {
        assert_eq!(choice("MACHIN / GRBL, 1\nFINI\n").unwrap(), Choice::Ready("grbl"));
        let said = refused("PARTNO / A\nMACHIN / UNCX01, 7\nFINI\n");
        assert!(said.contains("part.ncl:2:1: there is no post for MACHIN/UNCX01,7"), "{said}");
        assert!(said.contains("UNCX01.p07 in ") && said.contains("fanuc-mill"), "{said}");
        assert!(refused("MACHIN / 5\nFINI\n").contains("names no machine"));
        assert!(refused("MACHIN / UNCX01, 100\nFINI\n").contains("at most 99"));
        assert!(refused("MACHIN / UNCX01, 1.5\nFINI\n").contains("at most 99"));
    }

    #[test]
    fn a_file_without_machin_takes_a_generic_post() {
        assert_eq!(generic("UNITS / MM\nGOTO / 1, 2, 3\nFINI\n"), ("fanuc-mill", None));
        for (cl, word) in [
            ("TURRET / 1\n", "TURRET"),
            ("GOTO / 0, 0, 0\nTHREAD / AUTO, 1\n", "THREAD"),
            ("MODE / TURN\n", "MODE/TURN"),
        ] {
            assert_eq!(generic(cl), ("fanuc-lathe", Some(word.into())), "{cl}");
        }
    }

    #[test]
    fn machin_is_found_behind_a_long_head() {
        let head = "PPRINT / A LINE\n".repeat(5000);
        let cl = format!("{head}MACHIN / GRBL, 1\nGOTO / 0, 0, 0\n");
        assert_eq!(choice(&cl).unwrap(), Choice::Ready("grbl"));
    }
}
