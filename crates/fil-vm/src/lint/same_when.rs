//! W0233 and W0250: a WHEN for a value that an earlier WHEN takes, and one without
//! statements before another.

use fil_syntax::tree::{Expr, ExprKind, Span, StmtKind, When};

use super::context::Context;
use crate::constant::code;
use crate::errors::LintCode;

/// A value of a WHEN that is the same in every run.
#[derive(PartialEq)]
enum Value<'t> {
    Number(f64),
    Text(&'t str),
}

/// Warns of the second WHEN, and of the empty one.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found: Vec<(usize, LintCode, Span)> = Vec::new();
    context.each_statement(&mut |unit, stmt| {
        let StmtKind::Case { whens, .. } = &stmt.kind else { return };
        let doubles = doubles(context, whens).into_iter();
        found.extend(doubles.map(|span| (unit, LintCode::SameWhen, span)));
        let followed = whens.split_last().map_or(&[][..], |(_, followed)| followed);
        let empty = followed.iter().filter(|when| when.body.is_empty());
        found.extend(empty.map(|when| (unit, LintCode::EmptyWhen, when.span)));
    });
    for (unit, code, span) in found {
        let message = match code {
            LintCode::EmptyWhen => "no statement between this WHEN and the next",
            _ => "an earlier WHEN of this CASE takes this value",
        };
        context.report(code, unit, span, message.to_string());
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
