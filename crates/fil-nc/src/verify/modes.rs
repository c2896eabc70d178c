//! What must be in force while the tool moves: tool, spindle, coolant, compensation.
//!
//! A post may let a word wait for a motion of certain axes. Until then both the
//! state before and the state asked for are right; after it only the latter is.

mod check;
mod rules;

use super::compensation_plane::MeantPlane;
use super::counted::Counted;
use super::delayed::{DelayedMode, Moved};
use super::expected_step::{CoolantKind, Effect, ExpectedStep};
use super::report::FindingKind;
use super::restart::Restarts;
use super::settings::{Due, Settings};
use crate::dialect::Auxiliary;
use crate::motion::{Compensation, DRILLED, Speed, Spindle};

/// M70 of a SINUMERIK: the spindle stands and is an axis.
const AXIS_OF_SINUMERIK: u32 = 70;

/// The tool that must be in the spindle.
#[derive(Clone, Debug, Default)]
pub(super) struct ExpectedTool {
    /// Its number, as far as it is known.
    pub(super) number: Option<u32>,
    /// The change to it was left out: it is asked for where something moves alone.
    is_left_out: bool,
    /// The tool that LOADTL or a text named last.
    pub(super) loaded: Option<u32>,
    /// The offset that LOADTL named.
    pub(super) loaded_offset: Option<u32>,
}

/// What must hold of a spindle.
#[derive(Clone, Debug)]
pub(super) struct ExpectedSpindle {
    pub(super) turn: DelayedMode<Spindle>,
    /// How the last record that turned it did.
    pub(super) last_turn: Option<Spindle>,
    pub(super) speed: DelayedMode<Speed>,
    /// The rev/min of the approach before a surface speed, where the settings ask for it.
    pub(super) approach: Option<f64>,
    /// `None` where words of the user's own may have set it.
    pub(super) speed_limit: Option<Option<f64>>,
    /// `None` when none is asked for.
    pub(super) range: Option<u8>,
    /// Angle of the oriented spindle; `None` when none is asked for.
    pub(super) orientation: Option<f64>,
}

impl ExpectedSpindle {
    /// It stands, and has no speed.
    pub(super) fn at_start(speed_limit: Option<f64>) -> Self {
        ExpectedSpindle {
            turn: DelayedMode::new(Some(Spindle::Off)),
            last_turn: None,
            speed: DelayedMode::new(None),
            approach: None,
            speed_limit: Some(speed_limit),
            range: None,
            orientation: None,
        }
    }

    pub(super) fn flush(&mut self) {
        self.turn.flush();
        self.speed.flush();
    }

    fn moved(&mut self, moved: Moved) {
        self.turn.moved(moved);
        self.speed.moved(moved);
    }

    /// It turns as words of the user's own say, or anyhow (`None`).
    pub(super) fn turn_now(&mut self, turn: Option<Spindle>) {
        self.turn.set(turn, Due::Now);
        self.orientation = None;
    }
}

/// What records have named of a spindle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Naming {
    /// A speed was asked for, or words of the user's own may have set one.
    pub(super) has_speed: bool,
    /// The limit that the next surface speed brings along.
    next_limit: Option<f64>,
    /// The record that is taken up names the range.
    range: bool,
}

/// The work offset that must be in force.
#[derive(Clone, Debug)]
pub(super) struct ExpectedOffset {
    /// `None` when words of the user's own may have chosen it.
    pub(super) must: Option<Option<u32>>,
    /// Those that may be chosen where none is asked for.
    pub(super) allowed: Vec<u32>,
    /// The CL file has asked for one.
    pub(super) is_asked: bool,
}

/// The planes of cutter compensation.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExpectedPlane {
    /// The plane that a record has named last, by the index of its normal.
    pub(super) named: usize,
    /// In which planes the cutter may be compensated.
    pub(super) meant: MeantPlane,
}

