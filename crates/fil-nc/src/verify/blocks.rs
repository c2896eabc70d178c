//! Lines of a program that stand word for word in the settings or in INSERT.

use std::collections::{BTreeSet, HashMap, HashSet};

use fil_diag::Diag;
use fil_machine::user_blocks::NAMES;

use super::report::{Report, Unverified};
use crate::dialect::{Marks, SKIP};
use crate::source::{Lines, Source, unreadable};
use crate::text::read_block;

/// Texts of INSERT that were looked for to the end of the program without being there;
/// for one more than these only so many lines are read.
const MISSING: usize = 100;
const LINES_AHEAD: u32 = 10_000;

/// The lines that must be there as they are.
pub(super) struct OwnBlocks<'a> {
    source: &'a Source<'a>,
    /// Name of the program in messages.
    name: &'a str,
    /// What begins and ends the blocks of the machine.
    marks: &'a Marks,
    /// Blocks of the settings, bare, and whether the program has them.
    asked: HashMap<Vec<u8>, bool>,
    /// Blocks around tool changes, bare, and the lines of the program that are such.
    around: HashMap<Vec<u8>, Vec<u32>>,
    /// Those of both that hold numbers of tools and work offsets.
    patterns: Vec<Pattern>,
    /// Lines of the program that are such blocks.
    lines: BTreeSet<u32>,
    /// Where the next INSERT is looked for, and the lines before it.
    from: u64,
    passed: u32,
    /// Texts of INSERT that don't come any more.
    missing: HashSet<Vec<u8>>,
    /// Blocks of words that the CL file names, bare, and the lines between which they stand.
    words: Vec<(Vec<u8>, [u32; 2])>,
}

