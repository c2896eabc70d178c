//! A block of words: modes first, then tool and spindle, then the motion.

use super::super::Fault;
use super::super::left_to_control::Uses;
use super::functions::{Function, function};
use super::line::{Value, Word};
use super::{Part, Sinumerik};
use crate::dialect::{Auxiliary, FeedMode, Habit, Numbered, ToolCall, WayRound};
use crate::errors::NcCode;
use crate::motion::{Event, FOOT, Speed, Spindle, StartMode};

/// A coordinate: its value, and whether it is a position; `None` for what is in force.
pub(super) type Coordinate = (f64, Option<bool>);

/// What a block says.
#[derive(Default)]
pub(super) struct Said {
    functions: Vec<Function>,
    auxiliaries: Vec<Auxiliary>,
    /// By axis.
    pub(super) axes: [Option<Coordinate>; 5],
    /// The way round that a word of an axis names.
    pub(super) ways: [Option<WayRound>; 5],
    /// I, J, K.
    pub(super) center: [Option<Coordinate>; 3],
    /// A3, B3, C3: the direction of the tool.
    pub(super) direction: [Option<f64>; 3],
    /// CR.
    pub(super) radius: Option<f64>,
    pub(super) feed: Option<f64>,
    spindle: SpindleWords,
    tool: Option<u32>,
    edge: Option<u32>,
}

/// What a block says of the spindle.
#[derive(Default)]
struct SpindleWords {
    speed: Option<f64>,
    /// SPOS, degrees.
    position: Option<f64>,
    limit: Option<f64>,
}

impl Said {
    /// The block is a way of G331 or G332.
    pub(super) fn taps(&self) -> bool {
        matches!(self.has(1), Some(Function::RigidTap { .. }))
    }

    fn has(&self, group: u8) -> Option<Function> {
        self.functions.iter().copied().find(|function| function.group() == group)
    }

    pub(super) fn moves(&self) -> bool {
        self.axes != [None; 5] || self.direction != [None; 3]
    }
}

