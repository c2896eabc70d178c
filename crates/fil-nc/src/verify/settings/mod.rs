//! What the back-check has to know of a machine besides its kinematics: the last
//! digit of each address, where a post may put a word, and what the settings add.

mod cycles;
mod functions;
mod motions;
mod tools;
mod user_texts;

use fil_diag::Diag;
use fil_machine::address::Addresses;
use fil_machine::commons::{Commons, Dbl, Int};
use fil_machine::input_matrix::input_matrix;
use fil_machine::letter::{Letter, letters};
use fil_machine::locations::{
    self as loc, CircleCenter, ControlFamily, Exceeded, InputKind, Placement, RapidSplit,
    RotaryClwAlongNormal, RotaryDefaultClw, RotaryFacesPositive,
};
use nalgebra::Matrix3x4;

use crate::dialect::{Dialect, Habit};
use crate::forward::Forward;
use crate::motion::{FOOT, unit};
use crate::verify::cl_path::FrameWords;

/// How far an axis may be asked to stand from 0 when the program never writes it, mm.
const NOT_WRITTEN: f64 = 1e-3;

/// What binary fractions may add to the last digit.
const DUST: f64 = 1e-7;

/// Half of the last digit of a dwell in Klartext, seconds.
const KLARTEXT_DWELL: f64 = 5e-4;

const SCALES: [Dbl; 6] =
    [loc::SCALE_X, loc::SCALE_Y, loc::SCALE_Z, loc::SCALE_A, loc::SCALE_B, loc::SCALE_C];

/// When a word that waits must be in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Due {
    /// At once.
    Now,
    /// When X or Y moves.
    WithXY,
    /// When an axis of the plane in force moves.
    InPlane,
    /// With the next motion of any of them.
    WithAny,
    /// When Z moves.
    WithZ,
}

/// How far a value on the tape may lie from the exact one: half of the last
/// digit of its address, or what the user allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// X, Y, Z, mm.
    pub linear: [f64; 3],
    /// X where no transformation makes it a radius, mm.
    pub outside_transformations: f64,
    /// What of that only an axis may be off by that stays, as a coordinate that changes by
    /// less is not written, mm.
    pub kept: f64,
    /// Last digit of X, Y, Z, mm, where a value is rounded before it is scaled.
    pub rounded: [Option<f64>; 3],
    /// Primary and secondary rotary axis, degrees.
    pub rotary: [f64; 2],
    /// I, J, K, mm.
    pub center: [f64; 3],
    /// All others.
    scalars: [f64; Quantity::ALL.len()],
}

/// A value of one number that a program writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Radius of an arc, mm.
    Radius,
    /// Level or length in a cycle of the control, whatever way its tool goes, mm.
    Cycle,
    /// Feed, mm/min.
    Feed,
    /// Feed, mm a turn.
    FeedPerTurn,
    /// Lead of a thread, mm.
    Lead,
    /// Feed in inverse time, blocks a minute.
    InverseTime,
    /// Spindle speed, rpm.
    Speed,
    /// Surface speed, m/min.
    SurfaceSpeed,
    /// Dwell, seconds.
    Dwell,
    /// Dwell, turns of the spindle.
    DwellTurns,
    /// Most by which seconds are longer than the turns that they stand for, seconds.
    SecondsOfTurns,
}

impl Quantity {
    /// All of them, in their order.
    const ALL: [Quantity; 11] = [
        Quantity::Radius,
        Quantity::Cycle,
        Quantity::Feed,
        Quantity::FeedPerTurn,
        Quantity::Lead,
        Quantity::InverseTime,
        Quantity::Speed,
        Quantity::SurfaceSpeed,
        Quantity::Dwell,
        Quantity::DwellTurns,
        Quantity::SecondsOfTurns,
    ];
}

impl Tolerances {
    /// That of a value of one number.
    pub fn of(&self, quantity: Quantity) -> f64 {
        self.scalars[quantity as usize]
    }

    /// A position of X, Y or Z, 0 to 2, as it is rounded before an output scale, mm.
    pub fn before_scale(&self, number: usize, position: f64) -> f64 {
        self.rounded[number].map_or(position, |digit| to_digit(position, digit))
    }
}

