//! W0240 and W0241: macros that nobody calls and arrays that nobody uses.

use super::context::Context;
use crate::errors::LintCode;
use crate::output::OutputMacro;
use crate::resolve::SymbolKind;

/// Warns of both. Files without a section are a library: what they hold is for
/// other files.
pub(super) fn look(context: &mut Context<'_>) {
    if context.sections().next().is_none() {
        return;
    }
    for symbol in &context.program.resolution.symbols {
        let (code, message) = match symbol.kind {
            // The post itself calls it.
            SymbolKind::Macro if OutputMacro::named(&symbol.name).is_some() => continue,
            SymbolKind::Macro => (LintCode::UnusedMacro, format!("nothing calls {}", symbol.name)),
            SymbolKind::Array => {
                (LintCode::UnusedArray, format!("no statement uses {}", symbol.name))
            }
            _ => continue,
        };
        if let Some(first) = symbol.definitions.first().filter(|_| symbol.uses.is_empty()) {
            context.diags.push(context.at(code, *first, message));
        }
    }
}
