//! What the symbols tell once the vocabulary holds all words of the scripts: words
//! read as values, macros and sections that never run.

use fil_cl::Vocabulary;
use fil_cl::layout::takes_text;
use fil_cl::record::{CIRCLE_SURFACE, CUTTER_SUB, kind, mode, motion};
use fil_cl::vocabulary::words as w;
use fil_diag::{Code, Diag};
use fil_syntax::tree::{Item, SectionKey};

use super::{FileSpan, Resolution, Role, Symbol, SymbolKind};
use crate::builtins;
use crate::compile::files::Unit;
use crate::compile::sections::ALL;
use crate::errors::{CompileCode, LintCode};
use crate::lint::MachineFacts;
use crate::output::{Edits, OutputMacro};

/// Words that CL files have only behind `$$->`, which sections see where the machine says so.
const PSEUDO_WORDS: [&str; 3] = ["MFGNO", "FEATNO", "CUTCOM_GEOMETRY_TYPE"];

/// Types of records that the reader makes, with their subtypes; that of a post command
/// is the code of its major word.
const TYPES: [(u32, &[u32]); 6] = [
    (kind::POST, &[]),
    (kind::SURFACE, &[CIRCLE_SURFACE]),
    (kind::MOTION, &[motion::FROM, motion::GODLTA, motion::GOTO]),
    (kind::CUTTER, &[CUTTER_SUB]),
    (kind::MODE, &[mode::TLAXIS, mode::MULTAX]),
    (kind::FINI, &[0]),
];

/// The findings of every load.
pub(crate) fn find(
    resolution: &Resolution,
    units: &[Unit],
    vocabulary: &Vocabulary,
    facts: MachineFacts<'_>,
) -> Vec<Diag> {
    let (takes_creo, edits) = (facts.takes_creo_records, facts.edits);
    let mut findings = Findings { units, vocabulary, takes_creo, edits, diags: Vec::new() };
    for symbol in &resolution.symbols {
        match symbol.kind {
            SymbolKind::Variable if symbol.definitions.is_empty() => findings.word_as_value(symbol),
            SymbolKind::Macro => findings.reserved_macro(symbol),
            SymbolKind::Word => findings.misspelt(symbol),
            _ => {}
        }
    }
    for (file, unit) in units.iter().enumerate() {
        for item in &unit.program.items {
            if let Item::Section(section) = item {
                findings.section(file, &section.key);
            }
        }
    }
    findings.diags
}

struct Findings<'a> {
    units: &'a [Unit],
    vocabulary: &'a Vocabulary,
    takes_creo: bool,
    edits: Edits,
    diags: Vec<Diag>,
}

