//! The last words of a run: warnings, each once, and one line of numbers.

use std::collections::{HashMap, HashSet};
use std::time::Duration;

use filpost::cl::SplineCounts;
use filpost::nc::decimals;
use filpost::{Diag, Report};

use crate::{output, render};

/// Different warnings that are shown.
const MOST: usize = 20;

/// Shows warnings on standard error: the first of a code in full, further ones of that code in
/// a line each. Those that differ by their numbers alone are of one kind, and come once.
pub fn warnings<'a>(warnings: impl IntoIterator<Item = &'a Diag>) {
    let kinds = kinds(warnings);
    let mut codes = HashSet::new();
    for kind in kinds.iter().take(MOST) {
        let more = kind.more();
        if codes.insert(kind.shown.code.number) {
            let mut shown = kind.shown.clone();
            shown.notes.extend(more);
            render::to_stderr(&shown);
        } else {
            let more = more.map(|more| format!(" ({more})")).unwrap_or_default();
            output::say(&format!("{}{more}", kind.shown));
        }
    }
    if kinds.len() > MOST {
        output::say(&format!("and {} more", counted((kinds.len() - MOST) as u64, "warning")));
    }
}

/// Warnings of one code whose words are the same but for numbers.
struct Kind<'a> {
    /// The first one, or that with the largest measure.
    shown: &'a Diag,
    /// The others.
    others: Vec<&'a Diag>,
}

impl Kind<'_> {
    /// What is said of the others.
    fn more(&self) -> Option<String> {
        /// Lines that are listed.
        const LISTED: usize = 8;
        let count = self.others.len();
        if count == 0 {
            return None;
        }
        if self.others.iter().all(|other| other.message == self.shown.message) {
            return Some(format!("this warning came {} times", count + 1));
        }
        let mut lines: Vec<u32> = self.others.iter().filter_map(|other| line_of(other)).collect();
        lines.sort_unstable();
        lines.dedup();
        let mut text = format!("and {count} more of this kind");
        if !lines.is_empty() {
            let shown: Vec<String> = lines.iter().take(LISTED).map(u32::to_string).collect();
            let noun = if lines.len() == 1 { "line" } else { "lines" };
            text += &format!(", {noun} {}", shown.join(", "));
        }
        if lines.len() > LISTED {
            text.push_str(", …");
        }
        Some(text)
    }
}

fn line_of(diag: &Diag) -> Option<u32> {
    diag.spans.first().map(|span| span.line).filter(|line| *line > 0)
}

/// The kinds of warnings, in the order in which they come first.
fn kinds<'a>(warnings: impl IntoIterator<Item = &'a Diag>) -> Vec<Kind<'a>> {
    let mut kinds: Vec<Kind<'_>> = Vec::new();
    let mut known = HashMap::new();
    for diag in warnings {
        let key = (diag.code.number, without_numbers(&diag.message));
        let index = *known.entry(key).or_insert(kinds.len());
        let Some(kind) = kinds.get_mut(index) else {
            kinds.push(Kind { shown: diag, others: Vec::new() });
            continue;
        };
        let is_larger = measure(&diag.message) > measure(&kind.shown.message);
        let other = if is_larger { std::mem::replace(&mut kind.shown, diag) } else { diag };
        kind.others.push(other);
    }
    kinds
}

fn without_numbers(message: &str) -> String {
    message.chars().filter(|letter| !letter.is_ascii_digit()).collect()
}

/// The first number with decimals: what is whole counts or names something.
fn measure(message: &str) -> Option<f64> {
    let is_of_number = |letter: char| letter.is_ascii_digit() || letter == '.';
    let numbers = message.split(|letter| !is_of_number(letter));
    numbers.filter(|text| text.trim_matches('.').contains('.')).find_map(|text| text.parse().ok())
}

/// The line at the end of a run: post, blocks, warnings, extents, dialect, time.
pub fn line(post: &str, report: &Report, warnings: usize, time: Duration) -> String {
    let mut line = format!(
        "{post}: {}, {}",
        counted(report.blocks, "block"),
        counted(warnings as u64, "warning")
    );
    let extents = report.extents.as_ref().filter(|_| !report.may_leave_extents);
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
    if report.may_leave_extents {
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
    fn warnings_that_differ_by_numbers_are_one_kind() {
        let warning = |line: u32, message: &str| {
            let place = filpost::TextSpan::line("part.ncl", line, "");
            Diag::new(filpost::RunCode::NoFini, message).at(place)
        };
        let list = [
            warning(3, "the tip is 1.250 below its line"),
            warning(4, "tool 2: no speed"),
            warning(9, "the tip is 36.647 below its line"),
            warning(12, "tool 4: no speed"),
            warning(30, "the tip is 4.000 below its line"),
        ];
        let kinds = kinds(&list);
        let shown: Vec<&str> = kinds.iter().map(|kind| &kind.shown.message[..]).collect();
        assert_eq!(shown, ["the tip is 36.647 below its line", "tool 2: no speed"]);
        assert_eq!(kinds[0].more().unwrap(), "and 2 more of this kind, lines 3, 30");
        assert_eq!(kinds[1].more().unwrap(), "and 1 more of this kind, line 12");
    }

    #[test]
    fn the_same_warning_is_counted() {
        let warning = |message: &str| Diag::new(filpost::RunCode::NoFini, message);
        let list = [warning("a"), warning("b"), warning("a")];
        let kinds = kinds(&list);
        assert_eq!(kinds.len(), 2);
        assert_eq!(kinds[0].more().unwrap(), "this warning came 2 times");
        assert_eq!(kinds[1].more(), None);
    }
}
