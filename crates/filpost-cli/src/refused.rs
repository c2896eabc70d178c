//! What is wrong with a CL file, for people.

use std::collections::{BTreeSet, HashSet};
use std::fmt::Write;

use filpost::{Error, Refusals};

use crate::{output, render, summary};

/// Shows an error on standard error. Of a refused CL file each kind of error comes once:
/// the first of a code in full, further ones of that code in a line each; then the words
/// that may be listed as without effect.
pub fn tell(error: &Error) {
    let Some(refusals) = error.refusals() else {
        error.diags().iter().for_each(render::to_stderr);
        return;
    };
    let mut codes = HashSet::new();
    for (index, diag) in refusals.diags().iter().enumerate() {
        let again = further(refusals, index);
        if codes.insert(diag.code.number) {
            let mut shown = diag.clone();
            shown.notes.extend(again);
            render::to_stderr(&shown);
            continue;
        }
        let mut line = render::clean(&diag.to_string());
        for more in diag.hint.iter().chain(&again) {
            let _ = write!(line, "; {}", render::clean(more));
        }
        output::say(&line);
    }
    if refusals.unlisted() > 0 {
        output::say(&format!("and {} of other kinds", errors(refusals.unlisted())));
    }
    if let Some(answer) = answer(refusals) {
        output::say(&format!("\n{answer}"));
    }
    if refusals.total() > 1 {
        output::say(&format!("\n{}, no program", errors(refusals.total())));
    }
}

/// `and 37 more of this kind, lines 12, 15, …`
fn further(refusals: &Refusals, index: usize) -> Option<String> {
    let more = refusals.count(index).checked_sub(1).filter(|more| *more > 0)?;
    let lines = refusals.further_lines(index);
    let mut text = format!("and {more} more of this kind");
    if !lines.is_empty() {
        let shown: Vec<String> = lines.iter().map(u32::to_string).collect();
        let noun = if more == 1 { "line" } else { "lines" };
        let _ = write!(text, ", {noun} {}", shown.join(", "));
        if more > lines.len() as u64 {
            text.push_str(", …");
        }
    }
    Some(text)
}

/// The lines that list the words which may be without effect, with those that are listed
/// already; `None` without such words.
fn answer(refusals: &Refusals) -> Option<String> {
    refusals.words().next()?;
    let listed = refusals.listed_words();
    let old = listed.iter().map(String::as_str);
    let all: BTreeSet<&str> = refusals.words().chain(old).collect();
    let place = if listed.is_empty() {
        "put these lines at the end of machine.toml, or into a file for --compat"
    } else {
        "put these lines in the place of the words that machine.toml or the file of --compat lists"
    };
    let words: Vec<String> = all.iter().map(|word| format!("{word:?}")).collect();
    Some(format!(
        "If these words only inform and move nothing, {place}:\n\n{}",
        lines(&words.join(", "))
    ))
}

/// A list of TOML, broken where it gets long.
fn lines(words: &str) -> String {
    const WIDTH: usize = 90;
    let mut text = String::from("[words]\nwithout_effect = [");
    if words.len() < WIDTH {
        return text + words + "]";
    }
    for line in broken(words, WIDTH) {
        let _ = write!(text, "\n    {line}");
    }
    text + "\n]"
}

/// Cuts a list behind its commas.
fn broken(words: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words.split_inclusive(", ") {
        let last = lines.last_mut().expect("one line at least");
        if last.len() + word.len() > width {
            *last = last.trim_end().to_string();
            lines.push(word.to_string());
        } else {
            last.push_str(word);
        }
    }
    lines
}

fn errors(count: u64) -> String {
    summary::counted(count, "error")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_list_is_still_toml() {
        let words: Vec<String> = (0..40).map(|at| format!("\"SITEWORD{at}\"")).collect();
        let text = lines(&words.join(", "));
        assert!(text.lines().count() > 5 && text.lines().all(|line| line.len() < 100), "{text}");
        let found = filpost::read_compat("c", &text).expect("TOML");
        assert_eq!(found.without_effect.len(), 40);
    }
}
