//! One block: modes first, then tool and spindle, then the motion.

use fil_machine::effects::Effect;

use super::Fault;
use super::left_to_control::Uses;
use super::modes::H;
use super::state::State;
use super::words::{AxisWord, Words, letter};
use crate::dialect::{Amount, Auxiliary, FeedMode, Function, Group, Role};
use crate::errors::NcCode;
use crate::motion::{Course, Event, Modes};
use crate::text::Block;

const P: u8 = letter(b'P');
const L: u8 = letter(b'L');
const F: u8 = letter(b'F');

/// The word of rapids may be off by this, which is rounding.
const RAPID_WORD: f64 = 1e-3;

/// What a block asks of the order of blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The next one.
    Next,
    /// The program ends, by the auxiliary function of this number.
    End(u32),
    /// A subprogram.
    Call {
        /// Its number.
        number: i64,
        /// How often.
        times: u32,
    },
    /// The end of the subprogram.
    Back,
}

impl State<'_> {
    /// Runs a block; what it does is in [`State::events`].
    pub(super) fn run(&mut self, block: &Block) -> Result<Outcome, Fault> {
        self.line = block.line;
        self.events.clear();
        let text = || {
            let words = block.words.iter().filter(|word| word.letter != b'N');
            words
                .map(|word| format!("{}{}", char::from(word.letter), word.number.value()))
                .collect()
        };
        if self.is_of_others(text) {
            return Ok(Outcome::Next);
        }
        let mut words = std::mem::take(&mut self.words);
        words.read(block, self.dialect, self.metric)?;
        let outcome = self.follow(&mut words)?;
        // The next block uses its memory again.
        self.words = words;
        Ok(outcome)
    }

    /// A block whose effect the machine states, and which leaves the axes where they are. Behind one
    /// that may change modes none is certain.
    pub(super) fn is_of_others(&mut self, block: impl FnOnce() -> String) -> bool {
        let effect = self.dialect.effect(block);
        if effect == Some(Effect::KeepsPosition) {
            self.certain = self.dialect.start.behind_others;
            self.motion = None;
        }
        matches!(effect, Some(Effect::Nothing | Effect::KeepsPosition))
    }

    fn follow(&mut self, words: &mut Words) -> Result<Outcome, Fault> {
        if self.tilted_block(words)? || self.interpolation_block(words)? {
            return Ok(Outcome::Next);
        }
        let outcome = self.outcome(words)?;
        self.check_tip_control(words)?;
        self.check_tilt(words)?;
        let begins = matches!(
            words.peek(Group::Length),
            Some(Function::TipControl | Function::TipControlByDirection)
        );
        let (stood, known) = (self.at, self.known);
        let uses = Uses::of(words, self.dialect);
        self.check_live_words(words)?;
        self.modes(words)?;
        self.tool_and_spindle(words)?;
        self.auxiliaries(words);
        self.check_live(words)?;
        self.motion(words)?;
        // Away from the part either way round leads to the same place.
        let turns_alone = self.motion == Some(Function::Rapid) && stood[..3] == self.at[..3];
        if !turns_alone {
            self.check_ways_round(&stood, &known)?;
        }
        if begins {
            self.check_begun(&stood, &known)?;
        }
        words.finish()?;
        if !self.certain.all() {
            self.tell_left_to_control(uses);
        }
        if let Outcome::End(code) = outcome {
            self.end(code);
        }
        Ok(outcome)
    }

    /// The program ends by a code.
    pub(super) fn end(&mut self, code: u32) {
        let modes = Modes { cycle: self.cycle.active.is_some(), ..self.modes };
        self.events.push(Event::End { line: self.line, code: Some(code), modes });
    }

    /// End, call and return.
    fn outcome(&self, words: &mut Words) -> Result<Outcome, Fault> {
        let mut outcome = Outcome::Next;
        for (auxiliary, range) in words.auxiliaries.clone() {
            let asked = match auxiliary {
                Auxiliary::End(code) => Outcome::End(code),
                Auxiliary::Back => Outcome::Back,
                Auxiliary::Call => call(words)?,
                _ => continue,
            };
            if outcome != Outcome::Next {
                let message = "two M words that steer the program";
                return Err(Fault::new(NcCode::Twice, message).at(&range));
            }
            outcome = asked;
        }
        Ok(outcome)
    }

    fn motion(&mut self, words: &mut Words) -> Result<(), Fault> {
        match words.peek(Group::Once) {
            Some(Function::Dwell) => {
                words.function(Group::Once);
                self.dwell(words)?;
            }
            Some(Function::Reference) => {
                words.function(Group::Once);
                return self.reference(words);
            }
            Some(Function::NumberedReference) => {
                words.function(Group::Once);
                check_point(words)?;
                return self.reference(words);
            }
            Some(Function::MachineFrame | Function::EndOfTravel) => {
                if words.function(Group::Once) == Some(Function::EndOfTravel) {
                    check_machine_zero(words)?;
                }
                if self.take_motion(words)?.is_some() {
                    return Err(Fault::new(NcCode::Twice, "a cycle in the machine frame"));
                }
                return self.machine_frame(words);
            }
            Some(Function::ReturnTo) => {
                words.function(Group::Once);
                return self.return_level(words);
            }
            Some(Function::ThreadPasses) => {
                words.function(Group::Once);
                self.motion = None;
                return self.thread_passes(words);
            }
            Some(Function::ThreadPassesByPitch) => {
                words.function(Group::Once);
                self.motion = None;
                return self.thread_by_pitch(words);
            }
            Some(Function::ThreadPassesByHeight) => {
                words.function(Group::Once);
                self.motion = None;
                return self.thread_by_height(words);
            }
            _ => {}
        }
        match self.take_motion(words)? {
            Some(Function::Cycle(kind, dwells)) => return self.begin_cycle(kind, dwells, words),
            Some(Function::LiveCycle { side, kind }) => {
                return self.begin_live_cycle(side, kind, words);
            }
            _ => {}
        }
        if self.cycle.active.is_some() && (words.has_axes(self.dialect) || words.has(letter(b'R')))
        {
            return self.hole(words);
        }
        let arc = matches!(self.motion, Some(Function::Arc { .. }));
        let center = [b'I', b'J', b'K'].map(letter).iter().any(|letter| words.has(*letter));
        let moves = words.has_axes(self.dialect) || (center && (arc || self.head.by_direction));
        if !moves {
            return self.feed_word(words);
        }
        if self.modes.frame.tip_control {
            self.check_tip_motion()?;
        }
        match self.motion {
            Some(Function::Thread) => self.thread(words),
            Some(Function::VaryingThread) => self.varying_thread(words),
            Some(Function::ThreadPass) => self.thread_pass(words),
            motion => {
                self.feed_word(words)?;
                match motion {
                    Some(Function::Rapid) => self.straight(words, Course::Rapid),
                    Some(Function::Linear) => self.straight(words, Course::Feed),
                    Some(Function::Arc { ccw }) => self.arc(words, ccw),
                    _ => Err(Fault::new(NcCode::NoMotion, "no G code for this axis move")),
                }
            }
        }
    }

    /// Takes up the motion function and the cycle function of a block. Says which
    /// cycle begins.
    fn take_motion(&mut self, words: &mut Words) -> Result<Option<Function>, Fault> {
        let motion = words.function(Group::Motion);
        let cycle = words.function(Group::Cycle);
        if motion.is_some() || cycle == Some(Function::CycleOff) {
            self.motion = motion;
            self.cycle.active = None;
            self.threads.pass = None;
        }
        match cycle {
            Some(Function::Cycle(..) | Function::LiveCycle { .. }) if motion.is_some() => {
                Err(Fault::new(NcCode::Twice, "a motion and a cycle in one block"))
            }
            Some(Function::Cycle(..) | Function::LiveCycle { .. }) => {
                self.motion = None;
                self.threads.pass = None;
                Ok(cycle)
            }
            _ => Ok(None),
        }
    }

    /// Takes up F.
    pub(super) fn feed_word(&mut self, words: &mut Words) -> Result<(), Fault> {
        if let Some(feed) = words.take(F)? {
            self.feed.word = Some(feed);
        } else if self.feed.mode == FeedMode::Inverse {
            self.feed.word = None;
        }
        Ok(())
    }

    fn straight(&mut self, words: &mut Words, course: Course) -> Result<(), Fault> {
        let rate = if course == Course::Feed { Some(self.rate()?) } else { None };
        if course == Course::Rapid
            && let Some((letter, value)) = self.dialect.forms.rapid_word
        {
            // F stands in the block or in one before it.
            let word = if letter == F { self.feed.word } else { words.take(letter)? };
            if word.is_none_or(|word| (word - value).abs() > RAPID_WORD) {
                let message = format!("a rapid needs its word of {value}");
                return Err(Fault::new(NcCode::MissingWord, message));
            }
        }
        let leans = self.direction_words(words)?;
        let axes = words.take_axes(self.dialect)?;
        let mut target = self.target(&axes);
        if let Some(angles) = leans {
            target.0[3..].copy_from_slice(&angles);
        }
        if self.dialect.turning.live_at_start.is_some() {
            let course = self.live_course(&target.0, course)?;
            self.go(target, course, rate.filter(|_| course == Course::Feed));
            return Ok(());
        }
        self.go(target, course, rate);
        Ok(())
    }

    /// To the reference point by way of the point that the block names.
    fn reference(&mut self, words: &mut Words) -> Result<(), Fault> {
        let axes = words.take_axes(self.dialect)?;
        if axes.is_empty() {
            return Err(Fault::new(NcCode::MissingWord, "the axes that go there are needed"));
        }
        self.cycle.active = None;
        let (between, known) = self.target(&axes);
        if between != self.at {
            self.go((between, known), Course::Rapid, None);
        }
        // The reference point is the zero of the machine.
        let named = axes.named();
        let mut to = between;
        (0..5).filter(|n| named[*n]).for_each(|n| to[n] = 0.0);
        self.go_to_machine(to, named);
        Ok(())
    }

    /// To a point of the machine frame.
    fn machine_frame(&mut self, words: &mut Words) -> Result<(), Fault> {
        if !self.absolute {
            let message = "the machine frame knows no increments";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        self.feed_word(words)?;
        let axes = words.take_axes(self.dialect)?;
        if axes.is_empty() {
            return Err(Fault::new(NcCode::MissingWord, "the axes that go there are needed"));
        }
        let (to, _) = self.target(&axes);
        self.go_to_machine(to, axes.named());
        Ok(())
    }

    /// `G4 X1.` waits seconds on controls whose own word for it counts milliseconds, and on
    /// lathes, where `G4 U1.` does too.
    fn dwell_by_x(&self, words: &mut Words) -> Result<Option<f64>, Fault> {
        let takes_x =
            self.dialect.counts_diameters() || self.dialect.factor(Amount::Dwell) == MILLISECONDS;
        let is_usual = words.has(self.dialect.letter(Role::Dwell));
        if is_usual || !takes_x || !words.has_axes(self.dialect) {
            return Ok(None);
        }
        match words.take_axes(self.dialect)?[..] {
            [AxisWord { axis: 0, value, .. }] => Ok(Some(value)),
            _ => Err(Fault::new(NcCode::NoMeaning, "a dwell by a word of another axis than X")),
        }
    }

    fn dwell(&mut self, words: &mut Words) -> Result<(), Fault> {
        if let Some(seconds) = self.dwell_by_x(words)? {
            self.events.push(Event::Dwell { line: self.line, seconds: Some(seconds), turns: None });
            return Ok(());
        }
        let time = words.take(self.dialect.letter(Role::Dwell))?;
        let time =
            time.ok_or_else(|| Fault::new(NcCode::MissingWord, "the time of the dwell is needed"))?;
        // Some controls count turns while the feed is one a revolution.
        let turns =
            self.dialect.amount(Amount::DwellTurns).filter(|_| self.feed.mode == FeedMode::PerTurn);
        let turns = turns.map(|factor| time / factor);
        let seconds = turns.is_none().then_some(time / self.dialect.factor(Amount::Dwell));
        self.events.push(Event::Dwell { line: self.line, seconds, turns });
        Ok(())
    }
}

