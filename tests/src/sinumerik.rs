//! A small SINUMERIK control: R parameters, their arithmetic in degrees, calls of
//! subprograms and jumps ahead. It runs programs that calculate their own feed;
//! what it does not know is an error, never passed over.

use std::collections::BTreeMap;

/// A block that moves, or that can't because a parameter has no value.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// The parameters at the call of the subprogram.
    pub called_with: BTreeMap<u32, f64>,
    /// X, Y and Z, and F; or the function that has no value, as the alarm it gives.
    pub done: Result<([f64; 3], f64), String>,
}

/// Runs a tape that holds the main program and then subprograms, each under a
/// line `%_N_NAME_SPF`, and gives the moves that subprograms make.
///
/// # Errors
/// A word this control does not know.
pub fn run(tape: &str) -> Result<Vec<Move>, String> {
    let mut parts = tape.split("%_N_");
    let main = parts.next().unwrap_or_default();
    let mut subprograms = BTreeMap::new();
    for part in parts {
        let (head, body) = part.split_once('\n').ok_or("a head without a body")?;
        let name = head.trim().strip_suffix("_SPF").ok_or("a head that is no subprogram")?;
        subprograms.insert(name, body);
    }
    let mut parameters = BTreeMap::new();
    let mut moves = Vec::new();
    for word in main.split_whitespace() {
        if let Some((number, expression)) = assignment(word) {
            let value = value(expression, &parameters)?;
            parameters.insert(number, value.map_err(|alarm| format!("{alarm} in {word}"))?);
        } else if let Some(body) = subprograms.get(word) {
            let called_with = parameters.clone();
            let done = subprogram(body, &mut parameters)?;
            moves.push(Move { called_with, done });
        } else if !word.starts_with(['N', 'G', 'X', 'Y', 'Z', 'S', 'M']) {
            return Err(format!("the main program says {word}"));
        }
    }
    Ok(moves)
}

/// `R5=…` as number and expression.
fn assignment(word: &str) -> Option<(u32, &str)> {
    let (number, expression) = word.strip_prefix('R')?.split_once('=')?;
    Some((number.parse().ok()?, expression))
}

type Moved = Result<([f64; 3], f64), String>;

/// Runs a subprogram to its M17; the move it makes, or the alarm it stops with.
fn subprogram(body: &str, parameters: &mut BTreeMap<u32, f64>) -> Result<Moved, String> {
    let mut wanted: Option<&str> = None;
    let mut moved = None;
    for line in body.lines() {
        let mut condition = true;
        let mut words = line.split_whitespace().peekable();
        let mut axes = BTreeMap::new();
        while let Some(word) = words.next() {
            if let Some(label) = word.strip_suffix(':') {
                wanted = wanted.filter(|wanted| *wanted != label);
            } else if wanted.is_some() {
                continue;
            } else if word == "IF" {
                let (left, right) = words
                    .next()
                    .and_then(|compared| compared.split_once('<'))
                    .ok_or("an IF without <")?;
                match (value(left, parameters)?, value(right, parameters)?) {
                    (Ok(left), Ok(right)) => condition = left < right,
                    (Err(alarm), _) | (_, Err(alarm)) => return Ok(Err(alarm)),
                }
            } else if word == "GOTOF" {
                let label = words.next().ok_or("a GOTOF without a label")?;
                wanted = condition.then_some(label);
            } else if word == "M17" {
                return Ok(moved.ok_or("no block moves")?);
            } else if let Some((number, expression)) = assignment(word) {
                match value(expression, parameters)? {
                    Ok(value) => parameters.insert(number, value),
                    Err(alarm) => return Ok(Err(alarm)),
                };
            } else if let Some((axis, expression)) = word.split_once('=') {
                match value(expression, parameters)? {
                    Ok(value) => axes.insert(axis, value),
                    Err(alarm) => return Ok(Err(alarm)),
                };
            } else if !(word == "G1" || word.starts_with('N')) {
                return Err(format!("the subprogram says {word}"));
            }
        }
        if let [Some(x), Some(y), Some(z), Some(f)] =
            ["X", "Y", "Z", "F"].map(|axis| axes.get(axis))
        {
            moved = Some(Ok(([*x, *y, *z], *f)));
        }
    }
    Err("no M17".into())
}

/// The value of an expression; the inner error is the alarm of a function that has
/// no value there.
fn value(text: &str, parameters: &BTreeMap<u32, f64>) -> Result<Result<f64, String>, String> {
    let mut reader = Expression { rest: text, parameters, alarm: None };
    let value = reader.sum()?;
    if !reader.rest.is_empty() {
        return Err(format!("{} is left of {text}", reader.rest));
    }
    Ok(match reader.alarm {
        Some(alarm) => Err(alarm),
        None => Ok(value),
    })
}

