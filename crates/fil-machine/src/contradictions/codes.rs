//! Codes that would mean two things.

use fil_diag::Diag;

use super::contradiction;
use crate::commons::{Commons, Int};
use crate::locations::{self as loc, ControlFamily, CycleReturnCodes};
use crate::setting::CodeAt;

/// Codes of which no two may be the same: one motion, mode or command each.
const DIFFERENT: &[&[(CodeAt, &str)]] = &[
    &[
        (loc::RAPID_CODE_XY, "rapid motion"),
        (loc::LINEAR_CODE, "linear motion"),
        (loc::CIRCLE_CW_CODE, "clockwise arcs"),
        (loc::CIRCLE_CCW_CODE, "counterclockwise arcs"),
        (loc::THREAD_CODE, "a thread"),
        (loc::THREAD_CYCLE_CODE, "the cycle of a thread"),
        (loc::DWELL_CODE, "a dwell"),
        (loc::CYCLE_OFF_CODE, "the end of a cycle"),
    ],
    &[(loc::SPINDLE_CSS_CODE, "surface speed"), (loc::SPINDLE_RPM_CODE, "revolutions a minute")],
    &[
        (loc::CYCLE_DRILL_CODE, "drilling"),
        (loc::CYCLE_TAP_CODE, "tapping"),
        (loc::CYCLE_DEEP_CODE, "deep drilling"),
    ],
    &[
        (loc::CYCLE_DRILL_CODE, "drilling"),
        (loc::CYCLE_TAP_CODE, "tapping"),
        (loc::CYCLE_BRKCHP_CODE, "chip breaking"),
    ],
    &[
        (loc::CYCLE_DRILL_CODE, "drilling"),
        (loc::CYCLE_TAP_LEFT_CODE, "tapping of left-hand threads"),
        (loc::CYCLE_DEEP_CODE, "deep drilling"),
    ],
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
    &[
        (loc::FEED_UPM_CODE, "feed a minute"),
        (loc::FEED_UPR_CODE, "feed a revolution"),
        (loc::FEED_INVERSE_CODE, "inverse time"),
    ],
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
        (loc::THREAD_CHAMFER_ON_CODE, "the way out of threads"),
        (loc::THREAD_CHAMFER_OFF_CODE, "threads to their end"),
    ],
    COMMANDS,
];

/// Preparatory functions by the mode they set: no code may be of two modes.
const MODES: &[(&str, &[CodeAt])] = &[
    ("a motion", &loc::MOTION_CODES),
    ("a plane", &[loc::CIRCLE_PLANE_XY, loc::CIRCLE_PLANE_ZX, loc::CIRCLE_PLANE_YZ]),
    ("a unit", &[loc::UNITS_METRIC_CODE, loc::UNITS_INCH_CODE]),
    ("a feed mode", &[loc::FEED_UPM_CODE, loc::FEED_UPR_CODE, loc::FEED_INVERSE_CODE]),
    ("cutter compensation", &[loc::CUTCOM_OFF_CODE, loc::CUTCOM_LEFT_CODE, loc::CUTCOM_RIGHT_CODE]),
    ("the tool length", &[loc::TOOL_LENGTH_CODE]),
    ("a speed mode", &[loc::SPINDLE_CSS_CODE, loc::SPINDLE_RPM_CODE]),
    ("a dwell", &[loc::DWELL_CODE]),
    ("the end of a cycle", &[loc::CYCLE_OFF_CODE]),
    ("a cycle", &loc::CYCLE_CODES),
    ("the kind of coordinates", &[loc::MODE_ABSOLUTE_CODE, loc::MODE_INCREMENTAL_CODE]),
];

/// Preparatory functions in tenths, which are those of no mode either.
const IN_TENTHS: &[(Int, &str)] = &[
    (loc::ROTARY_TIP_CODE, "tool-tip control"),
    (loc::ROTARY_VECTOR_CODE, "directions of the tool as vectors"),
    (loc::ROTARY_FRAME_CODE, "a tilted frame"),
    (loc::ROTARY_FRAME_ALIGN_CODE, "a turn into a tilted frame"),
    (loc::MILL_TURN_POLAR_CODE, "polar interpolation"),
    (loc::MILL_TURN_POLAR_END_CODE, "the end of polar interpolation"),
    (loc::MILL_TURN_CYLINDER_CODE, "cylindrical interpolation"),
];

