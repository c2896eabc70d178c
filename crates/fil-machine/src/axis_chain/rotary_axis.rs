//! One rotary axis: where it may stand, and how it turns a direction.

use nalgebra::{Point3, Unit, Vector3};

use super::{Carries, near};
use crate::letter::Letter;
use crate::rotation::{self, Turn};
use crate::zones::Zones;

/// So far past a limit is at it: the tape rounds to no more than five decimals, degrees.
const PAST_LIMIT: f64 = 1e-6;

/// One rotary axis.
#[derive(Clone, Debug)]
pub struct Rotary {
    /// What it carries.
    pub carries: Carries,
    /// Direction in the machine frame.
    pub direction: Unit<Vector3<f64>>,
    /// A point on the axis in the machine frame at zero positions, mm.
    pub center: Point3<f64>,
    /// Printed letter.
    pub letter: Letter,
    /// Which of A, B, C (0 to 2) its scale, translation and limits belong to.
    pub axis: usize,
    /// Travel in degrees; `None` when not limited.
    pub min: Option<f64>,
    /// Travel in degrees; `None` when not limited.
    pub max: Option<f64>,
    /// Where it may stand within that.
    pub zones: Zones,
}

impl Rotary {
    /// True when its travel is limited.
    pub fn is_limited(&self) -> bool {
        self.min.is_some() || self.max.is_some() || !self.zones.is_empty()
    }

    /// True when the axis can go from one position to another, degrees. One that stands outside
    /// of its zones, as nothing has said where it stands, may come into any.
    #[inline]
    pub fn goes(&self, from: f64, to: f64) -> bool {
        self.reaches(to)
            && (self.zones.is_empty() || !self.zones.holds(from) || self.zones.leads(from, to))
    }

    /// Where an axis that stands at a position comes to its limit, up or down.
    pub fn limit(&self, from: f64, up: bool) -> Option<f64> {
        let travel = if up { self.max } else { self.min };
        let of_zone = self.zones.end(from, up);
        let nearer = |a: f64, b: f64| if (a - from).abs() < (b - from).abs() { a } else { b };
        match (travel, of_zone) {
            (Some(travel), Some(of_zone)) => Some(nearer(travel, of_zone)),
            (travel, of_zone) => travel.or(of_zone),
        }
    }

    /// True when the axis can stand at this position, degrees. A direction at a limit, rounded
    /// in the CL file, may lie a little past it.
    pub fn reaches(&self, angle: f64) -> bool {
        self.min.is_none_or(|min| angle >= min - PAST_LIMIT)
            && self.max.is_none_or(|max| angle <= max + PAST_LIMIT)
            && (self.zones.is_empty() || self.zones.holds(angle))
    }

    /// A direction turned about the axis by an angle, degrees, by the right-hand rule.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn turned(&self, vector: Vector3<f64>, angle: f64) -> Vector3<f64> {
        rotation::turned(self.direction, vector, angle)
    }

    /// The same by an angle whose sine is known.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn turned_by(&self, vector: Vector3<f64>, turn: Turn) -> Vector3<f64> {
        rotation::turned_by(self.direction, vector, turn)
    }

    /// The angle plus whole turns that lies nearest to `last` and within the limits.
    pub(super) fn turn_near(&self, angle: f64, last: f64) -> Option<f64> {
        let near = near(angle, last);
        if self.goes(last, near) {
            return Some(near);
        }
        [360.0, -360.0, 720.0, -720.0]
            .into_iter()
            .map(|turn| near + turn)
            .filter(|angle| self.goes(last, *angle))
            .min_by(|a, b| (a - last).abs().total_cmp(&(b - last).abs()))
    }
}
