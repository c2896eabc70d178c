//! Semantic tokens: what each word of a script is.

use std::collections::HashMap;

use filpost::resolve::SymbolKind;

use crate::script::Script;
use crate::text::Range;

/// The types of tokens, in the order of [`Token::kind`]; names of the protocol.
pub const TOKEN_TYPES: [&str; 9] = [
    "comment",
    "string",
    "number",
    "keyword",
    "function",
    "macro",
    "variable",
    "parameter",
    "enumMember",
];

const COMMENT: usize = 0;
const STRING: usize = 1;
const NUMBER: usize = 2;
const KEYWORD: usize = 3;

/// A token on one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// Where.
    pub range: Range,
    /// Index in [`TOKEN_TYPES`].
    pub kind: usize,
}

impl Script {
    /// The tokens of the edited file in their order.
    pub fn tokens(&self) -> Vec<Token> {
        let names = self.kinds();
        let mut found = Vec::new();
        for line in 0..self.text.line_count() {
            let bytes = self.text.line_bytes(line);
            for (from, to, kind) in scan(self.text.line(line)) {
                let (from, to) = (bytes.start + from, bytes.start + to);
                let word = &self.text.as_str()[from..to];
                let kind = match kind {
                    Some(kind) => Some(kind),
                    None => names
                        .get(&(from as u32))
                        .copied()
                        .or_else(|| filpost::syntax::is_statement_word(word).then_some(KEYWORD)),
                };
                if let Some(kind) = kind {
                    found.push(Token { range: self.text.range(from..to), kind });
                }
            }
        }
        found
    }

    /// Where names of a kind begin in the edited file.
    fn kinds(&self) -> HashMap<u32, usize> {
        let mut found = HashMap::new();
        for symbol in &self.analysis.resolution.symbols {
            let kind = match symbol.kind {
                SymbolKind::Function | SymbolKind::HostFunction | SymbolKind::Postf => 4,
                SymbolKind::Macro => 5,
                SymbolKind::Variable
                | SymbolKind::Letter
                | SymbolKind::Array
                | SymbolKind::Table => 6,
                SymbolKind::Parameter => 7,
                SymbolKind::Word => 8,
                SymbolKind::Label | SymbolKind::Section | SymbolKind::Unknown => continue,
            };
            for span in self.spans(symbol) {
                found.insert(span.start, kind);
            }
        }
        found
    }
}

/// Comments, texts, numbers and, without a kind, words of a line.
fn scan(line: &str) -> Vec<(usize, usize, Option<usize>)> {
    let bytes = line.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let from = at;
        match bytes[at] {
            b'$' if bytes.get(at + 1) == Some(&b'$') => {
                found.push((from, bytes.len(), Some(COMMENT)));
                return found;
            }
            b'\'' => {
                at += 1;
                while at < bytes.len() && bytes[at] != b'\'' {
                    at += 1;
                }
                at = (at + 1).min(bytes.len());
                found.push((from, at, Some(STRING)));
            }
            b'0'..=b'9' => {
                while at < bytes.len() && bytes[at].is_ascii_digit() {
                    at += 1;
                }
                // 5.EQ.6 is no number with a point.
                let point = bytes.get(at) == Some(&b'.');
                if point && !bytes.get(at + 1).is_some_and(u8::is_ascii_alphabetic) {
                    at += 1;
                    while at < bytes.len() && bytes[at].is_ascii_digit() {
                        at += 1;
                    }
                }
                found.push((from, at, Some(NUMBER)));
            }
            byte if byte.is_ascii_alphabetic() => {
                while at < bytes.len() && bytes[at].is_ascii_alphanumeric() {
                    at += 1;
                }
                found.push((from, at, None));
            }
            _ => at += 1,
        }
    }
    found
}
