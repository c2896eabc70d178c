//! What must be in force while the tool moves: tool, spindle, coolant, compensation.
//!
//! A post may let a word wait for a motion of certain axes. Until then both the
//! state before and the state asked for are right; after it only the latter is.

mod check;

use super::again::Again;
use super::compensation_plane::MeantPlane;
use super::counted::Counted;
use super::lag::Lag;
use super::own_switches::Resumes;
use super::report::FindingKind;
use super::settings::{Due, Settings};
use super::wanted::{CoolantKind, Effect, Wanted};
use crate::dialect::Auxiliary;
use crate::motion::{Compensation, DRILLED, Speed, Spindle};

/// M70 of a SINUMERIK: the spindle stands and is an axis.
const AXIS_OF_SINUMERIK: u32 = 70;

/// What must be in force. `None` inside is a state that is not known.
#[derive(Clone, Debug)]
pub(super) struct Expected {
    pub(super) tool: Option<u32>,
    /// The change to it was left out: it is asked for where something moves alone.
    tool_is_left_out: bool,
    /// The tool that LOADTL or a text named last.
    pub(super) loaded: Option<u32>,
    /// The offset that LOADTL named.
    pub(super) loaded_offset: Option<u32>,
    pub(super) offset: Lag<Option<u32>>,
    /// The side, and the number of the offset.
    pub(super) compensation: Lag<(Compensation, Option<u32>)>,
    pub(super) spindle: Lag<Option<Spindle>>,
    /// The spindles of a lathe, where the control is told which one it counts.
    pub(super) counted: Counted,
    /// How the last record that turned the spindle did.
    pub(super) last_turn: Option<Spindle>,
    /// Angle of the oriented spindle; `None` when none is asked for.
    pub(super) orientation: Option<f64>,
    /// The spindle range; `None` when none is asked for.
    pub(super) range: Option<u8>,
    /// The record that is taken up names the range.
    range_is_named: bool,
    pub(super) speed: Lag<Option<Speed>>,
    /// A speed was asked for, or words of the user's own may have set one.
    pub(super) has_speed: bool,
    /// `None` inside where words of the user's own may have set it.
    pub(super) speed_limit: Option<Option<f64>>,
    /// The limit that the next surface speed brings along.
    next_limit: Option<f64>,
    pub(super) coolant: Lag<Option<u32>>,
    /// A record has asked for the spindle, and for the coolant, since the last tool change or
    /// stop.
    pub(super) again: Again,
    /// What blocks of the settings have switched off.
    pub(super) resumes: Resumes,
    /// Nothing is done any more that modes of records left out would hold for.
    pub(super) unfollowed: bool,
    /// `None` when words of the user's own may have chosen it.
    pub(super) fixture: Option<Option<u32>>,
    /// The plane that a record has named last, by the index of its normal.
    pub(super) plane: usize,
    /// In which planes the cutter may be compensated.
    pub(super) meant_plane: MeantPlane,
    /// Work offsets that may be chosen where none is asked for.
    allowed_offsets: Vec<u32>,
    /// The CL file has asked for a work offset.
    asks_fixture: bool,
    /// The length offset seen last.
    offset_on: Option<u32>,
    /// Live tools mill: the main spindle is the axis C.
    mills: bool,
    /// The functions of the main spindle are not those of a live tool.
    pub(super) live_has_own_codes: bool,
    /// MODE has just changed that.
    mode_changed: bool,
    /// What was wrong at the last motion, so that it is said once.
    said: Vec<(FindingKind, String)>,
}

impl Expected {
    pub(super) fn new(settings: &Settings) -> Self {
        Expected {
            tool: None,
            tool_is_left_out: false,
            loaded: None,
            loaded_offset: None,
            offset: Lag::new(None),
            compensation: Lag::new((Compensation::Off, None)),
            spindle: Lag::new(Some(Spindle::Off)),
            counted: Counted::default(),
            last_turn: None,
            speed: Lag::new(None),
            orientation: None,
            range: None,
            range_is_named: false,
            has_speed: settings.has_speed_at_start(),
            speed_limit: Some(settings.speed_limit_at_start()),
            next_limit: None,
            coolant: Lag::new(None),
            again: Again::default(),
            resumes: Resumes::default(),
            unfollowed: false,
            fixture: Some(fixture_of(&settings.own_blocks())),
            plane: DRILLED,
            meant_plane: MeantPlane::of(settings),
            allowed_offsets: Vec::new(),
            asks_fixture: false,
            offset_on: None,
            mills: settings.begins_milling(),
            live_has_own_codes: settings.live_has_own_codes(),
            mode_changed: false,
            said: Vec::new(),
        }
    }

    /// Work offsets that the program may choose where the CL file asks for none.
    pub(super) fn allow_offsets(&mut self, offsets: Vec<u32>) {
        self.allowed_offsets = offsets;
    }

    /// The tool that must be in the spindle, as far as it is known.
    pub(super) fn tool(&self) -> Option<u32> {
        self.tool
    }

    /// The offset that LOADTL named last.
    pub(super) fn loaded_offset(&self) -> Option<u32> {
        self.loaded_offset
    }

