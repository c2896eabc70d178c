//! An arc of the CL program against the arcs and lines that the machine makes.
//! How it is divided is free; the way it goes, its sense and its angle are not.

use std::f64::consts::{PI, TAU};

use crate::path::Point;

use super::compare::{Comparer, Difference, spell};
use super::expected::Arc;
use super::geometry::{axes, distance};
use super::machine::{NcAct, NcStep};

/// How far an arc has come.
pub(super) struct Sweep<'e> {
    arc: &'e Arc,
    radius: f64,
    /// Angle made so far, radians.
    done: f64,
}

/// Points of a step that are looked at.
const SAMPLES: u32 = 24;

impl<'e> Sweep<'e> {
    pub(super) fn new(arc: &'e Arc) -> Self {
        let [first, second, _] = axes(arc.normal);
        let radius =
            (arc.from[first] - arc.center[first]).hypot(arc.from[second] - arc.center[second]);
        Sweep { arc, radius, done: 0.0 }
    }

    /// The next step of the machine that is a part of the arc; `None` at its end.
    pub(super) fn next<'a>(
        &mut self,
        machine: &Comparer<'a>,
    ) -> Result<Option<&'a NcStep>, Difference> {
        if self.is_small(machine) {
            return self.next_of_small(machine);
        }
        let noise = self.noise(machine);
        if self.done >= self.arc.total - noise && self.done > 0.0 {
            return Ok(machine.peek().filter(|found| self.is_remainder(found, machine)));
        }
        let there = machine.near(machine.at, self.arc.to);
        let short = self.arc.total <= 2.0 * noise;
        let Some(found) = machine.peek() else {
            return if short && there { Ok(None) } else { self.missing(machine, None) };
        };
        let turned = match self.turned_by(found, machine) {
            Ok(turned) => turned,
            // The whole arc is less than a digit, and the step is the next one's.
            Err(_) if short && there => return Ok(None),
            Err(difference) => return Err(difference),
        };
        if short && there && !self.ends_at_end(found, machine) {
            return Ok(None);
        }
        self.done += turned;
        if self.done > self.arc.total + noise {
            let (done, total) = (self.done.to_degrees(), self.arc.total.to_degrees());
            return machine.fail("arc angle", format!("the arc turns {done:.4}, not {total:.4}"));
        }
        Ok(Some(found))
    }

    /// The angle that a step of the machine makes.
    fn turned_by(&self, found: &NcStep, machine: &Comparer<'_>) -> Result<f64, Difference> {
        match &found.act {
            NcAct::Feed(to) => self.line(*to, machine),
            NcAct::Arc { to, center, normal, ccw, turns } => {
                if *normal != self.arc.normal || *ccw != self.arc.ccw {
                    let what = format!("arc about {normal:?}, counterclockwise {ccw}");
                    return machine.fail("arc sense", what);
                }
                self.part(*to, *center, *turns, machine)
            }
            other => self.missing(machine, Some(other)),
        }
    }

    fn missing<T>(&self, machine: &Comparer<'_>, found: Option<&NcAct>) -> Result<T, Difference> {
        let (done, total) = (self.done.to_degrees(), self.arc.total.to_degrees());
        let what = format!("{found:?} after {done:.4} of {total:.4} degrees of an arc");
        machine.fail("arc", what)
    }

    /// The angle that rounding may hide.
    fn noise(&self, machine: &Comparer<'_>) -> f64 {
        1e-6 + 3.0 * machine.tolerance.end / self.radius
    }

    fn ends_at_end(&self, found: &NcStep, machine: &Comparer<'_>) -> bool {
        found.act.end().is_some_and(|end| machine.near(end, self.arc.to))
            && !matches!(found.act, NcAct::Rapid(_))
    }

    /// The last part of a divided arc, of a digit or less.
    fn is_remainder(&self, found: &NcStep, machine: &Comparer<'_>) -> bool {
        let NcAct::Arc { to, center, normal, ccw, turns: 0 } = &found.act else { return false };
        let start = self.angle(machine.at, *center);
        let own = self.forward(self.angle(*to, *center) - start);
        let short = own > 0.0 && own < 2.0 * self.noise(machine);
        *normal == self.arc.normal
            && *ccw == self.arc.ccw
            && short
            && self.ends_at_end(found, machine)
            && distance(self.flat(*center), self.flat(self.arc.center))
                < 10.0 * machine.tolerance.curve
    }

    /// A point without its coordinate along the normal.
    fn flat(&self, mut point: Point) -> Point {
        let [.., along] = axes(self.arc.normal);
        point[along] = 0.0;
        point
    }

    /// The arc is so short or small that a step may be of the next one.
    pub(super) fn is_doubtful(&self, machine: &Comparer<'_>) -> bool {
        let short = self.arc.total <= 2.0 * self.noise(machine);
        machine.near(machine.at, self.arc.to) && (short || self.is_small(machine))
    }

    /// The whole circle is a few digits, or less than a chord may be off: only that
    /// the tool stays there is asked.
    fn is_small(&self, machine: &Comparer<'_>) -> bool {
        self.radius < (6.0 * machine.tolerance.end).max(machine.tolerance.chord / 2.0)
    }

    fn next_of_small<'a>(
        &mut self,
        machine: &Comparer<'a>,
    ) -> Result<Option<&'a NcStep>, Difference> {
        let there = machine.near(machine.at, self.arc.to);
        if there && self.done > 0.0 && self.done >= self.arc.total - PI / 2.0 {
            return Ok(None);
        }
        match machine.peek() {
            Some(NcStep { act: NcAct::Feed(to), .. })
                if there
                    && (self.done > 0.0
                        || self.arc.total < PI && !machine.near(*to, self.arc.to)) =>
            {
                Ok(None)
            }
            Some(found) if self.is_inside(found, machine) && self.done < self.arc.total + PI => {
                // Its ends are rounded so much that they tell no angle.
                self.done += PI / 2.0;
                Ok(Some(found))
            }
            _ if there => Ok(None),
            found => self.missing(machine, found.map(|step| &step.act)),
        }
    }

    /// A feed step that leaves the small circle by a few digits at most.
    fn is_inside(&self, found: &NcStep, machine: &Comparer<'_>) -> bool {
        let limit = self.radius + machine.tolerance.curve.max(machine.tolerance.chord);
        let near = |point: Point| {
            let [first, second, along] = axes(self.arc.normal);
            let off = (point[first] - self.arc.center[first])
                .hypot(point[second] - self.arc.center[second]);
            let (low, high) = (
                self.arc.from[along].min(self.arc.to[along]),
                self.arc.from[along].max(self.arc.to[along]),
            );
            let end = machine.tolerance.end;
            off <= limit && point[along] >= low - end && point[along] <= high + end
        };
        match &found.act {
            NcAct::Feed(to) => near(*to),
            NcAct::Arc { to, center, normal, ccw, .. }
                if *normal == self.arc.normal && *ccw == self.arc.ccw =>
            {
                let [first, second, _] = axes(self.arc.normal);
                let radius = (to[first] - center[first]).hypot(to[second] - center[second]);
                near(*to) && radius <= limit
            }
            _ => false,
        }
    }

    /// Angle of a point about a center, in the arc's plane.
    fn angle(&self, point: Point, center: Point) -> f64 {
        let [first, second, _] = axes(self.arc.normal);
        (point[second] - center[second]).atan2(point[first] - center[first])
    }

    /// A change of angle in the sense of the arc, from 0 to a full turn.
    fn forward(&self, change: f64) -> f64 {
        let change = if self.arc.ccw { change } else { -change };
        change.rem_euclid(TAU)
    }

    /// How far from where the arc has come to a point lies, in its sense; a point
    /// that lies back by no more than rounding counts as that, negative.
    fn turned_to(&self, point: Point, machine: &Comparer<'_>) -> f64 {
        let start = self.angle(self.arc.from, self.arc.center);
        let here = self.forward(self.angle(point, self.arc.center) - start);
        let way = (here - self.done).rem_euclid(TAU);
        if way > TAU - 2.0 * self.noise(machine) { way - TAU } else { way }
    }

    /// A straight part: its ends on the arc, no further from it than chords may be.
    fn line(&self, to: Point, machine: &Comparer<'_>) -> Result<f64, Difference> {
        let turned = self.turned_to(to, machine);
        let sagitta = self.radius * (1.0 - (turned.abs() / 2.0).cos());
        self.lies_on(to, self.done + turned, machine.tolerance.curve, machine)?;
        if sagitta > machine.tolerance.chord {
            let what = format!("a line to {} is {sagitta:.4} from its arc", spell(to));
            return machine.fail("arc way", what);
        }
        Ok(turned)
    }

    /// A part that is an arc: every point of it lies on the expected one.
    fn part(
        &self,
        to: Point,
        center: Point,
        turns: u32,
        machine: &Comparer<'_>,
    ) -> Result<f64, Difference> {
        let [first, second, along] = axes(self.arc.normal);
        let from = machine.at;
        let start = self.angle(from, center);
        let mut angle = self.forward(self.angle(to, center) - start);
        if angle < 1e-9 {
            angle = TAU;
        }
        let own = angle + TAU * f64::from(turns);
        let radius =
            |point: Point| (point[first] - center[first]).hypot(point[second] - center[second]);
        let (at_start, at_end) = (radius(from), radius(to));
        // The angle made about the expected center; about the program's own it
        // may differ by what rounding does to a short arc.
        let mut turned = self.turned_to(to, machine) + TAU * f64::from(turns);
        if (turned - own).abs() > PI {
            turned += TAU * ((own - turned) / TAU).round();
        }
        for sample in 0..=SAMPLES {
            let share = f64::from(sample) / f64::from(SAMPLES);
            let way = if self.arc.ccw { own * share } else { -own * share };
            let (sine, cosine) = (start + way).sin_cos();
            let length = at_start + (at_end - at_start) * share;
            let mut point = [0.0; 3];
            point[first] = center[first] + length * cosine;
            point[second] = center[second] + length * sine;
            point[along] = from[along] + (to[along] - from[along]) * share;
            let done = self.done + turned * share;
            self.lies_on(point, done, machine.tolerance.curve, machine)?;
        }
        Ok(turned)
    }

    /// A point lies on the arc, at the height that belongs to an angle.
    fn lies_on(
        &self,
        point: Point,
        done: f64,
        limit: f64,
        machine: &Comparer<'_>,
    ) -> Result<(), Difference> {
        let [first, second, along] = axes(self.arc.normal);
        let off = (point[first] - self.arc.center[first])
            .hypot(point[second] - self.arc.center[second])
            - self.radius;
        let rise = self.arc.to[along] - self.arc.from[along];
        let height = self.arc.from[along] + rise * (done / self.arc.total).clamp(0.0, 1.0);
        let slack = 3.0 * rise.abs() * self.noise(machine) / self.arc.total;
        let high = (point[along] - height).abs();
        if off.abs() > limit || high > limit + slack {
            let what = format!("{} is {off:.4} beside and {high:.4} over the arc", spell(point));
            return machine.fail("arc way", what);
        }
        Ok(())
    }
}
