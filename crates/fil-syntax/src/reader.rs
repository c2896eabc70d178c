//! What the grammar works on: collects statements and diagnostics.

use std::convert::Infallible;

use fil_diag::{Diag, LineIndex, TextSpan};
use lalrpop_util::{ErrorRecovery, ParseError};

use crate::adapter::Shared;
use crate::errors::SyntaxCode;
use crate::flat::{Flat, FlatKind};
use crate::free_text;
use crate::habits::{self, Refused};
use crate::message;
use crate::token::Token;
use crate::tree::{Name, Span};

/// The most diagnostics of a file; one more says that reading was given up.
pub(crate) const MAX_DIAGS: usize = 100;

/// Statements and diagnostics of a file as they come.
pub(crate) struct Reader<'a> {
    file: &'a str,
    source: &'a str,
    lines: LineIndex,
    shared: &'a Shared,
    label: Option<Name>,
    /// Statements in source order.
    pub(crate) flats: Vec<Flat>,
    /// Diagnostics in the order found.
    pub(crate) diags: Vec<Diag>,
    /// Some statement could not be read, so that blocks may seem unbalanced.
    pub(crate) unreadable: bool,
}

impl<'a> Reader<'a> {
    /// A reader with nothing read yet.
    pub(crate) fn new(file: &'a str, source: &'a str, shared: &'a Shared) -> Self {
        Reader {
            file,
            source,
            lines: LineIndex::new(source),
            shared,
            label: None,
            flats: Vec::new(),
            diags: Vec::new(),
            unreadable: false,
        }
    }

    /// The text of a span.
    pub(crate) fn text(&self, span: Span) -> &'a str {
        &self.source[span.range()]
    }

    /// The place of a span.
    pub(crate) fn place(&self, span: Span) -> TextSpan {
        self.lines.place(self.file, self.source, span.range())
    }

    /// The end of the last line with something on it.
    pub(crate) fn end_span(&self) -> Span {
        let end = self.source.trim_end().len();
        Span::new(end, end)
    }

    /// Reports something wrong at a span.
    pub(crate) fn report(&mut self, code: SyntaxCode, message: impl Into<String>, span: Span) {
        let place = self.place(span);
        self.push(Diag::new(code, message).at(place));
    }

    /// Adds a diagnostic; past the limit reading is given up.
    pub(crate) fn push(&mut self, diag: Diag) {
        if self.diags.len() < MAX_DIAGS {
            self.diags.push(diag);
        } else if !self.shared.stop.replace(true) {
            let message = format!("more than {MAX_DIAGS} messages, reading stopped here");
            let place =
                diag.spans.into_iter().next().unwrap_or_else(|| self.place(self.end_span()));
            self.diags.push(Diag::new(SyntaxCode::TooManyErrors, message).at(place));
        }
    }

    /// True when reading was given up.
    pub(crate) fn stopped(&self) -> bool {
        self.shared.stop.get()
    }

    /// A name or a label made of digits, in upper case and without leading zeros.
    pub(crate) fn name(&self, start: usize, text: &str) -> Name {
        let digits = text.bytes().all(|byte| byte.is_ascii_digit());
        let significant = if digits { text.trim_start_matches('0') } else { text };
        let kept = if significant.is_empty() { "0" } else { significant };
        Name { text: kept.to_ascii_uppercase(), span: Span::new(start, start + text.len()) }
    }

    /// Keeps the label of the statement that follows.
    pub(crate) fn label(&mut self, name: Name) {
        self.label = Some(name);
    }

    /// Takes a statement.
    pub(crate) fn statement(&mut self, kind: FlatKind, span: Span) {
        let label = self.label.take();
        self.unreadable |= matches!(kind, FlatKind::Refused);
        self.flats.push(Flat { label, kind, span });
        if let Some(text) = self.shared.semicolons.take() {
            self.report_semicolon(text);
        }
    }

    /// A semicolon in free text: harmless in a text for people, not where a statement
    /// stands behind it.
    fn report_semicolon(&mut self, text: Span) {
        match free_text::statement_behind_semicolon(self.text(text)) {
            Some(statement) => {
                let message = format!("{} is part of the text", message::quote(statement));
                self.report(SyntaxCode::StatementInText, message, text);
            }
            None => {
                let message = "the text runs to the end of the line, the semicolon included";
                self.report(SyntaxCode::SemicolonInText, message, text);
            }
        }
    }

    /// The line on which understanding ended.
    fn refused_line<'t>(&self, span: Span, token: Token<'t>) -> Refused<'t>
    where
        'a: 't,
    {
        let end = span.start as usize;
        let start = self.source[..end].rfind(['\r', '\n']).map_or(0, |at| at + 1);
        let rest = &self.source[start..];
        let rest = &rest[..rest.find(['\r', '\n']).unwrap_or(rest.len())];
        let line = &rest[..rest.find("$$").unwrap_or(rest.len())];
        Refused { line, at: end - start, token }
    }

    /// Takes a statement that does not follow the grammar.
    pub(crate) fn refused(&mut self, error: ErrorRecovery<usize, Token<'_>, Infallible>) {
        let (span, token, expected) = match error.error {
            ParseError::UnrecognizedToken { token: (start, token, end), expected } => {
                (Span::new(start, end), token, expected)
            }
            ParseError::ExtraToken { token: (start, token, end) } => {
                (Span::new(start, end), token, Vec::new())
            }
            ParseError::UnrecognizedEof { location, expected } => {
                (Span::new(location, location), Token::End, expected)
            }
            ParseError::InvalidToken { location } => {
                (Span::new(location, location), Token::End, Vec::new())
            }
            ParseError::User { error } => match error {},
        };
        let (code, text) = message::refusal(token, self.text(span), &expected);
        self.shared.semicolons.take();
        let place = self.place(span);
        let hint = habits::hint(&self.refused_line(span, token));
        self.push(Diag { hint, ..Diag::new(code, text).at(place) });
        self.statement(FlatKind::Refused, span);
    }
}
