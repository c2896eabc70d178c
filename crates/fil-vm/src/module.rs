//! A compiled set of FIL files.

use std::collections::HashMap;
use std::sync::Arc;

use fil_cl::{Record, Vocabulary, WordId};
use fil_diag::{LineIndex, TextSpan};
use fil_syntax::tree::Span;

use crate::debug::BranchOutcome;
use crate::library::LibraryCall;
use crate::matcher::Matcher;
use crate::ops::{Op, Reg};
use crate::output::OutputMacros;
use crate::postf::Compat;

/// Number of a chunk in [`Module::chunks`].
pub(crate) type ChunkId = u16;

/// A section of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SectionId(pub(crate) u16);

impl SectionId {
    /// Its number, in the order of the sections in FIL.
    pub fn index(self) -> u16 {
        self.0
    }
}

/// A FIL file with its text.
#[derive(Clone, Debug)]
pub struct File {
    /// Name as the user gave it.
    pub name: String,
    /// Its text.
    pub text: Arc<str>,
    pub(crate) lines: LineIndex,
}

impl File {
    pub(crate) fn new(name: &str, text: &str) -> Self {
        File { name: name.to_string(), text: text.into(), lines: LineIndex::new(text) }
    }

    /// The place of a span of this file.
    pub fn place(&self, span: Span) -> TextSpan {
        self.lines.place(&self.name, &self.text, span.range())
    }
}

/// Where a statement stands and which names it uses.
#[derive(Clone, Debug)]
pub(crate) struct Statement {
    /// Index of the file.
    pub file: u16,
    /// Line, 1-based.
    pub line: u32,
    /// Where it stands.
    pub span: Span,
    /// Registers of the names used in it.
    pub names: Vec<Reg>,
}

/// Code that runs from its first operation to `Return`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chunk {
    /// What it is: `section CYCLE`, `macro DEEPHL`, `global area of a.fil`.
    pub title: String,
    /// The operations.
    pub code: Vec<Op>,
    /// For each operation its index in [`Module::statements`].
    pub statements: Vec<u32>,
    /// The parameters of a macro.
    pub parameters: Vec<(String, Reg)>,
}

/// A CIMFIL section.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    /// Its key as written: `CYCLE,DEEP` or `5000,5`.
    pub key: String,
    /// Its code.
    pub chunk: ChunkId,
    /// Index of its file.
    pub file: u16,
    /// Where it stands.
    pub span: Span,
}

/// One item of a post word's template.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Item {
    /// The value of a register: number or text.
    Value(Reg),
    /// A vocabulary word.
    Minor(WordId),
}

/// How a post word in FIL becomes a CL record.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Template {
    /// The major word.
    pub major: WordId,
    /// Its name.
    pub name: String,
    /// Its items in order.
    pub items: Vec<Item>,
    /// The values are joined to the record's text (PPRINT, INSERT, …).
    pub is_text: bool,
}

/// Constants and texts that a machine loads into its registers before it runs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Constant {
    /// A number; 999999 is EMPTY.
    Number(f64),
    /// ICODEF of a word.
    Word(WordId),
    /// A text.
    Text(String),
}

