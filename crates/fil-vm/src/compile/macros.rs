//! Macros: definition, call, and the refusal of recursion.

use fil_syntax::tree::{Expr, Macro, Name, Span};

use super::Compiler;
use crate::errors::CompileCode;
use crate::ops::Op;

impl<'t> Compiler<'t> {
    pub(super) fn macro_definition(&mut self, definition: &'t Macro) {
        // A second one of the name has been reported, and so have more than there are numbers.
        let id = self.slots.names.macro_id(&definition.name.text).map(usize::from);
        let own = |id: &usize| std::ptr::eq(self.slots.names.macros[*id].definition, definition);
        let Some(id) = id.filter(own) else { return };
        let params = definition.params.iter().zip(&self.slots.macros[id]);
        self.slots.params = params.map(|((name, _), reg)| (name.text.as_str(), *reg)).collect();
        self.inside = Some(id as u16);
        let title = format!("macro {}", definition.name.text);
        let chunk = self.build_chunk(title, definition.span, |this| {
            this.collect_labels(&definition.body, &mut Vec::new());
            this.statements(&definition.body);
        });
        self.module.macros[id] = chunk;
        let parameters = self.slots.params.iter().map(|(name, reg)| (name.to_string(), *reg));
        self.module.chunks[usize::from(chunk)].parameters = parameters.collect();
        self.inside = None;
        self.slots.params.clear();
    }

    pub(super) fn call_macro(&mut self, name: &Name, args: &[(Option<Name>, Expr)], span: Span) {
        // A macro that is not there has been reported.
        let Some(id) = self.slots.names.macro_id(&name.text) else { return };
        if let Some(caller) = self.inside {
            self.calls[usize::from(caller)].push((id, self.unit, span));
        }
        let entry = &self.slots.names.macros[usize::from(id)];
        let (definition, unit) = (entry.definition, entry.unit);
        let registers = self.slots.macros[usize::from(id)].clone();
        let mut given = vec![false; registers.len()];
        for (position, (arg_name, value)) in args.iter().enumerate() {
            let index = match arg_name {
                Some(arg) => definition.params.iter().position(|(p, _)| p.text == arg.text),
                None => (position < registers.len()).then_some(position),
            };
            let Some(index) = index else {
                let shown = arg_name.as_ref().map_or("argument of that position", |a| &a.text);
                let message = format!("{} has no {shown}", name.text);
                self.report(CompileCode::WrongArguments, value.span, message);
                continue;
            };
            if std::mem::replace(&mut given[index], true) {
                let param = &definition.params[index].0.text;
                let message = format!("{param} is given twice");
                self.report(CompileCode::WrongArguments, value.span, message);
            }
            self.expression_into(value, registers[index]);
        }
        for (index, (param, default)) in definition.params.iter().enumerate() {
            match default {
                _ if given[index] => {}
                Some(default) => self.default_value(default, unit, registers[index]),
                None => {
                    let message = format!("{} needs {}", name.text, param.text);
                    self.report(CompileCode::WrongArguments, span, message);
                }
            }
        }
        self.chunk.emit(Op::Call { macro_id: id });
    }

    /// A default belongs to the macro's file and sees no parameters of the caller.
    fn default_value(&mut self, default: &'t Expr, unit: usize, dst: u16) {
        let params = std::mem::take(&mut self.slots.params);
        self.within(unit, |this| this.expression_into(default, dst));
        self.slots.params = params;
    }

    /// Parameters have one place each, so no macro may run inside itself.
    pub(super) fn refuse_recursion(&mut self) {
        // 0 not seen, 1 on the way, 2 done.
        let mut state = vec![0u8; self.calls.len()];
        for start in 0..self.calls.len() {
            let mut way = vec![(start, 0)];
            if state[start] != 0 {
                continue;
            }
            state[start] = 1;
            while let Some((at, next)) = way.pop() {
                let Some((callee, unit, span)) = self.calls[at].get(next).copied() else {
                    state[at] = 2;
                    continue;
                };
                way.push((at, next + 1));
                let callee = usize::from(callee);
                match state[callee] {
                    0 => {
                        state[callee] = 1;
                        way.push((callee, 0));
                    }
                    1 => self.report_recursion(callee, unit, span),
                    _ => {}
                }
            }
        }
    }

    fn report_recursion(&mut self, id: usize, unit: usize, span: Span) {
        let name = &self.slots.names.macros[id].definition.name.text;
        let message = format!("this call leads back into {name}");
        self.within(unit, |this| this.report(CompileCode::RecursiveMacro, span, message));
    }
}
