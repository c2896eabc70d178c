//! W0239: POSTN and REPEAT of letters that the machine does not write.

use std::collections::HashSet;

use fil_syntax::tree::{Expr, ExprKind, StmtKind};

use super::context::Context;
use super::flow::Action;
use super::walk::calls;
use crate::compile::names::letter;
use crate::constant::constant;
use crate::errors::LintCode;
use crate::postf::PostfOp;

/// Letters of the second set of tape positions, INTCOM 27 to 52, follow the first.
const LETTERS: u8 = 26;

/// Warns of letters without a tape position, but for those whose position the
/// program sets itself.
pub(super) fn look(context: &mut Context<'_>) {
    let Some(writes) = context.facts.writes_letter else { return };
    let moved = moved_letters(context);
    let mut found = Vec::new();
    for body in &context.bodies {
        for node in &body.graph.nodes {
            let Action::Plain(stmt) = node.action else { continue };
            let StmtKind::Post { word, args } = &stmt.kind else { continue };
            for arg in addresses(&word.text, args) {
                let Some(number) = address(context, arg) else { continue };
                if !writes(number) && !moved.contains(&number) {
                    let name = char::from(b'A' + number - 1);
                    let message = format!("the machine has no tape position for {name}");
                    found.push(context.diag(LintCode::NoAddress, node.unit, arg.span, message));
                }
            }
        }
    }
    context.diags.extend(found);
}

/// The arguments of a post word that stand for addresses.
fn addresses<'t>(word: &str, args: &'t [Expr]) -> impl Iterator<Item = &'t Expr> {
    let first = match word {
        "POSTN" => 1,
        "REPEAT" => 0,
        _ => args.len(),
    };
    args.iter().skip(first).step_by(2)
}

fn address(context: &Context<'_>, arg: &Expr) -> Option<u8> {
    let number = match &arg.kind {
        ExprKind::Name(name) if !context.is_assigned(name) => letter(name)?,
        _ => constant(arg)?,
    };
    let is_letter = number.fract() == 0.0 && (1.0..=f64::from(LETTERS)).contains(&number);
    is_letter.then_some(number as u8)
}

/// Letters whose tape position some POSTF(2,1,n,…) sets.
fn moved_letters(context: &Context<'_>) -> HashSet<u8> {
    let mut moved = HashSet::new();
    for body in &context.bodies {
        for node in &body.graph.nodes {
            calls(node.action, &mut |name, args, _| {
                if context.postf(&name.text, args) != Some(PostfOp::SetCommon) {
                    return;
                }
                let [_, kind, location, _] = args else { return };
                if let (Some(1.0), Some(location)) = (constant(kind), constant(location))
                    && (1.0..=2.0 * f64::from(LETTERS)).contains(&location)
                {
                    moved.insert((location as u8 - 1) % LETTERS + 1);
                }
            });
        }
    }
    moved
}
