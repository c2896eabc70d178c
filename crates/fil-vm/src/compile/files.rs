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

/// Most files that one may include, those that they include counted each time.
const MOST_FILES: usize = 10_000;

/// Most bytes of these.
const MOST_BYTES: usize = 64 << 20;

/// Most files that include one another in a row.
const DEEPEST: usize = 64;

/// What a file comes to.
#[derive(Clone, Copy)]
struct Size {
    files: usize,
    bytes: usize,
}

/// Reads files and, through the loader, those they include.
pub(super) struct Includes<'a> {
    loader: Option<Loader<'a>>,
    units: Vec<Unit>,
    found: Found,
    /// Units that are being read, outermost first.
    open: Vec<usize>,
    /// What each unit comes to with all that it includes, each time that it does.
    sizes: Vec<Size>,
    diags: Vec<Diag>,
}

impl<'a> Includes<'a> {
    pub fn new(loader: Option<Loader<'a>>) -> Self {
        Includes {
            loader,
            units: Vec::new(),
            found: Found::default(),
            open: Vec::new(),
            sizes: Vec::new(),
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
        self.sizes.push(Size { files: 1, bytes: text.len() });
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
            let Some(included) = self.include(unit, &name, span) else { continue };
            if !self.grow(unit, included, &name, span) {
                // The files behind it are too much as well.
                break;
            }
            self.found.included.insert((unit, span.start), included);
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
            None if self.open.len() >= DEEPEST => {
                let message = format!("'{name}': more than {DEEPEST} files include each other");
                self.refuse(from, span, message);
                None
            }
            None => Some(self.parse(&included.name, &included.text)),
        }
    }

    /// Counts an included file; refuses one with which its file would come to too much.
    fn grow(&mut self, unit: usize, included: usize, name: &str, span: Span) -> bool {
        let (own, more) = (self.sizes[unit], self.sizes[included]);
        let size = Size { files: own.files + more.files, bytes: own.bytes + more.bytes };
        if size.files > MOST_FILES || size.bytes > MOST_BYTES {
            let message = format!(
                "'{name}': with it more than {MOST_FILES} files or {MOST_BYTES} bytes are included"
            );
            self.refuse(unit, span, message);
            return false;
        }
        self.sizes[unit] = size;
        true
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
        fil_syntax::walk::inner_bodies(stmt, &mut |inner| inclusions(inner, wanted));
    }
}
