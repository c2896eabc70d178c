//! Settings that contradict each other: no machine is like that, and a program made
//! with them would be read otherwise than it is meant.

use fil_diag::{Diag, Result};

use crate::address::TapePosition;
use crate::axis_chain::AxisChain;
use crate::commons::{Commons, Dbl, Int, Rel};
use crate::errors::MachineCode;
use crate::letter::{Letter, letters};
use crate::locations::{self as loc, ToolChangeBlock};
use crate::setting::{CodeAt, LetterAt};

/// Codes of which no two may be the same: one motion, mode or command each.
const DIFFERENT: &[&[(CodeAt, &str)]] = &[
    &[
        (loc::RAPID_CODE_XY, "rapid motion"),
        (loc::LINEAR_CODE, "linear motion"),
        (loc::CIRCLE_CW_CODE, "clockwise arcs"),
        (loc::CIRCLE_CCW_CODE, "counterclockwise arcs"),
        (loc::DWELL_CODE, "a dwell"),
        (loc::CYCLE_OFF_CODE, "the end of a cycle"),
    ],
    &[(loc::RAPID_CODE_Z, "rapid motion of Z"), (loc::LINEAR_CODE, "linear motion")],
    &[(loc::ROTARY_RAPID_CODE, "rapid turns"), (loc::LINEAR_CODE, "linear motion")],
    &[
        (loc::CIRCLE_PLANE_XY, "the XY plane"),
        (loc::CIRCLE_PLANE_ZX, "the ZX plane"),
        (loc::CIRCLE_PLANE_YZ, "the YZ plane"),
    ],
    &[(loc::UNITS_METRIC_CODE, "millimetres"), (loc::UNITS_INCH_CODE, "inches")],
    &[
        (loc::MODE_ABSOLUTE_CODE, "absolute coordinates"),
        (loc::MODE_INCREMENTAL_CODE, "incremental coordinates"),
    ],
    &[(loc::FEED_UPM_CODE, "feed a minute"), (loc::FEED_UPR_CODE, "feed a revolution")],
    &[
        (loc::CUTCOM_OFF_CODE, "no compensation"),
        (loc::CUTCOM_LEFT_CODE, "compensation left"),
        (loc::CUTCOM_RIGHT_CODE, "compensation right"),
    ],
    &[
        (loc::CYCLE_RETURN_INITIAL_CODE, "return to the level before"),
        (loc::CYCLE_RETURN_CLEAR_CODE, "return to the R level"),
    ],
    &[
        (loc::SPINDLE_CW_CODE, "the spindle clockwise"),
        (loc::SPINDLE_CCW_CODE, "the spindle counterclockwise"),
        (loc::SPINDLE_STOP_CODE, "the spindle's stop"),
        (loc::TOOL_CHANGE_CODE, "a tool change"),
        (loc::PROGRAM_STOP_CODE, "a stop"),
        (loc::PROGRAM_OPSTOP_CODE, "an optional stop"),
        (loc::PROGRAM_END_CODE, "the end of the program"),
        (loc::PROGRAM_REWIND_CODE, "the end with rewind"),
        (loc::COOLANT_OFF_CODE, "coolant off"),
    ],
    &[(loc::COOLANT_OFF_CODE, "coolant off"), (loc::COOLANT_FLOOD_CODE, "flood coolant")],
    &[(loc::COOLANT_OFF_CODE, "coolant off"), (loc::COOLANT_MIST_CODE, "mist coolant")],
];

/// Numbers that must be above zero where they are given.
const POSITIVE: &[(Dbl, &str)] = &[
    (loc::FEED_UPM_FACTOR, "the factor of feeds"),
    (loc::CIRCLE_CHORD_TOLERANCE, "the chord tolerance"),
    (loc::SEQNO_INCREMENT, "the step of sequence numbers"),
    (loc::SEQNO_MAX, "the largest sequence number"),
    (loc::CIRCLE_MAX_RADIUS, "the largest radius"),
];

/// Numbers that must not be below zero where they are given.
const NOT_NEGATIVE: &[(Dbl, &str)] = &[
    (loc::FEED_UPM_MIN, "the least feed"),
    (loc::FEED_UPM_MAX, "the largest feed"),
    (loc::DWELL_UPM_FACTOR, "the factor of dwells in seconds"),
    (loc::DWELL_UPR_FACTOR, "the factor of dwells in turns"),
    (loc::CYCLE_AUTO_CLEARANCE, "the clearance of cycles"),
];

