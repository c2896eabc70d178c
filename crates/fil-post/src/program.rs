//! Start and end of the NC program.
//!
//! Start: tape start character, program number, the user's start blocks, the
//! mode codes (units, absolute, feed mode, plane). End: the user's end blocks,
//! the end code, tape end character.

use crate::cause::Cause;
use crate::commons::{Commons, Int};
use crate::errors::PostCode;
use crate::locations as loc;
use crate::post::Post;
use crate::state::FeedMode;
use fil_diag::Diag;

/// Integers of packed text a user block takes, two characters each.
pub const BLOCK_INTEGERS: u16 = 33;

/// Blocks that fit at the start and at the end.
pub const MAX_BLOCKS: u16 = 10;

/// Writes the start of the program, once, before the first block.
///
/// # Errors
/// A program number that does not fit its address.
pub fn start(post: &mut Post) -> Result<(), Box<Diag>> {
    if std::mem::replace(&mut post.state.started, true) {
        return Ok(());
    }
    post.machine.refresh(&post.commons, post.state.metric)?;
    post.because(Cause::default(), write_start)
}

/// The blocks at the start; the machine's settings ask for them.
fn write_start(post: &mut Post) -> Result<(), Box<Diag>> {
    if let Some(mark) = tape_mark(&post.commons, loc::TAPE_START_CHAR) {
        post.write_line(&mark.to_string(), false)?;
    }
    program_number(post)?;
    let flags = (loc::BLOCKS_START_FLAG, loc::BLOCKS_START_COUNT, loc::BLOCKS_START_TEXT);
    let blocks = user_blocks(&post.commons, flags);
    let own_start = !blocks.is_empty();
    for block in blocks {
        post.write_line(&block, true)?;
    }
    mode_codes(post, own_start);
    post.write_block()
}

/// Writes the end of the program.
///
/// # Errors
/// A code that does not fit its address.
pub fn end(post: &mut Post, code: Option<i32>) -> Result<(), Box<Diag>> {
    start(post)?;
    super::words::cycle::off(post)?;
    post.flush_pending()?;
    let flags = (loc::BLOCKS_END_FLAG, loc::BLOCKS_END_COUNT, loc::BLOCKS_END_TEXT);
    for block in user_blocks(&post.commons, flags) {
        post.because(Cause::default(), |post| post.write_line(&block, true))?;
    }
    if let Some(code) = code {
        post.block.m(code);
    }
    post.write_block()?;
    if let Some(mark) = tape_mark(&post.commons, loc::TAPE_END_CHAR) {
        post.because(Cause::default(), |post| post.write_line(&mark.to_string(), false))?;
    }
    post.state.ended = true;
    Ok(())
}

/// Adds the code of the CL file's unit.
pub fn units_code(post: &mut Post) {
    let location = if post.state.metric { loc::UNITS_METRIC_CODE } else { loc::UNITS_INCH_CODE };
    if let Some(code) = post.commons.int_opt(location) {
        post.block.g(code);
    }
}

/// Adds the mode codes a control must stand at. A machine with start blocks of
/// its own says them there; those blocks are trusted.
fn mode_codes(post: &mut Post, own_start: bool) {
    let starts_with = post.commons.int_opt(loc::FEED_MODE);
    let per_revolution = post.commons.int_opt(loc::FEED_UPR_CODE);
    post.state.feed_mode = if starts_with.is_some() && starts_with == per_revolution {
        Some(FeedMode::PerRevolution)
    } else {
        Some(FeedMode::PerMinute)
    };
    post.state.plane = post.commons.int_opt(loc::CIRCLE_PLANE);
    if own_start {
        return;
    }
    units_code(post);
    for location in [loc::MODE_POSITION, loc::FEED_MODE, loc::CIRCLE_PLANE] {
        if let Some(code) = post.commons.int_opt(location) {
            post.block.g(code);
        }
    }
}

fn program_number(post: &mut Post) -> Result<(), Box<Diag>> {
    let Some(letter) = post.commons.int_opt(loc::PROGRAM_NUMBER_ADDRESS) else { return Ok(()) };
    let fixed = post.commons.int_opt(loc::PROGRAM_NUMBER).map(i64::from);
    let number = fixed.or(post.state.part_number).unwrap_or(1);
    if !(0..10_000).contains(&number) {
        return Err(Box::new(Diag::new(
            PostCode::Overflow,
            format!("program number {number} has more than four digits"),
        )));
    }
    let letter = char::from(b'A' + (letter.clamp(1, 26) - 1) as u8);
    let width = if fixed.is_some() { 1 } else { 4 };
    let mut line = format!("{letter}{number:0width$}");
    if post.commons.flag(loc::PROGRAM_NAME_COMMENT) && !post.state.part_name.is_empty() {
        let name = post.state.part_name.replace(['(', ')'], " ");
        line.push_str(&format!(" ({name})"));
    }
    let from_part = fixed.is_none() && post.state.part_number.is_some();
    let cause = if from_part { post.state.part_cause } else { Cause::default() };
    post.because(cause, |post| post.write_line(&line, false))
}

/// The character before or after the program; none in a program for direct
/// transfer (INTCOM 2479).
fn tape_mark(commons: &Commons, location: Int) -> Option<char> {
    if commons.flag(loc::TAPE_DNC) {
        return None;
    }
    let code = commons.int_opt(location).and_then(|code| u8::try_from(code).ok())?;
    code.is_ascii_graphic().then_some(char::from(code))
}

/// The user's start or end blocks, unpacked: two ASCII characters an integer,
/// low byte first, each block 33 integers.
pub fn user_blocks(commons: &Commons, (flag, count, first): (Int, Int, Int)) -> Vec<String> {
    if !commons.flag(flag) {
        return Vec::new();
    }
    let count = commons.int(count).clamp(0, i32::from(MAX_BLOCKS)) as u16;
    (0..count).map(|block| packed_text(commons, first.0 + block * BLOCK_INTEGERS)).collect()
}

fn packed_text(commons: &Commons, first: u16) -> String {
    let mut text = String::new();
    for location in first..first + BLOCK_INTEGERS {
        let pair = commons.int_opt(Int(location)).unwrap_or(0x2020);
        for byte in [pair & 0xff, (pair >> 8) & 0xff] {
            let byte = byte as u8;
            text.push(if (0x20..0x7f).contains(&byte) { char::from(byte) } else { ' ' });
        }
    }
    text.trim().to_string()
}
