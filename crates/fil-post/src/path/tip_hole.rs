//! Holes under tool-tip control: no cycle runs there, so they are single moves along the tool.

use fil_diag::Result;
use fil_machine::locations as loc;
use nalgebra::{Point3, Vector3};

use super::expand::{WayOut, settle_way_out};
use super::{Since, linear, tip_control};
use crate::control::word_address::spindle;
use crate::errors::PostCode;
use crate::operation::cycle::{AboveHoles, Cycle, CycleFeed, CycleKind};
use crate::operation::{Dwell, MotionKind, Operation, Target};
use crate::post::Post;

/// What helps where a level can't hold for two directions of the tool.
const EACH_ITS_LEVEL: &str = "Give the cycle RETURN with a number, or CLEAR alone.";

/// Least part of a way along the tool that must lead up to the level of the next hole.
const LEAST_WAY_UP: f64 = 0.2;

/// Directions of the tool whose cosine is larger are one.
const SAME_DIRECTION: f64 = 1.0 - 1e-12;

/// Heights nearer than this are one, mm or inch.
const SAME_HEIGHT: f64 = 1e-9;

/// Drills a hole in single moves along its axis.
///
/// # Errors
/// A tap; a level to return to that is not known; as a straight motion.
pub(super) fn hole(post: &mut Post, cycle: &mut Cycle, target: Target) -> Result<()> {
    let CycleFeed::Feed(feed) = cycle.feed else { return cant_tap() };
    if cycle.kind == CycleKind::Tap {
        return cant_tap();
    }
    let axis = target.axis.normalize();
    let height = |point: Point3<f64>| (point - target.point).dot(&axis);
    let stands = post.path.axis.stands.normalize();
    let here = post.path.point.map(|at| AboveHoles { before: at, axis: stands, now: at });
    let above = cycle.above.or(here);
    let above = above.filter(|_| post.path.last.since != Since::ToolChange);
    refuse_turned_level(cycle, above, axis)?;
    if above.is_some() && post.path.last.since == Since::Frame {
        return PostCode::TipControl.err_with(
            "a hole right after TRANS, ORIGIN, TRACUT, ROTABL, FROM or a foreign block that moves the tool: put a GOTO between them",
            "Put a GOTO above the hole between them.",
        );
    }
    let rest = match (cycle.retract, above) {
        (None, _) => cycle.clear,
        (Some(0.0), None) => {
            return PostCode::CycleForm.err("the initial plane to return to is not known");
        }
        (Some(0.0), Some(above)) => height(above.before).max(cycle.clear),
        (Some(level), _) => level.max(cycle.clear),
    };
    let clear = cycle.clear;
    let was = (post.path.feed.replace(feed), post.control.block.cause);
    let mut moves = Moves { post, cycle, target, axis };
    match above {
        Some(above) => moves.across(above.now, stands, rest.max(clear))?,
        None if rest > clear + SAME_HEIGHT => moves.rapid(rest)?,
        None => {}
    }
    moves.down_and_up(rest)?;
    let now = target.point + axis * rest;
    let first = above.unwrap_or(AboveHoles { before: now, axis, now });
    cycle.above = Some(AboveHoles { now, ..first });
    (post.path.feed, post.control.block.cause) = was;
    post.path.point = Some(target.point);
    Ok(())
}

/// Goes away from the last hole of a cycle that has ended, to the level before the cycle.
///
/// # Errors
/// The tool leans otherwise than there; as a straight motion.
pub(super) fn retract(post: &mut Post, above: &mut AboveHoles) -> Result<()> {
    let axis = post.path.axis.stands.normalize();
    if above.axis.dot(&axis) < SAME_DIRECTION {
        return PostCode::TipControl.err_with(
            "cycle.retract_block returns to the initial plane, but the tool axis has changed since",
            EACH_ITS_LEVEL,
        );
    }
    let way = (above.before - above.now).dot(&axis);
    if way > SAME_HEIGHT {
        above.now += axis * way;
        let cause = post.control.block.cause;
        let to = Target { point: above.now, axis, word: 0 };
        linear::carry_out(post, &to, MotionKind::Rapid(cause))?;
    }
    Ok(())
}

/// Refuses a return to the level before the cycle at a hole in another direction: across that
/// direction the level lies elsewhere, and the way to it could lead through the part.
fn refuse_turned_level(cycle: &Cycle, above: Option<AboveHoles>, axis: Vector3<f64>) -> Result<()> {
    let turned = above.is_some_and(|above| above.axis.dot(&axis) < SAME_DIRECTION);
    if cycle.retract != Some(0.0) || !turned {
        return Ok(());
    }
    PostCode::TipControl.err_with(
        "RETURN,0 returns to the initial plane, but the tool axis has changed since: give a height over each hole (RETURN with a number, or RAPTO)",
        EACH_ITS_LEVEL,
    )
}

