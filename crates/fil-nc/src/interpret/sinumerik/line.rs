//! A block of a SINUMERIK program as words: `X10`, `X1=10`, `CR=5`, `I=AC(3)`,
//! `T="MILL"`, `MCALL`, `CYCLE83(10,0,2,-30)`. Numbers, labels and comments are left out.

use std::ops::Range;

use super::super::Fault;
use crate::dialect::WayRound;
use crate::errors::NcCode;

/// What stands behind a name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    /// A number.
    Number(f64),
    /// `AC(…)`: a position, whatever is in force.
    Absolute(f64),
    /// `DC(…)`, `ACP(…)`, `ACN(…)`: a position of a rotary axis within a turn, and the way
    /// to it.
    Turned(f64, WayRound),
    /// `IC(…)`: an increment, whatever is in force.
    Increment(f64),
    /// A text in quotes.
    Text(String),
    /// An R parameter, with its sign.
    Parameter(u32, f64),
    /// A calculation or a variable.
    Unread,
}

/// A word of a block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Word {
    /// In upper case, with the number of a named address: `X1`, `CR`, `CYCLE83`.
    pub(crate) name: String,
    /// Its name stands before `=`.
    pub(crate) assigned: bool,
    pub(crate) value: Option<Value>,
    /// What a call is given; `None` for an argument that is left out.
    pub(crate) arguments: Option<Vec<Option<Value>>>,
    /// Bytes of the line.
    pub(crate) range: Range<usize>,
}

impl Word {
    pub(crate) fn no_meaning(&self) -> Fault {
        let message = format!("`{}`: nothing takes it", self.name);
        Fault::new(NcCode::NoMeaning, message).at(&self.range)
    }

    pub(crate) fn foreign(&self, why: &str) -> Fault {
        Fault::new(NcCode::ForeignCode, format!("`{}` {why}", self.name)).at(&self.range)
    }
}

/// The words of a line.
///
/// # Errors
/// What is no word, a text that is not closed, a number that can't be read.
pub(crate) fn read(text: &[u8]) -> Result<Vec<Word>, Fault> {
    let mut scan = Scan { text, at: 0 };
    let mut words = Vec::new();
    scan.blanks();
    if scan.peek() == Some(b'/') {
        scan.at += 1;
        while scan.peek().is_some_and(|byte| byte.is_ascii_digit()) {
            scan.at += 1;
        }
    }
    loop {
        scan.blanks();
        match scan.peek() {
            None | Some(b';') => break,
            Some(byte) if byte.is_ascii_alphabetic() || byte == b'_' => {
                if let Some(word) = scan.word()? {
                    words.push(word);
                }
            }
            // A main block: `:10`.
            Some(b':') if words.is_empty() => {
                scan.at += 1;
                scan.number()?;
            }
            Some(_) => return Err(scan.refuse(NcCode::NotAWord, scan.at)),
        }
    }
    if words.first().is_some_and(|word| word.name == "N" && !word.assigned) {
        words.remove(0);
    }
    Ok(words)
}

struct Scan<'t> {
    text: &'t [u8],
    at: usize,
}

impl Scan<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn blanks(&mut self) {
        while self.peek().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    fn refuse(&self, code: NcCode, from: usize) -> Fault {
        let end = (from + 12).min(self.text.len());
        let shown = String::from_utf8_lossy(&self.text[from..end]).trim_end().to_string();
        Fault::new(code, format!("`{shown}`")).at(&(from..end))
    }

