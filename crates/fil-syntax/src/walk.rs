//! Walking over trees.

use crate::tree::{Expr, ExprKind, Stmt, StmtKind, Target};

/// The statement lists inside a statement.
pub fn inner_bodies<'t>(stmt: &'t Stmt, visit: &mut dyn FnMut(&'t [Stmt])) {
    match &stmt.kind {
        StmtKind::If { arms, otherwise } => {
            arms.iter().for_each(|(_, body)| visit(body));
            otherwise.iter().for_each(|body| visit(body));
        }
        StmtKind::IfOne { then, .. } => visit(std::slice::from_ref(then)),
        StmtKind::Do { body, .. } => visit(body),
        StmtKind::Case { whens, other, .. } => {
            whens.iter().for_each(|when| visit(&when.body));
            other.iter().for_each(|body| visit(body));
        }
        _ => {}
    }
}

/// Every expression of a statement, those inside of others too, but not those of the
/// statements inside of it.
pub fn all_expressions<'t>(stmt: &'t Stmt, visit: &mut dyn FnMut(&'t Expr)) {
    expressions(stmt, &mut |expr| within(expr, visit));
}

/// The expressions of a statement, without those inside of them and those of the statements
/// inside of it.
pub fn expressions<'t>(stmt: &'t Stmt, visit: &mut dyn FnMut(&'t Expr)) {
    let mut all = |exprs: &mut dyn Iterator<Item = &'t Expr>| exprs.for_each(&mut *visit);
    let index = |target: &'t Target| target.index.as_deref().into_iter();
    match &stmt.kind {
        StmtKind::Assign { target, value } => all(&mut index(target).chain([value])),
        StmtKind::Text { target, args } => all(&mut index(target).chain(args)),
        StmtKind::Post { args, .. } => all(&mut args.iter()),
        StmtKind::If { arms, .. } => all(&mut arms.iter().map(|(condition, _)| condition)),
        StmtKind::IfOne { condition: value, .. } | StmtKind::IfSign { value, .. } => {
            all(&mut [value].into_iter());
        }
        StmtKind::Do { range, .. } => all(&mut range.values()),
        StmtKind::Case { subject, whens, .. } => {
            let values = whens.iter().flat_map(|when| &when.values);
            all(&mut [subject].into_iter().chain(values));
        }
        StmtKind::Call { args, .. } => all(&mut args.iter().map(|(_, value)| value)),
        StmtKind::PostText { .. }
        | StmtKind::Jump { .. }
        | StmtKind::Reserv { .. }
        | StmtKind::Print { .. }
        | StmtKind::Redef { .. }
        | StmtKind::Includ { .. }
        | StmtKind::Contin
        | StmtKind::Fini => {}
    }
}

fn within<'t>(expr: &'t Expr, visit: &mut dyn FnMut(&'t Expr)) {
    visit(expr);
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Name(_) => {}
        ExprKind::Call { args, .. } => args.iter().for_each(|arg| within(arg, visit)),
        ExprKind::Unary { operand, .. } => within(operand, visit),
        ExprKind::Binary { left, right, .. } => {
            within(left, visit);
            within(right, visit);
        }
    }
}
