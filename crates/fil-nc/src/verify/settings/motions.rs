//! What the settings of a machine make of lines, rapids, arcs and feeds.

use fil_machine::axis_chain::{Carries, Rotary};
use fil_machine::commons::Dbl;
use fil_machine::locations::{
    self as loc, CircleCorrection, FeedInverseLength, HomeFrame, HomeLatheOrder, LinearMethod,
    ProgramEndBlock, RotaryTipForm,
};
use nalgebra::Point3;

use super::Settings;

use crate::motion::{Move, Position, unit};
use crate::verify::expected_step::Arc;

impl Settings<'_> {
    /// A feed in mm/min within the machine's range.
    pub fn feed_within(&self, feed: f64, metric: bool) -> f64 {
        let unit = unit(metric);
        let min = self.commons.dbl_opt(loc::FEED_UPM_MIN).unwrap_or(0.0) * unit;
        let max = self.commons.dbl_opt(loc::FEED_UPM_MAX).map_or(f64::MAX, |max| max * unit);
        feed.max(min).min(max)
    }

    /// A feed in mm/min within what Y and Z may do in a motion; from `None`, where nobody knows
    /// the way, each of them may go alone.
    pub fn feed_within_axes(
        &self,
        feed: f64,
        from: Option<&Position>,
        found: &Move,
        metric: bool,
    ) -> f64 {
        let unit = unit(metric);
        let most = self.commons.dbl_opt(loc::FEED_UPM_MAX).unwrap_or(f64::INFINITY);
        let from = from.unwrap_or(&found.to);
        let way = |axis: usize| (found.to.linear[axis] - from.linear[axis]).abs();
        let length = match &found.arc {
            Some(arc) => arc.length(from.linear, found.to.linear),
            None => [0, 1, 2].map(way).iter().map(|way| way * way).sum::<f64>().sqrt(),
        };
        let within = |feed: f64, (axis, at): (usize, Dbl)| {
            let Some(largest) = self.commons.dbl_opt(at).filter(|largest| *largest < most) else {
                return feed;
            };
            let turns = found.arc.is_some_and(|arc| arc.normal != axis);
            let share = if turns || length <= 0.0 { 1.0 } else { (way(axis) / length).min(1.0) };
            if feed * share > largest * unit { largest * unit / share } else { feed }
        };
        // The second axis of polar and cylindrical interpolation is C.
        let of_c = found.to.transformed || self.is_mill_turn() && !self.written()[1];
        [(1, loc::FEED_UPM_MAX_Y), (2, loc::FEED_UPM_MAX_Z)]
            .into_iter()
            .filter(|(axis, _)| !(*axis == 1 && of_c))
            .fold(feed, within)
    }

    /// The feed a minute of a cycle, within that of Z, mm a minute.
    pub fn cycle_feed_within(&self, feed: f64, metric: bool) -> f64 {
        let of_z = self.limits_feed_of_axes()[1];
        let largest = self.commons.dbl_opt(loc::FEED_UPM_MAX_Z).filter(|_| of_z);
        largest.map_or(feed, |largest| feed.min(largest * unit(metric)))
    }

    /// Whether Y and Z may go slower than the machine.
    pub fn limits_feed_of_axes(&self) -> [bool; 2] {
        let most = self.commons.dbl_opt(loc::FEED_UPM_MAX).unwrap_or(f64::INFINITY);
        [loc::FEED_UPM_MAX_Y, loc::FEED_UPM_MAX_Z]
            .map(|at| self.commons.dbl_opt(at).is_some_and(|largest| largest < most))
    }

    /// Home, retract and change positions are coordinates of the machine.
    pub fn names_machine_positions(&self) -> bool {
        self.commons.read(loc::HOME_FRAME) != HomeFrame::OfThePart
    }

    /// X, Y, Z of the home position, mm.
    pub fn home(&self, metric: bool) -> [Option<f64>; 3] {
        loc::HOME.map(|at| self.commons.dbl_opt(at).map(|value| value * unit(metric)))
    }

    /// Z that RETRCT goes up to, mm.
    pub fn retract_level(&self, metric: bool) -> Option<f64> {
        self.commons.dbl_opt(loc::HOME_RETRACT_Z).map(|value| value * unit(metric))
    }

    /// The axes that go home before the end of the program, mm; `None` for each that stays.
    pub fn home_at_end(&self, metric: bool) -> [Option<f64>; 3] {
        let [x, y, z] = self.home(metric);
        match self.commons.read(loc::PROGRAM_END_BLOCK) {
            ProgramEndBlock::None => [None; 3],
            ProgramEndBlock::Z => [None, None, z],
            ProgramEndBlock::ZThenXAndY | ProgramEndBlock::ZThenXAndYThenRotaryAxes => [x, y, z],
        }
    }

    /// The rotary axes turn to 0 before the end of the program.
    pub fn turns_home_at_end(&self) -> bool {
        let block = self.commons.read(loc::PROGRAM_END_BLOCK);
        let reaches = |axis: &Rotary| axis.reaches(0.0);
        block == ProgramEndBlock::ZThenXAndYThenRotaryAxes
            && self.forward.rotaries().iter().flatten().all(reaches)
    }

    /// Rapid motions turn rotary axes at the level of RETRCT.
    pub fn turns_at_top(&self) -> bool {
        self.forward.has_rotary()
            && !self.is_mill_turn()
            && self.commons.read(loc::ROTARY_TURN_RETRACT)
            && self.commons.dbl_opt(loc::HOME_RETRACT_Z).is_some()
    }

    /// The axis of a lathe that goes home before the others; `None` where all go together.
    pub fn first_of_lathe_home(&self) -> Option<usize> {
        match self.commons.read(loc::HOME_LATHE_ORDER) {
            HomeLatheOrder::OneBlock => None,
            HomeLatheOrder::XThenZ => Some(0),
            HomeLatheOrder::YThenXThenZ => Some(1),
        }
    }

    /// The tool goes up before another work offset.
    pub fn goes_up_for_offsets(&self) -> bool {
        self.commons.read(loc::FIXTURE_CHANGE_BLOCK)
    }

    /// Inverse time within the machine's limits, motions a minute.
    pub fn inverse_within(&self, inverse: f64) -> f64 {
        let of = |at: Dbl| self.commons.dbl_opt(at);
        let of_time = of(loc::FEED_INVERSE_MIN_TIME).filter(|time| *time > 0.0);
        let most = of(loc::FEED_INVERSE_MAX).unwrap_or(f64::INFINITY);
        let most = of_time.map_or(most, |time| most.min(60.0 / time));
        inverse.max(of(loc::FEED_INVERSE_MIN).unwrap_or(0.0)).min(most)
    }

    /// True when the inverse time of an arc is made from its chord.
    pub fn takes_chords(&self) -> bool {
        self.commons.read(loc::FEED_INVERSE_LENGTH) == FeedInverseLength::LengthOfTheChord
    }

    /// True when the feed of a compensated arc is that at the edge of the cutter.
    pub fn feeds_at_the_edge(&self) -> bool {
        self.commons.read(loc::CIRCLE_TRUE_RADIUS_FEED)
    }

    /// Motions under MULTAX/ON are written in tool-tip control.
    pub fn has_tip_control(&self) -> bool {
        self.commons.read(loc::ROTARY_TIP_OUTPUT) == loc::RotaryTipOutput::Tcpc
    }

    /// A rapid block of several axes is not straight, and heads lean the tool.
    pub fn bends_rapids(&self) -> bool {
        let mut heads = self.forward.rotaries().iter().flatten();
        self.commons.read(loc::RAPID_STRAIGHT) == loc::RapidStraight::EachAxisAtItsOwnSpeed
            && heads.any(|axis| axis.carries == Carries::Head)
    }

    /// An arc outside of the plane of cutter compensation changes that plane.
    pub fn arcs_change_plane(&self) -> bool {
        self.commons.read(loc::CIRCLE_CUTCOM_PLANE) == loc::CircleCutcomPlane::ChangeThePlane
    }

    /// Length below which a rapid is made at feed, and that feed, mm and mm/min.
    pub fn short_rapid(&self, metric: bool) -> Option<(f64, f64)> {
        let of = |at: Dbl| self.commons.dbl_opt(at).filter(|value| *value > 0.0);
        let turns = self.forward.has_rotary();
        let unit = unit(metric);
        let short = of(loc::RAPID_SHORT_DISTANCE).filter(|_| !turns)?;
        Some((short * unit, of(loc::RAPID_SHORT_FEED)? * unit))
    }

    /// The axes that go first in a slanted line: X and Y, or Z; `None` where all go at once.
    pub fn first_of_lines(&self) -> Option<LinearMethod> {
        let order = self.commons.read(loc::LINEAR_METHOD);
        (order != LinearMethod::XyzInOneBlock).then_some(order)
    }

    /// Where an arc ends when the machine corrects it: at the radius of its start, and at
    /// its level.
    pub fn arc_end(&self, arc: &Arc, metric: bool) -> Point3<f64> {
        let of = |at: Dbl| self.commons.dbl_opt(at).unwrap_or(0.0) * unit(metric);
        let mut end = arc.end.tip;
        let spoke = arc.spoke(end);
        let off = arc.radius() - spoke.norm();
        let corrects =
            self.commons.read(loc::CIRCLE_CORRECTION) == CircleCorrection::CorrectTheEndPoint;
        if corrects && off.abs() <= of(loc::CIRCLE_CORRECTION_MAX) && spoke.norm() > 1e-6 {
            end += spoke.normalize() * off;
        }
        let rise = arc.rise_of(end);
        if arc.sweep <= 360.0 && rise.abs() <= of(loc::CIRCLE_Z_TOLERANCE) {
            end -= arc.normal * rise;
        }
        end
    }

    /// How far a direction of the tool that the program says may be off by its rounding; `None`
    /// for a machine that says angles.
    pub fn direction_rounding(&self) -> Option<f64> {
        let says = self.commons.read(loc::ROTARY_TIP_FORM) == RotaryTipForm::Vectors;
        let decimals = self.commons.int(loc::ROTARY_VECTOR_DECIMALS).clamp(4, 8);
        says.then(|| 0.9 * libm::exp10(-f64::from(decimals)))
    }

    /// How far off the turn of a rotary axis may be by the rounding of the directions at both
    /// ends, degrees; none where the program says angles.
    pub fn turn_by_rounding(&self, ends: [&Position; 2]) -> f64 {
        let Some(off) = self.direction_rounding() else { return 0.0 };
        ends.into_iter().map(|end| self.forward.turn_for(end.rotary, off)).sum()
    }
}
