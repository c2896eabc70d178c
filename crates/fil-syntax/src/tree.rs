//! The tree of a FIL file.
//!
//! Names and words are kept in upper case: FIL does not tell cases apart
//! outside of texts. Every node carries its [`Span`] in the source.

use std::ops::Range;

/// A byte range in the source text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// A span of a byte range.
    pub fn new(start: usize, end: usize) -> Self {
        Span { start: start as u32, end: end as u32 }
    }

    /// The span as a range, to slice the source with.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A name or word with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// Upper case.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// A whole FIL file, in source order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Statements of the global area, sections and macros.
    pub items: Vec<Item>,
}

/// A part of a FIL file.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "most items of a file are statements")]
pub enum Item {
    /// A statement of the global area; it runs once before the first record.
    Stmt(Stmt),
    /// `CIMFIL/ON,…` to `CIMFIL/OFF`.
    Section(Section),
    /// `NAME=MACRO/…` to `TERMAC`.
    Macro(Macro),
}

/// A CIMFIL section.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Which records it takes.
    pub key: SectionKey,
    /// Its statements.
    pub body: Vec<Stmt>,
    /// Opening lines of the IF and CASE blocks that CIMFIL/OFF had to close.
    pub left_open: Vec<Span>,
    /// From CIMFIL/ON to CIMFIL/OFF.
    pub span: Span,
}

/// What follows `CIMFIL/ON,`.
#[derive(Clone, Debug, PartialEq)]
pub enum SectionKey {
    /// A major word and the minor words that must follow it, in this order.
    Words {
        /// The major word.
        major: Name,
        /// Minor words; may be empty.
        minors: Vec<Name>,
    },
    /// CLDATA type and subtype numbers (5000,5).
    Types {
        /// Record type, word 2.
        kind: u32,
        /// Record subtype, word 3.
        sub: Option<u32>,
        /// Where the numbers stand.
        span: Span,
    },
}

/// A macro definition.
#[derive(Clone, Debug, PartialEq)]
pub struct Macro {
    /// Name of the macro.
    pub name: Name,
    /// Parameters with their defaults.
    pub params: Vec<(Name, Option<Expr>)>,
    /// Statements up to TERMAC.
    pub body: Vec<Stmt>,
    /// From the name to TERMAC.
    pub span: Span,
}

/// A statement with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Stmt {
    /// `LABEL)` before the statement.
    pub label: Option<Name>,
    /// What it does.
    pub kind: StmtKind,
    /// Where it stands (for a block: its opening line).
    pub span: Span,
}

