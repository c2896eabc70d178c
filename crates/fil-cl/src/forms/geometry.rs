//! The geometry that TLON and PSIS name: `(CIRCLE/x,y,z,r),ON,(LINE/…)` and its like.

use super::vector::{Vector, cross, sub, unit};
use crate::reader::{leading_number, plain_number};
use crate::record::Word;
use crate::vocabulary::Vocabulary;

/// Shapes within shapes, no deeper than CAM systems write them.
const DEEPEST: usize = 8;

/// Room for the parts of a list: a line has six numbers, a cylinder seven.
const USUAL_PARTS: usize = 8;

/// A part of a list. Words are as written, in any case.
#[derive(Debug, PartialEq)]
pub(crate) enum Part<'t> {
    /// A number.
    Number(f64),
    /// A word.
    Word(&'t [u8]),
    /// A shape in parentheses: its name and its parts.
    Shape(&'t [u8], Vec<Part<'t>>),
}

impl Part<'_> {
    fn is_word(&self, name: &str) -> bool {
        matches!(self, Part::Word(word) if is(word, name))
    }
}

fn is(word: &[u8], name: &str) -> bool {
    word.eq_ignore_ascii_case(name.as_bytes())
}

/// What can't be read: where in the text, and what is wrong.
pub(crate) type Wrong = (usize, String);

/// Reads a list of numbers, words and shapes.
pub(crate) fn parse(text: &[u8]) -> Result<Vec<Part<'_>>, Wrong> {
    let mut parser = Parser { text, at: 0 };
    let parts = parser.list(0)?;
    if parser.at < text.len() {
        return parser.wrong("a parenthesis too many");
    }
    Ok(parts)
}

struct Parser<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Parser<'a> {
    fn wrong<T>(&self, message: &str) -> Result<T, Wrong> {
        Err((self.at.min(self.text.len().saturating_sub(1)), message.to_string()))
    }

    fn skip_blanks(&mut self) {
        while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    /// Parts up to a closing parenthesis or the end.
    fn list(&mut self, depth: usize) -> Result<Vec<Part<'a>>, Wrong> {
        if depth > DEEPEST {
            return self.wrong("too many shapes within shapes");
        }
        let mut parts = Vec::with_capacity(USUAL_PARTS);
        loop {
            self.skip_blanks();
            parts.push(self.part(depth)?);
            self.skip_blanks();
            match self.text.get(self.at) {
                Some(b',') => self.at += 1,
                None | Some(b')') => return Ok(parts),
                Some(_) => return self.wrong("a comma is missing"),
            }
        }
    }

    fn part(&mut self, depth: usize) -> Result<Part<'a>, Wrong> {
        if let Some((value, behind)) = leading_number(&self.text[self.at..])
            && matches!(behind, [] | [b',' | b')' | b' ', ..])
        {
            self.at = self.text.len() - behind.len();
            return Ok(Part::Number(value));
        }
        if self.text.get(self.at) != Some(&b'(') {
            let start = self.at;
            let item = self.item();
            if let Some(number) = plain_number(item) {
                return Ok(Part::Number(number));
            }
            if is_word(item) {
                return Ok(Part::Word(item));
            }
            self.at = start;
            return self.wrong("neither a number nor a word");
        }
        self.at += 1;
        self.skip_blanks();
        let name = self.item();
        if !is_word(name) {
            return self.wrong("a shape without a name");
        }
        self.skip_blanks();
        if self.text.get(self.at) != Some(&b'/') {
            return self.wrong("a slash is missing after the name of the shape");
        }
        self.at += 1;
        let parts = self.list(depth + 1)?;
        if self.text.get(self.at) != Some(&b')') {
            return self.wrong("a parenthesis is missing");
        }
        self.at += 1;
        Ok(Part::Shape(name, parts))
    }

    /// The bytes up to what ends an item.
    fn item(&mut self) -> &'a [u8] {
        let text: &'a [u8] = self.text;
        let rest = &text[self.at..];
        let ends = |byte: &u8| matches!(byte, b',' | b'(' | b')' | b' ' | b'\t' | b'/');
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }
}

fn is_word(item: &[u8]) -> bool {
    item.first().is_some_and(u8::is_ascii_alphabetic) && item.iter().all(u8::is_ascii_alphanumeric)
}

/// The numbers that a list consists of, when they are so many.
pub(crate) fn numbers<const N: usize>(parts: &[Part<'_>]) -> Option<[f64; N]> {
    let mut found = [0.0; N];
    if parts.len() != N {
        return None;
    }
    for (slot, part) in found.iter_mut().zip(parts) {
        let Part::Number(value) = part else { return None };
        *slot = *value;
    }
    Some(found)
}

/// The point or vector that a shape of this name is.
fn three(part: &Part<'_>, expected: &str) -> Option<Vector> {
    match part {
        Part::Shape(name, parts) if is(name, expected) => numbers::<3>(parts),
        _ => None,
    }
}

/// The normal of `(PLANE/(POINT/…),PERPTO,(VECTOR/…))`.
pub(crate) fn plane_normal(part: &Part<'_>) -> Option<Vector> {
    match part {
        Part::Shape(name, parts) if is(name, "PLANE") => match &parts[..] {
            [point, word, vector] if word.is_word("PERPTO") => {
                three(point, "POINT")?;
                unit(three(vector, "VECTOR")?)
            }
            _ => None,
        },
        _ => None,
    }
}

/// The circle that is to be followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Round {
    /// Center, or a point on the axis.
    pub(crate) center: Vector,
    /// Direction of the axis, of either sense, where it is given.
    pub(crate) axis: Option<Vector>,
    pub(crate) radius: f64,
}

