//! Rotary axes: from a point and a tool axis in the part to machine axes.
//!
//! The chain from part to tool has up to two rotary axes, the primary next to
//! the part (on a head/head machine: next to the base), the secondary next to
//! the tool. With unit directions u1, u2, rotations R by the right-hand rule and
//! the tool direction t at zero positions, the axis in the part frame is
//! `a = R(u1, r1) R(u2, r2) t`: angles count as motion of the tool relative to
//! the part, so a table turns by -r. The solution for r1, r2 is the classical
//! second subproblem of Paden and Kahan (two successive rotations about axes
//! through one point).

use nalgebra::{Point3, Unit, Vector3};

use crate::commons::{Commons, Dbl};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{self as loc, RotaryAxis, RotaryKind, TravelKind};
use crate::modes::INCH;
pub use crate::rotation::Turn;
use crate::rotation::{self, SAME, turn};
use crate::setting::{Choice, LetterAt, OptionalChoice};
use crate::zones::Zones;
use fil_diag::{Diag, Result};
pub use rotary_axis::Rotary;

/// Whole turns to either side in which other positions of a limited axis are looked for.
pub const TURNS: i32 = 12;

/// Letters of rotary axes about X, Y and Z (ISO 841).
pub const ROTARY_LETTERS: [Letter; 3] = [Letter::of(b'A'), Letter::of(b'B'), Letter::of(b'C')];

/// What a rotary axis carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carries {
    /// The part.
    Table,
    /// The tool.
    Head,
}

/// Positions of all axes that bring the tip to a point and the tool along its axis.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Of X, Y and Z, in the unit of the machine's lengths.
    pub linear: Point3<f64>,
    /// Of the rotary axes, degrees.
    pub angles: [f64; 2],
    /// Those that are the nearest if no axis has limits, degrees.
    pub free: [f64; 2],
    /// Those of the rotary axes with their sines.
    pub turns: [Turn; 2],
}

/// The rotary axes of a machine; `None` for an axis that is not there.
#[derive(Clone, Debug)]
pub struct AxisChain {
    /// The axes, primary first.
    pub rotaries: [Option<Rotary>; 2],
    /// Tool direction (from the tip to the spindle) at zero positions.
    pub tool: Unit<Vector3<f64>>,
    /// Distance from the pivot of the head to the tool tip, mm; `None` when
    /// the control itself keeps the tip on the path.
    pub pivot: Option<f64>,
}

struct RotaryLocations {
    kind: Choice<RotaryKind>,
    letter: LetterAt,
    axis: OptionalChoice<RotaryAxis>,
    direction: [Dbl; 3],
    center: [Dbl; 3],
    range: [Dbl; 2],
}

const PRIMARY: RotaryLocations = RotaryLocations {
    kind: loc::ROTARY_PRIMARY_KIND,
    letter: loc::ROTARY_PRIMARY_LETTER,
    axis: loc::ROTARY_PRIMARY_AXIS,
    direction: [loc::ROTARY_PRIMARY_I, loc::ROTARY_PRIMARY_J, loc::ROTARY_PRIMARY_K],
    center: [loc::ROTARY_PRIMARY_X, loc::ROTARY_PRIMARY_Y, loc::ROTARY_PRIMARY_Z],
    range: [loc::ROTARY_PRIMARY_MIN, loc::ROTARY_PRIMARY_MAX],
};

const SECONDARY: RotaryLocations = RotaryLocations {
    kind: loc::ROTARY_SECONDARY_KIND,
    letter: loc::ROTARY_SECONDARY_LETTER,
    axis: loc::ROTARY_SECONDARY_AXIS,
    direction: [loc::ROTARY_SECONDARY_I, loc::ROTARY_SECONDARY_J, loc::ROTARY_SECONDARY_K],
    center: [loc::ROTARY_SECONDARY_X, loc::ROTARY_SECONDARY_Y, loc::ROTARY_SECONDARY_Z],
    range: [loc::ROTARY_SECONDARY_MIN, loc::ROTARY_SECONDARY_MAX],
};

impl Default for AxisChain {
    /// Three linear axes, the tool along Z.
    fn default() -> Self {
        AxisChain { rotaries: [None, None], tool: Vector3::z_axis(), pivot: None }
    }
}