fn cant_go_up() -> Result<()> {
    PostCode::TipControl.err_with(
        "the tool axis changes a lot before the next hole of a cycle, whose plane is above the tool",
        "Put CYCLE/OFF and a GOTO above the next hole, along its axis, before it.",
    )
}

fn cant_tap() -> Result<()> {
    PostCode::TipControl.err_with(
        "a tap can't be written as single moves, and no cycle runs under it",
        tip_control::OUTSIDE,
    )
}

/// The moves of a hole along its axis.
struct Moves<'a> {
    post: &'a mut Post,
    cycle: &'a Cycle,
    target: Target,
    axis: Vector3<f64>,
}

impl Moves<'_> {
    /// Goes across above what stands between the holes, as a cycle of the control does: out of
    /// the part along the tool as it stands where that is below `lowest`, then on that level.
    ///
    /// # Errors
    /// The tool turns so far that along itself is no way up; as a straight motion.
    fn across(&mut self, now: Point3<f64>, stands: Vector3<f64>, lowest: f64) -> Result<()> {
        let way = self.target.point - now;
        let here = -way.dot(&self.axis);
        if here < lowest - SAME_HEIGHT {
            let slope = stands.dot(&self.axis);
            if slope < LEAST_WAY_UP {
                return cant_go_up();
            }
            let point = now + stands * ((lowest - here) / slope);
            self.rapid_to(Target { point, axis: stands, word: 0 })?;
        }
        let level = here.max(lowest);
        let least = self.post.control.tables.axis(0).resolution();
        let across = (way - self.axis * way.dot(&self.axis)).norm() > least;
        if across && level > self.cycle.clear + SAME_HEIGHT {
            self.rapid(level)?;
        }
        Ok(())
    }

    fn down_and_up(&mut self, rest: f64) -> Result<()> {
        let (clear, bottom) = (self.cycle.clear, -self.cycle.depth);
        self.rapid(clear)?;
        self.post.control.block.cause = self.cycle.cause;
        if let Some(step) = self.cycle.step {
            self.pecks(step)?;
        }
        self.feed(bottom)?;
        if self.cycle.dwell > 0.0 {
            self.post.control.block.cause = self.cycle.due_to(self.cycle.words.dwell);
            let dwell = Operation::Dwell(Dwell::Seconds(self.cycle.dwell));
            self.post.control.family().write(&mut self.post.control, dwell)?;
            self.post.control.block.cause = self.cycle.cause;
        }
        match settle_way_out(&mut self.post.control, self.cycle)? {
            WayOut::Rapid => self.rapid(rest),
            WayOut::Feed => {
                self.feed(clear)?;
                self.rapid(rest)
            }
            WayOut::Standing => {
                let clockwise = spindle::stand(&mut self.post.control)?;
                self.rapid(rest)?;
                spindle::turn_on(&mut self.post.control, clockwise)
            }
        }
    }

    /// DEEP comes out to the R level after each peck, BRKCHP lifts, and comes out as TIMES says.
    fn pecks(&mut self, step: f64) -> Result<()> {
        let mm = self.post.control.require_unit()?.in_mm();
        let gap = self.post.control.commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(0.0).max(0.0);
        let (clear, length) = (self.cycle.clear, self.cycle.clear + self.cycle.depth);
        let mut reached = 0.0;
        let mut peck = 0;
        while reached + step < length - SAME_HEIGHT {
            reached += step;
            peck += 1;
            self.feed(clear - reached)?;
            if self.cycle.leaves_after(peck) {
                self.rapid(clear)?;
            }
            self.rapid(clear - (reached - gap / mm).max(0.0))?;
        }
        Ok(())
    }

    fn at(&self, height: f64) -> Target {
        Target { point: self.target.point + self.axis * height, axis: self.target.axis, word: 0 }
    }

    fn rapid(&mut self, height: f64) -> Result<()> {
        let to = self.at(height);
        self.rapid_to(to)
    }

    fn rapid_to(&mut self, to: Target) -> Result<()> {
        let cause = self.post.control.block.cause;
        linear::carry_out(self.post, &to, MotionKind::Rapid(cause))
    }

    fn feed(&mut self, height: f64) -> Result<()> {
        let to = self.at(height);
        linear::carry_out(self.post, &to, MotionKind::Feed)
    }
}
