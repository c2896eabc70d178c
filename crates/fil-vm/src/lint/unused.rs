//! W0240 and W0241: macros that nobody calls and arrays that nobody uses.

use std::collections::HashSet;

use fil_syntax::tree::{Expr, ExprKind, Item, Name, Stmt, StmtKind, Target};

use super::context::{Context, Owner};
use super::flow::Action;
use super::walk::{self, calls};
use crate::compile::names::inner_bodies;
use crate::errors::LintCode;

/// Macros that the post calls itself.
const CALLED_BY_THE_POST: [&str; 5] = ["_REPOS", "_OUTPTP", "_OUTPUT", "_MCDWT", "_LSTWT"];

/// Warns of both. Files without a section are a library: what they hold is for
/// other files.
pub(super) fn look(context: &mut Context<'_>) {
    if context.sections().next().is_none() {
        return;
    }
    let (called, used) = uses(context);
    let mut found = Vec::new();
    for body in &context.bodies {
        let Owner::Macro(definition) = body.owner else { continue };
        let name = definition.name.text.as_str();
        if !called.contains(name) && !CALLED_BY_THE_POST.contains(&name) {
            let message = format!("nothing calls {name}");
            let span = definition.name.span;
            found.push(context.diag(LintCode::UnusedMacro, body.unit, span, message));
        }
    }
    for (unit, array) in arrays(context) {
        if !used.contains(array.text.as_str()) {
            let message = format!("no statement uses {}", array.text);
            found.push(context.diag(LintCode::UnusedArray, unit, array.span, message));
        }
    }
    context.diags.extend(found);
}

/// Names of the macros that are called and of the arrays that are used.
fn uses<'t>(context: &Context<'t>) -> (HashSet<&'t str>, HashSet<&'t str>) {
    let (mut called, mut used) = (HashSet::new(), HashSet::new());
    for body in &context.bodies {
        for node in &body.graph.nodes {
            calls(node.action, &mut |name, args, _| {
                used.insert(name.text.as_str());
                if let [Expr { kind: ExprKind::Name(array), .. }] = args {
                    // SIZEF names an array without a subscript.
                    used.insert(array);
                }
            });
            let (Action::Plain(stmt) | Action::DoEnter(stmt)) = node.action else { continue };
            match &stmt.kind {
                StmtKind::Call { name, .. } => {
                    called.insert(name.text.as_str());
                }
                StmtKind::Assign { target: Target { name, index: Some(_) }, .. }
                | StmtKind::Text { target: Target { name, index: Some(_) }, .. } => {
                    used.insert(name.text.as_str());
                }
                _ => {}
            }
        }
        let Owner::Macro(definition) = body.owner else { continue };
        for default in definition.params.iter().filter_map(|(_, default)| default.as_ref()) {
            walk::within(default, walk::Use::Value, &mut |expr, _| {
                if let ExprKind::Call { name, .. } = &expr.kind {
                    used.insert(name.text.as_str());
                }
            });
        }
    }
    (called, used)
}

/// Arrays of RESERV statements.
fn arrays<'t>(context: &Context<'t>) -> Vec<(usize, &'t Name)> {
    let mut arrays = Vec::new();
    for (number, unit) in context.program.units.iter().enumerate() {
        for item in &unit.program.items {
            let body = match item {
                Item::Stmt(stmt) => std::slice::from_ref(stmt),
                Item::Section(section) => &section.body,
                Item::Macro(definition) => &definition.body,
            };
            reserved(number, body, &mut arrays);
        }
    }
    arrays
}

fn reserved<'t>(unit: usize, body: &'t [Stmt], arrays: &mut Vec<(usize, &'t Name)>) {
    for stmt in body {
        if let StmtKind::Reserv { arrays: names } = &stmt.kind {
            arrays.extend(names.iter().map(|(name, _): &(Name, Expr)| (unit, name)));
        }
        inner_bodies(stmt, &mut |inner| reserved(unit, inner, arrays));
    }
}
