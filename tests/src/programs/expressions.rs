//! Numbers, conditions and texts.

use super::{ARRAYS, NUMBERS, Program, Scope, TEXTS, WORDS};

const OPERATORS: &[&str] =
    &["+", "-", "*", "/", "+", "-", "*", "**", "+", "-", "*", "+", "-", "**"];
const RELATIONS: &[&str] = &[".EQ.", ".NE.", ".LT.", ".LE.", ".GT.", ".GE."];
const FUNCTIONS: &[(&str, usize)] = &[
    ("ABSF", 1),
    ("ABSF", 1),
    ("SINF", 1),
    ("COSF", 1),
    ("TANF", 1),
    ("ATANF", 1),
    ("INTF", 1),
    ("NINTF", 1),
    ("ROUNDF", 1),
    ("SQRTF", 1),
    ("LOGF", 1),
    ("LOG10F", 1),
    ("EXPF", 1),
    ("ASINF", 1),
    ("ACOSF", 1),
    ("MODF", 2),
    ("SIGNF", 2),
    ("ATAN2F", 2),
    ("MAXF", 2),
    ("MINF", 3),
    ("MAX1F", 3),
    ("MIN1F", 2),
    ("DISTF", 6),
    ("DOTF", 6),
];

impl Program<'_, '_> {
    pub(super) fn literal(&mut self) -> String {
        let whole = self.dice.below(12);
        match self.dice.below(6) {
            0 => format!("{whole}.{}", self.dice.below(100)),
            1 => format!("-{whole}"),
            2 => format!("{}", whole * 30),
            3 => format!("-{whole}.5"),
            _ => whole.to_string(),
        }
    }

    /// A number; no deeper than `depth`.
    pub(super) fn number(&mut self, scope: Scope, depth: usize) -> String {
        if depth == 0 {
            return match self.dice.below(4) {
                0 | 1 => self.name(scope),
                2 if self.dice.once_in(6) => self.dice.pick(&["A", "F", "X", "Z"]).to_string(),
                _ => self.literal(),
            };
        }
        match self.dice.below(14) {
            0..=4 => {
                let (one, other) = (self.number(scope, depth - 1), self.number(scope, depth - 1));
                let sign = self.dice.pick(OPERATORS);
                // Two signs in a row are no FIL; sizes stay small.
                let sign = if sign == "**" { "*" } else { sign };
                if sign == "/" && !self.dice.once_in(8) {
                    return format!("({one})/(0.5+ABSF({other}))");
                }
                format!("({one}){sign}({other})")
            }
            5 => format!("-({})", self.number(scope, depth - 1)),
            6 => format!("({})**{}", self.number(scope, depth - 1), self.dice.below(4)),
            7 | 8 => self.function(scope, depth),
            9 if self.dice.once_in(12) => self.element(scope, depth),
            10 if scope.in_section => self.word(scope),
            10 | 11 => self.postf_value(scope, depth),
            12 => match self.dice.below(3) {
                0 if self.dice.once_in(40) => format!("ICODEF({})", self.dice.pick(WORDS)),
                1 => format!("LNTHF({})", self.text(1)),
                _ => format!("({})", self.condition(scope, 0)),
            },
            _ => self.unbracketed(scope),
        }
    }

    /// A chain without brackets, for the order of the operators.
    fn unbracketed(&mut self, scope: Scope) -> String {
        let mut chain = self.dice.pick(&["", "-", ""]).to_string() + &self.name(scope);
        for _ in 0..1 + self.dice.below(4) {
            chain += self.dice.pick(OPERATORS);
            let small = self.dice.below(3).to_string();
            chain += &if chain.ends_with("**") { small } else { self.name(scope) };
        }
        chain
    }

    /// Mostly within the domain of the function.
    fn function(&mut self, scope: Scope, depth: usize) -> String {
        let (name, count) = FUNCTIONS[self.dice.below(FUNCTIONS.len())];
        let careful = !self.dice.once_in(30);
        let argument = |this: &mut Self| match name {
            "SQRTF" if careful => format!("ABSF({})", this.number(scope, depth - 1)),
            "LOGF" | "LOG10F" if careful => format!("1+ABSF({})", this.number(scope, depth - 1)),
            "EXPF" if careful => format!("MINF({},20)", this.number(scope, depth - 1)),
            "ASINF" | "ACOSF" if careful => format!("SINF({})", this.number(scope, depth - 1)),
            _ => this.number(scope, depth - 1),
        };
        let arguments: Vec<String> = (0..count).map(|_| argument(self)).collect();
        format!("{name}({})", arguments.join(","))
    }