/// Refuses settings that contradict each other.
///
/// # Errors
/// The first contradiction, with the settings that make it.
pub fn check(commons: &Commons) -> Result<()> {
    match all(commons).into_iter().next() {
        Some(diag) => Err(Box::new(diag)),
        None => Ok(()),
    }
}

/// All contradictions of the settings.
pub fn all(commons: &Commons) -> Vec<Diag> {
    let mut found = Vec::new();
    for group in DIFFERENT {
        same_codes(commons, group, &mut found);
    }
    incremental_start(commons, &mut found);
    same_positions(commons, &mut found);
    axis_letters(commons, &mut found);
    word_letters(commons, &mut found);
    absent_axes(commons, &mut found);
    numbers(commons, &mut found);
    ranges(commons, &mut found);
    found
}

fn contradiction(message: String) -> Diag {
    Diag::new(MachineCode::Contradiction, message)
}

fn same_codes(commons: &Commons, group: &[(CodeAt, &str)], found: &mut Vec<Diag>) {
    for (index, (at, what)) in group.iter().enumerate() {
        let Some(code) = commons.read(*at) else { continue };
        let other = group[..index].iter().find(|(other, _)| commons.read(*other) == Some(code));
        if let Some((_, other)) = other {
            found.push(contradiction(format!("code {code} is both {other} and {what}")));
        }
    }
}

fn incremental_start(commons: &Commons, found: &mut Vec<Diag>) {
    let position = commons.read(loc::MODE_POSITION);
    if position.is_some() && position == commons.read(loc::MODE_INCREMENTAL_CODE) {
        found.push(contradiction(
            "mode.position is incremental, and the post writes absolute coordinates".into(),
        ));
    }
}

fn same_positions(commons: &Commons, found: &mut Vec<Diag>) {
    let position =
        |letter: Letter| TapePosition::numbered(commons.int(Int(u16::from(letter.number()))));
    for letter in Letter::all() {
        let Some(at) = position(letter) else { continue };
        let before = Letter::all().take_while(|other| *other < letter);
        if let Some(other) = before.into_iter().find(|other| position(*other) == Some(at)) {
            let at = at.index();
            found.push(contradiction(format!(
                "{other} and {letter} are both at tape position {at}"
            )));
        }
    }
}

/// The letters of rotary axes: neither each other's nor those of X, Y and Z.
fn axis_letters(commons: &Commons, found: &mut Vec<Diag>) {
    let rotary =
        [loc::ROTARY_PRIMARY_LETTER, loc::ROTARY_SECONDARY_LETTER].map(|at| commons.read(at));
    for letter in rotary.into_iter().flatten() {
        if letters::XYZ.contains(&letter) {
            found.push(contradiction(format!("{letter} is a linear and a rotary axis")));
        }
    }
    if rotary[0].is_some() && rotary[0] == rotary[1] {
        found.push(contradiction("both rotary axes have the same letter".into()));
    }
}

/// Letters of words that may stand in a block together: different, and neither an
/// axis nor a function.
fn word_letters(commons: &Commons, found: &mut Vec<Diag>) {
    let of = |at: LetterAt| commons.read(at);
    let taken = |letter: Letter| {
        letters::XYZ.contains(&letter) || [letters::G, letters::M, letters::N].contains(&letter)
    };
    let named = [
        (loc::CYCLE_STEP_ADDRESS, "the peck"),
        (loc::CYCLE_DWELL_ADDRESS, "the dwell of a cycle"),
        (loc::CIRCLE_RADIUS_ADDRESS, "the radius"),
        (loc::CUTCOM_ADDRESS, "the cutter offset"),
    ];
    for (at, what) in named {
        if let Some(letter) = of(at).filter(|letter| taken(*letter)) {
            found.push(contradiction(format!("{letter} is {what} and something else")));
        }
    }
    if let (Some(step), Some(dwell)) = (of(named[0].0), of(named[1].0))
        && step == dwell
    {
        found.push(contradiction(format!("{step} is both the peck and the dwell of a cycle")));
    }
}

