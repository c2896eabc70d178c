//! Arrays of RESERV and tables of DATA.

use fil_diag::suggest::did_you_mean;
use fil_syntax::tree::{Expr, ExprKind, Name, Span};

use super::Compiler;
use crate::errors::CompileCode;
use crate::module::{ArrayShape, Constant};
use crate::ops::{Op, Reg};

impl<'t> Compiler<'t> {
    /// An array of `RESERV/name,size`.
    pub(super) fn declare_array(&mut self, name: &'t str, span: Span, size: &'t Expr) {
        let given = self.constant(size).filter(|n| *n >= 1.0 && n.fract() == 0.0);
        // A number too large for usize is too large for the limit as well.
        self.add_array(name, span, given.unwrap_or_default() as usize, false, size.span);
        if given.is_none() {
            let message = format!("the size of {name} is no constant of 1 or more");
            self.report(CompileCode::BadArraySize, size.span, message);
        }
    }

    /// The form of a `DATA/` statement; its table is declared before anything runs.
    pub(super) fn check_data(&mut self, word: &Name, args: &[Expr]) {
        if self.refuse_extension("DATA/", word.span) {
            return;
        }
        match args {
            [Expr { kind: ExprKind::Name(_), .. }, _, ..] => {}
            [Expr { kind: ExprKind::Name(_), .. }] => {
                self.wrong_count("DATA/", "a name and one value or more", args.len(), word.span);
            }
            _ => {
                let message = "DATA/ takes a name and values";
                self.report(CompileCode::NotConstant, word.span, message);
            }
        }
    }

    /// A table of `DATA/name,v1,v2,…`.
    pub(super) fn declare_data(&mut self, name: &'t str, span: Span, values: &'t [Expr]) {
        let start = self.add_array(name, span, values.len(), true, span);
        for (offset, value) in values.iter().enumerate() {
            let constant = match &value.kind {
                ExprKind::Text(text) => Some(Constant::Text(text.clone())),
                _ => match self.word_code(value) {
                    Some(id) => Some(Constant::Word(id)),
                    None => self.constant(value).map(Constant::Number),
                },
            };
            match constant {
                Some(constant) => self.module.data.push((start + offset, constant)),
                None => {
                    let message = format!("value {} of {name} is no constant", offset + 1);
                    self.report(CompileCode::NotConstant, value.span, message);
                }
            }
        }
    }

    /// Adds an array and gives its first element. One that does not fit has no elements,
    /// so that the arrays behind it keep their numbers.
    fn add_array(
        &mut self,
        name: &'t str,
        span: Span,
        len: usize,
        read_only: bool,
        size: Span,
    ) -> usize {
        let start = self.module.arrays.last().map_or(0, |array| array.start + array.len);
        let room = self.limits.array_elements.saturating_sub(start);
        if len > room {
            let message = format!("{name} passes the limit; {room} elements are left");
            self.report(CompileCode::BadArraySize, size, message);
        }
        if self.added_function(name).is_some() {
            let message = format!("{name} is a function of the embedding program");
            self.report(CompileCode::DefinedTwice, span, message);
        }
        self.index(self.module.arrays.len(), span, "arrays");
        let len = if len > room { 0 } else { len };
        self.module.arrays.push(ArrayShape { name: name.to_string(), start, len, read_only });
        start
    }

    /// The array that an assignment changes; `None` after an error.
    pub(super) fn writable_array(&mut self, name: &Name) -> Option<u16> {
        let Some(array) = self.slots.names.array(&name.text) else {
            let message = format!("{} is no array; RESERV reserves one", name.text);
            let hint = did_you_mean(&name.text, self.slots.names.array_names());
            self.report_with(CompileCode::UnknownFunction, name.span, message, hint);
            return None;
        };
        if self.module.arrays[usize::from(array)].read_only {
            let message = format!("{} is a table of DATA/ and can't be changed", name.text);
            self.report(CompileCode::ArrayMisuse, name.span, message);
            return None;
        }
        Some(array)
    }

    /// `SIZEF(name)`
    pub(super) fn array_size(&mut self, args: &[Expr], span: Span, dst: Reg) {
        let [Expr { kind: ExprKind::Name(name), span: name_span }] = args else {
            let message = "SIZEF takes the name of an array";
            self.report(CompileCode::WordExpected, span, message);
            return;
        };
        match self.slots.names.array(name) {
            Some(array) => {
                let len = self.module.arrays[usize::from(array)].len;
                let src = self.number(len as f64, span);
                self.chunk.emit(Op::Move { dst, src });
            }
            None => {
                let message = format!("{name} is no array");
                self.report(CompileCode::UnknownFunction, *name_span, message);
            }
        }
    }
}