/// A value as the last digit shows it, halves away from zero.
fn to_digit(value: f64, digit: f64) -> f64 {
    let steps = value / digit;
    // A half of a decimal number may be a little less in binary.
    (steps + HALF * steps.signum()).round() * digit
}

/// What a half may lack, steps.
const HALF: f64 = 1e-9;

/// The machine as the back-check sees it.
#[derive(Clone, Debug)]
pub struct Settings<'c> {
    pub(super) commons: &'c Commons,
    /// Its forward kinematics.
    pub forward: Forward,
    /// What the words of its programs mean.
    pub(super) dialect: Dialect,
    /// What the user allows besides the last digit; `None` for nothing.
    tolerance: Option<f64>,
}

impl<'c> Settings<'c> {
    /// The settings of a machine; `tolerance` in mm and degrees.
    ///
    /// # Errors
    /// A machine whose kinematics make no sense.
    pub fn new(commons: &'c Commons, tolerance: Option<f64>) -> Result<Self, Box<Diag>> {
        let forward = Forward::from_commons(commons)?;
        Ok(Settings { commons, forward, dialect: Dialect::new(commons)?, tolerance })
    }

    /// The main spindle can become the axis C.
    pub fn is_mill_turn(&self) -> bool {
        self.dialect.turning.live_at_start.is_some()
    }

    /// How far the tip may leave its line while the machine turns where the CL file does not
    /// say it, mm.
    pub fn divides_within(&self) -> Option<f64> {
        self.commons.dbl_opt(loc::ROTARY_TOLERANCE).filter(|most| *most > 0.0)
    }

    /// How far the tool may lean out of the plane of its ends between the ends of a motion,
    /// degrees.
    pub fn leans_most(&self) -> Option<f64> {
        self.commons.dbl_opt(loc::ROTARY_AXIS_TOLERANCE).filter(|most| *most > 0.0)
    }

    /// The codes that clamp and release the rotary axes, where the post clamps them: in tilted
    /// work planes, or after rapid turns.
    pub fn clamps_of_post(&self) -> Option<[u32; 2]> {
        let in_frames = self.commons.read(loc::ROTARY_FRAME_OUTPUT)
            == loc::RotaryFrameOutput::TiltedWorkPlane
            || self.commons.read(loc::MOTION_PLANAR);
        let clamps = match in_frames {
            true => self.commons.read(loc::ROTARY_FRAME_CLAMP),
            false => self.commons.read(loc::ROTARY_TURN_CLAMP),
        };
        let codes = [loc::ROTARY_CLAMP_CODE, loc::ROTARY_UNCLAMP_CODE]
            .map(|at| self.commons.read(at).and_then(|code| u32::try_from(code).ok()));
        Some([codes[0]?, codes[1]?]).filter(|_| clamps)
    }

    /// The main spindle is the axis C when the program begins.
    pub fn begins_milling(&self) -> bool {
        self.dialect.turning.live_at_start == Some(true)
    }

    /// Translation of the input, CL units.
    pub fn input_shift(&self) -> [f64; 3] {
        loc::INPUT_TRANSLATE.map(|at| self.commons.dbl_opt(at).unwrap_or(0.0))
    }

    /// The matrix that the machine sends each point through.
    pub fn input_matrix(&self) -> Option<Matrix3x4<f64>> {
        input_matrix(self.commons)
    }

    /// Shift of the input along the tool axis of a machine that turns nothing, CL units.
    pub fn shift_along(&self) -> [f64; 3] {
        let along = self.commons.dbl_opt(loc::INPUT_ALONG_TOOL_AXIS).unwrap_or(0.0);
        let axis = [loc::TOOL_AXIS_I, loc::TOOL_AXIS_J, loc::TOOL_AXIS_K]
            .map(|at| self.commons.dbl_opt(at).unwrap_or(0.0));
        let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        axis.map(|part| part / length * along)
    }