/// Live tools.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExpectedMode {
    /// They mill: the main spindle is the axis C.
    mills: bool,
    /// MODE has just changed that.
    is_new: bool,
    /// The functions of the main spindle are not those of a live tool.
    pub(super) live_has_own_codes: bool,
}

/// What must be in force, by modal group.
#[derive(Clone, Debug)]
pub(super) struct Expected {
    pub(super) tool: ExpectedTool,
    /// The length offset.
    pub(super) length: DelayedMode<Option<u32>>,
    /// The length offset seen last.
    length_on: Option<u32>,
    /// The side, and the number of the offset.
    pub(super) compensation: DelayedMode<(Compensation, Option<u32>)>,
    pub(super) plane: ExpectedPlane,
    /// The master spindle.
    pub(super) spindle: ExpectedSpindle,
    /// The other spindle of a lathe, where the control is told which one is the master.
    pub(super) counted: Counted,
    pub(super) naming: Naming,
    pub(super) coolant: DelayedMode<Option<u32>>,
    pub(super) restarts: Restarts,
    pub(super) fixture: ExpectedOffset,
    pub(super) mode: ExpectedMode,
    /// Nothing is done any more that modes of records left out would hold for.
    pub(super) unfollowed: bool,
    /// What was wrong at the last motion, so that it is said once.
    said: Vec<(FindingKind, String)>,
}

impl Expected {
    pub(super) fn new(settings: &Settings) -> Self {
        Expected {
            tool: ExpectedTool::default(),
            length: DelayedMode::new(Some(None)),
            length_on: None,
            compensation: DelayedMode::new(Some((Compensation::Off, None))),
            plane: ExpectedPlane { named: DRILLED, meant: MeantPlane::of(settings) },
            spindle: ExpectedSpindle::at_start(settings.speed_limit_at_start()),
            counted: Counted { side: None, other: ExpectedSpindle::at_start(None) },
            naming: Naming {
                has_speed: settings.has_speed_at_start(),
                next_limit: None,
                range: false,
            },
            coolant: DelayedMode::new(Some(None)),
            restarts: Restarts::default(),
            fixture: ExpectedOffset {
                must: Some(fixture_of(&settings.own_blocks())),
                allowed: Vec::new(),
                is_asked: false,
            },
            mode: ExpectedMode {
                mills: settings.begins_milling(),
                is_new: false,
                live_has_own_codes: settings.live_has_own_codes(),
            },
            unfollowed: false,
            said: Vec::new(),
        }
    }

    /// Work offsets that the program may choose where the CL file asks for none.
    pub(super) fn allow_offsets(&mut self, offsets: Vec<u32>) {
        self.fixture.allowed = offsets;
    }

    /// A tool change says the work offset of the machine where nothing has named one.
    pub(super) fn take_first_offset(&mut self, settings: &Settings) {
        let is_named = self.fixture.is_asked || matches!(self.fixture.must, Some(Some(_)));
        let first = settings.first_work_offset().filter(|_| !is_named);
        if first.is_some() {
            self.fixture.must = Some(first);
        }
    }

    /// The tool that must be in the spindle, as far as it is known.
    pub(super) fn tool(&self) -> Option<u32> {
        self.tool.number
    }

    /// The offset that LOADTL named last.
    pub(super) fn loaded_offset(&self) -> Option<u32> {
        self.tool.loaded_offset
    }

    fn turn_spindle(&mut self, turn: Option<Spindle>, settings: &Settings) {
        self.spindle.turn.set(settings.spindle(turn), settings.spindle_due());
        self.spindle.orientation = None;
        self.naming.range = false;
    }

