//! Heidenhain Klartext to events: lines of phrases in their order.
//!
//! Followed are `L`, `CC`, `C`, `CR`, `CP`, `PLANE SPATIAL`, `TOOL CALL`, the drilling cycles 200, 201, 203,
//! 205, 206, 207 and the old cycle 1 with `M99` or `CYCL CALL`, dwell and datum shift. What
//! else moves, calculates or jumps is refused.

mod cycle;
mod line;
mod motion;
mod plane;
mod tool;

use std::collections::VecDeque;

use fil_diag::{Diag, TextSpan};

use super::state::State;
use super::{Fault, cant_read};
use crate::dialect::{Auxiliary, Dialect, FeedMode};
use crate::errors::NcCode;
use crate::motion::{Event, Spindle};
use crate::source::{Lines, Source};
use cycle::Definition;
use line::{Line, Word};

/// Where the reading stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Before BEGIN PGM.
    Head,
    /// Between BEGIN PGM and the end.
    Body,
    /// After M2 or M30.
    Ended,
    /// After END PGM.
    Closed,
}

/// The coolant that M13 and M14 switch on.
const COOLANT: u32 = 8;

/// The program and what Klartext remembers besides the modes that all controls have.
struct Klartext<'d> {
    state: State<'d>,
    part: Part,
    /// The M function that ends the program.
    end_code: Option<u32>,
    /// The pole of `CC`, mm.
    pole: [Option<f64>; 2],
    /// The cycle that `M99` and `CYCL CALL` run.
    defined: Option<Definition>,
    /// The datum shift of cycle 7, mm.
    shift: [f64; 3],
    /// M126: rotary axes without an end go the shorter way.
    shortest: bool,
    /// The old cycle that the line before defines, and whether it said more than its name.
    old: Option<(u32, bool)>,
}

/// A program of Klartext, line by line.
pub(super) struct Program<'a> {
    control: Klartext<'a>,
    lines: Lines<'a>,
    /// The line that was read last, 1-based, and the last one that is not empty.
    number: u32,
    last: u32,
    /// The block that was begun last is left out, with the lines that go on with it.
    leaves_out: bool,
}

impl<'a> Program<'a> {
    pub(super) fn new(source: &'a Source<'a>, dialect: &'a Dialect) -> Self {
        let mut state = State::new(dialect);
        state.plane = 2;
        state.feed.mode = FeedMode::PerMinute;
        let control = Klartext {
            state,
            part: Part::Head,
            end_code: None,
            pole: [None; 2],
            defined: None,
            shift: [0.0; 3],
            shortest: false,
            old: None,
        };
        Program { control, lines: Lines::from(source, 0), number: 0, last: 1, leaves_out: false }
    }

    /// Goes on after a refused line: pole and cycle are unknown too.
    pub(super) fn forget(&mut self) {
        self.control.state.forget();
        self.control.pole = [None; 2];
        self.control.defined = None;
        self.control.old = None;
    }

    /// Goes on after a refused line as if it were not there.
    pub(super) fn pass_over(&mut self) -> bool {
        self.control.state.events.clear();
        true
    }

    /// Runs the next line; false behind the last.
    pub(super) fn run_line(
        &mut self,
        name: &str,
        into: &mut VecDeque<Event>,
    ) -> Result<bool, Box<Diag>> {
        let line = self.lines.next_line().map_err(|error| cant_read(name, &error))?;
        let Some(text) = line else {
            if self.control.part == Part::Closed {
                return Ok(false);
            }
            let cut_off = Diag::new(NcCode::CutOff, "no END PGM was found");
            return Err(Box::new(cut_off.at(TextSpan::line(name, self.last, ""))));
        };
        self.number += 1;
        let text = text.strip_suffix(b"\r").unwrap_or(text);
        if !text.trim_ascii().is_empty() {
            self.last = self.number;
        }
        let placed = |fault: Fault| fault.place(name, self.number, text);
        let line = Line::read(text).map_err(placed)?;
        if !line.continues {
            self.leaves_out = line.skipped && self.control.state.dialect.leaves_blocks_out();
        }
        if self.leaves_out {
            return Ok(true);
        }
        self.control.state.line = self.number;
        self.control.line(&line).map_err(placed)?;
        into.extend(self.control.state.events.drain(..));
        Ok(true)
    }
}

