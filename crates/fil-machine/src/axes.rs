//! The five axis words X Y Z and two rotaries: from machine positions to the
//! values on the tape.
//!
//! A position is first rounded to the resolution of its address, then scaled
//! (DBLCOM 486–491), translated (775–780) and rounded again: that is what the
//! published grid-of-grooves listing shows. A diameter is different: it is the
//! position doubled, rounded once.

use fil_diag::{Diag, Result};

use crate::address::{Addresses, Output, TapePosition};
use crate::commons::{Commons, Dbl};
use crate::errors::MachineCode;
use crate::letter::{Letter, letters};
use crate::locations::{self as loc, MotionResolutionManual};
use crate::number::NumberFormat;

/// Number of axes: X, Y, Z, primary and secondary rotary.
pub const AXES: usize = 5;

/// Positions of the five axes: X Y Z in mm or inch, two rotaries in degrees.
pub type Position = [f64; AXES];

/// Degrees of a full turn.
const FULL_TURN: f64 = 360.0;

/// The way out of a rotary axis that has turned on and on.
const WITHIN_A_TURN: &str = "output positions of an axis without travel within 360 degrees (rotary.output = 1, 2 or 4), or give the address more digits";

/// Scale of X when the tape holds diameters.
const DIAMETER: f64 = 2.0;

/// An axis that moves less than this does not move: a lathe has its tip at Y0, mm or inch.
const NO_TRAVEL: f64 = 0.01;

/// Scales of X, Y, Z, A, B and C on the tape.
pub(crate) const SCALE: [Dbl; 6] =
    [loc::SCALE_X, loc::SCALE_Y, loc::SCALE_Z, loc::SCALE_A, loc::SCALE_B, loc::SCALE_C];

const TRANSLATE: [Dbl; 6] = [
    loc::OUTPUT_TRANSLATE_X,
    loc::OUTPUT_TRANSLATE_Y,
    loc::OUTPUT_TRANSLATE_Z,
    loc::OUTPUT_TRANSLATE_A,
    loc::OUTPUT_TRANSLATE_B,
    loc::OUTPUT_TRANSLATE_C,
];

/// A set of axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AxisSet(u8);

impl AxisSet {
    /// No axis.
    pub const NONE: AxisSet = AxisSet(0);
    /// X and Y.
    pub const XY: AxisSet = AxisSet(0b00011);
    /// Z.
    pub const Z: AxisSet = AxisSet(0b00100);
    /// X, Y and Z.
    pub const LINEAR: AxisSet = AxisSet(0b00111);
    /// Both rotary axes.
    pub const ROTARY: AxisSet = AxisSet(0b11000);
    /// All axes.
    pub const ALL: AxisSet = AxisSet(0b11111);

    /// The set of one axis by number.
    #[inline]
    pub const fn of(number: usize) -> Self {
        AxisSet(1 << number)
    }

    /// True when no axis is in it.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// True when the axis of this number is in it.
    #[inline]
    pub fn has(self, number: usize) -> bool {
        self.0 & 1 << number != 0
    }

    /// The axes that are in both.
    #[inline]
    pub fn and(self, other: AxisSet) -> AxisSet {
        AxisSet(self.0 & other.0)
    }

    /// The axes that are in one of them.
    #[inline]
    pub fn or(self, other: AxisSet) -> AxisSet {
        AxisSet(self.0 | other.0)
    }

    /// The axes that are in this one alone.
    #[inline]
    pub fn without(self, other: AxisSet) -> AxisSet {
        AxisSet(self.0 & !other.0)
    }

    /// The numbers of its axes, lowest first.
    #[inline]
    pub fn numbers(self) -> impl Iterator<Item = usize> {
        let mut set = self.0;
        std::iter::from_fn(move || {
            let number = set.trailing_zeros() as usize;
            set &= set.wrapping_sub(1);
            (number < AXES).then_some(number)
        })
    }
}

