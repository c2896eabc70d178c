//! Diagnostics for people.

use std::fmt;
use std::io::IsTerminal;

use filpost::{Diag, Severity, TextSpan};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode,
    SourceSpan, SpanContents,
};

use crate::output;

/// Width of messages where they don't go to a terminal that says its own.
const WIDTH: usize = 100;

/// Longest excerpt that is shown whole, in characters.
const EXCERPT: usize = 160;

/// Characters shown before the place in a longer one.
const BEFORE: usize = 60;

/// Shows a diagnostic on standard error.
pub fn to_stderr(diag: &Diag) {
    output::say(render(diag, colours(&std::io::stderr())).trim_end());
}

/// True when a stream takes colours.
pub fn colours(stream: &impl IsTerminal) -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    !refused && stream.is_terminal()
}

/// A diagnostic as text: the places in other lines than the first follow, each
/// with its excerpt, and then the notes.
pub fn render(diag: &Diag, colours: bool) -> String {
    let theme = if colours { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(WIDTH)
        .with_links(false)
        .with_context_lines(1);
    let mut text = String::new();
    for shown in all_shown(diag) {
        if handler.render_report(&mut text, &shown).is_err() {
            return format!("{diag}\n");
        }
    }
    for note in &diag.notes {
        for (index, line) in clean(note).lines().enumerate() {
            let head = if index == 0 { "  note: " } else { "        " };
            text.push_str(head);
            text.push_str(line);
            text.push('\n');
        }
    }
    text
}

/// A diagnostic, or a further place of one, as miette shows it.
#[derive(Debug)]
struct Shown {
    code: Option<String>,
    severity: miette::Severity,
    message: String,
    hint: Option<String>,
    source: Option<NamedSource<Excerpt>>,
    labels: Vec<LabeledSpan>,
}

/// The diagnostic at its first line, and then its places in other lines.
fn all_shown(diag: &Diag) -> Vec<Shown> {
    let first = diag.spans.first();
    let severity = match diag.severity() {
        Severity::Warning => miette::Severity::Warning,
        Severity::Error => miette::Severity::Error,
    };
    let mut shown = Shown::new(severity, clean(&diag.message), first);
    shown.code = Some(format!("{} {}", diag.code.name(), diag.code.title));
    shown.hint = Some(clean(diag.hint.as_deref().unwrap_or(diag.code.hint)));
    if let Some((label, first)) = shown.labels.first_mut().zip(first) {
        label.set_label((!first.label.is_empty()).then(|| clean(&first.label)));
    }
    let mut list = vec![shown];
    for place in diag.spans.iter().skip(1) {
        let message = if place.label.is_empty() { "see here" } else { &place.label };
        list.push(Shown::new(miette::Severity::Advice, clean(message), Some(place)));
    }
    list
}

impl Shown {
    fn new(severity: miette::Severity, message: String, place: Option<&TextSpan>) -> Shown {
        let (mut source, mut labels) = (None, Vec::new());
        if let Some(place) = place {
            let (text, span) = shown_excerpt(place);
            let line = place.line.saturating_sub(1) as usize;
            let excerpt = Excerpt { text, line, column: place.column() - 1 };
            source = Some(NamedSource::new(clean(&place.file), excerpt));
            labels.push(LabeledSpan::new_with_span(None, SourceSpan::from(span)));
        }
        Shown { code: None, severity, message, hint: None, source, labels }
    }
}

/// The excerpt as it is shown, and the place within it: control characters
/// are replaced, a long line is cut around the place.
pub fn shown_excerpt(place: &TextSpan) -> (String, std::ops::Range<usize>) {
    let (mut text, mut from, mut to) = (String::new(), None, None);
    let count = place.excerpt.chars().count();
    let at = place.excerpt.get(..place.span.start).map_or(0, |head| head.chars().count());
    let first = if count > EXCERPT { at.saturating_sub(BEFORE) } else { 0 };
    if first > 0 {
        text.push('…');
    }
    let window = place.excerpt.char_indices().skip(first).take(EXCERPT);
    for (offset, character) in window {
        if offset >= place.span.start {
            from.get_or_insert(text.len());
        }
        if offset >= place.span.end {
            to.get_or_insert(text.len());
        }
        text.push(visible(character));
    }
    let end = text.len();
    if count > first + EXCERPT {
        text.push('…');
    }
    let from = from.unwrap_or(end);
    (text, from..to.unwrap_or(end).max(from))
}

/// Text without characters that would steer a terminal.
pub fn clean(text: &str) -> String {
    text.chars()
        .map(|character| if character == '\n' { '\n' } else { visible(character) })
        .collect()
}

fn visible(character: char) -> char {
    match character {
        '\t' => ' ',
        _ if character.is_control() => '\u{fffd}',
        _ => character,
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Shown {}

impl Diagnostic for Shown {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.code.as_ref().map(|code| Box::new(code) as Box<dyn fmt::Display>)
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.hint.as_ref().map(|hint| Box::new(hint) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }
}

/// One line of a file, which knows its number; the rest of the file is not needed.
#[derive(Debug)]
struct Excerpt {
    text: String,
    /// Line number, 0-based.
    line: usize,
    /// Column of the place in the line of the file, 0-based.
    column: usize,
}

impl SourceCode for Excerpt {
    /// The whole line, whatever the span. Asked without context, miette wants
    /// to know where the span starts.
    fn read_span<'a>(
        &'a self,
        _: &SourceSpan,
        before: usize,
        _: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, miette::MietteError> {
        let column = if before == 0 { self.column } else { 0 };
        let whole = SourceSpan::from(0..self.text.len());
        let data = self.text.as_bytes();
        Ok(Box::new(miette::MietteSpanContents::new(data, whole, self.line, column, 1)))
    }
}