    /// What the machine takes ORIGIN, TRACUT and ROTABL for.
    pub fn frame_words(&self) -> FrameWords {
        FrameWords {
            origin: self.commons.read(loc::INPUT_ORIGIN),
            tracut: self.commons.read(loc::INPUT_TRACUT),
            csys: self.commons.read(loc::INPUT_CSYS),
            offsets: self.offset_functions(),
            without_effect: self.commons.words_without_effect().to_vec(),
            table: self.commons.read(loc::ROTARY_TABLE_WORDS),
            clockwise: self.clockwise(),
            by_default: self.commons.read(loc::ROTARY_DEFAULT_CLW) == RotaryDefaultClw::Yes,
            forward: self.forward.has_rotary().then(|| self.forward.clone()),
            turned: [None; 2],
            author_turns: self.tables_that_stay(),
        }
    }

    /// The letters of the tables that stay where a block of an author turns them: all but those
    /// that tool center point control, tilted work planes or a mill-turn machine turn.
    fn tables_that_stay(&self) -> [Option<u8>; 2] {
        let turns_itself = self.commons.read(loc::ROTARY_TIP_OUTPUT) == loc::RotaryTipOutput::Tcpc
            || self.commons.read(loc::ROTARY_FRAME_OUTPUT)
                == loc::RotaryFrameOutput::TiltedWorkPlane
            || self.is_mill_turn();
        [3, 4].map(|axis| {
            let is_table = self.dialect.tables().any(|table| table == axis);
            let letter = self.dialect.axes[axis].letter + b'A' - 1;
            Some(letter).filter(|_| is_table && !turns_itself)
        })
    }

    /// Which way positions count where the only table turns clockwise, 1 or -1. The table turns
    /// against its positions, which are those of the tool about the part.
    fn clockwise(&self) -> Option<f64> {
        let [Some(table), None] = self.forward.rotaries() else { return None };
        let faces = match self.commons.read(loc::ROTARY_FACES_POSITIVE)? {
            RotaryFacesPositive::Yes => 1.0,
            RotaryFacesPositive::No => -1.0,
        };
        let looks = match self.commons.read(loc::ROTARY_CLW_ALONG_NORMAL) {
            RotaryClwAlongNormal::Yes => faces,
            RotaryClwAlongNormal::No => -faces,
        };
        let along = table.direction[table.axis];
        (along != 0.0).then_some(-looks * along.signum())
    }

    /// True when a matrix of TRANS leaves the tool axis alone.
    pub fn matrix_leaves_axis(&self) -> bool {
        self.commons.read(loc::INPUT_KIND) == InputKind::MatrixOnPoints
    }

