//! Makes trees as the parser could have made them.

use fil_syntax::tree::{
    BinaryOp, DoRange, Expr, ExprKind, Item, Macro, Name, Program, Section, SectionKey, Span, Stmt,
    StmtKind, Target, UnaryOp, When,
};
use proptest::prelude::*;

/// Pieces of FIL texts, to make statements that are almost right.
pub const PIECES: &[&str] = &[
    "A",
    "X1",
    "IF",
    "(",
    ")",
    "THEN",
    "ELSE",
    "ELSEIF",
    "ENDIF",
    "DO",
    "/",
    "L",
    ",",
    "=",
    "1",
    "2.5",
    ".EQ.",
    "5.EQ.6",
    ".NOT.",
    ".OR.",
    "+",
    "-",
    "**",
    "*",
    "'t'",
    "'",
    "$",
    "$$",
    ";",
    "\n",
    "\n",
    "\r\n",
    " ",
    "CASE",
    "WHEN",
    "OTHER",
    "ENDCAS",
    "CIMFIL",
    "ON",
    "OFF",
    "MACRO",
    "TERMAC",
    "TEXT",
    "CALL",
    "RESERV",
    "PRINT",
    "REDEF",
    "INCLUD",
    "CONTIN",
    "FINI",
    "JUMPTO",
    "PPRINT",
    "INSERT",
    "я",
    "\u{a0}",
    "\0",
    "L)",
    "A=1\n",
    "IF(A)THEN\n",
    "ENDIF\n",
    "CASE/A\nWHEN/1\n",
    "ENDCAS\n",
    "DO/L,I=1,2\n",
    "L) CONTIN\n",
    "CIMFIL/ON,GOTO\n",
    "CIMFIL/OFF\n",
    "M=MACRO\n",
    "TERMAC\n",
    "WHEN/2\n",
    "WHEN/OTHER\n",
    "ELSE\n",
];

const SPAN: Span = Span { start: 0, end: 0 };

/// A name that no rule of the language takes for something else.
fn name() -> impl Strategy<Value = Name> {
    let plain = "[A-Z][A-Z0-9]{0,7}Q|_[A-Z]{1,6}Q".prop_map(|text: String| text);
    let minor = prop::sample::select(vec!["ON", "OUT", "STEP", "TO", "X", "GOTO", "_REPOS"]);
    prop_oneof![plain, minor.prop_map(str::to_string)].prop_map(|text| Name { text, span: SPAN })
}

/// A label: a name or a number.
fn label() -> impl Strategy<Value = Name> {
    let number = (0u32..99_999).prop_map(|n| Name { text: n.to_string(), span: SPAN });
    prop_oneof![name(), number]
}

fn text() -> impl Strategy<Value = String> {
    "[ -~а-яА-Яé]{0,12}"
}

fn expr() -> BoxedStrategy<Expr> {
    let number = prop_oneof![
        (0u32..100_000).prop_map(f64::from),
        (0.0..1e6f64).prop_map(f64::abs),
        Just(1e-9),
        Just(1e300)
    ];
    let leaf = prop_oneof![
        number.prop_map(ExprKind::Number),
        text().prop_map(ExprKind::Text),
        name().prop_map(|name| ExprKind::Name(name.text)),
    ];
    leaf.prop_recursive(5, 24, 3, |inner| {
        let inner = inner.prop_map(node);
        prop_oneof![
            (name(), prop::collection::vec(inner.clone(), 0..3))
                .prop_map(|(name, args)| ExprKind::Call { name, args }),
            (unary(), inner.clone())
                .prop_map(|(op, operand)| ExprKind::Unary { op, operand: Box::new(operand) }),
            (binary(), inner.clone(), inner).prop_map(|(op, left, right)| ExprKind::Binary {
                op,
                left: Box::new(left),
                right: Box::new(right),
            }),
        ]
    })
    .prop_map(node)
    .boxed()
}

fn node(kind: ExprKind) -> Expr {
    Expr { kind, span: SPAN }
}

fn unary() -> impl Strategy<Value = UnaryOp> {
    prop::sample::select(vec![UnaryOp::Minus, UnaryOp::Plus, UnaryOp::Not])
}

fn binary() -> impl Strategy<Value = BinaryOp> {
    use BinaryOp::*;
    prop::sample::select(vec![Add, Sub, Mul, Div, Pow, Eq, Ne, Lt, Le, Gt, Ge, And, Or])
}

fn exprs() -> impl Strategy<Value = Vec<Expr>> {
    prop::collection::vec(expr(), 0..4)
}

fn target() -> impl Strategy<Value = Target> {
    (name(), prop::option::of(expr()))
        .prop_map(|(name, index)| Target { name, index: index.map(Box::new) })
}

/// Text after PPRINT and its like, as it is left after cutting and trimming; with an item in
/// quotes it would be a list.
fn free_text() -> impl Strategy<Value = String> {
    "[A-Z0-9(=/][A-Za-z0-9 ,.=/()'я]{0,20}"
        .prop_map(|text: String| text.trim_end().to_string())
        .prop_filter("a list", |text| !text.replace(' ', "").contains(",'"))
}

fn free_word() -> impl Strategy<Value = Name> {
    prop::sample::select(vec!["PARTNO", "PPRINT", "INSERT", "LETTER", "REMARK"])
        .prop_map(|text| Name { text: text.to_string(), span: SPAN })
}