    fn turn_spindle(&mut self, turn: Option<Spindle>, settings: &Settings) {
        self.spindle.set(settings.spindle(turn), settings.spindle_due());
        self.orientation = None;
        self.range_is_named = false;
    }

    /// Takes up what a step switches.
    pub(super) fn take(&mut self, wanted: &Wanted, settings: &Settings) {
        self.again.take(wanted);
        self.resumes.take(wanted);
        match wanted {
            Wanted::Plane(normal) => self.plane = *normal,
            Wanted::Spindle(Some(Spindle::Off)) => {
                self.flush();
                self.spindle.set(settings.spindle(Some(Spindle::Off)), Due::Now);
                self.orientation = None;
            }
            Wanted::Spindle(turn) => {
                self.last_turn = turn.or_else(|| settings.spindle(None));
                self.turn_spindle(*turn, settings);
            }
            Wanted::Counts(side) => self.count(*side, settings),
            Wanted::OfSide(wanted) if settings.dialect.turning.counted.is_chosen() => {
                self.take(wanted, settings);
            }
            Wanted::SpindleAgain => self.turn_spindle(self.last_turn, settings),
            Wanted::SpindleRange(range) => {
                self.range = settings.spindle_range(*range);
                self.range_is_named = true;
            }
            Wanted::Speed(speed) => self.take_speed(*speed, settings),
            Wanted::SpeedLimit(limit) if settings.limit_comes_with_surface() => {
                self.next_limit = Some(*limit);
                if matches!(self.speed.asked(), Some(Speed::Surface(_))) {
                    self.speed_limit = Some(self.next_limit);
                }
            }
            Wanted::SpeedLimit(limit) => self.speed_limit = Some(Some(*limit)),
            Wanted::Orient(angle) => {
                self.spindle.set(None, Due::Now);
                self.speed.flush();
                self.orientation = *angle;
            }
            Wanted::Coolant(kind) => {
                if *kind == CoolantKind::Off {
                    self.flush();
                }
                let due = if *kind == CoolantKind::Off { Due::Now } else { settings.coolant_due() };
                if let Some(code) = settings.coolant_code(*kind) {
                    self.coolant.set(Some(code).filter(|_| *kind != CoolantKind::Off), due);
                }
            }
            Wanted::Compensation(side, offset) => {
                if *side != Compensation::Off {
                    self.plane = DRILLED;
                }
                let of_tool = self.loaded.filter(|_| settings.offsets_diameters_by_tool());
                // The nose of a turning tool is in the offset of its T word.
                let has_number = !settings.calls_tools_with_offset() && *side != Compensation::Off;
                let offset = match settings.takes_noses_of_tools() {
                    // Without a word the control takes the nose of the tool itself.
                    true => {
                        (*offset).or(self.loaded_offset).filter(|own| Some(*own) != self.loaded)
                    }
                    false => *offset,
                };
                // A tool that brings its own radius, which only an edge has a number for.
                let offset = if settings.takes_offsets_of_tools() {
                    self.loaded.filter(|_| !settings.has_edges())
                } else {
                    offset.or(of_tool)
                };
                let offset = offset.filter(|_| has_number);
                // The radius is that of the edge in force, which is said once.
                let edge = self.offset.now.filter(|_| settings.has_edges());
                let offset = offset.filter(|offset| Some(*offset) != edge);
                self.compensation.set((*side, offset), settings.compensation_due(self.mills));
            }
            Wanted::Mills(mills) if settings.is_mill_turn() => self.change_spindle(*mills),
            Wanted::Stop { .. } | Wanted::End(_) => self.flush(),
            Wanted::Insert { text, .. } => {
                settings.blocks_of_text(text).for_each(|text| self.insert(text, settings));
            }
            Wanted::Words(text) | Wanted::Repeated(text) => self.insert(text, settings),
            Wanted::WorkOffset(number) => {
                self.fixture = settings.work_offset(*number).map(Some);
                self.asks_fixture = true;
            }
            Wanted::Fixture(code) => {
                self.fixture = Some(Some(*code));
                self.asks_fixture = true;
            }
            Wanted::Unknown {
                effect: Effect::AnyWords | Effect::Path | Effect::Doubtful(_),
                ..
            } => {
                (self.fixture, self.speed_limit, self.range) = (None, None, None);
                self.has_speed = true;
            }
            Wanted::Unknown { effect: Effect::WordsOrOffset, .. } => self.fixture = None,
            Wanted::Unknown { effect: Effect::Words, .. } if settings.chooses_offsets_by_word() => {
                self.fixture = None;
            }
            Wanted::Unknown { effect: Effect::Auxiliary, .. } => self.range = None,
            Wanted::Auxiliary(code) => {
                self.range = None;
                let auxiliary = settings.dialect.auxiliary(i64::from(*code));
                if settings.has_edges() && *code == AXIS_OF_SINUMERIK {
                    self.insert_stop();
                }
                // The code of the main spindle stops no live tool that has its own.
                let of_main =
                    self.mills && settings.is_mill_turn() && !settings.dialect.turning.one_code[2];
                if !(of_main && auxiliary == Auxiliary::SpindleOff) {
                    self.insert_auxiliary(auxiliary);
                }
            }
            _ => {}
        }
    }

