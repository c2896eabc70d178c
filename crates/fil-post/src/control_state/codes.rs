//! What the preparatory functions of a machine mean: the codes its settings name,
//! and for texts of others the usual ones (ISO 6983, RS-274).

use fil_machine::locations::{
    self as loc, ControlFamily, MillTurnMode, RotaryTipOutput, ThreadCycle, ToolFormat,
};
use fil_machine::mill_turn;
use fil_machine::modes::{FeedMode, Plane, Unit};
use fil_machine::osp_lengths;
use fil_machine::setting::CodeAt;
use fil_machine::{Commons, FunctionCode, Letter, letters};

use super::{Compensation, Distance, Rotation, length, text};

/// G34 and G35 of a SINUMERIK: threading moves whose lead grows, and shrinks.
pub const VARYING_LEADS_OF_SINUMERIK: [FunctionCode; 2] =
    [FunctionCode::whole(34), FunctionCode::whole(35)];

/// G71 of an OSP: a whole thread.
pub const THREAD_OF_OSP: FunctionCode = FunctionCode::whole(71);

/// What a preparatory function does to the state of the control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// The kind of motion: rapid, line, arc, thread.
    Motion,
    /// The plane.
    Plane(Plane),
    /// How coordinates count.
    Distance(Distance),
    /// The unit.
    Unit(Unit),
    /// What F means.
    FeedMode(FeedMode),
    /// Cutter compensation.
    Compensation(Compensation),
    /// A canned cycle.
    Cycle,
    /// The end of a canned cycle.
    CycleOff,
    /// The level a cycle returns to.
    ReturnLevel,
    /// S is a surface speed, or turns.
    SurfaceSpeed(bool),
    /// X is a diameter.
    Diameters,
    /// It acts in its block alone, or on what the post does not depend on.
    OneBlock,
    /// A turning cycle: it leaves axes, motion and feed elsewhere.
    Turning,
    /// The length of the tool: where Z stands in the program is not known.
    ToolLength,
    /// Tool-tip control: X, Y and Z name the tip in the part.
    TipControl,
    /// It moves the zero, or the axes by a way of its own: where they stand in the
    /// program is not known.
    Frame,
    /// It begins, moves or ends a tilted frame.
    Tilt,
    /// Not known.
    Unknown,
}

/// The usual functions that turn the spindle.
const CLOCKWISE: FunctionCode = FunctionCode::whole(3);
const COUNTERCLOCKWISE: FunctionCode = FunctionCode::whole(4);

/// The usual functions that stop it.
const STOP: FunctionCode = FunctionCode::whole(5);
const ORIENT: FunctionCode = FunctionCode::whole(19);

/// M70 of a SINUMERIK: the spindle stands and is an axis.
const AXIS_OF_SINUMERIK: FunctionCode = FunctionCode::whole(70);

/// The functions of a machine.
#[derive(Clone, Debug)]
pub struct Codes {
    named: Vec<(FunctionCode, Meaning)>,
    /// Feeds are G98 and G99: then G90, G92 and G94 are turning cycles.
    turning: bool,
    /// The machine has canned cycles that a code ends.
    has_cycle_off: bool,
    /// Auxiliary functions of the spindle ranges.
    ranges: Vec<FunctionCode>,
    /// Auxiliary functions that turn the spindle or stop it.
    turns: [(FunctionCode, Rotation); 4],
    /// The same of the second spindle of a lathe, where it has its own and the control counts
    /// the one that a function chooses.
    side_turns: Option<[(FunctionCode, Rotation); 3]>,
    /// Auxiliary functions that choose the spindle which the control counts.
    choices: [Option<FunctionCode>; 2],
    /// Auxiliary functions that stop the program.
    stops: [Option<FunctionCode>; 2],
    /// Auxiliary functions that clamp the rotary axes and release them.
    clamps: [Option<FunctionCode>; 2],
    /// The lowest and the highest code of the work offsets.
    fixtures: Option<(FunctionCode, FunctionCode)>,
    /// The function that takes the length of the tool off.
    length_cancel: Option<FunctionCode>,
    /// The lengths of tools are called by a function.
    pub(super) calls_lengths: bool,
    /// A position of the machine ends the length of the axis that goes there.
    pub(super) positions_end_lengths: bool,
    /// Tool-tip control takes the length of the last LOADTL.
    pub(super) tip_control: bool,
    /// The functions are those of a SINUMERIK.
    sinumerik: bool,
    /// The function that limits the speed of the spindle.
    speed_limit: Option<FunctionCode>,
    /// The last digits of T are the offset: T0303.
    pub tool_word_has_offset: bool,
    /// T changes the tool by itself, as on a turret.
    pub tool_word_changes: bool,
}