    /// A word; `None` for a label.
    fn word(&mut self) -> Result<Option<Word>, Fault> {
        let start = self.at;
        let mut name = self.name();
        let one_letter = name.len() == 1;
        if self.peek() == Some(b'[') {
            let end = self.text[self.at..].iter().position(|byte| *byte == b']');
            let end = self.at + end.ok_or_else(|| self.refuse(NcCode::NotAWord, start))? + 1;
            name.push_str(&String::from_utf8_lossy(&self.text[self.at..end]));
            self.at = end;
        }
        self.blanks();
        let word =
            |name, value, arguments, range| Word { name, assigned: false, value, arguments, range };
        match self.peek() {
            Some(b'=') => {
                self.at += 1;
                self.blanks();
                let value = self.value()?;
                let range = start..self.at;
                Ok(Some(Word { assigned: true, ..word(name, Some(value), None, range) }))
            }
            Some(b'(') if !one_letter => {
                let arguments = self.arguments()?;
                Ok(Some(word(name, None, Some(arguments), start..self.at)))
            }
            Some(b':') => {
                self.at += 1;
                Ok(None)
            }
            Some(byte) if one_letter && (byte.is_ascii_digit() || b"+-.".contains(&byte)) => {
                let value = self.number()?;
                if self.peek() != Some(b'=') {
                    let range = start..self.at;
                    return Ok(Some(word(name, Some(Value::Number(value)), None, range)));
                }
                if value.fract() != 0.0 || value < 0.0 {
                    return Err(self.refuse(NcCode::BadNumber, start));
                }
                self.at += 1;
                self.blanks();
                let name = format!("{name}{value}");
                let value = self.value()?;
                let range = start..self.at;
                Ok(Some(Word { assigned: true, ..word(name, Some(value), None, range) }))
            }
            _ if one_letter => Err(self.refuse(NcCode::BadNumber, start)),
            _ => Ok(Some(word(name, None, None, start..start + self.width(start)))),
        }
    }

    fn width(&self, start: usize) -> usize {
        let bytes = &self.text[start..self.at];
        bytes.trim_ascii_end().len()
    }

    /// One letter where a number follows it, else all letters, digits and underscores.
    fn name(&mut self) -> String {
        let start = self.at;
        self.at += 1;
        if self.peek().is_some_and(|byte| byte.is_ascii_alphabetic() || byte == b'_') {
            while self.peek().is_some_and(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
                self.at += 1;
            }
        }
        String::from_utf8_lossy(&self.text[start..self.at]).to_ascii_uppercase()
    }

    fn number(&mut self) -> Result<f64, Fault> {
        let start = self.at;
        if matches!(self.peek(), Some(b'-' | b'+')) {
            self.at += 1;
        }
        while self.peek().is_some_and(|byte| byte.is_ascii_digit() || byte == b'.') {
            self.at += 1;
        }
        let text = std::str::from_utf8(&self.text[start..self.at]).unwrap_or("");
        let value = text.parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| self.refuse(NcCode::BadNumber, start))
    }

    /// What stands behind `=` or in a call.
    fn value(&mut self) -> Result<Value, Fault> {
        let start = self.at;
        if self.peek() == Some(b'"') {
            return self.text();
        }
        let end = self.end_of_value();
        let text = String::from_utf8_lossy(&self.text[start..end]).trim().to_ascii_uppercase();
        self.at = end;
        Ok(read_value(&text))
    }

    fn text(&mut self) -> Result<Value, Fault> {
        let start = self.at + 1;
        let length = self.text[start..].iter().position(|byte| *byte == b'"');
        let length = length.ok_or_else(|| self.refuse(NcCode::OpenComment, self.at))?;
        self.at = start + length + 1;
        Ok(Value::Text(String::from_utf8_lossy(&self.text[start..start + length]).into_owned()))
    }

    /// Where a value ends: at a blank, a comma or a bracket that it has not opened.
    fn end_of_value(&self) -> usize {
        let mut depth = 0;
        for (at, byte) in self.text.iter().enumerate().skip(self.at) {
            match byte {
                b'(' => depth += 1,
                b')' if depth == 0 => return at,
                b')' => depth -= 1,
                b',' | b';' if depth == 0 => return at,
                byte if byte.is_ascii_whitespace() && depth == 0 => return at,
                byte if byte.is_ascii_alphabetic() && depth == 0 => {
                    // `X=10Y=5`: a number ends where the next name begins.
                    let number = &self.text[self.at..at];
                    if !number.is_empty() && std::str::from_utf8(number).is_ok_and(is_number) {
                        return at;
                    }
                }
                _ => {}
            }
        }
        self.text.len()
    }

    fn arguments(&mut self) -> Result<Vec<Option<Value>>, Fault> {
        let open = self.at;
        self.at += 1;
        let mut arguments = Vec::new();
        let mut last = None;
        loop {
            self.blanks();
            match self.peek() {
                None => return Err(self.refuse(NcCode::OpenComment, open)),
                Some(b')') => {
                    self.at += 1;
                    if last.is_some() || !arguments.is_empty() {
                        arguments.push(last);
                    }
                    return Ok(arguments);
                }
                Some(b',') => {
                    self.at += 1;
                    arguments.push(last.take());
                }
                Some(_) if last.is_none() => last = Some(self.value()?),
                Some(_) => return Err(self.refuse(NcCode::NotAWord, self.at)),
            }
        }
    }
}

fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok()
}

fn read_value(text: &str) -> Value {
    let of = |name: &str| text.strip_prefix(name)?.strip_suffix(')')?.trim().parse::<f64>().ok();
    if let Ok(value) = text.parse::<f64>()
        && value.is_finite()
    {
        return Value::Number(value);
    }
    if let Some(value) = of("AC(") {
        return Value::Absolute(value);
    }
    let ways = [("DC(", WayRound::Shortest), ("ACP(", WayRound::Plus), ("ACN(", WayRound::Minus)];
    if let Some((value, way)) = ways.iter().find_map(|(name, way)| Some((of(name)?, *way))) {
        return Value::Turned(value, way);
    }
    if let Some(value) = of("IC(") {
        return Value::Increment(value);
    }
    let (sign, name) = match text.strip_prefix('-') {
        Some(name) => (-1.0, name),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    match name.strip_prefix('R').and_then(|number| number.parse().ok()) {
        Some(number) => Value::Parameter(number, sign),
        None => Value::Unread,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        read(text.as_bytes()).unwrap().into_iter().map(|word| word.name).collect()
    }

    #[test]
    fn words_are_read_packed_and_apart() {
        assert_eq!(names("N10 G1X10Y-2.5 CR=5 ; X9"), ["G", "X", "Y", "CR"]);
        assert_eq!(names("X1=10 S2=500 M2=3"), ["X1", "S2", "M2"]);
        assert_eq!(names("/2 MCALL CYCLE81(5,0,1,-3)"), ["MCALL", "CYCLE81"]);
        assert_eq!(names("BEGIN: SPOS[1]=90 SUPA"), ["SPOS[1]", "SUPA"]);
    }

    #[test]
    fn values_are_numbers_texts_and_forms() {
        let values = |text: &str| -> Vec<Value> {
            read(text.as_bytes()).unwrap().into_iter().filter_map(|word| word.value).collect()
        };
        let expected = [
            Value::Number(-2.5),
            Value::Absolute(3.0),
            Value::Increment(-1.0),
            Value::Text("A;B".to_string()),
            Value::Parameter(5, -1.0),
            Value::Unread,
            Value::Turned(350.0, WayRound::Plus),
            Value::Turned(10.0, WayRound::Minus),
            Value::Turned(90.0, WayRound::Shortest),
        ];
        let text = "X=-2.5 I=AC(3) Y=IC(-1) T=\"A;B\" Z=-R5 A=R1+1 C=ACP(350) C=ACN(10) C4=DC(90)";
        assert_eq!(values(text), expected);
    }

    #[test]
    fn arguments_may_be_left_out() {
        let words = read(b"CYCLE82(5, 0,1,,12 ,0.5)").unwrap();
        let arguments = words[0].arguments.clone().unwrap();
        assert_eq!(arguments.len(), 6);
        assert_eq!(arguments[3], None);
        assert_eq!(arguments[5], Some(Value::Number(0.5)));
        assert_eq!(read(b"CYCLE800()").unwrap()[0].arguments, Some(vec![]));
    }

    #[test]
    fn what_is_no_word_is_refused() {
        for text in ["X", "G1 X1.2.3", "CYCLE81(1,2", "T=\"OPEN", "#5"] {
            assert!(read(text.as_bytes()).is_err(), "{text}");
        }
    }
}
