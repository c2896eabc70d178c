//! Repairs for what is wrong.

use filpost::{is_allowable, syntax};

use crate::navigate::{Edit, Place};
use crate::script::{Finding, Script};
use crate::text::{Position, Range, word_around};

/// A repair.
#[derive(Clone, Debug, PartialEq)]
pub struct Fix {
    /// What it does.
    pub title: String,
    /// The edits.
    pub edits: Vec<Edit>,
    /// The finding it is for.
    pub finding: Finding,
    /// The one that is most likely meant.
    pub preferred: bool,
}

/// Signs of other languages, and what FIL has for them.
const SIGNS: [(&str, &str, &str); 13] = [
    ("equality is .EQ.", "==", ".EQ."),
    ("equality is .EQ.", "=", ".EQ."),
    ("inequality is .NE.", "!=", ".NE."),
    ("inequality is .NE.", "<>", ".NE."),
    ("inequality is .NE.", "/=", ".NE."),
    ("less or equal is .LE.", "<=", ".LE."),
    ("greater or equal is .GE.", ">=", ".GE."),
    ("less than is .LT.", "<", ".LT."),
    ("greater than is .GT.", ">", ".GT."),
    ("both conditions are joined by .AND.", "&&", ".AND."),
    ("one of two conditions is .OR.", "||", ".OR."),
    ("a power is **", "^", "**"),
    ("a value is set with =", ":=", "="),
];

impl Script {
    /// Repairs for what is wrong in a range of the edited file.
    pub fn fixes(&self, range: Range) -> Vec<Fix> {
        let here = |finding: &Finding| {
            finding.range.start.line <= range.end.line && finding.range.end.line >= range.start.line
        };
        let findings = self.findings().into_iter().filter(here);
        findings.flat_map(|finding| self.fixes_of(&finding)).collect()
    }

    fn fixes_of(&self, finding: &Finding) -> Vec<Fix> {
        let mut found = Vec::new();
        let mut fix = |title: String, range: Range, text: String, preferred: bool| {
            let file = self.analysis.files.get(self.file).map(|file| file.name.clone());
            let place = Place { file: file.unwrap_or_default(), range };
            let edits = vec![Edit { place, text }];
            found.push(Fix { title, edits, finding: finding.clone(), preferred });
        };
        if let Some(meant) = finding.hint.strip_prefix("did you mean ") {
            let meant = meant.split('?').next().unwrap_or_default();
            if let Some(range) = self.one_word(finding.range) {
                fix(format!("write {meant}"), range, meant.to_string(), true);
            }
        }
        if let Some((range, text)) = self.sign(finding) {
            fix(format!("write {text}"), range, text.to_string(), true);
        }
        if finding.code == <&filpost::Code>::from(syntax::SyntaxCode::MissingFini) {
            let end = self.text.whole().end;
            let line_end = if end.character == 0 { "" } else { "\n" };
            fix("add FINI".into(), Range { start: end, end }, format!("{line_end}FINI\n"), true);
        }
        if is_allowable(finding.code) {
            let start = Position { line: finding.range.start.line, character: 0 };
            let line = self.text.line(start.line as usize);
            let indent: String = line.chars().take_while(|c| *c == ' ' || *c == '\t').collect();
            let name = finding.code.name();
            let text = format!("{indent}$$ filpost: allow {name}\n");
            fix(format!("allow {name} here"), Range { start, end: start }, text, false);
        }
        found
    }

    /// The word of a finding: the range itself, or what stands around its start.
    fn one_word(&self, range: Range) -> Option<Range> {
        let byte = self.text.byte(range.start);
        let word = word_around(self.text.as_str(), byte);
        (!word.is_empty()).then(|| self.text.range(word))
    }

    /// A sign of another language at a finding whose hint knows what FIL has for it.
    fn sign(&self, finding: &Finding) -> Option<(Range, &'static str)> {
        let byte = self.text.byte(finding.range.start);
        let line = self.text.line_bytes(finding.range.start.line as usize);
        let text = self.text.as_str();
        let signs = SIGNS.iter().filter(|(hint, ..)| finding.hint.starts_with(hint));
        let mut places = signs.flat_map(|(_, sign, fil)| {
            // Understanding may end at the second character of a sign.
            let starts = [byte, byte.saturating_sub(1)];
            starts.into_iter().filter(|at| *at >= line.start).map(move |at| (at, *sign, *fil))
        });
        let (at, sign, fil) = places.find(|(at, sign, _)| {
            text.get(*at..line.end).is_some_and(|rest| rest.starts_with(sign))
        })?;
        Some((self.text.range(at..at + sign.len()), fil))
    }
}
