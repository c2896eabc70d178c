//! Lines of statements with their comments and blank lines, from the tokens of
//! the grammar and the gaps between them.

use std::ops::Range;

use super::gap::{self, Part};
use crate::adapter::{Adapter, Placed, Shared};
use crate::token::Token;

/// A whole file.
#[derive(Default)]
pub(super) struct Layout<'s> {
    pub(super) lines: Vec<Line<'s>>,
    /// What stands below the last statement.
    pub(super) below: Vec<Above<'s>>,
    pub(super) rest: Rest<'s>,
}

/// Text after FINI that is more than comments, as it is written.
#[derive(Default)]
pub(super) enum Rest<'s> {
    #[default]
    None,
    /// On the line of FINI.
    SameLine(&'s str),
    /// On the lines below it.
    Below(&'s str),
}

/// A line of statements joined by semicolons.
#[derive(Default)]
pub(super) struct Line<'s> {
    /// Comments and blank lines above it.
    pub(super) above: Vec<Above<'s>>,
    pub(super) statements: Vec<Statement<'s>>,
    /// The comment at its end.
    pub(super) trailing: Option<&'s str>,
}

/// A line without a statement.
pub(super) enum Above<'s> {
    Blank,
    Comment { text: &'s str, first_column: bool },
}

/// The words and signs of a statement.
pub(super) struct Statement<'s> {
    pub(super) words: Vec<Word<'s>>,
    /// The same words as the grammar sees them.
    pub(super) tokens: Vec<Placed<'s>>,
}

/// A word or sign.
pub(super) struct Word<'s> {
    /// As written, but a label without its bracket.
    pub(super) text: &'s str,
    /// Comments of the continued lines before it.
    pub(super) comments: Vec<&'s str>,
    /// A free text with a `/` before it.
    pub(super) after_slash: bool,
}

/// Takes a text apart that has no errors.
pub(super) fn layout(source: &str) -> Layout<'_> {
    let mut collector =
        Collector { source, layout: Layout::default(), at: 0, in_label: Vec::new() };
    let shared = Shared::default();
    let mut tokens = Vec::new();
    for placed in Adapter::new(source, &shared).flatten() {
        if placed.1 == Token::End {
            collector.statement(std::mem::take(&mut tokens));
        } else {
            tokens.push(placed);
        }
    }
    collector.finish();
    collector.layout
}

struct Collector<'s> {
    source: &'s str,
    layout: Layout<'s>,
    /// How far the text is taken apart.
    at: usize,
    /// Comments between a label and its bracket, which move behind the bracket.
    in_label: Vec<&'s str>,
}

impl<'s> Collector<'s> {
    /// Takes a statement and the gap before it.
    fn statement(&mut self, tokens: Vec<Placed<'s>>) {
        let Some(&(start, ..)) = tokens.first() else { return };
        let (parts, _) = gap::parts(self.source, self.at..start);
        self.at = start;
        let (above, own_line) = self.between(&parts);
        let mut words = Vec::with_capacity(tokens.len());
        for placed in &tokens {
            words.push(self.word(*placed));
        }
        let statement = Statement { words, tokens };
        match self.layout.lines.last_mut() {
            Some(line) if !own_line => line.statements.push(statement),
            _ => {
                let statements = vec![statement];
                self.layout.lines.push(Line { above, statements, trailing: None });
            }
        }
    }

    /// Takes a token and the gap before it.
    fn word(&mut self, (start, token, stop): Placed<'s>) -> Word<'s> {
        let before = self.at..start;
        let after_slash = matches!(token, Token::FreeText(_))
            && self.source[before.clone()].trim_start_matches([' ', '\t']).starts_with('/');
        let mut comments = std::mem::take(&mut self.in_label);
        comments.extend(comments_in(self.source, before));
        self.at = stop;
        let Token::Label(name) = token else {
            return Word { text: &self.source[start..stop], comments, after_slash };
        };
        self.in_label = comments_in(self.source, start + name.len()..stop);
        Word { text: name, comments, after_slash }
    }

    /// What the gap before a statement says: the comment that ends the line
    /// before it, the lines above it, and whether it stands on a line of its own.
    fn between(&mut self, parts: &[Part<'s>]) -> (Vec<Above<'s>>, bool) {
        let mut above = Vec::new();
        let mut own_line = self.layout.lines.is_empty();
        let mut filled = !own_line;
        for part in parts {
            match *part {
                Part::Semicolon => filled = true,
                Part::LineEnd => {
                    if !filled {
                        above.push(Above::Blank);
                    }
                    (filled, own_line) = (false, true);
                }
                Part::Comment { text, first_column } => {
                    match self.layout.lines.last_mut() {
                        Some(line) if !own_line => line.trailing = Some(text),
                        _ => above.push(Above::Comment { text, first_column }),
                    }
                    (filled, own_line) = (true, true);
                }
            }
        }
        (above, own_line)
    }

    /// Takes what follows the last statement.
    fn finish(&mut self) {
        let (parts, stop) = gap::parts(self.source, self.at..self.source.len());
        let (below, own_line) = self.between(&parts);
        self.layout.below = below;
        let rest = self.source[stop..].trim_end_matches([' ', '\t', '\r', '\n', '\x0c', '\x1a']);
        // A `$` at the very end continues nothing, as it does with a line end behind it.
        if matches!(rest, "" | "$") {
            return;
        }
        self.layout.rest = if own_line {
            let blanks = self.source[..stop].trim_end_matches([' ', '\t']).len();
            let end = stop + rest.len();
            Rest::Below(&self.source[blanks..end])
        } else {
            Rest::SameLine(rest)
        };
    }
}

/// The comments of the continued lines between two words.
fn comments_in(source: &str, range: Range<usize>) -> Vec<&str> {
    let (parts, _) = gap::parts(source, range);
    let texts = parts.into_iter().filter_map(|part| match part {
        Part::Comment { text, .. } => Some(text),
        _ => None,
    });
    texts.collect()
}