impl<'a> OwnBlocks<'a> {
    /// Looks for the blocks of the settings in a program: those at its start and end, and
    /// those around tool changes.
    ///
    /// # Errors
    /// E0915 when its file can't be read.
    pub(super) fn new(
        (source, name): (&'a Source<'a>, &'a str),
        marks: &'a Marks,
        blocks: &[String],
        around: &[String],
    ) -> Result<Self, Box<Diag>> {
        let bare_block = |block: &String| bare(&marks.read(block.as_bytes()));
        let patterns = blocks.iter().chain(around).map(bare_block).filter_map(Pattern::of);
        let mut own = OwnBlocks {
            source,
            name,
            marks,
            asked: blocks.iter().map(|block| (bare_block(block), false)).collect(),
            around: around.iter().map(|block| (bare_block(block), Vec::new())).collect(),
            patterns: patterns.collect(),
            lines: BTreeSet::new(),
            from: 0,
            passed: 0,
            missing: HashSet::new(),
            words: Vec::new(),
        };
        if !own.asked.is_empty() || !own.around.is_empty() {
            own.find()?;
        }
        Ok(own)
    }

    fn find(&mut self) -> Result<(), Box<Diag>> {
        let firsts = Firsts::of(self.asked.keys().chain(self.around.keys()));
        let mut lines = Lines::from(self.source, 0);
        for number in 1.. {
            let Some(line) = next(&mut lines, self.name)? else { break };
            let line = self.marks.read(line);
            if !firsts.may_be(&line) {
                continue;
            }
            let text = bare(&line);
            if let Some(found) = self.asked.get_mut(&text) {
                *found = true;
                self.lines.insert(number);
            }
            if let Some(found) = self.around.get_mut(&text) {
                found.push(number);
                self.lines.insert(number);
            }
            for pattern in self.patterns.iter().filter(|pattern| pattern.fits(&text)) {
                self.lines.insert(number);
                if let Some(found) = self.asked.get_mut(&pattern.block) {
                    *found = true;
                }
                for block in [&pattern.block, &text] {
                    let lines = self.around.entry(block.clone()).or_default();
                    if lines.last() != Some(&number) {
                        lines.push(number);
                    }
                }
            }
        }
        Ok(())
    }

    /// Blocks around tool changes that the program has less often than its tool changes
    /// ask for, sorted.
    pub(super) fn missing_around(&self, asked: &[String]) -> Vec<String> {
        let mut often: HashMap<Vec<u8>, usize> = HashMap::new();
        for block in asked {
            *often.entry(bare(&self.marks.read(block.as_bytes()))).or_default() += 1;
        }
        let has = |block: &Vec<u8>| self.around.get(block).map_or(0, Vec::len);
        let missing = often.iter().filter(|(block, times)| has(block) < **times);
        sorted(missing.map(|(block, _)| block))
    }

    /// A block around tool changes stands between two lines of the program.
    pub(super) fn stands_between(&self, block: &str, [first, last]: [u32; 2]) -> bool {
        let Some(lines) = self.around.get(&bare(&self.marks.read(block.as_bytes()))) else {
            return false;
        };
        let behind = lines.partition_point(|line| *line <= first);
        lines.get(behind).is_some_and(|line| *line < last)
    }

    /// True when a line is one of those blocks.
    pub(super) fn has(&self, line: u32) -> bool {
        self.lines.contains(&line)
    }

    /// Takes the next line that is this text, in a block that may be skipped or in one that
    /// may not, and gives its number; `None` when there is none. One that stands behind the line
    /// `behind` comes before others: another record may have written the same.
    ///
    /// # Errors
    /// E0915 when the file of the program can't be read.
    pub(super) fn insert(
        &mut self,
        text: &str,
        may_be_skipped: bool,
        behind: u32,
    ) -> Result<Option<u32>, Box<Diag>> {
        let mut text = bare(&self.marks.read(text.as_bytes()));
        if may_be_skipped && text.first() != Some(&SKIP) {
            text.insert(0, SKIP);
        }
        if self.missing.contains(&text) {
            return Ok(None);
        }
        let many = self.missing.len() >= MISSING;
        let last = if many { self.passed.saturating_add(LINES_AHEAD) } else { u32::MAX };
        let firsts = Firsts::of([&text].into_iter());
        let mut lines = Lines::from(self.source, self.from);
        let mut found = None;
        for number in self.passed.saturating_add(1)..=last {
            let Some(line) = next(&mut lines, self.name)? else { break };
            let line = self.marks.read(line);
            if (found.is_none() || number > behind) && firsts.may_be(&line) && bare(&line) == text {
                found = Some((number, lines.at()));
                if number > behind {
                    break;
                }
            }
        }
        if let Some((number, at)) = found {
            (self.from, self.passed) = (at, number);
            self.lines.insert(number);
            return Ok(Some(number));
        }
        if !many {
            self.missing.insert(text);
        }
        Ok(None)
    }

    /// A block of words that the CL file names may stand between two lines, which an interpreter
    /// need not know.
    pub(super) fn may_have(&mut self, words: &str, lines: [u32; 2]) {
        self.words.push((bare(words.as_bytes()), lines));
    }

    /// The block of words that a refused line is.
    fn words_of(&self, refused: &Diag) -> Option<&[u8]> {
        let span = refused.spans.first()?;
        let text = bare(&self.marks.read(span.excerpt.as_bytes()));
        let text = text.strip_prefix(&[SKIP]).unwrap_or(&text);
        let is_it = |(words, [first, last]): &&(Vec<u8>, [u32; 2])| {
            words == text && (*first..=*last).contains(&span.line)
        };
        self.words.iter().find(is_it).map(|(words, _)| words.as_slice())
    }

    /// The auxiliary functions of refused lines that the CL file names: the line and the number of
    /// each.
    pub(super) fn functions_of(&self, refused: &[Diag]) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        for diag in refused {
            let (Some(words), Some(span)) = (self.words_of(diag), diag.spans.first()) else {
                continue;
            };
            let Ok(block) = read_block(words, self.name, span.line) else { continue };
            let functions = block.words.iter().filter(|word| word.letter == b'M');
            let codes = functions.filter_map(|word| u32::try_from(word.number.digits).ok());
            found.extend(codes.map(|code| (span.line, code)));
        }
        found
    }

