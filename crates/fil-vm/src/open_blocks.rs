//! E0223: a block without its end in which the section sends its record on.
//!
//! The parser closes such a block at CIMFIL/OFF and warns. Where the record is taken
//! either way that is safe enough; where the block holds POSTF(13) the missing end
//! decides which records reach the post, and nobody knows where it was to stand.

use fil_cl::record::kind;
use fil_cl::vocabulary::words as w;
use fil_cl::{Vocabulary, WordId};
use fil_diag::{Code, Diag, Level};
use fil_syntax::SyntaxCode;
use fil_syntax::tree::{Expr, ExprKind, Item, Section, SectionKey, Span, Stmt, StmtKind};

use crate::allow::Allowed;
use crate::compile::files::{Found, Unit};

use crate::constant::constant;
use crate::errors::CompileCode;
use crate::postf::{Compat, PostfOp};
use crate::resolve::Names;
use fil_syntax::walk::{all_expressions, inner_bodies};

/// Calls of macros and INCLUD that are followed; deeper ones are taken to send.
const DEEPEST: u32 = 50;

/// Turns the warnings of such blocks into errors, unless they are allowed.
pub(crate) fn refuse(search: Search<'_>, allowed: &Allowed<'_>, diags: &mut [Diag]) {
    for (number, unit) in search.units.iter().enumerate() {
        for item in &unit.program.items {
            let Item::Section(section) = item else { continue };
            for span in &section.left_open {
                let Some(sent) = search.sent_in_block(number, section, *span) else { continue };
                let place = unit.file.place(*span);
                let mut error = Diag::new(CompileCode::OpenAroundRecord, String::new()).at(place);
                if allowed.level(&error) == Level::Allow {
                    continue;
                }
                let is_it = |diag: &&mut Diag| {
                    diag.code == <&Code>::from(SyntaxCode::ClosedBySection)
                        && diag.spans.first() == error.spans.first()
                };
                if let Some(warning) = diags.iter_mut().find(is_it) {
                    error.message = format!("{}, and {sent} is in it", warning.message);
                    error.spans.clone_from(&warning.spans);
                    *warning = error;
                }
            }
        }
    }
}

/// What the search looks at.
pub(crate) struct Search<'a> {
    pub units: &'a [Unit],
    pub found: &'a Found,
    pub names: &'a Names<'a>,
    pub compat: &'a Compat,
    pub vocabulary: &'a Vocabulary,
}

impl Search<'_> {
    /// What sends the record of the section within the block that begins at `span`.
    fn sent_in_block(&self, unit: usize, section: &Section, span: Span) -> Option<String> {
        let block = block_at(&section.body, span)?;
        self.sent_by(unit, block, &section.key, 0)
    }

    fn sent_in(&self, unit: usize, body: &[Stmt], key: &SectionKey, depth: u32) -> Option<String> {
        body.iter().find_map(|stmt| self.sent_by(unit, stmt, key, depth))
    }

    fn sent_by(&self, unit: usize, stmt: &Stmt, key: &SectionKey, depth: u32) -> Option<String> {
        if depth > DEEPEST {
            return Some("a deep call".to_string());
        }
        let mut sent = None;
        all_expressions(stmt, &mut |expr| sent = sent.take().or_else(|| self.postf(expr)));
        if sent.is_some() {
            return sent;
        }
        match &stmt.kind {
            StmtKind::Post { word, .. } if self.sends_on(key, &word.text) => {
                return Some(word.text.clone());
            }
            StmtKind::Call { name, .. } => {
                let id = self.names.macro_id(&name.text)?;
                let called = &self.names.macros[usize::from(id)];
                let inner = self.sent_in(called.unit, &called.definition.body, key, depth + 1);
                return inner.map(|sent| format!("{sent} of the macro {}", name.text));
            }
            StmtKind::Includ { file } => {
                let included = *self.found.included.get(&(unit, stmt.span.start))?;
                let items = self.units[included].program.items.iter();
                let mut statements = items.filter_map(|item| match item {
                    Item::Stmt(stmt) => Some(stmt),
                    _ => None,
                });
                let inner =
                    statements.find_map(|stmt| self.sent_by(included, stmt, key, depth + 1));
                return inner.map(|sent| format!("{sent} of '{file}'"));
            }
            _ => {}
        }
        let mut sent = None;
        inner_bodies(stmt, &mut |body| {
            sent = sent.take().or_else(|| self.sent_in(unit, body, key, depth));
        });
        sent
    }

    /// POSTF of an operation that sends the record, or of one that only the run knows.
    fn postf(&self, expr: &Expr) -> Option<String> {
        let ExprKind::Call { name, args } = &expr.kind else { return None };
        let number = args.first().filter(|_| name.text == "POSTF")?;
        match constant(number) {
            None => Some("POSTF with a computed number".to_string()),
            Some(number) if self.compat.operation(number) == Some(PostfOp::Process) => {
                Some(format!("POSTF({number})"))
            }
            Some(_) => None,
        }
    }

    /// True for a post word that does the work of the record the section takes, and for
    /// END, which may be meant to end the block.
    fn sends_on(&self, key: &SectionKey, word: &str) -> bool {
        match (key, self.vocabulary.find(word)) {
            (_, Some(w::END)) => true,
            (SectionKey::Words { major, .. }, _) if major.text == word => true,
            (SectionKey::Words { major, .. }, Some(word)) => {
                let major = self.vocabulary.find(&major.text);
                ALIKE.iter().any(|alike| {
                    alike.contains(&word) && major.is_some_and(|major| alike.contains(&major))
                })
            }
            (SectionKey::Types { kind: kind::POST, .. }, Some(word)) => !is_own_output(word),
            (SectionKey::Types { .. }, Some(word)) => ALIKE[0].contains(&word),
            (_, None) => false,
        }
    }
}

/// Words of which each can do the work of the others: motions, tool changes.
const ALIKE: [&[WordId]; 2] = [
    &[w::GOTO, w::FROM, w::GODLTA, w::CIRCLE],
    &[w::LOADTL, w::LOAD, w::TURRET, w::TOOLNO, w::SELCTL, w::SELECT],
];

/// Words that write of their own, whatever record is current.
fn is_own_output(word: WordId) -> bool {
    matches!(word, w::POSTN | w::REPEAT | w::PPRINT | w::INSERT | w::TRANS)
}

/// The block whose opening line is at `span`.
fn block_at(body: &[Stmt], span: Span) -> Option<&Stmt> {
    for stmt in body {
        let is_block = !matches!(stmt.kind, StmtKind::IfOne { .. });
        if stmt.span == span && is_block {
            return Some(stmt);
        }
        let mut found = None;
        inner_bodies(stmt, &mut |inner| found = found.or_else(|| block_at(inner, span)));
        if found.is_some() {
            return found;
        }
    }
    None
}
