//! The ways through a body of statements: a graph of what runs after what.

use std::collections::HashMap;

use fil_syntax::tree::{Expr, Item, Name, Span, Stmt, StmtKind, When};

use crate::compile::files::{Found, Unit};
use crate::constant::constant;

/// What a node of the graph does.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Action<'t> {
    /// The start of the body.
    Entry,
    /// Its end.
    Exit,
    /// A statement without statements inside, or an INCLUD before what it brings.
    Plain(&'t Stmt),
    /// JUMPTO.
    Jump,
    /// The condition of an IF, or the subject of a CASE.
    Decide(&'t Expr),
    /// The values of a WHEN.
    When(&'t When),
    /// DO before its first pass.
    DoEnter(&'t Stmt),
    /// DO between two passes.
    DoNext,
}

/// A node of the graph.
#[derive(Debug)]
pub(crate) struct Node<'t> {
    /// The unit it stands in.
    pub unit: usize,
    /// Where it stands there.
    pub span: Span,
    /// What it does.
    pub action: Action<'t>,
    /// What may run next.
    pub next: Vec<usize>,
}

/// A label, or a jump to one, with the blocks it lies in, outermost first.
#[derive(Debug)]
pub(crate) struct LabelUse<'t> {
    /// Its name with the place.
    pub name: &'t Name,
    /// The unit it stands in.
    pub unit: usize,
    /// Parts of IF and CASE around it.
    pub blocks: Vec<u32>,
}

/// The graph of a body. Node 0 is its entry, node 1 its exit.
#[derive(Debug, Default)]
pub(crate) struct Graph<'t> {
    /// Nodes in the order of the source, but for entry and exit.
    pub nodes: Vec<Node<'t>>,
    /// Labels of statements.
    pub labels: Vec<LabelUse<'t>>,
    /// Jumps to labels.
    pub jumps: Vec<LabelUse<'t>>,
}

/// Entry of each graph.
pub(crate) const ENTRY: usize = 0;
/// Exit of each graph.
pub(crate) const EXIT: usize = 1;

