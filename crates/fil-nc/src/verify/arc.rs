//! Arcs of the path against arcs, or short lines, of the program.

use std::f64::consts::SQRT_2;

use nalgebra::{Point3, Vector3};

use super::ahead::Steps;
use super::between::Asked;
use super::expected_step::{Arc, ExpectedStep, Step};
use super::report::FindingKind;
use super::say::{PLANES, short};
use super::settings::Quantity;
use super::verifier::Verifier;
use crate::forward::Pose;
use crate::motion::{self, Course, Move, Position, Rate};

/// Directions nearer than this are the same.
const PARALLEL: f64 = 1e-4;

/// An arc that leans by more than this, as the length between directions, is none of the plane.
const MOST_LEAN: f64 = 2e-3;

/// Most blocks of one arc.
const MOST_BLOCKS: usize = 100_000;

/// The blocks that make an arc.
struct Parts {
    /// Where each ends on the arc, degrees from the start.
    angles: Vec<f64>,
    /// All of them are straight lines.
    lines: bool,
}

impl<C: Steps> Verifier<'_, C> {
    /// Takes the blocks that make an arc; false when they don't.
    pub(super) fn arc(&mut self, cl_line: u32, arc: &Arc, rate: Option<Rate>) -> bool {
        let Some(parts) = self.arc_parts(arc) else {
            if self.is_a_few_digits(arc) {
                return self.line(cl_line, &arc.end, Course::Feed, rate);
            }
            return self.stands_for(arc);
        };
        let from = self.begins();
        let mut before = 0.0;
        let mut last = None;
        let count = parts.angles.len() as f64;
        for (n, angle) in (1..).zip(parts.angles) {
            let Some(found) = self.next_move() else { break };
            self.check_rate(cl_line, self.at, &found, rate);
            self.look_between(cl_line, &found, |_| Asked::arc(arc, from, [before, angle]));
            let share = if parts.lines { f64::from(n) / count } else { angle / arc.sweep };
            self.check_turn_on_arc(cl_line, &found, [from.axis, arc.end.axis], share);
            before = angle;
            self.take(cl_line, &found);
            self.next += 1;
            last = Some(found);
        }
        if let Some(last) = last {
            self.measure(&last, &arc.end);
        }
        true
    }

    /// True for a whole circle no wider than the chord tolerance, which no line is left of.
    fn stands_for(&mut self, arc: &Arc) -> bool {
        2.0 * arc.radius() <= self.chord_slack() && self.stands_at(&arc.end)
    }

    /// An arc so short that rounding turns it: it is a line of a last digit, or nothing; a helix of
    /// which nothing but its rise is left goes straight along its axis.
    fn is_a_few_digits(&self, arc: &Arc) -> bool {
        let slack = self.slack.linear.iter().fold(0.0f64, |a, b| a.max(*b));
        arc.sweep <= 180.0 && arc.sweep.to_radians() * arc.radius() <= 4.0 * slack
    }

    /// The motions from here to the end of the arc, when they lie on it.
    fn arc_parts(&self, arc: &Arc) -> Option<Parts> {
        let mut parts = Parts { angles: Vec::new(), lines: true };
        let mut angle = 0.0;
        let mut from = self.at;
        while parts.angles.len() < MOST_BLOCKS {
            let event = self.nc.get(self.next + parts.angles.len())?;
            let motion::Event::Move(found) = event else { return None };
            if found.course != Course::Feed || found.in_cycle {
                return None;
            }
            let swept = match &found.arc {
                Some(part) => self.on_arc(arc, angle, (&from, &found), part)?,
                None => self.on_chord(arc, angle, &found)?,
            };
            angle += swept;
            let slack = self.sweep_slack(arc);
            let ends = (angle - arc.sweep).abs() <= slack && self.reaches(&found, &arc.end);
            if !ends && (angle > arc.sweep + slack || !self.is_on(arc, angle, &found)) {
                return None;
            }
            if !ends && found.arc.is_some() {
                // The rounding of one block is none of the next one.
                angle += self.off_angle(arc, angle, &found);
            }
            parts.angles.push(angle);
            parts.lines &= found.arc.is_none();
            if ends {
                let is_right = self.steps_are_even(arc, &parts) && self.chords_end_on(arc, &parts);
                return is_right.then_some(parts);
            }
            from = found.to;
        }
        None
    }

    /// The angle an arc block sweeps, when its center, plane and sense are right.
    fn on_arc(
        &self,
        arc: &Arc,
        before: f64,
        (from, found): (&Position, &Move),
        part: &motion::Arc,
    ) -> Option<f64> {
        let frame = self.settings.forward.frame_of(&self.exactly(arc, found));
        let mut normal = Vector3::zeros();
        normal[part.normal] = if part.ccw { 1.0 } else { -1.0 };
        // A small arc that leans leaves its plane by less than a last digit.
        let lean = (frame.turn * normal - arc.normal).norm();
        let leaves = lean * arc.radius() > 2.0 * self.slack.linear[part.normal];
        if lean > PARALLEL && (leaves || lean > MOST_LEAN) {
            return None;
        }
        if self.settings.writes_radius() {
            return self.on_arc_of_radius(arc, before, (from, found), part);
        }
        let center = frame.linear(arc.center);
        let off = |n: usize| (part.center[n] - center[n]).abs();
        let in_plane = |n: &usize| *n != part.normal;
        let is_right = (0..3).filter(in_plane).all(|n| off(n) <= self.center_slack(n))
            || self.settings.turns_by_angles() && self.follows(arc, from, found, part);
        is_right.then_some(part.angle)
    }

    /// The same for an arc that is written with its radius. Where its center lies follows from
    /// rounded ends and the rounded radius, so the ends say how far it sweeps; the center may be
    /// off by what these roundings explain, and half a turn must not lie between both.
    fn on_arc_of_radius(
        &self,
        arc: &Arc,
        before: f64,
        (from, found): (&Position, &Move),
        part: &motion::Arc,
    ) -> Option<f64> {
        let given = distance(part.center, from.linear, part.normal);
        if (given - arc.radius()).abs() > self.slack.of(Quantity::Radius) {
            return None;
        }
        let swept = self.angle_behind(arc, before, found) - before;
        let at_half = (swept - 180.0).abs() <= self.angle_slack(arc);
        if (swept > 180.0) != (part.angle > 180.0) && !at_half {
            return None;
        }
        let slack = self.slack.linear.iter().fold(0.0f64, |a, b| a.max(*b));
        let chord = distance(from.linear, found.to.linear, part.normal);
        let height = (given * given - chord * chord / 4.0).max(0.0).sqrt();
        let rounded = given * self.slack.of(Quantity::Radius) + chord * slack;
        let along = (rounded / height).min((2.0 * rounded).sqrt());
        // The ends of a short chord turn it as they are rounded in both axes, and the center
        // with it.
        let turned = given * (2.0 * SQRT_2 * slack / chord).min(2.0);
        let center = self.settings.forward.frame_of(&self.exactly(arc, found)).linear(arc.center);
        let off = distance(part.center, center, part.normal);
        (off <= along + turned + 2.0 * slack).then_some(swept)
    }

    /// The angle from the start of an arc at which a motion ends, behind another angle.
    fn angle_behind(&self, arc: &Arc, before: f64, found: &Move) -> f64 {
        let turns = (before / 360.0).floor() * 360.0;
        let angle = turns + arc.angle_of(self.tip(arc, found));
        if angle <= before { angle + 360.0 } else { angle }
    }

    /// True for a helix about a pole that lies elsewhere than the center, so that the angle
    /// ends where it should: its points lie on the arc all the same.
    fn follows(&self, arc: &Arc, from: &Position, found: &Move, part: &motion::Arc) -> bool {
        let rises = found.to.linear[part.normal] != from.linear[part.normal];
        let slack = 2.0 * self.slack.linear.iter().fold(0.0f64, |a, b| a.max(*b));
        let [first, second] = [(part.normal + 1) % 3, (part.normal + 2) % 3];
        let arm = [first, second].map(|axis| from.linear[axis] - part.center[axis]);
        rises
            && [0.25, 0.5, 0.75].into_iter().all(|share| {
                let angle = if part.ccw { part.angle } else { -part.angle } * share;
                let (sine, cosine) = libm::sincos(angle.to_radians());
                let mut to = found.to;
                to.linear[first] = part.center[first] + arm[0] * cosine - arm[1] * sine;
                to.linear[second] = part.center[second] + arm[0] * sine + arm[1] * cosine;
                let pose = self.settings.forward.pose(&to);
                (arc.spoke(pose.tip).norm() - arc.radius()).abs() <= slack
            })
    }

    /// The center is written from the start as it is rounded on the tape: as exact as an end of
    /// the arc is exact enough, even where the machine writes centers finer. When the machine
    /// turns besides, the arc lies as its rounded angles have it.
    fn center_slack(&self, n: usize) -> f64 {
        let turned = if self.settings.forward.has_rotary() { self.slack.linear[n] } else { 0.0 };
        self.slack.center[n].max(self.slack.linear[n]) + turned
    }

    /// The angle a straight line sweeps, when it stays within the chord tolerance.
    fn on_chord(&self, arc: &Arc, before: f64, found: &Move) -> Option<f64> {
        let swept = self.angle_behind(arc, before, found) - before;
        let sagitta = arc.radius() * (1.0 - libm::cos((swept / 2.0).to_radians()));
        (sagitta <= self.chord_slack()).then_some(swept)
    }

    /// How far a line may leave its arc, mm.
    fn chord_slack(&self) -> f64 {
        self.settings.chord_tolerance() + 2.0 * self.slack.linear[0]
    }

    /// The end of a part lies on the arc, at the height of its share.
    fn is_on(&self, arc: &Arc, angle: f64, found: &Move) -> bool {
        let tip = self.tip(arc, found);
        let slack = 2.0 * self.digits_on(arc, found);
        let share = angle / arc.sweep;
        let rise = arc.rise_of(arc.end.tip) * share;
        // A last digit along the arc is more of them along the axis of a steep helix.
        let slope = arc.rise_of(arc.end.tip).abs() / (arc.sweep.to_radians() * arc.radius());
        let along = self.off_angle(arc, angle, found).abs().to_radians() * arc.radius();
        (arc.spoke(tip).norm() - arc.radius()).abs() <= slack
            && (arc.rise_of(tip) - rise).abs() <= slack * (1.0 + slope)
            && along <= slack
    }

    /// How far a block ends behind an angle of the arc, degrees; negative before it.
    fn off_angle(&self, arc: &Arc, angle: f64, found: &Move) -> f64 {
        let behind = (arc.angle_of(self.tip(arc, found)) - angle).rem_euclid(360.0);
        if behind > 180.0 { behind - 360.0 } else { behind }
    }

    /// Short lines divide an arc into even parts.
    fn steps_are_even(&self, arc: &Arc, parts: &Parts) -> bool {
        let angles = &parts.angles;
        let slack = 2.0 * self.angle_slack(arc);
        let share = arc.sweep / angles.len() as f64;
        let is_even = |(n, angle): (i32, &f64)| (angle - share * f64::from(n)).abs() <= slack;
        !parts.lines || angles.len() == 1 || (1..).zip(angles).all(is_even)
    }

    /// Each of the short lines that divide an arc ends where its share of the arc does. A
    /// machine that turns its axes has its own rounding there.
    fn chords_end_on(&self, arc: &Arc, parts: &Parts) -> bool {
        let count = parts.angles.len();
        if !parts.lines || self.slack.kept > 0.0 || self.settings.forward.has_rotary() {
            return true;
        }
        (1..count).all(|n| match self.nc.get(self.next + n - 1) {
            Some(motion::Event::Move(found)) => {
                let tip = arc.at(n as f64 / count as f64);
                let gap = self.gap(&found.to, &Pose { tip, ..arc.end });
                let near = |n: usize| !gap.excess[n] || self.stays_beside(n, &found, gap.linear[n]);
                gap.turned.is_none() && (0..3).all(near)
            }
            _ => false,
        })
    }

    /// An axis that a block before has left beside its last digits, as the end of a helix in polar
    /// coordinates, stays there while its number is the same.
    fn stays_beside(&self, n: usize, found: &Move, off: f64) -> bool {
        let digit = 2.0 * self.slack.linear[n];
        let stands = self.at.linear[n];
        let beside = (stands - (stands / digit).round() * digit).abs();
        found.to.linear[n] == stands && off.abs() <= self.slack.linear[n] + beside
    }

    /// How far the last digits can bring a tip from an arc, mm; where the tool turns, those of
    /// the rotary axes do it too.
    fn digits_on(&self, arc: &Arc, found: &Move) -> f64 {
        let linear = self.slack.linear.iter().fold(0.0f64, |a, b| a.max(*b));
        let turned = self.settings.forward.pose(&found.to).axis.angle(&arc.end.axis);
        if turned <= self.axis_slack() {
            return linear;
        }
        let lever = self.tip_slack(&found.to) - Vector3::from(self.slack.linear).norm();
        linear + lever
    }

    /// Angle that the last digits stand for on this arc, degrees: each end and the center may be
    /// off by half a digit in both axes of the plane, and the center turns both ends.
    fn angle_slack(&self, arc: &Arc) -> f64 {
        let slack = self.slack.linear.iter().fold(0.0f64, |a, b| a.max(*b));
        (4.0 * SQRT_2 * slack / arc.radius().max(slack)).to_degrees()
    }

    /// What the last digits do to the angle that an arc sweeps about its center, degrees: each end
    /// turns its spoke, and the center both, against each other the more the nearer to half a
    /// turn the arc is.
    fn sweep_slack(&self, arc: &Arc) -> f64 {
        let largest = |of: &dyn Fn(usize) -> f64| (0..3).map(of).fold(0.0f64, f64::max);
        let end = SQRT_2 * largest(&|n| self.slack.linear[n]);
        let center = SQRT_2 * largest(&|n| self.center_slack(n));
        let turned = 2.0 * end + 2.0 * center * libm::sin((arc.sweep / 2.0).to_radians()).abs();
        let of_digits = turned / arc.radius().max(turned);
        of_digits.to_degrees().max(self.angle_slack(arc))
    }

    fn tip(&self, arc: &Arc, found: &Move) -> Point3<f64> {
        self.settings.forward.pose(&self.exactly(arc, found)).tip
    }

    /// Where a block ends, with the rotary axes where the tool lies exactly as on the arc, if
    /// their last digits let them stand there: at the end of a long lever these are more than
    /// those of X, Y and Z.
    fn exactly(&self, arc: &Arc, found: &Move) -> Position {
        // An axis that does not turn the tool stays at its exact position.
        let stays = |n: usize| (self.exact[n] - found.to.rotary[n]).abs() <= self.slack.rotary[n];
        let kept = [0, 1].map(|n| if stays(n) { self.exact[n] } else { found.to.rotary[n] });
        let rotary = self.settings.forward.refine(kept, arc.end.axis);
        let is_near = |n: usize| (rotary[n] - found.to.rotary[n]).abs() <= self.slack.rotary[n];
        if is_near(0) && is_near(1) { Position { rotary, ..found.to } } else { found.to }
    }

    /// Says how an arc block differs from the arc it stands for.
    pub(super) fn say_arc(&mut self, step: &Step, found: &Move) {
        let (ExpectedStep::Arc(arc, _), Some(part)) = (&step.what, &found.arc) else { return };
        let frame = self.settings.forward.frame_of(&found.to);
        let wanted = frame.turn.transpose() * arc.normal;
        let along = wanted[part.normal].abs() > 1.0 - PARALLEL;
        let message = if !along {
            let plane = PLANES[part.normal];
            format!("the arc lies in the {plane} plane, the CL file has it in another")
        } else if (wanted[part.normal] > 0.0) != part.ccw {
            let (is, should) = if part.ccw {
                ("counterclockwise (G3)", "clockwise (G2)")
            } else {
                ("clockwise (G2)", "counterclockwise (G3)")
            };
            format!("the arc is {is}, it should be {should}")
        } else {
            let center = frame.linear(arc.center);
            let off: Vec<String> = (0..3)
                .filter(|n| *n != part.normal)
                .map(|n| (n, part.center[n] - center[n]))
                .filter(|(n, off)| off.abs() > self.center_slack(*n))
                .map(|(n, off)| format!("{} by {}", ["X", "Y", "Z"][n], short(off)))
                .collect();
            if off.is_empty() {
                let (is, should) = (short(part.angle), short(arc.sweep));
                format!("the arc sweeps {is} degrees, it should be {should}")
            } else {
                format!("the center of the arc is off in {}", off.join(" and "))
            }
        };
        self.find(FindingKind::Arc, Some(step.line), Some(found.line), message);
    }
}

/// Distance of two points in the plane of a normal.
fn distance(a: [f64; 3], b: [f64; 3], normal: usize) -> f64 {
    let ways = (0..3).filter(|n| *n != normal).map(|n| a[n] - b[n]);
    ways.map(|way| way * way).sum::<f64>().sqrt()
}
