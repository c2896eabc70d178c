//! What must hold while a program does something, a rule a row.

use super::super::report::FindingKind;
use super::super::say::short;
use super::super::settings::{Quantity, Tolerances};
use super::Expected;
use crate::motion::{Compensation, Modes, Speed, Spindle};
use crate::work_offsets::name_of_offset;

/// Allowed deviation of an oriented spindle, degrees.
const ANGLE: f64 = 6e-4;

/// What the machine does while its modes are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Doing {
    Standing,
    Moving,
    Cutting,
}

/// What the program does there.
pub(super) struct Seen<'a> {
    pub(super) modes: &'a Modes,
    pub(super) doing: Doing,
    pub(super) slack: &'a Tolerances,
}

/// What is wrong, in words.
pub(super) type Rule = fn(&Expected, &Seen<'_>) -> Option<String>;

/// The rules, in the order in which what they find is reported.
pub(super) const RULES: [(FindingKind, Rule); 15] = [
    (FindingKind::Tool, tool),
    (FindingKind::Tool, length),
    (FindingKind::Compensation, side),
    (FindingKind::Compensation, |expected, seen| expected.wrong_plane(seen.modes)),
    (FindingKind::Spindle, turn),
    (FindingKind::Speed, speed),
    (FindingKind::Speed, unasked_speed),
    (FindingKind::Spindle, spindle_again),
    (FindingKind::Coolant, coolant_again),
    (FindingKind::Speed, speed_limit),
    (FindingKind::Spindle, master),
    (FindingKind::Spindle, range),
    (FindingKind::Spindle, orientation),
    (FindingKind::Coolant, coolant),
    (FindingKind::Fixture, work_offset),
];

/// What must be off where a tool is changed and at the end, besides.
pub(super) const STANDING: [(FindingKind, Rule); 2] = [
    (FindingKind::Tool, |_, seen| {
        let said = "TCPC is active, it should be off";
        seen.modes.frame.tip_control.then(|| said.to_string())
    }),
    (FindingKind::Tool, |_, seen| {
        let said = "a tilted work plane is in force, it should be ended";
        seen.modes.frame.tilted.then(|| said.to_string())
    }),
];

fn tool(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = seen.modes.tool;
    let must = expected.tool.number.filter(|tool| *tool != found)?;
    Some(format!("tool {found} moves, it should be tool {must}"))
}

/// Between the change and the new offset, and at the end, the old one may be given up. Tool center
/// point control has an offset, whether one is asked for or not.
fn length(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = seen.modes.length.offset;
    let own = |may: Option<u32>| may.is_none() && seen.modes.frame.tip_control;
    let must = expected.length.refuses(|may| may == found || own(may))?;
    let may_give_up = expected.length.waits() || seen.doing == Doing::Standing;
    let given_up = may_give_up && found.is_none();
    (!given_up).then(|| said_of_offset(found, must))
}

fn side(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = (seen.modes.compensation.side, seen.modes.compensation.offset);
    let must = expected.compensation.refuses(|may| may == found)?;
    Some(said_of_compensation(found, must))
}

fn turn(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = seen.modes.spindle.turn;
    let must = expected.spindle.turn.refuses(|may| may == found)?;
    Some(said_of_spindle(found, must, seen.doing == Doing::Cutting))
}

/// The spindle turns at the rev/min of the approach, before a surface speed begins.
fn leads_in(expected: &Expected, seen: &Seen) -> bool {
    let turns = seen.modes.spindle.speed.and_then(Speed::turns);
    let differs = expected.spindle.approach.zip(turns).map(|(must, found)| (must - found).abs());
    seen.doing == Doing::Moving && differs.is_some_and(|by| by <= seen.slack.of(Quantity::Speed))
}

fn speed(expected: &Expected, seen: &Seen) -> Option<String> {
    if leads_in(expected, seen) {
        return None;
    }
    let found = seen.modes.spindle.speed;
    let must = expected.spindle.speed.refuses(|may| same_speed(may, found, seen.slack))?;
    let found = found.map_or("no speed".to_string(), said_of_speed);
    Some(format!("the spindle has {found}, it should be {}", said_of_speed(must)))
}

fn unasked_speed(expected: &Expected, seen: &Seen) -> Option<String> {
    let speed = seen.modes.spindle.speed.filter(|_| !expected.naming.has_speed)?;
    Some(format!("the spindle has {}, none is asked for", said_of_speed(speed)))
}

/// What still waits for a motion need not be on.
fn spindle_again(expected: &Expected, seen: &Seen) -> Option<String> {
    let turns = seen.modes.spindle.turn != Spindle::Off && !expected.spindle.turn.waits();
    let is_missing = expected.restarts.spindle.is_asked && seen.modes.unsaid.spindle && turns;
    is_missing.then(|| format!("the spindle {AGAIN}"))
}

fn coolant_again(expected: &Expected, seen: &Seen) -> Option<String> {
    let flows = seen.modes.coolant.is_some() && !expected.coolant.waits();
    let is_missing = expected.restarts.coolant.is_asked && seen.modes.unsaid.coolant && flows;
    is_missing.then(|| format!("the coolant {AGAIN}"))
}

const AGAIN: &str = "is not switched on again after the tool change or stop";

fn speed_limit(expected: &Expected, seen: &Seen) -> Option<String> {
    let (must, found) = (expected.spindle.speed_limit?, seen.modes.spindle.speed_limit);
    if leads_in(expected, seen) {
        return None;
    }
    let is_wrong = match (must, found) {
        (Some(must), Some(limit)) => (must - limit).abs() > seen.slack.of(Quantity::Speed),
        (must, limit) => must.is_some() != limit.is_some(),
    };
    let name = |limit: Option<f64>| limit.map_or("none".to_string(), |s| s.to_string());
    is_wrong.then(|| {
        let (found, must) = (name(found), name(must));
        format!("the limit of the spindle speed is {found}, it should be {must}")
    })
}

/// The spindle that the program has chosen, and the other one.
fn master(expected: &Expected, seen: &Seen) -> Option<String> {
    let (must, found) = (expected.counted.side?, seen.modes.master);
    let name = |side: bool| if side { "the sub-spindle" } else { "the main spindle" };
    if found.is_side != Some(must) {
        let found = found.is_side.map_or("no spindle that was chosen", name);
        return Some(format!("the control counts {found}, it should count {}", name(must)));
    }
    let turns = expected.counted.other.turn.refuses(|turns| turns == found.other)?;
    let [found, turns] = [found.other, turns].map(name_of_turn);
    Some(format!("{} is {found}, it should be {turns}", name(!must)))
}

fn range(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = seen.modes.spindle.range;
    let must = expected.spindle.range.filter(|must| found != Some(*must))?;
    let found = found.map_or("none".to_string(), |range| range.to_string());
    Some(format!("spindle range {found} is chosen, it should be {must}"))
}

fn orientation(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = seen.modes.spindle.orientation;
    let near = |must: f64| found.is_some_and(|is| (is - must).abs() <= ANGLE);
    let must = expected.spindle.orientation.filter(|must| !near(*must))?;
    Some(format!("the spindle is not oriented at {must} degrees"))
}

fn coolant(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = seen.modes.coolant;
    let must = expected.coolant.refuses(|may| may == found)?;
    let [found, must] =
        [found, must].map(|code| code.map_or("off".to_string(), |m| format!("on by M{m}")));
    Some(format!("coolant is {found}, it should be {must}"))
}

fn work_offset(expected: &Expected, seen: &Seen) -> Option<String> {
    let found = seen.modes.frame.fixture;
    let must = expected.fixture.must.filter(|must| *must != found)?;
    let is_allowed = !expected.fixture.is_asked
        && found.is_some_and(|found| expected.fixture.allowed.contains(&found));
    let name = |fixture: Option<u32>| fixture.map_or("none".to_string(), name_of_offset);
    (!is_allowed).then(|| format!("work offset {}, it should be {}", name(found), name(must)))
}

fn same_speed(must: Speed, found: Option<Speed>, slack: &Tolerances) -> bool {
    match (must, found) {
        (Speed::Turns(must), Some(Speed::Turns(found))) => {
            (must - found).abs() <= slack.of(Quantity::Speed)
        }
        (Speed::Surface(must), Some(Speed::Surface(found))) => {
            (must - found).abs() <= slack.of(Quantity::SurfaceSpeed)
        }
        _ => false,
    }
}

fn said_of_speed(speed: Speed) -> String {
    match speed {
        Speed::Turns(speed) => format!("{} rpm", short(speed)),
        Speed::Surface(speed) => format!("a surface speed of {} m/min", short(speed)),
    }
}

pub(super) fn said_of_offset(found: Option<u32>, must: Option<u32>) -> String {
    match (found, must) {
        (Some(found), Some(must)) => {
            format!("length offset {found} is active, it should be {must}")
        }
        (Some(found), None) => {
            format!("length offset {found} is active, the CL file asks for none")
        }
        (None, Some(must)) => format!("no length offset is active, it should be {must}"),
        (None, None) => String::new(),
    }
}

type Side = (Compensation, Option<u32>);

fn said_of_compensation((found, offset): Side, (must, must_offset): Side) -> String {
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

fn said_of_spindle(found: Spindle, must: Spindle, cuts: bool) -> String {
    if found == Spindle::Off && cuts {
        return "the spindle is off while the tool cuts".to_string();
    }
    format!("the spindle is {}, it should be {}", name_of_turn(found), name_of_turn(must))
}

fn name_of_turn(turn: Spindle) -> &'static str {
    match turn {
        Spindle::Off => "off",
        Spindle::Clockwise => "clockwise",
        Spindle::Counterclockwise => "counterclockwise",
    }
}
