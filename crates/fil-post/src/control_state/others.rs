//! What the control knows behind words and texts that the post has not made: POSTN, PREFUN
//! and AUXFUN, INSERT, the machine's own texts.

use fil_machine::functions::{Origin, WorkPlane};
use fil_machine::modes::Unit;
use fil_machine::{FunctionCode, Letter, letters};

use super::foreign::{ForeignBlock, TextFrame};
use super::modal::{
    CYCLE, DISTANCE, LENGTH, LENGTH_OFFSET, MOTION, NAMED_TOOL, PLANE, SPINDLE, TOOL, TOOL_CHANGED,
    TOOL_WORD, UNITS, WORK_OFFSET, WORK_PLANE,
};
use super::{AXIS_LETTERS, Codes, ControlState, Distance, Length, Meaning, Rotation, Source};

/// What preparatory functions of others do to where the axes stand.
#[derive(Clone, Copy, Debug, Default)]
struct Ways {
    /// The axes of the block go to positions of the machine, such as G53.
    of_machine: bool,
    /// They go to a reference point, without words all of them, such as G28.
    home: bool,
    /// The zero is another one.
    zero: Zero,
    /// The words of the block say it, such as those of G92.
    says_zero: bool,
    /// The length of the tool is another one.
    length: bool,
    /// They go by a way of their own.
    astray: bool,
    /// They come back from it to where they began, as from a turning cycle.
    returns: bool,
    /// How the coordinates may have been turned, against those before.
    turns: WorkPlane,
    /// The words of the block are no positions, such as those of G4 and of G71 of an OSP.
    pauses: bool,
    /// The tool is changed.
    changes: bool,
}

/// Which axes count from another zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
enum Zero {
    /// None.
    #[default]
    Kept,
    /// Those that the block names, all where it names none: G92 X0.
    OfWords,
    /// All: G55.
    Other,
}

impl Ways {
    fn of(words: &[(Letter, f64)], codes: &Codes, state: &ControlState) -> Self {
        let (in_force, plane) = (state.get(WORK_OFFSET), state.get(WORK_PLANE));
        let mut ways = Ways::default();
        for (letter, value) in words {
            match (*letter, FunctionCode::of_value(*value)) {
                (letters::G, Some(code)) => {
                    let offset = codes.work_offset(code, |letter| word(words, letter));
                    if offset.is_none() || offset != in_force {
                        ways.add(code, codes);
                        ways.add_turn(codes.turned(code, plane, |letter| word(words, letter)));
                    }
                }
                (letters::M, Some(code)) => ways.changes |= codes.does(code, Meaning::ToolChange),
                (letters::T, _) => ways.changes |= codes.tool_word_changes,
                _ => {}
            }
        }
        if codes.places_zero(words) {
            (ways.zero, ways.says_zero) = (Zero::OfWords, true);
        }
        ways
    }

    fn add(&mut self, code: FunctionCode, codes: &Codes) {
        match codes.meaning(code) {
            Meaning::Origin(origin) => {
                self.home |= origin == Origin::Home;
                self.of_machine |= origin.is_of_machine();
                if !self.of_machine {
                    let zero = if origin.is_of_its_words() { Zero::OfWords } else { Zero::Other };
                    self.zero = if zero > self.zero { zero } else { self.zero };
                }
                self.says_zero |= !self.of_machine && !origin.is_offset();
            }
            Meaning::LengthOffset(_) => self.length = true,
            Meaning::Tcpc => self.turns = WorkPlane::Tilted,
            Meaning::TurningCycle => (self.astray, self.returns) = (true, true),
            Meaning::Dwell | Meaning::ReturnLevel => self.pauses = true,
            _ => {}
        }
    }

    fn add_turn(&mut self, turned: Option<WorkPlane>) {
        if let Some(turned) = turned.filter(|turned| *turned != WorkPlane::Off) {
            self.turns = turned;
        }
    }
}

/// The value of the last word with a letter.
fn word(words: &[(Letter, f64)], letter: Letter) -> Option<f64> {
    words.iter().rev().find(|word| word.0 == letter).map(|word| word.1)
}

fn is_axis(letter: Letter) -> bool {
    AXIS_LETTERS.contains(&letter)
}