impl Sinumerik<'_> {
    pub(super) fn block(&mut self, words: &[Word]) -> Result<(), Fault> {
        let mut said = Said::default();
        for word in words {
            self.take(word, &mut said)?;
        }
        self.uses = Uses {
            positions: said.axes.iter().flatten().any(|(_, absolute)| absolute.is_none()),
            speed: said.spindle.speed.is_some(),
        };
        if matches!(said.has(3), Some(Function::Compensation(side)) if side != crate::motion::Compensation::Off)
        {
            self.state.refuse_under_tip_control("cutter compensation")?;
        }
        if matches!(said.has(7), Some(Function::Offset(code)) if self.state.moves_fixture(code)) {
            self.state.refuse_under_tip_control("another work offset")?;
        }
        if self.state.head.tilt.is_some()
            && matches!(said.has(7), Some(Function::Offset(code)) if self.state.moves_fixture(code))
        {
            let message = "another work offset in a tilted plane";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        self.modes(&said)?;
        self.tool(&said)?;
        self.spindle(&said);
        for auxiliary in &said.auxiliaries {
            if let Auxiliary::CAxis(on, code) = auxiliary {
                self.become_axis(*on, *code)?;
            }
        }
        self.check_live(&said)?;
        for auxiliary in &said.auxiliaries {
            if let Auxiliary::Other(code) = auxiliary {
                self.state.tell_auxiliary(*code);
            }
        }
        let (stood, known) = (self.state.at, self.state.known);
        self.act(&said)?;
        for axis in (3..5).filter(|axis| known[*axis] && said.ways[*axis].is_some()) {
            let to = self.state.at[axis];
            self.state.check_way_round(axis, said.ways[axis], stood[axis], to)?;
        }
        for auxiliary in &said.auxiliaries {
            if let Auxiliary::End(code) = auxiliary {
                let (line, modes) = (self.state.line, self.state.modes);
                self.state.events.push(Event::End { line, code: Some(*code), modes });
                self.part = Part::Ended;
            }
        }
        Ok(())
    }

    /// The dwell or the motion of a block.
    fn act(&mut self, said: &Said) -> Result<(), Fault> {
        match said.has(8) {
            Some(Function::Dwell) => return self.dwell(said),
            Some(Function::FixedPoint) => return self.go_to_fixed_point(said),
            _ => {}
        }
        if let Some(feed) = said.feed {
            self.state.feed.word = Some(feed);
        } else if self.state.feed.mode == FeedMode::Inverse && said.moves() {
            self.state.feed.word = None;
        }
        if said.has(8) == Some(Function::Machine) {
            return self.in_machine_frame(said);
        }
        if let Some(Function::RigidTap { back }) = said.has(1) {
            return self.rigid_tap(said, back);
        }
        self.motion(said)
    }

    /// Takes a word up.
    fn take(&mut self, word: &Word, said: &mut Said) -> Result<(), Fault> {
        let twice = || Fault::new(NcCode::Twice, format!("two `{}`", word.name)).at(&word.range);
        let Some(value) = &word.value else { return self.statement(word, said) };
        if let Some(axis) = self.axis(&word.name) {
            let coordinate = match value {
                Value::Turned(position, way) if axis > 2 => {
                    said.ways[axis] = Some(*way);
                    (*position, Some(true))
                }
                value => self.coordinate(word, value)?,
            };
            return if said.axes[axis].replace(coordinate).is_some() {
                Err(twice())
            } else {
                Ok(())
            };
        }
        let spindle = self.state.dialect.number(Numbered::Spindle).map(|index| index.to_string());
        let of_spindle = |letter: &str| {
            word.name == letter
                || spindle.as_ref().is_some_and(|index| word.name == format!("{letter}{index}"))
        };
        let slot = match word.name.as_str() {
            "G" => return self.function(word, value, said),
            "I" | "J" | "K" => {
                let axis = usize::from(word.name.as_bytes()[0] - b'I');
                let coordinate = self.coordinate(word, value)?;
                let before = said.center[axis].replace(coordinate);
                return if before.is_some() { Err(twice()) } else { Ok(()) };
            }
            "T" => {
                let tool = match value {
                    Value::Text(name) => self.tool_of_name(name),
                    value => self.whole(word, value)?,
                };
                return if said.tool.replace(tool).is_some() { Err(twice()) } else { Ok(()) };
            }
            "D" => {
                let edge = self.whole(word, value)?;
                return if said.edge.replace(edge).is_some() { Err(twice()) } else { Ok(()) };
            }
            _ if of_spindle("M") => return self.auxiliary(word, value, said),
            _ if of_spindle("S") => &mut said.spindle.speed,
            "F" => &mut said.feed,
            "A3" if word.assigned => &mut said.direction[0],
            "B3" if word.assigned => &mut said.direction[1],
            "C3" if word.assigned => &mut said.direction[2],
            "CR" => &mut said.radius,
            "LIMS" => &mut said.spindle.limit,
            "TURN" if self.number(word, value)? == 0.0 => return Ok(()),
            "SPOS" | "SPOSA" | "SPOS[1]" | "SPOSA[1]" => &mut said.spindle.position,
            name if parameter(name).is_some() && word.assigned => {
                let number = self.number(word, value)?;
                self.parameters.extend(parameter(name).map(|name| (name, number)));
                return Ok(());
            }
            name if name.starts_with("SPOS[") => &mut said.spindle.position,
            "CTOL" | "ADIS" | "ADISPOS" => {
                self.controls_path();
                return Ok(());
            }
            _ => return Err(word.foreign("is not followed")),
        };
        let number = self.number(word, value)?;
        if slot.replace(number).is_some() { Err(twice()) } else { Ok(()) }
    }

    /// A statement without a value.
    fn statement(&mut self, word: &Word, said: &mut Said) -> Result<(), Fault> {
        const PATH_CONTROL: &[&str] = &[
            "SOFT",
            "BRISK",
            "DRIVE",
            "FFWON",
            "FFWOF",
            "COMPON",
            "COMPOF",
            "COMPCURV",
            "COMPCAD",
            "NORM",
            "KONT",
            "CFC",
            "CFTCP",
            "CFIN",
            "CUT2D",
            "CUT2DF",
            "DYNNORM",
            "DYNPOS",
            "DYNROUGH",
            "DYNSEMIFIN",
            "DYNFINISH",
            "ORIWKS",
            "ORIMKS",
            "ORIAXES",
            "ORIVECT",
        ];
        if word.arguments.is_some() {
            return Err(word.foreign("is no call that is followed in a block of words"));
        }
        match word.name.as_str() {
            "SUPA" => said.functions.push(Function::Machine),
            "DIAMON" if self.writes_diameters() => {
                self.counts_radii = false;
                self.state.certain.say(StartMode::Diameter);
            }
            "DIAMOF" if self.writes_diameters() && self.may_count_radii() => {
                self.counts_radii = true;
            }
            "DIAMOF" if self.writes_diameters() => {
                return Err(word.foreign("on a machine whose X is a diameter"));
            }
            "STOPRE" | "DIAMOF" => {}
            name if PATH_CONTROL.contains(&name) => self.controls_path(),
            _ => return Err(word.foreign("is not followed")),
        }
        Ok(())
    }

    /// X of the machine's programs is a diameter.
    fn writes_diameters(&self) -> bool {
        self.state.dialect.axes[0].scale.is_some_and(|x| x.way(2.0) == 1.0)
    }

    /// X is a diameter now.
    pub(super) fn is_by_diameter(&self) -> bool {
        self.writes_diameters() && !self.counts_radii
    }

    /// Live tools mill in transformations, and tap along X, by lengths of radius.
    fn may_count_radii(&self) -> bool {
        self.state.dialect.has(Habit::Transforms)
            || self.state.dialect.number(Numbered::LiveSpindle).is_some()
    }

    fn function(&mut self, word: &Word, value: &Value, said: &mut Said) -> Result<(), Fault> {
        let code = self.whole(word, value)?;
        let known = function(code);
        let function = known.ok_or_else(|| {
            Fault::new(NcCode::ForeignCode, format!("G{code} is not followed")).at(&word.range)
        })?;
        if function.group() > 0 && said.has(function.group()).is_some() {
            let message = "two G words of one group";
            return Err(Fault::new(NcCode::Twice, message).at(&word.range));
        }
        said.functions.push(function);
        Ok(())
    }

    fn auxiliary(&mut self, word: &Word, value: &Value, said: &mut Said) -> Result<(), Fault> {
        let code = self.whole(word, value)?;
        let auxiliary = match self.state.dialect.auxiliary(i64::from(code)) {
            _ if code == 17 => Auxiliary::End(17),
            Auxiliary::Flow | Auxiliary::Call | Auxiliary::Back => Auxiliary::Other(code),
            known => known,
        };
        if said.auxiliaries.iter().any(|other| other.excludes(auxiliary)) {
            let message = "two M words of one kind";
            return Err(Fault::new(NcCode::Twice, message).at(&word.range));
        }
        said.auxiliaries.push(auxiliary);
        Ok(())
    }

    fn coordinate(&self, word: &Word, value: &Value) -> Result<Coordinate, Fault> {
        match value {
            Value::Absolute(value) => Ok((*value, Some(true))),
            Value::Increment(value) => Ok((*value, Some(false))),
            value => Ok((self.number(word, value)?, None)),
        }
    }

    fn modes(&mut self, said: &Said) -> Result<(), Fault> {
        for function in &said.functions {
            let state = &mut self.state;
            match *function {
                Function::Rapid => state.motion = Some(crate::dialect::Function::Rapid),
                Function::Linear => state.motion = Some(crate::dialect::Function::Linear),
                Function::Arc { ccw } => {
                    state.motion = Some(crate::dialect::Function::Arc { ccw });
                }
                Function::Thread => state.motion = Some(crate::dialect::Function::Thread),
                Function::VaryingThread { shrinks } => {
                    state.motion = Some(crate::dialect::Function::VaryingThread);
                    self.lead_shrinks = shrinks;
                }
                Function::RigidTap { .. } => state.motion = None,
                Function::Plane(normal) => {
                    state.plane = normal;
                    state.say_plane(normal);
                    state.certain.say(StartMode::Plane);
                }
                Function::Compensation(side) => state.compensate(side, None)?,
                Function::Units { metric, feeds } => {
                    state.certain.say(StartMode::Unit);
                    state.set_metric(metric);
                    if feeds && self.metric_feed != metric {
                        self.metric_feed = metric;
                        state.feed.word = None;
                    }
                }
                Function::Positions { absolute } => {
                    state.absolute = absolute;
                    state.certain.say(StartMode::Positions);
                }
                Function::Feed(mode) => {
                    // One group with G96: a feed mode ends a surface speed.
                    if state.surface {
                        state.surface = false;
                        state.modes.spindle.speed = None;
                    }
                    self.feed_mode(mode);
                }
                Function::Surface { on, feed } => {
                    if on != state.surface {
                        state.modes.spindle.speed = None;
                    }
                    state.surface = on;
                    state.certain.say(StartMode::Surface);
                    self.feed_mode(feed);
                }
                Function::Offset(code) => state.fixture(code),
                Function::PathControl => self.controls_path(),
                _ => {}
            }
        }
        Ok(())
    }

    fn feed_mode(&mut self, mode: FeedMode) {
        if self.state.feed.mode != mode {
            self.state.feed.word = None;
        }
        self.state.feed.mode = mode;
        self.state.certain.say(StartMode::Feed);
    }

    fn tool(&mut self, said: &Said) -> Result<(), Fault> {
        let changes = said.auxiliaries.contains(&Auxiliary::ToolChange);
        let at_once = self.state.dialect.forms.tool_call != ToolCall::WithCode;
        if at_once && let Some(tool) = said.tool {
            self.change(tool);
        } else if said.tool.is_some() {
            self.state.next_tool = said.tool;
        }
        if changes && !at_once {
            let missing =
                || Fault::new(NcCode::MissingWord, "no T word names the tool to change to");
            let next = self.state.next_tool.take().ok_or_else(missing)?;
            self.change(next);
        }
        if let Some(edge) = said.edge {
            self.state.modes.length.offset = Some(edge).filter(|edge| *edge > 0);
        }
        Ok(())
    }

    /// A new tool comes with an edge that the machine chooses, until D names it.
    fn change(&mut self, tool: u32) {
        self.state.modes.length.offset = None;
        self.state.change(tool);
    }

    fn spindle(&mut self, said: &Said) {
        let dwells = said.has(8) == Some(Function::Dwell);
        let state = &mut self.state;
        if let Some(speed) = said.spindle.speed.filter(|_| !dwells) {
            state.modes.spindle.speed = Some(match state.surface {
                true => Speed::Surface(speed * if state.metric { 1.0 } else { FOOT }),
                false => Speed::Turns(speed),
            });
        }
        state.modes.spindle.speed_limit = said.spindle.limit.or(state.modes.spindle.speed_limit);
        for auxiliary in &said.auxiliaries {
            match auxiliary {
                Auxiliary::Clockwise => state.turn_spindle(Spindle::Clockwise),
                Auxiliary::Counterclockwise => state.turn_spindle(Spindle::Counterclockwise),
                Auxiliary::SpindleOff | Auxiliary::Orient => state.turn_spindle(Spindle::Off),
                Auxiliary::Live(way) => state.turn_spindle(*way),
                // The spindle stands and becomes an axis.
                Auxiliary::Other(70) => state.turn_spindle(Spindle::Off),
                Auxiliary::SpindleRange(range) => state.modes.spindle.range = Some(*range),
                Auxiliary::Coolant { code, .. } => state.cool(Some(*code)),
                Auxiliary::CoolantOff(code) => state.cool_off(*code),
                _ => {}
            }
        }
        if said.spindle.position.is_some() {
            state.turn_spindle(Spindle::Off);
            state.modes.spindle.orientation = said.spindle.position;
        }
    }

    /// `G4 F1.5` seconds, `G4 S30` turns: neither is a feed or a speed from then on.
    fn dwell(&mut self, said: &Said) -> Result<(), Fault> {
        let (seconds, turns) = match (said.feed, said.spindle.speed) {
            (Some(seconds), None) => (Some(seconds), None),
            (None, Some(turns)) => (None, Some(turns)),
            _ => {
                let message = "a dwell needs F in seconds or S in turns";
                return Err(Fault::new(NcCode::MissingWord, message));
            }
        };
        let line = self.state.line;
        self.state.events.push(Event::Dwell { line, seconds, turns });
        Ok(())
    }
}

/// The number of an R parameter.
fn parameter(name: &str) -> Option<u32> {
    name.strip_prefix('R')?.parse().ok()
}
