//! Values of expressions.

use fil_syntax::tree::{BinaryOp, Expr, ExprKind, Span, UnaryOp};

use super::Oracle;
use super::functions;
use super::value::{Class, EMPTY, Fault, NEVER_SET, Value};

impl Oracle<'_> {
    /// The value of an expression.
    pub(super) fn eval(&mut self, expr: &Expr) -> Result<Value, Fault> {
        match &expr.kind {
            ExprKind::Number(number) => Ok(Value::of(*number)),
            ExprKind::Text(text) => Ok(Value::Text(text.clone())),
            ExprKind::Name(name) => Ok(self.read(name, expr.span)),
            ExprKind::Call { name, args } => self.call(&name.text, args, expr.span),
            ExprKind::Unary { op, operand } => match op {
                UnaryOp::Minus => Ok(Value::Number(-self.number(operand)?)),
                UnaryOp::Plus => Ok(Value::Number(self.number(operand)?)),
                UnaryOp::Not => Ok(logical(!self.condition(operand)?)),
            },
            ExprKind::Binary { op, left, right } => self.binary(*op, left, right, expr.span),
        }
    }

    /// The number of an expression; a text is refused.
    pub(super) fn number(&mut self, expr: &Expr) -> Result<f64, Fault> {
        match self.eval(expr)? {
            Value::Number(number) => Ok(number),
            _ => self.fault(Class::WrongType, expr.span),
        }
    }

    /// The number that a value compares as; `None` for a text.
    pub(super) fn plain(&self, value: &Value) -> Option<f64> {
        match value {
            Value::Number(number) => Some(*number),
            Value::Minor(word) => Some(self.code(word)),
            Value::Empty => Some(EMPTY),
            Value::Text(_) => None,
        }
    }

    /// True or false; a condition is 0 or 1.
    pub(super) fn condition(&mut self, expr: &Expr) -> Result<bool, Fault> {
        match self.number(expr)? {
            0.0 => Ok(false),
            1.0 => Ok(true),
            _ => self.fault(Class::NotLogical, expr.span),
        }
    }

    /// What a name holds; EMPTY when it was never set.
    pub(super) fn read(&mut self, name: &str, span: Span) -> Value {
        let own = self.frames.last().and_then(|frame| frame.get(name));
        let value = own.or_else(|| self.variables.get(name)).cloned();
        self.or_empty(value, span)
    }

    fn or_empty(&mut self, value: Option<Value>, span: Span) -> Value {
        value.unwrap_or_else(|| {
            self.warn(NEVER_SET, span);
            Value::Empty
        })
    }

    /// The place of an element, counted from 0.
    pub(super) fn element(&self, name: &str, index: &Value, span: Span) -> Result<usize, Fault> {
        let Value::Number(wanted) = *index else { return self.fault(Class::WrongType, span) };
        let size = self.arrays.get(name).map_or(0, Vec::len);
        if wanted.fract() != 0.0 || wanted < 1.0 || wanted > size as f64 {
            return self.fault(Class::Subscript, span);
        }
        Ok(wanted as usize - 1)
    }

    fn binary(
        &mut self,
        op: BinaryOp,
        left: &Expr,
        right: &Expr,
        span: Span,
    ) -> Result<Value, Fault> {
        match op {
            BinaryOp::And => {
                return Ok(logical(self.condition(left)? && self.condition(right)?));
            }
            BinaryOp::Or => return Ok(logical(self.condition(left)? || self.condition(right)?)),
            _ => {}
        }
        let (one, other) = (self.eval(left)?, self.eval(right)?);
        let compared = match op {
            BinaryOp::Eq => Some(self.equal(&one, &other, span)?),
            BinaryOp::Ne => Some(!self.equal(&one, &other, span)?),
            BinaryOp::Lt | BinaryOp::Le | BinaryOp::Gt | BinaryOp::Ge => {
                let order = match (&one, &other) {
                    (Value::Text(one), Value::Text(other)) => Some(one.cmp(other)),
                    _ => match (self.plain(&one), self.plain(&other)) {
                        (Some(one), Some(other)) => one.partial_cmp(&other),
                        _ => None,
                    },
                };
                match order {
                    None => return self.fault(Class::WrongType, span),
                    Some(order) if op == BinaryOp::Lt => Some(order.is_lt()),
                    Some(order) if op == BinaryOp::Le => Some(order.is_le()),
                    Some(order) if op == BinaryOp::Gt => Some(order.is_gt()),
                    Some(order) => Some(order.is_ge()),
                }
            }
            _ => None,
        };
        if let Some(truth) = compared {
            return Ok(logical(truth));
        }
        let (Value::Number(one), Value::Number(other)) = (one, other) else {
            return self.fault(Class::WrongType, span);
        };
        let result = match op {
            BinaryOp::Add => one + other,
            BinaryOp::Sub => one - other,
            BinaryOp::Mul => one * other,
            BinaryOp::Div => one / other,
            _ => libm::pow(one, other),
        };
        if result.is_finite() { Ok(Value::Number(result)) } else { self.fault(Class::Domain, span) }
    }

    /// Text and number can't be compared, but EMPTY equals nothing but EMPTY.
    pub(super) fn equal(&self, one: &Value, other: &Value, span: Span) -> Result<bool, Fault> {
        match (one, other) {
            (Value::Text(one), Value::Text(other)) => Ok(one == other),
            (Value::Empty, Value::Text(_)) | (Value::Text(_), Value::Empty) => Ok(false),
            _ => match (self.plain(one), self.plain(other)) {
                (Some(one), Some(other)) => Ok(one == other),
                _ => self.fault(Class::WrongType, span),
            },
        }
    }

    /// A function or an element of an array.
    fn call(&mut self, name: &str, args: &[Expr], span: Span) -> Result<Value, Fault> {
        if self.arrays.contains_key(name) && args.len() == 1 {
            let index = self.eval(&args[0])?;
            let index = self.element(name, &index, span)?;
            let element = self.arrays[name][index].clone();
            return Ok(self.or_empty(element, span));
        }
        match (name, args) {
            ("ICODEF", [Expr { kind: ExprKind::Name(word) | ExprKind::Text(word), .. }]) => {
                self.vocab.intern(word);
                Ok(Value::Minor(word.clone()))
            }
            ("LNTHF", [text]) => match self.eval(text)? {
                Value::Text(text) => Ok(Value::Number(text.chars().count() as f64)),
                _ => self.fault(Class::WrongType, span),
            },
            ("POSTF", args) => self.postf(args, span),
            _ => {
                let values: Vec<Value> =
                    args.iter().map(|arg| self.eval(arg)).collect::<Result<_, _>>()?;
                let number = |value: &Value| match value {
                    Value::Number(number) => Ok(*number),
                    _ => self.fault(Class::WrongType, span),
                };
                let numbers: Vec<f64> = values.iter().map(number).collect::<Result<_, _>>()?;
                match functions::call(name, &numbers) {
                    Some(Ok(number)) => Ok(Value::Number(number)),
                    Some(Err(class)) => self.fault(class, span),
                    None => self.fault(Class::Unknown, span),
                }
            }
        }
    }
}

fn logical(truth: bool) -> Value {
    Value::Number(if truth { 1.0 } else { 0.0 })
}
