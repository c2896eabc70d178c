//! Blocks while they are open.

use crate::flat::FlatKind;
use crate::tree::{DoRange, Expr, Name, Span, Stmt, StmtKind, Target, When};

/// An open block.
pub(crate) struct Frame {
    pub(crate) kind: FrameKind,
    pub(crate) label: Option<Name>,
    /// Its opening line.
    pub(crate) span: Span,
    /// Statements of the part that is open.
    pub(crate) body: Vec<Stmt>,
    /// Its wrong or missing end has been reported.
    pub(crate) reported: bool,
}

/// What kind of block is open, and the parts of it that are complete.
pub(crate) enum FrameKind {
    /// `condition` is that of the open part, `None` in ELSE.
    If {
        arms: Vec<(Expr, Vec<Stmt>)>,
        condition: Option<Expr>,
    },
    Do {
        label: Name,
        variable: Target,
        range: Box<DoRange>,
    },
    Case {
        subject: Expr,
        whens: Vec<When>,
        part: CasePart,
    },
}

/// The part of a CASE that is open.
pub(crate) enum CasePart {
    /// No WHEN yet.
    None,
    /// `WHEN/values` and the place of that line.
    When(Vec<Expr>, Span),
    /// `WHEN/OTHER`.
    Other,
}

impl FrameKind {
    pub(crate) fn if_then(condition: Expr) -> Self {
        FrameKind::If { arms: Vec::new(), condition: Some(condition) }
    }

    pub(crate) fn case(subject: Expr) -> Self {
        FrameKind::Case { subject, whens: Vec::new(), part: CasePart::None }
    }

    pub(crate) fn is_if(&self) -> bool {
        matches!(self, FrameKind::If { .. })
    }

    pub(crate) fn is_case(&self) -> bool {
        matches!(self, FrameKind::Case { .. })
    }

    /// True for a DO that ends at this label.
    pub(crate) fn ends_at(&self, name: &Name) -> bool {
        matches!(self, FrameKind::Do { label, .. } if label.text == name.text)
    }

    /// The word that opens such a block.
    pub(crate) fn word(&self) -> &'static str {
        match self {
            FrameKind::If { .. } => "IF",
            FrameKind::Do { .. } => "DO",
            FrameKind::Case { .. } => "CASE",
        }
    }

    /// The block as a message names it.
    pub(crate) fn describe(&self) -> String {
        match self {
            FrameKind::Do { label, .. } => format!("DO/{}", label.text),
            _ => self.word().to_string(),
        }
    }
}

impl Frame {
    /// True for a DO that ends at this label and of which nothing wrong is known.
    pub(crate) fn awaits(&self, label: &Name) -> bool {
        !self.reported && self.kind.ends_at(label)
    }

    /// True between CASE and its first WHEN.
    pub(crate) fn before_first_when(&self) -> bool {
        matches!(self.kind, FrameKind::Case { part: CasePart::None, .. })
    }

    /// Goes on to the next part of an IF or CASE; false when the open one must
    /// be the last.
    pub(crate) fn next_part(&mut self, next: FlatKind, span: Span) -> bool {
        match (&mut self.kind, next) {
            (FrameKind::If { arms, condition }, FlatKind::ElseIf(new)) => {
                let Some(old) = condition.replace(new) else {
                    *condition = None;
                    return false;
                };
                arms.push((old, std::mem::take(&mut self.body)));
            }
            (FrameKind::If { arms, condition }, FlatKind::Else) => {
                let Some(old) = condition.take() else { return false };
                arms.push((old, std::mem::take(&mut self.body)));
            }
            (FrameKind::Case { whens, part, .. }, next) => {
                let new = match next {
                    FlatKind::When(values) => CasePart::When(values, span),
                    _ => CasePart::Other,
                };
                if matches!(part, CasePart::Other) {
                    return false;
                }
                if let CasePart::When(values, span) = std::mem::replace(part, new) {
                    let body = std::mem::take(&mut self.body);
                    whens.push(When { values, body, span });
                }
            }
            _ => return false,
        }
        true
    }

    /// The statement of a block that is complete.
    pub(crate) fn close(self) -> Stmt {
        let Frame { kind, label, span, body, .. } = self;
        let kind = match kind {
            FrameKind::If { mut arms, condition: Some(condition) } => {
                arms.push((condition, body));
                StmtKind::If { arms, otherwise: None }
            }
            FrameKind::If { arms, condition: None } => StmtKind::If { arms, otherwise: Some(body) },
            FrameKind::Do { label, variable, range } => {
                StmtKind::Do { label, variable, range, body }
            }
            FrameKind::Case { subject, mut whens, part } => {
                let other = match part {
                    CasePart::None => None,
                    CasePart::When(values, span) => {
                        whens.push(When { values, body, span });
                        None
                    }
                    CasePart::Other => Some(body),
                };
                StmtKind::Case { subject, whens, other }
            }
        };
        Stmt { label, kind, span }
    }
}
