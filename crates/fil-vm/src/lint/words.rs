//! W0242 to W0246: words that are in no vocabulary or have no effect, and variables
//! with the name of a word.

use fil_cl::WordId;
use fil_cl::vocabulary::words;

use super::context::Context;
use crate::compile::names::letter;
use crate::errors::LintCode;
use crate::resolve::{Role, Symbol, SymbolKind};

/// Warns of words, by how they are used.
pub(super) fn look(context: &mut Context<'_>) {
    let resolution = context.program.resolution;
    for symbol in &resolution.symbols {
        match symbol.kind {
            SymbolKind::Word => word(context, symbol),
            SymbolKind::Variable => name_is_word(context, symbol),
            _ => {}
        }
    }
}

fn word(context: &mut Context<'_>, symbol: &Symbol) {
    let Some(id) = context.vocabulary.find(&symbol.name) else { return };
    let hint = context.vocabulary.perhaps_meant(id);
    let asked = symbol.uses.iter().find(|used| used.role == Role::Asked);
    // A word that functions ask for is one of the program's own.
    let is_own = asked.is_some();
    if let Some(asked) = asked.filter(|_| !context.vocabulary.is_known(id) && hint.is_none()) {
        let message = format!("{} is in no vocabulary", symbol.name);
        context.diags.push(context.at(LintCode::UnknownWord, asked.location, message));
    }
    for used in &symbol.uses {
        let found = match used.role {
            Role::Key => section_word(context, symbol, id),
            Role::Major | Role::Minor if hint.is_some() && !is_own => {
                Some((LintCode::MisspeltWord, format!("{} is in no vocabulary", symbol.name)))
            }
            Role::Major => no_handler(context, symbol, id),
            _ => None,
        };
        if let Some((code, message)) = found {
            let mut diag = context.at(code, used.location, message);
            if code == LintCode::MisspeltWord {
                diag.hint.clone_from(&hint);
            }
            context.diags.push(diag);
        }
    }
}

/// A section for a word that begins no statement.
fn section_word(context: &Context<'_>, symbol: &Symbol, id: WordId) -> Option<(LintCode, String)> {
    let vocabulary = context.vocabulary;
    // CIMFIL/ON,ALL is the section of all records that no other one takes.
    let message =
        if id == words::ALL || vocabulary.is_major(id) || vocabulary.perhaps_meant(id).is_some() {
            return None;
        } else if vocabulary.is_known(id) {
            format!("{} is a minor word, which begins no record", symbol.name)
        } else {
            format!("{} is in no vocabulary", symbol.name)
        };
    Some((LintCode::SectionNeverRuns, message))
}

fn no_handler(context: &Context<'_>, symbol: &Symbol, id: WordId) -> Option<(LintCode, String)> {
    let carries_out = context.facts.carries_out?;
    let message = format!("the post has no handler for {}", symbol.name);
    (!carries_out(id)).then_some((LintCode::NoHandler, message))
}

fn name_is_word(context: &mut Context<'_>, symbol: &Symbol) {
    let vocabulary = context.vocabulary;
    let is_word = vocabulary.find(&symbol.name).is_some_and(|word| vocabulary.is_of_posts(word));
    let Some(first) = symbol.definitions.first() else { return };
    if is_word && letter(&symbol.name).is_none() {
        let message = format!("{} is a word of the vocabulary", symbol.name);
        context.diags.push(context.at(LintCode::NameIsWord, *first, message));
    }
}
