//! The last words of a run: warnings, each once, and one line of numbers.

use std::collections::{HashMap, HashSet};
use std::time::Duration;

use filpost::cl::SplineCounts;
use filpost::nc::decimals;
use filpost::{Diag, Report};

use crate::{output, render};

/// Different warnings that are shown.
const MOST: usize = 20;

/// Shows warnings on standard error: the first of a code in full, further ones
/// of that code in a line each, the same one only once with a count.
pub fn warnings<'a>(warnings: impl IntoIterator<Item = &'a Diag>) {
    let groups = grouped(warnings);
    let mut codes = HashSet::new();
    for (diag, count) in groups.iter().take(MOST) {
        let times = if *count > 1 { format!("this warning came {count} times") } else { "".into() };
        if codes.insert(diag.code.number) {
            let mut shown = (*diag).clone();
            shown.notes.extend((!times.is_empty()).then_some(times));
            render::to_stderr(&shown);
        } else {
            let times = if times.is_empty() { times } else { format!(" ({times})") };
            output::say(&format!("{diag}{times}"));
        }
    }
    if groups.len() > MOST {
        output::say(&format!("and {} more", counted((groups.len() - MOST) as u64, "warning")));
    }
}

/// Warnings of the same code and words, at their first place, with their number.
fn grouped<'a>(warnings: impl IntoIterator<Item = &'a Diag>) -> Vec<(&'a Diag, usize)> {
    let mut groups: Vec<(&Diag, usize)> = Vec::new();
    let mut known = HashMap::new();
    for diag in warnings {
        let index = *known.entry((diag.code.number, diag.message.as_str())).or_insert(groups.len());
        match groups.get_mut(index) {
            Some((_, count)) => *count += 1,
            None => groups.push((diag, 1)),
        }
    }
    groups
}

/// The line at the end of a run: post, blocks, warnings, extents, dialect, time.
pub fn line(post: &str, report: &Report, warnings: usize, time: Duration) -> String {
    let mut line = format!(
        "{post}: {}, {}",
        counted(report.blocks, "block"),
        counted(warnings as u64, "warning")
    );
    let extents = report.extents.as_ref().filter(|_| !report.words_beside);
    if let Some(extents) = extents {
        line.push_str(", CL points");
        for (axis, name) in ["X", "Y", "Z"].iter().enumerate() {
            let (min, max) = (extents.min[axis], extents.max[axis]);
            let comma = if axis == 0 { "" } else { "," };
            line.push_str(&format!("{comma} {name} {} to {}", length(min), length(max)));
        }
    }
    if let Some((unit, source)) = report.unit {
        let separator = if extents.is_some() { " " } else { ", " };
        line.push_str(&format!("{separator}{unit} ({source})"));
    }
    if report.words_beside {
        line.push_str(", no extents: POSTN or REPEAT wrote axis words");
    }
    if let Some(dialect) = &report.dialect {
        line.push_str(&format!(", dialect {dialect}"));
    }
    if report.splines.splines > 0 {
        line.push_str(&format!(", {}", splines(&report.splines)));
    }
    line.push_str(&format!(", {:.2} s", time.as_secs_f64()));
    line
}

/// How many splines were read, as what, and within which tolerance.
pub fn splines(counts: &SplineCounts) -> String {
    let (splines, lines) =
        (counted(counts.splines.into(), "spline"), counted(counts.lines, "line"));
    format!("{splines} as {lines} within {}", decimals::short(counts.tolerance, 9))
}

/// A number with its noun.
pub fn counted(count: u64, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// A length with at most three decimals and no zeros at its end.
pub fn length(value: f64) -> String {
    decimals::short(value, 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short() {
        let shown: Vec<String> = [1.0, -0.35, 10.0, -0.0001, 0.12345].map(length).to_vec();
        assert_eq!(shown, ["1", "-0.35", "10", "0", "0.123"]);
    }

    #[test]
    fn the_same_warning_is_one_group() {
        let warning = |message: &str| Diag::new(filpost::RunCode::NoFini, message);
        let list = [warning("a"), warning("b"), warning("a")];
        let counts: Vec<usize> = grouped(&list).iter().map(|(_, count)| *count).collect();
        assert_eq!(counts, [2, 1]);
    }
}
