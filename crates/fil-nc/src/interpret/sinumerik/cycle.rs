//! Drilling cycles as single motions, by the manual of the cycles.

use super::super::Fault;
use super::super::cycle::{Cycle, reversed};
use super::Sinumerik;
use super::line::{Value, Word};
use crate::dialect::CycleKind;
use crate::errors::NcCode;
use crate::motion::{Course, Event, INCH, Rate, Speed, Spindle};

/// Most pecks of a hole.
const MAX_PECKS: f64 = 10_000.0;

/// By which chip breaking lifts where VRT says nothing, mm.
const LIFT: f64 = 1.0;

/// Levels nearer than this are one level, mm.
const SAME_LEVEL: f64 = 1e-6;

/// A cycle with what it is given.
#[derive(Clone, Debug)]
pub(super) struct Call {
    number: u32,
    values: Vec<Option<f64>>,
}

/// The names of the arguments, by the number of the cycle.
const NAMES: &[(u32, &[&str])] = &[
    (81, &["RTP", "RFP", "SDIS", "DP", "DPR"]),
    (82, &["RTP", "RFP", "SDIS", "DP", "DPR", "DTB"]),
    (
        83,
        &[
            "RTP", "RFP", "SDIS", "DP", "DPR", "FDEP", "FDPR", "DAM", "DTB", "DTS", "FRF", "VARI",
            "AXN", "MDEP", "VRT", "DTD", "DIS1",
        ],
    ),
    (
        84,
        &[
            "RTP", "RFP", "SDIS", "DP", "DPR", "DTB", "SDAC", "MPIT", "PIT", "POSS", "SST", "SST1",
            "AXN", "PITA", "TECHNO", "VARI",
        ],
    ),
    (85, &["RTP", "RFP", "SDIS", "DP", "DPR", "DTB", "FFR", "RFF"]),
    (86, &["RTP", "RFP", "SDIS", "DP", "DPR", "DTB", "SDIR", "RPA", "RPO", "RPAP", "POSS"]),
    (89, &["RTP", "RFP", "SDIS", "DP", "DPR", "DTB"]),
    (
        97,
        &[
            "PIT", "MPIT", "SPL", "FPL", "DM1", "DM2", "APP", "ROP", "TDEP", "FAL", "IANG", "NSP",
            "NRC", "NID", "VARI", "NUMTH", "VRT",
        ],
    ),
];

impl Call {
    fn names(&self) -> &'static [&'static str] {
        NAMES.iter().find(|(number, _)| *number == self.number).map_or(&[], |(_, names)| names)
    }

    /// An argument by its name; `None` for one that is left out.
    pub(super) fn get(&self, name: &str) -> Option<f64> {
        let at = self.names().iter().position(|known| *known == name)?;
        self.values.get(at).copied().flatten()
    }

    /// An argument that the cycle needs.
    pub(super) fn need(&self, name: &str) -> Result<f64, Fault> {
        self.get(name).ok_or_else(|| {
            Fault::new(NcCode::MissingWord, format!("CYCLE{} needs {name}", self.number))
        })
    }

    /// A depth as a level, or as a distance below the reference plane.
    ///
    /// # Errors
    /// Neither; both, at different levels, of which the control takes the distance.
    fn depth(
        &self,
        [name, relative]: [&str; 2],
        level: impl Fn(f64) -> f64,
        below: impl Fn(f64) -> f64,
    ) -> Result<f64, Fault> {
        match (self.get(name).map(level), self.get(relative).map(below)) {
            (Some(one), Some(other)) if (one - other).abs() > SAME_LEVEL => {
                let message = format!("{name} and {relative} are different depths");
                Err(Fault::new(NcCode::Twice, message))
            }
            (Some(depth), _) | (None, Some(depth)) => Ok(depth),
            (None, None) => {
                Err(Fault::new(NcCode::MissingWord, format!("{name} or {relative} is needed")))
            }
        }
    }

    /// Refuses a drilling axis other than the third one.
    fn check_axis(&self) -> Result<(), Fault> {
        if self.get("AXN").is_some_and(|axis| !matches!(axis as i64, 0 | 3)) {
            return Err(Fault::new(NcCode::ForeignCode, "AXN other than 3 is not followed"));
        }
        Ok(())
    }

    /// Refuses values other than zero: what they do is not followed.
    pub(super) fn refuse(&self, names: &[&str]) -> Result<(), Fault> {
        match names.iter().find(|name| self.get(name).is_some_and(|value| value != 0.0)) {
            Some(name) => {
                let message = format!("{name} of CYCLE{} is not followed", self.number);
                Err(Fault::new(NcCode::ForeignCode, message))
            }
            None => Ok(()),
        }
    }
}

/// The levels of a hole along the normal of the plane.
#[derive(Clone, Copy)]
struct Levels {
    axis: usize,
    rest: f64,
    surface: f64,
    clear: f64,
    bottom: f64,
}