    /// Lines that the interpreter can't follow are not compared where an author wrote them.
    ///
    /// # Errors
    /// The first that nobody asked for.
    pub(super) fn leave_open(
        &self,
        refused: &[Diag],
        report: &mut Report,
    ) -> Result<(), Box<Diag>> {
        let line = |diag: &Diag| diag.spans.first().map_or(0, |span| span.line);
        let is_own = |diag: &&Diag| self.has(line(diag)) || self.words_of(diag).is_some();
        if let Some(diag) = refused.iter().find(|diag| !is_own(diag)) {
            return Err(Box::new(diag.clone()));
        }
        let mut reasons: Vec<(&Diag, usize)> = Vec::new();
        for diag in refused {
            match reasons.iter_mut().find(|(first, _)| first.message == diag.message) {
                Some((_, more)) => *more += 1,
                None => reasons.push((diag, 0)),
            }
        }
        for (diag, more) in reasons {
            let text = diag.spans.first().map_or("", |span| span.excerpt.trim());
            let more = if more == 0 { String::new() } else { format!(" and {more} more") };
            let what =
                format!("NC line {}{more}, `{text}` of an author: {}", line(diag), diag.message);
            report.leave_open(Unverified { cl_line: None, what });
        }
        Ok(())
    }

    /// Blocks of the settings that the program does not have, sorted.
    pub(super) fn missing(&self) -> Vec<String> {
        sorted(self.asked.iter().filter(|(_, found)| !**found).map(|(block, _)| block))
    }
}

/// A block in which names stand for numbers.
struct Pattern {
    /// The block as it stands in the settings, bare.
    block: Vec<u8>,
    /// What stands before, between and behind its numbers.
    parts: Vec<Vec<u8>>,
}

impl Pattern {
    /// `None` for a block without such names.
    fn of(block: Vec<u8>) -> Option<Self> {
        let mut parts = vec![Vec::new()];
        let mut rest = block.as_slice();
        while let Some(byte) = rest.first() {
            let name = NAMES.iter().find(|name| {
                rest.len() >= name.len() && rest[..name.len()].eq_ignore_ascii_case(name.as_bytes())
            });
            match name {
                Some(name) => {
                    parts.push(Vec::new());
                    rest = &rest[name.len()..];
                }
                None => {
                    parts.last_mut()?.push(*byte);
                    rest = &rest[1..];
                }
            }
        }
        (parts.len() > 1).then_some(Pattern { block, parts })
    }

    /// True for a bare line that is the block with numbers in it.
    fn fits(&self, line: &[u8]) -> bool {
        let Some((first, others)) = self.parts.split_first() else { return false };
        let Some(mut rest) = line.strip_prefix(first.as_slice()) else { return false };
        for part in others {
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            match rest[digits..].strip_prefix(part.as_slice()) {
                Some(behind) if digits > 0 => rest = behind,
                _ => return false,
            }
        }
        rest.is_empty()
    }
}

/// The bytes that blocks begin with; most lines of a program begin with others.
struct Firsts {
    has: [bool; 256],
    /// One of the blocks is empty, or begins with what a number may stand for.
    any: bool,
}

impl Firsts {
    fn of<'b>(blocks: impl Iterator<Item = &'b Vec<u8>>) -> Self {
        let mut firsts = Firsts { has: [false; 256], any: false };
        for block in blocks {
            match block.first() {
                // A number comes first, which no line is told by.
                Some(b'{') => (firsts.has, firsts.any) = ([true; 256], true),
                Some(first) => firsts.has[usize::from(*first)] = true,
                None => firsts.any = true,
            }
        }
        firsts
    }

    /// False for a line that can't be one of the blocks.
    fn may_be(&self, line: &[u8]) -> bool {
        let is_number = |byte: &u8| byte.is_ascii_digit() || byte.is_ascii_whitespace();
        let mut rest = line;
        loop {
            rest = &rest[rest.iter().take_while(|byte| is_number(byte)).count()..];
            match rest {
                [] => return self.any,
                [b'N' | b'n', next, ..] if is_number(next) => rest = &rest[1..],
                [first, ..] => return self.has[usize::from(first.to_ascii_uppercase())],
            }
        }
    }
}

