//! Settings that contradict each other: no machine is like that, and a program made
//! with them would be read otherwise than it is meant.

mod codes;
mod counted_spindle;
mod description;
mod function_rules;
mod letters;
mod numbers;
mod tape;
mod travel;
mod written;

use fil_diag::{Diag, Result};

use crate::address::{Addresses, FORMATS, SPECIFICATIONS, TapePosition};
use crate::axis_chain::{AxisChain, Carries};
use crate::commons::{Commons, Int};
use crate::errors::MachineCode;
use crate::frame_rules;
use crate::full_turn;
use crate::input_matrix::{FLAT, input_matrix};
use crate::letter::{self, Letter};
use crate::locations::{
    self as loc, ControlFamily, ControlTranslation, HomeFrame, RotaryFrameForm, ToolChangeBlock,
    ToolFormat,
};
use crate::mill_turn;
use crate::osp_lengths;
use crate::rotary_feed_rules;
use crate::setting::CodeAt;

pub use travel::unchecked;

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
    function_rules::check(commons, &mut found);
    codes::check(commons, &mut found);
    counted_spindle::check(commons, &mut found);
    incremental_start(commons, &mut found);
    start_modes(commons, &mut found);
    arc_sizes(commons, &mut found);
    rapid_rules(commons, &mut found);
    feed_formats(commons, &mut found);
    dwell_formats(commons, &mut found);
    order_of_axes(commons, &mut found);
    head_before_table(commons, &mut found);
    shift_along(commons, &mut found);
    flat_matrix(commons, &mut found);
    diameters(commons, &mut found);
    translation(commons, &mut found);
    frame_rules::check(commons, &mut found);
    full_turn::check(commons, &mut found);
    found.extend(mill_turn::check(commons).err().map(|diag| *diag));
    same_positions(commons, &mut found);
    moved_letters(commons, &mut found);
    let addresses = Addresses::from_commons(commons, true);
    letters::check(commons, &addresses, &mut found);
    written::check(commons, &addresses, &mut found);
    absent_axes(commons, &mut found);
    travel::forms(commons, &mut found);
    description::check(commons, &mut found);
    rotary_feeds(commons, &mut found);
    numbers::numbers(commons, &mut found);
    tape::check(commons, &mut found);
    numbers::ranges(commons, &mut found);
    prepared_tools(commons, &mut found);
    frame_of_machine(commons, &mut found);
    reference_points(commons, &mut found);
    frame_without_angles(commons, &mut found);
    tools_in_one_word(commons, &mut found);
    found
}

