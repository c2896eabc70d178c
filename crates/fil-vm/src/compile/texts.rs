//! TEXT/, the functions on texts and on the world outside, WRITE/, ERROR/ and WARN/.

use fil_syntax::tree::{Expr, ExprKind, Name, Span, Target};

use super::Compiler;
use crate::builtins::{self, Builtin};
use crate::errors::CompileCode;
use crate::library::{FileOp, Library, LibraryCall, NumberRules};
use crate::ops::{Op, Reg};

impl Compiler<'_> {
    /// `NAME=TEXT/…`
    pub(super) fn assign_text(&mut self, target: &Target, args: &[Expr], span: Span) {
        let Some(index) = &target.index else {
            self.warn_of_letter(target, None);
            let dst = self.variable(&target.name.text, target.name.span);
            self.text_value(args, span, dst);
            return;
        };
        let Some(array) = self.writable_array(&target.name) else { return };
        let index = self.expression(index);
        let src = self.temporary(span);
        self.text_value(args, span, src);
        self.chunk.emit(Op::Store { array, index, src });
    }

    /// What follows TEXT/: a form with its minor word, or values to join.
    pub(super) fn text_value(&mut self, args: &[Expr], span: Span, dst: Reg) {
        if let [Expr { kind: ExprKind::Name(word), span: word_span }, rest @ ..] = args
            && let Some(form) = builtins::find(&format!("TEXT/{word}"))
        {
            if self.is_assigned(word) {
                let message = format!("TEXT/{word} is a form, but {word} is set as a name too");
                self.report(CompileCode::NotYet, *word_span, message);
                return;
            }
            self.builtin(form, rest, span, dst);
            return;
        }
        for arg in args {
            if let ExprKind::Name(name) = &arg.kind
                && !self.is_variable(name)
            {
                let message = format!("{name} is neither set nor the first word of a TEXT/ form");
                self.report(CompileCode::NotYet, arg.span, message);
                return;
            }
        }
        let count = args.len() as u16;
        let base = self.values(args, span);
        self.chunk.emit(Op::TextJoin { dst, base, count });
    }

    /// A call of the library with least and most arguments, rules of numbers apart.
    pub(super) fn library(
        &mut self,
        builtin: &Builtin,
        library: Library,
        (least, most): (u16, u16),
        args: &[Expr],
        span: Span,
        dst: Reg,
    ) {
        let (args, rules) = library.rules(args);
        if !(usize::from(least)..=usize::from(most)).contains(&args.len()) {
            self.wrong_count(builtin.name, &builtin.call(), args.len(), span);
            return;
        }
        self.library_call(library, args, rules, span, dst);
    }

    /// `FILEF(unit,op,name)`
    pub(super) fn file_function(&mut self, args: &[Expr], span: Span, dst: Reg) {
        let [unit, op, name @ ..] = args else {
            self.wrong_count("FILEF", "(unit,op[,name])", args.len(), span);
            return;
        };
        let found = match &op.kind {
            ExprKind::Name(word) => FileOp::WORDS.iter().find(|(known, _)| known == word),
            _ => None,
        };
        let Some((word, op)) = found else {
            let words: Vec<&str> = FileOp::WORDS.iter().map(|(word, _)| *word).collect();
            let message = format!("FILEF takes one of {}", words.join(" "));
            self.report(CompileCode::WordExpected, op.span, message);
            return;
        };
        if name.len() != usize::from(op.takes_name()) {
            let shape = if op.takes_name() { "(unit,op,name)" } else { "(unit,op)" };
            self.wrong_count(&format!("FILEF with {word}"), shape, args.len(), span);
            return;
        }
        let args: Vec<Expr> = std::iter::once(unit).chain(name).cloned().collect();
        self.library_call(Library::File(*op), &args, NumberRules::default(), span, dst);
    }

    /// `WRITE/unit,values`
    pub(super) fn write_line(&mut self, word: &Name, args: &[Expr]) {
        if self.refuse_extension("WRITE/", word.span) {
            return;
        }
        if args.is_empty() {
            self.wrong_count("WRITE/", "unit,v1,v2,…", 0, word.span);
            return;
        }
        let dst = self.temporary(word.span);
        self.library_call(Library::WriteLine, args, NumberRules::default(), word.span, dst);
    }

    /// `ERROR/values` and `WARN/values`
    pub(super) fn message(&mut self, library: Library, word: &Name, args: &[Expr]) {
        let name = format!("{}/", word.text);
        if self.refuse_extension(&name, word.span) {
            return;
        }
        if args.is_empty() {
            self.wrong_count(&name, "item,…", 0, word.span);
            return;
        }
        let dst = self.temporary(word.span);
        self.library_call(library, args, NumberRules::default(), word.span, dst);
    }

    /// Refuses an extension under `--strict`; true when it did.
    pub(super) fn refuse_extension(&mut self, name: &str, span: Span) -> bool {
        if self.strict {
            self.report(CompileCode::Extension, span, format!("{name} is an extension"));
        }
        self.strict
    }

    fn library_call(
        &mut self,
        library: Library,
        args: &[Expr],
        rules: NumberRules,
        span: Span,
        dst: Reg,
    ) {
        self.module.asks_totals |= matches!(library, Library::TotalsText(_));
        let base = self.arguments(args, span);
        let call = LibraryCall { library, base, count: args.len() as u16, rules };
        self.module.calls.push(call);
        let call = self.index(self.module.calls.len() - 1, span, "calls of texts and files");
        self.chunk.emit(Op::Library { dst, call });
    }
}
