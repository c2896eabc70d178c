//! How many blocks a statement stands in.

use super::collect::Statement;
use crate::token::Token;

/// Levels of indentation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Depth {
    /// Of the statement.
    pub(super) statement: usize,
    /// Of comments above it: those above the end of a block belong to its body.
    pub(super) comment: usize,
}

/// The blocks that are open.
#[derive(Default)]
pub(super) struct Blocks {
    open: Vec<Block>,
}

enum Block {
    If,
    Case,
    /// With the label that ends it.
    Do(String),
    /// A section or macro.
    Area,
}

/// What a statement does to the open blocks.
enum Effect {
    Opens(Block),
    /// A further part of the innermost block.
    Parts,
    /// Ends the innermost block.
    Ends,
    /// Ends a section or macro and all that is still open in it.
    EndsArea,
    Nothing,
}

impl Blocks {
    /// The place of the next statement.
    pub(super) fn place(&mut self, statement: &Statement<'_>) -> Depth {
        let tokens: Vec<_> = statement.tokens.iter().map(|placed| placed.1).collect();
        let (label, tokens) = match tokens.as_slice() {
            [Token::Label(label), rest @ ..] => (Some(normal(label)), rest),
            all => (None, all),
        };
        let depth = self.open.len();
        match effect(tokens) {
            Effect::Opens(block) => {
                self.open.push(block);
                Depth { statement: depth, comment: depth }
            }
            Effect::Parts => {
                let outside = depth.saturating_sub(1);
                Depth { statement: outside, comment: outside }
            }
            Effect::Ends => {
                self.open.pop();
                self.end_loop(label.as_deref());
                Depth { statement: depth.saturating_sub(1), comment: depth }
            }
            Effect::EndsArea => {
                self.open.clear();
                Depth { statement: 0, comment: 1 }
            }
            Effect::Nothing => {
                let ended = self.end_loop(label.as_deref());
                let marks_end = ended && matches!(tokens, [Token::Contin]);
                Depth { statement: depth - usize::from(marks_end), comment: depth }
            }
        }
    }

    /// Ends the innermost block when it is a DO up to this label.
    fn end_loop(&mut self, label: Option<&str>) -> bool {
        let ends = matches!((self.open.last(), label), (Some(Block::Do(end)), Some(label)) if end == label);
        if ends {
            self.open.pop();
        }
        ends
    }
}

fn effect(tokens: &[Token<'_>]) -> Effect {
    match tokens {
        [Token::If, .., Token::Then] => Effect::Opens(Block::If),
        [Token::ElseIf | Token::Else | Token::When, ..] => Effect::Parts,
        [Token::EndIf | Token::EndCas, ..] => Effect::Ends,
        [Token::Case, ..] => Effect::Opens(Block::Case),
        [Token::Do, Token::Slash, Token::Name(label) | Token::Integer(label), ..] => {
            Effect::Opens(Block::Do(normal(label)))
        }
        [Token::Cimfil, Token::Slash, Token::Name(word), ..] => {
            if word.eq_ignore_ascii_case("OFF") {
                Effect::EndsArea
            } else {
                Effect::Opens(Block::Area)
            }
        }
        [Token::Name(_), Token::Equals, Token::Macro, ..] => Effect::Opens(Block::Area),
        [Token::Termac, ..] => Effect::EndsArea,
        _ => Effect::Nothing,
    }
}

/// A label as labels are compared: in upper case, without leading zeros.
fn normal(label: &str) -> String {
    let digits = label.bytes().all(|byte| byte.is_ascii_digit());
    let significant = if digits { label.trim_start_matches('0') } else { label };
    significant.to_ascii_uppercase()
}