    /// Takes up what a step switches.
    pub(super) fn take(&mut self, wanted: &ExpectedStep, settings: &Settings) {
        self.restarts.take(wanted);
        match wanted {
            ExpectedStep::Plane(normal) => self.plane.named = *normal,
            ExpectedStep::Spindle(Some(Spindle::Off)) => {
                self.flush();
                self.spindle.turn.set(settings.spindle(Some(Spindle::Off)), Due::Now);
                self.spindle.orientation = None;
            }
            ExpectedStep::Spindle(turn) => {
                self.spindle.last_turn = turn.or_else(|| settings.spindle(None));
                self.turn_spindle(*turn, settings);
            }
            ExpectedStep::Counts(side) => self.count(*side, settings),
            ExpectedStep::OfSide(wanted) if settings.dialect.turning.counted.is_chosen() => {
                self.take(wanted, settings);
            }
            ExpectedStep::SpindleAgain => self.turn_spindle(self.spindle.last_turn, settings),
            ExpectedStep::SpindleRange(range) => {
                self.spindle.range = settings.spindle_range(*range);
                self.naming.range = true;
            }
            ExpectedStep::Speed(speed) => self.take_speed(*speed, settings),
            ExpectedStep::SpeedLimit(limit) if settings.limit_comes_with_surface() => {
                self.naming.next_limit = Some(*limit);
                if matches!(self.spindle.speed.asked(), Some(Speed::Surface(_))) {
                    self.spindle.speed_limit = Some(self.naming.next_limit);
                }
            }
            ExpectedStep::SpeedLimit(limit) => self.spindle.speed_limit = Some(Some(*limit)),
            ExpectedStep::Orient(angle) => {
                self.spindle.turn.set(None, Due::Now);
                self.spindle.speed.flush();
                self.spindle.orientation = *angle;
            }
            ExpectedStep::Coolant(kind) => {
                if *kind == CoolantKind::Off {
                    self.flush();
                }
                let due = if *kind == CoolantKind::Off { Due::Now } else { settings.coolant_due() };
                if let Some(code) = settings.coolant_code(*kind) {
                    self.coolant.require(Some(code).filter(|_| *kind != CoolantKind::Off), due);
                }
            }
            ExpectedStep::Compensation(side, offset) => {
                if *side != Compensation::Off {
                    self.plane.named = DRILLED;
                }
                let of_tool = self.tool.loaded.filter(|_| settings.offsets_diameters_by_tool());
                // The nose of a turning tool is in the offset of its T word.
                let has_number = !settings.calls_tools_with_offset() && *side != Compensation::Off;
                let offset = match settings.takes_noses_of_tools() {
                    // Without a word the control takes the nose of the tool itself.
                    true => (*offset)
                        .or(self.tool.loaded_offset)
                        .filter(|own| Some(*own) != self.tool.loaded),
                    false => *offset,
                };
                // A tool that brings its own radius, which only an edge has a number for.
                let offset = if settings.takes_offsets_of_tools() {
                    self.tool.loaded.filter(|_| !settings.has_edges())
                } else {
                    offset.or(of_tool)
                };
                let offset = offset.filter(|_| has_number);
                // The radius is that of the edge in force, which is said once.
                let edge = self.length.now().flatten().filter(|_| settings.has_edges());
                let offset = offset.filter(|offset| Some(*offset) != edge);
                self.compensation
                    .require((*side, offset), settings.compensation_due(self.mode.mills));
            }
            ExpectedStep::Mills(mills) if settings.is_mill_turn() => self.change_spindle(*mills),
            ExpectedStep::Stop { .. } | ExpectedStep::End(_) => self.flush(),
            ExpectedStep::Insert { text, .. } => {
                settings.blocks_of_text(text).for_each(|text| self.insert(text, settings));
            }
            ExpectedStep::Words(text) | ExpectedStep::Repeated(text) => self.insert(text, settings),
            ExpectedStep::WorkOffset(number) => {
                self.fixture.must = settings.work_offset(*number).map(Some);
                self.fixture.is_asked = true;
            }
            ExpectedStep::Fixture(code) => {
                self.fixture.must = Some(Some(*code));
                self.fixture.is_asked = true;
            }
            ExpectedStep::Unknown {
                effect: Effect::AnyWords | Effect::Path | Effect::Doubtful(_),
                ..
            } => {
                self.fixture.must = None;
                (self.spindle.speed_limit, self.spindle.range) = (None, None);
                self.naming.has_speed = true;
            }
            ExpectedStep::Unknown { effect: Effect::WordsOrOffset, .. } => self.fixture.must = None,
            ExpectedStep::Unknown { effect: Effect::Words, .. }
                if settings.chooses_offsets_by_word() =>
            {
                self.fixture.must = None;
            }
            ExpectedStep::Unknown { effect: Effect::Auxiliary, .. } => self.spindle.range = None,
            ExpectedStep::Auxiliary(code) => {
                self.spindle.range = None;
                let auxiliary = settings.dialect.auxiliary(i64::from(*code));
                if settings.has_edges() && *code == AXIS_OF_SINUMERIK {
                    self.insert_stop();
                }
                // The code of the main spindle stops no live tool that has its own.
                let of_main = self.mode.mills
                    && settings.is_mill_turn()
                    && !settings.dialect.turning.one_code[2];
                if !(of_main && auxiliary == Auxiliary::SpindleOff) {
                    self.insert_auxiliary(auxiliary);
                }
            }
            _ => {}
        }
    }