impl Codes {
    /// The axis that a letter moves: U, V and W of a lathe whose feeds are G98 and G99 are
    /// increments of X, Y and Z.
    pub fn moved_by(&self, letter: Letter) -> Letter {
        let increments = [b'U', b'V', b'W'];
        let index = increments.iter().position(|byte| *byte == letter.byte());
        index.filter(|_| self.turning).map_or(letter, |index| letters::XYZ[index])
    }

    /// The functions that the settings name.
    pub fn from_commons(commons: &Commons) -> Self {
        let turning = commons.read(loc::FEED_UPM_CODE) == Some(98);
        let code = |at: CodeAt| commons.read(at).and_then(FunctionCode::of_setting);
        let mut codes = Codes {
            fixtures: code(loc::FIXTURE_MIN_CODE).zip(code(loc::FIXTURE_MAX_CODE)),
            named: Vec::with_capacity(48),
            turning,
            stops: [loc::PROGRAM_STOP_CODE, loc::PROGRAM_OPSTOP_CODE].map(code),
            clamps: [loc::ROTARY_CLAMP_CODE, loc::ROTARY_UNCLAMP_CODE].map(code),
            length_cancel: match osp_lengths::are_meant(commons) {
                true => Some(osp_lengths::CANCEL),
                false => code(loc::TOOL_LENGTH_CANCEL_CODE),
            },
            calls_lengths: length::are_called(commons),
            positions_end_lengths: length::are_called(commons)
                && commons.read(loc::HOME_ENDS_LENGTH),
            tip_control: commons.read(loc::ROTARY_TIP_OUTPUT) == RotaryTipOutput::ToolTipControl,
            sinumerik: commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik,
            has_cycle_off: commons.read(loc::CYCLE_OFF_CODE).is_some(),
            ranges: loc::RANGE_CODES
                .iter()
                .filter_map(|at| commons.read(*at).and_then(FunctionCode::of_setting))
                .collect(),
            turns: turns(commons),
            side_turns: side_turns(commons),
            choices: [loc::SPINDLE_SIDE_MASTER_CODE, loc::SPINDLE_MAIN_MASTER_CODE].map(code),
            speed_limit: code(loc::SPINDLE_MAX_CODE),
            tool_word_has_offset: commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress
                && commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode,
            tool_word_changes: commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode
                || commons.read(loc::TOOL_CHANGE_CODE).is_none(),
        };
        let codes_are_calls = codes.sinumerik;
        if codes_are_calls {
            codes.named.extend(VARYING_LEADS_OF_SINUMERIK.map(|code| (code, Meaning::Motion)));
        }
        if commons.read(loc::THREAD_CYCLE) == ThreadCycle::G71OfAnOsp {
            codes.named.push((THREAD_OF_OSP, Meaning::Turning));
        }
        let mut name = |at: CodeAt, meaning: Meaning| {
            let code = commons.read(at).and_then(FunctionCode::of_setting);
            if let Some(code) = code {
                codes.named.push((code, meaning));
            }
        };
        for at in loc::MOTION_CODES.into_iter().chain([loc::THREAD_CODE, loc::THREAD_VARYING_CODE])
        {
            name(at, Meaning::Motion);
        }
        name(loc::THREAD_CYCLE_CODE, Meaning::Turning);
        for (at, meaning) in MODES {
            name(at, meaning);
        }
        // Cycles of a SINUMERIK are called, and their numbers are no functions.
        let cycles = if codes_are_calls { &[][..] } else { &loc::CYCLE_CODES[..] };
        for at in cycles {
            name(*at, Meaning::Cycle);
        }
        let mills = mill_turn::mode(commons).is_some();
        for at in mill_turn::CYCLE_CODES.into_iter().filter(|_| mills) {
            name(at, Meaning::Cycle);
        }
        let tenths = |at| {
            let code = commons.int_opt(at).and_then(|code| u32::try_from(code).ok());
            code.map(FunctionCode::tenths)
        };
        let extended = tenths(loc::FIXTURE_EXTENDED_CODE);
        let taps = [loc::CYCLE_RIGID_TAP_CODE, loc::CYCLE_RIGID_TAP_LEFT_CODE].map(tenths);
        let tips = [loc::ROTARY_TIP_CODE, loc::ROTARY_VECTOR_CODE].map(tenths);
        let planes = [
            loc::MILL_TURN_POLAR_CODE,
            loc::MILL_TURN_POLAR_END_CODE,
            loc::MILL_TURN_CYLINDER_CODE,
        ];
        let planes = planes.map(tenths).into_iter().flatten();
        let tilts = [loc::ROTARY_FRAME_CODE, loc::ROTARY_FRAME_ALIGN_CODE].map(tenths);
        if !turning {
            name(loc::MODE_PRESET_CODE, Meaning::Frame);
            name(loc::MODE_ABSOLUTE_CODE, Meaning::Distance(Distance::Absolute));
            name(loc::MODE_INCREMENTAL_CODE, Meaning::Distance(Distance::Incremental));
        }
        if osp_lengths::are_meant(commons) {
            codes.named.extend(osp_lengths::codes().map(|code| (code, Meaning::ToolLength)));
        }
        codes.named.extend(planes.filter(|_| mills).map(|code| (code, Meaning::Frame)));
        codes.named.extend(extended.map(|code| (code, Meaning::Frame)));
        codes.named.extend(tips.into_iter().flatten().map(|code| (code, Meaning::TipControl)));
        codes.named.extend(tilts.into_iter().flatten().map(|code| (code, Meaning::Tilt)));
        codes.named.extend(taps.into_iter().flatten().map(|code| (code, Meaning::Cycle)));
        codes
    }

