//! From trees to a [`Module`].
//!
//! All files share one name space, so the names of all of them are collected
//! first; then each section, macro and global area becomes a chunk of code.

mod arrays;
mod chunk;
mod conditions;
mod control;
mod debug;
mod expressions;
pub(crate) mod files;
mod functions;
mod macros;
pub(crate) mod names;
mod output;
mod posts;
pub(crate) mod sections;
mod statements;
mod texts;

use fil_cl::Vocabulary;
use fil_diag::{Diag, Levels};
use fil_syntax::tree::{Item, Program, Span};

use crate::allow::Allowed;
use crate::errors::CompileCode;
use crate::functions::Functions;
use crate::lint::{self, MachineFacts};
use crate::machine::Limits;
use crate::module::{File, Module};
use crate::open_blocks;
use crate::postf::Compat;
use crate::resolve::{self, Resolution};
use chunk::ChunkBuilder;
use files::{Includes, Unit};
use names::Slots;

/// A FIL file to load.
#[derive(Clone, Copy, Debug)]
pub struct FilFile<'a> {
    /// Name for messages.
    pub name: &'a str,
    /// Its text.
    pub text: &'a str,
}

/// A file that INCLUD has brought in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Included {
    /// Its name for messages, the same whichever file includes it.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// Gives a file that INCLUD names, or the reason why it can't. The first argument
/// is the name of the file the INCLUD stands in, the second what it says.
pub type Loader<'a> = &'a mut dyn FnMut(&str, &str) -> Result<Included, String>;

/// How FIL files are to be read.
#[derive(Default)]
pub struct LoadOptions<'a> {
    /// Numbers of POSTF and the behaviour of sections.
    pub compat: Compat,
    /// Limits; the compiler checks the sizes of arrays.
    pub limits: Limits,
    /// Refuse extensions of filpost.
    pub strict: bool,
    /// Look for what would run but is most likely not meant, see [`LintCode`](crate::errors::LintCode).
    pub lint: bool,
    /// Levels of findings in all files.
    pub levels: Levels,
    /// What the lints may ask about the machine.
    pub facts: MachineFacts<'a>,
    /// Functions of the embedding program.
    pub functions: Option<&'a Functions>,
    /// Where INCLUD gets its files; without it INCLUD is refused.
    pub loader: Option<Loader<'a>>,
    /// Make a debug build: bytecode that tells its host of each statement and each outcome
    /// of a condition, and does the same otherwise.
    pub debug: bool,
}

/// A module and the warnings of its making.
#[derive(Debug)]
pub struct Loaded {
    /// The compiled files.
    pub module: Module,
    /// Warnings, in the order of the files and their lines.
    pub warnings: Vec<Diag>,
}

/// All that is known of FIL files, also of such that can't run.
#[derive(Debug)]
pub struct Analysis {
    /// The files, those that INCLUD has brought in among them.
    pub files: Vec<File>,
    /// Their names, as far as the files could be read.
    pub resolution: Resolution,
    /// The compiled files; `None` when there are errors.
    pub module: Option<Module>,
    /// Errors and warnings, in the order of the files and their lines.
    pub diags: Vec<Diag>,
}

