//! A statement as pieces of text: how each word is written, where a blank
//! stands and where a line may be broken.

use super::collect::{Statement, Word};
use crate::adapter::{Placed, assigned_at, ends_value};
use crate::token::{FREE_TEXT_WORDS, Token};

/// A word or sign as it is written.
#[derive(Debug)]
pub(super) struct Piece {
    pub(super) text: String,
    /// A blank stands before it, unless it starts a line.
    pub(super) blank: bool,
    /// Whether a line may be broken before it.
    pub(super) before: Break,
    /// Comments of the continued lines before it, which keep their breaks.
    pub(super) comments: Vec<String>,
}

/// How well a line can be broken at a place, the worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Break {
    Never,
    /// Only where there is nothing better.
    Anywhere,
    /// After a sign within brackets.
    InnerSign,
    /// After a comma within brackets.
    InnerComma,
    /// After .AND. or .OR., or a sign of the statement itself.
    Operator,
    /// After a comma of the statement itself.
    Comma,
    /// The next line must start here.
    Always,
}

/// The pieces of a statement.
pub(super) fn pieces(statement: &Statement<'_>) -> Vec<Piece> {
    let shape = Shape::new(&statement.tokens);
    let mut depth = 0usize;
    let mut pieces = Vec::with_capacity(statement.words.len());
    for (at, word) in statement.words.iter().enumerate() {
        let token = statement.tokens[at].1;
        if token == Token::Close {
            depth = depth.saturating_sub(1);
        }
        let forced = !word.comments.is_empty() || shape.reads_on(at);
        pieces.push(Piece {
            text: written(word, token),
            blank: match token {
                Token::FreeText(_) => !word.after_slash,
                _ => shape.blank_before(at, depth),
            },
            before: if forced { Break::Always } else { shape.break_before(at, depth) },
            comments: word.comments.iter().map(ToString::to_string).collect(),
        });
        if token == Token::Open {
            depth += 1;
        }
    }
    pieces
}

/// A word as it is written: words, names and operators in upper case, numbers
/// and texts as they are.
fn written(word: &Word<'_>, token: Token<'_>) -> String {
    match token {
        Token::Label(_) => format!("{})", word.text.to_ascii_uppercase()),
        Token::FreeText(text) if word.after_slash => format!("/{text}"),
        Token::Integer(_)
        | Token::Real(_)
        | Token::Text(_)
        | Token::FreeText(_)
        | Token::FileName(_) => word.text.to_string(),
        _ => word.text.to_ascii_uppercase(),
    }
}

/// What kind of statement the words make.
struct Shape<'t, 's> {
    tokens: &'t [Placed<'s>],
    /// Where the statement starts, after its label and the condition of an IF.
    start: usize,
    /// Where the bracket of a condition opens.
    condition: Option<usize>,
    /// The `=` of an assignment.
    equals: Option<usize>,
    /// What is assigned is an expression.
    expression: bool,
}

impl<'t, 's> Shape<'t, 's> {
    fn new(tokens: &'t [Placed<'s>]) -> Self {
        let token = |at: usize| tokens.get(at).map(|placed| placed.1);
        let mut start = usize::from(matches!(token(0), Some(Token::Label(_))));
        let mut condition = None;
        if matches!(token(start), Some(Token::If | Token::ElseIf)) {
            condition = Some(start + 1);
            start = after_bracket(tokens, start + 1);
        }
        let equals = assigned_at(tokens, start);
        let assigned = equals.and_then(|equals| token(equals + 1));
        let expression = !matches!(assigned, None | Some(Token::TextWord | Token::Macro));
        Shape { tokens, start, condition, equals, expression }
    }

    fn token(&self, at: usize) -> Token<'s> {
        self.tokens[at].1
    }

    fn blank_before(&self, at: usize, depth: usize) -> bool {
        if at == 0 {
            return false;
        }
        let starts_part = at == self.start || self.condition == Some(at);
        let beside_equals = self.equals.is_some_and(|equals| at == equals || at == equals + 1);
        starts_part
            || beside_equals
            || self.is_spaced(at, depth)
            || self.is_spaced(at - 1, depth)
            || self.is_quoted_text(at)
            || matches!(self.token(at - 1), Token::Label(_))
    }

    /// An operator with blanks around it.
    fn is_spaced(&self, at: usize, depth: usize) -> bool {
        match self.token(at) {
            Token::And | Token::Or => true,
            Token::Plus | Token::Minus => {
                let in_value = self.equals.is_some_and(|equals| at > equals);
                depth == 0 && self.expression && in_value && ends_value(self.token(at - 1))
            }
            _ => false,
        }
    }

    /// The place of the `/` that is left out before a text between apostrophes.
    fn is_quoted_text(&self, at: usize) -> bool {
        let (start, token, stop) = self.tokens[at];
        token == Token::Slash && start == stop
    }

    /// After `PPRINT/` a word on the same line would be text; on the next one
    /// it is a word.
    fn reads_on(&self, at: usize) -> bool {
        at == self.start + 2
            && self.takes_text()
            && self.token(at - 1) == Token::Slash
            && !matches!(self.token(at), Token::Text(_))
    }

    /// The statement opens with PPRINT or its like.
    fn takes_text(&self) -> bool {
        matches!(self.tokens.get(self.start), Some((_, Token::Name(word), _))
            if FREE_TEXT_WORDS.iter().any(|name| name.eq_ignore_ascii_case(word)))
    }

    fn break_before(&self, at: usize, depth: usize) -> Break {
        if at == 0 || self.is_raw(at) {
            return Break::Never;
        }
        match self.token(at - 1) {
            Token::Comma if depth == 0 => Break::Comma,
            Token::Comma => Break::InnerComma,
            Token::And | Token::Or => Break::Operator,
            Token::Plus | Token::Minus if at > 1 && ends_value(self.token(at - 2)) => {
                if depth == 0 { Break::Operator } else { Break::InnerSign }
            }
            _ => Break::Anywhere,
        }
    }

    /// Text that must stay on the line of its word.
    fn is_raw(&self, at: usize) -> bool {
        matches!(self.token(at), Token::FreeText(_) | Token::FileName(_))
            || (self.takes_text() && at == self.start + 1)
            || matches!(self.token(at - 1), Token::Includ)
    }
}

/// The index after the bracket that opens at `open`.
fn after_bracket(tokens: &[Placed<'_>], open: usize) -> usize {
    let mut depth = 0usize;
    for (at, (_, token, _)) in tokens.iter().enumerate().skip(open) {
        match token {
            Token::Open => depth += 1,
            Token::Close if depth == 1 => return at + 1,
            Token::Close => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    tokens.len()
}
