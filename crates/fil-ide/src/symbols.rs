//! Outlines of files.

use filpost::resolve::SymbolKind;

use crate::script::Script;
use crate::text::{Range, Text};

/// What an entry of an outline is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutlineKind {
    /// A section of FIL, an operation of a CL file.
    Section,
    /// A macro.
    Macro,
    /// A label.
    Label,
    /// An array or table.
    Array,
    /// A variable of the global area.
    Variable,
    /// A tool of a CL file, a table of machine.toml.
    Group,
}

/// An entry of an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: OutlineKind,
    /// All of it.
    pub whole: Range,
    /// Its name in the text.
    pub range: Range,
    /// What stands in it.
    pub children: Vec<Outline>,
}

impl Script {
    /// Sections, macros with their labels, arrays and variables of the edited file.
    pub fn outline(&self) -> Vec<Outline> {
        self.outline_of(self.file, &self.text)
    }

    /// The same of each file, by name, for a search in all of them.
    pub fn outlines(&self) -> Vec<(&str, Vec<Outline>)> {
        let files = self.analysis.files.iter().enumerate();
        files
            .map(|(index, file)| {
                let text = if index == self.file { &self.text } else { &self.texts[index] };
                (file.name.as_str(), self.outline_of(index, text))
            })
            .collect()
    }

    fn outline_of(&self, file: usize, text: &Text) -> Vec<Outline> {
        let symbols = &self.analysis.resolution.symbols;
        let mut found = Vec::new();
        for (id, symbol) in symbols.iter().enumerate() {
            let Some(kind) = kind_of(symbol.kind) else { continue };
            let Some(first) = symbol.definitions.iter().find(|place| place.file == file) else {
                continue;
            };
            let range = text.range(first.span.range());
            let whole = symbol.extent.filter(|extent| extent.file == file);
            let whole = whole.map_or(range, |extent| text.range(extent.span.range()));
            let labels = symbols
                .iter()
                .filter(|label| label.kind == SymbolKind::Label && label.owner == Some(id));
            let children = labels.filter_map(|label| {
                let place = label.definitions.iter().find(|place| place.file == file)?;
                let range = text.range(place.span.range());
                let (name, kind) = (label.name.clone(), OutlineKind::Label);
                Some(Outline { name, kind, whole: range, range, children: Vec::new() })
            });
            let name = match symbol.kind {
                SymbolKind::Section => format!("CIMFIL/ON,{}", symbol.name),
                _ => symbol.name.clone(),
            };
            let whole =
                Range { start: whole.start.min(range.start), end: whole.end.max(range.end) };
            found.push(Outline { name, kind, whole, range, children: children.collect() });
        }
        found.sort_by_key(|entry| entry.range.start);
        found
    }
}

fn kind_of(kind: SymbolKind) -> Option<OutlineKind> {
    match kind {
        SymbolKind::Section => Some(OutlineKind::Section),
        SymbolKind::Macro => Some(OutlineKind::Macro),
        SymbolKind::Array | SymbolKind::Table => Some(OutlineKind::Array),
        SymbolKind::Variable => Some(OutlineKind::Variable),
        _ => None,
    }
}
