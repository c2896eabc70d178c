//! Conditions: comparisons become one operation that compares and jumps.

use fil_syntax::tree::{BinaryOp, Expr, ExprKind, UnaryOp};

use super::Compiler;
use super::chunk::Label;
use crate::ops::{Op, Reg};

impl Compiler<'_> {
    /// Jumps to a label further on when the condition is `wanted`, else goes on here.
    pub(super) fn branch(&mut self, condition: &Expr, wanted: bool, to: Label) {
        self.deeper(condition.span, (), |this| {
            let mark = this.mark();
            this.branch_on(condition, wanted, to);
            this.release(mark);
        });
    }

    fn branch_on(&mut self, condition: &Expr, wanted: bool, to: Label) {
        match &condition.kind {
            ExprKind::Unary { op: UnaryOp::Not, operand } => self.branch(operand, !wanted, to),
            ExprKind::Binary { op: op @ (BinaryOp::And | BinaryOp::Or), left, right } => {
                // One operand decides alone when it is the value that settles the operator.
                let settles = *op == BinaryOp::Or;
                if wanted == settles {
                    self.branch(left, wanted, to);
                    self.branch(right, wanted, to);
                } else {
                    let settled = self.chunk.label();
                    self.branch(left, settles, settled);
                    self.branch(right, wanted, to);
                    self.chunk.place(settled);
                }
            }
            ExprKind::Binary { op, left, right } if is_comparison(*op) => {
                let (a, b) = (self.expression(left), self.expression(right));
                let op = if wanted { *op } else { opposite(*op) };
                self.chunk.emit_to(to, |to| comparison(op, a, b, to));
            }
            _ => {
                let a = self.expression(condition);
                let op = |to| {
                    if wanted { Op::JumpTrue { a, to } } else { Op::JumpFalse { a, to } }
                };
                self.chunk.emit_to(to, op);
            }
        }
    }

    /// 1 or 0 from a logical expression.
    pub(super) fn logical_value(&mut self, expr: &Expr, dst: Reg) {
        let (no, end) = (self.chunk.label(), self.chunk.label());
        let (one, zero) = (self.number(1.0, expr.span), self.number(0.0, expr.span));
        self.branch(expr, false, no);
        self.chunk.emit(Op::Move { dst, src: one });
        self.chunk.jump(end);
        self.chunk.place(no);
        self.chunk.emit(Op::Move { dst, src: zero });
        self.chunk.place(end);
    }
}

/// True for an expression whose value is true or false by its form.
pub(super) fn is_logical(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Unary { op, .. } => *op == UnaryOp::Not,
        ExprKind::Binary { op, .. } => {
            is_comparison(*op) || matches!(op, BinaryOp::And | BinaryOp::Or)
        }
        _ => false,
    }
}

fn is_comparison(op: BinaryOp) -> bool {
    use BinaryOp::{Eq, Ge, Gt, Le, Lt, Ne};
    matches!(op, Eq | Ne | Lt | Le | Gt | Ge)
}

/// The comparison that holds exactly when `op` does not: values are never NaN.
fn opposite(op: BinaryOp) -> BinaryOp {
    match op {
        BinaryOp::Eq => BinaryOp::Ne,
        BinaryOp::Ne => BinaryOp::Eq,
        BinaryOp::Lt => BinaryOp::Ge,
        BinaryOp::Le => BinaryOp::Gt,
        BinaryOp::Gt => BinaryOp::Le,
        BinaryOp::Ge => BinaryOp::Lt,
        other => other,
    }
}

fn comparison(op: BinaryOp, a: Reg, b: Reg, to: u16) -> Op {
    match op {
        BinaryOp::Eq => Op::JumpEq { a, b, to },
        BinaryOp::Lt => Op::JumpLt { a, b, to },
        BinaryOp::Le => Op::JumpLe { a, b, to },
        BinaryOp::Gt => Op::JumpLt { a: b, b: a, to },
        BinaryOp::Ge => Op::JumpLe { a: b, b: a, to },
        _ => Op::JumpNe { a, b, to },
    }
}
