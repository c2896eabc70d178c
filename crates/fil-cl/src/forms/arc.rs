//! Arcs and helices that are given by geometry, as CIRCLE and the point where they end.
//!
//! INDIRV tells the direction of departure: with the way from the center to the start it
//! tells the axis and the sense, so that nothing is believed that the statement does not say
//! twice. The end is where the circle meets the line or plane; it is named by its number
//! along the way and, in all files seen, as the second point of the line.

use super::geometry::{Round, Stop};
use super::vector::{Vector, across, add, cross, dot, norm, sub, unit};
use crate::record::{Circle, Record, Word};
use crate::vocabulary::Vocabulary;
use crate::words;

/// Points nearer than this are one point: CAM systems round to five decimals, arcs to the
/// tolerance of their path.
const NEAR: f64 = 1e-3;

/// Least cosine between a direction and the tangent it stands for.
const TANGENT: f64 = 0.7;

/// Least cosine between the axis computed and the one given.
const PARALLEL: f64 = 0.99;

/// An arc, where it ends, and how many full turns it makes besides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Path {
    pub(crate) circle: Circle,
    pub(crate) end: Vector,
    pub(crate) turns: f64,
}

impl Path {
    /// Makes a record its CIRCLE.
    pub(crate) fn fill(&self, record: &mut Record) {
        record.fill_arc(self.circle);
        if self.turns > 0.0 {
            record.data.extend([Word::Minor(words::TIMES), Word::Number(self.turns)]);
        }
    }
}

/// Where a motion starts, and how it departs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Departure {
    pub(crate) start: Vector,
    pub(crate) direction: Vector,
}

/// The arc from a departure along a circle to a stop. `axes` are those that the circle may
/// have when it names none: that of the part surface, that of the tool, those of the part.
pub(crate) fn arc(
    from: Departure,
    round: Round,
    stop: Stop,
    axes: impl Iterator<Item = Vector>,
) -> Result<Path, String> {
    let axis = match round.axis {
        Some(axis) => only_axis(from, round.center, axis)?,
        None => axis_of(from, round.center, axes)?,
    };
    check_radius(from.start, round.center, axis, round.radius)?;
    let line = stop.line.map(|point| sub(point, round.center));
    if round.axis.is_none() && line.iter().any(|point| dot(*point, axis).abs() > NEAR) {
        return Err("the line lies out of the plane of the arc".to_string());
    }
    let ways = ways(from, round, axis, line)?;
    let named = sub(stop.line[1], round.center);
    let is_named = |point: Vector| norm(across(sub(point, named), axis)) < NEAR;
    let end = chosen(&ways, stop.count, is_named)?;
    let height = dot(sub(from.start, round.center), axis);
    let end = if is_named(end) { named } else { end };
    let end = add(round.center, add(across(end, axis), axis, height), 1.0);
    let center = add(round.center, axis, height);
    let circle = Circle { center, axis, radius: Some(round.radius) };
    Ok(Path { circle, end, turns: 0.0 })
}

/// What is said where a departure fits no axis.
const NO_TANGENT: &str = "INDIRV is no tangent of the circle in a plane that the file names";

/// The axis that is given, by the right-hand rule.
fn only_axis(from: Departure, center: Vector, axis: Vector) -> Result<Vector, String> {
    turned(from, center, axis).ok_or_else(|| NO_TANGENT.to_string())
}

/// The axis by the right-hand rule, the first of these that the departure fits.
fn axis_of(
    from: Departure,
    center: Vector,
    given: impl Iterator<Item = Vector>,
) -> Result<Vector, String> {
    let found = unit(cross(sub(from.start, center), from.direction));
    let is_near = |axis: &Vector| found.is_some_and(|found| dot(found, *axis).abs() > PARALLEL);
    given
        .filter(is_near)
        .find_map(|axis| turned(from, center, axis))
        .ok_or_else(|| NO_TANGENT.to_string())
}

/// An axis, turned so that the departure is counterclockwise about it; `None` where the
/// departure is no tangent of a circle about it.
fn turned(from: Departure, center: Vector, axis: Vector) -> Option<Vector> {
    let out = unit(across(sub(from.start, center), axis))?;
    let along = unit(across(from.direction, axis))?;
    let turn = dot(axis, cross(out, along));
    let is_flat = dot(unit(from.direction)?, along) > PARALLEL;
    (is_flat && turn.abs() > TANGENT).then(|| axis.map(|part| part * turn.signum() + 0.0))
}

fn check_radius(point: Vector, center: Vector, axis: Vector, radius: f64) -> Result<(), String> {
    let found = norm(across(sub(point, center), axis));
    if (found - radius).abs() > NEAR || radius < NEAR {
        return Err(format!("radius {radius:.4}, but the start lies at {found:.4}"));
    }
    Ok(())
}

/// An intersection: how far along the way, in radians, and where from the center.
#[derive(Clone, Copy, Debug)]
struct Way {
    angle: f64,
    point: Vector,
}