    /// The main spindle becomes an axis or a spindle again: neither it nor a live tool turns.
    fn change_spindle(&mut self, mills: bool) {
        self.mode.is_new = self.mode.mills != mills;
        if self.mode.is_new {
            self.flush();
            self.mode.mills = mills;
            self.spindle.turn.set(Some(Spindle::Off), Due::Now);
            self.restarts.spindle.was_on = None;
            self.spindle.speed.set(None, Due::Now);
            // The other spindle has no speed before one is asked for.
            self.naming.has_speed = false;
        }
    }

    /// The MODE that was taken up last has changed what the main spindle is.
    pub(super) fn changes_spindle(&self, mills: bool) -> bool {
        self.mode.is_new && self.mode.mills == mills
    }

    /// Live tools mill.
    pub(super) fn mills(&self) -> bool {
        self.mode.mills
    }

    /// The plane that a record has named last, by the index of its normal.
    pub(super) fn named_plane(&self) -> usize {
        self.plane.named
    }

    /// Live tools mill on a machine without Y.
    pub(super) fn mills_without_y(&self, settings: &Settings) -> bool {
        self.mode.mills && settings.is_mill_turn() && !settings.written()[1]
    }

    /// The program ends with a main spindle that is an axis, and begins with one that is none:
    /// the end makes it a spindle again.
    pub(super) fn ends_milling(&mut self, settings: &Settings) -> bool {
        let ends = settings.is_mill_turn() && self.mode.mills && !settings.begins_milling();
        if ends {
            self.change_spindle(false);
        }
        ends
    }

    /// The speed that must be in force, rpm; `None` for a surface speed, and where
    /// none is known.
    pub(super) fn turns_a_minute(&self) -> Option<f64> {
        self.spindle.speed.asked().and_then(Speed::turns)
    }

    /// The turns a minute of a surface speed at a diameter, mm: no more than the highest speed in
    /// force, and the top of the range. `None` where neither is known.
    pub(super) fn turns_of_surface(&self, diameter: f64, settings: &Settings) -> Option<f64> {
        let Some(Speed::Surface(speed)) = self.spindle.speed.asked() else { return None };
        let of_ranges = settings.speed_within(f64::MAX, self.spindle.range);
        let top = self.spindle.speed_limit.flatten().unwrap_or(f64::MAX).min(of_ranges);
        let turns = speed * 1000.0 / (std::f64::consts::PI * diameter);
        (top < f64::MAX).then_some(turns.min(top))
    }