/// Dwell units in a second of a control that counts milliseconds.
const MILLISECONDS: f64 = 1000.0;

/// `H0` of `G16` names the zero of the machine; other numbers are those of work offsets.
fn check_machine_zero(words: &mut Words) -> Result<(), Fault> {
    match words.take_whole(H)? {
        Some(0) => Ok(()),
        _ => Err(Fault::new(NcCode::NoMeaning, "G16 is known with H0 alone, the machine's zero")),
    }
}

/// `P2` to `P4`: the second to the fourth reference point, which is the second without it.
fn check_point(words: &mut Words) -> Result<(), Fault> {
    match words.take_plain(P)? {
        None | Some(2..=4) => Ok(()),
        Some(other) => {
            let message = format!("there is no reference point {other}, only 2 to 4");
            Err(Fault::new(NcCode::BadNumber, message))
        }
    }
}

/// The subprogram of a call: `P1001`, `P1001 L3`, or `P31001` for three times.
fn call(words: &mut Words) -> Result<Outcome, Fault> {
    let number = words.take_plain(P)?;
    let number = number
        .ok_or_else(|| Fault::new(NcCode::MissingWord, "the number of the subprogram is needed"))?;
    let times = words.take_plain(L)?;
    Ok(match times {
        None if number > 9999 => {
            Outcome::Call { number: i64::from(number % 10_000), times: number / 10_000 }
        }
        times => Outcome::Call { number: i64::from(number), times: times.unwrap_or(1) },
    })
}
