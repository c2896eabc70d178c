//! A chunk of code in the making: operations, labels, temporaries.

use std::collections::HashMap;

use fil_syntax::tree::Span;

use super::Compiler;
use crate::errors::CompileCode;
use crate::machine::FIRST_TEMPORARY;
use crate::module::{Chunk, ChunkId, Statement};
use crate::ops::{Op, Reg};

/// A place in the code that may not be known yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Label(usize);

/// A label that FIL gives, with the DO loops around it (by their start).
#[derive(Clone, Debug)]
pub(super) struct NamedLabel {
    pub label: Label,
    pub loops: Vec<(usize, u32)>,
}

/// A chunk in the making.
#[derive(Default)]
pub(super) struct ChunkBuilder {
    code: Vec<Op>,
    statements: Vec<u32>,
    positions: Vec<Option<usize>>,
    /// Operations whose target is to be filled in.
    patches: Vec<(usize, Label)>,
    pub named: HashMap<String, NamedLabel>,
    /// The DO loops around the statement that is being compiled.
    pub loops: Vec<(usize, u32)>,
    /// Index of that statement in the module.
    pub statement: u32,
    temporaries: u16,
    /// Nesting of blocks and expressions.
    pub depth: u32,
}

impl ChunkBuilder {
    pub fn emit(&mut self, op: Op) {
        match (self.code.last_mut(), op) {
            // A product that is only added to a variable needs no register of its own.
            (Some(last @ Op::Mul { .. }), Op::Add { dst, a: sum, b }) if dst == sum => {
                if let Op::Mul { dst: product, a, b: factor } = *last
                    && product == b
                    && product >= FIRST_TEMPORARY
                    && product != dst
                {
                    *last = Op::AddProduct { dst, a, b: factor };
                    return;
                }
            }
            _ => {}
        }
        self.code.push(op);
        self.statements.push(self.statement);
    }

    pub fn label(&mut self) -> Label {
        self.positions.push(None);
        Label(self.positions.len() - 1)
    }

    /// The label is here.
    pub fn place(&mut self, label: Label) {
        self.positions[label.0] = Some(self.code.len());
    }

    pub fn is_placed(&self, label: Label) -> bool {
        self.positions[label.0].is_some()
    }

    /// Emits an operation with a target; `op` gets the target as its argument.
    pub fn emit_to(&mut self, label: Label, op: impl FnOnce(u16) -> Op) {
        self.patches.push((self.code.len(), label));
        self.emit(op(0));
    }

    /// Goes to a label: backwards it costs fuel.
    pub fn jump(&mut self, label: Label) {
        if self.is_placed(label) {
            self.emit_to(label, |to| Op::JumpBack { to });
        } else {
            self.emit_to(label, |to| Op::Jump { to });
        }
    }

    fn patch(&mut self) {
        for (at, label) in std::mem::take(&mut self.patches) {
            let target = self.positions[label.0].unwrap_or(0) as u16;
            match &mut self.code[at] {
                Op::Jump { to }
                | Op::JumpBack { to }
                | Op::JumpEq { to, .. }
                | Op::JumpNe { to, .. }
                | Op::JumpLt { to, .. }
                | Op::JumpLe { to, .. }
                | Op::JumpTrue { to, .. }
                | Op::JumpFalse { to, .. }
                | Op::DoEnter { exit: to, .. }
                | Op::DoNext { body: to, .. } => *to = target,
                other => unreachable!("{other:?} has no target"),
            }
        }
    }
}

impl Compiler<'_> {
    /// Compiles a chunk of its own with `body` and gives its number.
    pub(super) fn build_chunk(
        &mut self,
        title: String,
        span: Span,
        body: impl FnOnce(&mut Self),
    ) -> ChunkId {
        let outer = std::mem::take(&mut self.chunk);
        self.begin_statement(span);
        let opening = self.chunk.statement;
        self.probe(Op::Enter);
        body(self);
        self.chunk.statement = opening;
        self.probe(Op::Leave);
        self.chunk.emit(Op::Return);
        self.chunk.patch();
        let built = std::mem::replace(&mut self.chunk, outer);
        if built.code.len() > usize::from(u16::MAX) {
            let message = format!("{title} has {} operations", built.code.len());
            self.report(CompileCode::TooLarge, span, message);
        }
        let ChunkBuilder { code, statements, .. } = built;
        let chunk = Chunk { title, code, statements, parameters: Vec::new() };
        self.module.chunks.push(chunk);
        self.index(self.module.chunks.len() - 1, span, "sections and macros")
    }

    /// The operations from here on belong to the statement at `span`.
    pub(super) fn begin_statement(&mut self, span: Span) {
        let file = self.unit as u16;
        let line = self.units[self.unit].file.lines.line(span.start as usize);
        self.chunk.statement = self.module.statements.len() as u32;
        self.module.statements.push(Statement { file, line, span, names: Vec::new() });
    }

    /// A temporary, free again after [`Compiler::release`].
    pub(super) fn temporary(&mut self, span: Span) -> Reg {
        self.temporaries(1, span)
    }

    /// Consecutive temporaries; gives the first.
    pub(super) fn temporaries(&mut self, count: u16, span: Span) -> Reg {
        let first = self.chunk.temporaries;
        let room = u16::MAX - FIRST_TEMPORARY;
        if count > room || first > room - count {
            self.report(
                CompileCode::TooLarge,
                span,
                "the expression needs too many values at once",
            );
            return FIRST_TEMPORARY;
        }
        self.chunk.temporaries += count;
        FIRST_TEMPORARY + first
    }

    /// The temporaries in use, to be given back later.
    pub(super) fn mark(&self) -> u16 {
        self.chunk.temporaries
    }

    /// Frees the temporaries taken since `mark`.
    pub(super) fn release(&mut self, mark: u16) {
        self.chunk.temporaries = mark;
    }

    /// Runs `body` one level deeper, unless that is too deep for the stack.
    pub(super) fn deeper<R>(
        &mut self,
        span: Span,
        too_deep: R,
        body: impl FnOnce(&mut Self) -> R,
    ) -> R {
        const DEEPEST: u32 = 400;
        if self.chunk.depth >= DEEPEST {
            self.report(
                CompileCode::TooLarge,
                span,
                format!("nested deeper than {DEEPEST} levels"),
            );
            return too_deep;
        }
        self.chunk.depth += 1;
        let result = body(self);
        self.chunk.depth -= 1;
        result
    }
}