/// The kinds of statements.
#[derive(Clone, Debug, PartialEq)]
pub enum StmtKind {
    /// `NAME=expr` or `NAME(i)=expr`.
    Assign {
        /// What is set.
        target: Target,
        /// Its value.
        value: Expr,
    },
    /// `NAME=TEXT/…`.
    Text {
        /// What is set.
        target: Target,
        /// Arguments of TEXT/.
        args: Vec<Expr>,
    },
    /// `WORD` or `WORD/args`: a post word, sent to the post as a record.
    Post {
        /// The major word.
        word: Name,
        /// Its arguments; a bare name is a variable or a minor word.
        args: Vec<Expr>,
    },
    /// `PPRINT text`, `INSERT/text`, … with text that is not quoted, as written.
    PostText {
        /// The major word.
        word: Name,
        /// The text up to the end of the line.
        text: String,
    },
    /// `IF(c)THEN … ELSEIF(c)THEN … ELSE … ENDIF`.
    If {
        /// Conditions and their statements, in order.
        arms: Vec<(Expr, Vec<Stmt>)>,
        /// The ELSE part.
        otherwise: Option<Vec<Stmt>>,
    },
    /// `IF(c) statement` on one line.
    IfOne {
        /// The condition.
        condition: Expr,
        /// The statement.
        then: Box<Stmt>,
    },
    /// Arithmetic `IF(x) l1,l2,l3`.
    IfSign {
        /// The value whose sign decides.
        value: Expr,
        /// Labels for negative, zero and positive.
        labels: Box<[Name; 3]>,
    },
    /// `JUMPTO/label`.
    Jump {
        /// Where to.
        label: Name,
    },
    /// `DO/label,var=from,to[,step]`; the statement with that label is the last of `body`.
    Do {
        /// The label of the last statement.
        label: Name,
        /// The loop variable.
        variable: Target,
        /// The values it takes; a box keeps statements small.
        range: Box<DoRange>,
        /// The statements of the loop.
        body: Vec<Stmt>,
    },
    /// `CASE/x … WHEN/v … WHEN/OTHER … ENDCAS`.
    Case {
        /// What is compared.
        subject: Expr,
        /// The WHEN parts.
        whens: Vec<When>,
        /// The WHEN/OTHER part.
        other: Option<Vec<Stmt>>,
    },
    /// `CALL/name,p=v,…`.
    Call {
        /// The macro.
        name: Name,
        /// Arguments by name, or by position where the name is left out.
        args: Vec<(Option<Name>, Expr)>,
    },
    /// `RESERV/name,n,…`.
    Reserv {
        /// Arrays and their sizes.
        arrays: Vec<(Name, Expr)>,
    },
    /// `PRINT/ON`, `PRINT/OFF[,IN]`.
    Print {
        /// ON or OFF.
        on: bool,
        /// The minor word IN was given.
        input: bool,
    },
    /// `REDEF/ON`, `REDEF/OFF`.
    Redef {
        /// ON or OFF.
        on: bool,
    },
    /// `INCLUD/file`.
    Includ {
        /// The name as written, quotes removed.
        file: String,
    },
    /// `CONTIN`.
    Contin,
    /// `FINI`: the end of the file.
    Fini,
}

/// The values that the variable of a DO takes.
#[derive(Clone, Debug, PartialEq)]
pub struct DoRange {
    /// First value.
    pub from: Expr,
    /// Last value.
    pub to: Expr,
    /// Step; 1 when left out.
    pub step: Option<Expr>,
}

impl DoRange {
    /// Its expressions in the order of the statement.
    pub fn values(&self) -> impl Iterator<Item = &Expr> {
        [&self.from, &self.to].into_iter().chain(&self.step)
    }
}

/// One `WHEN/` part.
#[derive(Clone, Debug, PartialEq)]
pub struct When {
    /// Values; the part is taken when the subject equals any of them.
    pub values: Vec<Expr>,
    /// Its statements.
    pub body: Vec<Stmt>,
    /// The WHEN line.
    pub span: Span,
}

/// What an assignment sets.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The variable or array.
    pub name: Name,
    /// The subscript of an array element.
    pub index: Option<Box<Expr>>,
}

/// An expression with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// A number.
    Number(f64),
    /// A 'text', quotes removed and doubled quotes single.
    Text(String),
    /// A variable or a vocabulary word.
    Name(String),
    /// A function call or an array element: `NAME(args)`.
    Call {
        /// Function or array.
        name: Name,
        /// Arguments or subscript.
        args: Vec<Expr>,
    },
    /// `-x`, `+x`, `.NOT.x`.
    Unary {
        /// The operator.
        op: UnaryOp,
        /// Its operand.
        operand: Box<Expr>,
    },
    /// `a op b`.
    Binary {
        /// The operator.
        op: BinaryOp,
        /// Left operand.
        left: Box<Expr>,
        /// Right operand.
        right: Box<Expr>,
    },
}

/// Operators with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-`
    Minus,
    /// `+`
    Plus,
    /// `.NOT.`
    Not,
}

/// Operators with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryOp {
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
    /// `**`
    Pow,
    /// `.EQ.`
    Eq,
    /// `.NE.`
    Ne,
    /// `.LT.`
    Lt,
    /// `.LE.`
    Le,
    /// `.GT.`
    Gt,
    /// `.GE.`
    Ge,
    /// `.AND.`
    And,
    /// `.OR.`
    Or,
}
