//! What may stand at a place.

use std::collections::HashSet;

use filpost::builtins::BUILTINS;
use filpost::cl::Vocabulary;
use filpost::dispatch;
use filpost::locations::TABLE;
use filpost::postf::POSTF;
use filpost::resolve::{Symbol, SymbolKind};
use filpost::statements::STATEMENTS;

use crate::context::{self, open_call, slash};
use crate::script::Script;
use crate::tables;
use crate::text::{Position, Range, is_word};

/// What a proposal is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ItemKind {
    /// A statement of FIL.
    Keyword,
    /// A function.
    Function,
    /// A word of the vocabulary.
    Word,
    /// A macro.
    Macro,
    /// A variable, array or parameter.
    Variable,
    /// A label.
    Label,
    /// A number with a meaning.
    Number,
    /// A setting.
    Setting,
}

/// A proposal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// What is shown and written.
    pub label: String,
    /// What it is.
    pub kind: ItemKind,
    /// A line about it.
    pub detail: String,
    /// What it takes the place of.
    pub range: Range,
}

/// Gathers proposals, each label once.
struct Items {
    range: Range,
    known: HashSet<String>,
    list: Vec<Item>,
}

impl Items {
    fn add(&mut self, label: impl Into<String>, kind: ItemKind, detail: impl Into<String>) {
        let label = label.into();
        if self.known.insert(label.clone()) {
            self.list.push(Item { label, kind, detail: detail.into(), range: self.range });
        }
    }
}

impl Script {
    /// Proposals for a place, those that are legal there.
    pub fn complete(&self, position: Position) -> Vec<Item> {
        let byte = self.text.byte(position);
        let before = context::before(&self.text, byte);
        let head = &self.text.as_str()[..byte];
        let start = head
            .rfind(|c| !is_word(c))
            .map_or(0, |at| at + head[at..].chars().next().map_or(0, char::len_utf8));
        let range = self.text.range(start..byte);
        let mut items = Items { range, known: HashSet::new(), list: Vec::new() };
        if before.comment {
            return Vec::new();
        }
        let statement = before.statement.as_str();
        if before.quoted {
            self.in_text(statement, byte, &mut items);
            return items.list;
        }
        if let Some((name, arguments)) = open_call(statement) {
            self.in_call(name, &arguments, byte, &mut items);
        } else if let Some((word, parts)) = slash(statement) {
            self.behind_slash(word, &parts, byte, &mut items);
        } else if statement.bytes().all(|byte| byte.is_ascii_alphanumeric()) {
            self.statements(&mut items);
        } else {
            self.values(byte, &mut items);
        }
        items.list
    }

    /// Names of settings in `COMF('…`.
    fn in_text(&self, statement: &str, byte: usize, items: &mut Items) {
        let Some(("COMF", _)) = statement.rsplit_once('\'').and_then(|(head, _)| open_call(head))
        else {
            return;
        };
        let head = &self.text.as_str()[..byte];
        let start = head.rfind('\'').map_or(byte, |at| at + 1);
        items.range = self.text.range(start..byte);
        for row in TABLE {
            items.add(row.name, ItemKind::Setting, row.meaning);
        }
    }

    fn in_call(&self, name: &str, arguments: &[&str], byte: usize, items: &mut Items) {
        match (name, arguments.len()) {
            ("POSTF", 1) => {
                for row in POSTF {
                    items.add(row.number.to_string(), ItemKind::Number, row.doc);
                }
            }
            ("POSTF", 2) if matches!(arguments[0].trim(), "1" | "2" | "3") => {
                for (number, name) in [("1", "INTCOM"), ("2", "RELCOM"), ("3", "DBLCOM")] {
                    items.add(number, ItemKind::Number, name);
                }
            }
            ("POSTF", 3) if matches!(arguments[0].trim(), "1" | "2" | "3") => {
                let kind = arguments[1].trim();
                let of_kind =
                    TABLE.iter().filter(|row| (row.kind as usize + 1).to_string() == kind);
                for row in of_kind {
                    items.add(row.number.to_string(), ItemKind::Number, row.name);
                }
            }
            ("ICODEF" | "HASF" | "COUPLF", 1) => self.minor_words(byte, items),
            ("NEXTF" | "PREVF", 1) => {
                for letter in ["X", "Y", "Z", "I", "J", "K"] {
                    items.add(letter, ItemKind::Word, "of the motion");
                }
            }
            _ => self.values(byte, items),
        }
    }

    fn behind_slash(&self, word: &str, parts: &[&str], byte: usize, items: &mut Items) {
        let vocabulary = Vocabulary::new();
        match word {
            "CIMFIL" if parts.len() == 1 => {
                items.add("ON", ItemKind::Keyword, "begins a section");
                items.add("OFF", ItemKind::Keyword, "ends a section");
            }
            "CIMFIL" if parts.len() == 2 => {
                items.add("ALL", ItemKind::Keyword, "all records");
                major_words(&vocabulary, items);
            }
            "CIMFIL" => minors(parts[1].trim(), &vocabulary, items),
            "CALL" if parts.len() == 1 => self.names(&[SymbolKind::Macro], byte, items),
            "CALL" => {
                for parameter in self.parameters(parts[0].trim()) {
                    items.add(format!("{parameter}="), ItemKind::Variable, "parameter");
                }
                self.values(byte, items);
            }
            "JUMPTO" | "DO" if parts.len() == 1 => self.labels(byte, items),
            "WHEN" => {
                items.add("OTHER", ItemKind::Keyword, "all that is left");
                items.add("ICODEF(", ItemKind::Function, "code of a word");
                self.values(byte, items);
            }
            "PRINT" | "REDEF" | "REPEAT" if parts.len() == 1 => {
                for word in ["ON", "OFF"] {
                    items.add(word, ItemKind::Word, "");
                }
                if word == "REPEAT" {
                    letters(items);
                }
            }
            "POSTN" if parts.len() == 1 => items.add("OUT", ItemKind::Word, "writes a block"),
            "POSTN" => {
                letters(items);
                self.values(byte, items);
            }
            _ => {
                minors(word, &vocabulary, items);
                self.values(byte, items);
            }
        }
    }