    /// What a code does.
    #[inline]
    pub fn meaning(&self, code: FunctionCode) -> Meaning {
        match self.named.iter().find(|(named, _)| *named == code) {
            Some((_, meaning)) => *meaning,
            None => match self.usual(code) {
                Meaning::Unknown if self.is_in_range_of_fixtures(code) => Meaning::Frame,
                usual => usual,
            },
        }
    }

    fn is_in_range_of_fixtures(&self, code: FunctionCode) -> bool {
        self.fixtures.is_some_and(|(first, last)| first <= code && code <= last)
    }

    /// True for a function whose block goes to positions of the machine.
    pub fn is_of_machine(&self, code: FunctionCode) -> bool {
        let is_named = self.named.iter().any(|(named, _)| *named == code);
        !is_named && matches!(code.value(), 53.0 | 153.0)
    }

    /// True for a function that chooses a work offset, whichever words stand beside it.
    pub fn is_fixture(&self, code: FunctionCode) -> bool {
        let value = code.value();
        let is_usual = match self.sinumerik {
            true => matches!(value, 54.0..=57.0 | 505.0..=599.0),
            false => (54.0..=59.0).contains(&value),
        };
        value.fract() == 0.0 && (is_usual || self.is_in_range_of_fixtures(code))
    }

    /// True for a function that chooses a work offset, by itself or by a word beside it.
    pub fn chooses_offset(&self, code: FunctionCode) -> bool {
        let by_a_word = (54.0..60.0).contains(&code.value()) || code.value() == 500.0;
        (self.is_fixture(code) || by_a_word) && self.meaning(code) != Meaning::ToolLength
    }

    /// True for a function of the frame that leaves the work offset in force.
    pub fn keeps_fixture(&self, code: FunctionCode) -> bool {
        self.is_of_machine(code) || self.is_home(code) || matches!(code.value(), 27.0 | 52.0 | 92.0)
    }

    /// True for a function that goes to a reference point of the machine.
    pub fn is_home(&self, code: FunctionCode) -> bool {
        let homes: &[f64] = if self.sinumerik { &[74.0, 75.0] } else { &[28.0, 30.0] };
        let is_named = self.named.iter().any(|(named, _)| *named == code);
        !is_named && homes.contains(&code.value())
    }

