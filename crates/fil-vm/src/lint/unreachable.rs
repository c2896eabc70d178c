//! W0232: statements that no way leads to.

use fil_syntax::tree::StmtKind;

use super::context::Context;
use super::flow::{Action, ENTRY};
use crate::errors::LintCode;

/// Warns of the first statement of each stretch that never runs.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found = Vec::new();
    for body in &context.bodies {
        let mut covered = body.graph.reached(ENTRY, |_| true);
        for at in 0..body.graph.nodes.len() {
            let node = &body.graph.nodes[at];
            if covered[at] || !does_something(node.action) {
                continue;
            }
            let message = "no way leads to this statement".to_string();
            found.push(context.diag(LintCode::Unreachable, node.unit, node.span, message));
            for (covered, reached) in covered.iter_mut().zip(body.graph.reached(at, |_| true)) {
                *covered |= reached;
            }
        }
    }
    context.diags.extend(found);
}

/// False for what has no effect of its own and is often only there for its label.
fn does_something(action: Action<'_>) -> bool {
    match action {
        Action::Plain(stmt) => !matches!(
            stmt.kind,
            StmtKind::Contin
                | StmtKind::Fini
                | StmtKind::Reserv { .. }
                | StmtKind::Print { .. }
                | StmtKind::Redef { .. }
                | StmtKind::Includ { .. }
        ),
        Action::Entry | Action::Exit | Action::DoNext => false,
        _ => true,
    }
}