impl AxisChain {
    /// The machine's axes as the commons describe them, lengths in mm.
    ///
    /// # Errors
    /// A direction of length zero.
    pub fn from_commons(commons: &Commons) -> Result<Self> {
        let tool = [loc::TOOL_AXIS_I, loc::TOOL_AXIS_J, loc::TOOL_AXIS_K];
        Ok(AxisChain {
            rotaries: [
                rotary(commons, &PRIMARY, commons.read(loc::ROTARY_LISTED_PRIMARY))?,
                rotary(commons, &SECONDARY, None)?,
            ],
            tool: direction(commons, tool, "tool.axis", [0.0, 0.0, 1.0])?,
            pivot: commons.dbl_opt(loc::ROTARY_PIVOT_DISTANCE),
        })
    }

    /// The same machine with its lengths in inches, for a program in inches.
    pub fn in_inches(mut self) -> Self {
        self.pivot = self.pivot.map(|length| length / INCH);
        for rotary in self.rotaries.iter_mut().flatten() {
            rotary.center /= INCH;
        }
        self
    }

    /// True when the machine has a rotary axis.
    pub fn has_rotary(&self) -> bool {
        self.rotaries.iter().any(Option::is_some)
    }

    /// True when a rotary axis turns the tool.
    pub fn has_heads(&self) -> bool {
        self.rotaries.iter().flatten().any(|rotary| rotary.carries == Carries::Head)
    }

    /// Rotary positions in degrees that bring the tool along `axis`: of the
    /// solutions within the limits, the one nearest to `last` (degrees).
    ///
    /// # Errors
    /// No solution at all, or none within the limits.
    #[inline(never)]
    pub fn solve(&self, axis: Vector3<f64>, last: [f64; 2]) -> Result<[f64; 2]> {
        Ok(self.solve_with_free(axis, last)?.0)
    }

    /// As [`AxisChain::solve`], and beside it the positions that are the nearest if no axis
    /// has limits.
    ///
    /// # Errors
    /// As [`AxisChain::solve`].
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn solve_with_free(
        &self,
        axis: Vector3<f64>,
        last: [f64; 2],
    ) -> Result<([f64; 2], [f64; 2])> {
        if is_none(axis) {
            return MachineCode::ToolAxis.err("the tool axis has length zero");
        }
        let solutions = self.all(axis, last);
        let solutions = solutions.pairs();
        let Some(free) = nearest_free(solutions, last) else { return Err(unreachable(axis)) };
        if self.goes(last, free) {
            return Ok((free, free));
        }
        Ok((self.nearest(solutions, last).ok_or_else(|| outside(solutions))?, free))
    }

    /// Positions of all axes for a tip in the part, in the unit of the machine's lengths, and a
    /// tool axis: rotary positions as those of [`AxisChain::solve_with_free`].
    ///
    /// # Errors
    /// As [`AxisChain::solve`].
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn place(&self, tip: Point3<f64>, axis: Vector3<f64>, last: [f64; 2]) -> Result<Place> {
        if let [Some(table), None] = &self.rotaries
            && let Some(place) = self.place_on(table, tip, axis, last)
        {
            return Ok(place);
        }
        let (angles, free) = self.solve_with_free(axis, last)?;
        let turns = self.turns_of(angles);
        Ok(Place { linear: self.linear_by(tip, turns), angles, free, turns })
    }

