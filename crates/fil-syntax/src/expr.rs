//! Builds expressions bottom up and keeps count of their depth, because whoever
//! walks the tree does so by recursion.

use crate::errors::SyntaxCode;
use crate::reader::Reader;
use crate::tree::{BinaryOp, Expr, ExprKind, Name, Span, UnaryOp};

/// The deepest tree an expression may have.
pub(crate) const MAX_DEPTH: u32 = 200;

/// An expression that knows how deep it is.
pub(crate) struct Deep {
    pub(crate) expr: Expr,
    depth: u32,
    /// A sign without brackets around it: `-A` but not `(-A)`.
    bare_sign: bool,
}

impl Deep {
    /// An expression of one part.
    pub(crate) fn leaf(kind: ExprKind, span: Span) -> Self {
        Deep { expr: Expr { kind, span }, depth: 1, bare_sign: false }
    }

    /// The same expression when it stood in brackets.
    pub(crate) fn in_brackets(self) -> Self {
        Deep { bare_sign: false, ..self }
    }

    /// A node over others; one that is too deep is reported and cut off.
    fn node(reader: &mut Reader<'_>, kind: ExprKind, span: Span, depth: u32) -> Self {
        if depth <= MAX_DEPTH {
            return Deep { expr: Expr { kind, span }, depth, bare_sign: false };
        }
        reader.report(
            SyntaxCode::TooDeep,
            format!("this expression has more than {MAX_DEPTH} operations inside each other"),
            span,
        );
        Deep::leaf(ExprKind::Number(0.0), span)
    }
}

/// A variable or word.
pub(crate) fn name(name: Name) -> Deep {
    Deep::leaf(ExprKind::Name(name.text), name.span)
}

/// `NAME(args)`.
pub(crate) fn call(reader: &mut Reader<'_>, name: Name, args: Vec<Deep>, stop: usize) -> Deep {
    let span = Span { start: name.span.start, end: stop as u32 };
    let depth = 1 + args.iter().map(|arg| arg.depth).max().unwrap_or(0);
    let args = args.into_iter().map(|arg| arg.expr).collect();
    Deep::node(reader, ExprKind::Call { name, args }, span, depth)
}

/// A sign or `.NOT.` before its operand.
pub(crate) fn unary(reader: &mut Reader<'_>, op: UnaryOp, operand: Deep, start: usize) -> Deep {
    let span = Span { start: start as u32, end: operand.expr.span.end };
    let kind = ExprKind::Unary { op, operand: Box::new(operand.expr) };
    let node = Deep::node(reader, kind, span, operand.depth + 1);
    Deep { bare_sign: op != UnaryOp::Not, ..node }
}

/// An operator between its operands.
pub(crate) fn binary(reader: &mut Reader<'_>, op: BinaryOp, left: Deep, right: Deep) -> Deep {
    let span = Span { start: left.expr.span.start, end: right.expr.span.end };
    if op == BinaryOp::Pow && left.bare_sign {
        reader.report(
            SyntaxCode::SignBeforePower,
            "the sign belongs to the base here: -A**B is read as (-A)**B",
            span,
        );
    }
    let depth = 1 + left.depth.max(right.depth);
    let kind = ExprKind::Binary { op, left: Box::new(left.expr), right: Box::new(right.expr) };
    Deep::node(reader, kind, span, depth)
}

/// The text between the apostrophes of a literal, doubled ones made single.
pub(crate) fn literal(quoted: &str) -> String {
    let inner = quoted.strip_prefix('\'').unwrap_or(quoted);
    inner.strip_suffix('\'').unwrap_or(inner).replace("''", "'")
}
