//! Coverage: what of FIL has run, over any number of programs and runs.
//!
//! A [`Recorder`] is the debugger of one run of a program that was built with
//! [`Builder::debug`](crate::Builder::debug); a [`Coverage`] collects recorders.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use fil_diag::Diag;

use crate::debug::{BranchOutcome, CodePlace, DebugEvent, DebugState, Debugger};
use crate::program::Program;

/// Counts what runs.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    statements: Vec<u64>,
    branches: Vec<u64>,
    parts: Vec<u64>,
}

impl Debugger for Recorder {
    fn at(
        &mut self,
        event: DebugEvent<'_>,
        state: &mut DebugState<'_, '_>,
    ) -> Result<(), Box<Diag>> {
        match event {
            DebugEvent::Statement => {
                count(&mut self.statements, state.fil.statement().map(|number| number as usize));
            }
            DebugEvent::Branch(number) => count(&mut self.branches, Some(usize::from(number))),
            DebugEvent::Enter => count(&mut self.parts, state.fil.part()),
            _ => {}
        }
        Ok(())
    }
}

fn count(counts: &mut Vec<u64>, at: Option<usize>) {
    let Some(at) = at else { return };
    if counts.len() <= at {
        counts.resize(at + 1, 0);
    }
    counts[at] += 1;
}

/// An outcome of a condition and how often it came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoveredBranch {
    /// Line of the IF, CASE or DO that the outcome belongs to.
    pub opening: u32,
    /// Line of the condition: another one for ELSEIF and WHEN.
    pub line: u32,
    /// Which outcome.
    pub outcome: BranchOutcome,
    /// How often it came.
    pub count: u64,
}

/// A section or macro and how often it ran.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoveredPart {
    /// `section CYCLE`, `macro DEEPHL`.
    pub title: String,
    /// Its first line.
    pub line: u32,
    /// How often it ran.
    pub count: u64,
}

/// What of a file has run.
#[derive(Clone, Debug, Default)]
pub struct CoveredFile {
    /// Its text.
    pub text: Arc<str>,
    /// By the bytes of the statement: its line and how often it ran.
    statements: BTreeMap<(u32, u32), (u32, u64)>,
    branches: BTreeMap<(CodePlace, CodePlace, BranchOutcome), u64>,
    parts: BTreeMap<(u32, String), (u32, u64)>,
}

/// How much of what there is has run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// What has run.
    pub hit: usize,
    /// What there is.
    pub all: usize,
}

impl std::ops::AddAssign for Share {
    fn add_assign(&mut self, other: Share) {
        self.hit += other.hit;
        self.all += other.all;
    }
}

impl std::fmt::Display for Share {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Share { hit, all } = self;
        // Rounded down: only all is 100 %.
        let percent = if *all == 0 { 100 } else { hit * 100 / all };
        write!(f, "{hit} of {all} ({percent} %)")
    }
}

fn share(counts: impl Iterator<Item = u64>) -> Share {
    counts.fold(Share::default(), |share, count| Share {
        hit: share.hit + usize::from(count > 0),
        all: share.all + 1,
    })
}

impl CoveredFile {
    /// Lines with statements, and how often the first statement of each ran.
    pub fn lines(&self) -> BTreeMap<u32, u64> {
        let mut lines = BTreeMap::new();
        for (line, count) in self.statements.values() {
            lines.entry(*line).or_insert(*count);
        }
        lines
    }

    /// The outcomes of conditions, in the order of the file.
    pub fn branches(&self) -> Vec<CoveredBranch> {
        let branch = |((opening, place, outcome), count): (&(CodePlace, CodePlace, _), &u64)| {
            CoveredBranch {
                opening: opening.line,
                line: place.line,
                outcome: *outcome,
                count: *count,
            }
        };
        self.branches.iter().map(branch).collect()
    }

    /// Sections and macros, in the order of the file.
    pub fn parts(&self) -> Vec<CoveredPart> {
        let parts = self.parts.iter();
        let part = |((_, title), (line, count)): (&(u32, String), &(u32, u64))| CoveredPart {
            title: title.clone(),
            line: *line,
            count: *count,
        };
        parts.map(part).collect()
    }

    /// How many lines have run.
    pub fn line_share(&self) -> Share {
        share(self.lines().into_values())
    }

    /// How many outcomes have come.
    pub fn branch_share(&self) -> Share {
        share(self.branches.values().copied())
    }

    /// How many sections and macros have run.
    pub fn part_share(&self) -> Share {
        share(self.parts.values().map(|(_, count)| *count))
    }
}

/// What of all files has run.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    /// By name and text: two programs may call different files by one name.
    files: BTreeMap<(String, Arc<str>), CoveredFile>,
}

