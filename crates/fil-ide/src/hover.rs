//! What stands under the pointer.

use filpost::resolve::{Symbol, SymbolKind};

use crate::context::{self, postf_calls};
use crate::script::Script;
use crate::tables;
use crate::text::{Position, Range, word_around};

impl Script {
    /// Markdown for a place, and the word it speaks of.
    pub fn hover(&self, position: Position) -> Option<(String, Range)> {
        let text = self.text.as_str();
        let byte = self.text.byte(position);
        let word = word_around(text, byte);
        let before = context::before(&self.text, byte);
        if word.is_empty() || before.comment {
            return None;
        }
        let name = text[word.clone()].to_ascii_uppercase();
        let range = self.text.range(word.clone());
        let numbered = self.postf_number(byte).or_else(|| self.postf_before(&name, word.end));
        let found = numbered.or_else(|| {
            let symbols = self.symbols_at(byte);
            symbols.iter().find_map(|symbol| self.of_symbol(symbol))
        });
        let found = found.or_else(|| if before.quoted { setting(text, byte) } else { None });
        let found = found.or_else(|| tables::statement(&name)).or_else(|| tables::function(&name));
        found.map(|markdown| (markdown, range))
    }

    /// POSTF and its numbers: the operation, or the common they name.
    fn postf_number(&self, byte: usize) -> Option<String> {
        let text = self.text.as_str();
        let call = postf_calls(&self.text).into_iter().find(|call| {
            call.arguments.iter().any(|range| range.start <= byte && byte <= range.end)
        })?;
        let at =
            call.arguments.iter().position(|range| range.start <= byte && byte <= range.end)?;
        let number =
            |index: usize| text.get(call.arguments.get(index)?.clone())?.parse::<u32>().ok();
        match (at, number(0)?) {
            (0, operation) => tables::postf(operation),
            (2, 1..=3) => tables::common(number(1)?, number(2)?),
            _ => None,
        }
    }

    /// The operation of the call whose POSTF ends at a byte.
    fn postf_before(&self, name: &str, end: usize) -> Option<String> {
        if name != "POSTF" {
            return None;
        }
        let text = self.text.as_str();
        let first = postf_calls(&self.text).into_iter().find_map(|call| {
            let first = call.arguments.into_iter().next()?;
            (text.get(end..first.start)?.trim() == "(").then_some(first)
        })?;
        tables::postf(text.get(first)?.parse().ok()?)
    }

    fn of_symbol(&self, symbol: &Symbol) -> Option<String> {
        let name = &symbol.name;
        Some(match symbol.kind {
            SymbolKind::Function | SymbolKind::HostFunction => tables::function(name)?,
            SymbolKind::Word => tables::word(name),
            SymbolKind::Postf => {
                let number = name.trim_start_matches("POSTF(").trim_end_matches(')').parse().ok();
                tables::postf(number?)?
            }
            SymbolKind::Letter => format!(
                "`{name}`: the letter of an address, a variable that begins as {}",
                name.bytes().next().map_or(0, |letter| letter.saturating_sub(b'A' - 1))
            ),
            SymbolKind::Macro => format!("macro{}", self.shown(symbol)),
            SymbolKind::Variable => format!("variable{}", self.shown(symbol)),
            SymbolKind::Parameter => format!("parameter{}", self.shown(symbol)),
            SymbolKind::Array => format!("array{}", self.shown(symbol)),
            SymbolKind::Table => format!("table{}", self.shown(symbol)),
            SymbolKind::Label => format!("label{}", self.shown(symbol)),
            SymbolKind::Section => format!("section `CIMFIL/ON,{name}`"),
            SymbolKind::Unknown => return None,
        })
    }

    /// The first definitions of a name, with the comments on their lines and above.
    fn shown(&self, symbol: &Symbol) -> String {
        if symbol.definitions.is_empty() {
            return format!(" `{}`: nothing sets it", symbol.name);
        }
        let mut shown = String::from("\n\n```fil\n");
        for place in symbol.definitions.iter().take(3) {
            let Some(text) = self.texts.get(place.file) else { continue };
            let line = text.line_of(place.span.start as usize);
            if line > 0 && text.line(line - 1).trim_start().starts_with("$$") {
                shown += &format!("{}\n", text.line(line - 1).trim());
            }
            shown += &format!("{}\n", text.line(line).trim());
        }
        shown += "```";
        if symbol.definitions.len() > 3 {
            shown += &format!("\n\nset in {} places", symbol.definitions.len());
        }
        shown
    }
}

/// The setting whose name stands between apostrophes around a byte.
fn setting(text: &str, byte: usize) -> Option<String> {
    let start = text[..byte].rfind(['\'', '\n']).map_or(0, |at| at + 1);
    let end = byte + text[byte..].find(['\'', '\n'])?;
    let name = text[start..end].to_ascii_lowercase();
    filpost::locations::Location::named(&name).map(tables::location)
}