impl ControlState {
    /// Learns from words that were written one after the other (POSTN). In a cycle they
    /// may have changed its data.
    pub fn learn_words(&mut self, words: &[(Letter, f64)], codes: &Codes) {
        let cycle = !self.is(CYCLE, false);
        let by_letter = |state: &mut Self, letter| match cycle {
            true => state.doubt(letter),
            false => state.trust(letter),
        };
        let ways = self.learn_functions(words, codes, by_letter);
        let has = |letters: &[u8]| words.iter().any(|(letter, _)| letters.contains(&letter.byte()));
        self.learn_ways(words, ways, codes);
        if ways.length {
            // A position beside the code of a length offset counts with the new length.
            let axes = words.iter().filter(|(letter, _)| is_axis(*letter));
            axes.for_each(|(letter, _)| self.trust(*letter));
        }
        let cycle = cycle || !self.is(CYCLE, false);
        // In a cycle a position drills, and its level can be one too.
        let drills = cycle && has(b"XYZABCR");
        let counts_on = !self.is(DISTANCE, Distance::Absolute);
        let moves = words.iter().any(|(letter, _)| is_axis(*letter)) && !ways.of_machine;
        if drills || has(b"UVW") && !ways.home || counts_on && moves {
            self.lose_axes();
        } else if counts_on {
            self.doubt_axes();
        }
    }

    /// Learns what the functions of words do, tools and lengths among them; `by_letter` what other
    /// words do.
    fn learn_functions(
        &mut self,
        words: &[(Letter, f64)],
        codes: &Codes,
        by_letter: impl Fn(&mut Self, Letter),
    ) -> Ways {
        let ways = Ways::of(words, codes, self);
        for (letter, value) in words {
            match (*letter, FunctionCode::of_value(*value)) {
                (letters::G, Some(code)) => {
                    let word = |letter| word(words, letter);
                    self.learn_code(code, codes, Source::Author, word);
                }
                (letters::M, Some(code)) => {
                    let word = |letter| word(words, letter);
                    self.learn_auxiliary(code, codes, Source::Author, word);
                }
                (letters::G | letters::M, None) => self.doubt_all(Source::Author),
                (letters::T, _) => self.names_tool(*value, codes),
                (letters::H, _) => self.names_length(*value, ways.length),
                (letter, _) => by_letter(self, letter),
            }
        }
        ways
    }

    /// Learns from a block of the post that was edited, and has no functions but its own; `made` is
    /// what the post had made of it. In a cycle other words may have changed its data.
    pub fn learn_own_words(
        &mut self,
        words: &[(Letter, f64)],
        made: &[(Letter, f64)],
        codes: &Codes,
    ) {
        let cycle = !self.is(CYCLE, false);
        let of = |kind: Letter| {
            let words = words.iter().filter(move |(letter, _)| *letter == kind);
            words.filter_map(|(_, value)| FunctionCode::of_value(*value))
        };
        let word = |letter| word(words, letter);
        of(letters::G).for_each(|code| self.learn_code(code, codes, Source::Author, word));
        of(letters::M).for_each(|code| self.learn_auxiliary(code, codes, Source::Author, word));
        let calls = of(letters::G)
            .any(|code| matches!(codes.meaning(code), Meaning::LengthOffset(_) | Meaning::Tcpc));
        for word in words.iter().filter(|(letter, _)| !matches!(*letter, letters::G | letters::M)) {
            match word.0 {
                letters::H if !made.contains(word) => self.names_length(word.1, calls),
                letter if cycle && !made.contains(word) => self.doubt(letter),
                letter => self.trust(letter),
            }
        }
        if !self.is(DISTANCE, Distance::Absolute) {
            self.doubt_axes();
        }
    }

    /// Learns from the words of a text that was read whole. `unit` is that of the program.
    pub fn learn_text(&mut self, block: &ForeignBlock, codes: &Codes, unit: Option<Unit>) {
        let words = &block.words;
        let before = block.skipped.then(|| self.clone());
        if block.calls_subprogram() {
            self.doubt_all(Source::Author);
        }
        let in_cycle = self.get(CYCLE);
        let mut ways = self.learn_functions(words, codes, |state, letter| match is_axis(letter) {
            true => state.doubt_axes(),
            false => state.doubt(letter),
        });
        match block.frame {
            TextFrame::Stays => {}
            TextFrame::OfTheMachine => ways.of_machine = true,
            TextFrame::Shifted => (ways.zero, ways.says_zero) = (Zero::Other, true),
            TextFrame::Turned => ways.turns = WorkPlane::Tilted,
            TextFrame::Unread => ways.astray = true,
        }
        self.learn_ways(words, ways, codes);
        let turns = ways.turns != WorkPlane::Off;
        let is_motion = !(ways.of_machine || ways.says_zero || turns || ways.astray || ways.pauses);
        let is_level_or_code =
            |(letter, _): &(Letter, f64)| matches!(*letter, letters::R | letters::G);
        // Behind a hole more the tool comes back to the level that it came from.
        let is_hole = in_cycle == Some(true) && !words.iter().any(is_level_or_code);
        if is_motion && !is_hole && words.iter().any(|(letter, _)| is_axis(*letter)) {
            let drills = in_cycle != Some(false) || !self.is(CYCLE, false);
            let is_read = !drills && unit.is_some() && self.get(UNITS) == unit;
            self.learn_motion(words, is_read);
        }
        if let Some(before) = before {
            self.agree_with(&before);
            if words.iter().any(|(letter, _)| is_axis(*letter)) {
                self.lose_axes();
            }
        }
    }