/// Auxiliary functions by what they command: no code may command two such things.
const FUNCTIONS: &[(&str, &[CodeAt])] = &[
    (
        "a stop or an end",
        &[
            loc::PROGRAM_STOP_CODE,
            loc::PROGRAM_OPSTOP_CODE,
            loc::PROGRAM_END_CODE,
            loc::PROGRAM_REWIND_CODE,
        ],
    ),
    (
        "the spindle",
        &[
            loc::SPINDLE_CW_CODE,
            loc::SPINDLE_CCW_CODE,
            loc::SPINDLE_STOP_CODE,
            loc::SPINDLE_ORIENT_CODE,
            loc::SPINDLE_DEFAULT_CODE,
        ],
    ),
    ("a range of the spindle", &loc::RANGE_CODES),
    ("a tool change", &[loc::TOOL_CHANGE_CODE]),
    (
        "the coolant",
        &[
            loc::COOLANT_OFF_CODE,
            loc::COOLANT_DEFAULT_CODE,
            loc::COOLANT_MIST_CODE,
            loc::COOLANT_TAP_CODE,
            loc::COOLANT_AIR_CODE,
            loc::COOLANT_FLOOD_CODE,
            loc::COOLANT_FLOOD_LOW_CODE,
            loc::COOLANT_FLOOD_MEDIUM_CODE,
            loc::COOLANT_FLOOD_HIGH_CODE,
            loc::COOLANT_THRU_LOW_CODE,
            loc::COOLANT_THRU_MEDIUM_CODE,
            loc::COOLANT_THRU_HIGH_CODE,
        ],
    ),
    ("the override of the feed", &[loc::OVERRIDE_ON_CODE, loc::OVERRIDE_OFF_CODE]),
    ("a clamp", &[loc::ROTARY_CLAMP_CODE, loc::ROTARY_UNCLAMP_CODE]),
    ("a rigid tap", &[loc::CYCLE_RIGID_TAP_MODE]),
    ("the way out of threads", &[loc::THREAD_CHAMFER_ON_CODE, loc::THREAD_CHAMFER_OFF_CODE]),
    (
        "the spindle that is counted",
        &[loc::SPINDLE_SIDE_MASTER_CODE, loc::SPINDLE_MAIN_MASTER_CODE],
    ),
];

/// Commands of M, which no coolant may share either.
const COMMANDS: &[(CodeAt, &str)] = &[
    (loc::SPINDLE_CW_CODE, "the spindle clockwise"),
    (loc::SPINDLE_CCW_CODE, "the spindle counterclockwise"),
    (loc::SPINDLE_STOP_CODE, "the spindle's stop"),
    (loc::SPINDLE_ORIENT_CODE, "the spindle's orientation"),
    (loc::TOOL_CHANGE_CODE, "a tool change"),
    (loc::PROGRAM_STOP_CODE, "a stop"),
    (loc::PROGRAM_OPSTOP_CODE, "an optional stop"),
    (loc::PROGRAM_END_CODE, "the end of the program"),
    (loc::PROGRAM_REWIND_CODE, "the end with rewind"),
    (loc::COOLANT_OFF_CODE, "coolant off"),
];

/// Coolants; two may share a code.
const COOLANTS: &[(CodeAt, &str)] =
    &[(loc::COOLANT_FLOOD_CODE, "flood coolant"), (loc::COOLANT_MIST_CODE, "mist coolant")];

/// Finds codes of two motions, modes or commands.
pub(super) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    for group in DIFFERENT {
        same_codes(commons, group, found);
    }
    rapid_codes(commons, found);
    tapping_codes(commons, found);
    codes_of_two_groups(commons, 'G', MODES, found);
    codes_of_two_groups(commons, 'M', FUNCTIONS, found);
    codes_in_tenths(commons, found);
    return_levels(commons, found);
    calls(commons, found);
    coolants(commons, found);
    turns_behind_surface_speed(commons, found);
    way_out_of_threads(commons, found);
}

/// The way out of threads has two codes, and a length only with them.
fn way_out_of_threads(commons: &Commons, found: &mut Vec<Diag>) {
    let codes = [loc::THREAD_CHAMFER_ON_CODE, loc::THREAD_CHAMFER_OFF_CODE];
    let [on, off] = codes.map(|at| commons.read(at).is_some());
    let tenths = commons.int_opt(loc::THREAD_CHAMFER_TENTHS);
    if on != off {
        found.push(contradiction(
            "thread.chamfer_on_code and thread.chamfer_off_code: one of them is not there, and \
             the control goes on as the other one left it"
                .into(),
        ));
    } else if tenths.is_some() && !on {
        found.push(contradiction(
            "thread.chamfer_tenths is what M codes switch, and thread.chamfer_on_code is not there"
                .into(),
        ));
    } else if tenths.is_some_and(|tenths| !(1..=99).contains(&tenths)) {
        found.push(contradiction("thread.chamfer_tenths is none of 1 to 99".into()));
    }
}

