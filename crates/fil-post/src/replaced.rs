//! Texts of the tape that are written otherwise (REPLAC).

/// A text and what takes its place.
#[derive(Clone, Debug)]
struct Pair {
    old: String,
    new: String,
    /// It stood in a line.
    found: bool,
}

impl Pair {
    /// The text stands at the start of `rest`, behind the character `before`: as a word of
    /// its own, so that M6 is not found in M60 and 5 not in 15 or 5.5.
    fn begins(&self, rest: &str, before: Option<char>) -> bool {
        let Some(behind) = rest.strip_prefix(self.old.as_str()) else { return false };
        let joined = |one: Option<char>, other: Option<char>| match (one, other) {
            (Some(one), Some(other)) => {
                let of_number = |c: char| c.is_ascii_digit() || c == '.';
                (one.is_alphabetic() && other.is_alphabetic()) || of_number(one) && of_number(other)
            }
            _ => false,
        };
        !joined(before, self.old.chars().next())
            && !joined(self.old.chars().next_back(), behind.chars().next())
    }
}

/// The texts that are replaced in each line.
#[derive(Clone, Debug, Default)]
pub struct Replaced(Vec<Pair>);

impl Replaced {
    /// True while lines are written as they are.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Replaces a text from the next line on, and no longer as it did before.
    pub fn add(&mut self, old: &str, new: &str) {
        let pair = Pair { old: old.to_string(), new: new.to_string(), found: false };
        match self.0.iter_mut().find(|known| known.old == old) {
            Some(known) => *known = Pair { found: known.found, ..pair },
            None => self.0.push(pair),
        }
    }

    /// The texts that stood in no line.
    pub fn unfound(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter(|pair| !pair.found).map(|pair| pair.old.as_str())
    }

    /// A line with all texts replaced. What takes the place of one is not looked at again,
    /// and of texts that begin alike the longest one counts.
    pub fn apply(&mut self, line: &str) -> String {
        let mut written = String::with_capacity(line.len());
        let (mut rest, mut before) = (line, None);
        while let Some(first) = rest.chars().next() {
            let fits = self.0.iter_mut().filter(|pair| pair.begins(rest, before));
            let length = match fits.max_by_key(|pair| pair.old.len()) {
                Some(pair) => {
                    pair.found = true;
                    written.push_str(&pair.new);
                    pair.old.len()
                }
                None => {
                    written.push(first);
                    first.len_utf8()
                }
            };
            before = rest[..length].chars().next_back();
            rest = &rest[length..];
        }
        written
    }
}

#[cfg(test)]
mod tests {
    use super::Replaced;

    fn written(pairs: &[(&str, &str)], line: &str) -> String {
        let mut replaced = Replaced::default();
        pairs.iter().for_each(|(old, new)| replaced.add(old, new));
        replaced.apply(line)
    }

    #[test]
    fn words_are_found_whole() {
        assert_eq!(written(&[("M6", "M06")], "N10 T1 M6"), "N10 T1 M06");
        assert_eq!(written(&[("M6", "M06")], "M60 M6.1 (TEAM6)"), "M60 M6.1 (TEAM6)");
        assert_eq!(written(&[("M6", "M06")], "N10T1M6"), "N10T1M06");
        assert_eq!(written(&[("5", "6")], "X5.5 X15 X5"), "X5.5 X15 X6");
        assert_eq!(written(&[("G43", "G43.4")], "G43 G43.1"), "G43.4 G43.1");
        assert_eq!(written(&[("Z", "W")], "X1. Z-2."), "X1. W-2.");
    }

    #[test]
    fn texts_are_replaced_once() {
        let pairs = [("G54", "G55"), ("G55", "G56"), ("G54 G", "!")];
        assert_eq!(written(&pairs, "G54 X1. G55"), "G55 X1. G56");
        assert_eq!(written(&pairs, "G54 G1"), "!1");
        assert_eq!(written(&[("A", "B"), ("A", "C")], "A"), "C");
        assert_eq!(written(&[("é", "e")], "(éé)"), "(éé)");
    }
}
