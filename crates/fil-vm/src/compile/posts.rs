//! Post words: how a statement becomes a template of a CL record.

use fil_cl::record::{kind, motion};
use fil_syntax::tree::{Expr, ExprKind, Name, Span};

use super::Compiler;
use crate::errors::CompileCode;
use crate::module::{Item, Template};
use crate::ops::Op;

/// Words whose record is a text.
const TEXT_WORDS: [&str; 7] =
    ["PPRINT", "INSERT", "PARTNO", "LETTER", "REMARK", "TITLES", "TPRINT"];

impl Compiler<'_> {
    /// `WORD/args`
    pub(super) fn post(&mut self, word: &Name, args: &[Expr], span: Span) {
        let mut items: Vec<Item> = args.iter().map(|arg| self.item(arg)).collect();
        let Some((kind, sub)) = layout(&word.text, &mut items) else {
            let message = format!("{} needs numbers in the number its layout asks for", word.text);
            self.report(CompileCode::BadPostWord, span, message);
            return;
        };
        if kind == kind::SURFACE {
            // Modifier, surface type 4 = circle, seven values.
            for (index, number) in [0.0, 4.0, 7.0].into_iter().enumerate() {
                items.insert(index, Item::Value(self.number(number, span)));
            }
        }
        self.template(word, kind, sub, items);
    }

    /// `PPRINT text`: a text as written, or the value of the one variable it names.
    pub(super) fn post_text(&mut self, word: &Name, text: &str) {
        let name = text.trim().to_ascii_uppercase();
        let register = if self.is_assigned(&name) {
            self.variable(&name, word.span)
        } else {
            self.text(text, word.span)
        };
        self.template(word, kind::POST, 0, vec![Item::Value(register)]);
    }

    fn template(&mut self, word: &Name, kind: u32, sub: u32, items: Vec<Item>) {
        let template = Template {
            major: self.vocab.intern(&word.text),
            name: word.text.clone(),
            kind,
            sub,
            items,
            is_text: TEXT_WORDS.contains(&word.text.as_str()),
        };
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

/// Type and subtype of a word's record; puts the empty slots of its layout in
/// place. `None` when the items do not fit.
fn layout(word: &str, items: &mut Vec<Item>) -> Option<(u32, u32)> {
    let (kind, sub, counts): (u32, u32, &[usize]) = match word {
        "GOTO" => (kind::MOTION, motion::GOTO, &[3, 6]),
        "FROM" => (kind::MOTION, motion::FROM, &[3, 6]),
        "GODLTA" => (kind::MOTION, motion::GODLTA, &[3]),
        "CIRCLE" => (kind::SURFACE, 2, &[6, 7]),
        "CUTTER" => return Some((kind::CUTTER, 6)),
        "TLAXIS" => return Some((kind::MODE, 1)),
        "MULTAX" => return Some((kind::MODE, 2)),
        "FINI" => return Some((kind::FINI, 0)),
        _ => return Some((kind::POST, 0)),
    };
    let all_values = items.iter().all(|item| matches!(item, Item::Value(_)));
    if !all_values || !counts.contains(&items.len()) {
        return None;
    }
    items.splice(0..0, [Item::Empty, Item::Empty]);
    Some((kind, sub))
}
