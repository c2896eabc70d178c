//! Diagnostics for people.

use std::fmt;
use std::io::IsTerminal;

use filpost::{Diag, Place, Severity};
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
    output::say(render(diag, colours()).trim_end());
}

/// True when standard error takes colours.
fn colours() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    !refused && std::io::stderr().is_terminal()
}

/// A diagnostic as text.
pub fn render(diag: &Diag, colours: bool) -> String {
    let theme = if colours { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(WIDTH)
        .with_links(false)
        .with_context_lines(0);
    let mut text = String::new();
    let shown = Shown::new(diag);
    if handler.render_report(&mut text, &shown).is_err() {
        return format!("{diag}\n");
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

/// A diagnostic as miette shows it. The places in other lines than the first
/// come as diagnostics of their own, each with its excerpt.
#[derive(Debug)]
struct Shown {
    code: Option<String>,
    severity: Option<miette::Severity>,
    message: String,
    hint: Option<String>,
    source: Option<NamedSource<Excerpt>>,
    labels: Vec<LabeledSpan>,
    others: Vec<Shown>,
}

impl Shown {
    fn new(diag: &Diag) -> Shown {
        let mut places = diag.places.iter();
        let first = places.next();
        let mut shown = match first {
            Some(place) => Shown::of_place(place, clean(&diag.message)),
            None => Shown::of_message(clean(&diag.message)),
        };
        shown.code = Some(format!("{} {}", diag.code.name(), diag.code.title));
        shown.severity = Some(match diag.code.severity {
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        });
        shown.hint = Some(clean(diag.hint.as_deref().unwrap_or(diag.code.hint)));
        for place in places {
            let same = first.is_some_and(|first| {
                first.file == place.file
                    && first.line == place.line
                    && first.excerpt == place.excerpt
                    && shown_excerpt(first).0 == first.excerpt
            });
            if same {
                shown.labels.push(label(place, shown_excerpt(place).1));
            } else {
                let message = if place.label.is_empty() { "see here" } else { &place.label };
                let mut other = Shown::of_place(place, clean(message));
                other.severity = Some(miette::Severity::Advice);
                shown.others.push(other);
            }
        }
        shown
    }

    fn of_message(message: String) -> Shown {
        Shown {
            code: None,
            severity: None,
            message,
            hint: None,
            source: None,
            labels: Vec::new(),
            others: Vec::new(),
        }
    }

    fn of_place(place: &Place, message: String) -> Shown {
        let (text, span) = shown_excerpt(place);
        let excerpt = Excerpt { text, line: place.line.saturating_sub(1) as usize };
        Shown {
            source: Some(NamedSource::new(clean(&place.file), excerpt)),
            labels: vec![label(place, span)],
            ..Shown::of_message(message)
        }
    }
}

fn label(place: &Place, span: std::ops::Range<usize>) -> LabeledSpan {
    let text = (!place.label.is_empty()).then(|| clean(&place.label));
    LabeledSpan::new_with_span(text, SourceSpan::from(span))
}

/// The excerpt as it is shown, and the place within it: control characters
/// are replaced, a long line is cut around the place.
fn shown_excerpt(place: &Place) -> (String, std::ops::Range<usize>) {
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
fn clean(text: &str) -> String {
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
        self.severity
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

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        if self.others.is_empty() {
            return None;
        }
        Some(Box::new(self.others.iter().map(|other| other as &dyn Diagnostic)))
    }
}

/// One line of a file, which knows its number; the rest of the file is not needed.
#[derive(Debug)]
struct Excerpt {
    text: String,
    /// Line number, 0-based.
    line: usize,
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, miette::MietteError> {
        let inner = self.text.as_str().read_span(span, before, after)?;
        Ok(Box::new(miette::MietteSpanContents::new(
            inner.data(),
            *inner.span(),
            inner.line() + self.line,
            inner.column(),
            inner.line_count(),
        )))
    }
}