/// How one axis is written.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// Printed letter.
    pub letter: Letter,
    output: Output,
    format: NumberFormat,
    scale: f64,
    translate: f64,
    /// It turns: positions are degrees.
    turns: bool,
    /// The tape holds diameters.
    diameter: bool,
    resolution: f64,
    /// Nothing comes between the position and its rounding to the address.
    is_plain: bool,
    /// Step that positions are rounded to first; `None` for that of the address.
    step: Option<f64>,
    /// Scaled integers no farther than this from the last one count as unchanged.
    same: i64,
    /// Values on the tape that differ are different positions.
    is_exact: bool,
    /// A full turn as a scaled integer, where positions count within one; else 0.
    full_turn: i64,
    min: f64,
    max: f64,
}

impl Axis {
    /// The axis that takes the scale and translation of number `common` (0 to 5
    /// for X Y Z A B C).
    pub(crate) fn new(
        letter: Letter,
        common: usize,
        addresses: &Addresses,
        commons: &Commons,
    ) -> Self {
        let scale = commons.dbl_opt(SCALE[common]).unwrap_or(1.0);
        let format = addresses.format(letter).copied().unwrap_or_default();
        let translate = commons.dbl_opt(TRANSLATE[common]).unwrap_or(0.0);
        let by_hand = commons.read(loc::MOTION_RESOLUTION_MANUAL) == MotionResolutionManual::Yes;
        let of_kind = if common < 3 { loc::MOTION_RESOLUTION } else { loc::ROTARY_RESOLUTION };
        let step = commons.dbl_opt(of_kind).filter(|_| by_hand);
        let same = commons.dbl_opt(loc::MOTION_SAME_TOLERANCE).unwrap_or(0.0);
        let same = if common < 3 { same * scale.abs() / format.unscale(1) } else { 0.0 };
        // What a tolerance of a whole number of digits leaves in binary counts.
        let same = (same + 1e-6).floor() as i64;
        Axis {
            letter,
            is_plain: scale == 1.0 && translate == 0.0 && step.is_none(),
            step,
            same,
            is_exact: same == 0,
            full_turn: 0,
            output: addresses.output(letter),
            format,
            scale,
            translate,
            turns: common >= 3,
            diameter: common == 0 && scale == DIAMETER,
            resolution: (format.unscale(1) / scale.abs()).max(step.unwrap_or(0.0)),
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
        }
    }

    /// Writes no words of this axis.
    pub(crate) fn turn_off(&mut self) {
        self.output = Output::Off;
    }

    /// Makes positions count from a zero of the control that lies here, mm or inch.
    pub(crate) fn count_from(&mut self, zero: f64) {
        self.translate -= zero;
        self.is_plain &= zero == 0.0;
    }

    /// Writes diameters, on top of an output scale of 1.
    ///
    /// # Errors
    /// Another output scale.
    pub(crate) fn write_diameters(&mut self) -> Result<()> {
        if self.scale != 1.0 {
            return MachineCode::SettingValue.err("lathe.diameter and scale.x would both change X");
        }
        self.scale = DIAMETER;
        self.is_plain = false;
        self.resolution = (self.resolution / DIAMETER).max(self.step.unwrap_or(0.0));
        self.diameter = true;
        Ok(())
    }

    /// Writes positions within one turn.
    ///
    /// # Errors
    /// An output scale that is neither 1 nor -1: a turn on the tape would be none.
    pub(crate) fn write_within_a_turn(&mut self) -> Result<()> {
        if self.scale.abs() != 1.0 {
            return MachineCode::SettingValue.err(format!(
                "rotary.output limits {} to 360 degrees, but its output is scaled",
                self.letter
            ));
        }
        self.full_turn = (FULL_TURN / self.format.unscale(1)).round() as i64;
        self.is_plain = false;
        self.is_exact = false;
        Ok(())
    }

    /// A full turn as a scaled integer; 0 for an axis whose positions count on.
    #[inline]
    pub fn full_turn(&self) -> i64 {
        self.full_turn
    }

    /// The position nearest to another that is the same within a turn; the position itself
    /// of an axis whose positions count on.
    pub fn near(&self, position: f64, other: f64) -> f64 {
        match self.full_turn {
            0 => position,
            _ => position + FULL_TURN * nearest((other - position) / FULL_TURN),
        }
    }

