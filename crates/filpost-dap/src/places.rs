//! What a breakpoint in a line of a file stops at.

use std::path::{Path, PathBuf};

use filpost::Program;

use crate::breakpoints::{What, is_part, same_file};
use crate::hook::Files;

/// Which file breakpoints of lines stand in.
pub enum Kind {
    /// A FIL file, with its lines that run.
    Fil(PathBuf, Vec<u32>),
    /// The CL file.
    Cl,
    /// The NC program.
    Nc,
    /// No file of this run.
    Other,
}

/// Finds the file of a run that a path means; `nc` is the path of its program.
pub fn kind_of(path: &Path, files: &Files, nc: Option<&Path>, program: &Program) -> Kind {
    if same_file(path, &files.cl) {
        return Kind::Cl;
    }
    if nc.is_some_and(|nc| same_file(path, nc)) {
        return Kind::Nc;
    }
    let found = files.fil.iter().position(|fil| same_file(fil, path));
    let Some(number) = found else { return Kind::Other };
    let statements = program.outline().statements;
    let of_file = statements.iter().filter(|(_, place)| usize::from(place.file) == number);
    let mut lines: Vec<u32> = of_file.map(|(_, place)| place.line).collect();
    lines.sort_unstable();
    Kind::Fil(files.fil[number].clone(), lines)
}

impl Kind {
    /// What a breakpoint in a line stops at; `None` where nothing runs.
    pub fn place(&self, line: u64) -> Option<What> {
        match self {
            Kind::Fil(path, lines) => {
                let wanted = u32::try_from(line).ok()?;
                let line = lines.iter().find(|line| **line >= wanted)?;
                Some(What::Fil(path.clone(), *line))
            }
            Kind::Cl => u32::try_from(line).ok().map(What::Cl),
            Kind::Nc => Some(What::Nc(line)),
            Kind::Other => None,
        }
    }

    /// True for what stands in this file.
    pub fn has(&self, what: &What) -> bool {
        match (self, what) {
            (Kind::Fil(path, _), What::Fil(other, _)) => path == other,
            (Kind::Cl, What::Cl(_)) | (Kind::Nc, What::Nc(_)) => true,
            _ => false,
        }
    }
}

/// The line that a breakpoint really stands in.
pub fn line_of(what: &What) -> Option<u64> {
    match what {
        What::Fil(_, line) | What::Cl(line) => Some(u64::from(*line)),
        What::Nc(line) => Some(*line),
        _ => None,
    }
}

/// A named breakpoint of this program.
///
/// # Errors
/// A section or macro that its FIL does not have.
pub fn known(what: What, program: &Program) -> Result<What, String> {
    match what {
        What::Part(wanted)
            if !program.outline().parts.iter().any(|part| is_part(&wanted, &part.title)) =>
        {
            Err(format!("there is no {wanted} in the FIL of this run"))
        }
        what => Ok(what),
    }
}
