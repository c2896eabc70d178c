//! Expressions.

use fil_cl::WordId;
use fil_syntax::tree::{BinaryOp, Expr, ExprKind, Name, Span, UnaryOp};

use super::Compiler;
use super::conditions::is_logical;
use crate::builtins;
use crate::errors::CompileCode;
use crate::ops::{Op, Reg};
use crate::value::EMPTY;

impl Compiler<'_> {
    /// The register that holds the value of an expression: that of a variable
    /// or constant as it is, else a temporary.
    pub(super) fn expression(&mut self, expr: &Expr) -> Reg {
        if let Some(number) = self.constant(expr) {
            return self.number(number, expr.span);
        }
        if let Some(id) = self.word_code(expr) {
            return self.word_register(id, expr.span);
        }
        match &expr.kind {
            ExprKind::Text(text) => self.text(text, expr.span),
            ExprKind::Name(name) => self.variable(name, expr.span),
            ExprKind::Unary { op: UnaryOp::Plus, operand } => self.expression(operand),
            _ => {
                let dst = self.temporary(expr.span);
                self.expression_into(expr, dst);
                dst
            }
        }
    }

    /// Puts the value of an expression into a register.
    pub(super) fn expression_into(&mut self, expr: &Expr, dst: Reg) {
        self.deeper(expr.span, (), |this| {
            let mark = this.mark();
            this.evaluate(expr, dst);
            this.release(mark);
        });
    }

    fn evaluate(&mut self, expr: &Expr, dst: Reg) {
        if is_logical(expr) {
            self.logical_value(expr, dst);
            return;
        }
        if self.constant(expr).is_none() {
            match &expr.kind {
                ExprKind::Unary { op: UnaryOp::Minus, operand } => {
                    let src = self.expression(operand);
                    self.chunk.emit(Op::Neg { dst, src });
                    return;
                }
                ExprKind::Unary { op: UnaryOp::Plus, operand } => {
                    self.evaluate(operand, dst);
                    return;
                }
                ExprKind::Binary { op, left, right } => {
                    let (a, b) = (self.expression(left), self.expression(right));
                    self.chunk.emit(binary(*op, dst, a, b));
                    return;
                }
                ExprKind::Call { name, args } if self.word_code(expr).is_none() => {
                    self.call(name, args, expr.span, dst);
                    return;
                }
                _ => {}
            }
        }
        let src = self.expression(expr);
        self.chunk.emit(Op::Move { dst, src });
    }

    /// `NAME(args)`: an array element or a function.
    fn call(&mut self, name: &Name, args: &[Expr], span: Span, dst: Reg) {
        if let Some(array) = self.slots.names.array(&name.text) {
            match args {
                [index] => {
                    let index = self.expression(index);
                    self.chunk.emit(Op::Load { dst, array, index });
                }
                _ => self.wrong_count(&name.text, "one subscript", args.len(), span),
            }
        } else if name.text == "TEXT" {
            self.text_value(args, span, dst);
        } else if let Some(function) = builtins::find(&name.text) {
            self.builtin(function, args, span, dst);
        } else if let Some((function, arity)) = self.added_function(&name.text) {
            if usize::from(arity) == args.len() {
                let base = self.arguments(args, span);
                self.chunk.emit(Op::HostFunction { dst, function, base });
            } else {
                self.wrong_count(&name.text, &format!("{arity} arguments"), args.len(), span);
            }
        }
        // What is neither has been reported.
    }

    /// Index and number of arguments of a function of the embedding program.
    pub(super) fn added_function(&self, name: &str) -> Option<(u16, u16)> {
        self.functions?.find(name)
    }

    /// Values in consecutive registers; gives the first.
    pub(super) fn arguments(&mut self, args: &[Expr], span: Span) -> Reg {
        if let [arg] = args {
            return self.expression(arg);
        }
        self.values(args, span)
    }

    /// The same in temporaries of their own.
    pub(super) fn values(&mut self, args: &[Expr], span: Span) -> Reg {
        let base = self.temporaries(args.len() as u16, span);
        for (offset, arg) in args.iter().enumerate() {
            self.expression_into(arg, base.wrapping_add(offset as u16));
        }
        base
    }

    pub(super) fn wrong_count(&mut self, name: &str, wanted: &str, given: usize, span: Span) {
        let message = format!("{name} takes {wanted}, {given} given");
        self.report(CompileCode::WrongArguments, span, message);
    }

    /// The value of an expression of constants, where it is finite.
    pub(super) fn constant(&mut self, expr: &Expr) -> Option<f64> {
        let value = match &expr.kind {
            ExprKind::Number(number) => return Some(*number),
            ExprKind::Unary { op: UnaryOp::Minus, operand } => -self.folded(operand)?,
            ExprKind::Unary { op: UnaryOp::Plus, operand } => self.folded(operand)?,
            ExprKind::Binary { op, left, right } => {
                let fold: fn(f64, f64) -> f64 = match op {
                    BinaryOp::Add => |x, y| x + y,
                    BinaryOp::Sub => |x, y| x - y,
                    BinaryOp::Mul => |x, y| x * y,
                    BinaryOp::Div => |x, y| x / y,
                    _ => return None,
                };
                fold(self.folded(left)?, self.folded(right)?)
            }
            _ => return None,
        };
        Some(value).filter(|value| value.is_finite() && *value != EMPTY)
    }

    /// A constant that is a number: EMPTY is none, and its operation stops the run.
    fn folded(&mut self, operand: &Expr) -> Option<f64> {
        self.constant(operand).filter(|number| *number != EMPTY)
    }

    /// The word of ICODEF(word).
    pub(super) fn word_code(&mut self, expr: &Expr) -> Option<WordId> {
        let ExprKind::Call { name, args } = &expr.kind else { return None };
        match args.as_slice() {
            [Expr { kind: ExprKind::Name(word), .. }] if name.text == "ICODEF" => {
                Some(self.vocab.intern(word))
            }
            _ => None,
        }
    }
}

fn binary(op: BinaryOp, dst: Reg, a: Reg, b: Reg) -> Op {
    match op {
        BinaryOp::Add => Op::Add { dst, a, b },
        BinaryOp::Sub => Op::Sub { dst, a, b },
        BinaryOp::Mul => Op::Mul { dst, a, b },
        BinaryOp::Div => Op::Div { dst, a, b },
        BinaryOp::Pow => Op::Pow { dst, a, b },
        BinaryOp::Eq
        | BinaryOp::Ne
        | BinaryOp::Lt
        | BinaryOp::Le
        | BinaryOp::Gt
        | BinaryOp::Ge
        | BinaryOp::And
        | BinaryOp::Or => unreachable!("logical expressions are compiled as jumps"),
    }
}
