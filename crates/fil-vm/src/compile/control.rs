//! Jumps, IF, DO and CASE.

use fil_syntax::tree::{DoRange, Expr, Name, Span, Stmt, StmtKind, Target, When};

use super::Compiler;
use super::chunk::{Label, NamedLabel};
use crate::debug::BranchOutcome;
use crate::errors::CompileCode;
use crate::ops::Op;
use fil_syntax::walk::inner_bodies;

impl Compiler<'_> {
    /// Finds the labels of a chunk before its code is made: jumps go forward too.
    pub(super) fn collect_labels(&mut self, body: &[Stmt], loops: &mut Vec<(usize, u32)>) {
        for stmt in body {
            if let Some(name) = &stmt.label {
                let label = self.chunk.label();
                let known = NamedLabel { label, loops: loops.clone() };
                self.chunk.named.insert(name.text.clone(), known);
            }
            let is_loop = matches!(stmt.kind, StmtKind::Do { .. });
            if is_loop {
                loops.push((self.unit, stmt.span.start));
            }
            inner_bodies(stmt, &mut |inner| self.collect_labels(inner, loops));
            if is_loop {
                loops.pop();
            }
            if let Some(unit) = self.included(stmt) {
                let program = self.program(unit);
                self.within(unit, |this| {
                    for item in &program.items {
                        if let fil_syntax::tree::Item::Stmt(stmt) = item {
                            this.collect_labels(std::slice::from_ref(stmt), loops);
                        }
                    }
                });
            }
        }
    }

    /// The label a jump from here may go to; `None` where there is none, which has been
    /// reported.
    fn destination(&mut self, name: &Name) -> Option<Label> {
        let named = self.chunk.named.get(&name.text)?;
        let label = named.label;
        if !self.chunk.loops.starts_with(&named.loops) {
            let message = format!("{} lies inside a DO that this jump is outside of", name.text);
            self.report(CompileCode::JumpIntoLoop, name.span, message);
        }
        Some(label)
    }

    pub(super) fn jump(&mut self, name: &Name) {
        if let Some(label) = self.destination(name) {
            self.chunk.jump(label);
        }
    }

    pub(super) fn if_block(&mut self, arms: &[(Expr, Vec<Stmt>)], otherwise: Option<&[Stmt]>) {
        let end = self.chunk.label();
        let opening = self.chunk.statement;
        for (index, (condition, body)) in arms.iter().enumerate() {
            if index > 0 {
                self.begin_statement(condition.span);
                self.probe(Op::Statement);
            }
            let next = self.chunk.label();
            self.branch(condition, false, next);
            self.outcome(opening, BranchOutcome::True);
            self.statements(body);
            // In a debug build something follows in any case: what tells that no arm was taken.
            if index + 1 < arms.len() || otherwise.is_some() || self.module.debug {
                self.chunk.statement = opening;
                self.chunk.jump(end);
            }
            self.chunk.place(next);
        }
        self.outcome(opening, BranchOutcome::Else);
        self.statements(otherwise.unwrap_or_default());
        self.chunk.place(end);
    }

    /// `IF(c) statement`; a forward jump becomes part of the condition.
    pub(super) fn if_one(&mut self, condition: &Expr, then: &Stmt) {
        if let StmtKind::Jump { label } = &then.kind {
            match self.destination(label) {
                Some(to) if !self.chunk.is_placed(to) && !self.module.debug => {
                    self.branch(condition, true, to);
                    return;
                }
                None => return,
                _ => {}
            }
        }
        let opening = self.chunk.statement;
        let skip = self.chunk.label();
        self.branch(condition, false, skip);
        self.outcome(opening, BranchOutcome::True);
        self.statements(std::slice::from_ref(then));
        self.skipped(opening, skip, BranchOutcome::Else);
    }

    /// Arithmetic IF.
    pub(super) fn if_sign(&mut self, value: &Expr, labels: &[Name; 3]) {
        let opening = self.chunk.statement;
        let mark = self.mark();
        let a = self.expression(value);
        let zero = self.number(0.0, value.span);
        let (negative, null) = (self.chunk.label(), self.chunk.label());
        self.chunk.emit_to(negative, |to| Op::JumpLt { a, b: zero, to });
        self.chunk.emit_to(null, |to| Op::JumpEq { a, b: zero, to });
        self.release(mark);
        self.outcome(opening, BranchOutcome::Positive);
        self.jump(&labels[2]);
        self.chunk.place(negative);
        self.outcome(opening, BranchOutcome::Negative);
        self.jump(&labels[0]);
        self.chunk.place(null);
        self.outcome(opening, BranchOutcome::Zero);
        self.jump(&labels[1]);
    }

    pub(super) fn do_loop(
        &mut self,
        stmt: &Stmt,
        variable: &Target,
        range: &DoRange,
        body: &[Stmt],
    ) {
        if variable.index.is_some() {
            let message = format!("the loop variable {} is an array element", variable.name.text);
            self.report(CompileCode::ArrayMisuse, variable.name.span, message);
            return;
        }
        self.warn_of_letter(variable, None);
        let opening = self.chunk.statement;
        let var = self.variable(&variable.name.text, variable.name.span);
        // Last value and step are settled before the loop and kept beside each other.
        let base = self.reserve(2, stmt.span);
        self.expression_into(&range.to, base);
        match &range.step {
            Some(step) => self.expression_into(step, base + 1),
            None => {
                let src = self.number(1.0, stmt.span);
                self.chunk.emit(Op::Move { dst: base + 1, src });
            }
        }
        self.expression_into(&range.from, var);
        let (exit, again) = (self.chunk.label(), self.chunk.label());
        self.chunk.emit_to(exit, |exit| Op::DoEnter { var, base, exit });
        self.outcome(opening, BranchOutcome::Pass);
        self.chunk.place(again);
        self.chunk.loops.push((self.unit, stmt.span.start));
        self.statements(body);
        self.chunk.loops.pop();
        self.chunk.statement = opening;
        self.chunk.emit_to(again, |body| Op::DoNext { var, base, body });
        self.skipped(opening, exit, BranchOutcome::NoPass);
    }

    pub(super) fn case(&mut self, subject: &Expr, whens: &[When], other: Option<&[Stmt]>) {
        let opening = self.chunk.statement;
        let mark = self.mark();
        // The subject is read here even where no WHEN follows: a name that was
        // never set is warned of in the line of the CASE.
        let a = self.temporary(subject.span);
        self.expression_into(subject, a);
        let bodies: Vec<Label> = whens.iter().map(|_| self.chunk.label()).collect();
        let mut tested = Vec::with_capacity(whens.len());
        for (when, body) in whens.iter().zip(&bodies) {
            self.begin_statement(when.span);
            tested.push(self.chunk.statement);
            for value in &when.values {
                let inner = self.mark();
                let b = self.expression(value);
                self.chunk.emit_to(*body, |to| Op::JumpEq { a, b, to });
                self.release(inner);
            }
        }
        self.release(mark);
        let end = self.chunk.label();
        self.chunk.statement = opening;
        self.outcome(opening, BranchOutcome::Else);
        self.statements(other.unwrap_or_default());
        for ((when, body), statement) in whens.iter().zip(&bodies).zip(tested) {
            self.chunk.statement = opening;
            self.chunk.jump(end);
            self.chunk.place(*body);
            self.chunk.statement = statement;
            self.outcome(opening, BranchOutcome::When);
            self.statements(&when.body);
        }
        self.chunk.place(end);
    }

    /// The unit that an INCLUD statement stands for.
    pub(super) fn included(&self, stmt: &Stmt) -> Option<usize> {
        match stmt.kind {
            StmtKind::Includ { .. } => {
                self.found.included.get(&(self.unit, stmt.span.start)).copied()
            }
            _ => None,
        }
    }

    /// Statements of an included file in the place of its INCLUD.
    pub(super) fn include(&mut self, unit: usize, span: Span, sections_allowed: bool) {
        let program = self.program(unit);
        let only_statements =
            program.items.iter().all(|item| matches!(item, fil_syntax::tree::Item::Stmt(_)));
        if !only_statements && !sections_allowed {
            let message = "the file holds sections or macros and is included inside of one";
            self.report(CompileCode::IncludeFailed, span, message);
            return;
        }
        self.within(unit, |this| {
            for item in &program.items {
                if let fil_syntax::tree::Item::Stmt(stmt) = item {
                    this.statement(stmt);
                }
            }
        });
    }
}
