//! Random FIL programs and CL files for them: mostly well typed, with loops
//! that mostly end.

mod dice;
mod expressions;
mod records;
mod statements;

pub use dice::Dice;

use std::fmt::Write;

/// A FIL program and the CL file to run it on.
#[derive(Clone, Debug)]
pub struct Case {
    /// FIL text.
    pub fil: String,
    /// CL text.
    pub cl: String,
}

/// Names that hold numbers. Not all of them are set in every program.
const NUMBERS: &[&str] = &["VA", "VB", "VC", "VD", "SUM", "FEED1", "Q2", "N"];
/// Names that hold texts.
const TEXTS: &[&str] = &["TA", "TB", "MSG"];
/// Arrays and their sizes.
const ARRAYS: &[(&str, usize)] = &[("AR", 5), ("BR", 2)];
/// Vocabulary words, those of users among them.
const WORDS: &[&str] =
    &["DRILL", "DEEP", "TAP", "DEPTH", "RPM", "CLW", "CCLW", "ON", "OFF", "MILL", "TURN", "WAVY"];
/// Keys of sections; a program takes each at most once, and of those in one
/// row, which name the same records, only one. Those for many records come first.
const KEYS: &[&[&str]] = &[
    &["GOTO", "5000,5"],
    &["2000"],
    &["CYCLE"],
    &["FINI", "14000"],
    &["5000"],
    &["SPINDL", "2000,1031"],
    &["FROM", "5000,3"],
    &["CYCLE,DEEP"],
    &["CYCLE,DRILL,DEPTH"],
    &["SPINDL,RPM"],
    &["COOLNT"],
    &["FEDRAT"],
    &["RAPID"],
    &["MODE"],
    &["ENGRAV"],
    &["ENGRAV,WAVY"],
];

/// Makes a case.
pub fn case(dice: &mut Dice<'_>) -> Case {
    Case { fil: Program::new(dice).write(), cl: records::file(dice) }
}

/// What a place in a program may hold.
#[derive(Clone, Copy)]
struct Scope {
    /// A CL record is there.
    in_section: bool,
    /// Number of the macro around it; a macro calls only those before it.
    in_macro: Option<usize>,
    /// How deep blocks are nested.
    depth: usize,
}

/// A program in the making.
struct Program<'d, 'b> {
    dice: &'d mut Dice<'b>,
    out: String,
    labels: usize,
    /// Number of parameters of each macro so far.
    macros: Vec<usize>,
    /// Loop variables in use, innermost last: a body seldom sets them.
    loops: usize,
    /// Labels further on that a jump may lead to, innermost last.
    ahead: Vec<String>,
    /// Statements that may still be written.
    left: usize,
}

impl<'d, 'b> Program<'d, 'b> {
    fn new(dice: &'d mut Dice<'b>) -> Self {
        let left = 10 + dice.below(60);
        Program {
            dice,
            out: String::new(),
            labels: 0,
            macros: Vec::new(),
            loops: 0,
            ahead: Vec::new(),
            left,
        }
    }

    fn write(mut self) -> String {
        self.line("REDEF/ON");
        let arrays: Vec<String> =
            ARRAYS.iter().map(|(name, size)| format!("{name},{size}")).collect();
        self.line(&format!("RESERV/{}", arrays.join(",")));
        for _ in 0..self.dice.below(4) {
            self.macro_definition();
        }
        let globals = Scope { in_section: false, in_macro: None, depth: 0 };
        self.preset();
        self.statements(globals, 8);
        for _ in 0..self.macros.len() {
            let line = self.call(globals);
            self.line(&line);
        }
        let mut keys = KEYS.to_vec();
        for _ in 0..2 + self.dice.below(4) {
            let row = keys.remove(self.dice.below(keys.len()).min(self.dice.below(keys.len())));
            let key = self.dice.pick(row);
            self.line(&format!("CIMFIL/ON,{key}"));
            self.statements(Scope { in_section: true, ..globals }, 10);
            if self.dice.once_in(2) {
                self.line("DMY=POSTF(13)");
            }
            self.line("CIMFIL/OFF");
        }
        self.line("FINI");
        self.out
    }

    /// Gives most names a value, so that few are EMPTY.
    fn preset(&mut self) {
        for name in NUMBERS {
            if !self.dice.once_in(40) {
                let value = self.literal();
                self.line(&format!("{name}={value}"));
            }
        }
        for name in TEXTS {
            let text = self.text(0);
            self.line(&format!("{name}={text}"));
        }
    }

    /// Parameters with a number in their name belong to one macro only.
    fn macro_definition(&mut self) {
        let number = self.macros.len();
        let count = self.dice.below(4);
        let mut head = format!("MAC{number}=MACRO");
        for index in 0..count {
            let separator = if index == 0 { '/' } else { ',' };
            let _ = write!(head, "{separator}P{number}{index}");
            if !self.dice.once_in(12) {
                let default = self.literal();
                let _ = write!(head, "={default}");
            }
        }
        self.line(&head);
        self.macros.push(count);
        // A macro that looks at the record is an error where it is called without one.
        let in_section = self.dice.once_in(16);
        // The macros must not use up what the program may have.
        let left = std::mem::replace(&mut self.left, 5);
        self.statements(Scope { in_section, in_macro: Some(number), depth: 1 }, 4);
        self.left = left;
        self.line("TERMAC");
    }

    /// The names of numbers that can be read and set here.
    fn name(&mut self, scope: Scope) -> String {
        if let Some(number) = scope.in_macro {
            let count = self.macros[number];
            if count > 0 && self.dice.once_in(2) {
                return format!("P{number}{}", self.dice.below(count));
            }
        }
        self.dice.pick(NUMBERS).to_string()
    }

    fn label(&mut self) -> String {
        self.labels += 1;
        format!("L{}", self.labels)
    }

    /// Writes a line; now and then two statements share one.
    fn line(&mut self, text: &str) {
        self.out.push_str(text);
        self.out.push('\n');
    }
}
