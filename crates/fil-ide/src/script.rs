//! A FIL file with all that is known of it.

use filpost::check::{self, Includes, Options};
use filpost::resolve::{FileSpan, Symbol};
use filpost::{Analysis, Code, Commons, Severity, TextSpan};

use crate::text::{Range, Text};

/// A FIL file and what it includes, analyzed.
pub struct Script {
    pub(crate) text: Text,
    pub(crate) analysis: Analysis,
    /// Texts of all files, in the order of [`Analysis::files`].
    pub(crate) texts: Vec<Text>,
    /// The one that is edited, in [`Analysis::files`].
    pub(crate) file: usize,
}

/// A diagnostic with its place in the edited file.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Where.
    pub range: Range,
    /// The code.
    pub code: &'static Code,
    /// Error or warning.
    pub severity: Severity,
    /// What is wrong, with its hint.
    pub message: String,
    /// The hint alone.
    pub hint: String,
}

impl Script {
    /// Analyzes `files`, each a name and a text, which share one name space; `edited` is the
    /// name of the one that is edited, which may also be one that another includes.
    /// `includes` gives the files of INCLUD, `machine` what the script runs on.
    pub fn new<'a>(
        files: &[(&str, &str)],
        edited: &str,
        includes: Option<Includes<'a>>,
        machine: Option<&'a Commons>,
    ) -> Self {
        let options = Options { includes, machine, ..Options::default() };
        let analysis = check::analyze(files, options);
        let texts: Vec<Text> = analysis.files.iter().map(|file| Text::new(&file.text)).collect();
        let file = analysis.files.iter().position(|file| file.name == edited).unwrap_or(0);
        // A text with a byte order mark has lost it in the analysis.
        let own = files.iter().find(|(name, _)| *name == edited).map(|(_, text)| Text::new(text));
        let text = own.or_else(|| texts.get(file).cloned()).unwrap_or_else(|| Text::new(""));
        Script { text, analysis, texts, file }
    }

    /// The edited text.
    pub fn text(&self) -> &Text {
        &self.text
    }

    /// Names of all files of the analysis.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        self.analysis.files.iter().map(|file| file.name.as_str())
    }

    /// What is wrong in the edited file.
    pub fn findings(&self) -> Vec<Finding> {
        self.findings_of(self.file, &self.text)
    }

    /// What is wrong in each file, by name.
    pub fn all_findings(&self) -> Vec<(&str, Vec<Finding>)> {
        let files = self.analysis.files.iter().enumerate();
        files
            .map(|(index, file)| {
                let text = if index == self.file { &self.text } else { &self.texts[index] };
                (file.name.as_str(), self.findings_of(index, text))
            })
            .collect()
    }

    fn findings_of(&self, file: usize, text: &Text) -> Vec<Finding> {
        let Some(name) = self.analysis.files.get(file).map(|file| &file.name) else {
            return Vec::new();
        };
        let of_file = |place: &&TextSpan| place.file == *name;
        let found = self.analysis.diags.iter().filter_map(|diag| {
            let place = diag.spans.first().filter(of_file)?;
            let hint = diag.hint.clone().unwrap_or_else(|| diag.code.hint.to_string());
            Some(Finding {
                range: range_of(text, place),
                code: diag.code,
                severity: diag.severity,
                message: format!("{}\n{hint}", diag.message),
                hint,
            })
        });
        found.collect()
    }

    /// The symbols at a byte of the edited file.
    pub(crate) fn symbols_at(&self, byte: usize) -> Vec<&Symbol> {
        let symbols = &self.analysis.resolution.symbols;
        let ids = self.analysis.resolution.at(self.file, byte as u32);
        let mut found: Vec<&Symbol> = ids.map(|id| &symbols[id]).collect();
        // A name that ends at the byte counts less than one that begins there.
        found.sort_by_key(|symbol| {
            !self.spans(symbol).any(|span| span.start as usize <= byte && byte < span.end as usize)
        });
        found
    }

    /// Where a symbol stands in the edited file.
    pub(crate) fn spans<'s>(
        &'s self,
        symbol: &'s Symbol,
    ) -> impl Iterator<Item = filpost::syntax::tree::Span> + 's {
        let own = move |location: &FileSpan| location.file == self.file;
        let uses = symbol.uses.iter().map(|used| used.location);
        symbol.definitions.iter().copied().chain(uses).filter(own).map(|location| location.span)
    }
}

/// The place of a diagnostic; an empty one is widened to a character.
fn range_of(text: &Text, place: &TextSpan) -> Range {
    let line = text.line_bytes((place.line as usize).saturating_sub(1));
    let start = (line.start + place.span.start).min(line.end);
    let end = (line.start + place.span.end).clamp(start, line.end);
    text.range(start..end)
}