impl<'t> Graph<'t> {
    /// The graph of statements, each with its unit.
    pub fn new(
        units: &'t [Unit],
        found: &'t Found,
        statements: impl Iterator<Item = (usize, &'t Stmt)>,
    ) -> Self {
        let mut builder = Builder {
            units,
            found,
            unit: 0,
            graph: Graph::default(),
            targets: HashMap::new(),
            pending: Vec::new(),
            blocks: Vec::new(),
            next_block: 0,
        };
        builder.node(Action::Entry, Span::default(), &[]);
        builder.node(Action::Exit, Span::default(), &[]);
        let mut ends = vec![ENTRY];
        for (unit, stmt) in statements {
            builder.unit = unit;
            ends = builder.statement(stmt, ends);
        }
        builder.finish(ends)
    }

    /// Nodes that can be reached from `start` over nodes that `passes` lets
    /// through; a node that stops the way is reached itself.
    pub fn reached(&self, start: usize, passes: impl Fn(&Node<'t>) -> bool) -> Vec<bool> {
        let mut reached = vec![false; self.nodes.len()];
        let mut open = vec![start];
        while let Some(at) = open.pop() {
            if !std::mem::replace(&mut reached[at], true) && passes(&self.nodes[at]) {
                open.extend(&self.nodes[at].next);
            }
        }
        reached
    }

    /// Nodes from which the body can be left: over its exit, or by a statement that ends the run.
    pub fn can_leave(&self) -> Vec<bool> {
        let mut before: Vec<Vec<usize>> = vec![Vec::new(); self.nodes.len()];
        for (at, node) in self.nodes.iter().enumerate() {
            node.next.iter().for_each(|next| before[*next].push(at));
        }
        let mut reached = vec![false; self.nodes.len()];
        let ends = self.nodes.iter().enumerate().filter(|(_, node)| node.next.is_empty());
        let mut open: Vec<usize> = ends.map(|(at, _)| at).collect();
        while let Some(at) = open.pop() {
            if !std::mem::replace(&mut reached[at], true) {
                open.extend(&before[at]);
            }
        }
        reached
    }
}

struct Builder<'t> {
    units: &'t [Unit],
    found: &'t Found,
    unit: usize,
    graph: Graph<'t>,
    targets: HashMap<&'t str, usize>,
    pending: Vec<(usize, &'t str)>,
    blocks: Vec<u32>,
    next_block: u32,
}

/// Nodes whose way goes on with what comes next.
type Ends = Vec<usize>;

impl<'t> Builder<'t> {
    fn finish(mut self, ends: Ends) -> Graph<'t> {
        self.link(&ends, EXIT);
        for (from, label) in std::mem::take(&mut self.pending) {
            if let Some(to) = self.targets.get(label) {
                self.graph.nodes[from].next.push(*to);
            }
        }
        self.graph
    }

    fn node(&mut self, action: Action<'t>, span: Span, from: &[usize]) -> usize {
        let at = self.graph.nodes.len();
        self.graph.nodes.push(Node { unit: self.unit, span, action, next: Vec::new() });
        self.link(from, at);
        at
    }

    fn link(&mut self, from: &[usize], to: usize) {
        for at in from {
            self.graph.nodes[*at].next.push(to);
        }
    }

    fn body(&mut self, body: &'t [Stmt], ends: Ends) -> Ends {
        body.iter().fold(ends, |ends, stmt| self.statement(stmt, ends))
    }

    /// A part of an IF or CASE: a jump into it from outside is noticed.
    fn block(&mut self, body: &'t [Stmt], ends: Ends) -> Ends {
        self.blocks.push(self.next_block);
        self.next_block += 1;
        let ends = self.body(body, ends);
        self.blocks.pop();
        ends
    }

    fn label_use(&self, name: &'t Name) -> LabelUse<'t> {
        LabelUse { name, unit: self.unit, blocks: self.blocks.clone() }
    }

    fn jump(&mut self, from: usize, label: &'t Name) {
        self.pending.push((from, &label.text));
        let used = self.label_use(label);
        self.graph.jumps.push(used);
    }

    /// Every statement begins with a node of its own, which its label stands for.
    fn statement(&mut self, stmt: &'t Stmt, from: Ends) -> Ends {
        if let Some(label) = &stmt.label {
            self.targets.insert(&label.text, self.graph.nodes.len());
            let used = self.label_use(label);
            self.graph.labels.push(used);
        }
        match &stmt.kind {
            StmtKind::If { arms, otherwise } => self.if_block(stmt, arms, otherwise, from),
            StmtKind::IfOne { condition, then } => {
                let decide = self.node(Action::Decide(condition), stmt.span, &from);
                let mut ends = self.statement(then, vec![decide]);
                ends.push(decide);
                ends
            }
            StmtKind::IfSign { value, labels } => {
                let decide = self.node(Action::Decide(value), stmt.span, &from);
                labels.iter().for_each(|label| self.jump(decide, label));
                Vec::new()
            }
            StmtKind::Jump { label } => {
                let jump = self.node(Action::Jump, stmt.span, &from);
                self.jump(jump, label);
                Vec::new()
            }
            StmtKind::Do { body, .. } => self.do_loop(stmt, body, from),
            StmtKind::Case { subject, whens, other } => {
                let decide = self.node(Action::Decide(subject), stmt.span, &from);
                self.case(decide, whens, other)
            }
            StmtKind::Includ { .. } => {
                let node = self.node(Action::Plain(stmt), stmt.span, &from);
                self.included(stmt, vec![node])
            }
            // The run ends here.
            StmtKind::Post { word, .. } if word.text == "ERROR" => {
                self.node(Action::Plain(stmt), stmt.span, &from);
                Vec::new()
            }
            _ => vec![self.node(Action::Plain(stmt), stmt.span, &from)],
        }
    }

    fn if_block(
        &mut self,
        stmt: &'t Stmt,
        arms: &'t [(Expr, Vec<Stmt>)],
        otherwise: &'t Option<Vec<Stmt>>,
        from: Ends,
    ) -> Ends {
        let mut ends = Vec::new();
        let mut last = from;
        for (index, (condition, body)) in arms.iter().enumerate() {
            let span = if index == 0 { stmt.span } else { condition.span };
            let decide = self.node(Action::Decide(condition), span, &last);
            ends.extend(self.block(body, vec![decide]));
            last = vec![decide];
        }
        match otherwise {
            Some(body) => ends.extend(self.block(body, last)),
            None => ends.extend(last),
        }
        ends
    }

    fn do_loop(&mut self, stmt: &'t Stmt, body: &'t [Stmt], from: Ends) -> Ends {
        let enter = self.node(Action::DoEnter(stmt), stmt.span, &from);
        let first = self.graph.nodes.len();
        let ends = self.body(body, vec![enter]);
        let next = self.node(Action::DoNext, stmt.span, &ends);
        if first != next {
            self.link(&[next], first);
        }
        if surely_runs(stmt) { vec![next] } else { vec![enter, next] }
    }

    fn case(&mut self, decide: usize, whens: &'t [When], other: &'t Option<Vec<Stmt>>) -> Ends {
        let mut ends = Vec::new();
        let mut last = decide;
        for when in whens {
            last = self.node(Action::When(when), when.span, &[last]);
            ends.extend(self.block(&when.body, vec![last]));
        }
        match other {
            Some(body) => ends.extend(self.block(body, vec![last])),
            None => ends.push(last),
        }
        ends
    }

    /// Statements of an included file in the place of its INCLUD.
    fn included(&mut self, stmt: &'t Stmt, mut ends: Ends) -> Ends {
        let key = (self.unit, stmt.span.start);
        let Some(unit) = self.found.included.get(&key).copied() else { return ends };
        let units: &'t [Unit] = self.units;
        let outer = std::mem::replace(&mut self.unit, unit);
        for item in &units[unit].program.items {
            if let Item::Stmt(stmt) = item {
                ends = self.statement(stmt, ends);
            }
        }
        self.unit = outer;
        ends
    }
}

/// True for a DO of constants that makes at least one pass.
fn surely_runs(stmt: &Stmt) -> bool {
    let StmtKind::Do { range, .. } = &stmt.kind else { return false };
    let step = range.step.as_ref().map_or(Some(1.0), constant);
    match (constant(&range.from), constant(&range.to), step) {
        (Some(from), Some(to), Some(step)) if step > 0.0 => from <= to,
        (Some(from), Some(to), Some(step)) if step < 0.0 => from >= to,
        _ => false,
    }
}