    /// The tool comes to the part at a diameter, mm: until the first cut the spindle may turn at the
    /// rev/min of it, where a surface speed is asked for.
    pub(super) fn approach_at(&mut self, diameter: f64, settings: &Settings) {
        let Some(Speed::Surface(speed)) = self.spindle.speed.asked() else { return };
        let limit = self.spindle.speed_limit.flatten().unwrap_or(f64::INFINITY);
        let turns = (speed * 1000.0 / (std::f64::consts::PI * diameter)).min(limit);
        let within = turns.is_finite().then(|| settings.speed_within(turns, self.spindle.range));
        self.spindle.approach = within.filter(|_| settings.leads_in_by_turns());
    }

    /// The rev/min of an approach is known.
    pub(super) fn leads_in(&self) -> bool {
        self.spindle.approach.is_some()
    }

    /// Takes up a speed, with the range that it brings along.
    fn take_speed(&mut self, speed: Speed, settings: &Settings) {
        let speed = match speed {
            Speed::Surface(_) => {
                if self.spindle.speed_limit == Some(None) || self.naming.next_limit.is_some() {
                    let limit = self.naming.next_limit.or(settings.surface_limit());
                    self.spindle.speed_limit = Some(limit);
                }
                speed
            }
            Speed::Turns(_) if self.mode.mills || self.counted.is_side() => speed,
            Speed::Turns(asked) => {
                if !self.naming.range {
                    let within = settings.speed_within(asked, None);
                    self.spindle.range =
                        settings.range_of_speed(within, self.spindle.range).or(self.spindle.range);
                }
                Speed::Turns(settings.speed_within(asked, self.spindle.range))
            }
        };
        self.spindle.speed.set(Some(speed), settings.spindle_due());
        self.spindle.approach = None;
        self.naming.has_speed = true;
    }

    /// Takes up a tool change.
    pub(super) fn change_tool(&mut self, tool: u32, offset: u32, settings: &Settings) {
        self.flush();
        self.restarts.stop();
        self.tool.is_left_out = false;
        self.tool_moves(tool, offset, settings);
    }

    /// The operator has changed the tool, which no word of the program names.
    pub(super) fn take_tool_by_hand(&mut self) {
        self.tool.number = None;
    }

    /// A change to a tool was left out, which moves behind it all the same.
    pub(super) fn leave_tool_out(&mut self, tool: u32, offset: u32, settings: &Settings) {
        self.tool_moves(tool, offset, settings);
        self.tool.is_left_out = true;
    }

    /// The tool that moves from here on.
    fn tool_moves(&mut self, tool: u32, offset: u32, settings: &Settings) {
        self.tool.number = settings.calls_tools().then_some(tool);
        self.tool.loaded = Some(tool);
        self.tool.loaded_offset = Some(offset);
        if settings.calls_offsets() || settings.calls_named_offsets() && offset != tool {
            self.length.require(Some(offset), Due::WithZ);
        } else if settings.has_edges() {
            self.length.require(Some(offset), Due::Now);
        } else if settings.calls_tools_with_offset() {
            self.length.require(Some(offset).filter(|offset| *offset > 0), Due::Now);
        }
    }

    /// The end of tool-tip control, or a position of the machine, has taken the length off: the next
    /// motion of Z calls it again.
    pub(super) fn length_is_taken_off(&mut self) {
        let must = self.length.now().flatten();
        if must.is_some() && !self.length.waits() {
            self.length = DelayedMode::new(Some(None));
            self.length.require(must, Due::WithZ);
        }
    }

    /// The length offset at the last motion.
    pub(super) fn offset_on(&self) -> Option<u32> {
        self.length_on
    }

    /// A length offset is still to be called.
    pub(super) fn offset_waits(&self) -> bool {
        self.length.waits()
    }
}

/// The work offset that the start of a program switches on.
fn fixture_of(blocks: &[String]) -> Option<u32> {
    let words = blocks.iter().filter_map(|block| {
        crate::text::read_block(block.as_bytes(), "settings", 1).ok().map(|block| block.words)
    });
    let offset =
        |word: &crate::text::Word| word.letter == b'G' && (54..=59).contains(&word.number.digits);
    words.flatten().filter(offset).map(|word| word.number.digits as u32).reduce(|_, last| last)
}
