//! The uses of names, body by body: global areas, sections, macros.

use fil_diag::suggest::did_you_mean;
use fil_syntax::tree::{
    Expr, ExprKind, Item, Macro, Name, Section, SectionKey, Span, Stmt, StmtKind, Target,
};

use super::{FileSpan, Resolver, Role, Scope, SymbolId, SymbolKind};
use crate::compile::sections::written;
use crate::errors::CompileCode;

impl<'t> Resolver<'t, '_> {
    /// Walks all bodies.
    pub(super) fn walk(&mut self) {
        for root in &self.input.found.roots {
            self.begin(None, Vec::new());
            self.within(*root, Self::global_statements);
            self.end_of_body();
        }
        let units = self.input.units;
        let mut macros = 0;
        for (number, unit) in units.iter().enumerate() {
            self.unit = number;
            self.again = false;
            for item in &unit.program.items {
                match item {
                    Item::Stmt(_) => {}
                    Item::Section(section) => self.section(section),
                    Item::Macro(definition) => {
                        self.macro_body(definition, macros);
                        macros += 1;
                    }
                }
            }
        }
    }

    fn begin(&mut self, owner: Option<SymbolId>, parameters: Vec<(&'t str, SymbolId)>) {
        self.scope = Scope { owner, parameters, ..Scope::default() };
    }

    /// Statements of a file: those of its global area, or in the place of an INCLUD.
    fn global_statements(&mut self, unit: usize) {
        let units = self.input.units;
        for item in &units[unit].program.items {
            if let Item::Stmt(stmt) = item {
                self.statement(stmt);
            }
        }
    }

    /// Walks statements of another file.
    fn within(&mut self, unit: usize, walk: impl FnOnce(&mut Self, usize)) {
        let outer = (self.unit, self.again);
        self.unit = unit;
        self.again = std::mem::replace(&mut self.visited[unit], true);
        walk(self, unit);
        (self.unit, self.again) = outer;
    }

    fn section(&mut self, section: &'t Section) {
        let symbol = self.symbol(written(&section.key), SymbolKind::Section);
        self.symbols[symbol].extent = Some(FileSpan { file: self.unit, span: section.span });
        match &section.key {
            SectionKey::Words { major, minors } => {
                let end = minors.last().map_or(major.span, |minor| minor.span).end;
                self.define(symbol, Span { start: major.span.start, end });
                self.word_of(major, Role::Key);
                minors.iter().for_each(|minor| self.word_of(minor, Role::MinorKey));
            }
            SectionKey::Types { span, .. } => self.define(symbol, *span),
        }
        self.begin(Some(symbol), Vec::new());
        self.statements(&section.body);
        self.end_of_body();
    }

    fn macro_body(&mut self, definition: &'t Macro, number: usize) {
        // A default is a value of the macro's file and sees no parameters.
        self.begin(None, Vec::new());
        for default in definition.params.iter().filter_map(|(_, default)| default.as_ref()) {
            self.expression(default, Role::Argument);
        }
        let names = definition.params.iter().map(|(name, _)| name.text.as_str());
        let parameters = names.zip(self.parameters[number].iter().copied()).collect();
        let owner = self.global(&definition.name.text).symbol;
        self.begin(Some(owner), parameters);
        self.statements(&definition.body);
        self.end_of_body();
    }

    /// Labels that were jumped to and are not there.
    fn end_of_body(&mut self) {
        let labels = std::mem::take(&mut self.scope.labels);
        let given = |id: &SymbolId| !self.symbols[*id].definitions.is_empty();
        let mut missing: Vec<SymbolId> = labels.values().copied().filter(|id| !given(id)).collect();
        missing.sort_unstable();
        let known: Vec<&str> =
            labels.iter().filter(|(_, id)| given(id)).map(|(name, _)| *name).collect();
        for id in missing {
            let name = self.symbols[id].name.clone();
            let message = format!("there is no label {name} here");
            let hint = did_you_mean(&name, known.iter().copied());
            // A DO without its label the parser has reported.
            let uses = self.symbols[id].uses.clone();
            for used in uses.iter().filter(|used| used.role == Role::Jump) {
                self.unit = used.location.file;
                let (span, message) = (used.location.span, message.clone());
                self.report_with(CompileCode::UnknownLabel, span, message, hint.clone());
            }
        }
    }

    fn statements(&mut self, body: &'t [Stmt]) {
        body.iter().for_each(|stmt| self.statement(stmt));
    }

    fn statement(&mut self, stmt: &'t Stmt) {
        if let Some(label) = &stmt.label {
            self.label_given(label);
        }
        match &stmt.kind {
            StmtKind::Assign { target, value } => {
                self.target(target);
                self.expression(value, Role::Read);
            }
            StmtKind::Text { target, args } => {
                self.target(target);
                self.text_arguments(args);
            }
            StmtKind::Post { word, args } => self.post(word, args),
            StmtKind::PostText { word, text } => self.post_text(word, text, stmt.span),
            StmtKind::If { arms, otherwise } => {
                for (condition, body) in arms {
                    self.expression(condition, Role::Read);
                    self.statements(body);
                }
                self.statements(otherwise.as_deref().unwrap_or_default());
            }
            StmtKind::IfOne { condition, then } => {
                self.expression(condition, Role::Read);
                self.statement(then);
            }
            StmtKind::IfSign { value, labels } => {
                self.expression(value, Role::Read);
                labels.iter().for_each(|label| self.label_used(label, Role::Jump));
            }
            StmtKind::Jump { label } => self.label_used(label, Role::Jump),
            StmtKind::Do { label, variable, range, body } => {
                self.label_used(label, Role::LoopEnd);
                self.target(variable);
                range.values().for_each(|value| self.expression(value, Role::Read));
                self.statements(body);
            }
            StmtKind::Case { subject, whens, other } => {
                self.expression(subject, Role::Read);
                for when in whens {
                    when.values.iter().for_each(|value| self.expression(value, Role::When));
                    self.statements(&when.body);
                }
                self.statements(other.as_deref().unwrap_or_default());
            }
            StmtKind::Call { name, args } => self.call_macro(name, args),
            StmtKind::Includ { .. } => {
                let key = (self.unit, stmt.span.start);
                if let Some(unit) = self.input.found.included.get(&key) {
                    self.within(*unit, Self::global_statements);
                }
            }
            StmtKind::Reserv { .. }
            | StmtKind::Print { .. }
            | StmtKind::Redef { .. }
            | StmtKind::Contin
            | StmtKind::Fini => {}
        }
    }

    /// What an assignment, TEXT/ or DO sets.
    fn target(&mut self, target: &'t Target) {
        let name = &target.name;
        match &target.index {
            Some(index) => {
                let array = self.global(&name.text).symbol;
                self.used(array, name.span, Role::SetElement);
                self.expression(index, Role::Read);
            }
            None => {
                let symbol = self.variable(&name.text);
                self.define(symbol, name.span);
            }
        }
    }

    fn variable(&mut self, name: &'t str) -> SymbolId {
        self.parameter(name).unwrap_or_else(|| self.global(name).symbol)
    }

    /// Reads a name; `role` is that of a name which is the whole expression.
    pub(super) fn expression(&mut self, expr: &'t Expr, role: Role) {
        match &expr.kind {
            ExprKind::Number(_) | ExprKind::Text(_) => {}
            ExprKind::Name(name) => {
                let symbol = self.variable(name);
                self.used(symbol, expr.span, role);
            }
            ExprKind::Call { name, args } => self.call(name, args),
            ExprKind::Unary { operand, .. } => self.expression(operand, self.operand()),
            ExprKind::Binary { left, right, .. } => {
                self.expression(left, self.operand());
                self.expression(right, self.operand());
            }
        }
    }

    fn operand(&self) -> Role {
        if self.takes_letters { Role::Read } else { Role::Operand }
    }

    fn label(&mut self, name: &'t str) -> SymbolId {
        if let Some(known) = self.scope.labels.get(name) {
            return *known;
        }
        let symbol = self.symbol(name, SymbolKind::Label);
        self.symbols[symbol].owner = self.scope.owner;
        self.scope.labels.insert(name, symbol);
        symbol
    }

    fn label_given(&mut self, name: &'t Name) {
        let symbol = self.label(&name.text);
        if !self.symbols[symbol].definitions.is_empty() {
            let message = format!("the label {} is already here", name.text);
            // A file that is included twice gives its labels twice.
            let again = std::mem::replace(&mut self.again, false);
            self.report(CompileCode::LabelTwice, name.span, message);
            self.again = again;
        }
        self.define(symbol, name.span);
    }

    fn label_used(&mut self, name: &'t Name, role: Role) {
        let symbol = self.label(&name.text);
        self.used(symbol, name.span, role);
    }

    fn call_macro(&mut self, name: &'t Name, args: &'t [(Option<Name>, Expr)]) {
        let global = self.global(&name.text);
        let (symbol, number) = (global.symbol, global.macro_id);
        self.used(symbol, name.span, Role::Call);
        for (given, value) in args {
            if let (Some(given), Some(number)) = (given, number) {
                let own = &self.parameters[usize::from(number)];
                let known = own.iter().find(|own| self.symbols[**own].name == given.text);
                if let Some(parameter) = known.copied() {
                    self.used(parameter, given.span, Role::Parameter);
                }
            }
            self.expression(value, Role::Argument);
        }
        if number.is_none() {
            let message = format!("there is no macro {}", name.text);
            let macros = self.names.macros.iter();
            let hint = did_you_mean(&name.text, macros.map(|m| m.definition.name.text.as_str()));
            self.report_with(CompileCode::UnknownMacro, name.span, message, hint);
        }
    }
}