impl Coverage {
    /// Adds what a recorder has counted in runs of a program; an empty one says that the
    /// files are there.
    pub fn add(&mut self, program: &Program, recorder: &Recorder) {
        let module = &program.shared.module;
        let outline = module.outline();
        let keys: Vec<(String, Arc<str>)> =
            module.files.iter().map(|file| (file.name.clone(), Arc::clone(&file.text))).collect();
        for key in &keys {
            let file = self.files.entry(key.clone()).or_default();
            file.text = Arc::clone(&key.1);
        }
        for (number, place) in &outline.statements {
            let counted = recorder.statements.get(*number as usize).copied().unwrap_or(0);
            let known = &mut self.file(&keys, *place).statements;
            known.entry((place.start, place.end)).or_insert((place.line, 0)).1 += counted;
        }
        for (number, branch) in outline.branches.iter().enumerate() {
            let counted = recorder.branches.get(number).copied().unwrap_or(0);
            // Numbers of files differ from program to program.
            let plain = |place: CodePlace| CodePlace { file: 0, ..place };
            let key = (plain(branch.opening), plain(branch.place), branch.outcome);
            *self.file(&keys, branch.place).branches.entry(key).or_default() += counted;
        }
        for (number, part) in outline.parts.iter().enumerate() {
            if part.title.starts_with("global area") {
                continue;
            }
            let counted = recorder.parts.get(number).copied().unwrap_or(0);
            let key = (part.place.start, part.title.clone());
            let known = &mut self.file(&keys, part.place).parts;
            known.entry(key).or_insert((part.place.line, 0)).1 += counted;
        }
    }

    fn file(&mut self, keys: &[(String, Arc<str>)], place: CodePlace) -> &mut CoveredFile {
        self.files.entry(keys[usize::from(place.file)].clone()).or_default()
    }

    /// The files by their names, in the order of these.
    pub fn files(&self) -> impl Iterator<Item = (&str, &CoveredFile)> {
        self.files.iter().map(|((name, _), file)| (name.as_str(), file))
    }

    /// True when a statement that begins in a line of the file has run.
    pub fn has_run(&self, name: &str, line: u32) -> bool {
        let mut files = self.files.iter().filter(|((known, _), _)| known == name);
        files.any(|(_, file)| {
            file.statements.values().any(|(known, count)| *known == line && *count > 0)
        })
    }

    /// The tracefile of lcov, which editors and code hosts read. Names of files are absolute
    /// where `absolute` makes them so.
    pub fn lcov(&self, absolute: impl Fn(&str) -> String) -> String {
        let mut text = String::new();
        for (name, file) in self.files() {
            let _ = writeln!(text, "TN:\nSF:{}", absolute(name));
            lcov_of(file, &mut text);
            text.push_str("end_of_record\n");
        }
        text
    }
}

/// The lines of one file; writing to a text can't fail.
fn lcov_of(file: &CoveredFile, text: &mut String) {
    for part in file.parts() {
        let _ = writeln!(text, "FN:{},{}", part.line, part.title);
    }
    for part in file.parts() {
        let _ = writeln!(text, "FNDA:{},{}", part.count, part.title);
    }
    let parts = file.part_share();
    let _ = writeln!(text, "FNF:{}\nFNH:{}", parts.all, parts.hit);
    let lines = file.lines();
    let mut number = 0;
    let mut last = None;
    for branch in file.branches() {
        number = if last == Some(branch.opening) { number + 1 } else { 0 };
        last = Some(branch.opening);
        // What was never tested at all is a dash.
        let tested = lines.get(&branch.opening).is_some_and(|count| *count > 0);
        let count = if tested { branch.count.to_string() } else { "-".to_string() };
        let _ = writeln!(text, "BRDA:{},{},{number},{count}", branch.line, branch.opening);
    }
    let branches = file.branch_share();
    let _ = writeln!(text, "BRF:{}\nBRH:{}", branches.all, branches.hit);
    for (line, count) in &lines {
        let _ = writeln!(text, "DA:{line},{count}");
    }
    let share = file.line_share();
    let _ = writeln!(text, "LF:{}\nLH:{}", share.all, share.hit);
}

/// An outcome that has not come, in words.
pub fn never(branch: &CoveredBranch) -> String {
    let line = branch.line;
    match branch.outcome {
        BranchOutcome::True => format!("line {line}: the condition was never true"),
        BranchOutcome::Else => format!("line {line}: one of its branches was always taken"),
        BranchOutcome::When => format!("line {line}: the WHEN never fitted"),
        BranchOutcome::Pass => format!("line {line}: the DO never had a pass"),
        BranchOutcome::NoPass => format!("line {line}: the DO always had a pass"),
        BranchOutcome::Negative => format!("line {line}: the value was never below 0"),
        BranchOutcome::Zero => format!("line {line}: the value was never 0"),
        BranchOutcome::Positive => format!("line {line}: the value was never above 0"),
    }
}