    /// The main spindle becomes an axis or a spindle again: neither it nor a live tool turns.
    fn change_spindle(&mut self, mills: bool) {
        self.mode_changed = self.mills != mills;
        if self.mode_changed {
            self.flush();
            self.mills = mills;
            self.spindle.set(Some(Spindle::Off), Due::Now);
            self.resumes.spindle = None;
            self.speed.set(None, Due::Now);
            // The other spindle has no speed before one is asked for.
            self.has_speed = false;
        }
    }

    /// The MODE that was taken up last has changed what the main spindle is.
    pub(super) fn changes_spindle(&self, mills: bool) -> bool {
        self.mode_changed && self.mills == mills
    }

    /// Live tools mill.
    pub(super) fn mills(&self) -> bool {
        self.mills
    }

    /// The plane that a record has named last, by the index of its normal.
    pub(super) fn named_plane(&self) -> usize {
        self.plane
    }

    /// Live tools mill on a machine without Y.
    pub(super) fn mills_without_y(&self, settings: &Settings) -> bool {
        self.mills && settings.is_mill_turn() && !settings.written()[1]
    }

    /// The program ends with a main spindle that is an axis, and begins with one that is none:
    /// the end makes it a spindle again.
    pub(super) fn ends_milling(&mut self, settings: &Settings) -> bool {
        let ends = settings.is_mill_turn() && self.mills && !settings.begins_milling();
        if ends {
            self.change_spindle(false);
        }
        ends
    }

    /// The speed that must be in force, turns/min; `None` for a surface speed, and where
    /// none is known.
    pub(super) fn turns_a_minute(&self) -> Option<f64> {
        self.speed.asked().and_then(Speed::turns)
    }

    /// The turns a minute of a surface speed at a diameter, mm: no more than the highest speed in
    /// force, and the top of the range. `None` where neither is known.
    pub(super) fn turns_of_surface(&self, diameter: f64, settings: &Settings) -> Option<f64> {
        let Some(Speed::Surface(speed)) = self.speed.asked() else { return None };
        let of_ranges = settings.speed_within(f64::MAX, self.range);
        let top = self.speed_limit.flatten().unwrap_or(f64::MAX).min(of_ranges);
        let turns = speed * 1000.0 / (std::f64::consts::PI * diameter);
        (top < f64::MAX).then_some(turns.min(top))
    }

    /// Takes up a speed, with the range that it brings along.
    fn take_speed(&mut self, speed: Speed, settings: &Settings) {
        let speed = match speed {
            Speed::Surface(_) => {
                if self.speed_limit == Some(None) || self.next_limit.is_some() {
                    let limit = self.next_limit.or(settings.surface_limit());
                    self.speed_limit = Some(limit);
                }
                speed
            }
            Speed::Turns(_) if self.mills || self.counted.is_side() => speed,
            Speed::Turns(asked) => {
                if !self.range_is_named {
                    let within = settings.speed_within(asked, None);
                    self.range = settings.range_of_speed(within, self.range).or(self.range);
                }
                Speed::Turns(settings.speed_within(asked, self.range))
            }
        };
        self.speed.set(Some(speed), settings.spindle_due());
        self.has_speed = true;
    }

    /// Takes up a tool change.
    pub(super) fn change_tool(&mut self, tool: u32, offset: u32, settings: &Settings) {
        self.flush();
        self.again = Again::default();
        self.tool_is_left_out = false;
        self.tool_moves(tool, offset, settings);
    }

    /// A change to a tool was left out, which moves behind it all the same.
    pub(super) fn leave_tool_out(&mut self, tool: u32, offset: u32, settings: &Settings) {
        self.tool_moves(tool, offset, settings);
        self.tool_is_left_out = true;
    }

    /// The tool that moves from here on.
    fn tool_moves(&mut self, tool: u32, offset: u32, settings: &Settings) {
        self.tool = settings.calls_tools().then_some(tool);
        self.loaded = Some(tool);
        self.loaded_offset = Some(offset);
        if settings.calls_offsets() {
            self.offset.set(Some(offset), Due::WithZ);
        } else if settings.has_edges() {
            self.offset.set(Some(offset), Due::Now);
        } else if settings.calls_tools_with_offset() {
            self.offset.set(Some(offset).filter(|offset| *offset > 0), Due::Now);
        }
    }

    /// The end of tool-tip control, or a position of the machine, has taken the length off: the next
    /// motion of Z calls it again.
    pub(super) fn length_is_taken_off(&mut self) {
        let must = self.offset.now;
        if must.is_some() && self.offset.next.is_none() {
            self.offset = Lag::new(None);
            self.offset.set(must, Due::WithZ);
        }
    }

    /// The length offset at the last motion.
    pub(super) fn offset_on(&self) -> Option<u32> {
        self.offset_on
    }

    /// A length offset is still to be called.
    pub(super) fn offset_waits(&self) -> bool {
        self.offset.next.is_some()
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
