//! The macros that edit what the post writes: their parameters.

use super::Compiler;
use crate::errors::CompileCode;
use crate::output::{OutputMacro, REPOSITION, WordParameter, word_named};

impl Compiler<'_> {
    /// Finds them among the macros; what a macro edits comes and goes in its parameters.
    pub(super) fn output_macros(&mut self) {
        for id in 0..self.slots.names.macros.len() {
            let entry = &self.slots.names.macros[id];
            let (definition, unit) = (entry.definition, entry.unit);
            let Some(edits) = OutputMacro::named(&definition.name.text) else { continue };
            let chunk = self.module.macros[id];
            let registers = self.slots.macros[id].clone();
            self.within(unit, |this| {
                let name = &definition.name;
                if let Some((param, _)) = definition.params.iter().find(|(_, d)| d.is_some()) {
                    let message = format!("{} takes no defaults: the post gives {}", name.text, param.text);
                    this.report(CompileCode::WrongArguments, param.span, message);
                    return;
                }
                if edits == OutputMacro::Words {
                    let mut words = Vec::with_capacity(registers.len());
                    for ((param, _), register) in definition.params.iter().zip(registers) {
                        let Some((letter, before)) = word_named(&param.text) else {
                            let message = format!("{} is no word of a block", param.text);
                            let hint = Some("parameters are letters: X, F, G for the first G, G2 for the second".to_string());
                            this.report_with(CompileCode::WrongArguments, param.span, message, hint);
                            return;
                        };
                        words.push(WordParameter { letter, before, register });
                    }
                    if this.module.output.words.replace((chunk, words)).is_some() {
                        let message = "_OUTPTP and _OUTPUT are two names of one macro";
                        this.report(CompileCode::DefinedTwice, name.span, message);
                    }
                    return;
                }
                if edits == OutputMacro::Reposition {
                    let mut known = Vec::with_capacity(registers.len());
                    for ((param, _), register) in definition.params.iter().zip(registers) {
                        let at = REPOSITION.iter().position(|name| *name == param.text);
                        let Some(at) = at else {
                            let message = format!("the post gives _REPOS no {}", param.text);
                            let hint = Some(format!("parameters are {}", REPOSITION.join(", ")));
                            this.report_with(CompileCode::WrongArguments, param.span, message, hint);
                            return;
                        };
                        known.push((at, register));
                    }
                    if known.is_empty() {
                        let message = "_REPOS without a parameter decides nothing";
                        let hint = Some(format!("parameters are {}", REPOSITION.join(", ")));
                        this.report_with(CompileCode::WrongArguments, name.span, message, hint);
                        return;
                    }
                    this.module.output.reposition = Some((chunk, known));
                    return;
                }
                let [register] = registers[..] else {
                    let message = format!("{} has one parameter, the line", name.text);
                    let hint = Some(format!("write {}=MACRO/LINE", name.text));
                    this.report_with(CompileCode::WrongArguments, name.span, message, hint);
                    return;
                };
                let output = &mut this.module.output;
                match edits {
                    OutputMacro::Tape => output.tape = Some((chunk, register)),
                    _ => output.listing = Some((chunk, register)),
                }
            });
        }
    }
}
