//! Variables of programs in word address: `#1=5.`, `X#1`, `Z[#2-0.5]`.
//!
//! A picture takes their values where the order of the lines is that of the text: in a program
//! without jumps, loops and calls. All else with `#` stays as it is, and the reader passes it
//! over.

use std::borrow::Cow;
use std::collections::BTreeMap;

/// Variables from this number on belong to the control.
const SYSTEM: u32 = 1000;

/// Most parentheses within parentheses.
const DEEPEST: u32 = 50;

/// Letters whose numbers are whole.
const WHOLE: &[u8] = b"GMTSHDPLNO";

/// What makes another order of lines than that of the text.
const JUMPS: [&[u8]; 9] =
    [b"GOTO", b"WHILE", b"IF[", b"END", b"M97", b"M98", b"M99", b"G65", b"G66"];

/// The text with the values of variables in their place, line by line.
pub(super) fn resolved(text: &[u8]) -> Cow<'_, [u8]> {
    if !text.contains(&b'#') || text.split(|byte| *byte == b'\n').any(jumps) {
        return Cow::Borrowed(text);
    }
    let mut variables = Variables::default();
    let mut out = Vec::with_capacity(text.len());
    for line in text.split_inclusive(|byte| *byte == b'\n') {
        match variables.line(line) {
            Some(line) => out.extend(line),
            None => out.extend(line),
        }
    }
    Cow::Owned(out)
}

fn jumps(line: &[u8]) -> bool {
    let mut code = without_comments(line).to_ascii_uppercase();
    code.retain(|byte| !byte.is_ascii_whitespace());
    JUMPS.iter().any(|word| code.windows(word.len()).any(|part| part == *word))
}

/// A line without what is in parentheses.
fn without_comments(line: &[u8]) -> Vec<u8> {
    let mut depth = 0;
    let mut keep = |byte: &u8| match byte {
        b'(' => {
            depth += 1;
            false
        }
        b')' => {
            depth = (depth - 1).max(0);
            false
        }
        _ => depth == 0,
    };
    line.iter().copied().filter(|byte| keep(byte)).collect()
}

#[derive(Default)]
struct Variables(BTreeMap<u32, f64>);

impl Variables {
    /// A line with values in place of variables; `None` where it has none, or not all of them have
    /// a value.
    fn line(&mut self, line: &[u8]) -> Option<Vec<u8>> {
        let code = without_comments(line);
        if !code.iter().any(|byte| b"#[".contains(byte)) {
            return None;
        }
        let mut rest = Cursor { text: &code, at: 0 };
        if let Some(end) = self.assign(&mut rest) {
            return Some(end);
        }
        let mut out = Vec::new();
        let mut rest = Cursor { text: &code, at: 0 };
        while let Some(byte) = rest.byte() {
            out.push(byte);
            if byte.is_ascii_alphabetic() && rest.begins_expression() {
                let value = self.factor(&mut rest, 0)?;
                out.extend(number(byte, value)?);
            }
        }
        (!out.contains(&b'#')).then_some(out)
    }

    /// Takes `#1=…`, alone or after a block number: what is left is an empty line.
    fn assign(&mut self, rest: &mut Cursor<'_>) -> Option<Vec<u8>> {
        rest.skip_blanks();
        if rest.take(b'N') || rest.take(b'n') {
            rest.digits()?;
        }
        let variable = rest.take(b'#').then(|| self.variable(rest, 0)).flatten();
        let is_assigned = variable.is_some() && rest.take(b'=');
        let value = if is_assigned { self.sum(rest, 0) } else { None };
        rest.skip_blanks();
        let ending = &rest.text[rest.at..];
        if !is_assigned || !ending.iter().all(|byte| b"\r\n;".contains(byte)) {
            return None;
        }
        let variable = variable?;
        match value {
            Some(value) => self.0.insert(variable, value),
            // Its old value is no longer that of the variable.
            None => self.0.remove(&variable),
        };
        value.map(|_| ending.to_vec())
    }

    /// The number of a variable after its sign.
    fn variable(&self, rest: &mut Cursor<'_>, depth: u32) -> Option<u32> {
        let number = match rest.digits() {
            Some(number) => number,
            None => {
                let value = self.factor(rest, depth + 1)?;
                (value.fract() == 0.0).then_some(value)?
            }
        };
        (1.0..f64::from(SYSTEM)).contains(&number).then_some(number as u32)
    }

    fn sum(&self, rest: &mut Cursor<'_>, depth: u32) -> Option<f64> {
        let mut value = self.product(rest, depth)?;
        loop {
            if rest.take(b'+') {
                value += self.product(rest, depth)?;
            } else if rest.take(b'-') {
                value -= self.product(rest, depth)?;
            } else {
                return finite(value);
            }
        }
    }

    fn product(&self, rest: &mut Cursor<'_>, depth: u32) -> Option<f64> {
        let mut value = self.factor(rest, depth)?;
        loop {
            if rest.take(b'*') {
                value *= self.factor(rest, depth)?;
            } else if rest.take(b'/') {
                value /= self.factor(rest, depth)?;
            } else {
                return finite(value);
            }
        }
    }

    fn factor(&self, rest: &mut Cursor<'_>, depth: u32) -> Option<f64> {
        if depth > DEEPEST {
            return None;
        }
        if rest.take(b'-') {
            return self.factor(rest, depth + 1).map(|value| -value);
        }
        if rest.take(b'+') {
            return self.factor(rest, depth + 1);
        }
        if rest.take(b'#') {
            let variable = self.variable(rest, depth)?;
            return self.0.get(&variable).copied();
        }
        if rest.take(b'[') {
            let value = self.sum(rest, depth + 1)?;
            return rest.take(b']').then_some(value);
        }
        match rest.name().as_slice() {
            b"" => rest.number(),
            b"ATAN" => {
                let y = self.factor(rest, depth + 1)?;
                let x = if rest.take(b'/') { self.factor(rest, depth + 1)? } else { 1.0 };
                finite(libm::atan2(y, x).to_degrees())
            }
            name => finite(function(name, self.factor(rest, depth + 1)?)?),
        }
    }
}

