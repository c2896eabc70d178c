//! Arcs in several blocks, as many as a CIRCLE with turns asks for: they are written some at a
//! time, so that whoever drives the post can take the finished ones away.

use fil_diag::Result;
use nalgebra::Point3;

use super::arc_parts::{Chords, Parts, Rest};
use super::feed_rules;
use crate::control::family;
use crate::operation::{Arc, Target};
use crate::post::Post;

/// Blocks that are written before the finished ones can be taken away.
const PIECE: u32 = 1_000;

/// Writes an arc as lines. They are no lines of the CL file, so they tell nothing of its sense.
///
/// # Errors
/// As a straight motion; too many lines.
pub(super) fn as_lines(
    post: &mut Post,
    arc: &Arc,
    start: Point3<f64>,
    sweep: f64,
    target: Target,
) -> Result<()> {
    let chords = Chords::new(post, arc, start, sweep, target)?;
    let course = std::mem::take(&mut post.path.sense.course);
    post.path.long_arc.in_chords = true;
    write(post, Rest::Lines(chords, course))
}

/// Writes an arc as its parts, of which the last ends at a point of the CL file.
///
/// # Errors
/// As an arc.
pub(super) fn in_parts(post: &mut Post, parts: Parts, end: Point3<f64>) -> Result<()> {
    write(post, Rest::Arcs(parts, end))
}

/// Writes more of the CIRCLE that is on the tape in part.
///
/// # Errors
/// As the motions it is made of.
pub(crate) fn go_on(post: &mut Post) -> Result<()> {
    match post.path.long_arc.rest.take() {
        Some(rest) => write(post, *rest),
        None => Ok(()),
    }
}

/// Writes a piece, and keeps what is left.
fn write(post: &mut Post, mut rest: Rest) -> Result<()> {
    let more = match &mut rest {
        Rest::Lines(chords, _) => chords.write(post, PIECE)?,
        Rest::Arcs(parts, _) => write_parts(post, parts)?,
    };
    match rest {
        rest if more => post.path.long_arc.rest = Some(Box::new(rest)),
        Rest::Lines(_, course) => {
            post.path.sense.course = course;
            post.path.long_arc.in_chords = false;
        }
        Rest::Arcs(_, end) => post.path.point = Some(end),
    }
    Ok(())
}

/// Writes some parts; false when the last one is written.
fn write_parts(post: &mut Post, parts: &mut Parts) -> Result<bool> {
    for _ in 0..PIECE {
        let Some(part) = parts.next(&post.control)? else { return Ok(false) };
        let feed = feed_rules::settle_of_arc(post, &part)?;
        family::arc(&mut post.control, &part, feed.as_ref())?;
    }
    Ok(!parts.over)
}
