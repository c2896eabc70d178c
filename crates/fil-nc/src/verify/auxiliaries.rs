//! Auxiliary functions besides those of spindle, coolant, tool and end: each that the CL
//! file asks for must be there, and no other.

use std::collections::HashMap;

use super::blocks::OwnBlocks;
use super::report::{Finding, FindingKind, Report};
use super::settings::Settings;

/// What the CL file asks for.
#[derive(Clone, Copy, Debug)]
struct Asked {
    code: u32,
    cl_line: u32,
    /// Lines of the program between which it must stand: that of the last motion before
    /// it, and that of the next.
    lines: [u32; 2],
}

/// The functions that the CL file asks for.
#[derive(Debug, Default)]
pub(super) struct Auxiliaries {
    asked: Vec<Asked>,
    /// What a script may decide on, and between which lines of the program.
    allowed: Vec<(u32, [u32; 2])>,
    /// From this line of the program on nobody knows what must come.
    open_from: Option<u32>,
    /// Codes that may stand anywhere: those of the way out of threads, which shows in the passes of
    /// the cycles, and those that change nothing by the machine's own word.
    free: Vec<u32>,
}

impl Auxiliaries {
    pub(super) fn new(settings: &Settings<'_>) -> Self {
        let way_out = settings.way_out_codes().into_iter().flatten();
        let free = way_out.chain(settings.dialect.allowed_functions()).collect();
        Auxiliaries { free, ..Auxiliaries::default() }
    }

    pub(super) fn ask(&mut self, code: u32, cl_line: u32, lines: [u32; 2]) {
        self.asked.push(Asked { code, cl_line, lines });
    }

    pub(super) fn allow(&mut self, code: u32, lines: [u32; 2]) {
        self.allowed.push((code, lines));
    }

    fn allows(&self, line: u32, code: u32) -> bool {
        let here = |(allowed, [first, last]): &(u32, [u32; 2])| {
            *allowed == code && (*first..=*last).contains(&line)
        };
        self.allowed.iter().any(here)
    }

    /// Words of the user's own may hold any function from this line on.
    pub(super) fn open(&mut self, line: u32) {
        self.open_from.get_or_insert(line);
    }

    /// What is missing, what nobody asks for, what stands elsewhere. `found`: the line and
    /// the number of each function of the program; `own`: the blocks of the settings and of
    /// INSERT.
    pub(super) fn compare(&self, found: &[(u32, u32)], own: &OwnBlocks<'_>) -> Report {
        let mut report = Report::default();
        let mut left: HashMap<u32, usize> = HashMap::new();
        let of_others = |(line, code): &&(u32, u32)| !own.has(*line) && !self.allows(*line, *code);
        for (_, code) in found.iter().filter(of_others) {
            *left.entry(*code).or_default() += 1;
        }
        let mut found = found.iter().filter(of_others);
        for asked in &self.asked {
            let code = asked.code;
            if left.get(&code).is_none_or(|count| *count == 0) {
                let message = format!("no M{code}");
                find(&mut report, Some(asked.cl_line), None, message);
                continue;
            }
            for (line, other) in found.by_ref() {
                *left.entry(*other).or_default() -= 1;
                if *other != code {
                    self.extra(&mut report, *line, *other);
                    continue;
                }
                let [first, last] = asked.lines;
                if *line < first && self.is_free(code) && left[&code] > 0 {
                    continue;
                }
                if !(first..=last).contains(line) {
                    let message = format!(
                        "M{code} is elsewhere, it should be between lines {first} and {last}"
                    );
                    find(&mut report, Some(asked.cl_line), Some(*line), message);
                }
                break;
            }
        }
        found.for_each(|(line, code)| self.extra(&mut report, *line, *code));
        report
    }

    /// Where a function stands, and what it does, is nothing to look at.
    pub(super) fn is_free(&self, code: u32) -> bool {
        self.free.contains(&code)
    }

    fn extra(&self, report: &mut Report, line: u32, code: u32) {
        if !self.is_free(code) && self.open_from.is_none_or(|open| line < open) {
            let message = format!("M{code}: neither the CL file nor the settings ask for it");
            find(report, None, Some(line), message);
        }
    }
}

fn find(report: &mut Report, cl_line: Option<u32>, nc_line: Option<u32>, message: String) {
    report.find(Finding { kind: FindingKind::Auxiliary, cl_line, nc_line, message });
}
