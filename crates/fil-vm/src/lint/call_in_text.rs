//! W0252: a text without quotes with a call of a function in it, which is written as it stands.

use fil_syntax::tree::{Span, StmtKind};

use super::context::Context;
use crate::builtins::BUILTINS;
use crate::errors::LintCode;

/// Warns at the statement.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found: Vec<(usize, Span, &str)> = Vec::new();
    context.each_statement(&mut |unit, stmt| {
        if let StmtKind::PostText { text, .. } = &stmt.kind
            && let Some(name) = called(text)
        {
            found.push((unit, stmt.span, name));
        }
    });
    for (unit, span, name) in found {
        let message = format!("{name} is part of the text, and is not called");
        context.report(LintCode::CallInText, unit, span, message);
    }
}

/// The first word before a bracket that is a function of FIL.
fn called(text: &str) -> Option<&str> {
    let brackets = text.match_indices('(').map(|(at, _)| &text[..at]);
    let words = brackets.filter_map(|before| {
        before.rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_').next()
    });
    let is_function = |word: &str| {
        word.eq_ignore_ascii_case("POSTF")
            || BUILTINS.iter().any(|row| row.name.eq_ignore_ascii_case(word))
    };
    words.filter(|word| !word.is_empty()).find(|word| is_function(word))
}
