//! What a debug build of the bytecode has beside the code of a run: operations that tell of
//! statements and of outcomes. Without it none of this emits anything.

use fil_syntax::tree::StmtKind;

use super::Compiler;
use super::chunk::Label;
use crate::debug::BranchOutcome;
use crate::module::Branch;
use crate::ops::Op;

impl Compiler<'_> {
    /// Emits an operation of a debug build.
    pub(super) fn probe(&mut self, op: Op) {
        if self.module.debug {
            self.chunk.emit(op);
        }
    }

    /// Tells of a statement that does something when it runs.
    pub(super) fn probe_statement(&mut self, kind: &StmtKind) {
        let declares = match kind {
            StmtKind::Reserv { .. }
            | StmtKind::Print { .. }
            | StmtKind::Redef { .. }
            | StmtKind::Includ { .. }
            | StmtKind::Fini => true,
            StmtKind::Post { word, .. } => word.text == "DATA",
            _ => false,
        };
        if !declares {
            self.probe(Op::Statement);
        }
    }

    /// Tells that an outcome of the condition has come; those of one `opening` belong together.
    pub(super) fn outcome(&mut self, opening: u32, outcome: BranchOutcome) {
        if !self.module.debug {
            return;
        }
        let statement = self.chunk.statement;
        let span = self.module.statements[statement as usize].span;
        let number = self.index(self.module.branches.len(), span, "outcomes of conditions");
        self.module.branches.push(Branch { opening, statement, outcome });
        self.chunk.emit(Op::Branch { number });
    }

    /// Places the label where a body was skipped; a debug build tells of it, and what comes
    /// out of the body goes past that.
    pub(super) fn skipped(&mut self, opening: u32, skip: Label, outcome: BranchOutcome) {
        if !self.module.debug {
            self.chunk.place(skip);
            return;
        }
        let end = self.chunk.label();
        self.chunk.statement = opening;
        self.chunk.jump(end);
        self.chunk.place(skip);
        self.outcome(opening, outcome);
        self.chunk.place(end);
    }
}
