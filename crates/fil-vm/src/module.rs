//! A compiled set of FIL files.

use std::collections::HashMap;
use std::sync::Arc;

use fil_cl::WordId;
use fil_diag::{LineIndex, Place};
use fil_syntax::tree::Span;

use crate::matcher::Matcher;
use crate::ops::{Op, Reg};
use crate::postf::{Compat, PostfOp};

/// Number of a chunk in [`Module::chunks`].
pub type ChunkId = u16;

/// A section of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SectionId(pub u16);

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
    pub fn place(&self, span: Span) -> Place {
        self.lines.place(&self.name, &self.text, span.range())
    }
}

/// Where a statement stands and which names it uses.
#[derive(Clone, Debug)]
pub struct Statement {
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
pub struct Chunk {
    /// What it is: `section CYCLE`, `macro DEEPHL`, `global area of a.fil`.
    pub title: String,
    /// The operations.
    pub code: Vec<Op>,
    /// For each operation its index in [`Module::statements`].
    pub statements: Vec<u32>,
}

/// A CIMFIL section.
#[derive(Clone, Debug)]
pub struct Section {
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
pub enum Item {
    /// The value of a register: number or text.
    Value(Reg),
    /// A vocabulary word.
    Minor(WordId),
    /// A slot that holds nothing.
    Empty,
}

/// How a post word in FIL becomes a CL record.
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    /// The major word.
    pub major: WordId,
    /// Its name.
    pub name: String,
    /// Record type, word 2.
    pub kind: u32,
    /// Record subtype, word 3.
    pub sub: u32,
    /// Words 4 and up.
    pub items: Vec<Item>,
    /// The values are joined to the record's text (PPRINT, INSERT, …).
    pub is_text: bool,
}

/// Constants and texts that a machine loads into its registers before it runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Constant {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
}

/// A compiled set of FIL files; immutable, shared by machines.
#[derive(Clone, Debug, Default)]
pub struct Module {
    /// The files, in the order they were read.
    pub files: Vec<File>,
    /// All code.
    pub chunks: Vec<Chunk>,
    /// Chunks of the global areas, in the order they run.
    pub globals: Vec<ChunkId>,
    /// The sections.
    pub sections: Vec<Section>,
    /// Chunk of each macro.
    pub macros: Vec<ChunkId>,
    /// Statements, for places and notes of messages.
    pub statements: Vec<Statement>,
    /// Constant registers.
    pub constants: Vec<(Reg, Constant)>,
    /// Registers in use: 0 to this, exclusive.
    pub registers: u32,
    /// Names of registers that are variables.
    pub names: HashMap<Reg, String>,
    /// First element and length of each array in the array store.
    pub arrays: Vec<ArrayShape>,
    /// Post words.
    pub templates: Vec<Template>,
    /// Vocabulary words that operations name.
    pub words: Vec<WordId>,
    /// Which section takes which record.
    pub matcher: Matcher,
    /// Numbers of POSTF and the behaviour of sections.
    pub compat: Compat,
    /// Numbers of arguments of the embedding program's functions.
    pub host_arity: Vec<u16>,
}

/// An array in the array store.
#[derive(Clone, Debug, PartialEq)]
pub struct ArrayShape {
    /// Its name.
    pub name: String,
    /// First element.
    pub start: usize,
    /// Number of elements; subscripts run from 1 to this.
    pub len: usize,
}

impl Module {
    /// The statement of an operation.
    pub fn statement(&self, chunk: ChunkId, pc: usize) -> &Statement {
        let index = self.chunks[chunk as usize].statements[pc];
        &self.statements[index as usize]
    }

    /// The place of a statement.
    pub fn place(&self, statement: &Statement) -> Place {
        self.files[statement.file as usize].place(statement.span)
    }

    /// Uses of POSTF operations in the code, with the statement of each.
    pub fn postf_uses(&self) -> impl Iterator<Item = (PostfOp, &Statement)> {
        self.chunks.iter().flat_map(|chunk| {
            chunk.code.iter().zip(&chunk.statements).filter_map(|(op, statement)| match op {
                Op::RecordWord { .. } => Some((PostfOp::Word, *statement)),
                Op::Postf { op, .. } => PostfOp::from_index(*op).map(|op| (op, *statement)),
                _ => None,
            })
        })
        .map(|(op, statement)| (op, &self.statements[statement as usize]))
    }
}