    /// An element of an array; seldom one that is not there.
    pub(super) fn element(&mut self, scope: Scope, depth: usize) -> String {
        let (name, size) = ARRAYS[self.dice.below(ARRAYS.len())];
        let index = match self.dice.below(12) {
            0 if self.dice.once_in(6) => self.number(scope, depth.saturating_sub(1)),
            1 => format!("1+ABSF(INTF(MODF({},{size})))", self.name(scope)),
            _ => (1 + self.dice.below(size)).to_string(),
        };
        format!("{name}({index})")
    }

    /// A number out of the current record.
    fn word(&mut self, scope: Scope) -> String {
        match self.dice.below(8) {
            0 => "POSTF(5)".to_string(),
            1 => format!("POSTF(6,{})", 1 + self.dice.below(9)),
            2 => {
                let word = self.dice.pick(WORDS);
                format!("POSTF(9,{},ICODEF({word}))", 1 + self.dice.below(7))
            }
            3 if self.dice.once_in(6) => format!("POSTF(7,{})", self.number(scope, 1)),
            4 if self.dice.once_in(6) => format!("POSTF(7,{})", 1 + self.dice.below(9)),
            _ => format!("POSTF(7,{})", 1 + self.dice.below(2)),
        }
    }

    fn postf_value(&mut self, scope: Scope, depth: usize) -> String {
        match self.dice.below(4) {
            0 if self.dice.once_in(40) => "POSTF(4)".to_string(),
            1 if self.dice.once_in(40) => {
                format!("POSTF(1,{},486)", self.number(scope, depth - 1))
            }
            _ => format!("POSTF(1,{},{})", 1 + self.dice.below(3), 480 + self.dice.below(4)),
        }
    }

    /// A value that is 0 or 1.
    pub(super) fn condition(&mut self, scope: Scope, depth: usize) -> String {
        if depth > 0 {
            let (one, other) = (self.condition(scope, depth - 1), self.condition(scope, depth - 1));
            match self.dice.below(6) {
                0 => return format!("{one}.AND.{other}"),
                1 => return format!("{one}.OR.{other}"),
                2 => return format!(".NOT.({one})"),
                3 => return format!("({one}).AND.({other})"),
                _ => {}
            }
        }
        let relation = self.dice.pick(RELATIONS);
        match self.dice.below(16) {
            0 => format!("{}{relation}{}", self.text(0), self.text(1)),
            1 if self.dice.once_in(12) => self.name(scope) + ".EQ." + &self.text(0),
            2 if self.dice.once_in(10) => self.name(scope),
            3 => format!("{}.EQ.POSTF(4)", self.name(scope)),
            4 if scope.in_section => {
                let word = self.dice.pick(WORDS);
                format!("POSTF(7,{}){relation}ICODEF({word})", 3 + self.dice.below(5))
            }
            5 => format!(
                "POSTF(1,{},{}){relation}POSTF(4)",
                1 + self.dice.below(3),
                480 + self.dice.below(4)
            ),
            _ => format!("{}{relation}{}", self.number(scope, 1), self.number(scope, 1)),
        }
    }

    /// A text.
    pub(super) fn text(&mut self, depth: usize) -> String {
        if depth > 0 && self.dice.once_in(2) {
            return self.dice.pick(TEXTS).to_string();
        }
        self.dice.pick(&["'A'", "'AB'", "''", "'IT''S'", "'$$ ;'", "'ÄЖ'", "'DRILL'"]).to_string()
    }

    /// A number or a text, for places that take both.
    pub(super) fn either(&mut self, scope: Scope) -> String {
        match self.dice.below(4) {
            0 => self.text(1),
            1 => self.dice.pick(NUMBERS).to_string(),
            _ => self.number(scope, 1),
        }
    }
}
