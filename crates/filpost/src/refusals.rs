//! All that is wrong with a CL file, as data: each kind of error once, with its number.

use std::collections::BTreeMap;

use fil_diag::Diag;

/// Most kinds of errors that are kept.
pub const MOST_KINDS: usize = 20;

/// Most lines that are kept of a kind, besides the first.
const MOST_LINES: usize = 10;

/// Most words that are kept as perhaps without effect.
const MOST_WORDS: usize = 1000;

/// All that is wrong with a CL file: the first error of each kind in full, and how often
/// the kind came. Errors that may only follow from one before them are not among them.
///
/// Two errors are of one kind when code and message are the same but for numbers and what
/// stands in apostrophes. Memory does not grow with the number of errors.
///
/// ```
/// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
/// let cl = "UNITS / MM\nQMSNOTE / A\nLOADTL / 1\nQMSNOTE / B\nFEDRAT / 1..5\nFINI\n";
/// let error = program.stream(cl.as_bytes(), std::io::sink()).expect_err("refused");
/// let refusals = error.refusals().expect("the CL file is wrong");
/// let codes: Vec<String> = refusals.diags().iter().map(|diag| diag.code.name()).collect();
/// assert_eq!(codes, ["E0513", "E0405"]);
/// assert_eq!(refusals.count(0), 2);
/// assert_eq!(refusals.further_lines(0), [4]);
/// assert!(refusals.words().eq(["QMSNOTE"]));
/// # Ok::<(), filpost::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Refusals {
    diags: Vec<Diag>,
    again: Vec<Again>,
    unlisted: u64,
    /// Words offered as perhaps without effect; false for one that came with coordinates later.
    words: BTreeMap<String, bool>,
    listed: Vec<String>,
}

/// What is kept of the errors of a kind.
#[derive(Clone, Debug)]
struct Again {
    kind: String,
    count: u64,
    lines: Vec<u32>,
}

impl Refusals {
    /// Nothing is wrong yet.
    #[doc(hidden)]
    pub fn new() -> Self {
        Refusals::default()
    }

    /// Adds an error.
    #[doc(hidden)]
    pub fn add(&mut self, diag: Diag) {
        let kind = kind_of(&diag);
        match self.again.iter_mut().find(|known| known.kind == kind) {
            Some(known) => {
                known.count += 1;
                let line = diag.spans.first().map(|place| place.line);
                known.lines.extend(line.filter(|_| known.lines.len() < MOST_LINES));
            }
            None if self.diags.len() < MOST_KINDS => {
                self.diags.push(diag);
                self.again.push(Again { kind, count: 1, lines: Vec::new() });
            }
            None => self.unlisted += 1,
        }
    }

    /// Notes that a major word may be without effect, or that it can't be.
    pub(crate) fn note_word(&mut self, word: &str, may_be_without_effect: bool) {
        if let Some(offered) = self.words.get_mut(word) {
            *offered &= may_be_without_effect;
        } else if may_be_without_effect && self.words.len() < MOST_WORDS {
            self.words.insert(word.to_string(), true);
        }
    }

    /// Notes the words that the machine lists already.
    pub(crate) fn note_listed(&mut self, words: &[String]) {
        self.listed = words.to_vec();
    }

    /// The first error of each kind, in the order of the file; at most [`MOST_KINDS`].
    pub fn diags(&self) -> &[Diag] {
        &self.diags
    }

    /// How many errors there are of the kind of `diags()[index]`; 0 past the end.
    pub fn count(&self, index: usize) -> u64 {
        self.again.get(index).map_or(0, |again| again.count)
    }

    /// Lines of the errors of that kind after the first, at most ten.
    pub fn further_lines(&self, index: usize) -> &[u32] {
        self.again.get(index).map_or(&[], |again| &again.lines)
    }

    /// Errors of further kinds, of which nothing else is kept.
    pub fn unlisted(&self) -> u64 {
        self.unlisted
    }

    /// All errors.
    pub fn total(&self) -> u64 {
        self.again.iter().map(|again| again.count).sum::<u64>() + self.unlisted
    }

    /// Major words that the post does not know and that may be without effect, in the order
    /// of the alphabet: `words.without_effect` of the machine or of a compat file may list
    /// them, when somebody who knows the CAM system agrees. A word that is like one that
    /// acts, that speaks of moving or placing, or that came with coordinates, is not here.
    /// What else is told holds for a machine that lists these words.
    pub fn words(&self) -> impl Iterator<Item = &str> {
        self.words.iter().filter(|(_, offered)| **offered).map(|(word, _)| word.as_str())
    }

    /// The words that the machine lists already.
    pub fn listed_words(&self) -> &[String] {
        &self.listed
    }

    /// True when there is no error.
    pub fn is_empty(&self) -> bool {
        self.diags.is_empty()
    }
}

/// Code and message, without numbers and signs and without what stands in apostrophes. Digits of a
/// name belong to the name.
fn kind_of(diag: &Diag) -> String {
    let mut kind = diag.code.name();
    let (mut is_quoted, mut in_word, mut in_number) = (false, false, false);
    for character in diag.message.chars() {
        is_quoted ^= character == '\'';
        let is_digit = character.is_ascii_digit();
        in_number = !in_word && (is_digit || in_number && character == '.');
        in_word = character.is_alphabetic() || character == '_' || in_word && is_digit;
        let is_sign = matches!(character, '-' | '+');
        if !is_quoted && !in_number && !is_sign {
            kind.push(character);
        }
    }
    kind
}

#[cfg(test)]
mod tests {
    use fil_diag::TextSpan;

    use super::*;
    use crate::error::RunCode;

    fn refusals(messages: &[&str]) -> Refusals {
        let mut refusals = Refusals::new();
        for (index, message) in messages.iter().enumerate() {
            let place = TextSpan::line("a.ncl", index as u32 + 1, "");
            refusals.add(RunCode::NoFini.diag(*message).at(place));
        }
        refusals
    }

    #[test]
    fn errors_that_differ_in_numbers_and_quotes_are_one_kind() {
        let found = refusals(&[
            "'1.2.3' is not a number",
            "an axis of length 0.5, not 1",
            "'4..' is not a number",
            "an axis of length -12, not 1",
            "a word of length 12, not 1",
            "no handler for WORD1",
            "no handler for WORD2",
        ]);
        assert_eq!(found.diags().len(), 5);
        assert_eq!((found.count(0), found.further_lines(0)), (2, &[3][..]));
        assert_eq!((found.count(1), found.further_lines(1)), (2, &[4][..]));
        assert_eq!((found.total(), found.count(9)), (7, 0));
    }

    #[test]
    fn memory_does_not_grow_with_the_number_of_errors() {
        let names: Vec<String> =
            (0..30u8).map(|at| format!("no handler for {}", char::from(b'A' + at))).collect();
        let mut messages: Vec<&str> = names.iter().map(String::as_str).collect();
        messages.extend([names[0].as_str(); 50]);
        let found = refusals(&messages);
        assert_eq!((found.diags().len(), found.unlisted(), found.total()), (20, 10, 80));
        assert_eq!((found.count(0), found.further_lines(0).len()), (51, MOST_LINES));
    }

    #[test]
    fn a_word_that_came_with_coordinates_is_not_offered_again() {
        let mut found = Refusals::new();
        for (word, may) in [("AWORD", true), ("BWORD", true), ("AWORD", false), ("AWORD", true)] {
            found.note_word(word, may);
        }
        assert!(found.words().eq(["BWORD"]));
    }
}
