//! Names resolved: where each is defined and where it is used.
//!
//! This pass runs once over the trees of all files, before code is made and before
//! lints look at names. Its [`Resolution`] is plain data: a list of [`Symbol`]s
//! with the spans of their definitions and uses, for compilers, lints and editors.

mod calls;
mod declare;
pub(crate) mod findings;
mod items;
mod uses;

use std::collections::HashMap;

use fil_cl::Vocabulary;
use fil_diag::Diag;
use fil_syntax::tree::{Expr, Macro, Name, Span};

use crate::compile::files::{Found, Unit};
use crate::functions::Functions;

/// Position of a symbol in [`Resolution::symbols`].
pub type SymbolId = usize;

/// A span of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FileSpan {
    /// Index of the file, in the order they were read ([`Module::files`](crate::Module)).
    pub file: usize,
    /// Where it stands there, in bytes behind a byte order mark.
    pub span: Span,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SymbolKind {
    /// A variable, which all files share.
    Variable,
    /// A to Z: a variable that begins as the number of its address.
    Letter,
    /// A parameter of a macro.
    Parameter,
    /// An array of RESERV.
    Array,
    /// A table of DATA.
    Table,
    /// A macro.
    Macro,
    /// A section; its name is its key, `CYCLE,DEEP` or `5000,5`.
    Section,
    /// A label of a section, macro or global area.
    Label,
    /// A word of the vocabulary, or one of the user.
    Word,
    /// A built-in function, or a form of TEXT/ (`TEXT/UP`).
    Function,
    /// A function that the embedding program adds.
    HostFunction,
    /// A number of POSTF, `POSTF(13)`.
    Postf,
    /// What is called like a function and is none.
    Unknown,
}

/// How a name is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Its value is read.
    Read,
    /// It is an operand of an expression.
    Operand,
    /// It is a value of a WHEN by itself.
    When,
    /// It is an argument of CALL by itself.
    Argument,
    /// It is joined to a text by itself.
    Text,
    /// An element of the array is set.
    SetElement,
    /// The function, form or macro is called.
    Call,
    /// The parameter is given its argument by name.
    Parameter,
    /// A jump leads to the label.
    Jump,
    /// A DO ends at the label.
    LoopEnd,
    /// The word is the major word of a section's key.
    Key,
    /// The word is a minor word of a section's key.
    MinorKey,
    /// The word is the major word of a record that the script makes.
    Major,
    /// The word is a minor word of such a record.
    Minor,
    /// A function takes the word as it is written: ICODEF, HASF, COUPLF.
    Asked,
}

/// A use of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Use {
    /// Where.
    pub location: FileSpan,
    /// How.
    pub role: Role,
}

/// A name with all its definitions and uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// In upper case.
    pub name: String,
    /// What it stands for.
    pub kind: SymbolKind,
    /// The macro of a parameter; the section or macro of a label.
    pub owner: Option<SymbolId>,
    /// A whole section or macro, from its first line to its last.
    pub extent: Option<FileSpan>,
    /// Statements that give it a value or a meaning. A variable has one for each
    /// statement that sets it, a name that nothing sets has none.
    pub definitions: Vec<FileSpan>,
    /// All other places, in the order of the files and of their bodies.
    pub uses: Vec<Use>,
}

impl Symbol {
    /// True where the symbol is defined or used at a byte of a file.
    fn covers(&self, file: usize, byte: u32) -> bool {
        let is_it = |location: &FileSpan| {
            location.file == file && (location.span.start..=location.span.end).contains(&byte)
        };
        self.definitions.iter().any(is_it) || self.uses.iter().any(|used| is_it(&used.location))
    }
}

/// Every name of a program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Resolution {
    /// In the order of their first appearance.
    pub symbols: Vec<Symbol>,
}

impl Resolution {
    /// The symbols at a byte of a file, or right before it. There are several where
    /// two macros include one file and call a parameter alike.
    pub fn at(&self, file: usize, byte: u32) -> impl Iterator<Item = SymbolId> + '_ {
        let symbols = self.symbols.iter().enumerate();
        symbols.filter(move |(_, symbol)| symbol.covers(file, byte)).map(|(id, _)| id)
    }

    /// The symbols of a kind.
    pub fn of_kind(&self, kind: SymbolKind) -> impl Iterator<Item = &Symbol> {
        self.symbols.iter().filter(move |symbol| symbol.kind == kind)
    }
}

/// A name of the one name space of all files.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Global {
    pub symbol: SymbolId,
    /// Some statement sets it.
    pub assigned: bool,
    /// A statement sets it to a value that is no constant.
    pub computed: bool,
    /// Its position in [`Names::arrays`].
    pub array: Option<u16>,
    /// Its position in [`Names::macros`].
    pub macro_id: Option<u16>,
}

/// A macro with its file.
pub(crate) struct MacroEntry<'t> {
    pub definition: &'t Macro,
    pub unit: usize,
}

/// An array or table with its file.
pub(crate) struct ArrayEntry<'t> {
    pub unit: usize,
    pub name: &'t str,
    pub span: Span,
    pub size: ArraySize<'t>,
}

/// How large an array is.
#[derive(Clone, Copy)]
pub(crate) enum ArraySize<'t> {
    /// `RESERV/name,size`
    Reserved(&'t Expr),
    /// `DATA/name,values`
    Values(&'t [Expr]),
}

/// The names of a program as the compiler looks them up.
#[derive(Default)]
pub(crate) struct Names<'t> {
    pub globals: HashMap<&'t str, Global>,
    pub macros: Vec<MacroEntry<'t>>,
    pub arrays: Vec<ArrayEntry<'t>>,
}

