//! Statements, plain and with blocks.

use super::{NUMBERS, Program, Scope, TEXTS, WORDS};

const LETTERS: &[&str] = &["G", "X", "Y", "Z", "F", "C", "24"];

impl Program<'_, '_> {
    /// Up to `most` statements, and no more than are left.
    pub(super) fn statements(&mut self, scope: Scope, most: usize) {
        for _ in 0..1 + self.dice.below(most) {
            if self.left == 0 {
                return;
            }
            self.left -= 1;
            self.statement(scope);
        }
    }

    fn statement(&mut self, scope: Scope) {
        let deeper = Scope { depth: scope.depth + 1, ..scope };
        if scope.depth < 4 {
            match self.dice.below(20) {
                0 | 1 => return self.if_block(deeper),
                2 | 3 => return self.do_loop(deeper),
                4 => return self.case(deeper),
                5 => return self.jump_back(deeper),
                6 => return self.jump_on(deeper),
                7 => return self.if_sign(deeper),
                _ => {}
            }
        }
        let line = self.plain(scope);
        let line = match self.dice.below(12) {
            0 if !line.starts_with("IF") => format!("IF({}){line}", self.condition(scope, 1)),
            1 => format!("{line};{}", self.plain(scope)),
            _ => line,
        };
        self.line(&line);
    }

    /// A statement of one line.
    fn plain(&mut self, scope: Scope) -> String {
        match self.dice.below(22) {
            0 | 20 => self.output(scope),
            21 => self.call(scope),
            1 => self.post_word(scope),
            2 => self.call(scope),
            3 => format!("{}={}", self.element(scope, 1), self.number(scope, 2)),
            4 => self.text_statement(scope),
            5 | 6 => self.postf_action(scope),
            7 if scope.in_section => self.record_action(scope),
            7 | 8 => self.output(scope),
            9 if self.dice.once_in(6) => self.odd(scope),
            9 if !self.ahead.is_empty() => {
                let label = self.ahead[self.dice.below(self.ahead.len())].clone();
                format!("IF({})JUMPTO/{label}", self.condition(scope, 0))
            }
            _ => format!("{}={}", self.name(scope), self.number(scope, 3)),
        }
    }

    fn output(&mut self, scope: Scope) -> String {
        let mut line = "POSTN/OUT".to_string();
        for _ in 0..1 + self.dice.below(3) {
            let letter = self.dice.pick(LETTERS);
            let value = self.number(scope, 2);
            line += &format!(",{letter},{value}");
        }
        line
    }

    fn post_word(&mut self, scope: Scope) -> String {
        match self.dice.below(9) {
            0 => format!("SPINDL/RPM,{},CLW", self.number(scope, 1)),
            1 => "COOLNT/ON".to_string(),
            2 => "RAPID".to_string(),
            3 => format!("REPEAT/Z,{}", self.number(scope, 1)),
            4 => format!("CYCLE/{},DEPTH,{}", self.dice.pick(WORDS), self.number(scope, 1)),
            5 => format!("GOTO/{},2,{}", self.number(scope, 1), self.number(scope, 0)),
            6 => format!("PPRINT {}", self.dice.pick(&["MSG", "USE MSG NOW", "VA", "A=1, B"])),
            7 => format!("INSERT/'',{},{}", self.text(1), self.either(scope)),
            _ => format!("ENGRAV/WAVY,{}", self.either(scope)),
        }
    }

    /// A call of a macro made before this place.
    pub(super) fn call(&mut self, scope: Scope) -> String {
        let known = scope.in_macro.unwrap_or(self.macros.len());
        if known == 0 {
            return self.output(scope);
        }
        let number = self.dice.below(known);
        let by_name = self.dice.once_in(2);
        let mut line = format!("CALL/MAC{number}");
        for index in 0..self.macros[number] {
            let value = self.number(scope, 1);
            line +=
                &if by_name { format!(",P{number}{index}={value}") } else { format!(",{value}") };
        }
        line
    }

    fn text_statement(&mut self, scope: Scope) -> String {
        let name = self.dice.pick(TEXTS);
        match self.dice.below(3) {
            0 => format!("{name}={}", self.text(1)),
            _ => {
                // A text is made anew, or a loop would let it grow without end.
                let parts = [self.text(0), self.either(scope), self.text(0)];
                format!("{name}=TEXT/{}", parts.join(","))
            }
        }
    }

    fn postf_action(&mut self, scope: Scope) -> String {
        let (kind, location) = (1 + self.dice.below(3), 480 + self.dice.below(4));
        match self.dice.below(5) {
            0 => format!("DMY=POSTF(3,{kind},{location})"),
            1 => format!("DMY=POSTF(24,{})", self.dice.below(2)),
            2 => {
                format!("DMY=POSTF(2,{kind},355+{},{})", self.dice.pick(LETTERS), self.name(scope))
            }
            _ => format!("DMY=POSTF(2,{kind},{location},{})", self.number(scope, 2)),
        }
    }

    fn record_action(&mut self, scope: Scope) -> String {
        match self.dice.below(10) {
            0 | 1 => "DMY=POSTF(13)".to_string(),
            2 | 3 => format!("{}=POSTF(14)", self.name(scope)),
            4 => "DMY=POSTF(20)".to_string(),
            5 => "DMY=POSTF(21)".to_string(),
            6 => "DMY=POSTF(20);S1=POSTF(14);DMY=POSTF(21)".to_string(),
            7 => {
                let word = self.dice.pick(WORDS);
                format!("DMY=POSTF(8,{},ICODEF({word}))", 4 + self.dice.below(3))
            }
            8 => format!("DMY=POSTF(8,{},{})", 4 + self.dice.below(5), self.either(scope)),
            _ => format!("DMY=POSTF(8,{},{})", 4 + self.dice.below(5), self.number(scope, 2)),
        }
    }