impl Findings<'_> {
    fn add(&mut self, code: impl Into<&'static Code>, at: FileSpan, message: String) -> &mut Diag {
        let place = self.units[at.file].file.place(at.span);
        self.diags.push(Diag::new(code, message).at(place));
        self.diags.last_mut().expect("it was just pushed")
    }

    /// A word of the vocabulary that is read as a variable is EMPTY, and so is any name
    /// in a WHEN that nothing sets: both are meant as words.
    fn word_as_value(&mut self, symbol: &Symbol) {
        let name = &symbol.name;
        let is_function = builtins::find(name).is_some();
        let word = self.vocabulary.find(name);
        let is_word = is_function || word.is_some_and(|word| self.vocabulary.is_of_posts(word));
        for used in &symbol.uses {
            let is_truth = matches!(name.as_str(), "TRUE" | "FALSE") && used.role == Role::Read;
            if used.role == Role::When
                || is_truth
                || (is_word && matches!(used.role, Role::Read | Role::Operand | Role::Argument))
            {
                let what = if is_function { "a result of the function" } else { "the word" };
                let message = format!("nothing sets {name}, so its value is EMPTY and not {what}");
                let diag = self.add(CompileCode::WordAsValue, used.location, message);
                diag.hint = Some(match name.as_str() {
                    "OTHERS" | "ELSE" | "DEFAULT" => {
                        "the part for all that is left is WHEN/OTHER".into()
                    }
                    "TRUE" => "true is 1, and IF(NN.EQ.1)THEN asks for it".into(),
                    "FALSE" => "false is 0, and IF(NN.EQ.0)THEN asks for it".into(),
                    _ if is_function => format!("a function is called with brackets: {name}(…)"),
                    _ => format!("ICODEF({name}) is the code of the word"),
                });
            }
        }
    }

    fn reserved_macro(&mut self, symbol: &Symbol) {
        let Some(at) = symbol.definitions.first() else { return };
        let hint = match OutputMacro::named(&symbol.name) {
            Some(edits) if self.edits.has(edits) => return,
            Some(edits) => Some(format!("{} in machine.toml has it called", edits.setting())),
            None => return,
        };
        let message = format!("the post does not call {}", symbol.name);
        self.add(CompileCode::ReservedMacro, *at, message).hint = hint;
    }

    /// A word that is near a known one where it decides what runs: in the key of a
    /// section, or where a function asks for it. Far from all it is one of the user.
    fn misspelt(&mut self, symbol: &Symbol) {
        let word = self.vocabulary.find(&symbol.name);
        let Some(hint) = word.and_then(|word| self.vocabulary.perhaps_meant(word)) else { return };
        let mut asked = false;
        for used in &symbol.uses {
            let code = match used.role {
                Role::Key | Role::MinorKey => LintCode::MisspeltWord,
                Role::Asked if !std::mem::replace(&mut asked, true) => LintCode::UnknownWord,
                _ => continue,
            };
            let message = format!("{} is in no vocabulary", symbol.name);
            self.add(code, used.location, message).hint = Some(hint.clone());
        }
    }

    fn has_subtype(&self, kind: u32, subs: &[u32], sub: u32) -> bool {
        match kind {
            kind::POST => self.vocabulary.minor_with_code(f64::from(sub)).is_some(),
            _ => subs.contains(&sub),
        }
    }

    fn section(&mut self, file: usize, key: &SectionKey) {
        match key {
            SectionKey::Types { kind, sub, span } => {
                let at = FileSpan { file, span: *span };
                let subs = TYPES.iter().find(|(known, _)| known == kind).map(|(_, subs)| *subs);
                match (subs, sub) {
                    (None, _) => {
                        let message = format!("no record has the type {kind}");
                        self.add(CompileCode::NeverMatches, at, message);
                    }
                    (Some(subs), Some(sub)) if !self.has_subtype(*kind, subs, *sub) => {
                        let message = format!("no record of the type {kind} has the subtype {sub}");
                        self.add(CompileCode::NeverMatches, at, message);
                    }
                    _ => {}
                }
            }
            SectionKey::Words { major, minors } => {
                let at = FileSpan { file, span: major.span };
                let word = self.vocabulary.find(&major.text);
                if major.text == ALL && !minors.is_empty() {
                    let message = "CIMFIL/ON,ALL takes no minor words".to_string();
                    self.add(CompileCode::NeverMatches, at, message).hint =
                        Some("write CIMFIL/ON,ALL, and test the record with HASF(word)".into());
                } else if PSEUDO_WORDS.contains(&major.text.as_str()) && !self.takes_creo {
                    let message = format!("CL files have {} behind $$-> only", major.text);
                    self.add(LintCode::SectionNeverRuns, at, message).hint =
                        Some("sections see it there where input.creo_records = 1".into());
                } else if let (Some(minor), Some(word)) = (minors.first(), word)
                    && (takes_text(word)
                        || matches!(word, w::GOTO | w::FROM | w::GODLTA | w::CIRCLE))
                {
                    let at = FileSpan { file, span: minor.span };
                    let message = format!("no word follows {} in a record", major.text);
                    self.add(CompileCode::NeverMatches, at, message);
                }
            }
        }
    }
}