/// What ends the motion on a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stop {
    /// Two points of the line in which it cuts the plane of the circle.
    pub(crate) line: [Vector; 2],
    /// Which intersection counts, where it is said.
    pub(crate) count: Option<u32>,
}

/// `(CIRCLE/x,y,z,r)` or `(CYLNDR/x,y,z,i,j,k,r)`, then `ON[,n,INTOF]`, then `(LINE/…)` or
/// `(PLANE/PERPTO,(PLANE/…),(POINT/…),(POINT/…))`.
pub(crate) fn round_and_stop(parts: &[Part<'_>]) -> Option<(Round, Stop)> {
    let (count, line) = match &parts[1..] {
        [on, line] if on.is_word("ON") => (None, line),
        [on, Part::Number(count), of, line]
            if on.is_word("ON")
                && of.is_word("INTOF")
                && (1.0..=3.0).contains(count)
                && count.fract() == 0.0 =>
        {
            (Some(*count as u32), line)
        }
        _ => return None,
    };
    let round = round(parts.first()?)?;
    let line = match line {
        Part::Shape(name, parts) if is(name, "LINE") => {
            let [a, b, c, d, e, f] = numbers::<6>(parts)?;
            [[a, b, c], [d, e, f]]
        }
        Part::Shape(name, parts) if is(name, "PLANE") => match &parts[..] {
            [word, plane, first, second] if word.is_word("PERPTO") => {
                let line = [three(first, "POINT")?, three(second, "POINT")?];
                let normal = plane_normal(plane)?;
                let is_known = round
                    .axis
                    .is_none_or(|axis| crate::forms::vector::norm(cross(axis, normal)) < 1e-4);
                if !is_known {
                    return None;
                }
                line
            }
            _ => return None,
        },
        _ => return None,
    };
    unit(sub(line[1], line[0]))?;
    Some((round, Stop { line, count }))
}

fn round(part: &Part<'_>) -> Option<Round> {
    let Part::Shape(name, parts) = part else { return None };
    if is(name, "CIRCLE") {
        let [x, y, z, radius] = numbers::<4>(parts)?;
        return Some(Round { center: [x, y, z], axis: None, radius });
    }
    if is(name, "CYLNDR") {
        let [x, y, z, i, j, k, radius] = numbers::<7>(parts)?;
        return Some(Round { center: [x, y, z], axis: Some(unit([i, j, k])?), radius });
    }
    None
}

/// Words and numbers of a list in their order, without the parentheses.
pub(crate) fn flatten(parts: &[Part<'_>], vocabulary: &mut Vocabulary, data: &mut Vec<Word>) {
    for part in parts {
        match part {
            Part::Number(value) => data.push(Word::Number(*value)),
            Part::Word(word) => data.push(Word::Minor(vocabulary.intern_bytes(word))),
            Part::Shape(name, parts) => {
                data.push(Word::Minor(vocabulary.intern_bytes(name)));
                flatten(parts, vocabulary, data);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_read_or_refused() {
        let parts = parse(b" (CIRCLE/ 1., 2. ,3.,.5) ,ON,2,INTOF,(LINE/1,2,3,4,5,6)").unwrap();
        let (round, stop) = round_and_stop(&parts).unwrap();
        assert_eq!((round.center, round.radius, round.axis), ([1.0, 2.0, 3.0], 0.5, None));
        assert_eq!((stop.count, stop.line[1]), (Some(2), [4.0, 5.0, 6.0]));
        for wrong in [
            "(CIRCLE/1,2,3,4",
            "(CIRCLE/1,2,3,4))",
            "(CIRCLE 1,2,3,4)",
            "(/1,2)",
            "(CIRCLE/1,2 3,4)",
            "(CIRCLE/1,,3,4)",
            "1..2",
            "((((((((((((",
            "",
        ] {
            assert!(parse(wrong.as_bytes()).is_err(), "{wrong}");
        }
        for other in [
            "(CIRCLE/1,2,3),ON,(LINE/1,2,3,4,5,6)",
            "(CIRCLE/1,2,3,4),TO,(LINE/1,2,3,4,5,6)",
            "(CIRCLE/1,2,3,4),ON,(LINE/1,2,3,1,2,3)",
            "(CIRCLE/1,2,3,4),ON,1.5,INTOF,(LINE/1,2,3,4,5,6)",
            "(SPHERE/1,2,3,4),ON,(LINE/1,2,3,4,5,6)",
            "(LINE/1,2,3,4,5,6)",
        ] {
            assert_eq!(round_and_stop(&parse(other.as_bytes()).unwrap()), None, "{other}");
        }
    }
}
