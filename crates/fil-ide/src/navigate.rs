//! Definitions, references and renaming.

use filpost::resolve::{FileSpan, Symbol, SymbolKind};

use crate::context::code;
use crate::script::Script;
use crate::tables;
use crate::text::{Position, Range, Text};

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// Name of the file as the analysis was given it.
    pub file: String,
    /// Where.
    pub range: Range,
}

/// A change of a file's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// Where the old text stands.
    pub place: Place,
    /// The new text.
    pub text: String,
}

impl Script {
    fn place(&self, location: &FileSpan) -> Option<Place> {
        let text = self.text_of(location.file)?;
        let file = self.analysis.files.get(location.file)?.name.clone();
        Some(Place { file, range: text.range(location.span.range()) })
    }

    fn text_of(&self, file: usize) -> Option<&Text> {
        if file == self.file { Some(&self.text) } else { self.texts.get(file) }
    }

    /// Where the name at a place is defined.
    pub fn definition(&self, position: Position) -> Vec<Place> {
        let byte = self.text.byte(position);
        if let Some(file) = self.included_at(position) {
            return vec![Place { file, range: Range::default() }];
        }
        let symbols = self.symbols_at(byte);
        let found = symbols.iter().find(|symbol| !symbol.definitions.is_empty());
        found.map_or_else(Vec::new, |symbol| {
            symbol.definitions.iter().filter_map(|location| self.place(location)).collect()
        })
    }

    /// The file that an INCLUD in the line of a place brings in.
    fn included_at(&self, position: Position) -> Option<String> {
        let (line, _) = code(self.text.line(position.line as usize));
        let (word, name) = line.split_once('/')?;
        if !word.trim().eq_ignore_ascii_case("INCLUD") {
            return None;
        }
        let parts = |name: &str| -> Vec<String> {
            let parts = name.split(['/', '\\']).filter(|part| !part.is_empty() && *part != ".");
            parts.map(str::to_ascii_uppercase).collect()
        };
        let wanted = parts(name.trim().trim_matches('\''));
        let is_wanted = |file: &&str| !wanted.is_empty() && parts(file).ends_with(&wanted);
        let files = self.analysis.files.iter().enumerate();
        let others = files.filter(|(index, _)| *index != self.file);
        others.map(|(_, file)| file.name.as_str()).find(is_wanted).map(str::to_string)
    }

    /// All places of the name at a place, its definitions among them on demand.
    pub fn references(&self, position: Position, with_definitions: bool) -> Vec<Place> {
        let byte = self.text.byte(position);
        let symbols = self.symbols_at(byte);
        let Some(symbol) = symbols.first() else { return Vec::new() };
        let definitions = symbol.definitions.iter().filter(|_| with_definitions);
        let uses = symbol.uses.iter().map(|used| &used.location);
        let mut found: Vec<Place> =
            definitions.chain(uses).filter_map(|location| self.place(location)).collect();
        found.dedup();
        found
    }

    /// The name that a rename at a place would change.
    ///
    /// # Errors
    /// Why it can't be renamed.
    pub fn renamable(&self, position: Position) -> Result<Range, String> {
        let byte = self.text.byte(position);
        let symbols = self.symbols_at(byte);
        let symbol = symbols.first().ok_or("there is no name here")?;
        own_name(symbol)?;
        let on_it = self
            .spans(symbol)
            .find(|span| span.start as usize <= byte && byte <= span.end as usize);
        on_it
            .map(|span| self.text.range(span.range()))
            .ok_or_else(|| "there is no name here".into())
    }

    /// The edits that give the name at a place another one.
    ///
    /// # Errors
    /// Why it can't be renamed, or not so.
    pub fn rename(&self, position: Position, new: &str) -> Result<Vec<Edit>, String> {
        self.renamable(position)?;
        let byte = self.text.byte(position);
        let symbols = self.symbols_at(byte);
        let symbol = symbols.first().ok_or("there is no name here")?;
        let new = new.to_ascii_uppercase();
        self.is_free(symbol, &new)?;
        let uses = symbol.uses.iter().map(|used| used.location);
        let mut places: Vec<FileSpan> = symbol.definitions.iter().copied().chain(uses).collect();
        places.sort_by_key(|place| (place.file, place.span.start));
        places.dedup();
        let edits = places.iter().map(|location| {
            let text = self.text_of(location.file).map(Text::as_str).unwrap_or_default();
            let written = text.get(location.span.range()).unwrap_or_default();
            if !written.eq_ignore_ascii_case(&symbol.name) {
                return Err(format!("`{written}` is not {}", symbol.name));
            }
            let place = self.place(location).ok_or("a file is not there")?;
            Ok(Edit { place, text: new.clone() })
        });
        edits.collect()
    }

    /// Refuses a new name that FIL doesn't allow, or that means something already.
    fn is_free(&self, symbol: &Symbol, new: &str) -> Result<(), String> {
        let is_name = new.starts_with(|c: char| c.is_ascii_alphabetic())
            && new.bytes().all(|byte| byte.is_ascii_alphanumeric());
        if !is_name || new.len() == 1 {
            return Err(format!("`{new}` is no name: a letter, then letters and digits"));
        }
        if tables::function(new).is_some()
            || tables::statement(new).is_some()
            || filpost::syntax::is_statement_word(new)
            || ["EMPTY", "OTHER", "THEN", "POSTF"].contains(&new)
        {
            return Err(format!("`{new}` is a word of FIL"));
        }
        let vocabulary = filpost::cl::Vocabulary::new();
        if vocabulary.find(new).is_some_and(|id| vocabulary.is_known(id)) {
            return Err(format!("`{new}` is a word of the vocabulary"));
        }
        let taken = self.analysis.resolution.symbols.iter().find(|other| {
            let apart = symbol.kind == SymbolKind::Label
                && other.kind == SymbolKind::Label
                && other.owner != symbol.owner;
            other.name == new && !apart
        });
        taken.map_or(Ok(()), |_| Err(format!("`{new}` is used already")))
    }
}

/// Names of the script itself can be renamed, words and functions not.
fn own_name(symbol: &Symbol) -> Result<(), String> {
    match symbol.kind {
        SymbolKind::Variable
        | SymbolKind::Parameter
        | SymbolKind::Array
        | SymbolKind::Table
        | SymbolKind::Macro
        | SymbolKind::Label => Ok(()),
        _ => Err(format!("{} is not a name of this script", symbol.name)),
    }
}
