//! Auxiliary functions besides those of spindle, coolant, tool and end: each that the CL
//! file asks for must be there, and no other.

use std::ops::RangeInclusive;

use super::blocks::OwnBlocks;
use super::report::{Finding, FindingKind};

/// What the CL file asks for.
#[derive(Clone, Debug)]
struct Asked {
    code: u32,
    cl_line: u32,
    /// Lines of the program between which it must stand: that of the last motion before
    /// it, and that of the next.
    lines: RangeInclusive<u32>,
}

/// The functions of a program and those that the CL file asks for.
#[derive(Debug, Default)]
pub(super) struct Auxiliaries {
    /// Line and number.
    found: Vec<(u32, u32)>,
    asked: Vec<Asked>,
    /// From this line of the program on nobody knows what must come.
    open_from: Option<u32>,
}

impl Auxiliaries {
    pub(super) fn found(&mut self, line: u32, code: u32) {
        self.found.push((line, code));
    }

    pub(super) fn ask(&mut self, code: u32, cl_line: u32, lines: RangeInclusive<u32>) {
        self.asked.push(Asked { code, cl_line, lines });
    }

    /// Words of the user's own may hold any function from this line on.
    pub(super) fn open(&mut self, line: u32) {
        self.open_from.get_or_insert(line);
    }

    /// What is missing, what nobody asks for, what stands elsewhere. `own`: the blocks of
    /// the settings and of INSERT.
    pub(super) fn compare(&self, own: &OwnBlocks<'_>) -> Vec<Finding> {
        let mut findings = Vec::new();
        let mut found = self.found.iter().filter(|(line, _)| !own.has(*line));
        let extra = |findings: &mut Vec<Finding>, line: u32, code: u32| {
            if self.open_from.is_none_or(|open| line < open) {
                let message = format!("M{code}: neither the CL file nor the settings ask for it");
                findings.push(finding(FindingKind::Auxiliary, None, Some(line), message));
            }
        };
        for asked in &self.asked {
            let code = asked.code;
            let rest = found.clone();
            let Some(before) = rest.clone().position(|(_, found)| *found == code) else {
                let message = format!("no M{code}");
                findings.push(finding(FindingKind::Auxiliary, Some(asked.cl_line), None, message));
                continue;
            };
            found.by_ref().take(before).for_each(|(line, code)| extra(&mut findings, *line, *code));
            let Some((line, _)) = found.next() else { continue };
            if !asked.lines.contains(line) {
                let message = format!(
                    "M{code} stands elsewhere, it should be between lines {} and {}",
                    asked.lines.start(),
                    asked.lines.end()
                );
                let kind = FindingKind::Auxiliary;
                findings.push(finding(kind, Some(asked.cl_line), Some(*line), message));
            }
        }
        found.for_each(|(line, code)| extra(&mut findings, *line, *code));
        findings
    }
}

fn finding(
    kind: FindingKind,
    cl_line: Option<u32>,
    nc_line: Option<u32>,
    message: String,
) -> Finding {
    Finding { kind, cl_line, nc_line, message }
}
