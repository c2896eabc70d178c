//! Debug builds of the bytecode: what they tell their host, and what there is to be told of.

use crate::module::{Module, Statement};
use crate::ops::Op;

/// What a debug build tells its host.
#[derive(Clone, Copy, Debug)]
pub enum Probe<'a> {
    /// A statement runs next.
    Statement,
    /// The global area, a section or a macro begins.
    Enter,
    /// It ends.
    Leave,
    /// An outcome of a condition, by its number in [`Outline::branches`].
    Branch(u16),
    /// The run ends with this error where it stands.
    Failed(&'a fil_diag::Diag),
}

/// An outcome of a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BranchOutcome {
    /// The condition of an IF or ELSEIF is true.
    True,
    /// No condition of the IF is true, or no WHEN of the CASE fits.
    Else,
    /// The WHEN fits.
    When,
    /// The DO runs at least once.
    Pass,
    /// The DO does not run.
    NoPass,
    /// The value of an arithmetic IF is below 0.
    Negative,
    /// It is 0.
    Zero,
    /// It is above 0.
    Positive,
}

/// Where a piece of FIL stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CodePlace {
    /// Index in [`Module::files`].
    pub file: u16,
    /// Line, 1-based.
    pub line: u32,
    /// First byte.
    pub start: u32,
    /// One past its last byte.
    pub end: u32,
}

/// An outcome that can come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutlineBranch {
    /// The statement whose outcomes belong together: the IF, the CASE, the DO.
    pub opening: CodePlace,
    /// The condition itself, which is another place for ELSEIF and WHEN.
    pub place: CodePlace,
    /// Which outcome.
    pub outcome: BranchOutcome,
}

/// A global area, section or macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutlinePart {
    /// `section CYCLE`, `macro DEEPHL`, `global area of a.fil`.
    pub title: String,
    /// Where it stands; a global area stands at the start of its file.
    pub place: CodePlace,
}

/// All that a debug build can tell of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outline {
    /// The statements, with the numbers that [`View::statement`](crate::View::statement) gives.
    pub statements: Vec<(u32, CodePlace)>,
    /// The outcomes, by the numbers of [`Probe::Branch`].
    pub branches: Vec<OutlineBranch>,
    /// The parts, by the numbers that [`View::part`](crate::View::part) gives.
    pub parts: Vec<OutlinePart>,
}

impl Module {
    /// True for a debug build.
    pub fn is_debug(&self) -> bool {
        self.debug
    }

    /// What a debug build can tell of; empty but for the parts without one.
    pub fn outline(&self) -> Outline {
        let place = |number: u32| place(&self.statements[number as usize]);
        let mut outline = Outline::default();
        for chunk in &self.chunks {
            let of_chunk = chunk.code.iter().zip(&chunk.statements);
            let told = of_chunk.filter(|(op, _)| **op == Op::Statement);
            outline.statements.extend(told.map(|(_, number)| (*number, place(*number))));
            let first = chunk.statements[0];
            outline.parts.push(OutlinePart { title: chunk.title.clone(), place: place(first) });
        }
        outline.branches.extend(self.branches.iter().map(|branch| OutlineBranch {
            opening: place(branch.opening),
            place: place(branch.statement),
            outcome: branch.outcome,
        }));
        outline
    }
}

fn place(statement: &Statement) -> CodePlace {
    let Statement { file, line, span, .. } = statement;
    CodePlace { file: *file, line: *line, start: span.start, end: span.end }
}
