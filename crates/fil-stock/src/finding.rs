//! What a simulation reports.

use std::collections::BTreeMap;

use fil_diag::{Code, Level, Levels, Severity};

use crate::errors::StockCode;

/// What made a line of a program, from its line map.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    /// Line of the CL file; 0 when not known.
    pub cl_line: u32,
    /// The CL record and the FIL lines, one a line.
    pub text: String,
}

/// A fault over one or more motions in a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Its code.
    pub code: &'static Code,
    /// Error or warning, by its level.
    pub severity: Severity,
    /// First line of the program.
    pub line: u32,
    /// Last line of the program.
    pub last: u32,
    /// Number of the tool.
    pub tool: u32,
    /// Most that is touched, mm along the tool.
    pub depth: f64,
    /// Length of the way in the material, mm.
    pub length: f64,
    /// Where it is deepest: X and Y of the cell, Z of the tool's surface, mm in the coordinates of
    /// the part.
    pub at: [f64; 3],
    /// Why the motion is not simulated; empty for one that is.
    pub reason: &'static str,
    /// What made the first line, where that is known.
    pub source: Option<Source>,
}

impl Finding {
    /// One sentence without line numbers.
    pub fn message(&self) -> String {
        let code = |code: StockCode| self.code == <&Code>::from(code);
        if code(StockCode::Compensated) {
            return "the path is taken as that of the tool center".into();
        }
        if code(StockCode::UnknownStart) {
            return "the motion is not simulated".into();
        }
        if code(StockCode::NotTurning) {
            return format!("tool {}: {}", self.tool, self.reason);
        }
        let [x, y, z] = self.at.map(short);
        let (tool, depth) = (self.tool, short(self.depth));
        let place = format!("at X{x} Y{y} Z{z}");
        let length = short(self.length);
        if code(StockCode::BelowPart) {
            return format!("tool {tool} cuts {depth} mm below the part {place}, {length} mm long");
        }
        format!("tool {tool}, {depth} mm deep {place}, {length} mm long")
    }
}

/// Three decimals at most.
fn short(value: f64) -> String {
    fil_nc::decimals::short(value, 3)
}

/// What a program cuts, and what is wrong with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// In the order of the program.
    pub findings: Vec<Finding>,
    /// Findings that are not listed.
    pub more: u64,
    /// A finding is an error, listed or not.
    pub fails: bool,
    /// Volume by the number of the tool, mm³.
    pub removed: BTreeMap<u32, f64>,
    /// Volume of the stock before the first cut, mm³.
    pub stock: f64,
    /// Motions that were simulated.
    pub motions: u64,
    /// Rapids from a position that is not known, of which only the end was checked.
    pub ends_only: u64,
    /// Tools that cut and whose holder is not known.
    pub without_holder: Vec<u32>,
    /// The larger side of a cell, mm.
    pub cell: f64,
}

impl Report {
    /// Volume that all tools removed, mm³.
    pub fn total(&self) -> f64 {
        // The sum of nothing would be -0.
        self.removed.values().sum::<f64>() + 0.0
    }

    /// What made the lines of the findings.
    pub fn name_sources(&mut self, source: &dyn Fn(u32) -> Option<Source>) {
        for found in &mut self.findings {
            found.source = source(found.line);
        }
    }
}

/// Most findings that are listed.
const MOST: usize = 50;

/// Findings in the making: those of one kind in motions that follow each other are one.
pub(crate) struct Findings<'l> {
    levels: &'l Levels,
    /// With the number of the motion that each was in last.
    list: Vec<(Finding, u64)>,
    more: u64,
    fails: bool,
}

/// A fault of one motion.
#[derive(Default)]
pub(crate) struct Fault {
    pub code: Option<StockCode>,
    /// Why the motion is not simulated.
    pub reason: &'static str,
    pub depth: f64,
    pub length: f64,
    pub at: [f64; 3],
}

impl<'l> Findings<'l> {
    pub fn new(levels: &'l Levels) -> Self {
        Findings { levels, list: Vec::new(), more: 0, fails: false }
    }

    /// Adds a fault of a motion.
    pub fn add(&mut self, fault: &Fault, line: u32, tool: u32, motion: u64) {
        let Some(code) = fault.code else { return };
        let code: &'static Code = code.into();
        let severity = match self.levels.set_for(code) {
            Some(Level::Allow) => return,
            Some(Level::Warn) => Severity::Warning,
            Some(Level::Deny) => Severity::Error,
            None => code.severity(),
        };
        let goes_on = |(found, last): &&mut (Finding, u64)| {
            let is_same = found.code == code && found.reason == fault.reason;
            is_same && found.tool == tool && motion - *last <= 1
        };
        self.fails |= severity == Severity::Error;
        if let Some((found, last)) = self.list.iter_mut().rev().take(8).find(goes_on) {
            *last = motion;
            found.last = line;
            found.length += fault.length;
            if fault.depth > found.depth {
                (found.depth, found.at) = (fault.depth, fault.at);
            }
            return;
        }
        if self.list.len() == MOST {
            self.more += 1;
            return;
        }
        let Fault { depth, length, at, reason, .. } = *fault;
        let found = Finding {
            code,
            severity,
            line,
            last: line,
            tool,
            depth,
            length,
            at,
            reason,
            source: None,
        };
        self.list.push((found, motion));
    }

    /// Hands all of them over.
    pub fn end(self, report: &mut Report) {
        report.findings = self.list.into_iter().map(|(found, _)| found).collect();
        (report.more, report.fails) = (self.more, self.fails);
    }
}