impl Names<'_> {
    /// True for a name that some statement sets.
    pub fn is_assigned(&self, name: &str) -> bool {
        self.globals.get(name).is_some_and(|global| global.assigned)
    }

    /// The number of an array or table.
    pub fn array(&self, name: &str) -> Option<u16> {
        self.globals.get(name)?.array
    }

    /// The number of a macro.
    pub fn macro_id(&self, name: &str) -> Option<u16> {
        self.globals.get(name)?.macro_id
    }

    /// Names of all arrays and tables.
    pub fn array_names(&self) -> impl Iterator<Item = &str> {
        self.arrays.iter().map(|array| array.name)
    }
}

/// What the pass is given.
#[derive(Clone, Copy)]
pub(crate) struct Input<'t, 'v> {
    pub units: &'t [Unit],
    pub found: &'t Found,
    pub vocabulary: &'v Vocabulary,
    pub functions: Option<&'v Functions>,
}

/// Resolves the names of all files. The diagnostics are names without a meaning
/// and names with two.
pub(crate) fn resolve<'t>(input: Input<'t, '_>) -> (Resolution, Names<'t>, Vec<Diag>) {
    let mut resolver = Resolver {
        input,
        symbols: Vec::new(),
        names: Names::default(),
        words: HashMap::new(),
        callees: HashMap::new(),
        postfs: Vec::new(),
        parameters: Vec::new(),
        scope: Scope::default(),
        unit: 0,
        takes_letters: false,
        visited: vec![false; input.units.len()],
        again: false,
        diags: Vec::new(),
    };
    resolver.declare();
    resolver.walk();
    (Resolution { symbols: resolver.symbols }, resolver.names, resolver.diags)
}

/// The body that is being walked.
#[derive(Default)]
struct Scope<'t> {
    /// The section or macro; `None` in a global area.
    owner: Option<SymbolId>,
    /// Parameters of the macro.
    parameters: Vec<(&'t str, SymbolId)>,
    /// Labels that are given or jumped to.
    labels: HashMap<&'t str, SymbolId>,
}

struct Resolver<'t, 'v> {
    input: Input<'t, 'v>,
    symbols: Vec<Symbol>,
    names: Names<'t>,
    words: HashMap<&'t str, SymbolId>,
    callees: HashMap<&'t str, calls::Callee>,
    /// Numbers of POSTF; there are few.
    postfs: Vec<(f64, SymbolId)>,
    /// Symbols of the parameters of each macro.
    parameters: Vec<Vec<SymbolId>>,
    scope: Scope<'t>,
    /// The file that is being walked.
    unit: usize,
    /// Files that have been walked before.
    visited: Vec<bool>,
    /// An argument is walked where a letter is meant as the number of its address.
    takes_letters: bool,
    /// Statements of this file have been walked before: an INCLUD brings them a second time.
    again: bool,
    diags: Vec<Diag>,
}

impl<'t> Resolver<'t, '_> {
    fn symbol(&mut self, name: impl Into<String>, kind: SymbolKind) -> SymbolId {
        self.symbols.push(Symbol {
            name: name.into(),
            kind,
            owner: None,
            extent: None,
            definitions: Vec::new(),
            uses: Vec::new(),
        });
        self.symbols.len() - 1
    }

    fn location(&self, span: Span) -> FileSpan {
        FileSpan { file: self.unit, span }
    }

    fn define(&mut self, symbol: SymbolId, span: Span) {
        let location = self.location(span);
        let definitions = &mut self.symbols[symbol].definitions;
        if !self.again || !definitions.contains(&location) {
            definitions.push(location);
        }
    }

    fn used(&mut self, symbol: SymbolId, span: Span, role: Role) {
        let new = Use { location: self.location(span), role };
        let uses = &mut self.symbols[symbol].uses;
        if !self.again || !uses.contains(&new) {
            uses.push(new);
        }
    }

    /// The entry of a name in the one name space, made where it is new.
    fn global(&mut self, name: &'t str) -> &mut Global {
        if !self.names.globals.contains_key(name) {
            let is_letter = crate::compile::names::letter(name).is_some();
            let kind = if is_letter { SymbolKind::Letter } else { SymbolKind::Variable };
            let symbol = self.symbol(name, kind);
            let global =
                Global { symbol, assigned: false, computed: false, array: None, macro_id: None };
            self.names.globals.insert(name, global);
        }
        self.names.globals.get_mut(name).expect("it was just made")
    }

    /// The parameter of the macro that is being walked.
    fn parameter(&self, name: &str) -> Option<SymbolId> {
        self.scope.parameters.iter().find(|(known, _)| *known == name).map(|(_, symbol)| *symbol)
    }

    /// True for a name whose value a post word or text would take.
    fn is_assigned(&self, name: &str) -> bool {
        self.parameter(name).is_some() || self.names.is_assigned(name)
    }

    fn word(&mut self, name: &'t str, span: Span, role: Role) {
        let symbol = match self.words.get(name) {
            Some(symbol) => *symbol,
            None => {
                let symbol = self.symbol(name, SymbolKind::Word);
                self.words.insert(name, symbol);
                symbol
            }
        };
        self.used(symbol, span, role);
    }

    fn word_of(&mut self, name: &'t Name, role: Role) {
        self.word(&name.text, name.span, role);
    }

    fn report(&mut self, code: impl Into<&'static fil_diag::Code>, span: Span, message: String) {
        self.report_with(code, span, message, None);
    }

    /// The same with a hint made for this case.
    fn report_with(
        &mut self,
        code: impl Into<&'static fil_diag::Code>,
        span: Span,
        message: String,
        hint: Option<String>,
    ) {
        // An INCLUD that brings the same statements again brings nothing new.
        if self.again {
            return;
        }
        let place = self.input.units[self.unit].file.place(span);
        self.diags.push(Diag { hint, ..Diag::new(code, message).at(place) });
    }
}
