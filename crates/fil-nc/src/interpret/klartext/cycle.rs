//! Drilling cycles and the other cycles that a program defines.

use std::collections::BTreeMap;

use super::super::Fault;
use super::super::cycle::{Cycle, reversed};
use super::Klartext;
use super::line::Word;
use crate::dialect::{CycleKind, FeedMode};
use crate::errors::NcCode;
use crate::motion::{Course, Event, Rate, Speed, Spindle};
use crate::work_offsets::WORD_OFFSETS;

/// Most pecks of a hole.
const MAX_PECKS: f64 = 10_000.0;

/// Distance above the last depth at which a peck begins to feed where the set-up
/// clearance is zero, mm.
const GAP: f64 = 0.2;

/// Q208 of this size is rapid traverse, mm/min.
const RAPID_OUT: f64 = 99_999.0;

/// The last row of the table of presets.
const LAST_PRESET: f64 = 9999.0;

/// A cycle as it is defined: its number and its values.
#[derive(Clone, Debug)]
pub(super) struct Definition {
    number: u32,
    /// By the number of the Q parameter, or by a name of the old cycles.
    values: BTreeMap<String, f64>,
    rapid_out: bool,
}

/// A hole with its levels, mm.
struct Hole {
    kind: CycleKind,
    clear: f64,
    surface: f64,
    bottom: f64,
    rest: f64,
    step: f64,
    dwell: f64,
    rate: Rate,
    /// How far above the last depth a peck goes on.
    again: f64,
    /// Pecks that only lift before the tool comes out.
    breaks: u32,
    lift: f64,
}

impl Definition {
    fn get(&self, name: &str) -> Result<f64, Fault> {
        let value = self.values.get(name).copied();
        value.ok_or_else(|| {
            let message = format!("cycle {} needs {name}", self.number);
            Fault::new(NcCode::MissingWord, message)
        })
    }

    /// Refuses a definition that the next line does not go on with. What a control takes for
    /// a value that is not there hangs on its software: all that the cycle has always had must
    /// be said. Q253 and Q379 of cycle 205 came later; without them nothing is done.
    pub(super) fn check_whole(&self) -> Result<(), Fault> {
        let asked: &[&str] = match self.number {
            200 => &["Q200", "Q201", "Q206", "Q202", "Q210", "Q203", "Q204", "Q211"],
            201 => &["Q200", "Q201", "Q206", "Q211", "Q208", "Q203", "Q204"],
            203 => &[
                "Q200", "Q201", "Q206", "Q202", "Q210", "Q203", "Q204", "Q212", "Q213", "Q205",
                "Q211", "Q256",
            ],
            205 => &[
                "Q200", "Q201", "Q206", "Q202", "Q203", "Q204", "Q212", "Q205", "Q258", "Q259",
                "Q257", "Q256", "Q211",
            ],
            247 => &["Q339"],
            206 => &["Q200", "Q201", "Q206", "Q211", "Q203", "Q204"],
            207 => &["Q200", "Q201", "Q239", "Q203", "Q204"],
            _ => &[],
        };
        asked.iter().try_for_each(|name| self.get(name).map(|_| ()))
    }
}

