//! Functions, elements of arrays and the forms of TEXT/.

use fil_diag::suggest::did_you_mean;
use fil_syntax::tree::{Expr, ExprKind, Name, Span};

use super::{Resolver, Role, SymbolId, SymbolKind};
use crate::builtins::{self, BUILTINS, FunctionKind};
use crate::constant::constant;
use crate::errors::CompileCode;
use crate::functions::Functions;
use crate::value::Shown;

/// What a name with brackets behind it calls.
#[derive(Clone, Copy)]
pub(super) struct Callee {
    symbol: SymbolId,
    /// The kind of a built-in function or statement.
    kind: Option<FunctionKind>,
}

impl<'t> Resolver<'t, '_> {
    /// `NAME(args)`
    pub(super) fn call(&mut self, name: &'t Name, args: &'t [Expr]) {
        if let Some(array) =
            self.names.globals.get(name.text.as_str()).filter(|g| g.array.is_some())
        {
            let symbol = array.symbol;
            self.used(symbol, name.span, Role::Read);
            args.iter().for_each(|arg| self.expression(arg, Role::Read));
            return;
        }
        if name.text == "TEXT" {
            self.text_arguments(args);
            return;
        }
        let callee = self.callee(&name.text);
        self.used(callee.symbol, name.span, Role::Call);
        match callee.kind {
            Some(kind) => self.arguments(kind, args),
            None => args.iter().for_each(|arg| self.expression(arg, Role::Read)),
        }
        if let (Some(FunctionKind::Postf), Some(number)) =
            (callee.kind, args.first().and_then(constant))
        {
            self.postf(number, args[0].span);
        }
        if self.symbols[callee.symbol].kind == SymbolKind::Unknown {
            let message = format!("{} is neither a function nor an array", name.text);
            let hint = self.function_like(&name.text);
            self.report_with(CompileCode::UnknownFunction, name.span, message, hint);
        }
    }

    fn callee(&mut self, name: &'t str) -> Callee {
        if let Some(callee) = self.callees.get(name) {
            return *callee;
        }
        let built_in = builtins::find(name).map(|index| BUILTINS[index].kind);
        self.new_callee(name, built_in)
    }

    /// A statement of our own: DATA/, WRITE/, ERROR/, WARN/.
    pub(super) fn statement_word(&mut self, word: &'t Name) {
        let callee = match self.callees.get(word.text.as_str()) {
            Some(known) => *known,
            None => self.new_callee(&word.text, Some(FunctionKind::Statement)),
        };
        self.used(callee.symbol, word.span, Role::Call);
    }

    fn new_callee(&mut self, name: &'t str, built_in: Option<FunctionKind>) -> Callee {
        let added = self.input.functions.and_then(|functions| functions.find(name)).is_some();
        let kind = match (built_in, added) {
            (Some(_), _) => SymbolKind::Function,
            (None, true) => SymbolKind::HostFunction,
            (None, false) => SymbolKind::Unknown,
        };
        let callee = Callee { symbol: self.symbol(name, kind), kind: built_in };
        self.callees.insert(name, callee);
        callee
    }

    /// Arguments of a built-in function: some take a word or a name as it is written.
    fn arguments(&mut self, kind: FunctionKind, args: &'t [Expr]) {
        let args = match kind {
            FunctionKind::Library(library, ..) => library.rules(args).0,
            _ => args,
        };
        let written = kind.word_argument();
        // POSTF(3,3,355+X), LASTF(X)
        let outer = self.takes_letters;
        self.takes_letters |= matches!(kind, FunctionKind::Postf | FunctionKind::LastWritten);
        for (index, arg) in args.iter().enumerate() {
            match (&arg.kind, written == Some(index)) {
                (ExprKind::Name(name), true) => match kind {
                    FunctionKind::Size => {
                        let symbol = self.global(name).symbol;
                        self.used(symbol, arg.span, Role::Read);
                    }
                    FunctionKind::WordCode | FunctionKind::Couplet | FunctionKind::HasWord => {
                        self.word(name, arg.span, Role::Asked);
                    }
                    // Words of FILEF, NEXTF, PREVF, TOOLF and the totals alone.
                    _ => {}
                },
                (_, true) => {}
                (_, false) => self.expression(arg, Role::Read),
            }
        }
        self.takes_letters = outer;
    }

    /// What follows TEXT/: a form with its minor word, or values to join.
    pub(super) fn text_arguments(&mut self, args: &'t [Expr]) {
        if let [Expr { kind: ExprKind::Name(word), span }, rest @ ..] = args
            && !self.is_assigned(word)
            && let Some(form) = builtins::find(&format!("TEXT/{word}"))
        {
            let builtin = &BUILTINS[form];
            let callee = self.callee(builtin.name);
            self.used(callee.symbol, *span, Role::Call);
            self.arguments(builtin.kind, rest);
            return;
        }
        self.joined(args);
    }

    /// A number of POSTF.
    fn postf(&mut self, number: f64, span: Span) {
        let known = self.postfs.iter().find(|(known, _)| known.to_bits() == number.to_bits());
        let symbol = match known {
            Some((_, symbol)) => *symbol,
            None => {
                let title = format!("POSTF({})", Shown(number));
                let symbol = self.symbol(title, SymbolKind::Postf);
                self.postfs.push((number, symbol));
                symbol
            }
        };
        self.used(symbol, span, Role::Call);
    }

    /// A hint that names the function or array that was perhaps meant.
    fn function_like(&self, name: &str) -> Option<String> {
        let built_in = BUILTINS.iter().map(|builtin| builtin.name);
        let added = self.input.functions.into_iter().flat_map(Functions::names);
        did_you_mean(name, built_in.chain(self.names.array_names()).chain(added))
    }
}
