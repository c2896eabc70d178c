//! W0248: an ELSE that may be meant for the one-line IF before it, as its indentation
//! does not tell otherwise.

use fil_syntax::tree::{Span, StmtKind};

use super::context::Context;
use crate::errors::LintCode;

/// Warns at the one-line IF.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found: Vec<(usize, Span)> = Vec::new();
    context.each_statement(&mut |unit, stmt| {
        let StmtKind::If { arms, otherwise } = &stmt.kind else { return };
        // Every part that ELSEIF or ELSE follows.
        let followed = if otherwise.is_some() { arms.len() } else { arms.len() - 1 };
        let last = arms[..followed].iter().filter_map(|(_, body)| body.last());
        let one_line = last.filter(|stmt| matches!(stmt.kind, StmtKind::IfOne { .. }));
        found.extend(one_line.map(|stmt| (unit, stmt.span)));
    });
    found.retain(|(unit, span)| !stands_out(&context.program.units[*unit].file.text, *span));
    for (unit, span) in found {
        let message = "the ELSE after it belongs to the IF around it".to_string();
        context.report(LintCode::LooseElse, unit, span, message);
    }
}

/// True where the ELSE or ELSEIF behind a statement is indented less than that.
fn stands_out(text: &str, statement: Span) -> bool {
    let column = |at: usize| at - text[..at].rfind('\n').map_or(0, |end| end + 1);
    let mut lines = text[statement.range().end..].split('\n').skip(1);
    let word = lines.find_map(|line| {
        let indent = line.len() - line.trim_start().len();
        let is_else = line[indent..].get(..4).is_some_and(|w| w.eq_ignore_ascii_case("ELSE"));
        is_else.then_some(indent)
    });
    word.is_some_and(|word| word < column(statement.range().start))
}
