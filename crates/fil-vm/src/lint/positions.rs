//! W0230: word numbers that an optional couplet can shift.

use std::collections::HashSet;

use fil_syntax::tree::{BinaryOp, Expr, ExprKind, SectionKey, Stmt, StmtKind};

use super::context::{Body, Context, Owner};
use super::flow::{Action, ENTRY};
use super::walk::{calls, expressions};
use crate::constant::constant;
use crate::errors::LintCode;
use crate::postf::PostfOp;

/// A major word whose records have optional couplets.
struct Layout {
    major: &'static str,
    /// The last word whose number no couplet can shift.
    fixed: u16,
    /// Words behind that with the minor word they follow when nothing optional
    /// stands before them.
    usual: &'static [(u16, &'static str)],
}

const LAYOUTS: &[Layout] = &[
    Layout {
        major: "THREAD",
        fixed: 11,
        usual: &[(13, "TPI"), (15, "DEEP"), (17, "LAST"), (19, "TYPE"), (23, "IPM"), (25, "FEDTO")],
    },
    Layout { major: "OP", fixed: 5, usual: &[(7, "DEPTH"), (9, "TPI"), (11, "MULTRD")] },
    Layout { major: "CYCLE", fixed: 5, usual: &[(6, "DEPTH")] },
    Layout { major: "LOADTL", fixed: 5, usual: &[] },
    Layout { major: "TURRET", fixed: 5, usual: &[] },
    Layout { major: "SPINDL", fixed: 5, usual: &[] },
    Layout { major: "FEDRAT", fixed: 5, usual: &[] },
    Layout { major: "CUTCOM", fixed: 5, usual: &[] },
    Layout { major: "COOLNT", fixed: 5, usual: &[] },
    Layout { major: "RAPID", fixed: 4, usual: &[] },
];

/// Warns of POSTF(7,n) with a constant n behind the couplets of the record.
pub(super) fn look(context: &mut Context<'_>) {
    let changing = changing_macros(context);
    let mut found = Vec::new();
    for body in &context.bodies {
        let Some(layout) = layout(body.owner) else { continue };
        let asked = asked_words(context, body);
        let own =
            body.graph.reached(ENTRY, |node| !changes_record(context, &changing, node.action));
        let nodes = body.graph.nodes.iter().zip(own).filter(|(_, is_own)| *is_own);
        for (node, _) in nodes {
            calls(node.action, &mut |name, args, call| {
                let Some(n) = word_number(context, &name.text, args) else { return };
                if n <= layout.fixed || asked.contains(&(n - 1)) {
                    return;
                }
                let message = format!(
                    "word {n} of {} comes after optional couplets of the record",
                    layout.major
                );
                let mut diag = context.diag(LintCode::ShiftingWord, node.unit, call.span, message);
                diag.hint = layout.usual.iter().find(|(usual, _)| *usual == n).map(|(_, word)| {
                    format!(
                        "COUPLF({word}) reads the value after {word} at any position; POSTF(9,4,ICODEF({word})) finds the word itself"
                    )
                });
                found.push(diag);
            });
        }
    }
    context.diags.extend(found);
}

fn layout(owner: Owner<'_>) -> Option<&'static Layout> {
    let Owner::Section(section) = owner else { return None };
    let SectionKey::Words { major, .. } = &section.key else { return None };
    LAYOUTS.iter().find(|layout| layout.major == major.text)
}

/// The n of POSTF(7,n).
fn word_number(context: &Context<'_>, name: &str, args: &[Expr]) -> Option<u16> {
    let [_, n] = args else { return None };
    let is_word = context.postf(name, args) == Some(PostfOp::Word);
    let n = constant(n).filter(|_| is_word)?;
    (n.fract() == 0.0 && (1.0..=9999.0).contains(&n)).then_some(n as u16)
}

/// Words that the body compares with a code: what follows them is known.
fn asked_words(context: &Context<'_>, body: &Body<'_>) -> HashSet<u16> {
    let mut asked = HashSet::new();
    for node in &body.graph.nodes {
        expressions(node.action, &mut |expr, _| {
            let ExprKind::Binary { op: BinaryOp::Eq | BinaryOp::Ne, left, right } = &expr.kind
            else {
                return;
            };
            for (word, code) in [(left, right), (right, left)] {
                let is_code = matches!(&code.kind,
                    ExprKind::Call { name, .. } if name.text == "ICODEF");
                if is_code && let ExprKind::Call { name, args } = &word.kind {
                    asked.extend(word_number(context, &name.text, args));
                }
            }
        });
    }
    asked
}

/// Macros that may change the current record, by themselves or by what they call.
fn changing_macros<'t>(context: &Context<'t>) -> HashSet<&'t str> {
    let mut changing = HashSet::new();
    loop {
        let before = changing.len();
        for body in &context.bodies {
            let Owner::Macro(definition) = body.owner else { continue };
            let mut nodes = body.graph.nodes.iter();
            if nodes.any(|node| changes_record(context, &changing, node.action)) {
                changing.insert(definition.name.text.as_str());
            }
        }
        if changing.len() == before {
            return changing;
        }
    }
}

/// True for an action behind which another record may be the current one.
fn changes_record(context: &Context<'_>, changing: &HashSet<&str>, action: Action<'_>) -> bool {
    let mut changes = match action {
        Action::Plain(Stmt { kind: StmtKind::Call { name, .. }, .. }) => {
            changing.contains(name.text.as_str())
        }
        _ => false,
    };
    calls(action, &mut |name, args, _| {
        changes |= matches!(
            context.postf(&name.text, args),
            Some(PostfOp::Next | PostfOp::Back | PostfOp::Seek | PostfOp::Restore)
        );
    });
    changes
}
