//! A helix: `CC` and `CP IPA+360 IZ-1 DR+`. The control turns the tool about the pole by
//! an angle, from where it stands, so no coordinate says where it ends: the pole and the
//! angle are chosen so that it ends there.

use fil_diag::Result;
use fil_machine::letters::IJK;

use crate::control::Control;
use crate::control::word_address::arc as words;
use crate::operation::motion::PlaneArc;

/// Decimals of a polar angle, degrees.
const ANGLE: f64 = 1e4;

/// By how many last digits of an axis the tool may end beside the point that is meant.
const BESIDE: f64 = 0.4;

/// A helix as the control reads it; lengths in mm or inch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    /// The pole.
    pub pole: [f64; 2],
    /// Degrees, counterclockwise above zero.
    pub angle: f64,
    /// Where it ends.
    pub end: [f64; 2],
}

/// True for an arc whose end the tape says at another level than its start.
///
/// # Errors
/// A position that does not fit its address.
pub fn rises(control: &Control, arc: &PlaneArc) -> Result<bool> {
    let normal = arc.plane.normal();
    let axis = control.tables.axis(normal);
    Ok(axis.scaled(arc.from[normal])? != axis.scaled(arc.to[normal])?)
}

/// The helix that leads from where the tool stands to the end of an arc; `None` where
/// rounding would make another one of it.
///
/// # Errors
/// A value that does not fit its address.
pub fn of(control: &Control, arc: &PlaneArc, stands: [f64; 2]) -> Result<Option<Helix>> {
    let axes = arc.plane.axes();
    let digits = axes.map(|number| control.tables.axis(number).resolution());
    let end = axes.map(|number| arc.to[number]);
    let lands = |point: [f64; 2]| {
        (0..2).all(|index| (point[index] - end[index]).abs() <= BESIDE * digits[index])
    };
    let closes = arc.sweep > 180.0 && lands(stands);
    let center = if closes { arc.center } else { on_bisector(arc.center, stands, end) };
    let mut pole = [0.0; 2];
    for (index, number) in axes.into_iter().enumerate() {
        let Some(format) = control.tables.addresses.format(IJK[number]) else { return Ok(None) };
        let moved = control.tables.axis(number).translation();
        pole[index] = format.unscale(format.scale(center[index] + moved)?) - moved;
    }
    let turned = if closes { 360.0 } else { turned(arc, pole, stands, end) };
    let turned = (turned * ANGLE).round() / ANGLE;
    let angle = if arc.counterclockwise { turned } else { -turned };
    let reached = rotated(pole, stands, angle);
    let meant = turned > 0.0
        && lands(reached)
        && words::turns_as_meant(control, arc, stands, (pole, turned));
    Ok(meant.then_some(Helix { pole, angle, end: reached }))
}

/// The point nearest to a center that is as far from one end as from the other.
fn on_bisector(center: [f64; 2], from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let chord = [to[0] - from[0], to[1] - from[1]];
    let squared = chord[0] * chord[0] + chord[1] * chord[1];
    let off = [center[0] - (from[0] + to[0]) / 2.0, center[1] - (from[1] + to[1]) / 2.0];
    let along = (off[0] * chord[0] + off[1] * chord[1]) / squared;
    [center[0] - along * chord[0], center[1] - along * chord[1]]
}

/// Degrees from start to end about a pole in the sense of the arc: of the angles that lead there,
/// the one nearest to its sweep, which may be a little more than a full turn.
fn turned(arc: &PlaneArc, pole: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let angle = |point: [f64; 2]| libm::atan2(point[1] - pole[1], point[0] - pole[0]).to_degrees();
    let turned = angle(to) - angle(from);
    let turned = if arc.counterclockwise { turned } else { -turned };
    turned + 360.0 * ((arc.sweep - turned) / 360.0).round()
}

fn rotated(pole: [f64; 2], point: [f64; 2], angle: f64) -> [f64; 2] {
    let [x, y] = [point[0] - pole[0], point[1] - pole[1]];
    let (sine, cosine) = libm::sincos(angle.to_radians());
    [pole[0] + x * cosine - y * sine, pole[1] + x * sine + y * cosine]
}
