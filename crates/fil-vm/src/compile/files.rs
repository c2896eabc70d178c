//! FIL files and the files they include.

use std::collections::HashMap;

use fil_diag::Diag;
use fil_syntax::SyntaxCode;
use fil_syntax::tree::{Item, Program, Span, Stmt, StmtKind};

use super::Loader;
use crate::errors::CompileCode;
use crate::module::File;

/// A file with its tree.
pub(crate) struct Unit {
    pub file: File,
    pub program: Program,
}

/// Which units are loaded by name and which an INCLUD stands for.
#[derive(Default)]
pub(crate) struct Found {
    /// The files given to `load`.
    pub roots: Vec<usize>,
    /// From unit and start of an INCLUD to the unit it brings in.
    pub included: HashMap<(usize, u32), usize>,
}

/// Reads files and, through the loader, those they include.
pub(super) struct Includes<'a> {
    loader: Option<Loader<'a>>,
    units: Vec<Unit>,
    found: Found,
    /// Units that are being read, outermost first.
    open: Vec<usize>,
    diags: Vec<Diag>,
}

impl<'a> Includes<'a> {
    pub fn new(loader: Option<Loader<'a>>) -> Self {
        Includes {
            loader,
            units: Vec::new(),
            found: Found::default(),
            open: Vec::new(),
            diags: Vec::new(),
        }
    }

    /// Reads a file given to `load`.
    pub fn read(&mut self, name: &str, text: &str) {
        let unit = self.parse(name, text);
        self.found.roots.push(unit);
    }

    pub fn finish(self) -> (Vec<Unit>, Found, Vec<Diag>) {
        (self.units, self.found, self.diags)
    }

    fn parse(&mut self, name: &str, text: &str) -> usize {
        // Spans count from behind a byte order mark.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let parsed = fil_syntax::parse(name, text);
        // An included file goes on where the including one does: it needs no FINI.
        let included = !self.open.is_empty();
        let missing_fini = <&fil_diag::Code>::from(SyntaxCode::MissingFini);
        let needless = |diag: &Diag| included && diag.code == missing_fini;
        self.diags.extend(parsed.diags.into_iter().filter(|diag| !needless(diag)));
        let unit = self.units.len();
        let file = File::new(name, text);
        self.units.push(Unit { file, program: Program::default() });
        let mut wanted = Vec::new();
        for item in &parsed.program.items {
            match item {
                Item::Stmt(stmt) => inclusions(std::slice::from_ref(stmt), &mut wanted),
                Item::Section(section) => inclusions(&section.body, &mut wanted),
                Item::Macro(definition) => inclusions(&definition.body, &mut wanted),
            }
        }
        self.open.push(unit);
        for (name, span) in wanted {
            if let Some(included) = self.include(unit, &name, span) {
                self.found.included.insert((unit, span.start), included);
            }
        }
        self.open.pop();
        self.units[unit].program = parsed.program;
        unit
    }

    fn include(&mut self, from: usize, name: &str, span: Span) -> Option<usize> {
        let found = match &mut self.loader {
            None => Err("no files can be included here".to_string()),
            Some(loader) => loader(&self.units[from].file.name, name),
        };
        let included = match found {
            Ok(included) => included,
            Err(reason) => {
                self.refuse(from, span, format!("'{name}': {reason}"));
                return None;
            }
        };
        let known = self.units.iter().position(|unit| unit.file.name == included.name);
        match known {
            Some(known) if self.open.contains(&known) => {
                self.refuse(from, span, format!("'{name}' includes itself"));
                None
            }
            Some(known) => Some(known),
            None => Some(self.parse(&included.name, &included.text)),
        }
    }

    fn refuse(&mut self, from: usize, span: Span, message: String) {
        let place = self.units[from].file.place(span);
        self.diags.push(Diag::new(CompileCode::IncludeFailed, message).at(place));
    }
}

/// INCLUD statements, those within blocks too.
fn inclusions(body: &[Stmt], wanted: &mut Vec<(String, Span)>) {
    for stmt in body {
        if let StmtKind::Includ { file } = &stmt.kind {
            wanted.push((file.clone(), stmt.span));
        }
        crate::tree::inner_bodies(stmt, &mut |inner| inclusions(inner, wanted));
    }
}
