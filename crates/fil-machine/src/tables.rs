//! What the commons say about a machine at this moment: addresses, axis words,
//! axis chain. The tables are made anew when a setting or the unit has changed.

use fil_diag::Result;
use nalgebra::{Matrix3x4, Vector3};

use crate::Letter;
use crate::address::Addresses;
use crate::axes::{AXES, Axis, AxisSet, Position, linear_letters};
use crate::axis_chain::{AxisChain, ROTARY_LETTERS};
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::frame_rules;
use crate::full_turn;
use crate::input_matrix::input_matrix;
use crate::letter::letters::{F, IJK};
use crate::locations::{self as loc, ControlFamily, MillTurnMode, RotaryTipForm, RotaryTipOutput};
use crate::mill_turn;
use crate::modes::FeedMode;
use crate::motion_rules::{FeedFormats, MotionRules};
use crate::number::NumberFormat;
use crate::numbering::Numbering;
use crate::rotary_feed_rules::RotaryFeedRules;
use crate::tape_style::TapeStyle;
use crate::travel_rules::{self, TravelRules};
use crate::user_blocks;

/// What option files hold where a move may be of any length, mm or inch.
const NO_DEPARTURE: f64 = 9999.9998;

/// The tables.
#[derive(Clone, Debug, Default)]
pub struct MachineTables {
    /// The address table.
    pub addresses: Addresses,
    /// The rules of sequence numbers.
    pub numbering: Numbering,
    /// How a block is put on the tape.
    pub style: TapeStyle,
    /// The rules of straight motions at feed.
    pub motion: MotionRules,
    /// The rules of feeds while a rotary axis turns.
    pub rotary_feed: RotaryFeedRules,
    /// The longest move of one block, mm or inch; `None` for any.
    pub most_departure: Option<f64>,
    feed_formats: FeedFormats,
    /// Digits of the words of a lead, and whether those in mm count.
    lead_digits: Option<(i32, bool)>,
    /// The language of the control.
    pub family: ControlFamily,
    /// Motions are written under tool-tip control.
    pub tip_output: bool,
    /// The tool's direction is said by vectors there, and not by angles.
    pub tip_vectors: bool,
    /// Motions under a tool axis that stands still are written in tilted frames.
    pub frame_output: bool,
    /// What a mill-turn machine does; `None` for another machine.
    pub mill_turn: Option<MillTurnMode>,
    /// A mill-turn machine mills by TRANSMIT and TRACYL.
    pub transforms: bool,
    /// A macro may change words of rotary axes before they are written: they stand where the tape
    /// says.
    pub follows_edits: bool,
    /// A motion asks something of the machine before it is made: a tilted frame, the mode of a
    /// mill-turn machine that mills, where a macro has turned it, a turn at the top, or a surface
    /// speed that begins behind the approach.
    pub prepares: bool,
    /// Rapid motions turn the rotary axes at the level of RETRCT.
    pub turns_at_top: bool,
    /// Positions of a rotary axis count within one turn.
    pub within_a_turn: bool,
    /// The post clamps the rotary axes: in tilted work planes, or after rapid turns.
    pub clamps: bool,
    /// The rotary axes are clamped after rapid turns.
    pub clamps_turns: bool,
    /// The user has blocks around turns of the rotary axes.
    pub turn_texts: bool,
    /// Words of rotary axes are looked at before they are written.
    pub watches_turns: bool,
    axes: Vec<Axis>,
    /// Rapid motions that take other positions of the rotary axes than the nearest are looked at.
    pub watches_rapids: bool,
    /// What straight motions do that would leave the travel of X, Y or Z.
    pub travel_rules: TravelRules,
    /// The travel of X, Y and Z where their words name the tip in the part.
    travel: Vec<Axis>,
    chain: AxisChain,
    present: AxisSet,
    last_digits: Position,
    written: AxisSet,
    input_shift: Vector3<f64>,
    input_matrix: Option<Matrix3x4<f64>>,
    /// Where the control has its zero, X Y Z, mm or inch.
    zero: [f64; 3],
    made_for: Option<(u64, bool)>,
}

/// X, Y and Z with their travel, while they may leave it.
#[derive(Debug)]
#[must_use]
pub struct Bounds {
    axes: Vec<Axis>,
    travel: Vec<Axis>,
}

