//! Lines of a program that stand word for word in the settings or in INSERT.

use std::collections::{HashMap, HashSet};

/// The lines that must be there as they are.
pub(super) struct OwnBlocks<'a> {
    /// Blocks of the settings, bare, and whether the program has them.
    wanted: HashMap<String, bool>,
    /// Blocks around tool changes, bare, and how often the program has them.
    around: HashMap<String, usize>,
    /// Lines of the program that are such blocks.
    lines: HashSet<u32>,
    /// The text in which the next INSERT is looked for, and the lines before it.
    rest: &'a [u8],
    passed: u32,
}

impl<'a> OwnBlocks<'a> {
    /// Looks for the blocks of the settings in a program: those at its start and end, and
    /// those around tool changes.
    pub(super) fn new(text: &'a [u8], blocks: &[String], around: &[String]) -> Self {
        let mut wanted: HashMap<String, bool> =
            blocks.iter().map(|block| (bare(block.as_bytes()), false)).collect();
        let mut lines = HashSet::new();
        let mut around: HashMap<String, usize> =
            around.iter().map(|block| (bare(block.as_bytes()), 0)).collect();
        if !wanted.is_empty() || !around.is_empty() {
            for (line, text) in numbered(text) {
                let text = bare(text);
                if let Some(found) = wanted.get_mut(&text) {
                    *found = true;
                    lines.insert(line);
                }
                if let Some(found) = around.get_mut(&text) {
                    *found += 1;
                    lines.insert(line);
                }
            }
        }
        OwnBlocks { wanted, around, lines, rest: text, passed: 0 }
    }

    /// Blocks around tool changes that the program has less often than its tool changes
    /// ask for, sorted.
    pub(super) fn missing_around(&self, asked: &[String]) -> Vec<String> {
        let mut often: HashMap<String, usize> = HashMap::new();
        for block in asked {
            *often.entry(bare(block.as_bytes())).or_default() += 1;
        }
        let has = |block: &String| self.around.get(block).copied().unwrap_or(0);
        let missing = often.into_iter().filter(|(block, times)| has(block) < *times);
        let mut missing: Vec<String> = missing.map(|(block, _)| block).collect();
        missing.sort();
        missing
    }

    /// True when a line is one of those blocks.
    pub(super) fn has(&self, line: u32) -> bool {
        self.lines.contains(&line)
    }

    /// Takes the next line that is this text; false when there is none.
    pub(super) fn insert(&mut self, wanted: &str) -> bool {
        let wanted = bare(wanted.as_bytes());
        let Some((line, _)) = numbered(self.rest).find(|(_, text)| bare(text) == wanted) else {
            return false;
        };
        let ends = self.rest.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
        let start = ends.map(|(at, _)| at + 1).nth(line as usize - 1).unwrap_or(self.rest.len());
        self.rest = &self.rest[start..];
        self.passed += line;
        self.lines.insert(self.passed);
        true
    }

    /// Blocks of the settings that the program does not have, sorted.
    pub(super) fn missing(&self) -> Vec<String> {
        let missing = self.wanted.iter().filter(|(_, found)| !**found);
        let mut missing: Vec<String> = missing.map(|(block, _)| block.clone()).collect();
        missing.sort();
        missing
    }
}

fn numbered(text: &[u8]) -> impl Iterator<Item = (u32, &[u8])> {
    (1..).zip(text.split(|byte| *byte == b'\n'))
}

/// A block without blanks and sequence number, in upper case.
fn bare(line: &[u8]) -> String {
    let mut bare: Vec<u8> =
        line.iter().filter(|byte| !byte.is_ascii_whitespace()).copied().collect();
    bare.make_ascii_uppercase();
    // Lines of Klartext begin with their number.
    let number = bare.iter().take_while(|byte| byte.is_ascii_digit()).count();
    bare.drain(..number);
    // A text may have a number of its own behind that of the post.
    loop {
        let digits = bare.iter().skip(1).take_while(|byte| byte.is_ascii_digit()).count();
        if bare.first() != Some(&b'N') || digits == 0 {
            break;
        }
        bare.drain(..=digits);
    }
    String::from_utf8_lossy(&bare).into_owned()
}
