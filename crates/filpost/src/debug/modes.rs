//! The modes of the control in words, as a debugger shows them.

use fil_machine::functions::WorkPlane;
use fil_machine::locations::{self as loc, ControlFamily};
use fil_machine::modes::{FeedMode, Plane, Unit};
use fil_machine::setting::CodeAt;
use fil_machine::{Commons, FunctionCode};
use fil_post::control_state::{Compensation, ControlState, Distance, Rotation, modal};

const NOT_KNOWN: &str = "not known";

/// Name and value of each mode.
pub(super) fn of(state: &ControlState, commons: &Commons) -> Vec<(&'static str, String)> {
    let coded = |mode: Option<(CodeAt, &str)>| match mode {
        Some((at, words)) => with_code(commons, at, words),
        None => NOT_KNOWN.to_string(),
    };
    let mut modes = vec![
        ("plane", coded(state.get(modal::PLANE).map(plane))),
        ("coordinates", coded(state.get(modal::DISTANCE).map(distance))),
        ("unit", coded(state.get(modal::UNITS).map(unit))),
        ("feed", coded(state.get(modal::FEED_MODE).map(feed))),
        ("compensation", coded(state.get(modal::CUTTER_COMP).map(compensation))),
        ("TCPC", on_or_off(state.get(modal::TCP))),
        (
            "tilted plane",
            on_or_off(state.get(modal::WORK_PLANE).map(|turned| turned == WorkPlane::Tilted)),
        ),
        ("canned cycle", cycle(state)),
        ("tool", number(state.get(modal::TOOL))),
        ("tool offset", number(state.get(modal::TOOL_OFFSET))),
        ("spindle", rotation(state.rotation()).to_string()),
        ("highest speed", speed(state.get(modal::SPEED_LIMIT))),
    ];
    if !is_klartext(commons) {
        modes.insert(0, ("motion", function(state.get(modal::MOTION))));
    }
    modes
}

/// Klartext has no functions for modes.
fn is_klartext(commons: &Commons) -> bool {
    commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext
}

/// The function of the machine, where it has one, and what it means.
fn with_code(commons: &Commons, at: CodeAt, words: &str) -> String {
    let code = commons.read(at).filter(|_| !is_klartext(commons));
    match code.and_then(FunctionCode::of_setting) {
        Some(code) => format!("G{} {words}", code.value()),
        None => words.to_string(),
    }
}

fn function(code: Option<FunctionCode>) -> String {
    code.map_or_else(|| NOT_KNOWN.to_string(), |code| format!("G{}", code.value()))
}

fn number(number: Option<i64>) -> String {
    number.map_or_else(|| NOT_KNOWN.to_string(), |number| number.to_string())
}

fn speed(limit: Option<f64>) -> String {
    limit.map_or_else(|| "not said".to_string(), |limit| format!("{limit} rpm"))
}

fn on_or_off(mode: Option<bool>) -> String {
    let words = match mode {
        Some(true) => "on",
        Some(false) => "off",
        None => NOT_KNOWN,
    };
    words.to_string()
}

fn cycle(state: &ControlState) -> String {
    match state.get(modal::CYCLE) {
        Some(true) => state
            .get(modal::CYCLE_CODE)
            .map_or_else(|| "on".to_string(), |code| function(Some(code))),
        other => on_or_off(other),
    }
}

fn plane(plane: Plane) -> (CodeAt, &'static str) {
    match plane {
        Plane::Xy => (loc::CIRCLE_PLANE_XY, "plane XY"),
        Plane::Zx => (loc::CIRCLE_PLANE_ZX, "plane ZX"),
        Plane::Yz => (loc::CIRCLE_PLANE_YZ, "plane YZ"),
    }
}

fn distance(distance: Distance) -> (CodeAt, &'static str) {
    match distance {
        Distance::Absolute => (loc::MODE_ABSOLUTE_CODE, "absolute"),
        Distance::Incremental => (loc::MODE_INCREMENTAL_CODE, "incremental"),
    }
}

fn unit(unit: Unit) -> (CodeAt, &'static str) {
    match unit {
        Unit::Mm => (loc::UNITS_METRIC_CODE, "mm"),
        Unit::Inch => (loc::UNITS_INCH_CODE, "inch"),
    }
}

fn feed(mode: FeedMode) -> (CodeAt, &'static str) {
    match mode {
        FeedMode::PerMinute => (loc::FEED_UPM_CODE, "per minute"),
        FeedMode::PerRevolution => (loc::FEED_UPR_CODE, "per revolution"),
        FeedMode::InverseTime => (loc::FEED_INVERSE_CODE, "inverse time"),
    }
}

fn compensation(compensation: Compensation) -> (CodeAt, &'static str) {
    match compensation {
        Compensation::Off => (loc::CUTCOM_OFF_CODE, "off"),
        Compensation::Left => (loc::CUTCOM_LEFT_CODE, "left of the path"),
        Compensation::Right => (loc::CUTCOM_RIGHT_CODE, "right of the path"),
    }
}

fn rotation(rotation: Rotation) -> &'static str {
    match rotation {
        Rotation::Unsaid => "not said",
        Rotation::Clockwise => "clockwise",
        Rotation::Counterclockwise => "counterclockwise",
        Rotation::InDoubt => "in doubt: perhaps counterclockwise",
        Rotation::Standing => "stopped",
    }
}
