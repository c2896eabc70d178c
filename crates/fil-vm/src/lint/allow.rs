//! Comments that switch warnings off: `$$ filpost: allow W0231` at the end of
//! a line or on the line before, `$$ filpost: allow-file W0231` at the top.

use std::collections::HashMap;

use fil_diag::{Diag, Severity};

/// What the comments of a file allow.
#[derive(Default)]
pub(crate) struct Allowed {
    everywhere: Vec<u16>,
    lines: HashMap<u32, Vec<u16>>,
}

impl Allowed {
    /// Reads the comments of a text.
    pub fn read(text: &str) -> Self {
        let mut allowed = Allowed::default();
        let mut waiting: Vec<u16> = Vec::new();
        let mut at_top = true;
        for (number, line) in (1..).zip(text.lines()) {
            let (code, comment) = split(line);
            let is_code = !code.trim().is_empty();
            at_top &= !is_code;
            let (whole_file, mut codes) = comment.and_then(codes).unwrap_or_default();
            if whole_file && at_top {
                allowed.everywhere.append(&mut codes);
            } else if !whole_file {
                waiting.append(&mut codes);
            }
            if is_code && !waiting.is_empty() {
                allowed.lines.insert(number, std::mem::take(&mut waiting));
            }
        }
        allowed
    }

    /// True for a warning that a comment of its file allows; never for an error.
    pub fn allows(&self, diag: &Diag) -> bool {
        let Some(place) = diag.places.first() else { return false };
        let number = diag.code.number;
        diag.code.severity == Severity::Warning
            && (self.everywhere.contains(&number)
                || self.lines.get(&place.line).is_some_and(|codes| codes.contains(&number)))
    }
}

/// A line before and behind the `$$` that opens its comment.
fn split(line: &str) -> (&str, Option<&str>) {
    let mut in_text = false;
    for (at, byte) in line.bytes().enumerate() {
        match byte {
            b'\'' => in_text = !in_text,
            b'$' if !in_text && line[at..].starts_with("$$") => {
                return (&line[..at], Some(&line[at + 2..]));
            }
            _ => {}
        }
    }
    (line, None)
}

/// The codes a comment allows, and whether it is for the whole file.
fn codes(comment: &str) -> Option<(bool, Vec<u16>)> {
    let mut words = comment.split([' ', '\t', ',']).filter(|word| !word.is_empty());
    let is_ours = words.next()?.eq_ignore_ascii_case("filpost:");
    let verb = words.next().filter(|_| is_ours)?;
    let whole_file = verb.eq_ignore_ascii_case("allow-file");
    if !whole_file && !verb.eq_ignore_ascii_case("allow") {
        return None;
    }
    let number = |word: &str| word.strip_prefix(['W', 'w']).and_then(|digits| digits.parse().ok());
    Some((whole_file, words.map_while(number).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::errors::LintCode;
    use fil_diag::Place;

    fn allows(text: &str, line: u32) -> bool {
        let diag = Diag::new(LintCode::UnusedLabel, "").at(Place::line("a.fil", line, ""));
        Allowed::read(text).allows(&diag)
    }

    #[test]
    fn at_the_end_of_the_line_or_before_it() {
        assert!(allows("XX=1\nLA) XX=2 $$ filpost: allow W0234\n", 2));
        assert!(allows("$$ filpost: allow W0220, W0234 because\n\n$$ next\nLA) XX=2\n", 4));
        assert!(!allows("LA) XX=1 $$ filpost: allow W0234\nLB) XX=2\n", 2));
        assert!(!allows("LA) XX=1 $$ filpost: allow W0235\n", 1));
        assert!(!allows("LA) XX='$$ filpost: allow W0234'\n", 1));
    }

    #[test]
    fn for_the_file_only_at_its_top() {
        assert!(allows("$$ a post\n$$ FILPOST: ALLOW-FILE W0234\nXX=1\nLA) XX=2\n", 4));
        assert!(!allows("XX=1\n$$ filpost: allow-file W0234\nLA) XX=2\n", 3));
    }

    #[test]
    fn an_error_cannot_be_allowed() {
        let code: &fil_diag::Code = crate::errors::CompileCode::UnknownLabel.into();
        let diag = Diag::new(code, "").at(Place::line("a.fil", 1, ""));
        assert!(!Allowed::read("JUMPTO/LA $$ filpost: allow W0201\n").allows(&diag));
    }
}