    /// True for a function that takes the length of the tool off.
    pub fn takes_length(&self, code: FunctionCode) -> bool {
        code == FunctionCode::whole(49) || self.length_cancel == Some(code)
    }

    /// True for the code of a spindle range.
    pub fn is_spindle_range(&self, code: FunctionCode) -> bool {
        self.ranges.contains(&code)
    }

    /// True for the function that chooses the spindle which the control counts.
    pub fn chooses_spindle(&self, code: FunctionCode) -> bool {
        self.choices.contains(&Some(code))
    }

    /// How the spindle turns after an auxiliary function, the second one of a lathe where that is
    /// counted; `None` for one that leaves it.
    pub fn rotation(&self, code: FunctionCode, of_side: bool) -> Option<Rotation> {
        if self.sinumerik && code == AXIS_OF_SINUMERIK {
            return Some(Rotation::Standing);
        }
        if let Some(turns) = self.side_turns.filter(|_| of_side) {
            return turns.iter().find(|(turning, _)| *turning == code).map(|(_, way)| *way);
        }
        self.turns.iter().find(|(turning, _)| *turning == code).map(|(_, rotation)| *rotation)
    }

    /// True for a function that stops the program, always or where the operator wants it.
    pub fn stops_program(&self, code: FunctionCode) -> bool {
        self.stops.contains(&Some(code))
    }

    /// Whether a function clamps the rotary axes or releases them; `None` for any other.
    pub fn clamps(&self, code: FunctionCode) -> Option<bool> {
        let index = self.clamps.iter().position(|named| *named == Some(code))?;
        Some(index == 0)
    }

    /// True where the functions of the speed stand in one group with those of the feed.
    pub fn speeds_are_feeds(&self) -> bool {
        self.sinumerik
    }

    /// What F counts behind a function of the speed: on a SINUMERIK G96, G97 and G973 are feeds a
    /// turn, G961 and G971 feeds a minute, and G962 and G972 leave it open.
    pub fn feed_behind_speed(
        &self,
        code: FunctionCode,
        before: Option<FeedMode>,
    ) -> Option<FeedMode> {
        const A_MINUTE: [FunctionCode; 2] = [FunctionCode::whole(961), FunctionCode::whole(971)];
        const OPEN: [FunctionCode; 2] = [FunctionCode::whole(962), FunctionCode::whole(972)];
        match code {
            _ if !self.speeds_are_feeds() => before,
            _ if A_MINUTE.contains(&code) => Some(FeedMode::PerMinute),
            _ if OPEN.contains(&code) => None,
            _ => Some(FeedMode::PerRevolution),
        }
    }

    /// True for words that move axes to positions of the part, with the length of the tool as it was:
    /// none of their functions calls one, moves the zero or goes to a place of the machine.
    pub fn moves_in_part(&self, words: &[(Letter, f64)]) -> bool {
        !self.places_zero(words)
            && text::functions(words).all(|code| match self.meaning(code) {
                Meaning::ToolLength | Meaning::TipControl | Meaning::Tilt | Meaning::Unknown => {
                    false
                }
                Meaning::Frame => self.chooses_offset(code),
                Meaning::OneBlock => code != FunctionCode::whole(4),
                _ => true,
            })
    }

    /// True for words that place the zero: those of the function that limits the speed, which on a
    /// lathe does so where X or Z stand beside it (G50 X100. Z50.).
    pub fn places_zero(&self, words: &[(Letter, f64)]) -> bool {
        let has = |letters: &[u8]| words.iter().any(|(letter, _)| letters.contains(&letter.byte()));
        let limits = |(letter, value): &(Letter, f64)| {
            *letter == letters::G && FunctionCode::of_value(*value) == self.speed_limit
        };
        self.speed_limit.is_some() && words.iter().any(limits) && has(b"XZUW")
    }

    /// True when a motion function ends a cycle that no code ends.
    pub fn motion_ends_cycle(&self) -> bool {
        !self.has_cycle_off && !self.sinumerik
    }

