//! Settings that contradict each other: no machine is like that, and a program made
//! with them would be read otherwise than it is meant.

mod letters;
mod numbers;
mod travel;

use fil_diag::{Diag, Result};

use crate::address::{Addresses, TapePosition};
use crate::axis_chain::AxisChain;
use crate::commons::{Commons, Int};
use crate::errors::MachineCode;
use crate::frame_rules;
use crate::full_turn;
use crate::letter::{self, Letter};
use crate::locations::{
    self as loc, ControlFamily, ControlTranslation, CycleReturnCodes, SeqnoAlign, TapeEndOfBlock,
    TapePartnoText, ToolChangeBlock, ToolFormat,
};
use crate::mill_turn;
use crate::setting::{CharacterAt, CodeAt};

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

/// Characters that begin or end a line: letters and digits would be words, parentheses
/// comments.
const MARKS: &[(CharacterAt, &str)] = &[
    (loc::TAPE_START_CHAR, "tape.start_char"),
    (loc::TAPE_END_CHAR, "tape.end_char"),
    (loc::TAPE_START_CODE, "tape.start_code"),
    (loc::TAPE_OPSKIP_CHAR, "tape.opskip_char"),
];

/// Farthest that the end of an arc may be corrected, mm or inch.
const MOST_CORRECTION: f64 = 1.0;

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
    rapid_codes(commons, &mut found);
    tapping_codes(commons, &mut found);
    codes_of_two_modes(commons, &mut found);
    return_levels(commons, &mut found);
    calls(commons, &mut found);
    coolants(commons, &mut found);
    incremental_start(commons, &mut found);
    start_modes(commons, &mut found);
    arc_sizes(commons, &mut found);
    rapid_rules(commons, &mut found);
    feed_formats(commons, &mut found);
    dwell_formats(commons, &mut found);
    order_of_axes(commons, &mut found);
    shift_along(commons, &mut found);
    diameters(commons, &mut found);
    translation(commons, &mut found);
    frame_rules::check(commons, &mut found);
    full_turn::check(commons, &mut found);
    found.extend(mill_turn::check(commons).err().map(|diag| *diag));
    same_positions(commons, &mut found);
    letters::check(commons, &mut found);
    absent_axes(commons, &mut found);
    travel::forms(commons, &mut found);
    numbers::numbers(commons, &mut found);
    tape(commons, &mut found);
    numbers::ranges(commons, &mut found);
    prepared_tools(commons, &mut found);
    found
}