fn contradiction(message: String) -> Diag {
    Diag::new(MachineCode::Contradiction, message)
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
            found
                .push(contradiction(format!("{name} is {code}, which is not a code of this mode")));
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
    let turns = AxisChain::from_commons(commons).is_ok_and(|chain| chain.has_rotary());
    if turns && commons.read(loc::LATHE_DIAMETER) && mill_turn::mode(commons).is_none() {
        found.push(contradiction(
            "a lathe has a rotary axis as a mill-turn machine alone (mill_turn.milling_code)"
                .into(),
        ));
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
    // Each feed move behind a rapid says its F again, so that F may be the rate of rapids.
    let feed_stays = !commons.read(loc::RAPID_REPEAT_FEED);
    if let Some(letter) = word.0
        && (letter::letters::XYZ.contains(&letter)
            || b"ABCDGHIJKMNORST".contains(&letter.byte())
            || letter.byte() == b'F' && feed_stays)
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

/// Formats of F by its mode, or as a lead, need the point: without it a reader would have to know
/// the mode.
fn feed_formats(commons: &Commons, found: &mut Vec<Diag>) {
    let addresses = Addresses::from_commons(commons, true);
    let pointless = addresses.format(letter::letters::F).is_some_and(|format| !format.point);
    for (at, name) in [
        (loc::FEED_UPM_FORMAT, "feed.upm_format"),
        (loc::FEED_INVERSE_FORMAT, "feed.inverse_format"),
        (loc::THREAD_LEAD_FORMAT, "thread.lead_format"),
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

/// The matrix of the input leaves a space.
fn flat_matrix(commons: &Commons, found: &mut Vec<Diag>) {
    let volume = |it: nalgebra::Matrix3x4<f64>| it.fixed_columns::<3>(0).into_owned().determinant();
    if input_matrix(commons).is_some_and(|it| volume(it).abs() < FLAT) {
        found.push(contradiction(
            "input.matrix_ax to input.matrix_cz bring all points of the CL file into one plane"
                .into(),
        ));
    }
}

/// F of motions that turn the machine counts in one way.
fn rotary_feeds(commons: &Commons, found: &mut Vec<Diag>) {
    if let Some((own, listed)) = rotary_feed_rules::two_forms(commons) {
        found.push(contradiction(format!(
            "rotary.feed is {}, and rotary.feed_method asks for {}",
            own as u16, listed as u16
        )));
    }
}

/// The zero that TRANS shifts does not turn with the part.
fn translation(commons: &Commons, found: &mut Vec<Diag>) {
    let shifts = commons.read(loc::CONTROL_TRANSLATION) == ControlTranslation::Trans
        && commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik;
    if shifts && frame_rules::is_scaled(commons) {
        found.push(contradiction(
            "control.translation shifts the origin in the control, but X, Y or Z is scaled or shifted in the program"
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

/// The primary rotary axis is the one next to the part: poses are solved in that order.
fn head_before_table(commons: &Commons, found: &mut Vec<Diag>) {
    let Ok(chain) = AxisChain::from_commons(commons) else { return };
    let carries = chain.rotaries.map(|axis| axis.map(|axis| axis.carries));
    if carries == [Some(Carries::Head), Some(Carries::Table)] {
        found.push(contradiction(
            "the primary rotary axis is a head and the secondary one a table; the primary axis is \
             the one next to the part"
                .into(),
        ));
    }
}

/// A letter that was given a tape position and no digits of its own: those that stood there were
/// meant for another word.
pub(crate) fn without_digits(letter: char, position: u32) -> Diag {
    let message =
        format!("{letter} is at tape position {position}, but its number format is missing");
    let mut diag = contradiction(message);
    diag.hint = Some(format!(
        "set address.{letter}.format and address.{letter}.spec too: {letter} = {{ slot = {position}, format = 4443, spec = 101 }} writes four digits before the point and three after it in mm"
    ));
    diag
}

/// Letters that the settings have given a tape position, and no digits since.
fn moved_letters(commons: &Commons, found: &mut Vec<Diag>) {
    for letter in Letter::all().filter(|letter| commons.wants_digits(letter.byte())) {
        let number = commons.int(Int(u16::from(letter.number())));
        let Some(at) = TapePosition::numbered(number) else { continue };
        let absent = |base: u32| commons.int_opt(Int(base as u16 + at.index() as u16)).is_none();
        if absent(FORMATS) || absent(SPECIFICATIONS) {
            found.push(without_digits(char::from(letter.byte()), number as u32));
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

/// A machine that prepares its next tool by T changes it by another word.
fn prepared_tools(commons: &Commons, found: &mut Vec<Diag>) {
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    if !by_words || !commons.read(loc::TOOL_PRESELECT) {
        return;
    }
    let in_one_word = commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode;
    if in_one_word || commons.read(loc::TOOL_CHANGE_CODE).is_none() {
        found.push(contradiction(
            "T prepares the next tool (tool.preselect), and T changes the tool by itself".into(),
        ));
    }
}

/// What a preparatory function within the range of work offsets means on this machine besides, such
/// as G81 between G54 and G129; `None` for one that is a work offset alone.
pub fn other_than_a_fixture(commons: &Commons, number: u16) -> Option<&'static str> {
    function_rules::other_than_a_fixture(commons, number)
}

/// G53 of a control that calls lengths by G54 to G59 takes the length off, and names no frame.
fn frame_of_machine(commons: &Commons, found: &mut Vec<Diag>) {
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    if by_words
        && osp_lengths::are_meant(commons)
        && commons.read(loc::HOME_FRAME) == HomeFrame::OfTheMachine
    {
        found.push(contradiction(
            "home.frame outputs machine coordinates by G53, which cancels the tool length offset on a control that activates it with G54 to G59"
                .into(),
        ));
    }
}

/// G28, G30 and G16 go where the control says.
fn reference_points(commons: &Commons, found: &mut Vec<Diag>) {
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    let (is_known, functions) = match commons.read(loc::HOME_FRAME) {
        HomeFrame::OfThePart | HomeFrame::OfTheMachine => return,
        HomeFrame::ReferencePoint | HomeFrame::SecondReferencePoint => (by_words, "G28 or G30"),
        HomeFrame::EndOfTravel => (by_words && osp_lengths::are_meant(commons), "G16 H0"),
    };
    if !is_known {
        found.push(contradiction(format!(
            "home.frame asks for a point of the machine by {functions}, which the language of the \
             control does not have"
        )));
    }
    let positions = loc::HOME.into_iter().chain(loc::CHANGE_POSITION).chain([loc::HOME_RETRACT_Z]);
    if positions.filter_map(|at| commons.dbl_opt(at)).any(|position| position != 0.0) {
        found.push(contradiction(
            "home.frame asks for a point that the control knows, where home.x, y, z, home.retract_z and \
             tool.change_x to tool.change_c are 0 or absent"
                .into(),
        ));
    }
}

/// Klartext and a SINUMERIK say a tilted work plane by its angles.
fn frame_without_angles(commons: &Commons, found: &mut Vec<Diag>) {
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    if !by_words && commons.read(loc::ROTARY_FRAME_FORM) != RotaryFrameForm::Angles {
        found.push(contradiction(
            "rotary.frame_form asks for a tilted work plane without angles, which the language of \
             the control does not have"
                .into(),
        ));
    }
}

/// T0101 is a word of lathes in word address: a SINUMERIK calls edges by D, and Klartext has
/// TOOL CALL.
fn tools_in_one_word(commons: &Commons, found: &mut Vec<Diag>) {
    let family = match commons.read(loc::CONTROL_FAMILY) {
        ControlFamily::WordAddress => return,
        ControlFamily::Sinumerik => "a SINUMERIK",
        ControlFamily::Klartext => "Klartext",
    };
    let form = commons.read(loc::TOOL_FORMAT);
    if form != ToolFormat::TWordAndChangeCode {
        found.push(contradiction(format!(
            "tool.format {} asks for tool and offset in one T word, and {family} has no such word",
            form as u16
        )));
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
