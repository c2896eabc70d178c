//! ROTABL and ROTATE/TABLE: a table turned to an angle, where the machine says what the
//! points after it count in.

use fil_cl::WordId;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::axis_chain::Carries;
use fil_machine::locations::{
    self as loc, RotaryClwAlongNormal, RotaryDefaultClw, RotaryFacesPositive, RotaryOutput,
    RotaryTableWords,
};

use crate::control::needs::Act;
use crate::control_state::Place;
use crate::control_state::modal::Source;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::{Statement, carry_out};
use crate::post::Post;

/// The words that name an axis, A, B and C.
const AXES: [WordId; 3] = [w::AAXIS, w::BAXIS, w::CAXIS];

/// Turns a table: `ROTABL/angle` or `ATANGL,angle` to a position, `INCR,angle` on from where
/// it stands, degrees; AAXIS, BAXIS or CAXIS names it where the machine has two. CLW and CCLW, or
/// the direction that the machine has where none is named, act where it says how they are seen;
/// else with a position they have no effect, as the axis has one way there. False where the machine
/// does not say what the points are then.
///
/// # Errors
/// No angle or two; a table that the machine lacks; INCR with a direction where the side it is
/// seen from is not known, with one and an angle below zero, or under MULTAX/ON; all that the turn
/// refuses.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<bool> {
    if post.control.commons.read(loc::ROTARY_TABLE_WORDS) == RotaryTableWords::Refused {
        return Ok(false);
    }
    if post.path.is_moved_by(Statement::NamedFrame) {
        return Err(items.error("a frame of the file moves the points already"));
    }
    let names_axis = AXES.iter().any(|axis| items.has(*axis));
    let is_rotate = items.major() == w::ROTATE;
    if !items.flag(w::TABLE) && is_rotate && !names_axis {
        return Err(items.error("ROTATE needs TABLE, AAXIS, BAXIS or CAXIS"));
    }
    let index = table(post, items)?;
    let (on, to) = turn_asked(items)?;
    let direction = items.any_of(&[w::CLW, w::CCLW]);
    let (on, direction) = match on {
        Some(on) if is_rotate => signed_turn(post, index, on, direction),
        on => (on, direction),
    };
    let alone = items.numbers();
    items.deny_rest()?;
    post.require(Act::OtherMotion)?;
    let way = way(post, index, direction);
    let angle = match (on, to, &alone[..]) {
        (None, Some(angle), []) => by_way(post, index, angle, way, items)?,
        (None, None, [angle]) => by_way(post, index, *angle, way, items)?,
        (Some(_), None, []) if direction.is_some() && way.is_none() => {
            let diag = items.error("INCR with a direction: the side it is seen from is not known");
            let hint = "Set rotary.faces_positive and rotary.clw_along_normal, or give INCR its sign: Creo writes plus with CLW and minus with CCLW.";
            return Err(Box::new(diag.hint(hint)));
        }
        (Some(_), None, []) if post.path.multax == Some(true) => {
            return Err(items.error("INCR under MULTAX/ON: the points turn the table too"));
        }
        (Some(angle), None, [])
            if angle.abs() > 180.0 && post.control.tables.axis(index + 3).full_turn() != 0 =>
        {
            return Err(items.error(
                "INCR by more than 180 degrees, but table positions are within 360 degrees: the table would turn the other way",
            ));
        }
        (Some(angle), None, []) if angle < 0.0 && way.is_some() => {
            return Err(items.error("INCR by less than zero, and clockwise or counterclockwise"));
        }
        (Some(angle), None, []) => turns_on_from(post, index, items)? + angle * way.unwrap_or(1.0),
        _ => return Err(items.error("one angle is needed")),
    };
    refuse_minus(post, index, way.filter(|_| direction.is_some()), items)?;
    if direction.is_some() && (way.is_none() || !turns_either_way(post, index)) {
        let word = if is_rotate { "ROTATE" } else { "ROTABL" };
        let message = format!("CLW or CCLW of {word}: the axis has one way to a position");
        post.warn(PostCode::IgnoredPart, message);
    }
    carry_out(post, Operation::Turn(index, angle))?;
    Ok(true)
}

/// INCR or ATANGL with its angle, in either order with each other: `ABSOL,90`, `ABSOL,ATANGL,90`,
/// `INCR,-36`, `INCR,ATANGL,30`.
fn turn_asked(items: &mut Items) -> Result<(Option<f64>, Option<f64>)> {
    items.flag(w::ABSOL);
    if items.pair(w::INCR, w::ATANGL) {
        let angle = items.number().ok_or_else(|| items.error("an angle is needed"))?;
        return Ok((Some(angle), None));
    }
    Ok((items.couplet(w::INCR)?, items.couplet(w::ATANGL)?))
}

