//! The five axis words X Y Z and two rotaries: from machine positions to the
//! values on the tape.
//!
//! A position is first rounded to the resolution of its address, then scaled
//! (DBLCOM 486–491), translated (775–780) and rounded again. Rounding before
//! scaling is what the published grid-of-grooves listing shows.

use crate::address::{Addresses, Output, letter};
use crate::block::{Block, no_address};
use crate::commons::{Commons, Dbl};
use crate::errors::PostCode;
use crate::kinematics::Kinematics;
use crate::locations as loc;
use crate::motion::{AxisSet, XY, Z};
use crate::number::NumberFormat;
use fil_diag::Diag;

/// Number of axes: X, Y, Z, primary and secondary rotary.
pub const AXES: usize = 5;

/// Scale of X when the tape holds diameters.
const DIAMETER: f64 = 2.0;

const SCALE: [Dbl; 6] =
    [loc::SCALE_X, loc::SCALE_Y, loc::SCALE_Z, loc::SCALE_A, loc::SCALE_B, loc::SCALE_C];

const TRANSLATE: [Dbl; 6] = [
    loc::OUTPUT_TRANSLATE_X,
    loc::OUTPUT_TRANSLATE_Y,
    loc::OUTPUT_TRANSLATE_Z,
    loc::OUTPUT_TRANSLATE_A,
    loc::OUTPUT_TRANSLATE_B,
    loc::OUTPUT_TRANSLATE_C,
];

/// How one axis is written.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// Printed letter, 1 to 26.
    pub letter: u8,
    output: Output,
    format: NumberFormat,
    scale: f64,
    translate: f64,
    min: f64,
    max: f64,
}

impl Axis {
    fn new(letter: u8, common: usize, addresses: &Addresses, commons: &Commons) -> Self {
        let output = addresses.output(letter);
        let position = match output {
            Output::At(position) => position,
            Output::Off | Output::Unknown => 0,
        };
        Axis {
            letter,
            output,
            format: addresses.slot(position).format,
            scale: commons.dbl_opt(SCALE[common]).unwrap_or(1.0),
            translate: commons.dbl_opt(TRANSLATE[common]).unwrap_or(0.0),
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
        }
    }

    /// The scaled integer on the tape for a machine position (mm or degrees).
    ///
    /// # Errors
    /// The value does not fit the address's format.
    #[inline(always)]
    pub fn scaled(&self, position: f64) -> Result<i64, Box<Diag>> {
        let scaled = self.format.scale(position).map_err(|diag| self.named(diag))?;
        if self.scale == 1.0 && self.translate == 0.0 {
            return Ok(scaled);
        }
        let value = self.format.unscale(scaled) * self.scale + self.translate;
        self.format.scale(value).map_err(|diag| self.named(diag))
    }

    /// A machine position rounded to the resolution of its address.
    ///
    /// # Errors
    /// As [`Axis::scaled`].
    pub fn rounded(&self, position: f64) -> Result<f64, Box<Diag>> {
        let scaled = self.format.scale(position).map_err(|diag| self.named(diag))?;
        Ok(self.format.unscale(scaled))
    }

    /// The value on the tape for a machine position.
    ///
    /// # Errors
    /// As [`Axis::scaled`].
    pub fn value(&self, position: f64) -> Result<f64, Box<Diag>> {
        Ok(self.format.unscale(self.scaled(position)?))
    }

    /// Adds the word if its value has changed, or in any case when `always`.
    /// Says whether a word was added.
    ///
    /// # Errors
    /// As [`Axis::scaled`]; the machine has no such address; the position lies
    /// outside the axis's travel.
    pub fn write(
        &self,
        position: f64,
        always: bool,
        block: &mut Block,
        commons: &Commons,
    ) -> Result<bool, Box<Diag>> {
        self.check(position)?;
        let Some(at) = self.place()? else { return Ok(false) };
        let scaled = self.scaled(position)?;
        let due = always || self.changes(scaled, commons);
        if due {
            block.put(at, scaled);
        }
        Ok(due)
    }

    /// The tape position for a word of this axis; `None` when its output is off.
    ///
    /// # Errors
    /// The machine has no such address.
    #[inline]
    pub fn place(&self) -> Result<Option<u8>, Box<Diag>> {
        match self.output {
            Output::Off => Ok(None),
            Output::Unknown => Err(no_address(self.letter)),
            Output::At(at) => Ok(Some(at)),
        }
    }

    /// Refuses a position outside the travel, written or not.
    ///
    /// # Errors
    /// The position lies outside.
    #[inline]
    pub fn check(&self, position: f64) -> Result<(), Box<Diag>> {
        if (self.min..=self.max).contains(&position) {
            return Ok(());
        }
        let name = char::from(b'A' + self.letter - 1);
        let message = format!("{name}{position} lies outside {} to {}", self.min, self.max);
        Err(Box::new(Diag::new(PostCode::AxisLimit, message)))
    }

