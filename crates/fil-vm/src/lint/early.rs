//! W0231: names that are read before they are set on some way.

use std::collections::{BTreeMap, HashMap};

use fil_diag::Diag;
use fil_syntax::tree::{Span, StmtKind};

use super::context::{Context, Owner, called};
use super::flow::{Action, ENTRY, EXIT, Node};
use super::walk::sets;
use crate::errors::LintCode;

/// Nodes looked at for all names together; a file that needs more than this is
/// not looked at further.
const MOST_NODES: usize = 20_000_000;

/// What a body does with one name when it begins without a value.
#[derive(Clone, Copy, Default)]
struct Way {
    /// The first place where it is read while it may have none.
    read: Option<(usize, Span)>,
    /// The body can end with the name still without a value.
    ends_unset: bool,
}

/// The search for one name.
struct Search<'c, 't> {
    context: &'c Context<'t>,
    name: &'t str,
    /// Ways through the macros that were called.
    macros: HashMap<usize, Way>,
    nodes_left: &'c mut usize,
}

/// Warns once per name and body.
pub(super) fn look(context: &mut Context<'_>) {
    let mut found: Vec<Diag> = Vec::new();
    let mut nodes_left = MOST_NODES;
    for (name, bodies) in readers(context) {
        let mut search =
            Search { context, name, macros: HashMap::new(), nodes_left: &mut nodes_left };
        let globals = search.explore(0);
        let mut note = |body: usize, (unit, span): (usize, Span)| {
            let place = called(context.bodies[body].owner);
            let message = format!("{name} may have no value here, on a way through {place}");
            let diag = context.diag(LintCode::ReadEarly, unit, span, message);
            if !found.iter().any(|known| known.code == diag.code && known.spans == diag.spans) {
                found.push(diag);
            }
        };
        if let Some(read) = globals.read {
            note(0, read);
        }
        if !globals.ends_unset {
            continue;
        }
        for body in bodies {
            if matches!(context.bodies[body].owner, Owner::Section(_))
                && let Some(read) = search.explore(body).read
            {
                note(body, read);
            }
        }
        if nodes_left == 0 {
            break;
        }
    }
    context.diags.extend(found);
}

/// Names that some statement sets and that are read, with the bodies that read
/// them or call macros.
fn readers<'t>(context: &Context<'t>) -> BTreeMap<&'t str, Vec<usize>> {
    let mut readers: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let mut callers = Vec::new();
    for (index, body) in context.bodies.iter().enumerate() {
        for node in &body.graph.nodes {
            context.reads(body.owner, node.action, &mut |name, _| {
                if context.is_assigned(name) {
                    let bodies = readers.entry(name).or_default();
                    if bodies.last() != Some(&index) {
                        bodies.push(index);
                    }
                }
            });
            if called_macro(context, node).is_some() && callers.last() != Some(&index) {
                callers.push(index);
            }
        }
    }
    for bodies in readers.values_mut() {
        bodies.extend(&callers);
        bodies.sort_unstable();
        bodies.dedup();
    }
    readers
}

fn called_macro(context: &Context<'_>, node: &Node<'_>) -> Option<usize> {
    let Action::Plain(stmt) = node.action else { return None };
    let StmtKind::Call { name, .. } = &stmt.kind else { return None };
    context.macros.get(name.text.as_str()).copied()
}

impl Search<'_, '_> {
    /// Follows every way through a body on which the name has no value yet.
    fn explore(&mut self, index: usize) -> Way {
        let context = self.context;
        let body = &context.bodies[index];
        let mut way = Way::default();
        if is_parameter(body.owner, self.name) {
            return Way { read: None, ends_unset: true };
        }
        let mut seen = vec![false; body.graph.nodes.len()];
        let mut open = vec![ENTRY];
        while let Some(at) = open.pop() {
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            if *self.nodes_left == 0 {
                return Way::default();
            }
            *self.nodes_left -= 1;
            let node = &body.graph.nodes[at];
            context.reads(body.owner, node.action, &mut |name, span| {
                if name == self.name {
                    way.note(node.unit, span);
                }
            });
            let mut goes_on = sets(node.action) != Some(self.name);
            if let Some(called) = called_macro(context, node) {
                let inner = self.macro_way(called);
                if let Some((unit, span)) = inner.read {
                    way.note(unit, span);
                }
                goes_on = inner.ends_unset;
            }
            way.ends_unset |= at == EXIT;
            if goes_on {
                open.extend(&node.next);
            }
        }
        way
    }

    fn macro_way(&mut self, index: usize) -> Way {
        if let Some(known) = self.macros.get(&index) {
            return *known;
        }
        let way = self.explore(index);
        self.macros.insert(index, way);
        way
    }
}

impl Way {
    fn note(&mut self, unit: usize, span: Span) {
        let earlier = |(u, s): (usize, Span)| (u, s.start) <= (unit, span.start);
        if !self.read.is_some_and(earlier) {
            self.read = Some((unit, span));
        }
    }
}

fn is_parameter(owner: Owner<'_>, name: &str) -> bool {
    match owner {
        Owner::Macro(definition) => definition.params.iter().any(|(param, _)| param.text == name),
        _ => false,
    }
}
