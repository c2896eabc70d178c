//! A control that runs a measuring program: custom macro B as far as that needs it, a probe that
//! stops at a simulated cylinder, and the port that DPRNT prints to.

use std::collections::HashMap;

use super::{Cylinder, Random};

/// How two numbers of a condition compare.
type Comparison = fn(&f64, &f64) -> bool;

/// The control while a program runs.
pub struct Control<'c> {
    cylinder: &'c Cylinder,
    noise: f64,
    random: Random,
    variables: HashMap<u32, f64>,
    /// X Y Z A B C.
    axes: HashMap<char, f64>,
    /// What DPRNT has printed.
    pub printed: String,
    /// How often the probe has touched the part.
    pub touches: usize,
}

impl<'c> Control<'c> {
    /// A control in front of a part, whose probe is wrong by at most `noise`.
    pub fn new(cylinder: &'c Cylinder, noise: f64, random: Random) -> Self {
        // The machine comes from far outside.
        let start = |axis| if axis == 'X' { 1000.0 } else { 0.0 };
        let axes = "XYZABC".chars().map(|axis| (axis, start(axis))).collect();
        let (variables, printed) = (HashMap::new(), String::new());
        Control { cylinder, noise, random, variables, axes, printed, touches: 0 }
    }

    /// Runs a program to its end.
    ///
    /// # Panics
    /// An alarm of the control, a collision, a block that it does not know.
    pub fn run(&mut self, nc: &str) {
        let blocks: Vec<&str> = nc.lines().map(without_number).collect();
        let mut at = 0;
        while at < blocks.len() {
            at = self.block(&blocks, at);
        }
    }

    /// Carries out a block and says which comes next.
    fn block(&mut self, blocks: &[&str], at: usize) -> usize {
        let block = blocks[at];
        let is_end = |block: &&str| block.starts_with("END1");
        if let Some(condition) = block.strip_prefix("WHILE ") {
            let condition = condition.strip_suffix(" DO1").expect("a WHILE has its DO1");
            if !self.holds(condition) {
                return at + 1 + blocks[at..].iter().position(is_end).expect("END1");
            }
        } else if block.starts_with("END1") {
            let begins = |block: &&str| block.starts_with("WHILE ");
            return blocks[..at].iter().rposition(begins).expect("WHILE");
        } else if let Some(rest) = block.strip_prefix("IF ") {
            let (condition, then) = rest.split_once(" THEN ").expect("IF has a THEN");
            if self.holds(condition) {
                self.assign(then);
            }
        } else if block.starts_with('#') {
            self.assign(block);
        } else if let Some(line) = block.strip_prefix("DPRNT[") {
            let line = self.line(line.strip_suffix(']').expect("DPRNT ends"));
            self.printed.push_str(&line);
            self.printed.push('\n');
        } else if block.starts_with('G') {
            self.moves(block);
        }
        at + 1
    }

    fn moves(&mut self, block: &str) {
        let words: Vec<(char, f64)> = block.split(' ').map(|word| self.word(word)).collect();
        let probes = words.contains(&('G', 31.0));
        let before = self.axes.clone();
        for (letter, value) in &words {
            if let Some(axis) = self.axes.get_mut(letter) {
                *axis = *value;
            }
        }
        if words.iter().all(|(letter, _)| !"XYZC".contains(*letter)) {
            return;
        }
        let [y, z, c] = ['Y', 'Z', 'C'].map(|axis| self.axes[&axis]);
        let surface = self.cylinder.reading(z, c);
        if probes {
            assert_eq!(y, 0.0, "the probe touches at Y0: {block}");
            let turned = "YZABC".chars().any(|axis| before[&axis] != self.axes[&axis]);
            assert!(!turned && before[&'X'] > surface, "the probe goes along X: {block}");
            let target = self.axes[&'X'];
            let stops = (surface + self.noise * self.random.unit()).max(target);
            self.touches += usize::from(surface > target);
            self.axes.insert('X', stops);
            self.variables.insert(5061, stops);
            return;
        }
        // Back from a touch it stands at the surface.
        let clear = self.axes[&'X'].min(before[&'X']) > surface - 2.0 * self.noise - 1e-9;
        assert!(clear, "a rapid move through the part: {block} from {before:?}");
        let stays = before[&'X'] > surface + 1.0;
        let across = "YZC".chars().any(|axis| before[&axis] != self.axes[&axis]);
        assert!(stays || !across, "the probe touches while it goes across: {block}");
    }