impl Sinumerik<'_> {
    /// A call of a cycle that is followed.
    pub(super) fn call_of(&self, word: &Word) -> Result<Call, Fault> {
        let number = word.name.strip_prefix("CYCLE").and_then(|number| number.parse().ok());
        let known = number.and_then(|number| NAMES.iter().find(|(known, _)| *known == number));
        let (Some((number, names)), Some(arguments)) = (known, &word.arguments) else {
            return Err(word.foreign("is not followed"));
        };
        if arguments.len() > names.len() {
            return Err(word.foreign("has more arguments than are followed"));
        }
        let value = |value: &Option<Value>| {
            value.as_ref().map(|value| self.number(word, value)).transpose()
        };
        let values = arguments.iter().map(value).collect::<Result<_, _>>()?;
        Ok(Call { number: *number, values })
    }

    /// Runs a cycle where the tool stands.
    pub(super) fn drill(&mut self, call: &Call) -> Result<(), Fault> {
        self.state.refuse_under_tip_control("a cycle")?;
        if call.number == 97 {
            return self.thread_passes(call);
        }
        let at = self.levels(call)?;
        let kind = match call.number {
            81 | 82 => CycleKind::Drill,
            83 if call.get("VARI").unwrap_or(0.0) == 1.0 => CycleKind::Peck,
            83 => CycleKind::BreakChips,
            84 => CycleKind::Tap,
            86 => CycleKind::StopOut,
            _ => CycleKind::FeedOut,
        };
        let initial = self.state.at[at.axis];
        self.state.cycle.active = Some(Cycle::of_hole(kind, initial, self.state.known[at.axis]));
        self.state.known[at.axis] = true;
        self.go(&at, at.clear, Course::Rapid, None);
        let result = match call.number {
            83 => self.pecks(call, &at, kind),
            84 => self.tap(call, &at),
            85 => self.ream(call, &at),
            86 => self.bore(call, &at),
            89 => self.bore_at_feed(call, &at),
            _ => self.plain(call, &at),
        };
        self.go(&at, at.rest, Course::Rapid, None);
        if call.number == 86 {
            self.state.modes.spindle.turn = sense(call.need("SDIR")?)?;
        }
        self.state.cycle.active = None;
        result
    }

    fn levels(&self, call: &Call) -> Result<Levels, Fault> {
        let axis = self.state.plane;
        let length = |value: f64| self.state.length(axis, value).abs();
        let level = |value: f64| self.state.position(axis, value);
        let (rest, surface) = (level(call.need("RTP")?), level(call.need("RFP")?));
        let clear = surface + length(call.get("SDIS").unwrap_or(0.0));
        let bottom = call.depth(["DP", "DPR"], level, |depth| surface - length(depth))?;
        if bottom >= surface || rest < surface {
            let message = "RFP must lie above the bottom and not above RTP (alarm 61101)";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        if rest < clear - 1e-6 {
            let message = "RTP lies below RFP and SDIS";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        Ok(Levels { axis, rest, surface, clear, bottom })
    }

    fn go(&mut self, at: &Levels, level: f64, course: Course, rate: Option<Rate>) {
        self.state.step(&[(at.axis, level)], course, rate);
    }

    /// Seconds; turns of the spindle where it is below zero.
    fn wait(&mut self, dwell: Option<f64>) {
        let line = self.state.line;
        match dwell {
            Some(time) if time > 0.0 => {
                self.state.events.push(Event::Dwell { line, seconds: Some(time), turns: None });
            }
            Some(turns) if turns < 0.0 => {
                self.state.events.push(Event::Dwell { line, seconds: None, turns: None });
            }
            _ => {}
        }
    }

    fn plain(&mut self, call: &Call, at: &Levels) -> Result<(), Fault> {
        let rate = self.rate()?;
        self.go(at, at.bottom, Course::Feed, Some(rate));
        self.wait(call.get("DTB"));
        Ok(())
    }

    /// The first peck ends at FDEP, the others are as deep: without degression.
    fn pecks(&mut self, call: &Call, at: &Levels, kind: CycleKind) -> Result<(), Fault> {
        call.refuse(&["DAM", "DTB", "DTS", "MDEP"])?;
        let (axis, state) = (at.axis, &self.state);
        let length = |value: f64| state.length(axis, value).abs();
        if call.get("FRF").is_some_and(|share| share != 1.0) {
            return Err(Fault::new(NcCode::ForeignCode, "FRF other than 1 is not followed"));
        }
        call.check_axis()?;
        let level = |depth: f64| state.position(axis, depth);
        let first = call.depth(["FDEP", "FDPR"], level, |depth| at.surface - length(depth))?;
        let step = at.surface - first;
        if step <= 0.0 || first < at.bottom - 1e-9 {
            let message = "FDEP must lie between RFP and the bottom (alarm 61107)";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        if (at.clear - at.bottom) / step > MAX_PECKS {
            return Err(Fault::new(NcCode::BadNumber, "the pecks are too small to count"));
        }
        let rate = Some(self.rate()?);
        let lift = call.get("VRT").filter(|lift| *lift > 0.0).map_or(LIFT, length);
        let stop = call.get("DIS1").filter(|stop| *stop > 0.0);
        let stop = stop.map_or_else(|| own_stop(at), length);
        let mut reached = first;
        while reached > at.bottom + 1e-9 {
            self.go(at, reached, Course::Feed, rate);
            if kind == CycleKind::Peck {
                self.go(at, at.clear, Course::Rapid, None);
                self.go(at, (reached + stop).min(at.clear), Course::Rapid, None);
            } else {
                self.go(at, (reached + lift).min(at.clear), Course::Feed, rate);
            }
            reached -= step;
        }
        self.go(at, at.bottom, Course::Feed, rate);
        self.wait(call.get("DTD"));
        Ok(())
    }

    /// In step with the spindle, down and up; SDAC is how it turns afterwards.
    fn tap(&mut self, call: &Call, at: &Levels) -> Result<(), Fault> {
        call.refuse(&["MPIT", "TECHNO", "VARI"])?;
        call.check_axis()?;
        let (pitch, speed) = (call.need("PIT")?, call.need("SST")?);
        let pitch = self.pitch(pitch, call.get("PITA").unwrap_or(0.0))?;
        if pitch == 0.0 || speed <= 0.0 {
            return Err(Fault::new(NcCode::BadNumber, "PIT and SST must not be zero"));
        }
        let back = call.get("SST1").filter(|speed| *speed > 0.0).unwrap_or(speed);
        if back != speed {
            let message = "SST1 other than SST is not followed";
            return Err(Fault::new(NcCode::ForeignCode, message));
        }
        let turning = if pitch > 0.0 { Spindle::Clockwise } else { Spindle::Counterclockwise };
        let rate = Some(Rate::PerTurn(pitch.abs()));
        self.state.modes.spindle.speed = Some(Speed::Turns(speed));
        self.state.modes.spindle.turn = turning;
        self.go(at, at.bottom, Course::Thread, rate);
        self.wait(call.get("DTB"));
        self.state.modes.spindle.turn = reversed(turning);
        self.go(at, at.clear, Course::Thread, rate);
        self.state.modes.spindle.turn = sense(call.need("SDAC")?)?;
        Ok(())
    }

    /// A pitch in mm: PITA 0 counts as the software does, 1 in mm, 2 in turns an inch, 3 in
    /// inches.
    fn pitch(&self, pitch: f64, unit: f64) -> Result<f64, Fault> {
        match unit {
            0.0 if self.state.metric => Ok(pitch),
            0.0 => {
                let message = "the unit of PIT in a program in inches is not certain without PITA";
                Err(Fault::new(NcCode::ForeignCode, message))
            }
            1.0 => Ok(pitch),
            2.0 if pitch != 0.0 => Ok(INCH / pitch),
            3.0 => Ok(pitch * INCH),
            _ => Err(Fault::new(NcCode::ForeignCode, "PITA of another unit is not followed")),
        }
    }

    fn ream(&mut self, call: &Call, at: &Levels) -> Result<(), Fault> {
        let feed = |name: &str| call.need(name).map(|feed| Some(self.rate_of(feed)));
        let (down, up) = (feed("FFR")?, feed("RFF")?);
        self.go(at, at.bottom, Course::Feed, down);
        self.wait(call.get("DTB"));
        self.go(at, at.clear, Course::Feed, up);
        Ok(())
    }

    fn bore(&mut self, call: &Call, at: &Levels) -> Result<(), Fault> {
        call.refuse(&["RPA", "RPO", "RPAP"])?;
        self.plain(call, at)?;
        self.state.modes.spindle.turn = Spindle::Off;
        Ok(())
    }

    fn bore_at_feed(&mut self, call: &Call, at: &Levels) -> Result<(), Fault> {
        let rate = Some(self.rate()?);
        self.plain(call, at)?;
        self.go(at, at.clear, Course::Feed, rate);
        Ok(())
    }
}

/// How far above the last depth the control stops by itself: 0.6 mm to a depth of 30 mm,
/// then a fiftieth of it up to 7 mm.
fn own_stop(at: &Levels) -> f64 {
    let deep = at.surface - at.bottom;
    if deep <= 30.0 { 0.6 } else { (deep / 50.0).min(7.0) }
}

/// 3, 4 or 5: as M3, M4 and M5.
fn sense(value: f64) -> Result<Spindle, Fault> {
    match value as i64 {
        3 => Ok(Spindle::Clockwise),
        4 => Ok(Spindle::Counterclockwise),
        5 => Ok(Spindle::Off),
        _ => Err(Fault::new(NcCode::NoMeaning, "SDAC and SDIR are 3, 4 or 5")),
    }
}
