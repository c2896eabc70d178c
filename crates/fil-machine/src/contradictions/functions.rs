//! Every setting that names a preparatory (G) or auxiliary (M) function, with what it means.
//!
//! No number stands for two of these meanings, nor for one of them and for what each control of
//! the family does by it. A setting of unit `code` that is in no list here fails a test.

use super::function_rules as rules;
use crate::commons::{Commons, Int};
use crate::locations as loc;
use crate::setting::CodeAt;

/// Whose numbers a group's are: two groups share them.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Space {
    /// Preparatory functions.
    G,
    /// Auxiliary functions.
    M,
    /// Cycles: preparatory functions in word address, numbers of calls elsewhere.
    Cycle,
}

/// The number of a setting, and what it stands for.
pub(super) struct Row {
    pub at: At,
    pub what: &'static str,
}

/// How a setting holds its number.
#[derive(Clone, Copy)]
pub(super) enum At {
    Whole(CodeAt),
    /// In tenths: 541 is G54.1.
    Tenths(Int),
}

/// Functions of one kind.
pub(super) struct Group {
    pub space: Space,
    /// What the numbers of `fixed` stand for.
    pub name: &'static str,
    pub rows: &'static [Row],
    /// Numbers that stand for it on each control of words, unless the settings name others.
    pub fixed: &'static [u16],
    /// The same of a SINUMERIK.
    pub sinumerik: &'static [u16],
    /// The machine has such functions.
    pub acts: fn(&Commons) -> bool,
}

const fn whole(at: CodeAt, what: &'static str) -> Row {
    Row { at: At::Whole(at), what }
}

const fn tenths(at: Int, what: &'static str) -> Row {
    Row { at: At::Tenths(at), what }
}

const fn g(name: &'static str, rows: &'static [Row], fixed: &'static [u16]) -> Group {
    Group { space: Space::G, name, rows, fixed, sinumerik: fixed, acts: rules::always }
}

const fn m(name: &'static str, rows: &'static [Row], fixed: &'static [u16]) -> Group {
    Group { space: Space::M, ..g(name, rows, fixed) }
}

const HOLE: &str = "a hole";
const LIVE_HOLE: &str = "a hole by a live tool";
const DEEP: &str = "deep drilling";
const CHIPS: &str = "chip breaking";
const TAP: &str = "tapping";
const PRESET: &str = "a preset of the axes";
const MAX: &str = "the limit of the speed";
const THREAD_CYCLE: &str = "the cycle of a thread";
const CLOCKWISE: &str = "the spindle clockwise";
const COUNTERCLOCKWISE: &str = "the spindle counterclockwise";
const USUAL_WAY: &str = "the usual way of the spindle";
const STOP: &str = "the spindle's stop";
const SPINDLE: &str = "the spindle";
const TURNING: &str = "the way back to turning";
const END: &str = "the end of the program";
const REWIND: &str = "the end with rewind";
const CALL: &str = "a call of a program";
const LENGTH: &str = "the length of the tool";
const LENGTH_OFF: &str = "the end of the tool's length";
const OSP_LENGTH: &str = "the lengths of tools by G53 to G59";
const COOLANT_ON: &str = "coolant";

/// Meanings that may have one number: a control tells them apart by the other words of the
/// block, or they are one to it.
pub(super) const MAY_SHARE: &[(&str, &str)] = &[
    (PRESET, MAX),
    (PRESET, THREAD_CYCLE),
    (DEEP, CHIPS),
    (HOLE, LIVE_HOLE),
    (DEEP, LIVE_HOLE),
    (CHIPS, LIVE_HOLE),
    (CLOCKWISE, USUAL_WAY),
    (COUNTERCLOCKWISE, USUAL_WAY),
    // M5 of a SINUMERIK makes the axis C the spindle again.
    (STOP, TURNING),
    (SPINDLE, TURNING),
    // M99 ends a program as well.
    (CALL, END),
    (CALL, REWIND),
    (OSP_LENGTH, LENGTH),
    (OSP_LENGTH, LENGTH_OFF),
];