    /// What a script seldom does.
    fn odd(&mut self, scope: Scope) -> String {
        match self.dice.below(16) {
            0 => format!("{}={}", self.dice.pick(&["A", "F", "X"]), self.number(scope, 1)),
            1 => format!("{}={}", self.name(scope), self.text(1)),
            2 => format!("{}={}", self.dice.pick(TEXTS), self.number(scope, 1)),
            3 => format!("VA={}/0", self.name(scope)),
            4 => format!("VB=POSTF({})", self.name(scope)),
            5 => format!("DMY=POSTF(2,{},{},1)", self.number(scope, 1), self.number(scope, 1)),
            6 => format!("VC={}", self.condition(scope, 2)),
            7 => "PRINT/OFF,IN".to_string(),
            9 => format!("AR({})={}", 1 + self.dice.below(5), self.text(1)),
            8 => "CONTIN".to_string(),
            _ => format!("{}={}", self.name(scope), self.name(scope)),
        }
    }

    fn if_block(&mut self, scope: Scope) {
        let condition = self.condition(scope, 2);
        self.line(&format!("IF({condition})THEN"));
        self.statements(scope, 3);
        for _ in 0..self.dice.below(3) {
            let condition = self.condition(scope, 1);
            self.line(&format!("ELSEIF({condition})THEN"));
            self.statements(scope, 3);
        }
        if self.dice.once_in(2) {
            self.line("ELSE");
            self.statements(scope, 3);
        }
        self.line("ENDIF");
    }

    fn case(&mut self, scope: Scope) {
        let of_texts = self.dice.once_in(3);
        let value = |this: &mut Self| match (of_texts, this.dice.once_in(40)) {
            (_, true) => this.either(scope),
            (true, _) => this.text(1),
            (false, _) => this.number(scope, 1),
        };
        let subject = value(self);
        self.line(&format!("CASE/{subject}"));
        for _ in 0..self.dice.below(4) {
            let values: Vec<String> = (0..1 + self.dice.below(2)).map(|_| value(self)).collect();
            self.line(&format!("WHEN/{}", values.join(",")));
            self.statements(scope, 2);
        }
        if self.dice.once_in(2) {
            self.line("WHEN/OTHER");
            self.statements(scope, 2);
        }
        self.line("ENDCAS");
    }

    /// A loop over a variable of its own or, seldom, over one that others set.
    fn do_loop(&mut self, scope: Scope) {
        let label = self.label();
        self.loops += 1;
        let own = format!("K{}", self.loops);
        let variable = if self.dice.once_in(8) { self.name(scope) } else { own };
        let (from, to) = (self.dice.below(4), self.dice.below(6));
        let head = match self.dice.below(12) {
            0 => format!("{from},{to},{}", self.number(scope, 1)),
            1 => format!("{to},{from},-1"),
            2 => format!("{from},{to},0.{}", 3 + self.dice.below(6)),
            3 => format!("{},{},2", self.number(scope, 0), self.number(scope, 0)),
            4 => format!("{from},{variable}"),
            _ => format!("{from},{to}"),
        };
        self.line(&format!("DO/{label},{variable}={head}"));
        self.ahead.push(label.clone());
        self.statements(scope, 3);
        self.ahead.pop();
        if self.dice.once_in(5) {
            let condition = self.condition(scope, 0);
            self.line(&format!("IF({condition})JUMPTO/{label}"));
            self.statements(scope, 2);
        }
        if self.dice.once_in(3) {
            let value = self.number(scope, 1);
            let name = self.dice.pick(NUMBERS);
            self.line(&format!("{label}) {name}={value}"));
        } else {
            self.line(&format!("{label}) CONTIN"));
        }
        self.loops -= 1;
    }

    /// A loop of jumps that a counter ends; seldom one that has no end.
    fn jump_back(&mut self, scope: Scope) {
        let label = self.label();
        let counter = format!("C{}", self.labels);
        let passes = 1 + self.dice.below(4);
        self.line(&format!("{counter}=0"));
        self.line(&format!("{label}) {counter}={counter}+1"));
        self.statements(scope, 3);
        let end =
            if self.dice.once_in(40) { "0.EQ.0".into() } else { format!("{counter}.LT.{passes}") };
        self.line(&format!("IF({end})JUMPTO/{label}"));
    }

    fn jump_on(&mut self, scope: Scope) {
        let label = self.label();
        let condition = self.condition(scope, 1);
        self.line(&format!("IF({condition})JUMPTO/{label}"));
        self.ahead.push(label.clone());
        self.statements(scope, 2);
        self.ahead.pop();
        if self.dice.once_in(3) {
            return self.label_in_block(scope, &label);
        }
        self.line(&format!("{label}) CONTIN"));
    }

    /// The label stands inside of an IF, which the jump enters without its test.
    fn label_in_block(&mut self, scope: Scope, label: &str) {
        let condition = self.condition(scope, 1);
        self.line(&format!("IF({condition})THEN"));
        self.statements(scope, 2);
        let line = self.plain(scope);
        self.line(&format!("{label}) {line}"));
        self.line("ELSE");
        self.statements(scope, 2);
        self.line("ENDIF");
    }

    fn if_sign(&mut self, scope: Scope) {
        let (minus, zero, plus) = (self.label(), self.label(), self.label());
        let value = self.number(scope, 1);
        self.line(&format!("IF({value}) {minus},{zero},{plus}"));
        for label in [minus, zero, plus] {
            self.line(&format!("{label}) CONTIN"));
            self.statements(scope, 2);
        }
    }
}