    /// The last digits of the addresses in a program in mm or inch.
    pub fn slack(&self, metric: bool) -> Tolerances {
        let addresses = Addresses::from_commons(self.commons, metric);
        let unit = unit(metric);
        let half = |letter: Letter| match addresses.format(letter) {
            Some(format) => 0.5 * format.unscale(1),
            None => NOT_WRITTEN,
        };
        let half_of_feed = |at: Int| match self.commons.int_opt(at) {
            Some(format) => {
                let decimals = if metric { format % 10 } else { format / 100 % 10 };
                0.5 * libm::exp10(-f64::from(decimals))
            }
            None => half(letters::F),
        };
        let of_axis = |letter: Letter, common: usize, unit: f64| {
            self.allowed(half(letter) / self.scale(common) * unit)
        };
        let axes = [0, 1, 2].map(|common| (letters::XYZ[common], common));
        let kept = self.commons.dbl_opt(loc::MOTION_SAME_TOLERANCE).unwrap_or(0.0) * unit;
        let by_hand = self.by_hand(loc::MOTION_RESOLUTION) * unit + kept;
        // A diameter is rounded once, after it is doubled.
        let scaled = |common: usize| {
            let diameter = common == 0 && self.scale(common) == 2.0;
            (self.scale(common) != 1.0 && !diameter).then_some(2.0 * unit)
        };
        let rotary = [0, 1].map(|index| match &self.forward.rotaries()[index] {
            Some(axis) => {
                of_axis(axis.letter, axis.axis + 3, 1.0) + self.by_hand(loc::ROTARY_RESOLUTION)
            }
            None => 0.0,
        });
        let mut linear = axes.map(|(letter, common)| of_axis(letter, common, unit) + by_hand);
        let outside_transformations = linear[0];
        if self.dialect.has(Habit::Transforms) {
            // X is a radius in TRANSMIT and TRACYL.
            linear[0] = self.allowed(half(letters::XYZ[0]) * unit) + by_hand;
        }
        let scalar = |quantity: Quantity| match quantity {
            Quantity::Radius => self.allowed(half(letters::R) * unit),
            Quantity::Cycle => of_axis(letters::XYZ[2], 2, unit),
            Quantity::Feed => half_of_feed(loc::FEED_UPM_FORMAT) * unit / self.feed_factor() + DUST,
            Quantity::FeedPerTurn => half(letters::F) * unit + DUST,
            Quantity::Lead => half_of_feed(loc::THREAD_LEAD_FORMAT) * unit + DUST,
            Quantity::InverseTime => {
                half_of_feed(loc::FEED_INVERSE_FORMAT) / self.inverse_factor() + DUST
            }
            Quantity::Speed => half(letters::S) + DUST,
            Quantity::SurfaceSpeed => half(letters::S) * if metric { 1.0 } else { FOOT } + DUST,
            Quantity::Dwell => self.dwell_slack(half, loc::DWELL_UPM_FORMAT, loc::DWELL_UPM_FACTOR),
            Quantity::DwellTurns => {
                self.dwell_slack(half, loc::DWELL_UPR_FORMAT, loc::DWELL_UPR_FACTOR)
            }
            // They are rounded up, so that so many turns or more are waited for.
            Quantity::SecondsOfTurns => {
                2.0 * self.dwell_slack(half, loc::DWELL_UPR_FORMAT, loc::DWELL_UPM_FACTOR)
            }
        };
        Tolerances {
            linear,
            outside_transformations,
            kept,
            rounded: axes.map(|(letter, common)| Some(half(letter) * scaled(common)?)),
            rotary,
            center: letters::IJK.map(|letter| self.allowed(half(letter) * unit)),
            scalars: Quantity::ALL.map(scalar),
        }
    }

    /// A peck as a cycle of the control has it, mm: its last digit counts once for each peck,
    /// and by the output scale of Z.
    pub fn peck_on_tape(&self, step: f64, metric: bool, of_diameter: bool) -> f64 {
        let letter = match self.commons.read(loc::CONTROL_FAMILY) {
            ControlFamily::WordAddress => self.commons.read(loc::CYCLE_STEP_ADDRESS),
            _ => Some(letters::XYZ[2]),
        };
        let addresses = Addresses::from_commons(self.commons, metric);
        let format = letter.and_then(|letter| addresses.format(letter).copied());
        let Some(format) = format else { return step };
        let of_diameter = if of_diameter { 2.0 } else { 1.0 };
        let digit = format.unscale(1) * unit(metric) / self.scale(2) / of_diameter;
        to_digit(step, digit)
    }

    /// What a resolution set by hand may take from a position, in the unit of the program or
    /// degrees.
    fn by_hand(&self, step: Dbl) -> f64 {
        let is_set =
            self.commons.read(loc::MOTION_RESOLUTION_MANUAL) == loc::MotionResolutionManual::Yes;
        0.5 * self.commons.dbl_opt(step).filter(|_| is_set).unwrap_or(0.0)
    }

    /// What the program multiplies an axis by.
    fn scale(&self, common: usize) -> f64 {
        let diameter = common == 0 && self.is_lathe();
        let scale = self.commons.dbl_opt(SCALES[common]).unwrap_or(1.0).abs();
        if diameter { 2.0 } else { scale }
    }

    /// What the program multiplies X by when it begins.
    pub fn x_scale(&self) -> f64 {
        self.scale(0)
    }