impl Klartext<'_> {
    fn line(&mut self, line: &Line) -> Result<(), Fault> {
        let words = line.texts();
        if words.is_empty() {
            return Ok(());
        }
        self.check_old_cycle(&words)?;
        match (self.part, &words[..]) {
            (Part::Head, ["BEGIN", "PGM", .., unit @ ("MM" | "INCH")]) => {
                self.state.set_metric(*unit == "MM");
                self.part = Part::Body;
                return Ok(());
            }
            (Part::Head, _) => {
                return Err(Fault::new(
                    NcCode::ForeignCode,
                    "the program begins without BEGIN PGM",
                ));
            }
            (Part::Body | Part::Ended, ["END", "PGM", .., unit @ ("MM" | "INCH")])
                if (*unit == "MM") != self.state.metric =>
            {
                let message = "END PGM and BEGIN PGM have different units";
                return Err(Fault::new(NcCode::Twice, message));
            }
            (Part::Body | Part::Ended, ["END", "PGM", ..]) => {
                if self.part == Part::Body {
                    self.end();
                }
                self.part = Part::Closed;
                return Ok(());
            }
            (Part::Ended | Part::Closed, _) => {
                return Err(Fault::new(NcCode::AfterEnd, "the program has ended before this line"));
            }
            (Part::Body, _) if self.state.is_of_others(|| words.join(" ")) => {
                return Ok(());
            }
            (Part::Body, _) => {}
        }
        if line.continues {
            return self.define_more(&line.words);
        }
        if let Some(definition) = &self.defined {
            definition.check_whole()?;
        }
        match &words[..] {
            ["BLK", "FORM", ..] => Ok(()),
            ["TOOL", "DEF", rest @ ..] => {
                self.define_tool(rest);
                Ok(())
            }
            ["STOP", ..] => {
                self.state.tell_auxiliary(0);
                self.functions(&line.words[1..])
            }
            ["TOOL", "CALL", ..] => self.tool_call(&line.words[2..]),
            ["CYCL" | "CYCLE", "DEF", ..] => self.define(&line.words[2..]),
            ["CYCL" | "CYCLE", "CALL", ..] => {
                self.functions(&line.words[2..])?;
                self.call_cycle()
            }
            ["LN", ..] => self.leaning_line(&line.words[1..]),
            ["PLANE", "SPATIAL", ..] => self.plane(&line.words[2..]),
            ["PLANE", "RESET", rest @ ..] => {
                plane::check_reset(rest, &line.words[2..])?;
                self.state.refuse_under_tip_control("the end of a tilted plane")?;
                self.state.end_tilt();
                Ok(())
            }
            ["FUNCTION", "TCPM", rest @ ..] => {
                plane::check_tcpm(rest)?;
                self.state.begin_stated_tip_control()
            }
            ["FUNCTION", "RESET", "TCPM"] | ["M129"] => {
                self.state.end_tip_control();
                Ok(())
            }
            ["M128"] => self.state.begin_stated_tip_control(),
            ["M140", "MB", "MAX"] | ["L", "M140", "MB", "MAX"] => {
                self.retract();
                Ok(())
            }
            ["L", ..] => self.straight(&line.words[1..]),
            ["CC", ..] => self.pole(&line.words[1..]),
            ["C" | "CR" | "CP", ..] if self.state.modes.frame.tip_control => {
                self.state.refuse_under_tip_control("an arc")
            }
            ["C", ..] => self.arc(&line.words[1..]),
            ["CP", ..] => self.polar_arc(&line.words[1..]),
            ["CR", ..] => self.arc_of_radius(&line.words[1..]),
            [first, ..] if first.starts_with('M') => self.functions(&line.words),
            _ => {
                let message = format!("`{}` is not followed", words[0]);
                Err(Fault::new(NcCode::ForeignCode, message))
            }
        }
    }

    /// Along the tool to the end of the travel, which in a tilted plane and under tool center point
    /// control is no way of Z alone.
    fn retract(&mut self) {
        let leans = self.state.head.tilt.is_some() || self.state.modes.frame.tip_control;
        self.state.go_to_machine(self.state.at, [leans, leans, true, false, false]);
    }

    fn end(&mut self) {
        let State { line, modes, .. } = self.state;
        self.state.events.push(Event::End { line, code: self.end_code, modes });
        self.part = Part::Ended;
    }

    /// What F counts: another mode needs another F.
    pub(super) fn feed_mode(&mut self, mode: FeedMode) {
        if self.state.feed.mode != mode {
            self.state.feed.word = None;
        }
        self.state.feed.mode = mode;
    }

    /// The M functions of a line that has nothing else.
    fn functions(&mut self, words: &[Word]) -> Result<(), Fault> {
        let (mut calls, mut ends) = (false, false);
        for word in words {
            let Some(code) = word.function()? else { return Err(word.no_meaning()) };
            match self.function(code, word)? {
                After::Nothing => {}
                // No position of the line counts in the frame of the machine.
                After::InMachineFrame => return Err(word.no_meaning()),
                After::CallsCycle => calls = true,
                After::Ends => ends = true,
            }
        }
        if calls {
            self.call_cycle()?;
        }
        if ends {
            self.end();
        }
        Ok(())
    }

    /// An M function; says what it asks for when the line is done.
    fn function(&mut self, code: i64, word: &Word) -> Result<After, Fault> {
        match code {
            13 | 14 => {
                let clockwise = code == 13;
                let turn = if clockwise { Spindle::Clockwise } else { Spindle::Counterclockwise };
                self.state.turn_spindle(turn);
                let coolant = match self.state.dialect.auxiliary(code) {
                    Auxiliary::Coolant { code, .. } => code,
                    _ => COOLANT,
                };
                self.state.cool(Some(coolant));
                return Ok(After::Nothing);
            }
            91 | 92 => return Ok(After::InMachineFrame),
            99 => return Ok(After::CallsCycle),
            136 | 137 => {
                self.feed_mode(if code == 136 { FeedMode::PerTurn } else { FeedMode::PerMinute });
                return Ok(After::Nothing);
            }
            126 | 127 => {
                self.shortest = code == 126;
                return Ok(After::Nothing);
            }
            89.. if !self.state.dialect.is_allowed(code) => {
                let message = format!("M{code} changes what motions or cycles do");
                return Err(Fault::new(NcCode::ForeignCode, message).at(&word.range));
            }
            _ => {}
        }
        match self.state.dialect.auxiliary(code) {
            Auxiliary::Clockwise => self.state.turn_spindle(Spindle::Clockwise),
            Auxiliary::Counterclockwise => self.state.turn_spindle(Spindle::Counterclockwise),
            Auxiliary::SpindleOff | Auxiliary::Orient => self.state.turn_spindle(Spindle::Off),
            Auxiliary::Coolant { code, .. } => self.state.cool(Some(code)),
            Auxiliary::CoolantOff(code) => self.state.cool_off(code),
            Auxiliary::End(code) => {
                self.end_code = Some(code);
                return Ok(After::Ends);
            }
            Auxiliary::Other(code) => self.state.tell_auxiliary(code),
            _ => {}
        }
        Ok(After::Nothing)
    }
}

/// What an M function asks for besides a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum After {
    Nothing,
    /// The positions of the line count in the frame of the machine.
    InMachineFrame,
    /// The cycle is run where the line ends.
    CallsCycle,
    /// The program ends.
    Ends,
}
