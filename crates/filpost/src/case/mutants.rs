//! Small changes of FIL: a suite of cases that notices none of them does not test the line.

use std::ops::Range;

use fil_syntax::tree::{Expr, ExprKind, Item, Span, Stmt, StmtKind};
use fil_syntax::walk;

/// A small change of a FIL file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// Line of what is changed, 1-based.
    pub line: u32,
    /// Line that the statement begins in, which runs when the change is reached.
    pub statement: u32,
    /// The change in words: `the condition XX.GT.5 is turned`.
    pub what: String,
    /// The section itself is taken away; the lines of its body need not have run.
    pub drops_section: bool,
    range: Range<usize>,
    new: String,
}

impl Mutant {
    /// The text with the change made.
    pub fn applied(&self, text: &str) -> String {
        format!("{}{}{}", &text[..self.range.start], self.new, &text[self.range.end..])
    }
}

/// All changes of a text, in the order of its lines: each condition turned, each constant
/// moved by one, each section dropped. A file with errors gives none.
pub fn mutants(name: &str, text: &str) -> Vec<Mutant> {
    let parsed = fil_syntax::parse(name, text);
    if parsed.diags.iter().any(fil_diag::Diag::is_error) {
        return Vec::new();
    }
    let mark = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut finder = Finder { text, mark, statement: 0, found: Vec::new() };
    for item in &parsed.program.items {
        match item {
            Item::Section(section) => {
                finder.drop_section(section.span);
                finder.statements(&section.body);
            }
            Item::Macro(definition) => finder.statements(&definition.body),
            Item::Stmt(stmt) => finder.statement(stmt),
        }
    }
    let mut found = finder.found;
    found.sort_by_key(|mutant| (mutant.range.start, mutant.range.end));
    found
}

struct Finder<'t> {
    text: &'t str,
    /// Bytes of a byte order mark, which spans do not count.
    mark: usize,
    /// Line of the statement that is looked at.
    statement: u32,
    found: Vec<Mutant>,
}

impl Finder<'_> {
    fn push(&mut self, span: Span, what: String, new: String) {
        let (range, line) = (self.range(span), self.line(span));
        let (statement, drops_section) = (self.statement, false);
        self.found.push(Mutant { line, statement, what, drops_section, range, new });
    }

    fn line(&self, span: Span) -> u32 {
        1 + self.text[..self.range(span).start].matches('\n').count() as u32
    }

    fn range(&self, span: Span) -> Range<usize> {
        let range = span.range();
        range.start + self.mark..range.end + self.mark
    }

    fn written(&self, span: Span) -> &str {
        &self.text[self.range(span)]
    }

    fn drop_section(&mut self, span: Span) {
        let lines = self.written(span).matches('\n').count();
        self.push(span, "the section is dropped".to_string(), "\n".repeat(lines));
        if let Some(last) = self.found.last_mut() {
            last.drops_section = true;
        }
    }

    fn statements(&mut self, body: &[Stmt]) {
        body.iter().for_each(|stmt| self.statement(stmt));
    }

    fn statement(&mut self, stmt: &Stmt) {
        let line = self.line(stmt.span);
        let outer = std::mem::replace(&mut self.statement, line);
        self.parts(stmt);
        self.statement = outer;
    }

    fn parts(&mut self, stmt: &Stmt) {
        match &stmt.kind {
            StmtKind::If { arms, otherwise } => {
                for (index, (condition, body)) in arms.iter().enumerate() {
                    if index > 0 {
                        self.statement = self.line(condition.span);
                    }
                    self.condition(condition);
                    self.statements(body);
                }
                self.statements(otherwise.as_deref().unwrap_or_default());
            }
            StmtKind::IfOne { condition, then } => {
                self.condition(condition);
                self.statement(then);
            }
            _ => {
                walk::expressions(stmt, &mut |expr| self.constants(expr));
                walk::inner_bodies(stmt, &mut |body| self.statements(body));
            }
        }
    }

    fn condition(&mut self, condition: &Expr) {
        let written = self.written(condition.span).to_string();
        let what = format!("the condition {} is turned", short(&written));
        self.push(condition.span, what, format!(".NOT.({written})"));
        self.constants(condition);
    }

    /// Each number of an expression; the number of a POSTF call is its name and no constant.
    fn constants(&mut self, expr: &Expr) {
        match &expr.kind {
            ExprKind::Number(number) => {
                let written = self.written(expr.span).to_string();
                let moved = number + 1.0;
                self.push(
                    expr.span,
                    format!("the constant {written} becomes {moved}"),
                    format!("{moved}"),
                );
            }
            ExprKind::Call { name, args } => {
                let named_by_number = usize::from(name.text == "POSTF");
                args.iter().skip(named_by_number).for_each(|arg| self.constants(arg));
            }
            ExprKind::Unary { operand, .. } => self.constants(operand),
            ExprKind::Binary { left, right, .. } => {
                self.constants(left);
                self.constants(right);
            }
            ExprKind::Text(_) | ExprKind::Name(_) => {}
        }
    }
}

/// A condition on one line.
fn short(text: &str) -> String {
    const MOST: usize = 60;
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if text.chars().count() <= MOST {
        return text;
    }
    text.chars().take(MOST).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::mutants;

    #[test]
    fn a_change_in_a_further_line_of_a_statement_is_reached_by_its_first_line() {
        let text = "AA=1\nIF(AA.EQ.0)THEN\nBB=$\n2\nELSEIF(AA.EQ.$\n1)THEN\nBB=3\nENDIF\nFINI\n";
        let found = mutants("a.fil", text);
        let lines: Vec<(u32, u32)> = found.iter().map(|m| (m.line, m.statement)).collect();
        let expected = [(1, 1), (2, 2), (2, 2), (4, 3), (5, 5), (6, 5), (7, 7)];
        assert_eq!(lines, expected, "{found:?}");
    }

    #[test]
    fn each_condition_constant_and_section_is_changed_once() {
        let text = "CIMFIL/ON,CYCLE\nIF(POSTF(7,4).GT.5)THEN\nPOSTN/OUT,G,4,X,2.5\nENDIF\n\
                    CIMFIL/OFF\nFINI\n";
        let found = mutants("a.fil", text);
        let words: Vec<(u32, &str)> =
            found.iter().map(|mutant| (mutant.line, mutant.what.as_str())).collect();
        assert_eq!(
            words,
            [
                (1, "the section is dropped"),
                (2, "the condition POSTF(7,4).GT.5 is turned"),
                (2, "the constant 4 becomes 5"),
                (2, "the constant 5 becomes 6"),
                (3, "the constant 4 becomes 5"),
                (3, "the constant 2.5 becomes 3.5"),
            ]
        );
        assert_eq!(found[0].applied(text), "\n\n\n\n\nFINI\n");
        let turned = found[1].applied(text);
        assert!(turned.contains("IF(.NOT.(POSTF(7,4).GT.5))THEN"), "{turned}");
        for mutant in &found {
            let changed = mutant.applied(text);
            let wrong = fil_syntax::parse("a.fil", &changed).diags;
            assert!(wrong.iter().all(|diag| !diag.is_error()), "{changed}{wrong:?}");
        }
    }
}
