//! W0221: names that no statement sets.

use std::collections::HashSet;

use super::context::{Context, Owner};
use super::walk::{self, Use};
use crate::compile::names::letter;
use crate::errors::LintCode;
use fil_syntax::tree::ExprKind;

/// Warns at the first place where each of them is read.
pub(super) fn look(context: &mut Context<'_>) {
    let mut seen = HashSet::new();
    let mut found = Vec::new();
    for body in &context.bodies {
        let mut note = |unit, name: &str, span| {
            if !context.is_assigned(name) && seen.insert(name.to_string()) {
                let message = format!("no statement sets {name}");
                found.push(context.diag(LintCode::NeverAssigned, unit, span, message));
            }
        };
        for node in &body.graph.nodes {
            context.reads(body.owner, node.action, &mut |name, span| note(node.unit, name, span));
        }
        // A default is a value of the macro's file and sees no parameters.
        let Owner::Macro(definition) = body.owner else { continue };
        for default in definition.params.iter().filter_map(|(_, default)| default.as_ref()) {
            walk::within(default, Use::Value, &mut |expr, _| match &expr.kind {
                ExprKind::Name(name) if letter(name).is_none() => note(body.unit, name, expr.span),
                _ => {}
            });
        }
    }
    context.diags.extend(found);
}
