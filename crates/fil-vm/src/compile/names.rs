//! Registers: where variables, parameters and constants live.

use std::collections::HashMap;

use fil_cl::WordId;
use fil_syntax::tree::{Macro, Span};

use super::Compiler;
use crate::errors::CompileCode;
use crate::machine::FIRST_TEMPORARY;
use crate::module::Constant;
use crate::ops::Reg;
use crate::resolve::{ArraySize, Names};

/// Names in the note of a message; a line rarely uses more.
const MOST_NAMES_NOTED: usize = 12;

/// Names of a program and the registers they have got.
pub(crate) struct Slots<'t> {
    /// All names.
    pub names: Names<'t>,
    /// Registers of the variables, by their symbol.
    registers: Vec<Option<Reg>>,
    /// Registers of the parameters of each macro.
    pub macros: Vec<Vec<Reg>>,
    /// Parameters of the macro that is being compiled.
    pub params: Vec<(&'t str, Reg)>,
    numbers: HashMap<u64, Reg>,
    words: HashMap<WordId, Reg>,
    texts: HashMap<String, Reg>,
    next: u32,
}

impl<'t> Slots<'t> {
    /// Names of which none has a register yet; `symbols` is their number.
    pub fn new(names: Names<'t>, symbols: usize) -> Self {
        Slots {
            names,
            registers: vec![None; symbols],
            macros: Vec::new(),
            params: Vec::new(),
            numbers: HashMap::new(),
            words: HashMap::new(),
            texts: HashMap::new(),
            next: 0,
        }
    }

    fn param(&self, name: &str) -> Option<Reg> {
        self.params.iter().find(|(param, _)| *param == name).map(|(_, reg)| *reg)
    }
}

impl<'t> Compiler<'t> {
    /// Gives arrays their elements and the parameters of macros their registers.
    pub(super) fn declare(&mut self) {
        for id in 0..self.slots.names.arrays.len() {
            let array = &self.slots.names.arrays[id];
            let (unit, name, span, size) = (array.unit, array.name, array.span, array.size);
            self.within(unit, |this| match size {
                ArraySize::Reserved(size) => this.declare_array(name, span, size),
                ArraySize::Values(values) => this.declare_data(name, span, values),
            });
        }
        for id in 0..self.slots.names.macros.len() {
            let entry = &self.slots.names.macros[id];
            let (unit, definition) = (entry.unit, entry.definition);
            self.within(unit, |this| this.declare_macro(definition));
        }
    }

    fn declare_macro(&mut self, definition: &'t Macro) {
        self.index(self.slots.macros.len(), definition.name.span, "macros");
        let mut registers = Vec::with_capacity(definition.params.len());
        for (param, _) in &definition.params {
            let reg = self.reserve(1, param.span);
            self.module.names.insert(reg, param.text.clone());
            registers.push(reg);
        }
        self.slots.macros.push(registers);
        // Filled in when the macro is compiled; the order is that of the files.
        self.module.macros.push(0);
        self.calls.push(Vec::new());
    }

    /// True for a name that holds a value: it is set somewhere, a parameter or a letter.
    pub(super) fn is_variable(&self, name: &str) -> bool {
        self.is_assigned(name) || letter(name).is_some()
    }

    /// True for a name that a statement sets, or a parameter.
    pub(super) fn is_assigned(&self, name: &str) -> bool {
        self.slots.param(name).is_some() || self.slots.names.is_assigned(name)
    }

    /// True for a parameter of the macro that is being compiled.
    pub(super) fn is_param(&self, name: &str) -> bool {
        self.slots.param(name).is_some()
    }

    /// The register of a variable.
    pub(super) fn variable(&mut self, name: &str, span: Span) -> Reg {
        let global = self.slots.names.globals.get(name).copied();
        if global.is_some_and(|global| global.array.is_some() || global.macro_id.is_some()) {
            let message = format!("{name} is an array or macro");
            self.report(CompileCode::ArrayMisuse, span, message);
        }
        let known = self.slots.param(name).or(global.and_then(|g| self.slots.registers[g.symbol]));
        let reg = match known {
            Some(reg) => reg,
            None => {
                let reg = self.new_variable(name, span);
                if let Some(global) = global {
                    self.slots.registers[global.symbol] = Some(reg);
                }
                reg
            }
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
        let first = self.slots.next;
        if first + count > u32::from(FIRST_TEMPORARY) {
            self.report_too_many(span, FIRST_TEMPORARY.into(), "names, constants and loops");
            return 0;
        }
        self.slots.next += count;
        self.module.registers = self.slots.next;
        first as Reg
    }

    /// The register that holds a number.
    pub(super) fn number(&mut self, number: f64, span: Span) -> Reg {
        if let Some(reg) = self.slots.numbers.get(&number.to_bits()) {
            return *reg;
        }
        let reg = self.reserve(1, span);
        self.slots.numbers.insert(number.to_bits(), reg);
        self.module.constants.push((reg, Constant::Number(number)));
        reg
    }

    /// The register that holds a word.
    pub(super) fn word_register(&mut self, id: WordId, span: Span) -> Reg {
        if let Some(reg) = self.slots.words.get(&id) {
            return *reg;
        }
        let reg = self.reserve(1, span);
        self.slots.words.insert(id, reg);
        self.module.constants.push((reg, Constant::Word(id)));
        reg
    }

    /// The register that holds a text.
    pub(super) fn text(&mut self, text: &str, span: Span) -> Reg {
        if let Some(reg) = self.slots.texts.get(text) {
            return *reg;
        }
        let reg = self.reserve(1, span);
        self.slots.texts.insert(text.to_string(), reg);
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
