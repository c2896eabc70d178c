//! Checking FIL files without a CL file.

use fil_cl::{Vocabulary, WordId};
use fil_diag::{Diag, Levels};
use fil_machine::Letter;
use fil_machine::address::Addresses;
use fil_machine::commons::{Commons, LAST_OUTPUT};
use fil_machine::locations::{INPUT_CREO_RECORDS, Location};
use fil_machine::stored;
use fil_vm::{Analysis, CommonKind, Compat, Edits, FilFile, LoadOptions, MachineFacts};

use crate::editing::edits;
use crate::outside::common_kind;

/// Gives a file by the name INCLUD has, or why it cannot.
pub type Includes<'a> = fil_vm::Loader<'a>;

/// Letters of the alphabet, and of each set of tape positions.
const LETTERS: u32 = 26;

/// The last of the four tables of tape positions, INTCOM 1 to 211.
const ADDRESS_TABLES: u32 = 211;

/// How FIL files are checked.
#[derive(Default)]
pub struct Options<'a> {
    /// Corrected readings of POSTF numbers and sections.
    pub compat: Compat,
    /// Refuse extensions of filpost.
    pub strict: bool,
    /// Levels of findings in all files.
    pub levels: Levels,
    /// Gives the files that INCLUD names; without it INCLUD is refused.
    pub includes: Option<Includes<'a>>,
    /// The machine; without it what depends on one is not looked at.
    pub machine: Option<&'a Commons>,
}

/// Everything a run would refuse or warn of when it loads these files, and
/// what would run but is most likely not meant, by file and line. The files
/// share one name space; each is a name for messages and a text.
pub fn check(files: &[(&str, &str)], options: Options<'_>) -> Vec<Diag> {
    analyze(files, options).diags
}

/// As [`check`], and with the names of all files, for an editor.
pub fn analyze(files: &[(&str, &str)], options: Options<'_>) -> Analysis {
    let files: Vec<FilFile<'_>> = files.iter().map(|(name, text)| FilFile { name, text }).collect();
    let addresses = options.machine.map(|commons| Addresses::from_commons(commons, true));
    let writes = |letter: u8| {
        let letter = Letter::numbered(letter.into());
        let position =
            addresses.as_ref().zip(letter).and_then(|(all, letter)| all.position(letter));
        position.is_some()
    };
    let facts = MachineFacts {
        name_of_common: Some(&name_of_common),
        storing: options.machine.map(|_| &storing as fil_vm::StoringInCommon<'_>),
        writes_letter: options.machine.map(|_| &writes as &dyn Fn(u8) -> bool),
        takes_creo_records: options.machine.is_some_and(|commons| commons.read(INPUT_CREO_RECORDS)),
        edits: options.machine.map_or(ALL_EDITS, edits),
        carries_out: Some(&carries_out),
    };
    let mut includes = options.includes;
    let load = LoadOptions {
        compat: options.compat,
        strict: options.strict,
        lint: true,
        levels: options.levels,
        facts,
        loader: includes.as_mut().map(|loader| loader as Includes<'_>),
        ..LoadOptions::default()
    };
    fil_vm::analyze(&files, &mut Vocabulary::new(), load)
}

/// Without a machine nothing tells which macros the post calls.
const ALL_EDITS: Edits = Edits { words: true, tape: true, listing: true, reposition: true };

/// True for a word that a file of the post carries out.
fn carries_out(word: WordId) -> bool {
    fil_post::dispatch::HANDLERS.iter().any(|(known, _)| *known == word)
}

/// What is wrong with storing a value, as a run would say it.
fn storing(kind: CommonKind, number: u32, value: Option<f64>) -> Option<Diag> {
    let kind = common_kind(kind);
    if let Some(Err(diag)) = value.map(|value| stored::check_in_run(kind, number, value)) {
        return Some(*diag);
    }
    (!stored::acts(kind, number)).then(|| stored::without_effect(&[(kind, number)]))
}

/// The name of a common location: that of its setting, or its use in a table
/// of all letters.
pub fn name_of_common(kind: CommonKind, number: u32) -> Option<String> {
    if let Some(row) = Location::numbered(common_kind(kind), number) {
        return Some(row.name.to_string());
    }
    let last_output = LAST_OUTPUT as u32;
    match kind {
        CommonKind::Int if (1..=ADDRESS_TABLES).contains(&number) => {
            Some("part of the address table".to_string())
        }
        CommonKind::Dbl if (last_output + 1..=last_output + LETTERS).contains(&number) => {
            let letter = char::from(b'A' + (number - last_output - 1) as u8);
            Some(format!("the last output value of {letter}"))
        }
        _ => None,
    }
}
