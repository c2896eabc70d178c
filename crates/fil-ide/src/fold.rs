//! What can be folded: sections, macros, blocks, runs of comments.

use crate::context::{before, code};
use crate::script::Script;

/// Lines that can be folded, 0-based, the first one stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fold {
    /// The line that stays.
    pub first: u32,
    /// The last line that goes.
    pub last: u32,
    /// Lines of comments.
    pub comment: bool,
}

/// What opens a block, until what closes it.
#[derive(Clone, Copy, PartialEq)]
enum Open {
    Section,
    Macro,
    If,
    Case,
}

impl Script {
    /// All that can be folded, by its first line.
    pub fn folds(&self) -> Vec<Fold> {
        let mut found = Vec::new();
        let mut open: Vec<(Open, u32)> = Vec::new();
        let mut comments: Option<u32> = None;
        for line in 0..self.text.line_count() {
            let number = line as u32;
            let whole = self.text.line(line);
            let is_comment = whole.trim_start().starts_with("$$");
            match (is_comment, comments) {
                (true, None) => comments = Some(number),
                (false, Some(first)) => {
                    push(&mut found, first, number.saturating_sub(1), true);
                    comments = None;
                }
                _ => {}
            }
            if code(whole).0.trim().is_empty() {
                continue;
            }
            let end = self.text.line_bytes(line).end;
            let plain = before(&self.text, end);
            let raw = code(whole).0.trim().to_ascii_uppercase().replace([' ', '\t'], "");
            let words = plain.statement.trim().replace([' ', '\t'], "");
            let closes = match words.as_str() {
                "CIMFIL/OFF" | "SIMFIL/OFF" => Some(Open::Section),
                "TERMAC" => Some(Open::Macro),
                "ENDIF" => Some(Open::If),
                "ENDCAS" => Some(Open::Case),
                _ => None,
            };
            if let Some(closes) = closes {
                if let Some(at) = open.iter().rposition(|(kind, _)| *kind == closes) {
                    let (_, first) = open[at];
                    open.truncate(at);
                    push(&mut found, first, number, false);
                }
            } else if words.starts_with("CIMFIL/ON") || words.starts_with("SIMFIL/ON") {
                open.push((Open::Section, number));
            } else if words.contains("=MACRO") {
                open.push((Open::Macro, number));
            } else if raw.ends_with(")THEN") && raw.contains("IF(") && !raw.starts_with("ELSEIF") {
                open.push((Open::If, number));
            } else if words.starts_with("CASE/") {
                open.push((Open::Case, number));
            }
        }
        if let Some(first) = comments {
            push(&mut found, first, self.text.line_count() as u32 - 1, true);
        }
        found.sort_by_key(|fold| (fold.first, fold.last));
        found
    }
}

fn push(found: &mut Vec<Fold>, first: u32, last: u32, comment: bool) {
    if last > first {
        found.push(Fold { first, last, comment });
    }
}