/// Marks of the tape that are asked for and not there, or mean something else.
fn tape(commons: &Commons, found: &mut Vec<Diag>) {
    let has_text = commons.read(loc::TAPE_PARTNO_TEXT) == TapePartnoText::Yes;
    if has_text && commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik {
        found.push(contradiction(
            "tape.partno_text asks for a line before the head of a SINUMERIK program".into(),
        ));
    }
    let aligns = commons.read(loc::SEQNO_ALIGN) == SeqnoAlign::ToolChanges;
    match commons.read(loc::TAPE_ALIGN_CHAR) {
        _ if !aligns => {}
        None => found.push(contradiction(
            "seqno.align asks for a character, and tape.align_char is none".into(),
        )),
        Some(mark)
            if Letter::of_character(mark)
                .is_some_and(|mark| commons.read(loc::PROGRAM_NUMBER_ADDRESS) == Some(mark)) =>
        {
            found.push(contradiction(format!(
                "{mark} is both tape.align_char and the letter of a program number"
            )));
        }
        Some(_) => {}
    }
    for (at, name) in MARKS {
        let skips = *at == loc::TAPE_OPSKIP_CHAR;
        let is_no_mark =
            |c: &char| c.is_alphanumeric() || "()\"'.+-".contains(*c) || (*c == '%' && skips);
        if let Some(mark) = commons.read(*at).filter(is_no_mark) {
            found.push(contradiction(format!("{name} is `{mark}`, which means something else")));
        }
    }
    let length = commons.dbl_opt(loc::TAPE_LEADER).unwrap_or(0.0);
    let has_leader = !commons.read(loc::TAPE_DNC) && length != 0.0;
    if has_leader && commons.read(loc::TAPE_LEADER_CHAR).is_none() {
        found.push(contradiction("tape.leader has a length, and tape.leader_char is none".into()));
    }
    let ends = commons.read(loc::TAPE_END_OF_BLOCK) == TapeEndOfBlock::Yes;
    if ends && commons.read(loc::TAPE_END_OF_BLOCK_CHAR).is_none() {
        found.push(contradiction(
            "tape.end_of_block asks for a character, and tape.end_of_block_char is none".into(),
        ));
    }
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

fn codes_of_two_modes(commons: &Commons, found: &mut Vec<Diag>) {
    for (index, (what, group)) in MODES.iter().enumerate() {
        for code in group.iter().filter_map(|at| commons.read(*at)) {
            let has = |group: &[CodeAt]| group.iter().any(|at| commons.read(*at) == Some(code));
            if let Some((other, _)) = MODES[..index].iter().find(|(_, group)| has(group)) {
                found.push(contradiction(format!("G{code} is both {other} and {what}")));
            }
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
        let has = |group: &[CodeAt]| group.iter().any(|at| commons.read(*at) == Some(code));
        if let Some((what, _)) = MODES.iter().find(|(_, group)| has(group)) {
            found.push(contradiction(format!(
                "G{code} is both {what} and the level that cycles return to"
            )));
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

/// The modes that the program says at its start are among the machine's.
fn start_modes(commons: &Commons, found: &mut Vec<Diag>) {
    let modes: [(&str, CodeAt, &[CodeAt]); 3] = [
        (
            "mode.position",
            loc::MODE_POSITION,
            &[loc::MODE_ABSOLUTE_CODE, loc::MODE_INCREMENTAL_CODE],
        ),
        ("feed.mode", loc::FEED_MODE, &[loc::FEED_UPM_CODE, loc::FEED_UPR_CODE]),
        (
            "circle.plane",
            loc::CIRCLE_PLANE,
            &[loc::CIRCLE_PLANE_XY, loc::CIRCLE_PLANE_ZX, loc::CIRCLE_PLANE_YZ],
        ),
    ];
    for (name, at, codes) in modes {
        let Some(code) = commons.read(at) else { continue };
        let mut known = codes.iter().filter_map(|at| commons.read(*at)).peekable();
        if known.peek().is_some() && !known.any(|known| known == code) {
            found.push(contradiction(format!("{name} is {code}, which is no code of this mode")));
        }
    }
}

/// The center of an arc in Klartext is a position, which no control reads as a diameter. A program
/// that says X is a diameter must write it as one.
fn diameters(commons: &Commons, found: &mut Vec<Diag>) {
    let is_klartext = commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext;
    let doubles = commons.dbl_opt(loc::SCALE_X) == Some(2.0);
    if is_klartext && doubles {
        found.push(contradiction("scale.x is 2, and Klartext has no diameters".into()));
    }
    if let Some(code) = commons.read(loc::LATHE_DIAMETER_CODE)
        && !doubles
        && !commons.read(loc::LATHE_DIAMETER)
    {
        found.push(contradiction(format!(
            "lathe.diameter_code begins programs with G{code}, which makes X a diameter, and \
             lathe.diameter writes it as a radius"
        )));
    }
}

/// Arcs end at a quadrant or at a full circle.
fn arc_sizes(commons: &Commons, found: &mut Vec<Diag>) {
    let correction = commons.dbl_opt(loc::CIRCLE_CORRECTION_MAX);
    if let Some(most) = correction.filter(|most| *most > MOST_CORRECTION) {
        found.push(contradiction(format!(
            "circle.correction_max is {most}; an end farther off than {MOST_CORRECTION} is that of \
             another arc"
        )));
    }
    if let Some(degrees) = commons.read(loc::CIRCLE_MAX_DEGREES)
        && degrees != 90
        && degrees != 360
    {
        let message = format!("circle.max_degrees is {degrees}; it can be 90 or 360");
        found.push(contradiction(message));
    }
}

/// The word of rapids needs letter and value, a letter of its own; short rapids need a feed.
fn rapid_rules(commons: &Commons, found: &mut Vec<Diag>) {
    let word = (commons.read(loc::RAPID_ADDRESS), commons.dbl_opt(loc::RAPID_VALUE));
    if let (Some(letter), None) = word {
        found.push(contradiction(format!(
            "rapid.address is {letter}, and rapid.value gives the word no number"
        )));
    }
    if let Some(letter) = word.0
        && (letter::letters::XYZ.contains(&letter) || b"ABCFGHIJKMNRST".contains(&letter.byte()))
    {
        found.push(contradiction(format!("{letter} is the word of rapids and something else")));
    }
    let short = commons.dbl_opt(loc::RAPID_SHORT_DISTANCE).unwrap_or(0.0);
    if short > 0.0 && commons.dbl_opt(loc::RAPID_SHORT_FEED).is_none_or(|feed| feed <= 0.0) {
        found.push(contradiction(
            "rapid.short_distance asks for short rapids at feed, and rapid.short_feed gives none"
                .into(),
        ));
    }
}

/// Formats of F by its mode need the point: without it a reader would have to know the mode.
fn feed_formats(commons: &Commons, found: &mut Vec<Diag>) {
    let addresses = Addresses::from_commons(commons, true);
    let pointless = addresses.format(letter::letters::F).is_some_and(|format| !format.point);
    for (at, name) in [
        (loc::FEED_UPM_FORMAT, "feed.upm_format"),
        (loc::FEED_INVERSE_FORMAT, "feed.inverse_format"),
    ] {
        if pointless && commons.int_opt(at).is_some() {
            found.push(contradiction(format!("{name} is given, and F is written without a point")));
        }
    }
}

/// Formats of the dwell word need the point: without it a reader would count the digits by
/// the format of the address.
fn dwell_formats(commons: &Commons, found: &mut Vec<Diag>) {
    let addresses = Addresses::from_commons(commons, true);
    let letters = [loc::DWELL_ADDRESS, loc::CYCLE_DWELL_ADDRESS].map(|at| commons.read(at));
    let pointless = letters
        .into_iter()
        .flatten()
        .find(|letter| addresses.format(*letter).is_some_and(|format| !format.point));
    let formats =
        [(loc::DWELL_UPM_FORMAT, "dwell.upm_format"), (loc::DWELL_UPR_FORMAT, "dwell.upr_format")];
    for (at, name) in formats {
        if let (Some(letter), true) = (pointless, commons.int_opt(at).is_some_and(|d| d > 0)) {
            found.push(contradiction(format!(
                "{name} is given, and {letter} is written without a point"
            )));
        }
    }
}

/// A shift along the tool axis is a matter of three axes: with a rotary axis the center of
/// an arc would have to go along.
fn shift_along(commons: &Commons, found: &mut Vec<Diag>) {
    let shifts = commons.dbl_opt(loc::INPUT_ALONG_TOOL_AXIS).is_some_and(|by| by != 0.0);
    if shifts && AxisChain::from_commons(commons).is_ok_and(|chain| chain.has_rotary()) {
        found.push(contradiction(
            "input.along_tool_axis shifts the points, and the machine has a rotary axis".into(),
        ));
    }
}

/// The zero that TRANS shifts does not turn with the part.
fn translation(commons: &Commons, found: &mut Vec<Diag>) {
    let shifts = commons.read(loc::CONTROL_TRANSLATION) == ControlTranslation::ByTrans
        && commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik;
    if shifts && frame_rules::is_scaled(commons) {
        found.push(contradiction(
            "control.translation shifts the zero of the control, and X, Y or Z is scaled or \
             shifted on the tape"
                .into(),
        ));
    }
    if shifts && AxisChain::from_commons(commons).is_ok_and(|chain| chain.has_rotary()) {
        found.push(contradiction(
            "control.translation shifts the zero of the control, and the machine has a rotary axis"
                .into(),
        ));
    }
}

/// One axis after the other is a matter of three axes: with a rotary axis the tip would
/// leave its path by far.
fn order_of_axes(commons: &Commons, found: &mut Vec<Diag>) {
    let apart = commons.read(loc::LINEAR_METHOD) != loc::LinearMethod::XyzInOneBlock;
    let turns = AxisChain::from_commons(commons).is_ok_and(|chain| chain.has_rotary());
    if apart && turns {
        found.push(contradiction(
            "linear.method moves XY and Z one after the other, and the machine has a rotary axis"
                .into(),
        ));
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

/// A machine that prepares its next tool by T changes it by another word.
fn prepared_tools(commons: &Commons, found: &mut Vec<Diag>) {
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    if !by_words || !commons.read(loc::TOOL_PRESELECT) {
        return;
    }
    let in_one_word = commons.read(loc::TOOL_FORMAT) == ToolFormat::ToolAndOffsetInOneTWord;
    if in_one_word || commons.read(loc::TOOL_CHANGE_CODE).is_none() {
        found.push(contradiction(
            "T prepares the next tool (tool.preselect), and T changes the tool by itself".into(),
        ));
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

#[cfg(test)]
mod tests;