/// Settings of rotary axes that the machine does not have. A zero is what files of
/// machines without the axis hold.
fn absent_axes(commons: &Commons, found: &mut Vec<Diag>) {
    let Ok(chain) = AxisChain::from_commons(commons) else { return };
    let has = |axis: usize| chain.rotaries.iter().flatten().any(|rotary| rotary.axis == axis);
    let goes = commons.read(loc::TOOL_CHANGE_BLOCK) == ToolChangeBlock::XyzAndRotary;
    let positions = loc::CHANGE_POSITION[3..].iter().filter(|_| goes);
    let shifts = [loc::OUTPUT_TRANSLATE_A, loc::OUTPUT_TRANSLATE_B, loc::OUTPUT_TRANSLATE_C];
    let named = positions.map(|at| ("tool.change", *at)).enumerate();
    let named = named.chain(shifts.map(|at| ("output.translate", at)).into_iter().enumerate());
    for (axis, (what, at)) in named.filter(|(axis, _)| !has(*axis)) {
        if let Some(value) = commons.dbl_opt(at).filter(|value| *value != 0.0) {
            let letter = ['a', 'b', 'c'][axis];
            found.push(contradiction(format!(
                "{what}_{letter} is {value}, and the machine has no axis {}",
                letter.to_ascii_uppercase()
            )));
        }
    }
}

fn numbers(commons: &Commons, found: &mut Vec<Diag>) {
    for (at, what) in POSITIVE {
        if let Some(value) = commons.read(*at).filter(|value| *value <= 0.0) {
            found.push(contradiction(format!("{what} is {value}, it must be above zero")));
        }
    }
    for (at, what) in NOT_NEGATIVE {
        if let Some(value) = commons.read(*at).filter(|value| *value < 0.0) {
            found.push(contradiction(format!("{what} is {value}, it must not be below zero")));
        }
    }
}

/// Lowest and highest values that are the wrong way round.
fn ranges(commons: &Commons, found: &mut Vec<Diag>) {
    let mut range = |low: Option<f64>, high: Option<f64>, what: &str| {
        if let (Some(low), Some(high)) = (low, high)
            && low > high
        {
            found.push(contradiction(format!(
                "{what}: the least, {low}, is above the most, {high}"
            )));
        }
    };
    let dbl = |at: Dbl| commons.read(at);
    let rel = |at: Rel| commons.read(at);
    for ((low, high), name) in loc::LINEAR_LIMITS.into_iter().zip(letters::XYZ) {
        range(dbl(low), dbl(high), &format!("travel of {name}"));
    }
    range(dbl(loc::FEED_UPM_MIN), dbl(loc::FEED_UPM_MAX), "feed");
    range(dbl(loc::ROTARY_PRIMARY_MIN), dbl(loc::ROTARY_PRIMARY_MAX), "first rotary axis");
    range(dbl(loc::ROTARY_SECONDARY_MIN), dbl(loc::ROTARY_SECONDARY_MAX), "second rotary axis");
    for (index, (low, high)) in loc::RANGE_SPEEDS.into_iter().enumerate() {
        range(rel(low), rel(high), &format!("spindle range {}", index + 1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::apply_setting;
    use crate::locations::default_commons;

    #[test]
    fn the_default_machine_does_not_contradict_itself() {
        assert!(check(&default_commons()).is_ok());
    }

    #[test]
    fn positions_of_axes_that_the_machine_has_are_taken() {
        let axis = "rotary.primary_kind=1\nrotary.primary_letter=B\nrotary.primary_axis=2";
        for setting in ["tool.change_block=2\ntool.change_b=10", "output.translate_b=5"] {
            let mut commons = default_commons();
            for part in axis.lines().chain(setting.lines()) {
                apply_setting(&mut commons, part).unwrap();
            }
            assert!(check(&commons).is_ok(), "{setting}");
        }
    }

    #[test]
    fn contradictions_are_found() {
        for setting in [
            "circle.cw_code=3",
            "linear.code=0",
            "mode.position=91",
            "int.5=3",
            "feed.upm_factor=-1",
            "limits.x_min=5\nlimits.x_max=1",
            "cycle.dwell_address=Q",
            "rotary.primary_letter=X",
            "spindle.stop_code=3",
            "tool.change_block=2\ntool.change_b=10",
            "output.translate_c=5",
        ] {
            let mut commons = default_commons();
            for part in setting.lines() {
                apply_setting(&mut commons, part).unwrap();
            }
            let refused = check(&commons).expect_err(setting);
            assert_eq!(refused.code.name(), "E0607", "{setting}: {refused}");
        }
    }
}
