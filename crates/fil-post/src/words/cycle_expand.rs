//! Canned cycles as single moves, for machines that have no code for them.

use fil_cl::vocabulary::words as w;
use fil_diag::Diag;

use super::cycle::{Cycle, HoleLevels, with_feed};
use super::delay;
use crate::errors::PostCode;
use crate::kinematics::INCH;
use crate::motion::{Position, ROTARY, XY, Z};
use crate::post::Post;

/// Distance above the last depth at which a peck starts to feed, and by which
/// BRKCHP lifts, mm.
const PECK_GAP: f64 = 0.2;

/// Drills one hole: rapid to it and to the R level, feed to the bottom (in
/// pecks), dwell, retract.
///
/// # Errors
/// TAP, which needs a control that couples spindle and feed.
pub fn hole(
    post: &mut Post,
    cycle: &Cycle,
    at: &Position,
    levels: HoleLevels,
) -> Result<(), Box<Diag>> {
    if cycle.word == w::TAP {
        return Err(Box::new(Diag::new(
            PostCode::NoCode,
            "the machine has no tapping cycle, and a tap can't be written as single moves",
        )));
    }
    post.rapid_to(at, XY | ROTARY)?;
    post.because(cycle.cause, |post| down_and_up(post, cycle, levels))
}

/// The moves along Z, which the CYCLE record asks for.
fn down_and_up(post: &mut Post, cycle: &Cycle, levels: HoleLevels) -> Result<(), Box<Diag>> {
    rapid_z(post, levels.clear)?;
    match cycle.step {
        Some(step) => pecks(post, cycle, levels, step)?,
        None => feed_z(post, cycle, levels.bottom)?,
    }
    if cycle.dwell > 0.0 {
        let value = delay::in_seconds(post, cycle.dwell);
        post.because(cycle.due_to(cycle.words.dwell), |post| delay::write(post, value))?;
    }
    if matches!(cycle.word, w::BORE | w::REAM) {
        feed_z(post, cycle, levels.clear)?;
    }
    rapid_z(post, levels.rest(cycle))
}

/// DEEP comes out to the R level after each peck, BRKCHP only lifts.
fn pecks(post: &mut Post, cycle: &Cycle, levels: HoleLevels, step: f64) -> Result<(), Box<Diag>> {
    let gap = if post.state.metric { PECK_GAP } else { PECK_GAP / INCH };
    let mut reached = levels.clear;
    while reached - step > levels.bottom + 1e-9 {
        reached -= step;
        feed_z(post, cycle, reached)?;
        if cycle.word == w::DEEP {
            rapid_z(post, levels.clear)?;
            rapid_z(post, (reached + gap).min(levels.clear))?;
        } else {
            rapid_z(post, reached + gap)?;
        }
    }
    feed_z(post, cycle, levels.bottom)
}

fn rapid_z(post: &mut Post, z: f64) -> Result<(), Box<Diag>> {
    let mut position = Position::default();
    position[2] = z;
    post.rapid_to(&position, Z)
}

fn feed_z(post: &mut Post, cycle: &Cycle, z: f64) -> Result<(), Box<Diag>> {
    with_feed(post, cycle.feed, |post| {
        let mut position = Position::default();
        position[2] = z;
        post.feed_to(&position, Z)
    })
}
