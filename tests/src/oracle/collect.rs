//! What is known of a program before it runs: names that are set, arrays, macros.

use fil_syntax::tree::{ExprKind, Item, Stmt, StmtKind, Target};

use super::Oracle;

impl Oracle<'_> {
    /// Walks all statements once.
    pub(super) fn collect(&mut self) {
        for item in &self.program.items {
            match item {
                Item::Stmt(stmt) => self.collect_stmt(stmt),
                Item::Section(section) => self.collect_all(&section.body),
                Item::Macro(definition) => {
                    self.macros.insert(&definition.name.text, definition);
                    self.collect_all(&definition.body);
                }
            }
        }
        for item in &self.program.items {
            if let Item::Macro(definition) = item {
                let locals = definition.params.iter().map(|(name, _)| &name.text);
                locals.for_each(|name| {
                    self.assigned.remove(name);
                });
            }
        }
    }

    fn collect_all(&mut self, body: &[Stmt]) {
        body.iter().for_each(|stmt| self.collect_stmt(stmt));
    }

    fn collect_stmt(&mut self, stmt: &Stmt) {
        match &stmt.kind {
            StmtKind::Assign { target, .. } | StmtKind::Text { target, .. } => self.sets(target),
            StmtKind::Do { variable, body, .. } => {
                self.sets(variable);
                self.collect_all(body);
            }
            StmtKind::If { arms, otherwise } => {
                arms.iter().for_each(|(_, body)| self.collect_all(body));
                otherwise.iter().for_each(|body| self.collect_all(body));
            }
            StmtKind::IfOne { then, .. } => self.collect_stmt(then),
            StmtKind::Case { whens, other, .. } => {
                whens.iter().for_each(|when| self.collect_all(&when.body));
                other.iter().for_each(|body| self.collect_all(body));
            }
            StmtKind::Reserv { arrays } => {
                for (name, size) in arrays {
                    if let ExprKind::Number(size) = size.kind {
                        self.arrays.insert(name.text.clone(), vec![None; size as usize]);
                    }
                }
            }
            _ => {}
        }
    }

    fn sets(&mut self, target: &Target) {
        if target.index.is_none() {
            self.assigned.insert(target.name.text.clone());
        }
    }
}
