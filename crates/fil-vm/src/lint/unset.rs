//! W0221: names that no statement sets.

use super::context::Context;
use crate::errors::LintCode;
use crate::resolve::{Role, SymbolKind};

/// Warns at the first place where each of them is read.
pub(super) fn look(context: &mut Context<'_>) {
    let variables = context.program.resolution.of_kind(SymbolKind::Variable);
    for symbol in variables.filter(|symbol| symbol.definitions.is_empty()) {
        let is_read = |role| matches!(role, Role::Read | Role::When | Role::Argument | Role::Text);
        if let Some(first) = symbol.uses.iter().find(|used| is_read(used.role)) {
            let message = format!("no statement sets {}", symbol.name);
            context.diags.push(context.at(LintCode::NeverAssigned, first.location, message));
        }
    }
}