impl MachineTables {
    /// Brings the tables up to date; says whether they were made anew. `metric`:
    /// the program is in mm, else in inches.
    ///
    /// # Errors
    /// Settings that make no machine (a direction of length zero, scale zero).
    #[inline]
    pub fn refresh(&mut self, commons: &Commons, metric: bool) -> Result<bool> {
        if self.made_for == Some((commons.generation(), metric)) {
            return Ok(false);
        }
        self.make_again(commons, metric)
    }

    #[cold]
    fn make_again(&mut self, commons: &Commons, metric: bool) -> Result<bool> {
        let is_shift = |(generation, made_metric)| {
            made_metric == metric && commons.is_only_shifted_since(generation)
        };
        let is_shift = self.made_for.is_some_and(is_shift);
        if is_shift {
            self.input_shift = input_shift(commons);
        } else {
            self.make(commons, metric)?;
        }
        self.made_for = Some((commons.generation(), metric));
        Ok(!is_shift)
    }

    fn make(&mut self, commons: &Commons, metric: bool) -> Result<()> {
        self.addresses = Addresses::from_commons(commons, metric);
        self.family = commons.read(loc::CONTROL_FAMILY);
        self.numbering = Numbering::from_commons(&self.addresses, commons);
        self.style = TapeStyle::from_commons(commons);
        self.motion = MotionRules::from_commons(commons);
        self.rotary_feed = RotaryFeedRules::from_commons(&self.addresses, commons, metric);
        self.feed_formats = FeedFormats::from_commons(&self.addresses, commons, metric);
        self.format_feed(FeedMode::PerMinute);
        self.lead_digits = commons.int_opt(loc::THREAD_LEAD_FORMAT).map(|digits| (digits, metric));
        let chain = AxisChain::from_commons(commons)?;
        let has_rotary = chain.has_rotary();
        let rotary_letter = mill_turn::letter(&chain);
        self.mill_turn = mill_turn::mode(commons);
        self.transforms = mill_turn::transforms(commons);
        let chain = mill_turn::chain_in(self.mill_turn, chain);
        self.chain = if metric { chain } else { chain.in_inches() };
        self.axes = linear_letters()
            .map(|(common, letter)| Axis::new(letter, common, &self.addresses, commons))
            .collect();
        self.present = AxisSet::LINEAR;
        self.tip_output = self.chain.has_rotary()
            && commons.read(loc::ROTARY_TIP_OUTPUT) == RotaryTipOutput::Tcpc;
        self.tip_vectors =
            self.tip_output && commons.read(loc::ROTARY_TIP_FORM) == RotaryTipForm::Vectors;
        self.frame_output = self.chain.has_rotary() && frame_rules::asks_for_frames(commons);
        self.input_shift = input_shift(commons);
        self.input_matrix = input_matrix(commons);
        let along = commons.dbl_opt(loc::INPUT_ALONG_TOOL_AXIS).unwrap_or(0.0);
        self.most_departure =
            commons.dbl_opt(loc::LIMITS_MAX_DEPARTURE).filter(|most| *most != NO_DEPARTURE);
        self.follows_edits = self.chain.has_rotary() && commons.read(loc::TAPE_EDIT_MACRO);
        self.turns_at_top = self.chain.has_rotary()
            && self.mill_turn.is_none()
            && commons.read(loc::ROTARY_TURN_RETRACT)
            && commons.dbl_opt(loc::HOME_RETRACT_Z).is_some();
        self.prepares = self.frame_output
            || self.tip_output
            || self.mills()
            || self.follows_edits
            || self.turns_at_top
            || commons.read(loc::SPINDLE_CSS_LEAD_IN);
        if !has_rotary {
            self.input_shift += self.chain.tool.into_inner() * along;
        }
        for (index, rotary) in self.chain.rotaries.iter().enumerate() {
            let (letter, common) = match rotary {
                Some(rotary) => (rotary.letter, rotary.axis + 3),
                None => (ROTARY_LETTERS[index], index + 3),
            };
            if rotary.is_some() {
                self.present = self.present.or(AxisSet::of(index + 3));
            }
            let mut axis = Axis::new(letter, common, &self.addresses, commons);
            if rotary.as_ref().is_some_and(|rotary| full_turn::is_meant(commons, rotary)) {
                axis.write_within_a_turn()?;
            }
            self.axes.push(axis);
        }
        self.axes.iter_mut().zip(self.zero).for_each(|(axis, zero)| axis.count_from(zero));
        self.within_a_turn = self.axes.iter().any(|axis| axis.full_turn() != 0);
        self.clamps_turns = !self.frame_output
            && self.chain.has_rotary()
            && self.mill_turn.is_none()
            && commons.read(loc::ROTARY_TURN_CLAMP);
        let in_frames = self.frame_output && commons.read(loc::ROTARY_FRAME_CLAMP);
        self.clamps = in_frames || self.clamps_turns;
        let turn = user_blocks::TURN;
        self.turn_texts = turn.before.is_on(commons) || turn.after.is_on(commons);
        self.watches_turns =
            self.within_a_turn || self.clamps || self.tip_vectors || self.turn_texts;
        if self.axes.iter().any(|axis| axis.scale() == 0.0) {
            return MachineCode::SettingValue.err("an output scale is zero");
        }
        let in_transformation = self.transforms && (self.is_polar() || self.is_unrolled());
        if commons.read(loc::LATHE_DIAMETER) && !in_transformation {
            self.axes[0].write_diameters()?;
        }
        if commons.read(loc::LIMITS_CHECK) {
            for (axis, (min, max)) in self.axes.iter_mut().zip(loc::LINEAR_LIMITS) {
                axis.limit(commons.dbl_opt(min), commons.dbl_opt(max));
            }
        }
        self.travel = self.axes[..3].to_vec();
        let bends = has_rotary && !self.mills();
        self.watches_rapids = bends && travel_rules::watches_rapids(commons);
        self.travel_rules =
            if bends { TravelRules::from_commons(commons) } else { TravelRules::default() };
        if let (Some(MillTurnMode::PolarInterpolation), Some(letter)) =
            (self.mill_turn, rotary_letter)
        {
            // The second axis of the plane is C, in mm or inch, and no slide of the machine; X
            // goes as far as the plane says only where C is 0.
            self.axes[0].limit(None, None);
            let second = if self.transforms { self.axes[1].letter } else { letter };
            self.axes[1] = Axis::new(second, 1, &self.addresses, commons);
        } else if in_transformation {
            // Y is the way around the cylinder.
            self.axes[1].limit(None, None);
        } else if self.transforms {
            self.axes[1].turn_off();
        }
        if self.tip_output || self.frame_output {
            self.axes[..3].iter_mut().for_each(|axis| axis.limit(None, None));
        }
        self.last_digits = std::array::from_fn(|n| self.axes[n].resolution());
        let off = (0..AXES).filter(|n| self.axes[*n].is_off());
        self.written = off.fold(self.present, |set, n| set.without(AxisSet::of(n)));
        Ok(())
    }