/// What ends a surface speed: without a code for it, S would go on as one.
fn turns_behind_surface_speed(commons: &Commons, found: &mut Vec<Diag>) {
    let Some(code) = commons.read(loc::SPINDLE_CSS_CODE) else { return };
    if commons.read(loc::SPINDLE_RPM_CODE).is_none() {
        found.push(contradiction(format!(
            "spindle.css_code G{code} makes S a surface speed, and no spindle.rpm_code makes it \
             turns a minute again"
        )));
    }
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

/// The rapid motion of Z and that of turns may have the code of the one across, and no other.
fn rapid_codes(commons: &Commons, found: &mut Vec<Diag>) {
    let rapids =
        [(loc::RAPID_CODE_Z, "rapid motion of Z"), (loc::ROTARY_RAPID_CODE, "rapid turns")];
    for (at, what) in rapids {
        let Some(code) = commons.read(at) else { continue };
        let others = DIFFERENT[0].iter().filter(|(other, _)| *other != loc::RAPID_CODE_XY);
        for (_, other) in others.filter(|(other, _)| commons.read(*other) == Some(code)) {
            found.push(contradiction(format!("code {code} is both {other} and {what}")));
        }
    }
}

/// A tap turns back at the bottom; no hole without a thread has its code.
fn tapping_codes(commons: &Commons, found: &mut Vec<Diag>) {
    // The first groups of DIFFERENT say it of drilling, deep drilling and chip breaking.
    let others = [
        (loc::CYCLE_CSINK_CODE, "countersinking"),
        (loc::CYCLE_BORE_CODE, "boring"),
        (loc::CYCLE_REAM_CODE, "reaming"),
        (loc::CYCLE_FACE_CODE, "facing"),
        (loc::CYCLE_THRU_CODE, "drilling through"),
        (loc::CYCLE_MILL_CODE, "milling of holes"),
    ];
    for at in [loc::CYCLE_TAP_CODE, loc::CYCLE_TAP_LEFT_CODE] {
        let Some(code) = commons.read(at) else { continue };
        for (_, other) in others.iter().filter(|(other, _)| commons.read(*other) == Some(code)) {
            found.push(contradiction(format!("code {code} is both tapping and {other}")));
        }
    }
}

/// No code of one of these groups is one of another.
fn codes_of_two_groups(
    commons: &Commons,
    letter: char,
    groups: &[(&str, &[CodeAt])],
    found: &mut Vec<Diag>,
) {
    for (index, (what, group)) in groups.iter().enumerate() {
        for code in group.iter().filter_map(|at| commons.read(*at)) {
            if let Some(other) = group_of(commons, code, &groups[..index]) {
                found.push(contradiction(format!("{letter}{code} is both {other} and {what}")));
            }
        }
    }
}

fn group_of<'g>(commons: &Commons, code: i32, groups: &[(&'g str, &[CodeAt])]) -> Option<&'g str> {
    let has = |group: &[CodeAt]| group.iter().any(|at| commons.read(*at) == Some(code));
    groups.iter().find(|(_, group)| has(group)).map(|(what, _)| *what)
}

fn codes_in_tenths(commons: &Commons, found: &mut Vec<Diag>) {
    for (at, what) in IN_TENTHS {
        let Some(tenths) = commons.int_opt(*at).filter(|tenths| tenths % 10 == 0) else { continue };
        if let Some(other) = group_of(commons, tenths / 10, MODES) {
            found.push(contradiction(format!("G{} is both {other} and {what}", tenths / 10)));
        }
    }
}

/// A control that returns from holes by code means nothing else by it.
fn return_levels(commons: &Commons, found: &mut Vec<Diag>) {
    // A machine without a tapping cycle has none for left-hand threads either.
    let mut cycles = loc::CYCLE_CODES.iter().filter(|at| **at != loc::CYCLE_TAP_LEFT_CODE);
    if !cycles.any(|at| commons.read(*at).is_some())
        || commons.read(loc::CYCLE_RETURN_CODES) == CycleReturnCodes::No
        || commons.read(loc::CONTROL_FAMILY) != ControlFamily::WordAddress
    {
        return;
    }
    let levels = [loc::CYCLE_RETURN_INITIAL_CODE, loc::CYCLE_RETURN_CLEAR_CODE];
    for code in levels.iter().filter_map(|at| commons.read(*at)) {
        if let Some(what) = group_of(commons, code, MODES) {
            let mut diag = contradiction(format!(
                "G{code} is both {what} and the level that cycles return to"
            ));
            diag.hint = Some(
                "cycle.return_codes = 1 leaves the level out, as on lathes, where G98 and G99 are \
                 feeds."
                    .into(),
            );
            found.push(diag);
        }
    }
}

/// No command of the machine calls a program or goes back from one; the end of a program may.
fn calls(commons: &Commons, found: &mut Vec<Diag>) {
    const CALLS: [i32; 4] = [97, 98, 99, 198];
    let ends = |at: &CodeAt| [loc::PROGRAM_END_CODE, loc::PROGRAM_REWIND_CODE].contains(at);
    for (at, what) in COMMANDS.iter().chain(COOLANTS).filter(|(at, _)| !ends(at)) {
        if let Some(code) = commons.read(*at).filter(|code| CALLS.contains(code)) {
            found.push(contradiction(format!("M{code} calls programs, and is {what} here")));
        }
    }
}

fn coolants(commons: &Commons, found: &mut Vec<Diag>) {
    for (at, what) in COOLANTS {
        let code = commons.read(*at);
        let other =
            COMMANDS.iter().find(|(other, _)| code.is_some() && commons.read(*other) == code);
        if let (Some(code), Some((_, other))) = (code, other) {
            found.push(contradiction(format!("code {code} is both {other} and {what}")));
        }
    }
}