    fn word(&self, word: &str) -> (char, f64) {
        let letter = word.chars().next().expect("a word");
        (letter, self.value(&word[1..]))
    }

    fn assign(&mut self, text: &str) {
        let (name, value) = text.split_once('=').expect("an assignment");
        let number: u32 = name[1..].parse().expect("the number of a variable");
        assert_ne!(number, 3000, "alarm: {text}");
        let value = self.value(value);
        self.variables.insert(number, value);
    }

    /// `[A LT B]`.
    fn holds(&self, condition: &str) -> bool {
        let inside = condition.strip_prefix('[').and_then(|it| it.strip_suffix(']'));
        let inside = inside.expect("a condition stands in brackets");
        let rules: [(&str, Comparison); 3] =
            [(" LT ", f64::lt), (" LE ", f64::le), (" GE ", f64::ge)];
        for (name, holds) in rules {
            if let Some((left, right)) = inside.split_once(name) {
                return holds(&self.value(left), &self.value(right));
            }
        }
        panic!("unknown condition {condition}")
    }

    fn value(&self, text: &str) -> f64 {
        let mut reader = Reader { control: self, rest: text };
        let value = reader.sum();
        assert!(reader.rest.is_empty(), "{} is left of {text}", reader.rest);
        value
    }

    /// A line of DPRNT: `*` is a blank, `#n[ab]` a number with a digits and b decimals.
    fn line(&self, text: &str) -> String {
        let mut line = String::new();
        let mut rest = text;
        while let Some(next) = rest.chars().next() {
            if next == '#' {
                let (name, after) = rest[1..].split_once('[').expect("a format");
                let (format, after) = after.split_once(']').expect("a format ends");
                let digits: Vec<usize> =
                    format.chars().map(|it| it.to_digit(10).expect("a digit") as usize).collect();
                let value = self.variables[&name.parse().expect("a number")];
                let width = digits[0] + 1 + digits[1];
                line.push_str(&format!("{value:width$.*}", digits[1]));
                rest = after;
            } else {
                line.push(if next == '*' { ' ' } else { next });
                rest = &rest[1..];
            }
        }
        line
    }
}

fn without_number(line: &str) -> &str {
    let numbered = line.strip_prefix('N').and_then(|rest| rest.split_once(' '));
    numbered.map_or(line, |(_, block)| block)
}

/// Reads an expression of the macro language.
struct Reader<'r, 'c> {
    control: &'r Control<'c>,
    rest: &'r str,
}

impl Reader<'_, '_> {
    fn takes(&mut self, text: &str) -> bool {
        match self.rest.strip_prefix(text) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn sum(&mut self) -> f64 {
        let mut value = self.product();
        loop {
            if self.takes("+") {
                value += self.product();
            } else if self.takes("-") {
                value -= self.product();
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut value = self.factor();
        while self.takes("/") {
            value /= self.factor();
        }
        value
    }

    fn factor(&mut self) -> f64 {
        if self.takes("-") {
            return -self.factor();
        }
        if self.takes("ABS") {
            return self.bracket().abs();
        }
        if self.takes("ATAN") {
            let up = self.bracket();
            assert!(self.takes("/"), "ATAN takes two numbers");
            return up.atan2(self.bracket()).to_degrees();
        }
        if self.rest.starts_with('[') {
            return self.bracket();
        }
        let is_variable = self.takes("#");
        let is_digit = |it: char| it.is_ascii_digit() || it == '.';
        let end = self.rest.find(|it: char| !is_digit(it)).unwrap_or(self.rest.len());
        let (number, rest) = self.rest.split_at(end);
        self.rest = rest;
        if is_variable {
            return self.control.variables[&number.parse().expect("a variable")];
        }
        number.parse().unwrap_or_else(|_| panic!("{number:?} is no number"))
    }

    fn bracket(&mut self) -> f64 {
        assert!(self.takes("["), "a bracket is missing before {}", self.rest);
        let value = self.sum();
        assert!(self.takes("]"), "a bracket is missing before {}", self.rest);
        value
    }
}
