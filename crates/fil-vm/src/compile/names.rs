//! Names: which are variables, where they live, constants.

use std::collections::{HashMap, HashSet};

use fil_syntax::tree::{Item, Macro, Program, Span, Stmt, StmtKind};

use super::Compiler;
use crate::errors::CompileCode;
use crate::machine::FIRST_TEMPORARY;
use crate::module::Constant;
use crate::ops::Reg;

/// Names in the note of a message; a line rarely uses more.
const MOST_NAMES_NOTED: usize = 12;

/// A macro with the registers of its parameters.
pub(crate) struct MacroInfo<'t> {
    pub definition: &'t Macro,
    pub unit: usize,
    pub params: Vec<Reg>,
}

/// All names of the program.
#[derive(Default)]
pub(crate) struct Names<'t> {
    /// Names that some statement sets.
    pub assigned: HashSet<&'t str>,
    /// Parameters of the macro that is being compiled.
    pub params: HashMap<&'t str, Reg>,
    pub arrays: HashMap<&'t str, u16>,
    pub macro_ids: HashMap<&'t str, u16>,
    pub macros: Vec<MacroInfo<'t>>,
    numbers: HashMap<u64, Reg>,
    texts: HashMap<String, Reg>,
    next: u32,
}

impl<'t> Compiler<'t> {
    /// Finds every name that is set, every array and every macro of all files.
    pub(super) fn collect_names(&mut self) {
        for unit in 0..self.units.len() {
            self.within(unit, |this| this.collect_unit(this.program(unit)));
        }
    }

    fn collect_unit(&mut self, program: &'t Program) {
        for item in &program.items {
            match item {
                Item::Stmt(stmt) => self.collect(std::slice::from_ref(stmt), &[]),
                Item::Section(section) => self.collect(&section.body, &[]),
                Item::Macro(definition) => {
                    let params: Vec<&str> =
                        definition.params.iter().map(|(name, _)| name.text.as_str()).collect();
                    self.collect(&definition.body, &params);
                    self.declare_macro(definition);
                }
            }
        }
    }

    fn collect(&mut self, body: &'t [Stmt], params: &[&str]) {
        for stmt in body {
            match &stmt.kind {
                StmtKind::Assign { target, .. }
                | StmtKind::Text { target, .. }
                | StmtKind::Do { variable: target, .. }
                    if target.index.is_none() && !params.contains(&target.name.text.as_str()) =>
                {
                    self.names.assigned.insert(&target.name.text);
                }
                StmtKind::Reserv { arrays } => {
                    for (name, size) in arrays {
                        self.declare_array(name, size);
                    }
                }
                StmtKind::Post { word, args } if word.text == "DATA" => {
                    self.declare_data(word, args);
                }
                _ => {}
            }
            inner_bodies(stmt, &mut |inner| self.collect(inner, params));
        }
    }

    fn declare_macro(&mut self, definition: &'t Macro) {
        let name = &definition.name;
        let id = self.index(self.names.macros.len(), name.span, "macros");
        if self.names.macro_ids.insert(&name.text, id).is_some() {
            let message = format!("the macro {} is defined already", name.text);
            self.report(CompileCode::DefinedTwice, name.span, message);
        }
        let mut params = Vec::new();
        for (index, (param, _)) in definition.params.iter().enumerate() {
            if definition.params[..index].iter().any(|(other, _)| other.text == param.text) {
                let message = format!("{} has two parameters {}", name.text, param.text);
                self.report(CompileCode::DefinedTwice, param.span, message);
            }
            let reg = self.reserve(1, param.span);
            self.module.names.insert(reg, param.text.clone());
            params.push(reg);
        }
        self.names.macros.push(MacroInfo { definition, unit: self.unit, params });
        // Filled in when the macro is compiled; the order is that of the files.
        self.module.macros.push(0);
        self.calls.push(Vec::new());
    }

    /// True for a name that holds a value: it is set somewhere, a parameter or a letter.
    pub(super) fn is_variable(&self, name: &str) -> bool {
        self.names.params.contains_key(name)
            || self.names.assigned.contains(name)
            || letter(name).is_some()
    }

    /// True for a name that a statement sets, or a parameter.
    pub(super) fn is_assigned(&self, name: &str) -> bool {
        self.names.params.contains_key(name) || self.names.assigned.contains(name)
    }

    /// The register of a variable.
    pub(super) fn variable(&mut self, name: &str, span: Span) -> Reg {
        if self.names.arrays.contains_key(name) || self.names.macro_ids.contains_key(name) {
            let message = format!("{name} is an array or macro");
            self.report(CompileCode::ArrayMisuse, span, message);
        }
        let known = self.names.params.get(name).or_else(|| self.module.variables.get(name));
        let reg = match known {
            Some(reg) => *reg,
            None => self.new_variable(name, span),
        };
        let used = &mut self.module.statements[self.chunk.statement as usize].names;
        if used.len() < MOST_NAMES_NOTED && !used.contains(&reg) {
            used.push(reg);
        }
        reg
    }

    fn new_variable(&mut self, name: &str, span: Span) -> Reg {
        let reg = self.reserve(1, span);
        self.module.variables.insert(name.to_string(), reg);
        self.module.names.insert(reg, name.to_string());
        if let Some(number) = letter(name) {
            self.module.constants.push((reg, Constant::Number(number)));
        }
        reg
    }

    /// Consecutive registers that nothing else uses; gives the first.
    pub(super) fn reserve(&mut self, count: u32, span: Span) -> Reg {
        let first = self.names.next;
        if first + count > u32::from(FIRST_TEMPORARY) {
            let message = format!("more than {FIRST_TEMPORARY} names, constants and loops");
            self.report(CompileCode::TooLarge, span, message);
            return 0;
        }
        self.names.next += count;
        self.module.registers = self.names.next;
        first as Reg
    }

    /// The register that holds a number.
    pub(super) fn number(&mut self, number: f64, span: Span) -> Reg {
        if let Some(reg) = self.names.numbers.get(&number.to_bits()) {
            return *reg;
        }
        let reg = self.reserve(1, span);
        self.names.numbers.insert(number.to_bits(), reg);
        self.module.constants.push((reg, Constant::Number(number)));
        reg
    }

    /// The register that holds a text.
    pub(super) fn text(&mut self, text: &str, span: Span) -> Reg {
        if let Some(reg) = self.names.texts.get(text) {
            return *reg;
        }
        let reg = self.reserve(1, span);
        self.names.texts.insert(text.to_string(), reg);
        self.module.constants.push((reg, Constant::Text(text.to_string())));
        reg
    }
}

/// The number of a letter variable.
pub(crate) fn letter(name: &str) -> Option<f64> {
    match name.as_bytes() {
        [byte @ b'A'..=b'Z'] => Some(f64::from(byte - b'A' + 1)),
        _ => None,
    }
}

/// The statement lists inside a statement.
pub(crate) fn inner_bodies<'t>(stmt: &'t Stmt, visit: &mut dyn FnMut(&'t [Stmt])) {
    match &stmt.kind {
        StmtKind::If { arms, otherwise } => {
            arms.iter().for_each(|(_, body)| visit(body));
            otherwise.iter().for_each(|body| visit(body));
        }
        StmtKind::IfOne { then, .. } => visit(std::slice::from_ref(then)),
        StmtKind::Do { body, .. } => visit(body),
        StmtKind::Case { whens, other, .. } => {
            whens.iter().for_each(|when| visit(&when.body));
            other.iter().for_each(|body| visit(body));
        }
        _ => {}
    }
}
