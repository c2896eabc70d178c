//! W0233 and W0250: a WHEN for a value that an earlier WHEN takes, and one without
//! statements before another.

use fil_syntax::tree::{Expr, ExprKind, Span, Stmt, StmtKind, When};

use super::context::{Context, Owner};
use crate::constant::code;
use crate::errors::LintCode;
use fil_syntax::walk::inner_bodies;

/// A value of a WHEN that is the same in every run.
#[derive(PartialEq)]
enum Value<'t> {
    Number(f64),
    Text(&'t str),
}

/// Warns of the second WHEN, and of the empty one.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found: Vec<(usize, LintCode, Span)> = Vec::new();
    for (number, unit) in context.program.units.iter().enumerate() {
        for item in &unit.program.items {
            if let fil_syntax::tree::Item::Stmt(stmt) = item {
                statements(context, number, std::slice::from_ref(stmt), &mut found);
            }
        }
    }
    for body in &context.bodies {
        let statements_of = match body.owner {
            Owner::Globals => continue,
            Owner::Section(section) => &section.body,
            Owner::Macro(definition) => &definition.body,
        };
        statements(context, body.unit, statements_of, &mut found);
    }
    for (unit, code, span) in found {
        let message = match code {
            LintCode::EmptyWhen => "no statement between this WHEN and the next",
            _ => "an earlier WHEN of this CASE takes this value",
        };
        context.report(code, unit, span, message.to_string());
    }
}

fn statements(
    context: &Context<'_>,
    unit: usize,
    body: &[Stmt],
    found: &mut Vec<(usize, LintCode, Span)>,
) {
    for stmt in body {
        if let StmtKind::Case { whens, .. } = &stmt.kind {
            let doubles = doubles(context, whens).into_iter();
            found.extend(doubles.map(|span| (unit, LintCode::SameWhen, span)));
            let followed = whens.split_last().map_or(&[][..], |(_, followed)| followed);
            let empty = followed.iter().filter(|when| when.body.is_empty());
            found.extend(empty.map(|when| (unit, LintCode::EmptyWhen, when.span)));
        }
        inner_bodies(stmt, &mut |inner| statements(context, unit, inner, found));
    }
}

fn doubles(context: &Context<'_>, whens: &[When]) -> Vec<Span> {
    let mut taken: Vec<Value<'_>> = Vec::new();
    let mut doubles = Vec::new();
    for value in whens.iter().flat_map(|when| &when.values) {
        match constant(context, value) {
            Some(known) if taken.contains(&known) => doubles.push(value.span),
            Some(new) => taken.push(new),
            None => {}
        }
    }
    doubles
}

fn constant<'t>(context: &Context<'_>, expr: &'t Expr) -> Option<Value<'t>> {
    match &expr.kind {
        ExprKind::Text(text) => Some(Value::Text(text)),
        _ => code(expr, context.vocabulary).map(Value::Number),
    }
}
