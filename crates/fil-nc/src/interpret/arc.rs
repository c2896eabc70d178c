//! Arcs and helices: center or radius, sense, sweep.

use super::Fault;
use super::state::{Axes, State};
use super::words::{Words, letter};
use crate::dialect::{Amount, CenterForm, Habit, HelixForm, Role};
use crate::errors::NcCode;
use crate::motion::{Arc, Course, unit};

const FULL: f64 = 360.0;

/// By this much the radii at start and end may differ, mm: numbers on the tape are
/// rounded to a thousandth, and so may be those of the CL file.
const RADIUS_TOLERANCE: f64 = 0.004;

/// The same of inches, which have four digits.
const INCH_TOLERANCE: f64 = 0.013;

/// The same in steps that a setting names: both ends and the center are off by half of one at
/// most, along and across.
const STEPS: f64 = 2.0;

/// By this part the word of a helix may differ from its rise.
const HELIX_TOLERANCE: f64 = 0.011;

/// Ends nearer than this are one point, mm.
const SAME_POINT: f64 = 1e-7;

/// Letters of the center, by axis.
const CENTER: [u8; 3] = [letter(b'I'), letter(b'J'), letter(b'K')];

/// The two axes of a plane, in the order that makes its normal right-handed.
pub(super) fn plane_axes(normal: usize) -> [usize; 2] {
    [(normal + 1) % 3, (normal + 2) % 3]
}

