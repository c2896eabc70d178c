//! What every lint sees: the bodies of a program with their graphs, its names.

use std::collections::HashMap;

use fil_cl::Vocabulary;
use fil_diag::Diag;
use fil_syntax::tree::{ExprKind, Item, Macro, Section, SectionKey, Span, Stmt, StmtKind};
use fil_syntax::walk::inner_bodies;

use super::flow::{Action, Graph};
use super::walk::{self, Use};
use super::{MachineFacts, Program};
use crate::compile::names::letter;
use crate::constant::constant;
use crate::errors::LintCode;
use crate::postf::PostfOp;
use crate::resolve::FileSpan;

/// What a body of statements belongs to.
#[derive(Clone, Copy)]
pub(crate) enum Owner<'t> {
    /// The global areas of all files, one after the other.
    Globals,
    /// A section.
    Section(&'t Section),
    /// A macro.
    Macro(&'t Macro),
}

/// Statements that run from their first to their last.
pub(crate) struct Body<'t> {
    pub owner: Owner<'t>,
    /// The unit it stands in.
    pub unit: usize,
    pub graph: Graph<'t>,
}

/// A program as the lints look at it.
pub(crate) struct Context<'t> {
    pub program: &'t Program<'t>,
    pub vocabulary: &'t Vocabulary,
    pub facts: MachineFacts<'t>,
    /// The first is that of the global areas.
    pub bodies: Vec<Body<'t>>,
    /// From the name of a macro to its body.
    pub macros: HashMap<&'t str, usize>,
    pub diags: Vec<Diag>,
}

impl<'t> Context<'t> {
    pub fn new(
        program: &'t Program<'t>,
        vocabulary: &'t Vocabulary,
        facts: MachineFacts<'t>,
    ) -> Self {
        let mut context = Context {
            program,
            vocabulary,
            facts,
            bodies: Vec::new(),
            macros: HashMap::new(),
            diags: Vec::new(),
        };
        let globals = program.found.roots.iter().flat_map(|unit| {
            let items = program.units[*unit].program.items.iter();
            items.filter_map(|item| match item {
                Item::Stmt(stmt) => Some((*unit, stmt)),
                _ => None,
            })
        });
        let graph = Graph::new(program.units, program.found, globals);
        context.bodies.push(Body { owner: Owner::Globals, unit: 0, graph });
        for (number, unit) in program.units.iter().enumerate() {
            for item in &unit.program.items {
                match item {
                    Item::Stmt(_) => {}
                    Item::Section(section) => {
                        context.add(Owner::Section(section), number, &section.body);
                    }
                    Item::Macro(definition) => {
                        context.macros.insert(&definition.name.text, context.bodies.len());
                        context.add(Owner::Macro(definition), number, &definition.body);
                    }
                }
            }
        }
        context
    }

    fn add(&mut self, owner: Owner<'t>, unit: usize, body: &'t [Stmt]) {
        let statements = body.iter().map(|stmt| (unit, stmt));
        let graph = Graph::new(self.program.units, self.program.found, statements);
        self.bodies.push(Body { owner, unit, graph });
    }

    /// A finding.
    pub fn diag(&self, code: LintCode, unit: usize, span: Span, message: String) -> Diag {
        Diag::new(code, message).at(self.program.units[unit].file.place(span))
    }

    /// A finding about a symbol.
    pub fn at(&self, code: LintCode, location: FileSpan, message: String) -> Diag {
        self.diag(code, location.file, location.span, message)
    }

    /// Keeps a finding.
    pub fn report(&mut self, code: LintCode, unit: usize, span: Span, message: String) {
        let diag = self.diag(code, unit, span, message);
        self.diags.push(diag);
    }

    /// Every statement with its unit, as they are written: those of the global areas, of sections
    /// and of macros, and those inside of others.
    pub fn each_statement(&self, visit: &mut dyn FnMut(usize, &'t Stmt)) {
        for (number, unit) in self.program.units.iter().enumerate() {
            let mut visit = |stmt| visit(number, stmt);
            for item in &unit.program.items {
                let body = match item {
                    Item::Stmt(stmt) => std::slice::from_ref(stmt),
                    Item::Section(section) => &section.body,
                    Item::Macro(definition) => &definition.body,
                };
                within(body, &mut visit);
            }
        }
    }

    /// Sections as they are written.
    pub fn sections(&self) -> impl Iterator<Item = (usize, &'t Section)> + '_ {
        self.bodies.iter().filter_map(|body| match body.owner {
            Owner::Section(section) => Some((body.unit, section)),
            _ => None,
        })
    }

    /// True for a name that some statement sets.
    pub fn is_assigned(&self, name: &str) -> bool {
        self.program.names.is_assigned(name)
    }

    /// Every name that an action of a body reads as a variable of the whole
    /// program, with its place: no letter, no parameter, no minor word.
    pub fn reads(
        &self,
        owner: Owner<'t>,
        action: Action<'t>,
        visit: &mut dyn FnMut(&'t str, Span),
    ) {
        let params: &[_] = match owner {
            Owner::Macro(definition) => &definition.params,
            _ => &[],
        };
        let is_own = |name: &str| params.iter().any(|(param, _)| param.text == name);
        walk::expressions(action, &mut |expr, used| {
            if let ExprKind::Name(name) = &expr.kind
                && letter(name).is_none()
                && !is_own(name)
                && (used == Use::Value || self.is_assigned(name))
            {
                visit(name, expr.span);
            }
        });
        if let Action::Plain(Stmt { kind: StmtKind::PostText { word, text }, .. }) = action {
            // PPRINT with the name of a variable shows its value.
            let upper = text.trim().to_ascii_uppercase();
            if let Some((name, global)) = self.program.names.globals.get_key_value(upper.as_str())
                && global.assigned
                && !is_own(name)
            {
                visit(name, word.span);
            }
        }
    }

    /// The POSTF operation of a call with a constant number.
    pub fn postf(&self, name: &str, args: &[fil_syntax::tree::Expr]) -> Option<PostfOp> {
        if name != "POSTF" {
            return None;
        }
        self.program.module.compat.operation(constant(args.first()?)?)
    }
}

/// The name of a body in messages.
pub(crate) fn called(owner: Owner<'_>) -> String {
    match owner {
        Owner::Globals => "the global area".to_string(),
        Owner::Section(section) => match &section.key {
            SectionKey::Words { major, .. } => format!("the section for {}", major.text),
            SectionKey::Types { kind, .. } => format!("the section for {kind}"),
        },
        Owner::Macro(definition) => format!("the macro {}", definition.name.text),
    }
}

fn within<'t>(body: &'t [Stmt], visit: &mut dyn FnMut(&'t Stmt)) {
    for stmt in body {
        visit(stmt);
        inner_bodies(stmt, &mut |body| within(body, visit));
    }
}
