//! Two texts as a unified difference, the form of `diff -u`.

use std::fmt::Write;

use imara_diff::{Algorithm, Diff, Hunk, InternedInput, Token};

/// Equal lines that are shown around a change.
const CONTEXT: u32 = 3;

/// The lines that an expected file and this run do not share; empty when they are equal.
pub(super) fn difference(name: &str, expected: &str, found: &str) -> String {
    let input = InternedInput::new(expected, found);
    let mut changes = Diff::compute(Algorithm::Myers, &input);
    changes.postprocess_no_heuristic(&input);
    let hunks: Vec<Hunk> = changes.hunks().collect();
    let mut text = String::new();
    if !hunks.is_empty() {
        text = format!("--- {name}\n+++ this run\n");
    }
    for group in hunks.chunk_by(|one, next| next.before.start - one.before.end <= 2 * CONTEXT) {
        show(&mut text, &input, group);
    }
    text
}

/// Shows changes that lie near each other, with the lines between and around them.
fn show(text: &mut String, input: &InternedInput<&str>, group: &[Hunk]) {
    let (first, last) = (&group[0], &group[group.len() - 1]);
    let above = first.before.start.min(CONTEXT);
    let below = (input.before.len() as u32 - last.before.end).min(CONTEXT);
    let (old, new) = (first.before.start - above, first.after.start - above);
    let (old_end, new_end) = (last.before.end + below, last.after.end + below);
    let sizes = (old_end - old, new_end - new);
    let _ = writeln!(text, "@@ -{},{} +{},{} @@", old + 1, sizes.0, new + 1, sizes.1);
    let mut at = old;
    for hunk in group {
        lines(text, ' ', input, &input.before[at as usize..hunk.before.start as usize]);
        lines(
            text,
            '-',
            input,
            &input.before[hunk.before.start as usize..hunk.before.end as usize],
        );
        lines(text, '+', input, &input.after[hunk.after.start as usize..hunk.after.end as usize]);
        at = hunk.before.end;
    }
    lines(text, ' ', input, &input.before[at as usize..old_end as usize]);
}

fn lines(text: &mut String, mark: char, input: &InternedInput<&str>, tokens: &[Token]) {
    for token in tokens {
        let line = input.interner[*token];
        text.push(mark);
        text.push_str(line);
        if !line.ends_with('\n') {
            text.push_str("\n\\ No newline at end of file\n");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::difference;

    #[test]
    fn changes_near_each_other_share_their_lines() {
        let expected: String = (1..=20).map(|line| format!("{line}\n")).collect();
        let found = expected.replacen("5\n", "five\n", 1).replacen("9\n", "", 1);
        let text = "--- a\n+++ this run\n@@ -2,11 +2,10 @@\n 2\n 3\n 4\n-5\n+five\n 6\n 7\n 8\n-9\n \
                    10\n 11\n 12\n";
        assert_eq!(difference("a", &expected, &found), text);
    }

    #[test]
    fn changes_far_from_each_other_stand_apart() {
        let expected: String = (1..=20).map(|line| format!("{line}\n")).collect();
        let found = expected.replacen("1\n", "one\n", 1).replacen("20\n", "20", 1);
        let text = "--- a\n+++ this run\n@@ -1,4 +1,4 @@\n-1\n+one\n 2\n 3\n 4\n@@ -17,4 +17,4 @@\n 17\n \
                    18\n 19\n-20\n+20\n\\ No newline at end of file\n";
        assert_eq!(difference("a", &expected, &found), text);
    }

    #[test]
    fn equal_texts_give_nothing() {
        assert_eq!(difference("a", "1\n", "1\n"), "");
    }
}