    fn dwell_slack(&self, half: impl Fn(Letter) -> f64, format: Int, factor: Dbl) -> f64 {
        if self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext {
            // Klartext has no letter for it: seconds in thousandths.
            return KLARTEXT_DWELL + DUST;
        }
        let factor = self.commons.dbl_opt(factor).filter(|factor| *factor > 0.0);
        let letter = self.commons.read(loc::DWELL_ADDRESS).unwrap_or(Letter::of(b'P'));
        let own = self.commons.int_opt(format).filter(|digits| *digits > 0);
        // F has the digits of feeds.
        let of_feeds =
            || self.commons.int_opt(loc::FEED_UPM_FORMAT).filter(|_| letter == letters::F);
        let own = own.or_else(of_feeds);
        let coarse = own.map_or(0.0, |digits| {
            // The last digit of each half of the format says its decimals; the fewer count.
            let decimals = (digits / 100 % 10).min(digits % 10);
            0.5 * libm::exp10(-f64::from(decimals))
        });
        half(letter).max(coarse) / factor.unwrap_or(1.0) + DUST
    }

    /// Control's feed unit in a unit of length a minute.
    fn feed_factor(&self) -> f64 {
        self.commons.dbl_opt(loc::FEED_UPM_FACTOR).filter(|factor| *factor > 0.0).unwrap_or(1.0)
    }

    /// Control's inverse time in motions a minute.
    fn inverse_factor(&self) -> f64 {
        self.commons.dbl_opt(loc::FEED_INVERSE_FACTOR).filter(|factor| *factor > 0.0).unwrap_or(1.0)
    }

    fn allowed(&self, last_digit: f64) -> f64 {
        self.tolerance.unwrap_or(0.0).max(last_digit) + DUST
    }

    /// Travel of the linear axes in mm where the machine checks it.
    pub fn travel(&self, metric: bool) -> [(f64, f64); 3] {
        if !self.commons.read(loc::LIMITS_CHECK) {
            return [(f64::NEG_INFINITY, f64::INFINITY); 3];
        }
        let unit = unit(metric);
        let of = |at: Dbl, otherwise: f64| {
            self.commons.dbl_opt(at).map_or(otherwise, |limit| limit * unit)
        };
        loc::LINEAR_LIMITS.map(|(min, max)| (of(min, f64::NEG_INFINITY), of(max, f64::INFINITY)))
    }

    /// Which of X, Y and Z a straight motion may bring out of their travel: the post has warned.
    pub fn leaves_travel(&self) -> [bool; 3] {
        let commons = self.commons;
        let rules = self.forward.has_rotary()
            && !self.is_mill_turn()
            && commons.read(loc::REPOS_CHECK_LINEAR);
        loc::LINEAR_EXCEEDED.map(|at| rules && commons.read(at) == Exceeded::Warn)
    }

    /// Deviation allowed when an arc is written as short lines, mm.
    pub fn chord_tolerance(&self) -> f64 {
        self.commons.dbl_opt(loc::CIRCLE_CHORD_TOLERANCE).unwrap_or(0.005)
    }

    /// True when a rapid goes across, turns and goes down in blocks of their own.
    pub fn splits_rapids(&self) -> bool {
        self.commons.read(loc::RAPID_SPLIT) != RapidSplit::OneBlock
    }

    /// Which of X, Y, Z the program writes; one that it never writes stands at 0.
    pub fn written(&self) -> [bool; 3] {
        let [x, y, z] = letters::XYZ.map(|letter| self.writes(letter));
        // Y of TRANSMIT and TRACYL is no axis of the machine.
        [x, y && !self.dialect.has(Habit::Transforms), z]
    }

    fn writes(&self, letter: Letter) -> bool {
        Addresses::from_commons(self.commons, true).position(letter).is_some()
    }

    /// True for a control that turns helices by angles: their ends are coordinates of no word.
    pub fn turns_by_angles(&self) -> bool {
        self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext
    }

    /// True when an arc is written with its radius.
    pub fn writes_radius(&self) -> bool {
        self.commons.read(loc::CIRCLE_CENTER) == CircleCenter::Radius
    }
}

fn due(placement: Placement) -> Due {
    match placement {
        Placement::NextXyBlock => Due::WithXY,
        Placement::NextZBlock => Due::WithZ,
        Placement::BlockOfItsOwn => Due::Now,
    }
}
