//! Built-in functions and POSTF.

use fil_syntax::tree::{Expr, ExprKind, Span};

use super::Compiler;
use crate::builtins::{BUILTINS, Builtin, FunctionKind};
use crate::errors::CompileCode;
use crate::ops::{Op, Reg};
use crate::postf::{Grade, PostfOp};
use crate::totals::{self, TotalsList};
use crate::value::Shown;

/// Words that NEXTF and PREVF take, in the order of the host's coordinates.
const COORDINATES: [&str; 7] = ["X", "Y", "Z", "I", "J", "K", "RAPID"];

impl Compiler<'_> {
    pub(super) fn builtin(&mut self, function: usize, args: &[Expr], span: Span, dst: Reg) {
        let builtin = &BUILTINS[function];
        if builtin.extension && self.refuse_extension(builtin.name, span) {
            return;
        }
        let function = function as u16;
        match (builtin.kind, args) {
            (FunctionKind::Numbers(arity, _), args) if usize::from(arity) == args.len() => {
                let base = self.arguments(args, span);
                self.chunk.emit(Op::Function { dst, function, base });
            }
            (FunctionKind::Fold(_), [first, rest @ ..]) if !rest.is_empty() => {
                let base = self.temporaries(2, span);
                self.expression_into(first, base);
                for (index, arg) in rest.iter().enumerate() {
                    self.expression_into(arg, base + 1);
                    let dst = if index + 1 == rest.len() { dst } else { base };
                    self.chunk.emit(Op::Function { dst, function, base });
                }
            }
            (FunctionKind::Library(library, least, most), args) => {
                self.library(builtin, library, (least, most), args, span, dst);
            }
            (FunctionKind::File, args) => self.file_function(args, span, dst),
            (FunctionKind::Size, args) => self.array_size(args, span, dst),
            (FunctionKind::Postf, [number, args @ ..]) => self.postf(number, args, span, dst),
            (FunctionKind::LastWritten, [letter]) => {
                let letter = self.expression(letter);
                self.chunk.emit(Op::LastWritten { dst, letter });
            }
            (FunctionKind::NamedCommon, [name]) => {
                let name = self.expression(name);
                self.chunk.emit(Op::NamedCommon { dst, name });
            }
            (FunctionKind::PostOption, [name]) => {
                let name = self.expression(name);
                self.chunk.emit(Op::PostOption { dst, name });
            }
            (FunctionKind::Couplet, [word, default @ ..]) if default.len() <= 1 => {
                let Some(word) = self.word(builtin, word) else { return };
                let op = match default.first() {
                    Some(default) => {
                        let default = self.expression(default);
                        Op::Couplet { dst, word, default }
                    }
                    None => Op::CoupletOrFail { dst, word },
                };
                self.chunk.emit(op);
            }
            (FunctionKind::HasWord, [word]) => {
                if let Some(word) = self.word(builtin, word) {
                    self.chunk.emit(Op::HasWord { dst, word });
                }
            }
            (kind @ (FunctionKind::NextMotion | FunctionKind::PreviousMotion), [word]) => {
                let coordinate = match &word.kind {
                    ExprKind::Name(name) => COORDINATES.iter().position(|known| known == name),
                    _ => None,
                };
                match coordinate {
                    Some(word) if matches!(kind, FunctionKind::NextMotion) => {
                        self.chunk.emit(Op::NextMotion { dst, word: word as u16 });
                    }
                    Some(word) => self.chunk.emit(Op::PreviousMotion { dst, word: word as u16 }),
                    None => {
                        let message = format!("{} takes one of X Y Z I J K RAPID", builtin.name);
                        self.report(CompileCode::WordExpected, span, message);
                    }
                }
            }
            (FunctionKind::ToolData, [word]) => match &word.kind {
                ExprKind::Name(name) if name == "DIAMTR" => {
                    self.chunk.emit(Op::ToolDiameter { dst });
                }
                ExprKind::Name(name) if name == "NEXT" => {
                    self.module.asks_totals = true;
                    self.chunk.emit(Op::NextTool { dst });
                }
                _ => {
                    self.report(CompileCode::WordExpected, span, "TOOLF takes DIAMTR or NEXT");
                }
            },
            (FunctionKind::Totals(list @ TotalsList::Program), [word]) => {
                self.totals(list, builtin, word, dst, dst);
            }
            (FunctionKind::Totals(list), [index, word]) if list != TotalsList::Program => {
                let index = self.expression(index);
                self.totals(list, builtin, word, index, dst);
            }
            // A constant unless its argument is no word.
            (FunctionKind::WordCode, [word]) => {
                let hint = match &word.kind {
                    ExprKind::Text(text) => Some(format!("ICODEF({text}), without apostrophes")),
                    _ => None,
                };
                let message = "ICODEF takes a word as it is written";
                self.report_with(CompileCode::WordExpected, span, message, hint);
            }
            _ => self.wrong_count(
                builtin.name,
                &format!("({})", builtin.arguments),
                args.len(),
                span,
            ),
        }
    }

    /// PROGF, TLISTF and OPERF; without an index `index` is any register.
    fn totals(&mut self, list: TotalsList, builtin: &Builtin, word: &Expr, index: Reg, dst: Reg) {
        let found = match &word.kind {
            ExprKind::Name(name) => list.find(name),
            _ => None,
        };
        let Some(word_number) = found else {
            let words: Vec<&str> = list.words().map(|(name, _)| name).collect();
            let message = format!("{} takes one of {}", builtin.name, words.join(" "));
            self.report(CompileCode::WordExpected, word.span, message);
            return;
        };
        self.module.asks_totals = true;
        let what = totals::what(list, word_number);
        self.chunk.emit(Op::Totals { dst, what, index });
    }

    /// The index of a word that a function names.
    fn word(&mut self, builtin: &Builtin, arg: &Expr) -> Option<u16> {
        let ExprKind::Name(name) = &arg.kind else {
            let message = format!("{} takes a word as it is written", builtin.name);
            self.report(CompileCode::WordExpected, arg.span, message);
            return None;
        };
        let id = self.vocab.intern(name);
        let known = self.module.words.iter().position(|word| *word == id);
        let index = known.unwrap_or_else(|| {
            self.module.words.push(id);
            self.module.words.len() - 1
        });
        Some(self.index(index, arg.span, "words"))
    }

    fn postf(&mut self, number: &Expr, args: &[Expr], span: Span, dst: Reg) {
        let Some(constant) = self.constant(number) else {
            let count = args.len() as u16 + 1;
            let base = self.temporaries(count, span);
            for (offset, arg) in std::iter::once(number).chain(args).enumerate() {
                self.expression_into(arg, base.wrapping_add(offset as u16));
            }
            self.chunk.emit(Op::PostfDynamic { dst, base, count });
            return;
        };
        let Some(op) = self.module.compat.operation(constant) else {
            let message = format!("what POSTF({}) does is not known", Shown(constant));
            self.report(CompileCode::UnknownPostf, number.span, message);
            return;
        };
        let wanted = op.info().arguments;
        if wanted.len() != args.len() {
            let name = format!("POSTF({})", Shown(constant));
            let shape = format!("({},{})", Shown(constant), wanted.join(","));
            self.wrong_count(&name, shape.trim_end_matches(",)"), args.len() + 1, span);
            return;
        }
        self.note_own_reading(op, constant as u16, span);
        if op == PostfOp::Word
            && let Some(n) = self.constant(&args[0])
            && f64::from(n as u16) == n
        {
            self.chunk.emit(Op::RecordWord { dst, n: n as u16 });
            return;
        }
        let base = self.arguments(args, span);
        self.chunk.emit(Op::Postf { dst, op: op as u16, base });
    }

    /// Notes the first use of a number whose operation is our own choice; one
    /// that a site has assigned itself is not.
    fn note_own_reading(&mut self, op: PostfOp, number: u16, span: Span) {
        let info = op.info();
        let own = info.grade == Grade::Own && info.number == number;
        if own && !self.noted.contains(&number) {
            self.noted.push(number);
            let message = format!("POSTF({number}): {}", info.doc);
            self.report(CompileCode::OwnReading, span, message);
        }
    }
}
