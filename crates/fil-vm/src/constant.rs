//! Values that are known before anything runs.

use fil_cl::Vocabulary;
use fil_syntax::tree::{BinaryOp, Expr, ExprKind, UnaryOp};

/// The value of an expression of numbers.
pub(crate) fn constant(expr: &Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Number(number) => Some(*number),
        ExprKind::Unary { op: UnaryOp::Minus, operand } => Some(-constant(operand)?),
        ExprKind::Unary { op: UnaryOp::Plus, operand } => constant(operand),
        ExprKind::Binary { op, left, right } => {
            let (left, right) = (constant(left)?, constant(right)?);
            match op {
                BinaryOp::Add => Some(left + right),
                BinaryOp::Sub => Some(left - right),
                BinaryOp::Mul => Some(left * right),
                BinaryOp::Div => Some(left / right),
                _ => None,
            }
        }
        _ => None,
    }
}

/// The same with ICODEF of a word.
pub(crate) fn code(expr: &Expr, vocabulary: &Vocabulary) -> Option<f64> {
    match &expr.kind {
        ExprKind::Call { name, args } if name.text == "ICODEF" => match args.as_slice() {
            [Expr { kind: ExprKind::Name(word), .. }] => {
                vocabulary.find(word).map(|id| vocabulary.code(id))
            }
            _ => None,
        },
        _ => constant(expr),
    }
}