    /// Where the control has its zero, X Y Z, mm or inch: words of X, Y and Z count from there.
    pub fn zero(&self) -> [f64; 3] {
        self.zero
    }

    /// The control has its zero elsewhere, X Y Z, mm or inch; [`MachineTables::refresh`] makes
    /// the axes anew.
    pub fn set_zero(&mut self, zero: [f64; 3]) {
        self.zero = zero;
        self.made_for = None;
    }

    /// The main spindle of a mill-turn machine is the axis C.
    pub fn mills(&self) -> bool {
        self.mill_turn.is_some_and(|mode| mode != MillTurnMode::Turning)
    }

    /// X and C are a plane of mm or inch.
    pub fn is_polar(&self) -> bool {
        self.mill_turn == Some(MillTurnMode::PolarInterpolation)
    }

    /// Y is the way around a cylinder (TRACYL).
    pub fn is_unrolled(&self) -> bool {
        self.mill_turn == Some(MillTurnMode::CylindricalInterpolationByTracyl)
    }

    /// Refuses a position of the machine outside the travel of X, Y and Z: under tool-tip
    /// control and in tilted frames the words themselves do not say it.
    ///
    /// # Errors
    /// It lies outside.
    pub fn check_travel(&self, position: &Position, axes: AxisSet) -> Result<()> {
        for number in axes.and(AxisSet::LINEAR).numbers() {
            self.travel[number].check(position[number])?;
        }
        Ok(())
    }