    /// The same on one table about X, Y or Z, whose sine is that of the directions: X, Y and Z
    /// need not wait for the angle. `None` where more is to be said.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn place_on(
        &self,
        table: &Rotary,
        tip: Point3<f64>,
        axis: Vector3<f64>,
        last: [f64; 2],
    ) -> Option<Place> {
        if table.carries != Carries::Table || is_none(axis) {
            return None;
        }
        let tool = self.tool.into_inner();
        let turn = rotation::turn_about_a_line(table.direction, tool, axis, last[0])?;
        let turn = turn.at(near(turn.degrees, last[0]));
        if !table.goes(last[0], turn.degrees) {
            return None;
        }
        let linear = table.center + table.turned_by(tip - table.center, turn.back());
        let angles = [turn.degrees, last[1]];
        Some(Place { linear, angles, free: angles, turns: [turn, Turn::default()] })
    }

    /// All pairs of rotary positions that bring the tool along `axis`, in degrees from -180
    /// to 180, whatever the limits; an axis that does not turn the tool stays at `last`.
    #[inline(never)]
    pub fn solutions(&self, axis: Vector3<f64>, last: [f64; 2]) -> Vec<[f64; 2]> {
        if is_none(axis) { Vec::new() } else { self.all(axis, last).pairs().to_vec() }
    }

    /// True when the travel of a rotary axis is limited.
    pub fn is_limited(&self) -> bool {
        self.rotaries.iter().flatten().any(Rotary::is_limited)
    }

    /// True when the rotary axes can stand at these positions, degrees.
    pub fn reaches(&self, angles: [f64; 2]) -> bool {
        let reaches = |(rotary, angle): (&Option<Rotary>, f64)| {
            rotary.as_ref().is_none_or(|rotary| rotary.reaches(angle))
        };
        self.rotaries.iter().zip(angles).all(reaches)
    }

    /// True when the rotary axes can go from one position to another, degrees.
    pub fn goes(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        (0..2).all(|n| self.rotaries[n].as_ref().is_none_or(|rotary| rotary.goes(from[n], to[n])))
    }

    /// As [`AxisChain::solve`] on a machine whose rotary axes have no limits; `None` where
    /// no position brings the tool along `axis`.
    #[inline(never)]
    pub fn nearest_anywhere(&self, axis: Vector3<f64>, last: [f64; 2]) -> Option<[f64; 2]> {
        if is_none(axis) {
            return None;
        }
        nearest_free(self.all(axis, last).pairs(), last)
    }

    /// All positions within the limits that bring the tool along `axis`, degrees, with up to
    /// [`TURNS`] whole turns from `last`; an axis that does not turn the tool stays at `last`,
    /// or goes by whole turns.
    pub fn positions(&self, axis: Vector3<f64>, last: [f64; 2]) -> Vec<[f64; 2]> {
        let mut positions = Vec::new();
        for found in self.solutions(axis, last) {
            let second = self.turns(1, near(found[1], last[1]), last[1]);
            for at in self.turns(0, near(found[0], last[0]), last[0]) {
                positions.extend(second.iter().map(|other| [at, *other]));
            }
        }
        positions
    }

    /// The first of two rotary axes turns the tool about itself where it lies along this direction,
    /// so that any position of it will do there.
    pub fn is_pole(&self, axis: Vector3<f64>) -> bool {
        let [Some(first), Some(_)] = &self.rotaries else { return false };
        !is_none(axis) && first.direction.cross(&axis.normalize()).norm() < SAME
    }

    /// An angle with the whole turns that the travel of a rotary axis has room for, degrees.
    fn turns(&self, number: usize, angle: f64, last: f64) -> Vec<f64> {
        let Some(rotary) = &self.rotaries[number] else { return vec![angle] };
        let most = if rotary.is_limited() { TURNS } else { 0 };
        let mut turns: Vec<_> = (-most..=most).map(|n| angle + 360.0 * f64::from(n)).collect();
        turns.retain(|angle| rotary.goes(last, *angle));
        turns
    }

    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn all(&self, axis: Vector3<f64>, last: [f64; 2]) -> Solutions {
        match &self.rotaries {
            [None, None] => self.fixed(Unit::new_normalize(axis), last),
            [Some(one), None] => {
                Solutions::of(single(one, axis, self.tool, last[0]).map(|angle| [angle, last[1]]))
            }
            [None, Some(one)] => {
                Solutions::of(single(one, axis, self.tool, last[1]).map(|angle| [last[0], angle]))
            }
            [Some(first), Some(second)] => {
                pair(first, second, Unit::new_normalize(axis), self.tool, last)
            }
        }
    }

    /// Machine position of the linear axes for a tool tip in the part frame, in the
    /// unit of the machine's lengths, and rotary positions in degrees.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn linear(&self, tip: Point3<f64>, angles: [f64; 2]) -> Point3<f64> {
        self.linear_by(tip, self.turns_of(angles))
    }

    /// Rotary positions, degrees, with their sines; of an axis that is not there 0.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn turns_of(&self, angles: [f64; 2]) -> [Turn; 2] {
        let of = |n: usize| match &self.rotaries[n] {
            Some(_) => Turn::of(angles[n]),
            None => Turn::default(),
        };
        [of(0), of(1)]
    }

    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn linear_by(&self, tip: Point3<f64>, turns: [Turn; 2]) -> Point3<f64> {
        let mut point = tip;
        let mut tool = self.tool.into_inner();
        for (rotary, turn) in self.rotaries.iter().zip(turns) {
            let Some(rotary) = rotary.as_ref().filter(|r| r.carries == Carries::Table) else {
                continue;
            };
            point = rotary.center + rotary.turned_by(point - rotary.center, turn.back());
        }
        for (rotary, turn) in self.rotaries.iter().zip(turns).rev() {
            let Some(rotary) = rotary.as_ref().filter(|r| r.carries == Carries::Head) else {
                continue;
            };
            tool = rotary.turned_by(tool, turn);
        }
        match self.pivot {
            Some(length) => point + (tool - self.tool.into_inner()) * length,
            None => point,
        }
    }

    fn fixed(&self, axis: Unit<Vector3<f64>>, last: [f64; 2]) -> Solutions {
        let reached = (axis.into_inner() - self.tool.into_inner()).norm() < SAME;
        Solutions::of(reached.then_some(last))
    }

    fn nearest(&self, solutions: &[[f64; 2]], last: [f64; 2]) -> Option<[f64; 2]> {
        let within = |index: usize, angle: f64| match &self.rotaries[index] {
            Some(rotary) => rotary.turn_near(angle, last[index]),
            None => Some(angle),
        };
        solutions
            .iter()
            .filter_map(|s| Some([within(0, s[0])?, within(1, s[1])?]))
            .min_by(|a, b| travel(a, &last).total_cmp(&travel(b, &last)))
    }
}

