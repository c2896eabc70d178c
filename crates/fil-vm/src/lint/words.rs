//! W0242: words that are in no vocabulary and near one that is.

use std::collections::HashSet;

use fil_syntax::tree::{ExprKind, Name, SectionKey, Span, StmtKind};

use super::context::Context;
use super::flow::Action;
use super::walk::{calls, word_argument};
use crate::builtins;
use crate::compile::names::letter;
use crate::errors::LintCode;

/// Warns of keys of sections and of words in post words. A word that the
/// program asks for elsewhere is one of its own.
pub(super) fn look(context: &mut Context<'_>) {
    let own = own_words(context);
    let mut found = Vec::new();
    let mut note = |unit: usize, word: &str, span: Span| {
        let hint =
            context.vocabulary.find(word).and_then(|id| context.vocabulary.perhaps_meant(id));
        if let Some(hint) = hint {
            let message = format!("{word} is in no vocabulary");
            found.push(context.diag(LintCode::MisspeltWord, unit, span, message).hint(hint));
        }
    };
    for (unit, section) in context.sections() {
        if let SectionKey::Words { major, minors } = &section.key {
            std::iter::once(major).chain(minors).for_each(|word| note(unit, &word.text, word.span));
        }
    }
    for body in &context.bodies {
        for node in &body.graph.nodes {
            let Action::Plain(stmt) = node.action else { continue };
            let StmtKind::Post { word, args } = &stmt.kind else { continue };
            if builtins::is_statement(&word.text) {
                continue;
            }
            note(node.unit, &word.text, word.span);
            for arg in args {
                if let ExprKind::Name(name) = &arg.kind
                    && letter(name).is_none()
                    && !context.is_assigned(name)
                    && !own.contains(name.as_str())
                {
                    note(node.unit, name, arg.span);
                }
            }
        }
    }
    context.diags.extend(found);
}

/// Words that functions ask for, as in ICODEF(EMBOSL), and parameters.
fn own_words<'t>(context: &Context<'t>) -> HashSet<&'t str> {
    let mut words = HashSet::new();
    for body in &context.bodies {
        for node in &body.graph.nodes {
            calls(node.action, &mut |name: &Name, args, _| {
                let word = word_argument(name).and_then(|index| args.get(index));
                if let Some(ExprKind::Name(word)) = word.map(|arg| &arg.kind) {
                    words.insert(word.as_str());
                }
            });
        }
        if let super::context::Owner::Macro(definition) = body.owner {
            words.extend(definition.params.iter().map(|(param, _)| param.text.as_str()));
        }
    }
    words
}
