//! W0234 and W0235: labels that nothing names, and jumps into blocks.

use std::collections::{HashMap, HashSet};

use super::context::Context;
use crate::errors::LintCode;

/// Warns of both; a jump into a DO is an error of the compiler.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found = Vec::new();
    for body in &context.bodies {
        let graph = &body.graph;
        let jumps = graph.jumps.iter().map(|jump| jump.name.text.as_str());
        let used: HashSet<&str> = jumps.chain(graph.loop_ends.iter().copied()).collect();
        for label in &graph.labels {
            if !used.contains(label.name.text.as_str()) {
                let message = format!("nothing jumps to {}", label.name.text);
                let span = label.name.span;
                found.push(context.diag(LintCode::UnusedLabel, label.unit, span, message));
            }
        }
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