pub(super) const GROUPS: &[Group] = &[
    g(
        "a motion",
        &[
            whole(loc::RAPID_CODE_XY, "rapid motion"),
            whole(loc::RAPID_CODE_Z, "rapid motion"),
            whole(loc::ROTARY_RAPID_CODE, "rapid motion"),
            whole(loc::LINEAR_CODE, "linear motion"),
            whole(loc::CIRCLE_CW_CODE, "clockwise arcs"),
            whole(loc::CIRCLE_CCW_CODE, "counterclockwise arcs"),
        ],
        &[0, 1, 2, 3],
    ),
    g(
        "a thread",
        &[
            whole(loc::THREAD_CODE, "a thread"),
            whole(loc::THREAD_VARYING_CODE, "a thread of another lead"),
        ],
        &[],
    ),
    // CYCLE97 of a SINUMERIK is a call.
    Group {
        space: Space::Cycle,
        ..g(THREAD_CYCLE, &[whole(loc::THREAD_CYCLE_CODE, THREAD_CYCLE)], &[])
    },
    g("a dwell", &[whole(loc::DWELL_CODE, "a dwell")], &[4]),
    g(
        "a plane",
        &[
            whole(loc::CIRCLE_PLANE_XY, "the XY plane"),
            whole(loc::CIRCLE_PLANE_ZX, "the ZX plane"),
            whole(loc::CIRCLE_PLANE_YZ, "the YZ plane"),
        ],
        &[17, 18, 19],
    ),
    Group {
        sinumerik: &[70, 71, 700, 710],
        ..g(
            "a unit",
            &[whole(loc::UNITS_METRIC_CODE, "millimetres"), whole(loc::UNITS_INCH_CODE, "inches")],
            &[20, 21],
        )
    },
    Group { sinumerik: &[], ..g("the way to a reference point", &[], &[28, 30]) },
    g(
        "cutter compensation",
        &[
            whole(loc::CUTCOM_OFF_CODE, "no compensation"),
            whole(loc::CUTCOM_LEFT_CODE, "compensation left"),
            whole(loc::CUTCOM_RIGHT_CODE, "compensation right"),
        ],
        &[40, 41, 42],
    ),
    Group {
        sinumerik: &[],
        ..g(
            LENGTH,
            &[
                whole(loc::TOOL_LENGTH_CODE, LENGTH),
                whole(loc::TOOL_LENGTH_CANCEL_CODE, LENGTH_OFF),
            ],
            &[43, 49],
        )
    },
    Group {
        acts: rules::lengths_by_g54,
        sinumerik: &[],
        ..g(OSP_LENGTH, &[], &[53, 54, 55, 56, 57, 58, 59])
    },
    Group { acts: rules::no_lengths_by_g54, ..g("the frame of the machine", &[], &[53]) },
    Group {
        acts: rules::no_lengths_by_g54,
        sinumerik: &[54, 55, 56, 57, 500],
        ..g(rules::FIXTURE, &[], &[54, 55, 56, 57, 58, 59])
    },
    g(
        "a work offset with a number",
        &[tenths(loc::FIXTURE_EXTENDED_CODE, "a work offset with a number")],
        &[],
    ),
    Group {
        sinumerik: &[],
        ..g("the end of a cycle", &[whole(loc::CYCLE_OFF_CODE, "the end of a cycle")], &[80])
    },
    Group {
        space: Space::Cycle,
        sinumerik: &[],
        ..g(
            "a cycle",
            &[
                whole(loc::CYCLE_DRILL_CODE, HOLE),
                whole(loc::CYCLE_CSINK_CODE, HOLE),
                whole(loc::CYCLE_BORE_CODE, HOLE),
                whole(loc::CYCLE_REAM_CODE, HOLE),
                whole(loc::CYCLE_THRU_CODE, HOLE),
                whole(loc::CYCLE_FACE_CODE, HOLE),
                whole(loc::CYCLE_MILL_CODE, HOLE),
                whole(loc::CYCLE_DEEP_CODE, DEEP),
                whole(loc::CYCLE_BRKCHP_CODE, CHIPS),
                whole(loc::CYCLE_TAP_CODE, TAP),
                tenths(loc::CYCLE_RIGID_TAP_CODE, TAP),
            ],
            &[81, 82, 83, 84, 85, 86, 87, 88, 89],
        )
    },
    // A machine without a tapping cycle has none for left-hand threads either.
    Group {
        space: Space::Cycle,
        acts: rules::has_taps,
        ..g(
            "a cycle",
            &[whole(loc::CYCLE_TAP_LEFT_CODE, TAP), tenths(loc::CYCLE_RIGID_TAP_LEFT_CODE, TAP)],
            &[],
        )
    },
    Group {
        space: Space::Cycle,
        ..g(
            "a cycle",
            &[
                whole(loc::MILL_TURN_FACE_DRILL_CODE, LIVE_HOLE),
                whole(loc::MILL_TURN_SIDE_DRILL_CODE, LIVE_HOLE),
                whole(loc::MILL_TURN_FACE_TAP_CODE, TAP),
                whole(loc::MILL_TURN_SIDE_TAP_CODE, TAP),
                whole(loc::MILL_TURN_FACE_TAP_LEFT_CODE, TAP),
                whole(loc::MILL_TURN_SIDE_TAP_LEFT_CODE, TAP),
            ],
            &[],
        )
    },
    Group {
        acts: rules::returns_by_codes,
        sinumerik: &[],
        ..g(
            rules::RETURN,
            &[
                whole(loc::CYCLE_RETURN_INITIAL_CODE, "return to the level before"),
                whole(loc::CYCLE_RETURN_CLEAR_CODE, "return to the R level"),
            ],
            &[98, 99],
        )
    },
    g(
        "the kind of coordinates",
        &[
            whole(loc::MODE_ABSOLUTE_CODE, "absolute coordinates"),
            whole(loc::MODE_INCREMENTAL_CODE, "incremental coordinates"),
        ],
        &[90, 91],
    ),
    Group {
        acts: rules::has_presets,
        sinumerik: &[],
        ..g(PRESET, &[whole(loc::MODE_PRESET_CODE, PRESET)], &[92])
    },
    g(
        "a feed mode",
        &[
            whole(loc::FEED_UPM_CODE, "feed a minute"),
            whole(loc::FEED_UPR_CODE, "feed a revolution"),
            whole(loc::FEED_INVERSE_CODE, "inverse time"),
        ],
        &[93, 94, 95],
    ),
    g(
        "a speed mode",
        &[
            whole(loc::SPINDLE_CSS_CODE, "surface speed"),
            whole(loc::SPINDLE_RPM_CODE, "revolutions a minute"),
        ],
        &[96, 97],
    ),
    g(MAX, &[whole(loc::SPINDLE_MAX_CODE, MAX)], &[]),
    g("diameters", &[whole(loc::LATHE_DIAMETER_CODE, "diameters")], &[]),
    g(
        "tool-tip control",
        &[
            tenths(loc::ROTARY_TIP_CODE, "tool-tip control"),
            tenths(loc::ROTARY_VECTOR_CODE, "directions of the tool as vectors"),
        ],
        &[],
    ),
    g(
        "a tilted frame",
        &[
            tenths(loc::ROTARY_FRAME_CODE, "a tilted frame"),
            tenths(loc::ROTARY_FRAME_ALIGN_CODE, "a turn into a tilted frame"),
            whole(loc::ROTARY_FRAME_CANCEL_CODE, "the end of a tilted frame"),
        ],
        &[],
    ),
    g(
        "an interpolation of a live tool",
        &[
            tenths(loc::MILL_TURN_POLAR_CODE, "polar interpolation"),
            tenths(loc::MILL_TURN_POLAR_END_CODE, "the end of polar interpolation"),
            tenths(loc::MILL_TURN_CYLINDER_CODE, "cylindrical interpolation"),
        ],
        &[],
    ),
    m(
        "a stop or an end",
        &[
            whole(loc::PROGRAM_STOP_CODE, "a stop"),
            whole(loc::PROGRAM_OPSTOP_CODE, "an optional stop"),
            whole(loc::PROGRAM_END_CODE, END),
            whole(loc::PROGRAM_REWIND_CODE, REWIND),
        ],
        &[0, 1, 2, 30],
    ),
    m(CALL, &[], &[97, 98, 99, 198]),
    m(
        SPINDLE,
        &[
            whole(loc::SPINDLE_CW_CODE, CLOCKWISE),
            whole(loc::SPINDLE_CCW_CODE, COUNTERCLOCKWISE),
            whole(loc::SPINDLE_DEFAULT_CODE, USUAL_WAY),
            whole(loc::SPINDLE_STOP_CODE, STOP),
            whole(loc::SPINDLE_ORIENT_CODE, "the spindle's orientation"),
            // Under MODE/MILL the spindle of a SINUMERIK is that of the live tool.
            whole(loc::MILL_TURN_LIVE_CW_CODE, CLOCKWISE),
            whole(loc::MILL_TURN_LIVE_CCW_CODE, COUNTERCLOCKWISE),
            whole(loc::MILL_TURN_LIVE_STOP_CODE, STOP),
        ],
        &[3, 4, 5],
    ),
    m(
        "the second spindle",
        &[
            whole(loc::SPINDLE_SIDE_CW_CODE, "the second spindle clockwise"),
            whole(loc::SPINDLE_SIDE_CCW_CODE, "the second spindle counterclockwise"),
            whole(loc::SPINDLE_SIDE_STOP_CODE, "the second spindle's stop"),
        ],
        &[],
    ),
    m(
        "the spindle that is counted",
        &[
            whole(loc::SPINDLE_SIDE_MASTER_CODE, "the count of the second spindle"),
            whole(loc::SPINDLE_MAIN_MASTER_CODE, "the count of the main spindle"),
        ],
        &[],
    ),
    m(
        "the work of a mill-turn machine",
        &[
            whole(loc::MILL_TURN_MILLING_CODE, "the way to milling"),
            whole(loc::MILL_TURN_TURNING_CODE, TURNING),
        ],
        &[],
    ),
    m(
        "a range of the spindle",
        &[
            whole(loc::SPINDLE_RANGE1_CODE, "a range of the spindle"),
            whole(loc::SPINDLE_RANGE2_CODE, "a range of the spindle"),
            whole(loc::SPINDLE_RANGE3_CODE, "a range of the spindle"),
            whole(loc::SPINDLE_RANGE4_CODE, "a range of the spindle"),
            whole(loc::SPINDLE_RANGE5_CODE, "a range of the spindle"),
            whole(loc::SPINDLE_RANGE6_CODE, "a range of the spindle"),
        ],
        &[],
    ),
    m("a tool change", &[whole(loc::TOOL_CHANGE_CODE, "a tool change")], &[6]),
    m(
        COOLANT_ON,
        &[
            whole(loc::COOLANT_OFF_CODE, "coolant off"),
            whole(loc::COOLANT_DEFAULT_CODE, COOLANT_ON),
            whole(loc::COOLANT_MIST_CODE, COOLANT_ON),
            whole(loc::COOLANT_TAP_CODE, COOLANT_ON),
            whole(loc::COOLANT_AIR_CODE, COOLANT_ON),
            whole(loc::COOLANT_FLOOD_CODE, COOLANT_ON),
            whole(loc::COOLANT_FLOOD_LOW_CODE, COOLANT_ON),
            whole(loc::COOLANT_FLOOD_MEDIUM_CODE, COOLANT_ON),
            whole(loc::COOLANT_FLOOD_HIGH_CODE, COOLANT_ON),
            whole(loc::COOLANT_THRU_LOW_CODE, COOLANT_ON),
            whole(loc::COOLANT_THRU_MEDIUM_CODE, COOLANT_ON),
            whole(loc::COOLANT_THRU_HIGH_CODE, COOLANT_ON),
        ],
        &[7, 8, 9],
    ),
    m(
        "the override of the feed",
        &[
            whole(loc::OVERRIDE_ON_CODE, "the override of the operator"),
            whole(loc::OVERRIDE_OFF_CODE, "feeds without override"),
        ],
        &[48, 49],
    ),
    m(
        "a clamp",
        &[
            whole(loc::ROTARY_CLAMP_CODE, "the clamp of the rotary axes"),
            whole(loc::ROTARY_UNCLAMP_CODE, "the release of the rotary axes"),
        ],
        &[],
    ),
    m("a rigid tap", &[whole(loc::CYCLE_RIGID_TAP_MODE, "a rigid tap")], &[]),
    m(
        "the way out of threads",
        &[
            whole(loc::THREAD_CHAMFER_ON_CODE, "the way out of threads"),
            whole(loc::THREAD_CHAMFER_OFF_CODE, "threads to their end"),
        ],
        &[],
    ),
];

/// Settings that say which of these functions is meant, where several are, and have a rule of
/// their own: what is in force at the start, the work offsets.
#[cfg(test)]
pub(super) const CHOOSE: &[CodeAt] = &[
    loc::UNITS_IN_FORCE,
    loc::MODE_POSITION,
    loc::MODE_POSITION_IN_FORCE,
    loc::CIRCLE_PLANE,
    loc::CIRCLE_PLANE_IN_FORCE,
    loc::FEED_MODE,
    loc::FEED_MODE_IN_FORCE,
    loc::FIXTURE_DEFAULT_CODE,
    loc::FIXTURE_MIN_CODE,
    loc::FIXTURE_MAX_CODE,
];

/// Settings of unit `code` that name no function of the control, but words of the CL file.
#[cfg(test)]
pub(super) const NO_FUNCTIONS: &[CodeAt] = &[
    loc::REPOS_OPTIMISE_START_MAJOR,
    loc::REPOS_OPTIMISE_STOP_MAJOR,
    loc::REPOS_OPTIMISE_START_MINOR,
    loc::REPOS_OPTIMISE_STOP_MINOR,
];
