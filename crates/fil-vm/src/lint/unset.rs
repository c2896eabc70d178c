//! W0221 and W0249: names that no statement sets, and letters among them.

use super::context::Context;
use crate::compile::names::letter;
use crate::errors::LintCode;
use crate::resolve::{Role, SymbolKind};

/// Warns at the first place where each of them is read.
pub(super) fn look(context: &mut Context<'_>) {
    letters(context);
    let variables = context.program.resolution.of_kind(SymbolKind::Variable);
    for symbol in variables.filter(|symbol| symbol.definitions.is_empty()) {
        let is_read = |role| {
            matches!(role, Role::Read | Role::Operand | Role::When | Role::Argument | Role::Text)
        };
        if let Some(first) = symbol.uses.iter().find(|used| is_read(used.role)) {
            let message = format!("no statement sets {}", symbol.name);
            context.diags.push(context.at(LintCode::NeverAssigned, first.location, message));
        }
    }
}

/// Letters that are operands: as the number of an address that is hardly meant.
fn letters(context: &mut Context<'_>) {
    let letters = context.program.resolution.of_kind(SymbolKind::Letter);
    for symbol in letters.filter(|symbol| symbol.definitions.is_empty()) {
        let Some(number) = letter(&symbol.name) else { continue };
        if let Some(first) = symbol.uses.iter().find(|used| used.role == Role::Operand) {
            let message = format!("{} is the number {number} here", symbol.name);
            context.diags.push(context.at(LintCode::LetterInExpression, first.location, message));
        }
    }
}