/// The pairs of rotary positions that bring the tool along an axis: two at most.
#[derive(Clone, Copy, Default)]
struct Solutions {
    pairs: [[f64; 2]; 2],
    count: usize,
}

impl Solutions {
    fn of(pairs: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut found = Solutions::default();
        for (place, pair) in found.pairs.iter_mut().zip(pairs) {
            *place = pair;
            found.count += 1;
        }
        found
    }

    fn pairs(&self) -> &[[f64; 2]] {
        &self.pairs[..self.count]
    }
}

/// Of the solutions with whole turns, whatever the limits, the one nearest to `last`.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn nearest_free(solutions: &[[f64; 2]], last: [f64; 2]) -> Option<[f64; 2]> {
    let mut found = solutions.iter().map(|at| [near(at[0], last[0]), near(at[1], last[1])]);
    let first = found.next()?;
    Some(found.fold(
        first,
        |best, next| {
            if travel(&next, &last) < travel(&best, &last) { next } else { best }
        },
    ))
}

/// An angle with the whole turns that bring it nearest to another, degrees.
#[inline]
fn near(angle: f64, last: f64) -> f64 {
    if (last - angle).abs() < 180.0 {
        return angle + 0.0;
    }
    angle + 360.0 * ((last - angle) / 360.0).round()
}

fn travel(angles: &[f64; 2], last: &[f64; 2]) -> f64 {
    (angles[0] - last[0]).abs() + (angles[1] - last[1]).abs()
}

#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn single(rotary: &Rotary, axis: Vector3<f64>, tool: Unit<Vector3<f64>>, last: f64) -> Option<f64> {
    turn(rotary.direction, tool.into_inner(), axis, last)
}

/// Solves `axis = R(first) R(second) tool`.
#[inline(never)]
fn pair(
    first: &Rotary,
    second: &Rotary,
    axis: Unit<Vector3<f64>>,
    tool: Unit<Vector3<f64>>,
    last: [f64; 2],
) -> Solutions {
    let (u1, u2) = (first.direction, second.direction);
    let skew = u1.dot(&u2);
    let denominator = skew * skew - 1.0;
    if denominator.abs() < SAME {
        return Solutions::default();
    }
    let axis = onto_the_pole(u1, axis);
    let (on1, on2) = (u1.dot(&axis), u2.dot(&tool));
    let alpha = (skew * on2 - on1) / denominator;
    let beta = (skew * on1 - on2) / denominator;
    let cross = u1.cross(&u2);
    let rest = 1.0 - alpha * alpha - beta * beta - 2.0 * alpha * beta * skew;
    if rest < -SAME {
        return Solutions::default();
    }
    let gamma = (rest.max(0.0) / cross.norm_squared()).sqrt();
    let signs: &[f64] = if gamma < SAME { &[0.0] } else { &[1.0, -1.0] };
    Solutions::of(signs.iter().filter_map(|sign| {
        let between = u1.scale(alpha) + u2.scale(beta) + cross.scale(sign * gamma);
        let r1 = turn(u1, between, axis.into_inner(), last[0])?;
        let r2 = turn(u2, tool.into_inner(), between, last[1])?;
        Some([r1, r2])
    }))
}