/// The angle of ROTATE with INCR, and its direction. Creo writes the sign and the word: plus is CLW,
/// minus is CCLW. Where the machine says how a direction is seen it counts, else the sign does.
fn signed_turn(
    post: &mut Post,
    index: usize,
    on: f64,
    direction: Option<WordId>,
) -> (Option<f64>, Option<WordId>) {
    let says_twice = direction == Some(if on < 0.0 { w::CCLW } else { w::CLW });
    match (says_twice, way(post, index, direction)) {
        (true, Some(_)) => (Some(on.abs()), direction),
        (true, None) => {
            let message = "CLW or CCLW of ROTATE: the sign of INCR is the direction".to_string();
            post.warn(PostCode::IgnoredPart, message);
            (Some(on), None)
        }
        (false, _) => (Some(on), direction),
    }
}

/// Refuses a direction that counts down where the control turns up in any case.
///
/// # Errors
/// It is such a direction.
fn refuse_minus(post: &Post, index: usize, way: Option<f64>, items: &Items) -> Result<()> {
    let goes_up =
        post.control.commons.read(loc::ROTARY_OUTPUT) == RotaryOutput::PositiveWithinATurn;
    if goes_up && way == Some(-1.0) && post.control.tables.axis(index + 3).full_turn() != 0 {
        return Err(items.error(
            "a direction in which positions count down, and the control always turns them up",
        ));
    }
    Ok(())
}

/// The sense in which the positions of a table count in a direction, 1 or -1: that of the record,
/// else that of the machine. `None` where the machine does not say how it is seen, and under
/// MULTAX/ON, as the points turn the table too.
fn way(post: &Post, index: usize, direction: Option<WordId>) -> Option<f64> {
    let commons = &post.control.commons;
    let by_default = commons.read(loc::ROTARY_DEFAULT_CLW) == RotaryDefaultClw::Yes;
    let clockwise = direction.map_or(by_default, |direction| direction == w::CLW);
    let [Some(table), None] = &post.control.tables.chain().rotaries else { return None };
    if index != 0 || post.path.multax == Some(true) {
        return None;
    }
    let faces_plus = commons.read(loc::ROTARY_FACES_POSITIVE)? == RotaryFacesPositive::Yes;
    let from_behind = commons.read(loc::ROTARY_CLW_ALONG_NORMAL) == RotaryClwAlongNormal::Yes;
    let along = table.direction[table.axis];
    // Seen along a line, clockwise is the right-hand rule about it. Positions count the motion of
    // the tool about the part: the table itself turns the other way.
    let sees_plus = faces_plus == from_behind;
    let plus = (sees_plus == (along > 0.0)) != clockwise;
    (along != 0.0).then_some(if plus { 1.0 } else { -1.0 })
}

/// True for a table that comes to a position in both directions: one without travel.
fn turns_either_way(post: &Post, index: usize) -> bool {
    post.control.tables.chain().rotaries[index].as_ref().is_some_and(|table| !table.is_limited())
}

/// A position, degrees, with the whole turns that the table has behind it when it comes to it in a
/// direction; one where it is not known to stand is the position itself.
///
/// # Errors
/// More than half a turn, and positions count within one: the control goes the shorter way.
fn by_way(post: &Post, index: usize, to: f64, way: Option<f64>, items: &Items) -> Result<f64> {
    let Some(way) = way.filter(|_| turns_either_way(post, index)) else { return Ok(to) };
    let Ok(here) = stands(post, index, items) else { return Ok(to) };
    let axis = post.control.tables.axis(index + 3);
    let turn = ((to - here) * way).rem_euclid(360.0);
    let turn = if 360.0 - turn < axis.resolution() { 0.0 } else { turn };
    if turn > 180.0 && axis.full_turn() != 0 {
        return Err(items.error(
            "more than 180 degrees in this direction, but table positions are within 360 degrees: the table would turn the other way",
        ));
    }
    Ok(here + turn * way)
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
        (Some(_), Some(_)) => Err(items.error("the machine has two tables: name one")),
        _ => Err(items.error("the machine has no such table")),
    }
}

/// Where a table stands that is turned on from there, degrees, over any number of turns. After
/// another work offset its angle is that of the offset before, which is a doubt.
fn turns_on_from(post: &mut Post, index: usize, items: &Items) -> Result<f64> {
    let Place::Shifted(here) = post.control.place(index + 3) else {
        return stands(post, index, items);
    };
    let here = post.path.rotary.map_or(here, |angles| angles[index]);
    let message = format!("the table is at {here} degrees of the work offset before");
    let assumed = "both offsets are taken to have one zero of the table";
    post.control.doubt(Source::Post, PostCode::ShiftedTurn.diag(message), assumed)?;
    Ok(here)
}

/// Where a table stands, degrees, over any number of turns.
fn stands(post: &Post, index: usize, items: &Items) -> Result<f64> {
    let Some(here) = post.control.stands(index + 3) else {
        let diag = items.error("INCR: the table position is not known");
        return Err(Box::new(diag.hint("Give the angle from zero: with ABSOL, or without INCR.")));
    };
    Ok(post.path.rotary.map_or(here, |angles| angles[index]))
}
