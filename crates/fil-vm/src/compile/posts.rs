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
        if let Some((called, _)) = name.strip_suffix(')').and_then(|call| call.split_once('('))
            && (self.slots.names.array(called).is_some()
                || builtins::find(called).is_some()
                || self.added_function(called).is_some())
        {
            let message = format!("{name} would be written as it stands, not as its value");
            self.report(CompileCode::NotYet, word.span, message);
            return;
        }
        let register = if self.is_assigned(&name) {
            self.variable(&name, word.span)
        } else {
            self.text(text, word.span)
        };
        self.template(word, vec![Item::Value(register)]);
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
