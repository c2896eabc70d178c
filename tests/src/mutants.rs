//! Small faults put into NC programs: a changed digit, a lost sign, a dropped word,
//! a turned arc, a missing block, a word too many.

use fil_nc::text::{Block, read_block};

/// A program with one fault.
pub struct Mutant {
    /// Line of the fault, from 1.
    pub line: usize,
    /// What was done to it.
    pub fault: String,
    /// The program.
    pub text: String,
}

/// All mutants of a program; lines keep their numbers.
pub fn all(nc: &str) -> Vec<Mutant> {
    let lines: Vec<&str> = nc.split('\n').collect();
    let mut mutants = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        for (fault, changed) in of_line(line) {
            let mut lines = lines.clone();
            lines[index] = &changed;
            mutants.push(Mutant { line: index + 1, fault, text: lines.join("\n") });
        }
    }
    mutants
}

/// What can be wrong with a line, and the line with it.
fn of_line(line: &str) -> Vec<(String, String)> {
    let Ok(block) = read_block(line.as_bytes(), "nc", 1) else { return Vec::new() };
    if block.words.is_empty() {
        return Vec::new();
    }
    let mut faults = vec![(format!("without `{line}`"), String::new())];
    for word in ["M0", "M7", "M50", "S77"].into_iter().filter(|word| fits(&block, word)) {
        faults.push((format!("`{line}` with {word}"), format!("{line} {word}")));
    }
    for word in &block.words {
        let (range, text) = (word.range.clone(), &line[word.range.clone()]);
        let with = |new: &str| format!("{}{new}{}", &line[..range.start], &line[range.end..]);
        faults.push((format!("`{line}` without {text}"), with("")));
        if text.contains('-') {
            let unsigned = text.replace('-', "");
            faults.push((format!("{text} is {unsigned} in `{line}`"), with(&unsigned)));
        }
        if let Some(turned) = turned(text) {
            faults.push((format!("{text} is {turned} in `{line}`"), with(&turned)));
        }
        for (at, digit) in text.char_indices().filter(|(_, c)| c.is_ascii_digit()) {
            for step in [1, 9] {
                let other = (digit as u8 - b'0' + step) % 10 + b'0';
                let mut changed = text.to_string();
                changed.replace_range(at..=at, &char::from(other).to_string());
                faults.push((format!("{text} is {changed} in `{line}`"), with(&changed)));
            }
        }
    }
    faults
}

/// A word may be added to a block that has none like it.
fn fits(block: &Block, word: &str) -> bool {
    let letter = word.as_bytes()[0];
    block.comments.is_empty() && block.words.iter().all(|other| other.letter != letter)
}

/// G2 for G3 and the reverse.
fn turned(word: &str) -> Option<String> {
    match word {
        "G2" | "G02" => Some(word.replace('2', "3")),
        "G3" | "G03" => Some(word.replace('3', "2")),
        _ => None,
    }
}