/// Statements that may stand behind a one-line IF.
fn plain() -> BoxedStrategy<StmtKind> {
    let args = prop::collection::vec((prop::option::of(name()), expr()), 0..3);
    let arrays = prop::collection::vec((name(), expr()), 1..3);
    prop_oneof![
        (target(), expr()).prop_map(|(target, value)| StmtKind::Assign { target, value }),
        (target(), exprs()).prop_map(|(target, args)| StmtKind::Text { target, args }),
        (name(), exprs()).prop_map(|(word, args)| StmtKind::Post { word, args }),
        (free_word(), text()).prop_map(|(word, text)| {
            StmtKind::Post { word, args: vec![node(ExprKind::Text(text))] }
        }),
        (free_word(), free_text()).prop_map(|(word, text)| StmtKind::PostText { word, text }),
        label().prop_map(|label| StmtKind::Jump { label }),
        (name(), args).prop_map(|(name, args)| StmtKind::Call { name, args }),
        arrays.prop_map(|arrays| StmtKind::Reserv { arrays }),
        (any::<bool>(), any::<bool>()).prop_map(|(on, input)| StmtKind::Print { on, input }),
        any::<bool>().prop_map(|on| StmtKind::Redef { on }),
        Just(StmtKind::Contin),
    ]
    .boxed()
}

fn stmt() -> BoxedStrategy<Stmt> {
    let simple = prop_oneof![
        4 => plain(),
        1 => (expr(), plain()).prop_map(|(condition, kind)| StmtKind::IfOne {
            condition,
            then: Box::new(Stmt { label: None, kind, span: SPAN }),
        }),
        1 => (expr(), label(), label(), label())
            .prop_map(|(value, a, b, c)| StmtKind::IfSign { value, labels: Box::new([a, b, c]) }),
        1 => text().prop_map(|file| StmtKind::Includ { file }),
    ];
    let leaf = (prop::option::of(label()), simple).prop_map(|(label, kind)| Stmt {
        label,
        kind,
        span: SPAN,
    });
    leaf.prop_recursive(3, 20, 3, |inner| {
        (prop::option::of(label()), block(inner)).prop_map(|(label, kind)| Stmt {
            label,
            kind,
            span: SPAN,
        })
    })
    .boxed()
}

/// IF, CASE and DO over statements.
fn block(inner: BoxedStrategy<Stmt>) -> impl Strategy<Value = StmtKind> {
    let body = prop::collection::vec(inner, 0..3);
    let arms = prop::collection::vec((expr(), body.clone()), 1..3);
    let values = prop::collection::vec(expr(), 1..3);
    let when = (values, body.clone()).prop_map(|(values, body)| When { values, body, span: SPAN });
    let whens = prop::collection::vec(when, 0..3);
    prop_oneof![
        (arms, prop::option::of(body.clone()))
            .prop_map(|(arms, otherwise)| StmtKind::If { arms, otherwise }),
        (expr(), whens, prop::option::of(body.clone()))
            .prop_map(|(subject, whens, other)| StmtKind::Case { subject, whens, other }),
        (target(), expr(), expr(), prop::option::of(expr()), body)
            .prop_map(|(variable, from, to, step, body)| loop_over(variable, from, to, step, body)),
    ]
}

/// A DO gets its label from `name_loops`, which sees the whole tree.
fn loop_over(
    variable: Target,
    from: Expr,
    to: Expr,
    step: Option<Expr>,
    mut body: Vec<Stmt>,
) -> StmtKind {
    let label = Name { text: String::new(), span: SPAN };
    let last = Stmt { label: Some(label.clone()), kind: StmtKind::Contin, span: SPAN };
    body.push(last);
    StmtKind::Do { label, variable, range: Box::new(DoRange { from, to, step }), body }
}

/// Gives every DO and its last statement a label that nothing else has.
fn name_loops(body: &mut [Stmt], count: &mut u32) {
    for stmt in body {
        match &mut stmt.kind {
            StmtKind::Do { label, body, .. } => {
                *count += 1;
                label.text = format!("LOOP{count}");
                if let Some(last) = body.last_mut() {
                    last.label = Some(label.clone());
                }
                name_loops(body, count);
            }
            StmtKind::If { arms, otherwise } => {
                arms.iter_mut().for_each(|(_, body)| name_loops(body, count));
                otherwise.iter_mut().for_each(|body| name_loops(body, count));
            }
            StmtKind::Case { whens, other, .. } => {
                whens.iter_mut().for_each(|when| name_loops(&mut when.body, count));
                other.iter_mut().for_each(|body| name_loops(body, count));
            }
            _ => {}
        }
    }
}

fn item() -> BoxedStrategy<Item> {
    let body = || {
        prop::collection::vec(stmt(), 0..4).prop_map(|mut body| {
            name_loops(&mut body, &mut 0);
            body
        })
    };
    let words = (name(), prop::collection::vec(name(), 0..3))
        .prop_map(|(major, minors)| SectionKey::Words { major, minors });
    let types = (any::<u32>(), prop::option::of(any::<u32>()))
        .prop_map(|(kind, sub)| SectionKey::Types { kind, sub, span: SPAN });
    let params = prop::collection::vec((name(), prop::option::of(expr())), 0..3);
    prop_oneof![
        stmt().prop_map(|mut stmt| {
            name_loops(std::slice::from_mut(&mut stmt), &mut 0);
            Item::Stmt(stmt)
        }),
        (prop_oneof![words, types], body()).prop_map(|(key, body)| Item::Section(Section {
            key,
            body,
            left_open: Vec::new(),
            span: SPAN
        })),
        (name(), params, body()).prop_map(|(name, params, body)| {
            Item::Macro(Macro { name, params, body, span: SPAN })
        }),
    ]
    .boxed()
}

/// A whole file that ends with FINI.
pub fn program() -> impl Strategy<Value = Program> {
    prop::collection::vec(item(), 0..6).prop_map(|mut items| {
        items.push(Item::Stmt(Stmt { label: None, kind: StmtKind::Fini, span: SPAN }));
        Program { items }
    })
}
