//! What the machine says of values that POSTF(2) and POSTF(3) store: locations without
//! effect, values without a meaning.

use std::collections::HashSet;

use super::commons::location;
use super::context::Context;
use super::walk::calls;
use crate::constant::constant;
use crate::postf::PostfOp;
use crate::value::EMPTY;

/// Reports each finding once for each location and code.
pub(super) fn look(context: &mut Context<'_>) {
    let (Some(storing), Some(name_of)) = (context.facts.storing, context.facts.name_of_common)
    else {
        return;
    };
    let mut found = Vec::new();
    let mut seen = HashSet::new();
    for body in &context.bodies {
        for node in &body.graph.nodes {
            calls(node.action, &mut |name, args, call| {
                let value = match context.postf(&name.text, args) {
                    Some(PostfOp::SetCommon) => args.get(3).and_then(constant),
                    Some(PostfOp::ClearCommon) => Some(EMPTY),
                    _ => return,
                };
                // A location without a name is reported as such.
                let Some((kind, _, location)) =
                    location(args).filter(|(kind, _, number)| name_of(*kind, *number).is_some())
                else {
                    return;
                };
                let Some(diag) = storing(kind, location, value) else { return };
                if diag.is_error() || seen.insert((kind, location)) {
                    let file = &context.program.units[node.unit].file;
                    found.push(diag.at(file.place(call.span)));
                }
            });
        }
    }
    context.diags.extend(found);
}