/// Both intersections of a circle and a line, the nearer one first; one at the start has the
/// angle 0.
fn ways(
    from: Departure,
    round: Round,
    axis: Vector,
    line: [Vector; 2],
) -> Result<[Way; 2], String> {
    let [first, second] = line.map(|point| across(point, axis));
    let along = unit(sub(second, first)).ok_or("the line is a point in the plane of the arc")?;
    let foot = add(first, along, -dot(first, along));
    let rest = round.radius * round.radius - dot(foot, foot);
    if rest < -2.0 * NEAR * round.radius {
        return Err("the circle does not meet the line".to_string());
    }
    let half = rest.max(0.0).sqrt();
    let out = across(sub(from.start, round.center), axis);
    let mut ways = [half, -half].map(|by| {
        let point = add(foot, along, by);
        let turn = libm::atan2(dot(axis, cross(out, point)), dot(out, point));
        let is_start = norm(sub(point, out)) < NEAR;
        let angle = if is_start { 0.0 } else { turn.rem_euclid(std::f64::consts::TAU) };
        Way { angle, point }
    });
    ways.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    Ok(ways)
}

/// The intersection that is meant.
fn chosen(
    ways: &[Way; 2],
    count: Option<u32>,
    is_named: impl Fn(Vector) -> bool,
) -> Result<Vector, String> {
    let starts_on_it = ways[0].angle == 0.0;
    let way = match (count, starts_on_it) {
        (None | Some(1), false) => ways[0],
        (Some(2), _) => ways[1],
        (Some(3), true) => ways[0],
        // The start lies on the line: the number would count it, and no number tells nothing.
        (None, true) if is_named(ways[1].point) => ways[1],
        _ => return Err("which intersection ends the arc is not clear".to_string()),
    };
    if !is_named(way.point) && ways.iter().any(|other| is_named(other.point)) {
        return Err("the number of the intersection contradicts the point of the line".to_string());
    }
    Ok(way.point)
}

/// HELICAL: all that it says.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Helix {
    pub(crate) center: Vector,
    pub(crate) axis: Vector,
    pub(crate) radius: f64,
    /// Degrees.
    pub(crate) angle: f64,
    pub(crate) height: f64,
    pub(crate) pitch: f64,
    pub(crate) rounds: f64,
    pub(crate) end: Vector,
}

/// The words of HELICAL in their order, each with how many numbers follow it.
const HELICAL: [(&str, usize); 9] = [
    ("CENTER", 3),
    ("INDIRV", 3),
    ("AXIS", 3),
    ("PITCH", 1),
    ("RADIUS", 1),
    ("ANGLE", 1),
    ("HEIGHT", 1),
    ("ROUND", 1),
    ("END", 3),
];

/// A HELICAL and the direction in which it departs.
pub(crate) fn read_helix(vocab: &Vocabulary, items: &[Word]) -> Option<(Helix, Vector)> {
    let mut values = Vec::new();
    let mut items = items.iter();
    for (name, count) in HELICAL {
        let Word::Minor(word) = items.next()? else { return None };
        if vocab.name(*word) != name {
            return None;
        }
        for _ in 0..count {
            let Word::Number(value) = items.next()? else { return None };
            values.push(*value);
        }
    }
    if items.next().is_some() {
        return None;
    }
    let three = |at: usize| [values[at], values[at + 1], values[at + 2]];
    let helix = Helix {
        center: three(0),
        axis: three(6),
        pitch: values[9],
        radius: values[10],
        angle: values[11],
        height: values[12],
        rounds: values[13],
        end: three(14),
    };
    Some((helix, three(3)))
}

/// The helix from a departure.
pub(crate) fn helix(from: Departure, helix: &Helix) -> Result<Path, String> {
    let given = unit(helix.axis).ok_or("AXIS has no length")?;
    let axis = only_axis(from, helix.center, given)?;
    check_radius(from.start, helix.center, axis, helix.radius)?;
    check_radius(helix.end, helix.center, axis, helix.radius)?;
    let height = dot(sub(helix.end, from.start), axis).abs();
    let disagree = |a: f64, b: f64| (a - b).abs() > NEAR.max(1e-3 * a.abs());
    if disagree(height, helix.height.abs()) || disagree(helix.angle / 360.0, helix.rounds) {
        return Err("HEIGHT, ROUND, ANGLE and END do not agree".to_string());
    }
    if disagree(helix.pitch.abs() * helix.rounds, helix.height.abs()) {
        return Err("PITCH, ROUND and HEIGHT do not agree".to_string());
    }
    let [out, end] = [from.start, helix.end].map(|point| across(sub(point, helix.center), axis));
    let turn =
        libm::atan2(dot(axis, cross(out, end)), dot(out, end)).to_degrees().rem_euclid(360.0);
    // A degree of a circle as small as this is below what points near each other tell.
    let slack = (2.0 * NEAR / helix.radius).to_degrees();
    let turns = ((helix.angle - turn) / 360.0).round();
    if helix.angle <= 0.0 || (helix.angle - turn - 360.0 * turns).abs() > slack || turns < 0.0 {
        return Err("ANGLE and END do not agree".to_string());
    }
    let is_whole = norm(sub(out, end)) < 1e-6;
    if !is_whole && norm(sub(out, end)) < NEAR {
        return Err("END is nearly above the start: a full turn or none".to_string());
    }
    let circle = Circle { center: helix.center, axis, radius: Some(helix.radius) };
    Ok(Path { circle, end: helix.end, turns })
}
