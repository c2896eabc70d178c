//! The order of the parts of a rapid. A lathe makes a rapid of the CL file in one block: a corner
//! lies where neither end does, in the wall of a bore or in the part. Of a live tool the tool is up
//! while it goes across, along Z or along X as it lies. Z comes down behind a tool change where the
//! rotary axes have turned.

use nalgebra::{Point3, Vector2};

use super::ahead::Steps;
use super::between::way::Way;
use super::report::FindingKind;
use super::say::short;
use super::verifier::{Fact, STILL, Verifier};
use crate::forward::Pose;
use crate::motion::{Move, Position};

/// Ways shorter than this hit nothing: more than positions differ by that are rounded as X and
/// C, or as lengths in the plane of both, mm.
const SMALL: f64 = 0.01;

/// A turn of less than this is none, degrees: what the rounding of a tool axis makes.
const SMALL_TURN: f64 = 0.01;

/// A tool whose axis has more than this along Z is an axial one.
const AXIAL: f64 = 0.5;

impl<C: Steps> Verifier<'_, C> {
    /// Looks at a part of a rapid that ends elsewhere than the rapid does, on a lathe. Where it is not
    /// known where the part begins, a point of the machine has brought the tool away.
    pub(super) fn check_order_on_lathe(&mut self, cl_line: u32, part: &Move, end: (&Move, &Pose)) {
        let is_lathe = self.settings.is_mill_turn() || self.settings.dialect.counts_diameters();
        let known = self.is_known(&self.known) && self.is_known(&part.known);
        if !is_lathe || !known {
            return;
        }
        let wrong = match self.settings.is_mill_turn() && self.expected.mills() {
            true => self.wrong_order_of_live_tool(&part.to, &end.0.to, end.1),
            false => self.wrong_order_of_turning(&part.to, &end.0.to),
        };
        if let Some(message) = wrong {
            self.find(FindingKind::Order, Some(cl_line), Some(part.line), message.to_string());
        }
    }

    /// On a mill-turn machine with Y: while C turns, X and Y may not come nearer to the axis of the
    /// spindle than where the rapid begins and ends, as the line of the CL file turns with the part.
    pub(super) fn check_way_past_axis(&mut self, cl_line: u32, part: &Move, ends: [&Position; 2]) {
        let turns = (part.to.rotary[0] - self.at.rotary[0]).abs() > SMALL_TURN;
        let known = self.is_known(&self.known) && self.is_known(&part.known);
        if !(self.has_axis_y() && turns && known) {
            return;
        }
        let [from, to] = [&self.at, &part.to].map(|at| self.off_spindle(at));
        let way = Way::line(from.push(0.0).into(), to.push(0.0).into());
        let nearest = way.foot(Point3::origin(), 0.0).distance;
        let least = ends.map(|at| self.off_spindle(at).norm()).into_iter().fold(f64::MAX, f64::min);
        // From beyond the axis, where a tool along Z has worked, the level is its way up.
        let stays_up = from.x <= 0.0 && part.to.linear[2] == self.at.linear[2];
        if nearest < least - SMALL && !stays_up {
            let message = format!(
                "rapid turns C and passes {} from the axis of the spindle, nearer than both its ends",
                short(nearest)
            );
            self.find(FindingKind::Order, Some(cl_line), Some(part.line), message);
        }
    }

    /// A part of a rapid along X alone, out to where C may turn past both ends.
    pub(super) fn goes_out_along_x(&self, part: &Move, end: &Position) -> bool {
        let stays = (1..3).all(|n| part.to.linear[n] == self.at.linear[n])
            && part.to.rotary == self.at.rotary;
        let [from, to] = [&self.at, end].map(|at| self.off_spindle(at).norm());
        let out = self.off_spindle(&part.to).x;
        self.has_axis_y()
            && self.is_known(&self.known)
            && stays
            && out > self.off_spindle(&self.at).x
            && (out - from.max(to)).abs() <= 2.0 * self.slack.linear[0] + STILL
    }

    /// A mill-turn machine whose Y is an axis of its own.
    fn has_axis_y(&self) -> bool {
        self.settings.is_mill_turn() && self.limits.written[1] && !self.at.transformed
    }

    /// How X and Y stand from the axis of the spindle, mm.
    fn off_spindle(&self, at: &Position) -> Vector2<f64> {
        let spindle = self.settings.forward.rotaries()[0].as_ref();
        let center = spindle.map_or_else(Vector2::zeros, |spindle| spindle.center.coords.xy());
        Vector2::new(at.linear[0], at.linear[1]) - center
    }

    /// X and Z go one after the other.
    fn wrong_order_of_turning(&self, part: &Position, end: &Position) -> Option<&'static str> {
        let way = |n: usize, to: &Position| (to.linear[n] - self.at.linear[n]).abs();
        let goes_alone = |n: usize, other: usize| {
            way(n, part) > SMALL && way(other, part) <= STILL && way(other, end) > SMALL
        };
        let corner = "rapid goes along X and Z in two blocks, the CL file has one line: the corner \
                      may lie in the part";
        let is_corner = goes_alone(0, 2) || goes_alone(2, 0);
        (is_corner && !self.limits.splits_rapids).then_some(corner)
    }

    /// A live tool goes across at depth, or down beside its place.
    fn wrong_order_of_live_tool(
        &self,
        part: &Position,
        end: &Position,
        pose: &Pose,
    ) -> Option<&'static str> {
        let is_axial = pose.axis.z.abs() > AXIAL;
        let tip = |at: &Position| self.settings.forward.pose(at).tip;
        let [at, part, end] = [tip(&self.at), tip(part), tip(end)];
        let height = |tip: Point3<f64>| if is_axial { tip.z } else { libm::hypot(tip.x, tip.y) };
        // How far two places lie apart across the tool, at the lower of both heights.
        let across = |a: Point3<f64>, b: Point3<f64>| {
            if is_axial {
                return libm::hypot(a.x - b.x, a.y - b.y);
            }
            let turned = libm::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
            libm::hypot(a.z - b.z, turned * height(a).min(height(b)))
        };
        let rises = height(end) > height(at) + SMALL;
        let lifts = height(part) > height(at) + STILL;
        match () {
            () if across(at, part) > SMALL && rises && !lifts => Some(match is_axial {
                true => "rapid goes across before Z has gone up",
                false => "rapid goes across before X has gone up",
            }),
            () if height(part) < height(at) - SMALL && across(part, end) > SMALL => {
                Some(match is_axial {
                    true => "rapid plunges before X and C have arrived",
                    false => "rapid plunges before Z and C have arrived",
                })
            }
            () => None,
        }
    }

    /// From the place of a tool change, or from where nobody knows, Z comes down while a rotary axis
    /// has yet to turn to where the height is meant.
    pub(super) fn comes_down_before_it_turns(&self, part: &Move, end: [f64; 2]) -> bool {
        let comes_down = self.facts.has(Fact::FreshHeight)
            || !(self.known[2] || self.facts.has(Fact::HadHeight));
        let rotaries = self.settings.forward.rotaries();
        let is_to_turn = |n: usize| {
            let is_there = (part.to.rotary[n] - end[n]).abs() <= SMALL_TURN;
            rotaries[n].is_some() && !(part.known[n + 3] && is_there)
        };
        comes_down && !part.to.names_tip() && (0..2).any(is_to_turn)
    }
}
