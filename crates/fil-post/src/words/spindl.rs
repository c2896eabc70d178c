//! SPINDL: RPM,s,CLW in any order; OFF; ON; ORIENT\[,angle]; SFM and SMM for
//! constant surface speed; MAXRPM,n; RANGE,n|LOW|MEDIUM|HIGH. SIDE speaks of the second
//! spindle of a lathe, MAIN of the first.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use super::fedrat;
use crate::control::word_address::spindle::counted;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::{
    CountedSpindle, Operation, SideSpindle, Spindle, SpindleRange, SpindleSpeed, SpindleTurn,
};
use crate::path::{carry_out, lead_in};
use crate::post::Post;

/// Commands the spindle.
///
/// # Errors
/// A form that is not known, or a speed that does not fit.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let is_side = items.flag(w::SIDE);
    if is_side && !counted::is_chosen(&post.control) {
        return side(post, items);
    }
    items.flag(w::MAIN);
    refuse_of_side(post, items, is_side)?;
    if items.flag(w::OFF) {
        items.deny_rest()?;
        choose(post, is_side, true)?;
        return carry_out(post, Operation::Spindle(Spindle::Off));
    }
    if items.flag(w::ORIENT) {
        let angle = items.number();
        post.due_to(items);
        items.deny_rest()?;
        choose(post, is_side, true)?;
        return carry_out(post, Operation::Spindle(Spindle::Orient(angle)));
    }
    let range = range(items)?.map(|range| (range, items.last_word()));
    let limit = items.couplet(w::MAXRPM)?.map(|limit| (limit, items.last_word()));
    let turn = turn(items)?;
    items.deny_rest()?;
    if turn.is_some_and(|turn| turn.speed.is_some_and(SpindleSpeed::is_zero)) {
        let message = "SPINDL: a speed of 0; the spindle is stopped as by OFF".to_string();
        let hint = || Some("Write SPINDL / OFF, or the speed.".into());
        post.control.warnings.add_with(PostCode::IgnoredPart, message, hint);
        choose(post, is_side, true)?;
        return carry_out(post, Operation::Spindle(Spindle::Off));
    }
    let is_whole = turn.is_some_and(|turn| turn.speed.is_some() && turn.clockwise.is_some());
    choose(post, is_side, is_whole)?;
    if let Some((range, word)) = range {
        post.control.block.cause.word = word;
        carry_out(post, Operation::Spindle(Spindle::Range(range)))?;
    }
    let turn = turn.map(|turn| SpindleTurn { in_named_range: range.is_some(), ..turn });
    let highest = limit.map(|(limit, _)| limit);
    lead_in::end(&mut post.control)?;
    if turn.is_some_and(|turn| lead_in::keep(&mut post.control, turn, highest)) {
        return Ok(());
    }
    if let Some((limit, word)) = limit {
        post.control.block.cause.word = word;
        carry_out(post, Operation::Spindle(Spindle::Limit(limit)))?;
    }
    match turn {
        Some(turn) => carry_out(post, Operation::Spindle(Spindle::Turn(turn))),
        None => Ok(()),
    }
}

/// The control counts the spindle that a record speaks of, where the machine says how.
fn choose(post: &mut Post, is_side: bool, is_whole: bool) -> Result<()> {
    if !counted::is_chosen(&post.control) {
        return Ok(());
    }
    let chosen = CountedSpindle { is_side, is_whole };
    carry_out(post, Operation::Spindle(Spindle::Counted(chosen)))
}

/// Refuses what is not known of a second spindle: its ranges, its orientation, and on most
/// controls whose X a surface speed counts.
fn refuse_of_side(post: &Post, items: &mut Items, is_side: bool) -> Result<()> {
    let has = |words: &[fil_cl::WordId]| words.iter().any(|word| items.has(*word));
    if !is_side {
        return Ok(());
    }
    if has(&[w::RANGE, w::ORIENT]) {
        return Err(items.error("RANGE and ORIENT of the sub-spindle (SIDE) are not written"));
    }
    let of_surface = has(&[w::SFM, w::SMM, w::MAXRPM]);
    if of_surface && !counted::may_hold_surface_speed(&post.control) {
        return Err(items.error("a surface speed of the sub-spindle (SIDE) is not written"));
    }
    Ok(())
}

/// The second spindle: RPM,s with CLW or CCLW; OFF.
fn side(post: &mut Post, items: &mut Items) -> Result<()> {
    let stops = items.flag(w::OFF);
    if items.has(w::SFM) || items.has(w::SMM) || items.has(w::MAXRPM) {
        return Err(items.error("a surface speed of the sub-spindle (SIDE) is not written"));
    }
    items.flag(w::RPM);
    let speed = if stops { None } else { items.number() };
    let speed_word = items.last_word();
    let direction = items.any_of(&[w::CLW, w::CCLW]);
    let words = [speed_word, items.last_word()];
    items.deny_rest()?;
    let turn = match direction {
        _ if stops => None,
        Some(word) => Some(word == w::CLW),
        None => return Err(items.error("the sub-spindle needs CLW, CCLW or OFF")),
    };
    if speed.is_some_and(|speed| speed < 0.0) {
        return Err(items.error("the speed is negative; CCLW turns the other way"));
    }
    carry_out(post, Operation::Spindle(Spindle::Side(SideSpindle { turn, speed, words })))?;
    if let Some(feed) = post.path.feed {
        fedrat::warn_beside_second_spindle(post, feed);
    }
    Ok(())
}

/// RANGE with a number or a word.
fn range(items: &mut Items) -> Result<Option<SpindleRange>> {
    let named = [
        (w::LOW, SpindleRange::Low),
        (w::MEDIUM, SpindleRange::Medium),
        (w::HIGH, SpindleRange::High),
    ];
    let found = named.iter().find(|(word, _)| items.pair(w::RANGE, *word));
    match found {
        Some((_, range)) => Ok(Some(*range)),
        None => Ok(items.couplet(w::RANGE)?.map(SpindleRange::Number)),
    }
}

/// What makes the spindle turn; `None` for a record that only sets a range or limit.
fn turn(items: &mut Items) -> Result<Option<SpindleTurn>> {
    let only_sets = items.last_word() != 0;
    let unit = items.any_of(&[w::RPM, w::SFM, w::SMM]);
    let number = items.number();
    let speed_word = if number.is_some() { items.last_word() } else { 0 };
    let speed = match (unit, number) {
        (Some(_), None) => return Err(items.error("the speed is missing")),
        (_, None) => None,
        (_, Some(speed)) if speed < 0.0 => {
            return Err(items.error("the speed is negative; CCLW turns the other way"));
        }
        (Some(w::SFM), Some(speed)) => Some(SpindleSpeed::Feet(speed)),
        (Some(w::SMM), Some(speed)) => Some(SpindleSpeed::Meters(speed)),
        (_, Some(speed)) => Some(SpindleSpeed::Revolutions(speed)),
    };
    let direction = items.any_of(&[w::CLW, w::CCLW]);
    let direction_word = if direction.is_some() { items.last_word() } else { 0 };
    let on = items.flag(w::ON);
    if only_sets && speed.is_none() && direction.is_none() && !on {
        return Ok(None);
    }
    let clockwise = direction.map(|word| word == w::CLW);
    let words = [speed_word, direction_word];
    Ok(Some(SpindleTurn { speed, clockwise, in_named_range: false, words }))
}
