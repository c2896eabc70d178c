//! Walking over expressions: values, words and constants.

use fil_syntax::tree::{Expr, ExprKind, Name, Stmt, StmtKind, Target};

use super::flow::Action;
use crate::builtins::{self, BUILTINS, FunctionKind};

/// How an expression is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Use {
    /// For its value.
    Value,
    /// As an argument where a bare name may be a word instead of a variable.
    PostArgument,
}

/// Every expression an action evaluates, those inside of others too.
pub(crate) fn expressions<'t>(action: Action<'t>, visit: &mut dyn FnMut(&'t Expr, Use)) {
    match action {
        Action::Entry | Action::Exit | Action::DoNext | Action::Jump => {}
        Action::Decide(expr) => within(expr, Use::Value, visit),
        Action::When(when) => when.values.iter().for_each(|v| within(v, Use::Value, visit)),
        Action::Plain(stmt) | Action::DoEnter(stmt) => statement(stmt, visit),
    }
}

fn statement<'t>(stmt: &'t Stmt, visit: &mut dyn FnMut(&'t Expr, Use)) {
    let mut value = |expr| within(expr, Use::Value, visit);
    let index = |target: &'t Target| target.index.as_deref();
    match &stmt.kind {
        StmtKind::Assign { target, value: source } => {
            index(target).into_iter().for_each(&mut value);
            value(source);
        }
        StmtKind::Text { target, args } => {
            index(target).into_iter().for_each(&mut value);
            // The first may be a word that says what to do with the others.
            args.iter().for_each(|arg| within(arg, Use::PostArgument, visit));
        }
        // A table of constants, known before anything runs.
        StmtKind::Post { word, .. } if word.text == "DATA" => {}
        StmtKind::Post { word, args } if builtins::is_statement(&word.text) => {
            args.iter().for_each(value);
        }
        StmtKind::Post { args, .. } => {
            args.iter().for_each(|arg| within(arg, Use::PostArgument, visit));
        }
        StmtKind::Do { range, .. } => range.values().for_each(value),
        StmtKind::Call { args, .. } => args.iter().for_each(|(_, arg)| value(arg)),
        _ => {}
    }
}

/// An expression and those inside of it; a word that a function names is none.
pub(crate) fn within<'t>(expr: &'t Expr, used: Use, visit: &mut dyn FnMut(&'t Expr, Use)) {
    visit(expr, used);
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Name(_) => {}
        ExprKind::Call { name, args } => {
            let word = word_argument(name);
            let used = arguments_use(name);
            for (index, arg) in args.iter().enumerate() {
                if word != Some(index) {
                    within(arg, used, visit);
                }
            }
        }
        ExprKind::Unary { operand, .. } => within(operand, Use::Value, visit),
        ExprKind::Binary { left, right, .. } => {
            within(left, Use::Value, visit);
            within(right, Use::Value, visit);
        }
    }
}

/// Functions of texts take words such as TRIM among their arguments.
fn arguments_use(function: &Name) -> Use {
    match builtins::find(&function.text).map(|index| BUILTINS[index].kind) {
        Some(FunctionKind::Library(..)) => Use::PostArgument,
        _ => Use::Value,
    }
}

/// Which argument of a function is a word or name as it is written.
fn word_argument(function: &Name) -> Option<usize> {
    BUILTINS[builtins::find(&function.text)?].kind.word_argument()
}

/// Every function call or array element an action evaluates.
pub(crate) fn calls<'t>(action: Action<'t>, visit: &mut dyn FnMut(&'t Name, &'t [Expr], &'t Expr)) {
    expressions(action, &mut |expr, _| {
        if let ExprKind::Call { name, args } = &expr.kind {
            visit(name, args, expr);
        }
    });
}

/// The plain variable an action sets.
pub(crate) fn sets(action: Action<'_>) -> Option<&str> {
    match action {
        Action::Plain(stmt) | Action::DoEnter(stmt) => match &stmt.kind {
            StmtKind::Assign { target, .. }
            | StmtKind::Text { target, .. }
            | StmtKind::Do { variable: target, .. }
                if target.index.is_none() =>
            {
                Some(&target.name.text)
            }
            _ => None,
        },
        _ => None,
    }
}