/// Reads and compiles FIL files, in this order, into one name space.
///
/// The module names words by their ids, so it must run with `vocab` or a clone
/// of it.
///
/// # Errors
/// With an error anywhere there is no module; all diagnostics come back.
pub fn load(
    files: &[FilFile<'_>],
    vocab: &mut Vocabulary,
    options: LoadOptions<'_>,
) -> Result<Loaded, Vec<Diag>> {
    let Analysis { module, diags, .. } = analyze(files, vocab, options);
    match module {
        Some(module) => Ok(Loaded { module, warnings: diags }),
        None => Err(diags),
    }
}

/// As [`load`], and with the names of all files, for an editor.
pub fn analyze(
    files: &[FilFile<'_>],
    vocab: &mut Vocabulary,
    options: LoadOptions<'_>,
) -> Analysis {
    let LoadOptions { compat, limits, strict, lint, levels, facts, functions, loader, debug } =
        options;
    let mut includes = Includes::new(loader);
    for file in files {
        includes.read(file.name, file.text);
    }
    let (units, found, mut diags) = includes.finish();
    let allowed = Allowed::new(&levels, &units);
    let input = resolve::Input { units: &units, found: &found, vocabulary: vocab, functions };
    let (resolution, names, unresolved) = resolve::resolve(input);
    diags.extend(unresolved);
    let slots = Slots::new(names, resolution.symbols.len());
    let module = Module {
        files: units.iter().map(|unit| unit.file.clone()).collect(),
        compat,
        host_arity: functions.map_or_else(Vec::new, Functions::arities),
        debug,
        ..Module::default()
    };
    let mut compiler = Compiler {
        units: &units,
        found: &found,
        vocab,
        strict,
        limits,
        functions,
        module,
        slots,
        diags,
        unit: 0,
        chunk: ChunkBuilder::default(),
        calls: Vec::new(),
        inside: None,
        noted: Vec::new(),
    };
    compiler.refuse_functions();
    compiler.run();
    let Compiler { mut module, mut diags, slots: Slots { names, .. }, vocab, .. } = compiler;
    let search = open_blocks::Search {
        units: &units,
        found: &found,
        names: &names,
        compat: &module.compat,
        vocabulary: vocab,
    };
    open_blocks::refuse(search, &allowed, &mut diags);
    diags.extend(resolve::findings::find(&resolution, &units, vocab, facts));
    diags = diags.into_iter().filter_map(|diag| allowed.at_level(diag)).collect();
    let mut refused = diags.iter().any(Diag::is_error);
    if lint && !refused {
        let program = lint::Program {
            units: &units,
            found: &found,
            module: &module,
            names: &names,
            resolution: &resolution,
        };
        let findings = lint::warnings(program, vocab, facts);
        diags.extend(findings.into_iter().filter_map(|diag| allowed.at_level(diag)));
        refused = diags.iter().any(Diag::is_error);
    }
    module.allowed = allowed.comments();
    sort(&mut diags, &units);
    let files = module.files.clone();
    Analysis { files, resolution, module: (!refused).then_some(module), diags }
}

/// Puts diagnostics into the order of the files and their lines.
fn sort(diags: &mut [Diag], units: &[Unit]) {
    diags.sort_by_key(|diag| {
        diag.spans.first().map(|place| {
            let file = units.iter().position(|unit| unit.file.name == place.file);
            (file, place.line, place.span.start)
        })
    });
}

struct Compiler<'t> {
    units: &'t [Unit],
    found: &'t files::Found,
    vocab: &'t mut Vocabulary,
    strict: bool,
    limits: Limits,
    functions: Option<&'t Functions>,
    module: Module,
    slots: Slots<'t>,
    diags: Vec<Diag>,
    /// The unit that is being compiled; also the index of its file.
    unit: usize,
    chunk: ChunkBuilder,
    /// Macros called by each macro, with unit and span of the call.
    calls: Vec<Vec<(u16, usize, Span)>>,
    /// The macro that is being compiled.
    inside: Option<u16>,
    /// POSTF numbers of our own reading that were noted.
    noted: Vec<u16>,
}

impl<'t> Compiler<'t> {
    /// Refuses functions of the embedding program whose names can't be taken.
    fn refuse_functions(&mut self) {
        let refused = self.functions.map(|functions| functions.refused_names(self.vocab));
        for message in refused.into_iter().flatten() {
            self.diags.push(*CompileCode::FunctionName.diag(message));
        }
    }

    fn run(&mut self) {
        self.declare();
        for unit in &self.found.roots {
            self.global_area(*unit);
        }
        for unit in &self.found.roots {
            self.sections_and_macros(*unit);
        }
        self.output_macros();
        self.refuse_recursion();
    }

    fn report(&mut self, code: CompileCode, span: Span, message: impl Into<String>) {
        self.report_with(code, span, message, None);
    }

    /// The same with a hint made for this case.
    fn report_with(
        &mut self,
        code: CompileCode,
        span: Span,
        message: impl Into<String>,
        hint: Option<String>,
    ) {
        let place = self.units[self.unit].file.place(span);
        self.diags.push(Diag { hint, ..Diag::new(code, message).at(place) });
    }

    /// An index that must fit a `u16` field of an operation.
    fn index(&mut self, index: usize, span: Span, what: &str) -> u16 {
        u16::try_from(index).unwrap_or_else(|_| {
            self.report_too_many(span, 65_536, what);
            0
        })
    }

    /// Too many of what a program may have only so many of: said once, and not for each of the
    /// hundred thousands that may follow.
    #[cold]
    fn report_too_many(&mut self, span: Span, most: u32, what: &str) {
        const LIMITS: usize = 8;
        let message = format!("more than {most} {what}");
        if self.diags.iter().rev().take(LIMITS).all(|last| last.message != message) {
            self.report(CompileCode::TooLarge, span, message);
        }
    }

    /// Items of a unit.
    fn program(&self, unit: usize) -> &'t Program {
        let units: &'t [Unit] = self.units;
        &units[unit].program
    }

    /// Runs `body` as part of another file.
    fn within<R>(&mut self, unit: usize, body: impl FnOnce(&mut Self) -> R) -> R {
        let outer = std::mem::replace(&mut self.unit, unit);
        let result = body(self);
        self.unit = outer;
        result
    }

    /// Sections and macros of a file and of those it includes.
    fn sections_and_macros(&mut self, unit: usize) {
        let program = self.program(unit);
        self.within(unit, |this| {
            for item in &program.items {
                match item {
                    Item::Section(section) => this.section(section),
                    Item::Macro(definition) => this.macro_definition(definition),
                    Item::Stmt(statement) => {
                        if let Some(included) = this.included(statement) {
                            this.sections_and_macros(included);
                        }
                    }
                }
            }
        });
    }
}