impl State<'_> {
    /// An arc in the plane in force.
    pub(super) fn arc(&mut self, words: &mut Words, ccw: bool) -> Result<(), Fault> {
        let rate = self.rate()?;
        let ccw = ccw == self.dialect.forms.right_handed[self.plane];
        let axes = words.take_axes(self.dialect)?;
        let (to, known) = self.target(&axes);
        let plane = plane_axes(self.plane);
        if plane.iter().any(|axis| !self.known[*axis]) {
            return Err(Fault::new(NcCode::NoCenter, "it is not known where the arc begins"));
        }
        let radius = words.take(self.dialect.letter(Role::Radius))?;
        let has_center = plane.iter().any(|axis| words.has(CENTER[*axis]));
        let radius = radius.or(self.since.arc_radius.filter(|_| !has_center));
        let (center, angle) = match radius {
            Some(radius) => self.about_radius(plane, &to, radius * self.unit(), ccw)?,
            None => {
                let center = self.center(words, plane, &to, ccw)?;
                (center, sweep(plane, center, &self.at, &to, ccw))
            }
        };
        self.check_helix(words, &to, angle)?;
        if self.live.polar && to[2] != self.at[2] {
            let message = "Z moves along an arc in polar interpolation";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        let mut point = [0.0; 3];
        point[self.plane] = self.at[self.plane];
        (point[plane[0]], point[plane[1]]) = (center[0], center[1]);
        let arc = Arc { center: point, normal: self.plane, ccw, angle };
        self.travel((to, known), Course::Feed, Some(rate), Some(arc));
        self.since.arc_radius = radius.filter(|_| self.dialect.has(Habit::RadiusModal));
        Ok(())
    }

    /// The word of a helix must say how far the arc rises to its end.
    fn check_helix(&self, words: &mut Words, to: &Axes, angle: f64) -> Result<(), Fault> {
        let Some(form) = self.dialect.forms.helix else { return Ok(()) };
        let Some(given) = words.take(CENTER[self.plane])? else { return Ok(()) };
        let a_radian = (to[self.plane] - self.at[self.plane]) / angle.to_radians();
        let rise = match form {
            HelixForm::Radian => a_radian.abs(),
            HelixForm::SignedRadian => a_radian,
            HelixForm::Turn => a_radian.abs() * std::f64::consts::TAU,
        };
        let given = self.length(self.plane, given);
        if rise == 0.0 || (given - rise).abs() > HELIX_TOLERANCE * rise.abs() {
            let message = format!("the helix word says {given:.4} mm, and the arc rises {rise:.4}");
            return Err(Fault::new(NcCode::ArcRadii, message));
        }
        Ok(())
    }

    /// The center that I, J, K name.
    fn center(
        &self,
        words: &mut Words,
        plane: [usize; 2],
        to: &Axes,
        ccw: bool,
    ) -> Result<[f64; 2], Fault> {
        let mut given = [None; 2];
        for (value, axis) in given.iter_mut().zip(plane) {
            *value = words.take(CENTER[axis])?.map(|value| value * self.unit());
        }
        if given == [None; 2] {
            return Err(Fault::new(NcCode::NoCenter, "neither a center nor a radius is given"));
        }
        let start = plane.map(|axis| self.at[axis]);
        let by = given.map(|value| value.unwrap_or(0.0));
        let center = match self.dialect.forms.center {
            CenterForm::FromStart => [start[0] + by[0], start[1] + by[1]],
            CenterForm::FromCenter => [start[0] - by[0], start[1] - by[1]],
            CenterForm::Absolute => match given {
                [Some(_), Some(_)] => [0, 1].map(|index| self.moved(plane[index], by[index])),
                _ => return Err(Fault::new(NcCode::NoCenter, "the center needs both coordinates")),
            },
            CenterForm::Unsigned => self.unsigned(plane, by, to, ccw)?,
        };
        self.check_radii(plane, center, to)?;
        Ok(center)
    }

    /// A coordinate of a center on an axis whose positions are moved on the tape.
    pub(super) fn moved(&self, axis: usize, center: f64) -> f64 {
        let scale = self.dialect.axes[axis].scale;
        center - scale.map_or(0.0, |scale| scale.shift) * self.unit() + self.zero[axis]
    }

    /// Of the four centers without signs the one that makes an arc within a quadrant.
    fn unsigned(
        &self,
        plane: [usize; 2],
        by: [f64; 2],
        to: &Axes,
        ccw: bool,
    ) -> Result<[f64; 2], Fault> {
        let start = plane.map(|axis| self.at[axis]);
        let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        signs
            .map(|sign| [start[0] + sign[0] * by[0], start[1] + sign[1] * by[1]])
            .into_iter()
            .find(|center| {
                self.check_radii(plane, *center, to).is_ok()
                    && sweep(plane, *center, &self.at, to, ccw) < 90.1
            })
            .ok_or_else(|| Fault::new(NcCode::ArcRadii, "no signs of the center make an arc"))
    }

    /// By how much the radii at start and end may differ, mm: by more where X, Y and Z have
    /// larger steps than their last digits.
    fn radius_tolerance(&self) -> f64 {
        let of_digits = if self.metric { RADIUS_TOLERANCE } else { INCH_TOLERANCE };
        of_digits.max(STEPS * self.dialect.amount(Amount::Steps).unwrap_or(0.0) * unit(self.metric))
    }

    pub(super) fn check_radii(
        &self,
        plane: [usize; 2],
        center: [f64; 2],
        to: &Axes,
    ) -> Result<(), Fault> {
        let radius =
            |point: &Axes| libm::hypot(point[plane[0]] - center[0], point[plane[1]] - center[1]);
        let (start, end) = (radius(&self.at), radius(to));
        let tolerance = self.radius_tolerance();
        if (start - end).abs() > tolerance || start < SAME_POINT {
            let message = format!("radius {start:.4} mm at the start, {end:.4} mm at the end");
            return Err(Fault::new(NcCode::ArcRadii, message));
        }
        Ok(())
    }

    /// Center and sweep of an arc of a radius; a negative one goes the long way.
    pub(super) fn about_radius(
        &self,
        plane: [usize; 2],
        to: &Axes,
        radius: f64,
        ccw: bool,
    ) -> Result<([f64; 2], f64), Fault> {
        let start = plane.map(|axis| self.at[axis]);
        let chord = [to[plane[0]] - start[0], to[plane[1]] - start[1]];
        let length = libm::hypot(chord[0], chord[1]);
        if length < SAME_POINT {
            return Err(Fault::new(NcCode::NoCenter, "a radius can't make a full circle"));
        }
        let tolerance = self.radius_tolerance();
        if length / 2.0 > radius.abs() + tolerance {
            let message = format!("radius {radius:.4} mm, but the ends are {length:.4} mm apart");
            return Err(Fault::new(NcCode::ArcRadii, message));
        }
        let height = (radius * radius - length * length / 4.0).max(0.0).sqrt();
        // Left of the chord lies the center of a short counterclockwise arc.
        let side = if ccw == (radius > 0.0) { height } else { -height };
        let center = [
            start[0] + chord[0] / 2.0 - chord[1] / length * side,
            start[1] + chord[1] / 2.0 + chord[0] / length * side,
        ];
        Ok((center, sweep(plane, center, &self.at, to, ccw)))
    }
}

/// Degrees from start to end about the center, above 0; 360 when they are one point.
pub(super) fn sweep(plane: [usize; 2], center: [f64; 2], from: &Axes, to: &Axes, ccw: bool) -> f64 {
    let arm = |point: &Axes| [point[plane[0]] - center[0], point[plane[1]] - center[1]];
    let (a, b) = (arm(from), arm(to));
    if libm::hypot(a[0] - b[0], a[1] - b[1]) < SAME_POINT {
        return FULL;
    }
    let turned = libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]).to_degrees();
    let turned = if ccw { turned } else { -turned };
    if turned <= 0.0 { turned + FULL } else { turned }
}