    /// What a statement may begin with.
    fn statements(&self, items: &mut Items) {
        for row in STATEMENTS {
            let line = row.doc.split(". ").next().unwrap_or_default();
            items.add(row.word, ItemKind::Keyword, line);
        }
        for word in ["IF(", "ELSE", "ELSEIF(", "ENDIF", "ENDCAS", "TERMAC", "CONTIN", "FINI"] {
            items.add(word, ItemKind::Keyword, "");
        }
        major_words(&Vocabulary::new(), items);
        let kinds = [SymbolKind::Variable, SymbolKind::Array];
        self.names(&kinds, usize::MAX, items);
    }

    /// What may stand in an expression.
    fn values(&self, byte: usize, items: &mut Items) {
        let kinds =
            [SymbolKind::Variable, SymbolKind::Array, SymbolKind::Table, SymbolKind::Parameter];
        self.names(&kinds, byte, items);
        items.add("POSTF(", ItemKind::Function, "talks to the post");
        let functions = BUILTINS.iter().filter(|row| !row.call().contains('/'));
        for row in functions {
            items.add(format!("{}(", row.name), ItemKind::Function, row.doc);
        }
        items.add("EMPTY", ItemKind::Number, "no value");
    }

    fn names(&self, kinds: &[SymbolKind], byte: usize, items: &mut Items) {
        let symbols = &self.analysis.resolution.symbols;
        let typed = |symbol: &Symbol| {
            // The name that is being typed is no proposal for itself.
            let places = symbol.definitions.len() + symbol.uses.len();
            places > 1
                || !self.spans(symbol).any(|span| span.range().contains(&byte.wrapping_sub(1)))
        };
        for symbol in symbols.iter().filter(|symbol| kinds.contains(&symbol.kind)) {
            if symbol.kind == SymbolKind::Parameter && !self.is_inside(symbol, byte) {
                continue;
            }
            if !symbol.definitions.is_empty() && typed(symbol) {
                let kind = if symbol.kind == SymbolKind::Macro {
                    ItemKind::Macro
                } else {
                    ItemKind::Variable
                };
                items.add(symbol.name.clone(), kind, "");
            }
        }
    }

    /// True where a symbol belongs to the macro around a byte.
    fn is_inside(&self, symbol: &Symbol, byte: usize) -> bool {
        let owner = symbol.owner.map(|owner| &self.analysis.resolution.symbols[owner]);
        let extent = owner.and_then(|owner| owner.extent);
        extent.is_some_and(|extent| extent.file == self.file && extent.span.range().contains(&byte))
    }

    /// Labels of the section or macro around a byte.
    fn labels(&self, byte: usize, items: &mut Items) {
        let symbols = &self.analysis.resolution.symbols;
        let labels = symbols.iter().filter(|symbol| symbol.kind == SymbolKind::Label);
        for symbol in labels.filter(|symbol| !symbol.definitions.is_empty()) {
            let here = symbol.owner.is_none() || self.is_inside(symbol, byte);
            if here {
                items.add(symbol.name.clone(), ItemKind::Label, "");
            }
        }
    }

    fn parameters(&self, name: &str) -> Vec<String> {
        let symbols = &self.analysis.resolution.symbols;
        let id = symbols
            .iter()
            .position(|symbol| symbol.kind == SymbolKind::Macro && symbol.name == name);
        let own = symbols.iter().filter(|symbol| {
            symbol.kind == SymbolKind::Parameter && id.is_some() && symbol.owner == id
        });
        own.map(|symbol| symbol.name.clone()).collect()
    }

    /// Minor words: those of the section's major word first.
    fn minor_words(&self, byte: usize, items: &mut Items) {
        let vocabulary = Vocabulary::new();
        if let Some(key) = self.section_at(byte) {
            let major = key.split(',').next().unwrap_or_default();
            minors(major, &vocabulary, items);
        }
        let asked = self.analysis.resolution.of_kind(SymbolKind::Word);
        for symbol in asked.filter(|symbol| symbol.uses.len() > 1) {
            items.add(symbol.name.clone(), ItemKind::Word, "used in this script");
        }
        for (id, _) in dispatch::HANDLERS {
            for minor in tables::minors_of(vocabulary.name(*id), &vocabulary) {
                items.add(minor, ItemKind::Word, "minor word");
            }
        }
    }
}

fn major_words(vocabulary: &Vocabulary, items: &mut Items) {
    for (id, _) in dispatch::HANDLERS {
        let name = vocabulary.name(*id);
        items.add(name, ItemKind::Word, tables::form_of(name).unwrap_or_default());
    }
}

fn minors(major: &str, vocabulary: &Vocabulary, items: &mut Items) {
    for minor in tables::minors_of(major, vocabulary) {
        items.add(minor, ItemKind::Word, format!("minor word of {major}"));
    }
}

fn letters(items: &mut Items) {
    for letter in 'A'..='Z' {
        items.add(letter.to_string(), ItemKind::Number, "an address");
    }
}