    /// The scaled integer of a value on the tape, within a turn; `None` for no value.
    pub fn within_a_turn(&self, value: f64) -> Option<i64> {
        Some(self.format.scale(value.abs()).ok()?.rem_euclid(self.full_turn.max(1)))
    }

    /// Bounds the travel.
    pub(crate) fn limit(&mut self, min: Option<f64>, max: Option<f64>) {
        self.min = min.unwrap_or(f64::NEG_INFINITY);
        self.max = max.unwrap_or(f64::INFINITY);
    }

    /// True when the travel is bounded.
    pub fn is_limited(&self) -> bool {
        self.min.is_finite() || self.max.is_finite()
    }

    /// Output scale: 2 for diameters.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Added to values on the tape after the scale, mm, inch or degrees.
    pub fn translation(&self) -> f64 {
        self.translate
    }

    /// A length along the axis as the tape says it outside of the axis' own words, with its
    /// sign: a peck, a clearance, the rise of a helix. Diameters are of positions alone.
    pub fn length(&self, length: f64) -> f64 {
        if self.diameter { length } else { length * self.scale }
    }

    /// True when a length on the tape is the length itself, so that a lead is what the
    /// spindle and the axis make of it.
    pub fn keeps_lengths(&self) -> bool {
        self.diameter || self.scale.abs() == 1.0
    }

    /// True when the output scale leaves circles circles: 1, or X a diameter.
    pub fn keeps_circles(&self) -> bool {
        self.scale == 1.0 || self.diameter
    }

    /// The scaled integer on the tape for a machine position (mm, inch or degrees).
    ///
    /// # Errors
    /// The value does not fit the address's format.
    #[inline]
    pub fn scaled(&self, position: f64) -> Result<i64> {
        if self.is_plain {
            return self.format.scale(position).map_err(|diag| self.named(diag));
        }
        self.scaled_and_moved(position)
    }

    fn scaled_and_moved(&self, position: f64) -> Result<i64> {
        if self.full_turn != 0 && position.is_finite() {
            let within = position - FULL_TURN * floor(position / FULL_TURN);
            let scaled = self.moved(within)?;
            // A division of whole numbers takes longer than all the rest.
            let is_within = (0..self.full_turn).contains(&scaled);
            return Ok(if is_within { scaled } else { scaled.rem_euclid(self.full_turn) });
        }
        self.moved(position)
    }

    fn moved(&self, position: f64) -> Result<i64> {
        if self.scale == 1.0 && self.translate == 0.0 && self.step.is_none() {
            return self.format.scale(position).map_err(|diag| self.named(diag));
        }
        let position = match self.step {
            Some(step) => (position / step).round() * step,
            None => position,
        };
        let rounded = if self.diameter {
            position
        } else {
            self.format.unscale(self.format.scale(position).map_err(|diag| self.named(diag))?)
        };
        self.format.scale(rounded * self.scale + self.translate).map_err(|diag| self.named(diag))
    }

    /// The value on the tape for a machine position.
    ///
    /// # Errors
    /// As [`Axis::scaled`].
    pub fn value(&self, position: f64) -> Result<f64> {
        Ok(self.format.unscale(self.scaled(position)?))
    }

    /// The machine position that the tape says for a machine position: what is
    /// left after rounding.
    ///
    /// # Errors
    /// As [`Axis::scaled`].
    #[inline]
    pub fn on_tape(&self, position: f64) -> Result<f64> {
        Ok(self.scaled_on_tape(position)?.0)
    }

    /// The same with the scaled integer of its word.
    ///
    /// # Errors
    /// As [`Axis::scaled`].
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn scaled_on_tape(&self, position: f64) -> Result<(f64, i64)> {
        let scaled = self.scaled(position)?;
        let value = self.format.unscale(scaled);
        if self.is_plain {
            return Ok((value, scaled));
        }
        Ok((self.near(self.position(value), position), scaled))
    }