    /// True when no function of a motion can end a cycle: `MCALL` does.
    pub fn keeps_cycles(&self) -> bool {
        self.sinumerik
    }

    /// What a code does that no setting names.
    fn usual(&self, code: FunctionCode) -> Meaning {
        let value = code.value();
        if value.fract() != 0.0 {
            return of_tenths(code);
        }
        if self.sinumerik {
            return of_sinumerik(value as u16);
        }
        match value as u16 {
            0..=3 => Meaning::Motion,
            17 => Meaning::Plane(Plane::Xy),
            18 => Meaning::Plane(Plane::Zx),
            19 => Meaning::Plane(Plane::Yz),
            20 | 70 if !self.turning => Meaning::Unit(Unit::Inch),
            21 | 71 if !self.turning => Meaning::Unit(Unit::Mm),
            20 => Meaning::Unit(Unit::Inch),
            21 => Meaning::Unit(Unit::Mm),
            40 => Meaning::Compensation(Compensation::Off),
            41 => Meaning::Compensation(Compensation::Left),
            42 => Meaning::Compensation(Compensation::Right),
            32 | 33 => Meaning::Motion,
            70..=78 | 90 | 92 | 94 if self.turning => Meaning::Turning,
            73 | 74 | 76 | 81..=89 => Meaning::Cycle,
            80 => Meaning::CycleOff,
            90 => Meaning::Distance(Distance::Absolute),
            91 => Meaning::Distance(Distance::Incremental),
            93 => Meaning::FeedMode(FeedMode::InverseTime),
            94 => Meaning::FeedMode(FeedMode::PerMinute),
            95 => Meaning::FeedMode(FeedMode::PerRevolution),
            96..=99 => Meaning::OneBlock,
            4 | 9 | 61 | 64 => Meaning::OneBlock,
            43 | 44 | 49 => Meaning::ToolLength,
            10 | 27..=30 | 50 | 52..=59 | 92 => Meaning::Frame,
            68 | 69 => Meaning::Tilt,
            _ => Meaning::Unknown,
        }
    }
}

/// The functions that turn the spindle in use or stop it: of a mill-turn machine that mills
/// the live tool, whatever functions of the main spindle a text may hold.
fn turns(commons: &Commons) -> [(FunctionCode, Rotation); 4] {
    let mills = mill_turn::mode(commons).is_some_and(|mode| mode != MillTurnMode::Turning);
    let [clockwise, counterclockwise, stop] = match mills {
        true => [
            loc::MILL_TURN_LIVE_CW_CODE,
            loc::MILL_TURN_LIVE_CCW_CODE,
            loc::MILL_TURN_LIVE_STOP_CODE,
        ],
        false => [loc::SPINDLE_CW_CODE, loc::SPINDLE_CCW_CODE, loc::SPINDLE_STOP_CODE],
    };
    let code =
        |at: CodeAt, usual| commons.read(at).and_then(FunctionCode::of_setting).unwrap_or(usual);
    [
        (code(clockwise, CLOCKWISE), Rotation::Clockwise),
        (code(counterclockwise, COUNTERCLOCKWISE), Rotation::Counterclockwise),
        (code(stop, STOP), Rotation::Standing),
        (code(loc::SPINDLE_ORIENT_CODE, ORIENT), Rotation::Standing),
    ]
}

/// The functions of the second spindle of a lathe, where the control is told which one it counts.
fn side_turns(commons: &Commons) -> Option<[(FunctionCode, Rotation); 3]> {
    let code = |at: CodeAt| commons.read(at).and_then(FunctionCode::of_setting);
    code(loc::SPINDLE_SIDE_MASTER_CODE)?;
    Some([
        (code(loc::SPINDLE_SIDE_CW_CODE)?, Rotation::Clockwise),
        (code(loc::SPINDLE_SIDE_CCW_CODE)?, Rotation::Counterclockwise),
        (code(loc::SPINDLE_SIDE_STOP_CODE)?, Rotation::Standing),
    ])
}

