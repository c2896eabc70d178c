//! Statements: one function that knows them all, and assignments.

use fil_syntax::tree::{Expr, Item, Span, Stmt, StmtKind, Target};

use super::Compiler;
use super::names::letter;
use crate::errors::CompileCode;
use crate::library::Library;
use crate::ops::Op;

impl Compiler<'_> {
    /// Statements outside of sections of a file and of those it includes.
    pub(super) fn global_area(&mut self, unit: usize) {
        let program = self.program(unit);
        let title = format!("global area of {}", self.units[unit].file.name);
        self.within(unit, |this| {
            let chunk = this.build_chunk(title, Span::default(), |this| {
                for item in &program.items {
                    if let Item::Stmt(stmt) = item {
                        this.collect_labels(std::slice::from_ref(stmt), &mut Vec::new());
                    }
                }
                for item in &program.items {
                    if let Item::Stmt(stmt) = item {
                        this.statement(stmt);
                    }
                }
            });
            this.module.globals.push(chunk);
        });
    }

    pub(super) fn statements(&mut self, body: &[Stmt]) {
        for stmt in body {
            self.deeper(stmt.span, (), |this| this.statement(stmt));
        }
    }

    pub(super) fn statement(&mut self, stmt: &Stmt) {
        self.begin_statement(stmt.span);
        if let Some(name) = &stmt.label
            && let Some(named) = self.chunk.named.get(&name.text)
        {
            let label = named.label;
            self.chunk.place(label);
        }
        self.probe_statement(&stmt.kind);
        let mark = self.mark();
        match &stmt.kind {
            StmtKind::Assign { target, value } => self.assign(target, value),
            StmtKind::Text { target, args } => self.assign_text(target, args, stmt.span),
            StmtKind::Post { word, args } if word.text == "DATA" => self.check_data(word, args),
            StmtKind::Post { word, args } if word.text == "WRITE" => self.write_line(word, args),
            StmtKind::Post { word, args } if word.text == "ERROR" => {
                self.message(Library::Refuse, word, args);
            }
            StmtKind::Post { word, args } if word.text == "WARN" => {
                self.message(Library::Warn, word, args);
            }
            StmtKind::Post { word, args } => self.post(word, args),
            StmtKind::PostText { word, text } => self.post_text(word, text),
            StmtKind::If { arms, otherwise } => self.if_block(arms, otherwise.as_deref()),
            StmtKind::IfOne { condition, then } => self.if_one(condition, then),
            StmtKind::IfSign { value, labels } => self.if_sign(value, labels),
            StmtKind::Jump { label } => self.jump(label),
            StmtKind::Do { variable, range, body, .. } => {
                self.do_loop(stmt, variable, range, body);
            }
            StmtKind::Case { subject, whens, other } => {
                self.case(subject, whens, other.as_deref());
            }
            StmtKind::Call { name, args } => self.call_macro(name, args, stmt.span),
            StmtKind::Includ { .. } => {
                if let Some(unit) = self.included(stmt) {
                    // Sections of the file are only looked for at the outermost level.
                    let outermost = self.in_global_area() && self.chunk.depth == 0;
                    self.include(unit, stmt.span, outermost);
                }
            }
            StmtKind::Fini if !self.in_global_area() => {
                let message = "FINI inside of a section or macro";
                self.report(CompileCode::NotYet, stmt.span, message);
            }
            // Arrays are reserved before anything runs; PRINT and REDEF are for
            // the listing and the checks of a FIL compiler.
            StmtKind::Reserv { .. }
            | StmtKind::Print { .. }
            | StmtKind::Redef { .. }
            | StmtKind::Contin
            | StmtKind::Fini => {}
        }
        self.release(mark);
    }

    fn assign(&mut self, target: &Target, value: &Expr) {
        if let Some(index) = &target.index {
            let Some(array) = self.writable_array(&target.name) else { return };
            let (index, src) = (self.expression(index), self.expression(value));
            self.chunk.emit(Op::Store { array, index, src });
            return;
        }
        self.warn_of_letter(target, Some(value));
        let dst = self.variable(&target.name.text, target.name.span);
        self.expression_into(value, dst);
    }

    /// A letter that gets another value than its number no longer names its address.
    pub(super) fn warn_of_letter(&mut self, target: &Target, value: Option<&Expr>) {
        let name = &target.name.text;
        if self.is_param(name) {
            return;
        }
        let Some(number) = letter(name) else { return };
        if value.and_then(|value| self.constant(value)) != Some(number) {
            let message = format!("{name} no longer means address {number} after this");
            self.report(CompileCode::LetterRedefined, target.name.span, message);
        }
    }
}