    /// A block has changed the tool, as `[effects]` says: to the one of a number, or to the last
    /// one that was named. Its length is called with the next motion.
    pub fn learn_said_change(&mut self, tool: Option<f64>, codes: &Codes) {
        if let Some(tool) = tool {
            self.names_tool(tool, codes);
        }
        let named = self.get(NAMED_TOOL);
        self.has_tool(None);
        self.set(SPINDLE, Rotation::Standing);
        self.set(TOOL_CHANGED, true);
        self.forget(MOTION, Source::Author);
        if codes.calls_lengths {
            self.set(LENGTH, Length::Ended);
            self.groups.set_if_known(LENGTH_OFFSET, named, Source::Author);
        }
    }

    /// A block may have changed modes, and moved no axis.
    pub fn keeps_position(&mut self) {
        self.groups.doubt_all(Source::Author);
        self.doubts.add_all();
    }

    /// A word names a tool.
    fn names_tool(&mut self, value: f64, codes: &Codes) {
        self.groups.doubt(TOOL);
        let named = (!codes.tool_word_has_offset && value.fract() == 0.0).then_some(value as i64);
        self.groups.set_if_known(NAMED_TOOL, named, Source::Author);
        if codes.tool_word_has_offset {
            self.length_by_tool_word(value);
        }
        if codes.tool_word_changes {
            self.set(TOOL_WORD, true);
        }
    }

    /// Learns where a text has brought the axes; positions that count otherwise than those of
    /// the post are not read.
    fn learn_motion(&mut self, words: &[(Letter, f64)], is_read: bool) {
        let counts = self.is(DISTANCE, Distance::Absolute) && self.get(MOTION).is_some();
        let is_incremental = words.iter().any(|(letter, _)| b"UVW".contains(&letter.byte()));
        if !(is_read && counts) || is_incremental {
            return self.lose_axes();
        }
        for (letter, value) in words.iter().filter(|(letter, _)| is_axis(*letter)) {
            self.stand(*letter, *value);
        }
    }

    /// Learns where functions leave the axes.
    fn learn_ways(&mut self, words: &[(Letter, f64)], ways: Ways, codes: &Codes) {
        let named = || words.iter().map(|(letter, _)| *letter).filter(|letter| is_axis(*letter));
        if ways.of_machine {
            self.doubt_axes();
            if ways.home && named().next().is_none() {
                self.lose_axes();
            }
            let counts = self.is(DISTANCE, Distance::Absolute);
            for word in words.iter().filter(|(letter, _)| is_axis(*letter)) {
                self.clears(codes.moved_by(word.0), codes.machine_spot(words, word.1, counts));
            }
        } else if ways.astray {
            self.lose_axes();
            self.doubts.returned = ways.returns;
        } else if ways.turns == WorkPlane::Tilted {
            self.turn_axes(AXIS_LETTERS);
            self.forget(WORK_PLANE, Source::Author);
        } else if ways.turns == WorkPlane::Rotated {
            let plane = self.get(PLANE).map(|plane| plane.axes().map(|axis| letters::XYZ[axis]));
            let turned = plane.as_ref().map_or(&letters::XYZ[..], |axes| &axes[..]);
            let is_turned =
                |letter: &Letter| turned.contains(letter) || named().any(|named| named == *letter);
            self.turn_axes(AXIS_LETTERS.into_iter().filter(is_turned));
        } else if ways.zero != Zero::Kept {
            let is_all = ways.zero == Zero::Other || named().next().is_none();
            let has_another =
                |letter: &Letter| is_all || named().any(|named| codes.moved_by(named) == *letter);
            let axes = AXIS_LETTERS.into_iter().filter(has_another);
            axes.for_each(|letter| self.shifts(letter, Source::Author));
        } else if ways.length {
            self.tool_length_changes();
        }
        if ways.changes {
            AXIS_LETTERS.into_iter().for_each(|letter| self.tool_change_moves(letter));
            if !ways.length {
                self.length_is_of_another_tool(codes);
            }
        } else if ways.of_machine {
            let all = ways.home && named().next().is_none();
            let moves = |axis| all || named().any(|letter| codes.moved_by(letter) == axis);
            self.length_ends_at_machine(codes, moves);
        }
    }
}
