//! W0237: .EQ. and .NE. of reals that come from arithmetic.

use std::collections::HashMap;

use fil_syntax::tree::{BinaryOp, Expr, ExprKind, StmtKind};

use super::context::{Context, Owner};
use super::flow::Action;
use super::walk::expressions;
use crate::builtins::{self, BUILTINS, FunctionKind};
use crate::constant::constant;
use crate::errors::LintCode;
use crate::library::Library;

/// How exact a value is, from the most exact on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
enum Exactness {
    /// A whole number: a code, a count, or computed from those.
    #[default]
    Whole,
    /// A value as it was read or written down, not computed with.
    Given,
    /// What arithmetic on reals gives: rounding has a part in it.
    Computed,
}

use Exactness::{Computed, Given, Whole};

type Names<'t> = HashMap<&'t str, Exactness>;

/// Built-in functions of numbers whose result is a whole number.
const WHOLE_RESULTS: [&str; 3] = ["INTF", "NINTF", "ROUNDF"];

/// Built-in functions whose result is as exact as their arguments.
const PASS_ON: [&str; 7] = ["ABSF", "MAXF", "MINF", "MAX1F", "MIN1F", "MODF", "SIGNF"];

/// Warns of each comparison with a computed side.
pub(super) fn look(context: &mut Context<'_>) {
    let names = settled(context);
    let mut found = Vec::new();
    for body in &context.bodies {
        for node in &body.graph.nodes {
            expressions(node.action, &mut |expr, _| {
                let ExprKind::Binary { op: BinaryOp::Eq | BinaryOp::Ne, left, right } = &expr.kind
                else {
                    return;
                };
                let sides = [left, right];
                if sides.iter().any(|side| is_rounded(side)) {
                    return;
                }
                let Some(side) = sides.iter().find(|side| exactness(side, &names) == Computed)
                else {
                    return;
                };
                let source = &context.program.units[node.unit].file.text;
                let shown = source.get(side.span.range()).unwrap_or("a side").trim();
                let message = format!("{shown} comes from arithmetic on reals");
                found.push(context.diag(LintCode::RealsCompared, node.unit, expr.span, message));
            });
        }
    }
    context.diags.extend(found);
}

/// The exactness of every name over all its assignments. It only ever gets
/// less, by two steps at most, so the passes end.
fn settled<'t>(context: &Context<'t>) -> Names<'t> {
    let assignments = assignments(context);
    let mut names = Names::new();
    loop {
        let mut changed = false;
        for (name, values) in &assignments {
            for value in values {
                let now = value.map_or(Given, |value| exactness(value, &names));
                let known = names.entry(name).or_default();
                changed |= now > *known;
                *known = now.max(*known);
            }
        }
        if !changed {
            return names;
        }
    }
}

type Assignments<'t> = Vec<(&'t str, Vec<Option<&'t Expr>>)>;

/// What each name is set to; `None` for a text.
fn assignments<'t>(context: &Context<'t>) -> Assignments<'t> {
    let mut assignments = Assignments::new();
    for body in &context.bodies {
        for node in &body.graph.nodes {
            let (Action::Plain(stmt) | Action::DoEnter(stmt)) = node.action else { continue };
            match &stmt.kind {
                StmtKind::Assign { target, value } => {
                    assignments.push((&target.name.text, vec![Some(value)]));
                }
                StmtKind::Text { target, .. } => {
                    assignments.push((&target.name.text, vec![None]));
                }
                StmtKind::Do { variable, range, .. } => {
                    let values = [&range.from].into_iter().chain(&range.step).map(Some);
                    assignments.push((&variable.name.text, values.collect()));
                }
                StmtKind::Call { name, args } => {
                    let called = context.macros.get(name.text.as_str());
                    let Some(Owner::Macro(called)) =
                        called.map(|index| context.bodies[*index].owner)
                    else {
                        continue;
                    };
                    for (position, (given, value)) in args.iter().enumerate() {
                        let param = match given {
                            Some(given) => Some(given.text.as_str()),
                            None => called.params.get(position).map(|(p, _)| p.text.as_str()),
                        };
                        assignments.extend(param.map(|param| (param, vec![Some(value)])));
                    }
                }
                _ => {}
            }
        }
    }
    assignments
}

fn exactness(expr: &Expr, names: &Names<'_>) -> Exactness {
    if let Some(number) = constant(expr) {
        return if number.fract() == 0.0 { Whole } else { Given };
    }
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Text(_) => Given,
        ExprKind::Name(name) => names.get(name.as_str()).copied().unwrap_or_default(),
        ExprKind::Unary { operand, .. } => exactness(operand, names),
        ExprKind::Binary { op, left, right } => {
            binary(*op, exactness(left, names), exactness(right, names))
        }
        ExprKind::Call { name, args } => call(&name.text, args, names),
    }
}

/// INTF and its like: compared with them, a value is tested for being whole.
fn is_rounded(expr: &Expr) -> bool {
    matches!(&expr.kind, ExprKind::Call { name, .. } if WHOLE_RESULTS.contains(&name.text.as_str()))
}

fn binary(op: BinaryOp, left: Exactness, right: Exactness) -> Exactness {
    match (op, left, right) {
        (BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul, Whole, Whole) => Whole,
        // A counter that begins with a value of the record.
        (BinaryOp::Add | BinaryOp::Sub, Given, Whole) => Given,
        (BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div | BinaryOp::Pow, ..) => {
            Computed
        }
        // Comparisons and logical operations give 0 or 1.
        _ => Whole,
    }
}

fn call(name: &str, args: &[Expr], names: &Names<'_>) -> Exactness {
    if let Some(exactness) = names.get(name) {
        return *exactness;
    }
    let Some(builtin) = builtins::find(name).map(|index| &BUILTINS[index]) else { return Given };
    match builtin.kind {
        FunctionKind::WordCode
        | FunctionKind::HasWord
        | FunctionKind::Size
        | FunctionKind::File => Whole,
        FunctionKind::Library(
            Library::Length | Library::Position | Library::Compare | Library::CharacterCode,
            ..,
        ) => Whole,
        _ if WHOLE_RESULTS.contains(&name) => Whole,
        _ if PASS_ON.contains(&name) => {
            args.iter().map(|arg| exactness(arg, names)).max().unwrap_or_default()
        }
        FunctionKind::Numbers(..) | FunctionKind::Fold(_) => Computed,
        _ => Given,
    }
}