/// A compiled set of FIL files; immutable, shared by machines.
#[derive(Clone, Debug, Default)]
pub struct Module {
    /// The files, in the order they were read.
    pub files: Vec<File>,
    /// What comments allow of doubts while the script runs: the number of the file, the line or 0
    /// for the whole file, and the number of the code.
    pub allowed: Vec<(u16, u32, u16)>,
    /// All code.
    pub(crate) chunks: Vec<Chunk>,
    /// Chunks of the global areas, in the order they run.
    pub(crate) globals: Vec<ChunkId>,
    /// The sections.
    pub(crate) sections: Vec<Section>,
    /// Chunk of each macro.
    pub(crate) macros: Vec<ChunkId>,
    /// Statements, for places and notes of messages.
    pub(crate) statements: Vec<Statement>,
    /// Constant registers.
    pub(crate) constants: Vec<(Reg, Constant)>,
    /// Registers in use: 0 to this, exclusive.
    pub(crate) registers: u32,
    /// Registers of the variables all files share.
    pub(crate) variables: HashMap<String, Reg>,
    /// Names of registers that are variables or parameters.
    pub(crate) names: HashMap<Reg, String>,
    /// First element and length of each array in the array store.
    pub(crate) arrays: Vec<ArrayShape>,
    /// Post words.
    pub(crate) templates: Vec<Template>,
    /// Values of the tables of DATA by their place in the array store.
    pub(crate) data: Vec<(usize, Constant)>,
    /// Calls on texts, files and the clock.
    pub(crate) calls: Vec<LibraryCall>,
    /// Vocabulary words that operations name.
    pub(crate) words: Vec<WordId>,
    /// Macros that edit what the post writes.
    pub(crate) output: OutputMacros,
    /// Which section takes which record.
    pub(crate) matcher: Matcher,
    /// Numbers of POSTF and the behaviour of sections.
    pub compat: Compat,
    /// FIL asks for numbers of the whole program.
    pub(crate) asks_totals: bool,
    /// Numbers of arguments of the embedding program's functions.
    pub(crate) host_arity: Vec<u16>,
    /// The outcomes of conditions, in a debug build alone.
    pub(crate) branches: Vec<Branch>,
    /// The bytecode tells its host of each statement.
    pub(crate) debug: bool,
}

/// An outcome of a condition, in a debug build.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Branch {
    /// The statement whose outcomes belong together, in [`Module::statements`].
    pub opening: u32,
    /// The statement with the condition: another one for ELSEIF and WHEN.
    pub statement: u32,
    /// Which one it is.
    pub outcome: BranchOutcome,
}

/// An array in the array store.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ArrayShape {
    /// Its name.
    pub name: String,
    /// First element.
    pub start: usize,
    /// Number of elements; subscripts run from 1 to this.
    pub len: usize,
    /// A table of DATA, which no statement changes.
    pub read_only: bool,
}

impl Module {
    /// The section that takes a record.
    #[inline]
    pub fn find(&self, record: &Record, vocab: &Vocabulary) -> Option<SectionId> {
        self.matcher.find(record, vocab)
    }

    /// The key of a section as FIL writes it: `CYCLE,DEEP` or `5000,5`.
    pub fn section_key(&self, section: SectionId) -> &str {
        &self.sections[usize::from(section.0)].key
    }

    /// The keys of all sections, by [`SectionId::index`].
    pub fn section_keys(&self) -> impl Iterator<Item = &str> {
        self.sections.iter().map(|section| section.key.as_str())
    }

    /// Where a section stands.
    pub fn section_place(&self, section: SectionId) -> TextSpan {
        let section = &self.sections[usize::from(section.0)];
        self.files[usize::from(section.file)].place(section.span)
    }

    /// True when FIL has no section, so that no record needs the machine.
    pub fn has_no_section(&self) -> bool {
        self.sections.is_empty()
    }

    /// True when FIL has a macro that edits what the post writes.
    pub fn edits_output(&self) -> bool {
        !self.output.is_empty()
    }

    /// True when FIL asks for numbers of the whole program (PROGF, TLISTF, OPERF and
    /// TOOLF(NEXT)), which need a first pass over the CL file.
    pub fn asks_totals(&self) -> bool {
        self.asks_totals
    }

    /// The statement of an operation.
    pub(crate) fn statement(&self, chunk: ChunkId, pc: usize) -> &Statement {
        let index = self.chunks[usize::from(chunk)].statements[pc];
        &self.statements[index as usize]
    }

    /// The place of a statement.
    pub(crate) fn place(&self, statement: &Statement) -> TextSpan {
        self.files[usize::from(statement.file)].place(statement.span)
    }
}