    /// Smallest step of the machine position that the tape can say, mm, inch or
    /// degrees.
    #[inline]
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// The tape position for a word of this axis; `None` when its output is off.
    ///
    /// # Errors
    /// The machine has no such address.
    #[inline]
    pub fn tape_position(&self) -> Result<Option<TapePosition>> {
        match self.output {
            Output::Off => Ok(None),
            Output::Unknown => Err(crate::address::no_address(self.letter)),
            Output::At(at) => Ok(Some(at)),
        }
    }

    /// Refuses a position outside the travel, written or not.
    ///
    /// # Errors
    /// The position lies outside, or is not a number.
    #[inline]
    pub fn check(&self, position: f64) -> Result<()> {
        if (self.min..=self.max).contains(&position) {
            return Ok(());
        }
        Err(self.outside(position))
    }

    #[cold]
    fn outside(&self, position: f64) -> Box<Diag> {
        let Axis { letter, min, max, .. } = self;
        // A number that was computed has digits that nobody has asked for.
        let told = (position * 1e6).round() / 1e6;
        let beyond = match (min.is_finite(), max.is_finite()) {
            (true, false) => format!("below {min}"),
            (false, true) => format!("above {max}"),
            _ => format!("outside {min} to {max}"),
        };
        let mut diag = MachineCode::AxisLimit.diag(format!("{letter}{told} lies {beyond}"));
        if max - min < NO_TRAVEL {
            let hint = "The axis has no travel: turning is in X and Z. Put MODE / MILL before the work of a live tool; where the file has the spindle along X, set input.kind = 2 and input.matrix_ax to input.matrix_cz.";
            diag.hint = Some(hint.to_string());
        }
        diag
    }

    /// True when the tape does not yet stand at this scaled value.
    #[inline]
    pub fn changes(&self, scaled: i64, commons: &Commons) -> bool {
        let last = commons.last_output(self.letter);
        self.format.unscale(scaled) != last && (self.is_exact || self.is_apart(scaled, last))
    }

    /// True when a scaled integer is farther from the last value than what counts as
    /// unchanged.
    #[cold]
    fn is_apart(&self, scaled: i64, last: f64) -> bool {
        if self.full_turn != 0 {
            return self.within_a_turn(last) != Some(scaled);
        }
        match self.format.scale(last) {
            Ok(last) => (scaled - last).abs() > self.same,
            Err(_) => true,
        }
    }

    /// True when some ways of more than a digit are none (`motion.same_tolerance`).
    #[inline]
    pub fn leaves_out_small_ways(&self) -> bool {
        !self.is_exact
    }

    /// True when the way between two positions is none, so that the word of its end is left out.
    ///
    /// # Errors
    /// A position that does not fit its address.
    pub fn is_no_way(&self, from: f64, to: f64) -> Result<bool> {
        Ok((self.scaled(to)? - self.scaled(from)?).abs() <= self.same)
    }

    /// True when the settings suppress the words of this axis.
    #[inline]
    pub fn is_off(&self) -> bool {
        self.output == Output::Off
    }

    /// Position before scale and translation that a tape value stands for.
    pub fn position(&self, value: f64) -> f64 {
        // Within a turn the sign is the way that the axis goes there.
        let value = if self.full_turn == 0 { value } else { value.abs() };
        (value - self.translate) / self.scale
    }

    #[cold]
    fn named(&self, mut diag: Box<Diag>) -> Box<Diag> {
        diag.message = format!("{}: {}", self.letter, diag.message);
        if self.turns {
            diag.hint = Some(WITHIN_A_TURN.to_string());
        }
        diag
    }
}

/// The whole number at or below a value; `f64::floor` is a call on most builds. Of values that
/// no tape can say it is any.
fn floor(value: f64) -> f64 {
    let whole = value as i64 as f64;
    if whole > value { whole - 1.0 } else { whole }
}

/// The nearest whole number, half away from zero.
fn nearest(value: f64) -> f64 {
    floor(value.abs() + 0.5).copysign(value)
}

/// The letters X, Y and Z with the numbers of their commons.
pub(crate) fn linear_letters() -> impl Iterator<Item = (usize, Letter)> {
    letters::XYZ.into_iter().enumerate()
}
