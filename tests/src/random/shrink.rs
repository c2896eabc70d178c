//! Making a program that fails as small as possible.

use std::path::Path;

use super::make::Program;
use super::statement::Statement;
use super::verdict::{Verdict, judge};

/// The smallest program found that fails in the same way.
pub fn shrink(rs274: &Path, program: &Program) -> Program {
    let mut small = program.clone();
    let Some(kind) = failure(rs274, &small) else { return small };
    loop {
        let before = small.clone();
        let mut size = small.statements.len().next_power_of_two();
        while size > 0 {
            drop_runs(rs274, &mut small, size, &kind);
            size /= 2;
        }
        drop_settings(rs274, &mut small, &kind);
        round(rs274, &mut small, &kind);
        if small == before {
            return small;
        }
    }
}

fn failure(rs274: &Path, program: &Program) -> Option<String> {
    match judge(rs274, std::slice::from_ref(program)).pop() {
        Some(Verdict::Differs(difference)) => Some(difference.class()),
        _ => None,
    }
}

/// Takes a smaller program when it fails in the same way.
fn try_smaller(rs274: &Path, small: &mut Program, candidate: Program, kind: &str) -> bool {
    let same = candidate != *small && failure(rs274, &candidate).as_deref() == Some(kind);
    if same {
        *small = candidate;
    }
    same
}

fn drop_runs(rs274: &Path, small: &mut Program, size: usize, kind: &str) {
    let mut at = 0;
    while at < small.statements.len() {
        let mut candidate = small.clone();
        candidate.statements.drain(at..(at + size).min(small.statements.len()));
        if !try_smaller(rs274, small, candidate, kind) {
            at += size;
        }
    }
}

fn drop_settings(rs274: &Path, small: &mut Program, kind: &str) {
    // A setting that the comparison knows of can't be dropped by its text alone.
    const FREE: [&str; 9] = [
        "circle.max_degrees",
        "circle.full_circle",
        "circle.modal",
        "circle.axes_modal",
        "rapid.modal",
        "linear.modal",
        "motion.modal",
        "tape.blank",
        "seqno.off",
    ];
    let mut at = 0;
    while at < small.setup.settings.len() {
        let mut candidate = small.clone();
        let setting = candidate.setup.settings.remove(at);
        let free = FREE.iter().any(|key| setting.starts_with(key));
        if !free || !try_smaller(rs274, small, candidate, kind) {
            at += 1;
        }
    }
    let mut candidate = small.clone();
    candidate.setup.hostile = false;
    try_smaller(rs274, small, candidate, kind);
}

/// Tries whole and short numbers.
fn round(rs274: &Path, small: &mut Program, kind: &str) {
    for at in 0..small.statements.len() {
        for digits in [0, 1, 3, 5] {
            let mut candidate = small.clone();
            candidate.statements[at] = rounded(&candidate.statements[at], digits);
            if try_smaller(rs274, small, candidate, kind) {
                break;
            }
        }
    }
}

fn rounded(statement: &Statement, digits: i32) -> Statement {
    let factor = 10f64.powi(digits);
    let short = |value: f64| (value * factor).round() / factor;
    match statement.clone() {
        Statement::Rapid(to) => Statement::Rapid(to.map(short)),
        Statement::Feed(to) => Statement::Feed(to.map(short)),
        Statement::Hole(at) => Statement::Hole(at.map(short)),
        Statement::Delta { by, rapid } => Statement::Delta { by: by.map(short), rapid },
        Statement::Arc(mut shape) => {
            shape.radius = short(shape.radius).max(1.0 / factor);
            shape.start = short(shape.start);
            shape.sweep = short(shape.sweep).max(1.0 / factor);
            shape.rise = short(shape.rise);
            Statement::Arc(shape)
        }
        Statement::Feedrate(mut feed) => {
            feed.value = short(feed.value).max(1.0 / factor);
            Statement::Feedrate(feed)
        }
        Statement::Cycle(mut shape) => {
            shape.depth = short(shape.depth).max(1.0 / factor);
            shape.clear = short(shape.clear);
            shape.step = shape.step.map(|step| short(step).max(1.0 / factor));
            shape.retract = shape.retract.map(short);
            Statement::Cycle(shape)
        }
        other => other,
    }
}