    /// True when the tape does not yet stand at this scaled value.
    #[inline]
    pub fn changes(&self, scaled: i64, commons: &Commons) -> bool {
        self.format.unscale(scaled) != commons.last_output(self.letter)
    }

    /// True when the settings suppress the words of this axis.
    pub fn is_off(&self) -> bool {
        self.output == Output::Off
    }

    /// Position before scale and translation that a tape value stands for.
    pub fn position(&self, value: f64) -> f64 {
        (value - self.translate) / self.scale
    }

    fn named(&self, mut diag: Box<Diag>) -> Box<Diag> {
        diag.message = format!("{}: {}", char::from(b'A' + self.letter - 1), diag.message);
        diag
    }
}

/// Axes, addresses and kinematics as the commons describe them at this moment.
#[derive(Clone, Debug, Default)]
pub struct Machine {
    /// The address table.
    pub addresses: Addresses,
    axes: Vec<Axis>,
    kinematics: Option<Kinematics>,
    present: AxisSet,
    generation: Option<(u32, bool)>,
}

impl Machine {
    /// Brings everything up to date with the commons.
    ///
    /// # Errors
    /// Settings that make no machine (a direction of length zero, scale zero).
    pub fn refresh(&mut self, commons: &Commons, metric: bool) -> Result<(), Box<Diag>> {
        if self.generation == Some((commons.generation(), metric)) {
            return Ok(());
        }
        self.addresses.refresh(commons, metric);
        let kinematics = Kinematics::from_commons(commons)?;
        let kinematics = if metric { kinematics } else { kinematics.in_inches() };
        let linear = [b'X', b'Y', b'Z'].into_iter().enumerate();
        self.axes = linear
            .map(|(common, name)| Axis::new(letter(name), common, &self.addresses, commons))
            .collect();
        self.present = XY | Z;
        for (index, rotary) in kinematics.rotaries.iter().enumerate() {
            self.present |= AxisSet::from(rotary.is_some()) << (index + 3);
            let (name, common) = match rotary {
                Some(rotary) => (rotary.letter, rotary.axis + 3),
                None => (index as u8 + 1, index + 3),
            };
            self.axes.push(Axis::new(name, common, &self.addresses, commons));
        }
        if self.axes.iter().any(|axis| axis.scale == 0.0) {
            return Err(Box::new(Diag::new(PostCode::SettingValue, "an output scale is zero")));
        }
        if commons.flag(loc::LATHE_DIAMETER) {
            self.write_diameters()?;
        }
        if commons.flag(loc::LIMITS_CHECK) {
            for (axis, (min, max)) in self.axes.iter_mut().zip(loc::LINEAR_LIMITS) {
                axis.min = commons.dbl_opt(min).unwrap_or(f64::NEG_INFINITY);
                axis.max = commons.dbl_opt(max).unwrap_or(f64::INFINITY);
            }
        }
        self.kinematics = Some(kinematics);
        self.generation = Some((commons.generation(), metric));
        Ok(())
    }

    /// X as a diameter, on top of an output scale of 1.
    fn write_diameters(&mut self) -> Result<(), Box<Diag>> {
        let x = &mut self.axes[0];
        if x.scale != 1.0 {
            return Err(Box::new(Diag::new(
                PostCode::SettingValue,
                "lathe.diameter and scale.x would both change X",
            )));
        }
        x.scale = DIAMETER;
        Ok(())
    }

    /// An axis by number: 0 to 2 are X Y Z, 3 and 4 the rotaries.
    pub fn axis(&self, number: usize) -> &Axis {
        &self.axes[number]
    }

    /// True when the output scales leave circles in the plane of two axes
    /// circles: all 1, or X a diameter.
    pub fn keeps_circles(&self, first: usize, second: usize) -> bool {
        [first, second].into_iter().all(|number| {
            let scale = self.axes[number].scale;
            scale == 1.0 || (number == 0 && scale == DIAMETER)
        })
    }

    /// The axis a scale or translation common belongs to: 0 to 5 for X Y Z A B C.
    pub fn axis_of_common(&self, common: usize) -> Option<usize> {
        if common < 3 {
            return Some(common);
        }
        let rotaries = &self.kinematics()?.rotaries;
        let at = rotaries.iter().position(|r| r.as_ref().is_some_and(|r| r.axis + 3 == common))?;
        Some(at + 3)
    }

    /// The rotary axes.
    pub fn kinematics(&self) -> Option<&Kinematics> {
        self.kinematics.as_ref()
    }

    /// The axes the machine has; X, Y and Z are always there.
    pub fn present(&self) -> AxisSet {
        self.present
    }

    /// True when axis 3 or 4 is there.
    pub fn has_rotary(&self, number: usize) -> bool {
        self.present & 1 << number != 0
    }
}