struct Expression<'a> {
    rest: &'a str,
    parameters: &'a BTreeMap<u32, f64>,
    alarm: Option<String>,
}

impl Expression<'_> {
    fn takes(&mut self, sign: char) -> bool {
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self) -> Result<f64, String> {
        let mut sum = self.product()?;
        loop {
            if self.takes('+') {
                sum += self.product()?;
            } else if self.takes('-') {
                sum -= self.product()?;
            } else {
                return Ok(sum);
            }
        }
    }

    fn product(&mut self) -> Result<f64, String> {
        let mut product = self.factor()?;
        loop {
            if self.takes('*') {
                product *= self.factor()?;
            } else if self.takes('/') {
                product /= self.factor()?;
                self.must(product.is_finite(), "/");
            } else {
                return Ok(product);
            }
        }
    }

    fn factor(&mut self) -> Result<f64, String> {
        if self.takes('-') {
            return Ok(-self.factor()?);
        }
        if self.takes('(') {
            let inner = self.sum()?;
            return if self.takes(')') { Ok(inner) } else { Err("a bracket is open".into()) };
        }
        let length = |rest: &str, fits: fn(char) -> bool| {
            rest.find(|character| !fits(character)).unwrap_or(rest.len())
        };
        let (name, rest) = self.rest.split_at(length(self.rest, |c| c.is_ascii_alphabetic()));
        let digits = length(rest, |c| c.is_ascii_digit() || c == '.');
        match name {
            "" | "R" => {
                let (number, rest) = rest.split_at(digits);
                self.rest = rest;
                if name.is_empty() {
                    return number.parse().map_err(|_| format!("{number} is no number"));
                }
                let number = number.parse().map_err(|_| "R without a number")?;
                self.parameters.get(&number).copied().ok_or(format!("R{number} is not set"))
            }
            _ => {
                // ATAN2 is the one function with a digit in its name.
                let digits = if name == "ATAN" { digits } else { 0 };
                self.rest = &rest[digits..];
                self.function(&format!("{name}{}", &rest[..digits]).to_uppercase())
            }
        }
    }

    fn function(&mut self, name: &str) -> Result<f64, String> {
        if !self.takes('(') {
            return Err(format!("{name} without a bracket"));
        }
        let x = self.sum()?;
        let other = if self.takes(',') { Some(self.sum()?) } else { None };
        if !self.takes(')') {
            return Err(format!("the bracket of {name} is open"));
        }
        let result = match (name, other) {
            ("SIN", None) => x.to_radians().sin(),
            ("TAN", None) => x.to_radians().tan(),
            ("ASIN", None) => x.asin().to_degrees(),
            ("LN", None) => x.ln(),
            ("ABS", None) => x.abs(),
            ("ATAN2", Some(other)) => x.atan2(other).to_degrees(),
            _ => return Err(format!("{name} is not known")),
        };
        self.must(result.is_finite(), name);
        Ok(result)
    }

    /// Notes the first operation without a value.
    fn must(&mut self, has_value: bool, operation: &str) {
        if !has_value {
            self.alarm.get_or_insert(operation.to_string());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_is_that_of_the_control() {
        let parameters = BTreeMap::from([(1, 30.0), (2, -1.0)]);
        let value = |text| value(text, &parameters);
        assert_eq!(value("2+3*4-6/(1+2)"), Ok(Ok(12.0)));
        assert!((value("SIN(R1)*2").unwrap().unwrap() - 1.0).abs() < 1e-12);
        // 30.5 up and 80.1 along; the first argument is the height.
        let angle = value("ATAN2(30.5,80.1)").unwrap().unwrap();
        assert!((angle - 20.8455).abs() < 1e-4);
        assert_eq!(value("LN(R2)"), Ok(Err("LN".to_string())));
        assert_eq!(value("1/(R2+1)"), Ok(Err("/".to_string())));
        assert!(value("COT(1)").is_err());
        assert!(value("R9").is_err());
    }

    #[test]
    fn jumps_lead_ahead_to_their_label() {
        let tape = "N10 R1=1 R2=2\nN20 SUB\nN30 R1=3 SUB\n%_N_SUB_SPF\nIF R1<R2 GOTOF LOW\n\
                    G1 X=1 Y=2 Z=3 F=R1 GOTOF DONE\nLOW: R3=R1*10\nG1 X=4 Y=5 Z=6 F=R3\nDONE: M17\n";
        let moves = run(tape).unwrap();
        let done: Vec<_> = moves.into_iter().map(|made| made.done).collect();
        assert_eq!(done, [Ok(([4.0, 5.0, 6.0], 10.0)), Ok(([1.0, 2.0, 3.0], 3.0))]);
    }
}
