//! A program of the generator through the post and the interpreter, and what
//! comes of it.

use std::path::Path;

use crate::path::Unit;
use crate::posting::{self, Job, Machine, Posted, Refused};

use super::compare::{Difference, Tolerance, compare};
use super::expected::Expected;
use super::lathe;
use super::machine::{self, NcStep, Tape, without_number};
use super::make::Program;
use super::model::{World, expect};
use super::statement::Statement;

/// What came of a program.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The machine does what the CL asks for.
    Agrees,
    /// The post refuses it, with this code, and may.
    Refused(String),
    /// The machine does something else, or the post refuses what it should not.
    Differs(Difference),
    /// The model can't tell.
    Unpredictable,
}

/// A program on its way: posted, not yet run.
struct Case {
    /// As the control reads it with and without blocks that have a skip mark.
    worlds: Vec<(World, Expected)>,
    posted: Result<Posted, Refused>,
}

/// The CL text of a program.
pub fn cl_text(program: &Program) -> String {
    expect(&program.setup, &program.statements, World::Whole).cl
}

/// The program that the post makes, or its refusal.
pub fn nc_text(program: &Program) -> String {
    match posting::post(&job(program)) {
        Ok(posted) => posted.nc,
        Err(refused) => format!("refused: {}\n", refused.message),
    }
}

fn job(program: &Program) -> Job {
    Job {
        machine: Machine::Ready(program.setup.ready.to_string()),
        settings: program.setup.settings.clone(),
        cl: cl_text(program),
        ..Job::default()
    }
}

/// Posts programs, runs them in one process, compares.
pub fn judge(rs274: &Path, programs: &[Program]) -> Vec<Verdict> {
    judge_changed(rs274, programs, |nc| nc)
}

/// The same, with the NC programs changed before they are run.
pub fn judge_changed(
    rs274: &Path,
    programs: &[Program],
    mut change: impl FnMut(String) -> String,
) -> Vec<Verdict> {
    let mut cases: Vec<Case> = programs.iter().map(case).collect();
    for posted in cases.iter_mut().filter_map(|case| case.posted.as_mut().ok()) {
        posted.nc = change(std::mem::take(&mut posted.nc));
    }
    let mut tapes = Vec::new();
    for (program, case) in programs.iter().zip(&cases) {
        if let Ok(posted) = &case.posted {
            tapes.extend(case.worlds.iter().map(|(world, _)| Tape {
                nc: &posted.nc,
                setup: &program.setup,
                skipping: *world == World::Skipping,
            }));
        }
    }
    let mut runs = run(rs274, &tapes).into_iter();
    let both = programs.iter().zip(&cases);
    both.map(|(program, case)| verdict(program, case, &mut runs)).collect()
}

/// A machine of LinuxCNC is its interpreter, a Fanuc lathe is our own; the programs are of one
/// kind.
fn run(rs274: &Path, tapes: &[Tape<'_>]) -> Vec<Result<Vec<NcStep>, String>> {
    match tapes.first() {
        Some(first) if first.setup.runs_on_our_lathe() => tapes.iter().map(lathe::run).collect(),
        _ => machine::run(rs274, tapes),
    }
}

fn case(program: &Program) -> Case {
    let skips = program.statements.contains(&Statement::Skip(true));
    let worlds = if skips { vec![World::Whole, World::Skipping] } else { vec![World::Whole] };
    let worlds = worlds
        .into_iter()
        .map(|world| (world, expect(&program.setup, &program.statements, world)))
        .collect();
    Case { worlds, posted: posting::post(&job(program)) }
}

fn verdict(
    program: &Program,
    case: &Case,
    runs: &mut impl Iterator<Item = Result<Vec<NcStep>, String>>,
) -> Verdict {
    let expected = || case.worlds.iter().map(|(_, expected)| expected);
    let posted = match &case.posted {
        Ok(posted) => posted,
        Err(refused) => {
            let may = expected().any(|one| !one.may_refuse.is_empty() || one.must_refuse.is_some());
            return if may || expected().any(|one| one.unpredictable) {
                Verdict::Refused(refused.code.clone())
            } else {
                differs("refused", refused.message.clone())
            };
        }
    };
    // The runs of this program are taken in any case: those of the next follow.
    let found: Vec<_> = case.worlds.iter().map(|_| runs.next()).collect();
    if expected().any(|one| one.unpredictable) {
        return Verdict::Unpredictable;
    }
    if let Some(reason) = expected().find_map(|one| one.must_refuse) {
        return differs("not refused", reason.to_string());
    }
    if let Err(what) = envelope(&posted.nc) {
        return differs("start and end", what);
    }
    for ((_, expected), found) in case.worlds.iter().zip(found) {
        let Some(found) = found else { return differs("lost", "no run".to_string()) };
        let steps = match found {
            Ok(steps) => steps,
            // LinuxCNC makes no arc of about a micron, and says so.
            Err(said) if said.contains("Zero-radius arc") && has_micron_arc(program) => {
                return Verdict::Refused("rs274".to_string());
            }
            Err(said) => return differs("interpreter", said),
        };
        let tolerance = Tolerance::new(&program.setup, coarsest(program));
        if let Err(difference) = compare(&program.setup, tolerance, &expected.steps, &steps) {
            return Verdict::Differs(difference);
        }
    }
    Verdict::Agrees
}

fn has_micron_arc(program: &Program) -> bool {
    program.statements.iter().any(|statement| match statement {
        Statement::Arc(shape) => shape.radius * program.setup.unit.in_mm() < 0.003,
        _ => false,
    })
}

fn differs(kind: &'static str, what: String) -> Verdict {
    Verdict::Differs(Difference { kind, what, cl_line: None, nc_line: None })
}

/// The unit in which a digit is most: rounding counts in the coarsest.
fn coarsest(program: &Program) -> Unit {
    let inch = program.setup.unit == Unit::Inch
        || program.statements.contains(&Statement::Units(Unit::Inch));
    if inch { Unit::Inch } else { Unit::Mm }
}

/// Tape marks and the end code stand where they must and nowhere else.
fn envelope(nc: &str) -> Result<(), String> {
    let ends = |line: &&str| {
        let block = line.trim_start_matches('/');
        let mut words = without_number(block).split(' ');
        !block.starts_with('(') && words.any(|word| ["M2", "M02", "M30"].contains(&word))
    };
    let last = nc.lines().rfind(|line| !line.trim().is_empty() && line.trim() != "%");
    match nc.lines().filter(|line| ends(line)).collect::<Vec<_>>()[..] {
        [only] if Some(only) == last && !only.starts_with('/') => {}
        [_] => return Err("the end code does not stand at the end".to_string()),
        [] => return Err("no end code".to_string()),
        _ => return Err("more than one end code".to_string()),
    }
    match nc.lines().filter(|line| line.contains('%')).count() {
        0 | 2 => Ok(()),
        count => Err(format!("{count} tape marks")),
    }
}
