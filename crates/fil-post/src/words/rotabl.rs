//! ROTABL and ROTATE/TABLE: a table turned to an angle, where the machine says what the
//! points after it count in.

use fil_cl::WordId;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::axis_chain::Carries;
use fil_machine::locations::{self as loc, RotaryTableWords};

use super::goto;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// The words that name an axis, A, B and C.
const AXES: [WordId; 3] = [w::AAXIS, w::BAXIS, w::CAXIS];

/// Turns a table: `ROTABL/angle` or `ATANGL,angle` to a position, `INCR,angle` on from where
/// it stands, degrees; AAXIS, BAXIS or CAXIS names it where the machine has two. CLW and CCLW
/// with a position have no effect, as the axis has one way there. False where the machine does
/// not say what the points are then.
///
/// # Errors
/// No angle or two; a table that the machine lacks; INCR with a direction, as the side it is
/// seen from is not known, or under MULTAX/ON; all that the turn refuses.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<bool> {
    if post.control.commons.read(loc::ROTARY_TABLE_WORDS) == RotaryTableWords::Refused {
        return Ok(false);
    }
    if !items.flag(w::TABLE) && items.major() == w::ROTATE {
        return Err(items.error("only ROTATE/TABLE is known"));
    }
    let index = table(post, items)?;
    let (on, to) = (items.couplet(w::INCR)?, items.couplet(w::ATANGL)?);
    let direction = items.any_of(&[w::CLW, w::CCLW]);
    let alone = items.numbers();
    items.deny_rest()?;
    goto::refuse_waiting_arc(post)?;
    let angle = match (on, to, &alone[..]) {
        (None, Some(angle), []) => angle,
        (None, None, [angle]) => *angle,
        (Some(_), None, []) if direction.is_some() => {
            return Err(items.error("INCR with a direction: the side it is seen from is not known"));
        }
        (Some(_), None, []) if post.path.multax == Some(true) => {
            return Err(items.error("INCR under MULTAX/ON: the points turn the table too"));
        }
        (Some(angle), None, [])
            if angle.abs() > 180.0 && post.control.tables.axis(index + 3).full_turn() != 0 =>
        {
            return Err(items.error(
                "INCR by more than half a turn, and positions of the table count within one turn: \
                 it would go the other way round",
            ));
        }
        (Some(angle), None, []) => stands(post, index, items)? + angle,
        _ => return Err(items.error("one angle is needed")),
    };
    if direction.is_some() {
        let message = "CLW or CCLW of ROTABL: the axis has one way to a position".to_string();
        post.warn(PostCode::IgnoredPart, message);
    }
    carry_out(post, Operation::Turn(index, angle))?;
    Ok(true)
}

/// The table that the record means: 0 or 1.
fn table(post: &Post, items: &mut Items) -> Result<usize> {
    let named = AXES.iter().position(|axis| items.flag(*axis));
    let chain = post.control.tables.chain();
    let mut tables = chain.rotaries.iter().enumerate().filter(|(_, rotary)| {
        let is_meant = |axis: usize| named.is_none_or(|named| named == axis);
        rotary.as_ref().is_some_and(|it| it.carries == Carries::Table && is_meant(it.axis))
    });
    match (tables.next(), tables.next()) {
        (Some((index, _)), None) => Ok(index),
        (Some(_), Some(_)) => Err(items.error("the machine has two tables: which is not said")),
        _ => Err(items.error("the machine has no such table")),
    }
}

/// Where a table stands, degrees, over any number of turns.
fn stands(post: &Post, index: usize, items: &Items) -> Result<f64> {
    let Some(here) = post.control.stands(index + 3) else {
        return Err(items.error("INCR: where the table stands is not known"));
    };
    Ok(post.path.rotary.map_or(here, |angles| angles[index]))
}
