//! What is in force and what should be, in words.

use super::say::short;
use crate::motion::{Compensation, Speed, Spindle, WORD_OFFSETS};

pub(super) fn said_of_speed(speed: Speed) -> String {
    match speed {
        Speed::Turns(speed) => format!("{} turns/min", short(speed)),
        Speed::Surface(speed) => format!("a surface speed of {} m/min", short(speed)),
    }
}

pub(super) fn said_of_offset(found: Option<u32>, must: Option<u32>) -> String {
    match (found, must) {
        (Some(found), Some(must)) => format!("length offset {found} is on, it should be {must}"),
        (Some(found), None) => format!("length offset {found} is on, none is asked for"),
        (None, Some(must)) => format!("no length offset is on, it should be {must}"),
        (None, None) => String::new(),
    }
}

type Side = (Compensation, Option<u32>);

pub(super) fn said_of_compensation((found, offset): Side, (must, must_offset): Side) -> String {
    let side = |side| match side {
        Compensation::Off => "off",
        Compensation::Left => "left",
        Compensation::Right => "right",
    };
    if must == Compensation::Off {
        return format!("cutter compensation {} is left on", side(found));
    }
    let with = |offset: Option<u32>| offset.map_or(String::new(), |n| format!(" with offset {n}"));
    let (found, must) = (side(found), side(must));
    let (found_offset, must_offset) = (with(offset), with(must_offset));
    format!("cutter compensation is {found}{found_offset}, it should be {must}{must_offset}")
}

pub(super) fn said_of_spindle(found: Spindle, must: Spindle, cuts: bool) -> String {
    if found == Spindle::Off && cuts {
        return "the spindle is off while the tool cuts".to_string();
    }
    format!("the spindle is {}, it should be {}", name_of_turn(found), name_of_turn(must))
}

pub(super) fn name_of_turn(turn: Spindle) -> &'static str {
    match turn {
        Spindle::Off => "off",
        Spindle::Clockwise => "clockwise",
        Spindle::Counterclockwise => "counterclockwise",
    }
}

pub(super) fn name_of_fixture(fixture: u32) -> String {
    match fixture {
        0..1000 => format!("G{fixture}"),
        1000..WORD_OFFSETS => {
            let (tenths, number) = (fixture / 1000, fixture % 1000);
            format!("G{}.{} P{number}", tenths / 10, tenths % 10)
        }
        _ => format!("number {}", fixture - WORD_OFFSETS),
    }
}