impl Klartext<'_> {
    /// `CYCL DEF 200 DRILLING`, `CYCL DEF 7.1 X+10`, `CYCL DEF 9.1 DWELL 1.5`.
    pub(super) fn define(&mut self, words: &[Word]) -> Result<(), Fault> {
        let missing = || Fault::new(NcCode::MissingWord, "CYCL DEF needs its number");
        let (first, rest) = words.split_first().ok_or_else(missing)?;
        let (number, part) = first.text.split_once('.').unwrap_or((&first.text, "0"));
        let number: u32 = number.parse().map_err(|_| first.no_meaning())?;
        if let 1 | 7 | 9 | 32 = number {
            self.begin_or_go_on(number, part, first)?;
        }
        match (number, part) {
            (1, "0") | (200 | 201 | 203 | 205..=207, "0") => {
                self.defined =
                    Some(Definition { number, values: BTreeMap::new(), rapid_out: false });
                Ok(())
            }
            (247, "0") => {
                self.state.refuse_under_tip_control("another preset")?;
                if self.state.head.tilt.is_some() {
                    let message = "another preset in a tilted plane";
                    return Err(Fault::new(NcCode::NoMeaning, message));
                }
                self.defined =
                    Some(Definition { number, values: BTreeMap::new(), rapid_out: false });
                Ok(())
            }
            (1, _) => self.old_pecking(rest),
            (7, "0") | (9, "0") => Ok(()),
            (32, _) => {
                self.state.modes.path_control = Some(self.state.line);
                Ok(())
            }
            (7, _) => self.datum_shift(rest),
            (9, _) => self.dwell(rest),
            _ => {
                let message = format!("cycle {number} is not followed");
                Err(Fault::new(NcCode::ForeignCode, message).at(&first.range))
            }
        }
    }

    /// The lines of an old cycle: `CYCL DEF 7.0 DATUM SHIFT`, `CYCL DEF 7.1 X+10`. Values without
    /// the name before them define nothing.
    fn begin_or_go_on(&mut self, number: u32, part: &str, first: &Word) -> Result<(), Fault> {
        let goes_on = part != "0";
        if goes_on && self.old.is_none_or(|(begun, _)| begun != number) {
            let message = format!("a value of cycle {number} without its first line");
            return Err(Fault::new(NcCode::NoMeaning, message).at(&first.range));
        }
        self.old = Some((number, goes_on));
        Ok(())
    }

    /// Refuses an old cycle whose name no line with a value follows: whether a control goes on
    /// with the values it had, or stops, is not known.
    pub(super) fn check_old_cycle(&mut self, words: &[&str]) -> Result<(), Fault> {
        let Some((number, has_value)) = self.old else { return Ok(()) };
        if let ["CYCL" | "CYCLE", "DEF", first, ..] = words
            && first.split_once('.').is_some_and(|(begun, _)| begun == number.to_string())
        {
            return Ok(());
        }
        self.old = None;
        match has_value {
            true => Ok(()),
            false => {
                let message = format!("cycle {number} without its values");
                Err(Fault::new(NcCode::MissingWord, message))
            }
        }
    }

    /// `Q200=+2`.
    pub(super) fn define_more(&mut self, words: &[Word]) -> Result<(), Fault> {
        for word in words {
            let (name, value) = word.text.split_once('=').ok_or_else(|| word.no_meaning())?;
            let Some(definition) = &mut self.defined else {
                let message = "values without the cycle that takes them";
                return Err(Fault::new(NcCode::NoMeaning, message).at(&word.range));
            };
            let value = match value {
                "MAX" | "FMAX" if name == "Q208" => {
                    definition.rapid_out = true;
                    0.0
                }
                _ => value.parse().map_err(|_| {
                    Fault::new(NcCode::BadNumber, format!("`{}`", word.text)).at(&word.range)
                })?,
            };
            if definition.values.insert(name.to_string(), value).is_some() {
                return Err(Fault::new(NcCode::Twice, format!("two {name}")).at(&word.range));
            }
            if definition.number == 247 {
                self.preset(name, value, word)?;
            }
        }
        Ok(())
    }

    /// A row of the table of presets: the axes stand elsewhere in it.
    fn preset(&mut self, name: &str, row: f64, word: &Word) -> Result<(), Fault> {
        if name != "Q339" || row.fract() != 0.0 || !(0.0..=LAST_PRESET).contains(&row) {
            return Err(word.no_meaning());
        }
        self.state.fixture(WORD_OFFSETS + row as u32);
        Ok(())
    }

    /// The words of cycle 1: `DIST25.0`, `DEPTH-9.7`, `PLNGNG3.0`, `DWELL0`, `F224`.
    fn old_pecking(&mut self, words: &[Word]) -> Result<(), Fault> {
        const NAMES: [&str; 6] = ["DIST", "DEPTH", "PLNGNG", "PECKG", "DWELL", "F"];
        for word in words {
            let named = NAMES.iter().find_map(|name| Some((*name, word.value(name)?)));
            let (Some((name, value)), Some(definition)) = (named, &mut self.defined) else {
                return Err(word.no_meaning());
            };
            let name = if name == "PECKG" { "PLNGNG" } else { name };
            definition.values.insert(name.to_string(), value?);
        }
        Ok(())
    }

    /// Another datum: where the axes stand in it is not known.
    fn datum_shift(&mut self, words: &[Word]) -> Result<(), Fault> {
        if words.is_empty() {
            return Err(Fault::new(NcCode::MissingWord, "a datum shift needs an axis"));
        }
        for word in words {
            let axis = ["X", "Y", "Z"].iter().position(|name| word.value(name).is_some());
            let Some(axis) = axis else { return Err(word.no_meaning()) };
            let value = word.value(["X", "Y", "Z"][axis]).transpose()?.unwrap_or(0.0);
            let value = value * self.state.unit();
            if value != self.shift[axis] {
                self.shift[axis] = value;
                self.state.known[axis] = false;
            }
        }
        self.state.modes.frame.moved_zero =
            Some(self.state.line).filter(|_| self.shift != [0.0; 3]);
        Ok(())
    }

    /// `DWELL 1.5`, or the seconds alone.
    fn dwell(&mut self, words: &[Word]) -> Result<(), Fault> {
        let last = words.last();
        let last = last.ok_or_else(|| Fault::new(NcCode::MissingWord, "the seconds are needed"))?;
        let text = last.text.strip_prefix("DWELL").unwrap_or(&last.text);
        let seconds: f64 = text.parse().map_err(|_| last.no_meaning())?;
        let line = self.state.line;
        self.state.events.push(Event::Dwell { line, seconds: Some(seconds), turns: None });
        Ok(())
    }

    /// Runs the cycle that is defined where the tool stands.
    pub(super) fn call_cycle(&mut self) -> Result<(), Fault> {
        self.state.refuse_under_tip_control("a cycle")?;
        let missing = || Fault::new(NcCode::MissingWord, "no cycle is defined");
        let definition = self.defined.clone().ok_or_else(missing)?;
        if self.state.feed.mode != FeedMode::PerMinute {
            let message = "a cycle under M136: its feed per revolution is not supported";
            return Err(Fault::new(NcCode::ForeignCode, message));
        }
        let hole = self.hole(&definition)?;
        if hole.bottom >= hole.surface || hole.clear < hole.surface {
            return Err(Fault::new(NcCode::ForeignCode, "a hole that goes up is not followed"));
        }
        if (hole.clear - hole.bottom) / hole.step > MAX_PECKS {
            return Err(Fault::new(NcCode::BadNumber, "the pecks are too small to count"));
        }
        let initial_known = self.state.known[2];
        self.state.cycle.active = Some(Cycle::of_hole(hole.kind, self.state.at[2], initial_known));
        self.state.known[2] = true;
        self.up_and_down(Course::Rapid, hole.clear, None);
        self.drill(&hole);
        if hole.dwell > 0.0 {
            let line = self.state.line;
            self.state.events.push(Event::Dwell { line, seconds: Some(hole.dwell), turns: None });
        }
        let turning = self.state.modes.spindle.turn;
        match hole.kind {
            CycleKind::Tap => {
                self.state.modes.spindle.turn = reversed(turning);
                self.up_and_down(Course::Thread, hole.clear, Some(hole.rate));
            }
            CycleKind::FeedOut => self.up_and_down(Course::Feed, hole.clear, Some(hole.rate)),
            _ => {}
        }
        self.state.modes.spindle.turn = turning;
        self.up_and_down(Course::Rapid, hole.rest, None);
        self.state.cycle.active = None;
        Ok(())
    }

    fn up_and_down(&mut self, course: Course, level: f64, rate: Option<Rate>) {
        self.state.step(&[(2, level)], course, rate);
    }

    /// From the set-up clearance to the bottom; the pecks count from the surface.
    fn drill(&mut self, hole: &Hole) {
        let tap = hole.kind == CycleKind::Tap;
        let course = if tap { Course::Thread } else { Course::Feed };
        let (mut reached, mut broken) = (hole.surface, 0);
        while reached - hole.step > hole.bottom + 1e-9 {
            reached -= hole.step;
            self.up_and_down(course, reached, Some(hole.rate));
            if hole.kind == CycleKind::BreakChips && broken < hole.breaks {
                broken += 1;
                self.up_and_down(Course::Rapid, (reached + hole.lift).min(hole.clear), None);
                continue;
            }
            broken = 0;
            self.up_and_down(Course::Rapid, hole.clear, None);
            self.up_and_down(Course::Rapid, (reached + hole.again).min(hole.clear), None);
        }
        self.up_and_down(course, hole.bottom, Some(hole.rate));
    }

    /// The levels of a hole.
    fn hole(&self, definition: &Definition) -> Result<Hole, Fault> {
        if definition.number == 1 {
            return self.old_hole(definition);
        }
        let length = |name: &str| definition.get(name).map(|value| self.state.length(2, value));
        let surface = self.state.position(2, definition.get("Q203")?);
        let set_up = length("Q200")?;
        let clear = surface + set_up;
        let depth = length("Q201")?;
        let rest = (surface + length("Q204")?).max(clear);
        let (mut kind, mut step, mut breaks, mut lift) = (CycleKind::Drill, f64::INFINITY, 0, 0.0);
        let mut again = if set_up > 0.0 { set_up } else { GAP };
        let rate = match definition.number {
            207 => {
                kind = CycleKind::Tap;
                self.check_sense(definition.get("Q239")?)?;
                Rate::PerTurn(definition.get("Q239")?.abs() * self.state.unit())
            }
            206 => {
                kind = CycleKind::Tap;
                self.lead_of(definition.get("Q206")?)?
            }
            _ => self.rate_of(definition.get("Q206")?),
        };
        match definition.number {
            200 => step = length("Q202")?,
            201 => {
                kind = CycleKind::FeedOut;
                let out = definition.get("Q208")?;
                if out != 0.0 && out != definition.get("Q206")? {
                    return Err(Fault::new(NcCode::ForeignCode, "Q208: a feed out of its own"));
                }
            }
            203 => {
                step = length("Q202")?;
                self.refuse(definition, &["Q212"])?;
                if !definition.rapid_out && definition.get("Q208")? < RAPID_OUT {
                    return Err(Fault::new(NcCode::ForeignCode, "Q208: a feed out of its own"));
                }
                breaks = definition.get("Q213")?.max(0.0) as u32;
                lift = length("Q256")?;
                kind = if breaks > 0 { CycleKind::BreakChips } else { CycleKind::Peck };
            }
            205 => {
                step = length("Q202")?;
                self.refuse(definition, &["Q212", "Q257", "Q379"])?;
                again = length("Q258")?;
                if length("Q259")? != again {
                    let message = "Q259 other than Q258: the stops before the depths change evenly";
                    return Err(Fault::new(NcCode::ForeignCode, message));
                }
                kind = CycleKind::Peck;
            }
            _ => {}
        }
        if step <= 0.0 {
            return Err(Fault::new(NcCode::BadNumber, "Q202 must be above zero"));
        }
        self.refuse(definition, &["Q210"])?;
        let dwell = definition.values.get("Q211").copied().unwrap_or(0.0);
        let bottom = surface + depth;
        Ok(Hole { kind, clear, surface, bottom, rest, step, dwell, rate, again, breaks, lift })
    }

    /// Refuses values other than zero: what they do is not followed.
    fn refuse(&self, definition: &Definition, names: &[&str]) -> Result<(), Fault> {
        for name in names {
            if definition.values.get(*name).is_some_and(|value| *value != 0.0) {
                let message = format!("{name} other than 0 is not followed");
                return Err(Fault::new(NcCode::ForeignCode, message));
            }
        }
        Ok(())
    }

    /// In a floating holder the tap goes at Q206 while the spindle turns: the lead is what is
    /// left of it for a turn.
    fn lead_of(&self, feed: f64) -> Result<Rate, Fault> {
        let turning = self.state.modes.spindle.turn != Spindle::Off;
        match (self.rate_of(feed), self.state.modes.spindle.speed) {
            (Rate::PerMinute(feed), Some(Speed::Turns(turns))) if turning && turns > 0.0 => {
                Ok(Rate::PerTurn(feed / turns))
            }
            _ => {
                let message = "cycle 206 taps with the spindle that turns, and it does not, or its \
                               speed is not known";
                Err(Fault::new(NcCode::NoMeaning, message))
            }
        }
    }

    /// A pitch below zero cuts a left-hand thread, with the spindle turning that way.
    fn check_sense(&self, pitch: f64) -> Result<(), Fault> {
        let turns = if pitch > 0.0 { Spindle::Clockwise } else { Spindle::Counterclockwise };
        if self.state.modes.spindle.turn == Spindle::Off || self.state.modes.spindle.turn == turns {
            return Ok(());
        }
        let message = "the sign of Q239 does not match the spindle direction";
        Err(Fault::new(NcCode::NoMeaning, message))
    }

    /// Cycle 1 begins at its set-up clearance, where the tool stands.
    fn old_hole(&self, definition: &Definition) -> Result<Hole, Fault> {
        let length = |name: &str| definition.get(name).map(|value| self.state.length(2, value));
        if !self.state.known[2] {
            return Err(Fault::new(NcCode::NoMeaning, "the tool position is not known"));
        }
        let clear = self.state.at[2];
        let (dist, depth, step) =
            (length("DIST")?.abs(), length("DEPTH")?, length("PLNGNG")?.abs());
        if step <= 0.0 {
            return Err(Fault::new(NcCode::BadNumber, "PLNGNG must not be zero"));
        }
        let surface = clear - dist;
        Ok(Hole {
            kind: CycleKind::Peck,
            clear,
            surface,
            bottom: surface + depth,
            rest: clear,
            step,
            dwell: definition.get("DWELL")?,
            rate: self.rate_of(definition.get("F")?),
            again: GAP,
            breaks: 0,
            lift: 0.0,
        })
    }
}
