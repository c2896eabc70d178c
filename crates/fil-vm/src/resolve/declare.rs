//! What must be known before any use is looked at: names that are set, arrays,
//! macros with their parameters.

use fil_syntax::tree::{Expr, ExprKind, Item, Macro, Span, Stmt, StmtKind};

use super::{ArrayEntry, ArraySize, FileSpan, MacroEntry, Resolver, SymbolKind};
use crate::builtins;
use crate::constant::constant;
use crate::errors::CompileCode;
use fil_syntax::walk::inner_bodies;

impl<'t> Resolver<'t, '_> {
    /// Declares the names of all files.
    pub(super) fn declare(&mut self) {
        for unit in 0..self.input.units.len() {
            self.unit = unit;
            let units = self.input.units;
            for item in &units[unit].program.items {
                match item {
                    Item::Stmt(stmt) => self.declare_in(std::slice::from_ref(stmt), &[]),
                    Item::Section(section) => self.declare_in(&section.body, &[]),
                    Item::Macro(definition) => {
                        let parameters: Vec<&str> =
                            definition.params.iter().map(|(name, _)| name.text.as_str()).collect();
                        self.declare_in(&definition.body, &parameters);
                        self.declare_macro(definition);
                    }
                }
            }
        }
    }

    fn declare_in(&mut self, body: &'t [Stmt], parameters: &[&str]) {
        for stmt in body {
            match &stmt.kind {
                StmtKind::Assign { target, .. }
                | StmtKind::Text { target, .. }
                | StmtKind::Do { variable: target, .. }
                    if target.index.is_none()
                        && !parameters.contains(&target.name.text.as_str()) =>
                {
                    let computes = match &stmt.kind {
                        StmtKind::Assign { value, .. } => constant(value).is_none(),
                        StmtKind::Text { .. } => true,
                        _ => false,
                    };
                    let global = self.global(&target.name.text);
                    global.assigned = true;
                    global.computed |= computes;
                }
                StmtKind::Reserv { arrays } => {
                    for (name, size) in arrays {
                        let size = ArraySize::Reserved(size);
                        self.declare_array(&name.text, name.span, size, SymbolKind::Array);
                    }
                }
                StmtKind::Post { word, args } if word.text == "DATA" => {
                    // Other forms the compiler refuses.
                    if let [Expr { kind: ExprKind::Name(name), span }, values @ ..] =
                        args.as_slice()
                    {
                        let size = ArraySize::Values(values);
                        self.declare_array(name, *span, size, SymbolKind::Table);
                    }
                }
                _ => {}
            }
            inner_bodies(stmt, &mut |inner| self.declare_in(inner, parameters));
        }
    }

    fn declare_array(&mut self, name: &'t str, span: Span, size: ArraySize<'t>, kind: SymbolKind) {
        let id = self.names.arrays.len() as u16;
        self.names.arrays.push(ArrayEntry { unit: self.unit, name, span, size });
        let global = self.global(name);
        let (symbol, known) = (global.symbol, global.array);
        global.array = known.or(Some(id));
        self.symbols[symbol].kind = kind;
        self.define(symbol, span);
        if known.is_some() {
            let message = format!("the array {name} is reserved already");
            self.report(CompileCode::DefinedTwice, span, message);
        } else if builtins::find(name).is_some() {
            let message = format!("{name} is a function of FIL; an array would hide it");
            self.report(CompileCode::DefinedTwice, span, message);
        }
    }

    fn declare_macro(&mut self, definition: &'t Macro) {
        let name = &definition.name;
        let id = self.names.macros.len() as u16;
        self.names.macros.push(MacroEntry { definition, unit: self.unit });
        let global = self.global(&name.text);
        let (symbol, known) = (global.symbol, global.macro_id);
        global.macro_id = Some(id);
        self.symbols[symbol].kind = SymbolKind::Macro;
        self.symbols[symbol].extent = Some(FileSpan { file: self.unit, span: definition.span });
        self.define(symbol, name.span);
        if known.is_some() {
            let message = format!("the macro {} is defined already", name.text);
            self.report(CompileCode::DefinedTwice, name.span, message);
        }
        let mut parameters = Vec::with_capacity(definition.params.len());
        for (index, (parameter, _)) in definition.params.iter().enumerate() {
            if definition.params[..index].iter().any(|(other, _)| other.text == parameter.text) {
                let message = format!("{} has two parameters {}", name.text, parameter.text);
                self.report(CompileCode::DefinedTwice, parameter.span, message);
            }
            let own = self.symbol(parameter.text.as_str(), SymbolKind::Parameter);
            self.symbols[own].owner = Some(symbol);
            self.define(own, parameter.span);
            parameters.push(own);
        }
        self.parameters.push(parameters);
    }
}
