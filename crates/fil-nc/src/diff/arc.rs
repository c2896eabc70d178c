//! Arcs compared as geometry: a center and a radius that give the same path are
//! the same, however they are written.

use std::f64::consts::TAU;

use super::Options;
use super::program::Line;

/// Points of an arc that are compared.
const SAMPLES: u32 = 16;

/// How far start and end may be from one circle, as a share of its radius, for
/// the words to be understood as an arc's.
const ROUND: f64 = 0.05;

/// Ends of a full circle may be apart by this much, from decimal to binary.
const SAME: f64 = 1e-9;

/// An arc in its plane.
struct Arc {
    /// Start and end, as the words say them.
    ends: [[f64; 2]; 2],
    center: [f64; 2],
    radius: f64,
    /// Direction of the start, radians.
    from: f64,
    /// Radians to go, negative clockwise.
    sweep: f64,
}

impl Arc {
    /// The point after a share of the way.
    fn point(&self, share: f64) -> [f64; 2] {
        let angle = self.from + self.sweep * share;
        [
            self.center[0] + self.radius * libm::cos(angle),
            self.center[1] + self.radius * libm::sin(angle),
        ]
    }
}

/// Largest distance between two arcs at the same share of their way; `None` when
/// one of the blocks is no arc whose geometry is known, or the arcs go
/// different ways, which the functions tell.
pub(super) fn deviation(one: &Line, two: &Line, options: &Options) -> Option<f64> {
    if one.after.arc()? != two.after.arc()? || one.after.plane() != two.after.plane() {
        return None;
    }
    let (one, two) = (arc(one, options)?, arc(two, options)?);
    let apart = |step: u32| {
        let share = f64::from(step) / f64::from(SAMPLES);
        let ([x1, y1], [x2, y2]) = (one.point(share), two.point(share));
        libm::hypot(x1 - x2, y1 - y2)
    };
    // The ends are words of their own; between them the center shows.
    Some((1..SAMPLES).map(apart).fold(0.0, f64::max) - end_difference(&one, &two))
        .map(|d| d.max(0.0))
}

/// How far the ends are apart, whichever is more.
fn end_difference(one: &Arc, two: &Arc) -> f64 {
    let apart = |end: usize| {
        let ([x1, y1], [x2, y2]) = (one.ends[end], two.ends[end]);
        libm::hypot(x1 - x2, y1 - y2)
    };
    apart(0).max(apart(1))
}

fn arc(line: &Line, options: &Options) -> Option<Arc> {
    let [u, v, _] = line.after.plane();
    let ccw = line.after.arc()?;
    let half = |axis: usize| if axis == 0 && options.diameter { 0.5 } else { 1.0 };
    let letters = [u, v].map(|axis| b"XYZ"[axis]);
    let mut start = [0.0; 2];
    let mut end = [0.0; 2];
    for (at, axis) in [u, v].into_iter().enumerate() {
        start[at] = line.before.value(letters[at])? * half(axis);
        end[at] = line.after.value(letters[at])? * half(axis);
    }
    let word = |letter: u8| line.block.word(letter).map(|word| word.number.value());
    let offsets = [u, v].map(|axis| word(b"IJK"[axis]));
    let center = match (offsets, word(b'R')) {
        ([None, None], Some(radius)) => center_of_radius(start, end, radius, ccw)?,
        ([None, None], None) => return None,
        (offsets, _) if line.after.absolute_centers() => [offsets[0]?, offsets[1]?],
        (offsets, _) => {
            [start[0] + offsets[0].unwrap_or(0.0), start[1] + offsets[1].unwrap_or(0.0)]
        }
    };
    let from_center = |point: [f64; 2]| [point[0] - center[0], point[1] - center[1]];
    let (s, e) = (from_center(start), from_center(end));
    let radius = libm::hypot(s[0], s[1]);
    if (libm::hypot(e[0], e[1]) - radius).abs() > ROUND * radius {
        return None;
    }
    let from = libm::atan2(s[1], s[0]);
    let mut sweep = libm::atan2(e[1], e[0]) - from;
    if libm::hypot(start[0] - end[0], start[1] - end[1]) < SAME {
        sweep = 0.0;
    }
    while ccw && sweep <= 0.0 {
        sweep += TAU;
    }
    while !ccw && sweep >= 0.0 {
        sweep -= TAU;
    }
    Some(Arc { ends: [start, end], center, radius, from, sweep })
}

/// Center of an arc given by its radius; a negative one goes the long way.
fn center_of_radius(start: [f64; 2], end: [f64; 2], radius: f64, ccw: bool) -> Option<[f64; 2]> {
    let chord = [end[0] - start[0], end[1] - start[1]];
    let length = libm::hypot(chord[0], chord[1]);
    let height = radius * radius - length * length / 4.0;
    if length == 0.0 || height < -ROUND * radius * radius {
        return None;
    }
    let side = if ccw == (radius > 0.0) { 1.0 } else { -1.0 };
    let height = side * height.max(0.0).sqrt() / length;
    Some([
        (start[0] + end[0]) / 2.0 - chord[1] * height,
        (start[1] + end[1]) / 2.0 + chord[0] * height,
    ])
}
