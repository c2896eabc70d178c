//! Two texts beside each other, line by line.

use imara_diff::{Algorithm, Diff, InternedInput};

/// Equal lines that are shown around a change.
const CONTEXT: u32 = 3;

/// A line by its number, from 1, with its text.
pub type Numbered<'t> = (u32, &'t str);

/// A row of two texts beside each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row<'t> {
    /// A line that both have.
    Same(Numbered<'t>, Numbered<'t>),
    /// Lines that differ; a side without one has `None`.
    Changed(Option<Numbered<'t>>, Option<Numbered<'t>>),
    /// Equal lines that are left out.
    Gap(u32),
}

/// The rows of two texts, the lines that are equal only around those that are not; no rows for
/// equal texts.
pub fn side_by_side<'t>(expected: &'t str, found: &'t str) -> Vec<Row<'t>> {
    let input = InternedInput::new(expected, found);
    let mut changes = Diff::compute(Algorithm::Myers, &input);
    changes.postprocess_no_heuristic(&input);
    let old = |at: u32| (at + 1, plain(input.interner[input.before[at as usize]]));
    let new = |at: u32| (at + 1, plain(input.interner[input.after[at as usize]]));
    let mut rows = Vec::new();
    // Lines of each text that have their row.
    let (mut left, mut right) = (0, 0);
    for hunk in changes.hunks() {
        let later = !rows.is_empty();
        equal(&mut rows, hunk.before.start - left, later, true, |at| {
            Row::Same(old(left + at), new(right + at))
        });
        let [gone, come] = [hunk.before.len(), hunk.after.len()].map(|count| count as u32);
        rows.extend((0..gone.max(come)).map(|at| {
            let left = (at < gone).then(|| old(hunk.before.start + at));
            Row::Changed(left, (at < come).then(|| new(hunk.after.start + at)))
        }));
        (left, right) = (hunk.before.end, hunk.after.end);
    }
    if !rows.is_empty() {
        let rest = input.before.len() as u32 - left;
        equal(&mut rows, rest, true, false, |at| Row::Same(old(left + at), new(right + at)));
    }
    rows
}

/// Adds lines that are equal: all of a few, else those beside the changes before and after them.
fn equal<'t>(
    rows: &mut Vec<Row<'t>>,
    count: u32,
    after_change: bool,
    before_change: bool,
    row: impl Fn(u32) -> Row<'t>,
) {
    let head = if after_change { CONTEXT } else { 0 };
    let tail = if before_change { CONTEXT } else { 0 };
    if count <= head + tail + 1 {
        rows.extend((0..count).map(row));
        return;
    }
    rows.extend((0..head).map(&row));
    rows.push(Row::Gap(count - head - tail));
    rows.extend((count - tail..count).map(row));
}

/// A line without its end.
fn plain(line: &str) -> &str {
    line.trim_end_matches(['\n', '\r'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_lines_stand_beside_each_other_with_their_numbers() {
        let expected: String = (1..=30).map(|line| format!("{line}\n")).collect();
        let found = expected.replacen("15\n", "fifteen\nand more\n", 1).replacen("29\n", "", 1);
        let rows = side_by_side(&expected, &found);
        assert_eq!(rows[0], Row::Gap(11));
        assert_eq!(rows[1], Row::Same((12, "12"), (12, "12")));
        assert_eq!(rows[4], Row::Changed(Some((15, "15")), Some((15, "fifteen"))));
        assert_eq!(rows[5], Row::Changed(None, Some((16, "and more"))));
        assert_eq!(rows[6], Row::Same((16, "16"), (17, "16")));
        assert_eq!(rows[9], Row::Gap(7));
        assert_eq!(rows[13], Row::Changed(Some((29, "29")), None));
        assert_eq!(rows[14], Row::Same((30, "30"), (30, "30")));
        assert_eq!(rows.len(), 15);
    }

    #[test]
    fn a_text_that_is_not_there_yet_has_an_empty_side() {
        let rows = side_by_side("", "M30\n");
        assert_eq!(rows, [Row::Changed(None, Some((1, "M30")))]);
        assert_eq!(side_by_side("M30\n", "M30\n"), []);
    }
}
