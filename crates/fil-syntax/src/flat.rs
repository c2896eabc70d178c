//! Statements as the grammar reads them, before blocks are nested.

use crate::tree::{DoRange, Expr, Name, SectionKey, Span, StmtKind, Target};

/// A statement line.
#[derive(Debug)]
pub(crate) struct Flat {
    /// `LABEL)` before it.
    pub(crate) label: Option<Name>,
    pub(crate) kind: FlatKind,
    pub(crate) span: Span,
}

/// What a statement line says; words that open or close a block stand alone.
#[derive(Debug)]
pub(crate) enum FlatKind {
    /// A whole statement.
    Plain(StmtKind),
    /// A line that could not be read and has been reported; it keeps its label.
    Refused,
    /// `IF(c)THEN`
    If(Expr),
    /// `ELSEIF(c)THEN`
    ElseIf(Expr),
    /// `ELSE`
    Else,
    /// `ENDIF`
    EndIf,
    /// `DO/label,var=from,to,step`
    Do { label: Name, variable: Target, range: Box<DoRange> },
    /// `CASE/x`
    Case(Expr),
    /// `WHEN/v,…`
    When(Vec<Expr>),
    /// `WHEN/OTHER`
    WhenOther,
    /// `ENDCAS`
    EndCase,
    /// `CIMFIL/ON,…`
    SectionOn(SectionKey),
    /// `CIMFIL/OFF`
    SectionOff,
    /// `NAME=MACRO/…`
    Macro { name: Name, params: Vec<(Name, Option<Expr>)> },
    /// `TERMAC`
    MacroEnd,
}