fn next<'l>(lines: &'l mut Lines<'_>, name: &str) -> Result<Option<&'l [u8]>, Box<Diag>> {
    lines.next_line().map_err(|error| Box::new(unreadable(name, &error)))
}

fn sorted<'b>(blocks: impl Iterator<Item = &'b Vec<u8>>) -> Vec<String> {
    let mut sorted: Vec<String> =
        blocks.map(|block| String::from_utf8_lossy(block).into_owned()).collect();
    sorted.sort();
    sorted
}

/// A block without blanks and sequence number, in upper case.
fn bare(line: &[u8]) -> Vec<u8> {
    let mut bare: Vec<u8> =
        line.iter().filter(|byte| !byte.is_ascii_whitespace()).copied().collect();
    bare.make_ascii_uppercase();
    // Lines of Klartext begin with their number.
    let number = bare.iter().take_while(|byte| byte.is_ascii_digit()).count();
    bare.drain(..number);
    // A text may have a number of its own behind that of the post; the mark of a block that
    // may be skipped stands in front of it.
    let mark = usize::from(bare.first() == Some(&SKIP));
    loop {
        let rest = &bare[mark..];
        let digits = rest.iter().skip(1).take_while(|byte| byte.is_ascii_digit()).count();
        if rest.first() != Some(&b'N') || digits == 0 {
            break;
        }
        bare.drain(mark..=mark + digits);
    }
    let number = bare[mark..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    bare.drain(mark..mark + number);
    bare
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own(text: &str, insert: &[&str]) -> Vec<Option<u32>> {
        inserted(text, insert, false)
    }

    fn inserted(text: &str, insert: &[&str], may_be_skipped: bool) -> Vec<Option<u32>> {
        let (source, marks) = (Source::memory(text.as_bytes()), Marks::default());
        let mut own = OwnBlocks::new((&source, "nc"), &marks, &[], &[]).unwrap();
        insert.iter().map(|text| own.insert(text, may_be_skipped, 0).unwrap()).collect()
    }

    #[test]
    fn texts_of_insert_come_in_their_order() {
        let text = "N1 G0 X1.\nN2 M50\n3 m 50\nN4 N7 G4 P1\n/M50\n";
        assert_eq!(
            own(text, &["M50", "M50", "N9 G4 P1", "G0X1."]),
            [Some(2), Some(3), Some(4), None]
        );
        assert_eq!(own(text, &["/ M50", "M50"]), [Some(5), None]);
        assert_eq!(own(text, &["M51", "M50"]), [None, Some(2)]);
    }

    #[test]
    fn a_text_that_another_record_has_written_is_passed_over() {
        let (source, marks) = (Source::memory(b"M1\nX1.\nM1\nX2.\n"), Marks::default());
        let mut own = OwnBlocks::new((&source, "nc"), &marks, &[], &[]).unwrap();
        assert_eq!(own.insert("M1", false, 2).unwrap(), Some(3));
        let mut own = OwnBlocks::new((&source, "nc"), &marks, &[], &[]).unwrap();
        assert_eq!(own.insert("M1", false, 3).unwrap(), Some(1));
    }

    #[test]
    fn a_text_behind_opskip_has_its_mark() {
        let text = "N1 M50\n/N2 M50\n/3 L X+5\n";
        assert_eq!(inserted(text, &["M50", "L X+5", "M50"], true), [Some(2), Some(3), None]);
        assert_eq!(own(text, &["M50", "M50"]), [Some(1), None]);
    }

    #[test]
    fn no_line_that_is_a_block_is_passed_over() {
        for line in ["N5 G0 X1", "n5g0 x1", " 12 G0 X1", "N 5 N6 G0X1", "12N7 G0 X1", "G0 X1"] {
            let text = bare(line.as_bytes());
            let firsts = Firsts::of([&text].into_iter());
            assert!(firsts.may_be(line.as_bytes()), "{line}");
        }
        let firsts = Firsts::of([&bare(b"G0 X1")].into_iter());
        assert!(!firsts.may_be(b"N5 X1.") && firsts.may_be(b"N5 G1"));
        assert!(Firsts::of([&bare(b"N5")].into_iter()).may_be(b"N7"));
    }
}
