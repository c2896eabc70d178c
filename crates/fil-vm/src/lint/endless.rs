//! W0238: loops that no way leads out of.

use fil_syntax::tree::StmtKind;

use super::context::Context;
use super::flow::{Action, ENTRY};
use crate::constant::constant;
use crate::errors::LintCode;

/// Warns at the statement that leads back, and at a DO with step 0.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found = Vec::new();
    for body in &context.bodies {
        let reached = body.graph.reached(ENTRY, |_| true);
        let leaves = body.graph.can_leave();
        for (at, node) in body.graph.nodes.iter().enumerate() {
            if !reached[at] {
                continue;
            }
            let message = match node.action {
                Action::DoEnter(stmt) if has_step_zero(&stmt.kind) => "this DO has step 0",
                Action::Jump | Action::Decide(_)
                    if !leaves[at] && node.next.iter().any(|next| *next <= at) =>
                {
                    "this jump leads back, and no way leads out"
                }
                _ => continue,
            };
            found.push(context.diag(
                LintCode::EndlessLoop,
                node.unit,
                node.span,
                message.to_string(),
            ));
        }
    }
    context.diags.extend(found);
}

fn has_step_zero(kind: &StmtKind) -> bool {
    match kind {
        StmtKind::Do { range, .. } => range.step.as_ref().and_then(constant) == Some(0.0),
        _ => false,
    }
}
