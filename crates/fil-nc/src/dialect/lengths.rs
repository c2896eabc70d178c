//! How a control takes up the lengths of tools, and in which plane they act along the tool.

use super::{Dialect, Family, Habit, Settings};

/// The least cosine between directions that are one.
const SAME_WAY: f64 = 1.0 - 1e-6;

/// The normal of the plane in which a lathe turns.
const TURNED: usize = 1;

impl Dialect {
    /// The plane in force says along which axes the lengths of a tool count, as on a SINUMERIK whose
    /// setting data do not hold them fast.
    pub fn counts_lengths_in_plane(&self) -> bool {
        self.family == Family::Sinumerik && !self.has(Habit::LengthsAreFast)
    }

    /// The plane in which the length of a tool acts along the tool, by the index of its normal: on a
    /// lathe that of Z and X.
    pub(crate) fn plane_of_lengths(&self) -> usize {
        let tool = self.forward.tool();
        match (0..3).find(|axis| tool[*axis].abs() > SAME_WAY) {
            _ if self.counts_diameters() => TURNED,
            Some(axis) => axis,
            None => self.start.plane,
        }
    }

    /// A mill whose tool lies along Z takes up its length by a function, which some controls count
    /// square to the plane in force there.
    pub(crate) fn takes_up_lengths_along_z(&self) -> bool {
        let is_mill = self.family == Family::WordAddress && !self.is_lathe();
        is_mill && self.forward.tool().z.abs() > SAME_WAY
    }
}

/// LOADTL calls the length of its tool by a function with a number, in word address.
pub(super) fn are_called(settings: &Settings) -> bool {
    let is = |key: &str, value: i32| settings.code(key).unwrap_or(value) == value;
    is("control.family", 0)
        && is("tool.format", 1)
        && settings.is_not_off("tool.length_from_tool")
        && settings.code("tool.length_code").is_some()
}
