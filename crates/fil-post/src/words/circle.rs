//! CIRCLE/x,y,z,i,j,k\[,r]\[,TIMES,n]: an arc or helix to the GOTO after it.
//!
//! The GOTO before is the start. The axis turns by the right-hand rule: seen
//! against it the arc runs counterclockwise.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use nalgebra::{Point3, Vector3};

use crate::control::needs::Act;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::Arc;
use crate::post::Post;

/// An axis shorter than this has no direction.
const NO_AXIS: f64 = 1e-6;

/// Most full turns of one helix.
const MAX_TURNS: f64 = 10_000.0;

/// Tolerances and sizes of the tool that NX writes behind the radius.
const OF_THE_TOOL: usize = 4;

/// Keeps the circle until its end point comes.
///
/// # Errors
/// A second CIRCLE without a GOTO between, a CIRCLE in a cycle or in a thread, a record without
/// center and axis, a direction that contradicts the axis.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if post.path.arc.is_some() {
        return PostCode::ArcEnd.err("a second CIRCLE came before the GOTO");
    }
    post.require(Act::Arc)?;
    let circle = items.circle().ok_or_else(|| items.error("center and axis are needed"))?;
    let axis = Vector3::from(circle.axis);
    if axis.norm() < NO_AXIS {
        return Err(items.error("the axis has length zero"));
    }
    let turns = if items.all_taken() { 0.0 } else { further(items, axis)? };
    post.path.arc = Some(Arc {
        center: Point3::from(circle.center),
        axis: axis.normalize(),
        radius: circle.radius,
        turns,
        line: items.line(),
        cause: post.control.block.cause,
    });
    Ok(())
}

/// What may stand behind the radius: turns, a direction, measures of the tool. Gives
/// the number of full turns.
fn further(items: &mut Items, axis: Vector3<f64>) -> Result<f64> {
    let turns = items.couplet(w::TIMES)?.unwrap_or(0.0);
    if turns.fract() != 0.0 || !(0.0..=MAX_TURNS).contains(&turns) {
        return Err(
            items.error(format!("TIMES must be a whole number, at most {MAX_TURNS}, not {turns}"))
        );
    }
    check_direction(items, axis)?;
    let rest = items.numbers().len();
    if rest != 0 && rest != OF_THE_TOOL {
        return Err(items.error(format!("no meaning is known for {rest} more numbers")));
    }
    Ok(turns)
}

/// Refuses a direction word that contradicts the axis, seen from the positive side
/// of the axis nearest to it.
fn check_direction(items: &mut Items, axis: Vector3<f64>) -> Result<()> {
    let clockwise = match items.any_of(&[w::CLOCKWISE, w::CLW, w::COUNTERCLOCKWISE, w::CCLW]) {
        None => return Ok(()),
        Some(word) => matches!(word, w::CLOCKWISE | w::CLW),
    };
    let main = axis[axis.iamax()];
    if clockwise == (main > 0.0) {
        let mut diag = PostCode::ArcSense.diag("the direction contradicts the axis of the CIRCLE");
        diag.hint = Some("choose the dialect of the CL file with --dialect".into());
        return Err(diag);
    }
    Ok(())
}