/// A direction; the pole where it all but lies along the first axis. That axis stays there, so
/// the second one must not lean the tool to where the first would have had to turn it.
fn onto_the_pole(first: Unit<Vector3<f64>>, axis: Unit<Vector3<f64>>) -> Unit<Vector3<f64>> {
    let along = first.dot(&axis);
    let across = axis.into_inner() - first.scale(along);
    if across.norm_squared() >= SAME * SAME {
        return axis;
    }
    if along < 0.0 { -first } else { first }
}

/// The rotary axis of these settings; `listed` is the one it is where they do not say it.
fn rotary(
    commons: &Commons,
    at: &RotaryLocations,
    listed: Option<RotaryAxis>,
) -> Result<Option<Rotary>> {
    let carries = match commons.read(at.kind) {
        RotaryKind::Table => Carries::Table,
        RotaryKind::Head => Carries::Head,
        RotaryKind::None => return Ok(None),
    };
    let axis = match commons.read(at.axis).or(listed) {
        Some(RotaryAxis::C) => 2,
        Some(RotaryAxis::B) => 1,
        Some(RotaryAxis::A) | None => 0,
    };
    let mut home = [0.0; 3];
    home[axis] = 1.0;
    let coordinate = |location: Dbl| commons.dbl_opt(location).unwrap_or(0.0);
    let of_letter = loc::ROTARY_LIMITS[axis];
    let limit = |own: Dbl, of_letter: Dbl| {
        let checked = commons.read(loc::LIMITS_CHECK)
            && commons.read(loc::TRAVEL_KINDS[axis]) == TravelKind::StraightRange;
        commons.dbl_opt(own).or_else(|| commons.dbl_opt(of_letter).filter(|_| checked))
    };
    Ok(Some(Rotary {
        carries,
        direction: direction(commons, at.direction, "rotary axis", home)?,
        center: Point3::from(at.center.map(coordinate)),
        letter: commons.read(at.letter).unwrap_or(ROTARY_LETTERS[axis]),
        axis,
        min: limit(at.range[0], of_letter.0),
        max: limit(at.range[1], of_letter.1),
        zones: Zones::from_commons(commons, axis),
    }))
}

fn direction(
    commons: &Commons,
    at: [Dbl; 3],
    name: &str,
    default: [f64; 3],
) -> Result<Unit<Vector3<f64>>, Box<Diag>> {
    let given = at.map(|location| commons.dbl_opt(location));
    let vector = if given.iter().all(Option::is_none) {
        Vector3::from(default)
    } else {
        Vector3::from(given.map(|part| part.unwrap_or(0.0)))
    };
    Unit::try_new(vector, 1e-9).ok_or_else(|| {
        MachineCode::SettingValue.diag(format!("the direction of {name} has length zero"))
    })
}

/// True for a vector too short to have a direction.
fn is_none(axis: Vector3<f64>) -> bool {
    axis.norm() <= 1e-9
}

#[cold]
fn unreachable(axis: Vector3<f64>) -> Box<Diag> {
    let axis = axis.normalize();
    MachineCode::ToolAxis.diag(format!("tool axis {:.6}, {:.6}, {:.6}", axis.x, axis.y, axis.z))
}

#[cold]
fn outside(solutions: &[[f64; 2]]) -> Box<Diag> {
    let angles: Vec<String> =
        solutions.iter().map(|at| format!("{:.3}/{:.3}", at[0], at[1])).collect();
    MachineCode::AxisLimit
        .diag(format!("rotary positions {} lie outside the limits", angles.join(" and ")))
}

mod directions;
mod rotary_axis;
#[cfg(test)]
mod tests;
