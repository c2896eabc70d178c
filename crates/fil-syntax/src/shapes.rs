//! Statements whose arguments are words and numbers of a fixed shape. The
//! grammar reads their arguments as expressions, what they must be is said here.

use crate::errors::SyntaxCode;
use crate::flat::FlatKind;
use crate::reader::Reader;
use crate::tree::{Expr, ExprKind, Name, SectionKey, Span, Stmt, StmtKind, Target};

/// Parameters of a macro with their defaults.
type Params = Vec<(Name, Option<Expr>)>;

/// `IF(condition) statement`.
pub(crate) fn if_one(condition: Expr, kind: StmtKind, span: Span) -> FlatKind {
    let then = Box::new(Stmt { label: None, kind, span });
    FlatKind::Plain(StmtKind::IfOne { condition, then })
}

/// `WHEN/values` or `WHEN/OTHER`.
pub(crate) fn when(reader: &mut Reader<'_>, values: Vec<Expr>, span: Span) -> FlatKind {
    let others = values.iter().filter(|value| word(value) == Some("OTHER")).count();
    match (values.len(), others) {
        (1, 1) => FlatKind::WhenOther,
        (0, _) => refuse(reader, "WHEN/ takes values or the word OTHER", span),
        (_, 0) => FlatKind::When(values),
        _ => refuse(reader, "OTHER must be alone in WHEN/OTHER", span),
    }
}

/// `CIMFIL/ON,…` or `CIMFIL/OFF`.
pub(crate) fn section(reader: &mut Reader<'_>, args: Vec<Expr>, span: Span) -> FlatKind {
    if reader.text(span).starts_with(['S', 's']) {
        reader.report(SyntaxCode::Misspelled, "SIMFIL is read as CIMFIL", span);
    }
    let found = match args.as_slice() {
        [only] if word(only) == Some("OFF") => Some(FlatKind::SectionOff),
        [on, key @ ..] if word(on) == Some("ON") => section_key(key).map(FlatKind::SectionOn),
        _ => None,
    };
    found.unwrap_or_else(|| {
        let message = "expected CIMFIL/ON with a word or a record type after it, or CIMFIL/OFF";
        reader.report(SyntaxCode::WrongSection, message, span);
        FlatKind::Refused
    })
}

fn section_key(key: &[Expr]) -> Option<SectionKey> {
    let first = key.first()?;
    if let Some(kind) = whole_number(first) {
        let sub = match &key[1..] {
            [] => None,
            [sub] => Some(whole_number(sub)?),
            _ => return None,
        };
        let span = Span { start: first.span.start, end: key.last()?.span.end };
        return Some(SectionKey::Types { kind, sub, span });
    }
    let mut names = key.iter().map(name).collect::<Option<Vec<_>>>()?;
    let minors = names.split_off(1);
    Some(SectionKey::Words { major: names.pop()?, minors })
}

/// `NAME=MACRO/parameters`.
pub(crate) fn macro_open(
    reader: &mut Reader<'_>,
    target: Target,
    params: Option<Params>,
) -> FlatKind {
    if let Some(index) = target.index {
        return refuse(reader, "a macro has a name without a subscript", index.span);
    }
    FlatKind::Macro { name: target.name, params: params.unwrap_or_default() }
}

/// `RESERV/name,size,…`.
pub(crate) fn reserv(reader: &mut Reader<'_>, args: Vec<Expr>, span: Span) -> StmtKind {
    let mut arrays = Vec::with_capacity(args.len() / 2);
    let mut args = args.into_iter();
    while let Some(array) = args.next() {
        let pair = name(&array).zip(args.next());
        let Some(pair) = pair else {
            return wrong(reader, "RESERV/ takes pairs of an array name and its size", span);
        };
        arrays.push(pair);
    }
    if arrays.is_empty() {
        return wrong(reader, "RESERV/ takes pairs of an array name and its size", span);
    }
    StmtKind::Reserv { arrays }
}

/// `PRINT/ON`, `PRINT/OFF`, each with `IN` or without.
pub(crate) fn print(reader: &mut Reader<'_>, args: Vec<Expr>, span: Span) -> StmtKind {
    let words: Vec<_> = args.iter().map(word).collect();
    match words.as_slice() {
        [Some("ON")] => StmtKind::Print { on: true, input: false },
        [Some("OFF")] => StmtKind::Print { on: false, input: false },
        [Some("ON"), Some("IN")] => StmtKind::Print { on: true, input: true },
        [Some("OFF"), Some("IN")] => StmtKind::Print { on: false, input: true },
        _ => wrong(reader, "PRINT/ takes ON or OFF, and IN after them", span),
    }
}

/// `REDEF/ON` or `REDEF/OFF`.
pub(crate) fn redef(reader: &mut Reader<'_>, args: Vec<Expr>, span: Span) -> StmtKind {
    match args.as_slice() {
        [only] if word(only) == Some("ON") => StmtKind::Redef { on: true },
        [only] if word(only) == Some("OFF") => StmtKind::Redef { on: false },
        _ => wrong(reader, "REDEF/ takes ON or OFF", span),
    }
}

/// Reports a line of a block, which is then left out of the nesting.
fn refuse(reader: &mut Reader<'_>, message: &str, span: Span) -> FlatKind {
    reader.report(SyntaxCode::WrongArguments, message, span);
    FlatKind::Refused
}

/// Reports a statement; its place is kept by one that does nothing.
fn wrong(reader: &mut Reader<'_>, message: &str, span: Span) -> StmtKind {
    reader.report(SyntaxCode::WrongArguments, message, span);
    StmtKind::Contin
}

fn word(expr: &Expr) -> Option<&str> {
    match &expr.kind {
        ExprKind::Name(text) => Some(text),
        _ => None,
    }
}

fn name(expr: &Expr) -> Option<Name> {
    word(expr).map(|text| Name { text: text.to_string(), span: expr.span })
}

fn whole_number(expr: &Expr) -> Option<u32> {
    match expr.kind {
        ExprKind::Number(value) if value.fract() == 0.0 && value <= f64::from(u32::MAX) => {
            Some(value as u32)
        }
        _ => None,
    }
}