    /// Which of X, Y and Z would have to leave their travel for a position of the machine.
    pub fn exceeded(&self, position: [f64; 3]) -> AxisSet {
        let leaves = |number: &usize| self.travel[*number].check(position[*number]).is_err();
        (0..3).filter(leaves).fold(AxisSet::NONE, |set, number| set.or(AxisSet::of(number)))
    }

    /// Lets axes leave their travel until [`MachineTables::bound_again`].
    pub fn unbound(&mut self, axes: AxisSet) -> Bounds {
        let bounds = Bounds { axes: self.axes[..3].to_vec(), travel: self.travel.clone() };
        for number in axes.and(AxisSet::LINEAR).numbers() {
            self.axes[number].limit(None, None);
            self.travel[number].limit(None, None);
        }
        bounds
    }

    /// Keeps X, Y and Z within their travel again.
    pub fn bound_again(&mut self, bounds: Bounds) {
        self.axes[..3].copy_from_slice(&bounds.axes);
        self.travel = bounds.travel;
    }

    /// True when the travel of X, Y or Z is bounded where their words name the tip.
    pub fn limits_travel(&self) -> bool {
        self.travel.iter().any(Axis::is_limited)
    }

    /// F is written as this mode asks for from now on.
    pub fn format_feed(&mut self, mode: FeedMode) {
        if let Some(format) = self.feed_formats.of(mode) {
            self.addresses.set_format(F, format);
        }
    }

    /// The format of a letter where it is a lead, or what a lead changes by.
    pub fn lead_format(&self, letter: Letter) -> Option<NumberFormat> {
        let of_address = self.addresses.format(letter).copied()?;
        Some(match self.lead_digits {
            Some((digits, metric)) => of_address.with_digits(digits, metric),
            None => of_address,
        })
    }

    /// I, J and K are written as parts of a unit vector from now on, else as lengths.
    pub fn format_vectors(&mut self, commons: &Commons, metric: bool, as_vectors: bool) {
        let plain = Addresses::from_commons(commons, metric);
        for letter in IJK {
            let Some(format) = plain.format(letter).copied() else { continue };
            let decimals = commons.int(loc::ROTARY_VECTOR_DECIMALS).clamp(4, 8) as u8;
            let of_vector =
                NumberFormat { whole: 1, decimals, leading: true, point: true, ..format };
            self.addresses.set_format(letter, if as_vectors { of_vector } else { format });
        }
    }

    /// An axis by number: 0 to 2 are X Y Z, 3 and 4 the rotaries.
    #[inline]
    pub fn axis(&self, number: usize) -> &Axis {
        &self.axes[number]
    }

    /// The axis a scale or translation common belongs to: 0 to 5 for X Y Z A B C.
    pub fn axis_of_common(&self, common: usize) -> Option<usize> {
        if common < 3 {
            return Some(common);
        }
        let rotaries = &self.chain.rotaries;
        let at = rotaries.iter().position(|r| r.as_ref().is_some_and(|r| r.axis + 3 == common))?;
        Some(at + 3)
    }

    /// The axis chain.
    #[inline]
    pub fn chain(&self) -> &AxisChain {
        &self.chain
    }

    /// The axes the machine has; X, Y and Z are always there.
    #[inline]
    pub fn present(&self) -> AxisSet {
        self.present
    }

    /// The axes whose words the tape gets.
    #[inline]
    pub fn written(&self) -> AxisSet {
        self.written
    }

    /// Smallest step of each axis that the tape can say, mm, inch or degrees.
    #[inline]
    pub fn last_digits(&self) -> &Position {
        &self.last_digits
    }

    /// The matrix that the machine sends each point of the input through, before the shift.
    #[inline]
    pub fn input_matrix(&self) -> Option<&Matrix3x4<f64>> {
        self.input_matrix.as_ref()
    }

    /// What is added to each point of the input, mm or inch (DBLCOM 286 to 288 and 918).
    #[inline]
    pub fn input_shift(&self) -> Vector3<f64> {
        self.input_shift
    }
}

/// What TRANS adds to the points, in the unit of the program.
fn input_shift(commons: &Commons) -> Vector3<f64> {
    Vector3::from(loc::INPUT_TRANSLATE.map(|at| commons.dbl_opt(at).unwrap_or(0.0)))
}
