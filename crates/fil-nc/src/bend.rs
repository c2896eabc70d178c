//! How strongly the path of a motion can bend between its ends.
//!
//! A motion moves all axes evenly, so the tip is a point that goes on evenly and is
//! turned by axes that turn evenly. The bounds here follow it along the chain from
//! the tool to the part and add up what each axis can do at most. A curve whose
//! second derivative is at most `bend` is never farther from a chord than `bend / 8`
//! times the square of the chord's share of the motion.

use fil_machine::axis_chain::{Carries, Rotary};
use nalgebra::{Rotation3, Vector3};

use crate::forward::Forward;
use crate::motion::{Arc, Position};

/// Bounds of a point while a motion goes from 0 to 1.
#[derive(Clone, Copy)]
struct Moving {
    /// Where it is half way.
    middle: Vector3<f64>,
    /// How far it can be from there.
    away: f64,
    /// Length of its first derivative, at most.
    speed: f64,
    /// Length of its second derivative, at most.
    bend: f64,
}

impl Moving {
    fn fixed(middle: Vector3<f64>) -> Self {
        Moving { middle, away: 0.0, speed: 0.0, bend: 0.0 }
    }

    /// X, Y, Z of a motion, mm.
    fn linear(forward: &Forward, from: &Position, to: &Position, arc: Option<&Arc>) -> Self {
        let at = |share| Vector3::from(forward.along(from, to, arc, share).linear);
        let way = at(1.0) - at(0.0);
        let mut point =
            Moving { middle: at(0.5), away: 0.5 * way.norm(), speed: way.norm(), bend: 0.0 };
        if let Some(arc) = arc {
            let spoke = at(0.0) - Vector3::from(arc.center);
            let [first, second] = arc.plane();
            let radius = libm::hypot(spoke[first], spoke[second]);
            let swept = arc.angle.to_radians();
            point.away += 2.0 * radius;
            point.speed += swept * radius;
            point.bend = swept * swept * radius;
        }
        point
    }

    /// The point when a rotary axis turns it from one angle to another (degrees).
    fn turned(self, axis: &Rotary, center: Vector3<f64>, [from, to]: [f64; 2]) -> Self {
        let arm = self.middle - center;
        let radius = axis.direction.cross(&arm).norm();
        let reach = radius + self.away;
        let angle = (to - from).abs().to_radians();
        let half = Rotation3::from_axis_angle(&axis.direction, (0.5 * (from + to)).to_radians());
        Moving {
            middle: center + half * arm,
            away: self.away + radius * (0.5 * angle).min(2.0),
            speed: self.speed + angle * reach,
            bend: self.bend + 2.0 * angle * self.speed + angle * angle * reach,
        }
    }

    /// The point less another.
    fn less(self, other: Moving) -> Self {
        Moving {
            middle: self.middle - other.middle,
            away: self.away + other.away,
            speed: self.speed + other.speed,
            bend: self.bend + other.bend,
        }
    }
}

/// Most that the second derivative of the tip by the share of a motion can be, mm; under
/// tool-tip control no rotary axis bends its path.
pub fn of_tip(forward: &Forward, from: &Position, to: &Position, arc: Option<&Arc>) -> f64 {
    let mut point = Moving::linear(forward, from, to, arc);
    if to.names_tip() {
        return point.bend;
    }
    let tool = forward.tool();
    let turn = |point: Moving, carries: Carries, centered: bool| {
        // From the tool to the part: the secondary axis first.
        [1, 0].into_iter().fold(point, |point, n| match &forward.rotaries()[n] {
            Some(axis) if axis.carries == carries => {
                let center = if centered { axis.center.coords } else { Vector3::zeros() };
                point.turned(axis, center, [from.rotary[n], to.rotary[n]])
            }
            _ => point,
        })
    };
    if let Some(length) = forward.pivot() {
        let head = turn(Moving::fixed(tool * length), Carries::Head, false);
        point = point.less(head).less(Moving::fixed(-tool * length));
    }
    turn(point, Carries::Table, true).bend
}

/// Most that the second derivative of the tool axis, a unit vector, can be.
pub fn of_axis(forward: &Forward, from: &Position, to: &Position) -> f64 {
    let turn = |axis: Moving, n: usize| match &forward.rotaries()[n] {
        Some(rotary) => axis.turned(rotary, Vector3::zeros(), [from.rotary[n], to.rotary[n]]),
        None => axis,
    };
    turn(turn(Moving::fixed(forward.tool()), 1), 0).bend
}
