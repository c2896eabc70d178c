//! Post words: how a statement becomes a template of a CL record.

use fil_cl::layout::takes_text;
use fil_syntax::tree::{Expr, ExprKind, Name};

use super::Compiler;
use crate::builtins;
use crate::errors::CompileCode;
use crate::module::{Item, Template};
use crate::ops::Op;

impl Compiler<'_> {
    /// `WORD/args`
    pub(super) fn post(&mut self, word: &Name, args: &[Expr]) {
        let items = args.iter().map(|arg| self.item(arg)).collect();
        self.template(word, items);
    }

    /// `PPRINT text`: a text as written, or the value of the one variable it names.
    /// An element or a call is refused: `PPRINT/'',TAB(1)` writes its value.
    pub(super) fn post_text(&mut self, word: &Name, text: &str) {
        let name = text.trim().to_ascii_uppercase();
        let called = name.strip_suffix(')').and_then(|call| call.split_once('('));
        if called.is_some_and(|(called, _)| self.is_called(called)) || self.are_values(&name) {
            let message = format!("{name} would be written literally, not as its value");
            let hint = format!(
                "for the values {}/'',{name}; for the literal text {0}/'{name}'",
                word.text
            );
            self.report_with(CompileCode::NotYet, word.span, message, Some(hint));
            return;
        }
        let register = if self.is_assigned(&name) {
            self.variable(&name, word.span)
        } else {
            self.text(text, word.span)
        };
        self.template(word, vec![Item::Value(register)]);
    }

    /// True for an array or a function.
    fn is_called(&self, name: &str) -> bool {
        self.slots.names.array(name).is_some()
            || builtins::find(name).is_some()
            || self.added_function(name).is_some()
    }

    /// True for a text of several values and nothing else, as `DIA,LENG` or `DEEP+1`: names
    /// that are set, calls and numbers, with signs between them.
    fn are_values(&self, text: &str) -> bool {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let (mut rest, mut depth, mut values, mut names, mut after_value) = (text, 0, 0, 0, false);
        while let Some(first) = rest.chars().next() {
            let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
            let (value, behind) = rest.split_at(end);
            if value.is_empty() {
                match first {
                    '(' => depth += 1,
                    ')' => depth -= 1,
                    '+' | '-' | '*' | '/' | ',' | ' ' => {}
                    _ => return false,
                }
                after_value = first == ')' || first == ' ' && after_value;
                rest = &rest[1..];
                continue;
            }
            let is_call = behind.starts_with('(') && self.is_called(value);
            let is_number = value.parse::<f64>().is_ok();
            let is_name = is_call || self.is_assigned(value);
            // What stands within a call may be a word.
            if after_value || depth == 0 && !is_number && !is_name {
                return false;
            }
            (values, names) = (values + 1, names + usize::from(is_name));
            (after_value, rest) = (true, behind);
        }
        values > 1 && names > 0
    }

    fn template(&mut self, word: &Name, items: Vec<Item>) {
        let major = self.vocab.intern(&word.text);
        let template =
            Template { major, name: word.text.clone(), items, is_text: takes_text(major) };
        self.module.templates.push(template);
        let template = self.index(self.module.templates.len() - 1, word.span, "post words");
        self.chunk.emit(Op::Post { template });
    }

    /// A bare name is a variable where one of that name is set, else a word.
    fn item(&mut self, arg: &Expr) -> Item {
        match &arg.kind {
            ExprKind::Name(name) if !self.is_variable(name) => Item::Minor(self.vocab.intern(name)),
            _ => Item::Value(self.expression(arg)),
        }
    }
}