/// What the codes with a decimal do that controls of today share: high-speed modes,
/// tool-tip control, work offsets, tilted planes.
fn of_tenths(code: FunctionCode) -> Meaning {
    const HIGH_SPEED: FunctionCode = FunctionCode::tenths(51);
    const TIP: [FunctionCode; 2] = [FunctionCode::tenths(434), FunctionCode::tenths(435)];
    const TILTS: [FunctionCode; 4] = [
        FunctionCode::tenths(531),
        FunctionCode::tenths(682),
        FunctionCode::tenths(683),
        FunctionCode::tenths(684),
    ];
    let offset = (54.0..60.0).contains(&code.value());
    match code {
        HIGH_SPEED => Meaning::OneBlock,
        _ if TIP.contains(&code) => Meaning::TipControl,
        _ if TILTS.contains(&code) => Meaning::Tilt,
        _ if offset => Meaning::Frame,
        _ => Meaning::Unknown,
    }
}

/// What the functions of a SINUMERIK do.
fn of_sinumerik(code: u16) -> Meaning {
    match code {
        0..=3 | 33..=35 | 331 | 332 => Meaning::Motion,
        4 | 9 | 25 | 26 | 60 | 64 | 601..=603 | 641..=645 | 450 | 451 => Meaning::OneBlock,
        96 | 961 | 962 => Meaning::SurfaceSpeed(true),
        97 | 971..=973 => Meaning::SurfaceSpeed(false),
        17 => Meaning::Plane(Plane::Xy),
        18 => Meaning::Plane(Plane::Zx),
        19 => Meaning::Plane(Plane::Yz),
        40 => Meaning::Compensation(Compensation::Off),
        41 => Meaning::Compensation(Compensation::Left),
        42 => Meaning::Compensation(Compensation::Right),
        70 | 700 => Meaning::Unit(Unit::Inch),
        71 | 710 => Meaning::Unit(Unit::Mm),
        90 => Meaning::Distance(Distance::Absolute),
        91 => Meaning::Distance(Distance::Incremental),
        93 => Meaning::FeedMode(FeedMode::InverseTime),
        94 => Meaning::FeedMode(FeedMode::PerMinute),
        95 => Meaning::FeedMode(FeedMode::PerRevolution),
        53..=57 | 74 | 75 | 153 | 500 | 505..=599 => Meaning::Frame,
        _ => Meaning::Unknown,
    }
}

const MODES: [(CodeAt, Meaning); 20] = [
    (loc::LATHE_DIAMETER_CODE, Meaning::Diameters),
    (loc::CIRCLE_PLANE_XY, Meaning::Plane(Plane::Xy)),
    (loc::CIRCLE_PLANE_ZX, Meaning::Plane(Plane::Zx)),
    (loc::CIRCLE_PLANE_YZ, Meaning::Plane(Plane::Yz)),
    (loc::UNITS_METRIC_CODE, Meaning::Unit(Unit::Mm)),
    (loc::UNITS_INCH_CODE, Meaning::Unit(Unit::Inch)),
    (loc::FEED_UPM_CODE, Meaning::FeedMode(FeedMode::PerMinute)),
    (loc::FEED_UPR_CODE, Meaning::FeedMode(FeedMode::PerRevolution)),
    (loc::FEED_INVERSE_CODE, Meaning::FeedMode(FeedMode::InverseTime)),
    (loc::CUTCOM_OFF_CODE, Meaning::Compensation(Compensation::Off)),
    (loc::CUTCOM_LEFT_CODE, Meaning::Compensation(Compensation::Left)),
    (loc::CUTCOM_RIGHT_CODE, Meaning::Compensation(Compensation::Right)),
    (loc::CYCLE_OFF_CODE, Meaning::CycleOff),
    (loc::CYCLE_RETURN_CLEAR_CODE, Meaning::ReturnLevel),
    (loc::CYCLE_RETURN_INITIAL_CODE, Meaning::ReturnLevel),
    (loc::DWELL_CODE, Meaning::OneBlock),
    (loc::SPINDLE_CSS_CODE, Meaning::SurfaceSpeed(true)),
    (loc::SPINDLE_RPM_CODE, Meaning::SurfaceSpeed(false)),
    (loc::SPINDLE_MAX_CODE, Meaning::OneBlock),
    (loc::TOOL_LENGTH_CODE, Meaning::ToolLength),
];