/// A function of one value, angles in degrees.
fn function(name: &[u8], value: f64) -> Option<f64> {
    Some(match name {
        b"SIN" => libm::sin(value.to_radians()),
        b"COS" => libm::cos(value.to_radians()),
        b"TAN" => libm::tan(value.to_radians()),
        b"ASIN" => libm::asin(value).to_degrees(),
        b"ACOS" => libm::acos(value).to_degrees(),
        b"SQRT" => libm::sqrt(value),
        b"ABS" => value.abs(),
        b"ROUND" => value.round(),
        b"FIX" => value.trunc(),
        b"FUP" => value.abs().ceil().copysign(value),
        _ => return None,
    })
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// The number of a word as a program writes it.
fn number(letter: u8, value: f64) -> Option<Vec<u8>> {
    if WHOLE.contains(&letter.to_ascii_uppercase()) {
        let is_whole = (value - value.round()).abs() < 1e-9 && (0.0..1e9).contains(&value);
        return is_whole.then(|| format!("{value:.0}").into_bytes());
    }
    let digits = format!("{value:.6}");
    Some(digits.trim_end_matches('0').as_bytes().to_vec())
}

/// Where the reading of a line is.
struct Cursor<'t> {
    text: &'t [u8],
    at: usize,
}

impl Cursor<'_> {
    fn byte(&mut self) -> Option<u8> {
        let byte = self.text.get(self.at).copied()?;
        self.at += 1;
        Some(byte)
    }

    fn skip_blanks(&mut self) {
        while self.text.get(self.at).is_some_and(|byte| b" \t".contains(byte)) {
            self.at += 1;
        }
    }

    /// Takes a sign after blanks.
    fn take(&mut self, sign: u8) -> bool {
        let before = self.at;
        self.skip_blanks();
        if self.text.get(self.at) == Some(&sign) {
            self.at += 1;
            return true;
        }
        self.at = before;
        false
    }

    /// True before `#` or `[`, with a sign or without.
    fn begins_expression(&self) -> bool {
        let rest = self.text[self.at..].trim_ascii_start();
        let rest = rest.strip_prefix(b"-").unwrap_or(rest).trim_ascii_start();
        matches!(rest.first(), Some(b'#' | b'['))
    }

    fn digits(&mut self) -> Option<f64> {
        let count = self.text[self.at..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let digits = std::str::from_utf8(&self.text[self.at..self.at + count]).ok()?;
        let value = digits.parse().ok()?;
        self.at += count;
        Some(value)
    }

    fn number(&mut self) -> Option<f64> {
        self.skip_blanks();
        let is_part = |byte: &&u8| byte.is_ascii_digit() || **byte == b'.';
        let count = self.text[self.at..].iter().take_while(is_part).count();
        let digits = std::str::from_utf8(&self.text[self.at..self.at + count]).ok()?;
        let value = digits.parse().ok()?;
        self.at += count;
        Some(value)
    }

    /// The name of a function, in capitals; empty without one.
    fn name(&mut self) -> Vec<u8> {
        self.skip_blanks();
        let is_letter = |byte: &&u8| byte.is_ascii_alphabetic();
        let count = self.text[self.at..].iter().take_while(is_letter).count();
        let name = self.text[self.at..self.at + count].to_ascii_uppercase();
        self.at += count;
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(program: &str) -> String {
        String::from_utf8(resolved(program.as_bytes()).into_owned()).expect("the text is UTF-8")
    }

    #[test]
    fn words_take_the_values_of_variables() {
        let program = "#1=10. (WIDTH)\nN20 #2 = [#1+2]*-3/4\nG1 X#1 Y-#2 Z[#1/4] F[#2+109]\nT#1 M6\n\
                       #3=SQRT[#1*#1+576]\nX#3 (#9)\n#[3+1]=ATAN[1]/[-1]\nA#4\nY-[2*SIN[30]]\n";
        assert_eq!(text(program), "\n\nG1 X10. Y9. Z2.5 F100.\nT10 M6\n\nX26. \n\nA135.\nY-1.\n");
    }

    #[test]
    fn what_has_no_value_stays() {
        for line in ["X#7\n", "X#5001\n", "#1=#7\n", "X[1+\n", "T[0.5]#1\n", "#500X\n", "#1=2 G0\n"]
        {
            assert_eq!(text(line), line);
        }
        // A variable whose new value is not known has not the old one.
        assert_eq!(text("#1=2.\n#1=#2001\nX#1\n"), "\n#1=#2001\nX#1\n");
        let deep = format!("X{}#1\n", "[".repeat(1000));
        assert_eq!(text(&deep), deep);
    }

    #[test]
    fn nothing_is_taken_where_lines_run_in_another_order() {
        for jump in ["GOTO 5", "IF [#1 GT 2] GOTO 5", "WHILE[#1LT3]DO1", "M98 P5", "G65 P9"] {
            let program = format!("#1=2.\n{jump}\nX#1\n");
            assert_eq!(text(&program), program);
        }
        assert_eq!(text("#1=2.\n(M98 IS A CALL)\nX#1\n"), "\n(M98 IS A CALL)\nX2.\n");
    }
}
