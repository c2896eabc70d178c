//! W0234 and W0235: labels that nothing names, and jumps into blocks.

use std::collections::HashMap;

use super::context::Context;
use crate::errors::LintCode;
use crate::resolve::SymbolKind;

/// Warns of both; a jump into a DO is an error of the compiler.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found = Vec::new();
    let labels = context.program.resolution.of_kind(SymbolKind::Label);
    for label in labels.filter(|label| label.uses.is_empty()) {
        for definition in &label.definitions {
            let message = format!("nothing jumps to {}", label.name);
            found.push(context.at(LintCode::UnusedLabel, *definition, message));
        }
    }
    for body in &context.bodies {
        let graph = &body.graph;
        let blocks: HashMap<&str, &[u32]> = graph
            .labels
            .iter()
            .map(|label| (label.name.text.as_str(), label.blocks.as_slice()))
            .collect();
        for jump in &graph.jumps {
            let into = blocks.get(jump.name.text.as_str());
            if into.is_some_and(|blocks| !jump.blocks.starts_with(blocks)) {
                let message = format!(
                    "{} lies inside a part of an IF or CASE that this jump is outside of",
                    jump.name.text
                );
                let span = jump.name.span;
                found.push(context.diag(LintCode::JumpIntoBlock, jump.unit, span, message));
            }
        }
    }
    context.diags.extend(found);
}
