//! W0236: common locations that nothing is known of.

use super::context::Context;
use super::walk::calls;
use crate::constant::constant;
use crate::errors::LintCode;
use crate::host::CommonKind;
use crate::postf::PostfOp;

/// The three commons with the type numbers POSTF takes.
const KINDS: [(f64, CommonKind, &str); 3] = [
    (1.0, CommonKind::Int, "INTCOM"),
    (2.0, CommonKind::Rel, "RELCOM"),
    (3.0, CommonKind::Dbl, "DBLCOM"),
];

/// Warns of constant locations without a name; one of the same number in
/// another common is suggested.
pub(super) fn look(context: &mut Context<'_>) {
    let Some(name_of) = context.facts.name_of_common else { return };
    let mut found = Vec::new();
    for body in &context.bodies {
        for node in &body.graph.nodes {
            calls(node.action, &mut |name, args, call| {
                let is_common = matches!(
                    context.postf(&name.text, args),
                    Some(PostfOp::GetCommon | PostfOp::SetCommon | PostfOp::ClearCommon)
                );
                let Some((kind, title, location)) = (if is_common { location(args) } else { None })
                else {
                    return;
                };
                if name_of(kind, location).is_some() {
                    return;
                }
                let message = format!("nothing is known of {title} {location}");
                let mut diag = context.diag(LintCode::UnnamedCommon, node.unit, call.span, message);
                diag.hint = KINDS.iter().find_map(|(number, other, title)| {
                    let near = name_of(*other, location)?;
                    Some(format!("{title} {location} is {near}; its type is {number}"))
                });
                found.push(diag);
            });
        }
    }
    context.diags.extend(found);
}

/// Type and location of POSTF(1/2/3,type,location,…), both constant.
pub(super) fn location(args: &[fil_syntax::tree::Expr]) -> Option<(CommonKind, &'static str, u32)> {
    let [_, kind, location, ..] = args else { return None };
    let (kind, location) = (constant(kind)?, constant(location)?);
    let (_, kind, title) = KINDS.iter().find(|(number, ..)| *number == kind)?;
    let whole = location.fract() == 0.0 && (1.0..=f64::from(u16::MAX)).contains(&location);
    whole.then_some((*kind, *title, location as u32))
}
