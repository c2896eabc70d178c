//! Letters of words that a control would read as something else.

use fil_diag::Diag;

use super::contradiction;
use crate::address::{Addresses, Output};
use crate::axis_chain::AxisChain;
use crate::commons::{Commons, Int};
use crate::letter::{Letter, letters};
use crate::locations::{self as loc, ControlFamily, FixtureForm};
use crate::setting::LetterAt;

/// What the control of a family reads a word of these settings as.
struct Rule {
    at: LetterAt,
    what: &'static str,
    /// Letters that a control of words reads as something else.
    taken: &'static [u8],
}

/// Letters of functions and axes, which stand in the block of a thread with another meaning.
const OF_THREADS: &[u8] = b"GMNOSTUVWXYZ";

/// Letters of words with a place of their own in each control of words.
const RULES: &[Rule] = &[
    Rule {
        at: loc::PROGRAM_NUMBER_ADDRESS,
        what: "the number of the program",
        taken: b"ABCDEFGHIJKLMQRSTUVWXYZ",
    },
    Rule { at: loc::DWELL_ADDRESS, what: "a dwell", taken: b"ABCDGHIJKMNOSTYZ" },
    Rule { at: loc::FIXTURE_ADDRESS, what: "the work offset", taken: b"FGIJKMNORSTXYZ" },
    Rule {
        at: loc::FIXTURE_EXTENDED_ADDRESS,
        what: "the number of a further work offset",
        taken: b"FGMNOSTXYZ",
    },
    Rule { at: loc::SPINDLE_ORIENT_ADDRESS, what: "the angle of the spindle", taken: b"FGMNOTXYZ" },
    Rule { at: loc::SPINDLE_MAX_ADDRESS, what: "the limit of the speed", taken: b"FGMNOSTXYZ" },
    Rule {
        at: loc::MILL_TURN_LIVE_SPEED_ADDRESS,
        what: "the speed of the live tool",
        taken: b"FGMNOTXYZ",
    },
    Rule { at: loc::THREAD_LEAD_ADDRESS, what: "the lead of a thread", taken: OF_THREADS },
    Rule { at: loc::THREAD_CHANGE_ADDRESS, what: "the growth of a lead", taken: OF_THREADS },
    Rule { at: loc::THREAD_TAPER_ADDRESS, what: "the taper of a thread", taken: OF_THREADS },
    Rule { at: loc::THREAD_COUNT_ADDRESS, what: "a number of threads", taken: OF_THREADS },
];

/// The letters that a SINUMERIK has for them; none where it says them otherwise.
const SINUMERIK: &[(LetterAt, &str, Option<u8>)] = &[
    (loc::PROGRAM_NUMBER_ADDRESS, "program.number_address", None),
    (loc::DWELL_ADDRESS, "dwell.address", Some(b'F')),
    (loc::CUTCOM_ADDRESS, "cutcom.address", Some(b'D')),
    (loc::RAPID_ADDRESS, "rapid.address", None),
];

/// Letters that no control has for a rotary axis: they are X, Y and Z, or stand for other words.
const NO_ROTARY_AXIS: &[u8] = b"DFGHIJKLMNOPQRSTXYZ";

/// Finds letters that mean two things.
pub(super) fn check(commons: &Commons, addresses: &Addresses, found: &mut Vec<Diag>) {
    let rotary = rotary_letters(commons);
    axis_letters(rotary, addresses, found);
    functions(commons, addresses, found);
    sequence_numbers(commons, addresses, found);
    word_letters(commons, rotary, found);
    match commons.read(loc::CONTROL_FAMILY) {
        ControlFamily::WordAddress => {
            of_words(commons, found);
            fixture_letter(commons, rotary, found);
        }
        ControlFamily::Sinumerik => of_sinumerik(commons, found),
        // Klartext says each of them by a word of its own.
        ControlFamily::Klartext => {}
    }
}

/// G and M have a place on the tape: without it each function would be lost. Klartext has no G. A
/// machine can have M off the tape, which each of its words is warned of, but no other letter in
/// its place.
fn functions(commons: &Commons, addresses: &Addresses, found: &mut Vec<Diag>) {
    if commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext {
        return;
    }
    let gave_way = commons.int_opt(Int(u16::from(letters::M.number()))).is_none();
    let missing = [(letters::G, addresses.position(letters::G).is_none()), (letters::M, gave_way)];
    for (letter, _) in missing.into_iter().filter(|(_, is_missing)| *is_missing) {
        found.push(contradiction(format!(
            "{letter} has no tape position, so its functions would be lost; give it a free one (address.{letter}.slot)"
        )));
    }
}

/// Blocks that are numbered have an N, which another letter has not taken the place of.
fn sequence_numbers(commons: &Commons, addresses: &Addresses, found: &mut Vec<Diag>) {
    let by_words = commons.read(loc::CONTROL_FAMILY) != ControlFamily::Klartext;
    let is_numbered = by_words && commons.read(loc::SEQNO_OFF_AT_START);
    if is_numbered && addresses.output(letters::N) == Output::Unknown {
        found.push(contradiction(
            "N has no tape position, but blocks are numbered; give it a free one (address.N.slot), or 53 to leave it out"
                .into(),
        ));
    }
}

fn of_words(commons: &Commons, found: &mut Vec<Diag>) {
    for Rule { at, what, taken } in RULES {
        let acts =
            *at != loc::FIXTURE_ADDRESS || commons.read(loc::FIXTURE_FORM) == FixtureForm::Word;
        let letter = commons.read(*at).filter(|letter| acts && taken.contains(&letter.byte()));
        if let Some(letter) = letter {
            found.push(contradiction(format!(
                "{letter} can't be {what}; a control reads it as something else"
            )));
        }
    }
}

/// The word of a work offset stands alone, and is none of an offset of the tool or of an axis.
fn fixture_letter(commons: &Commons, rotary: [Option<Letter>; 2], found: &mut Vec<Diag>) {
    if commons.read(loc::FIXTURE_FORM) != FixtureForm::Word {
        return;
    }
    let Some(letter) = commons.read(loc::FIXTURE_ADDRESS) else { return };
    let compensates = [loc::CUTCOM_LEFT_CODE, loc::CUTCOM_RIGHT_CODE]
        .into_iter()
        .any(|at| commons.read(at).is_some());
    let others = [
        (
            letter == letters::H && commons.read(loc::TOOL_LENGTH_CODE).is_some(),
            "the tool's length",
        ),
        (compensates && commons.read(loc::CUTCOM_ADDRESS) == Some(letter), "the cutter offset"),
        (rotary.contains(&Some(letter)), "a rotary axis"),
    ];
    for (_, what) in others.into_iter().filter(|(is_so, _)| *is_so) {
        found.push(contradiction(format!("{letter} is both the work offset and {what}")));
    }
}

fn of_sinumerik(commons: &Commons, found: &mut Vec<Diag>) {
    for (at, name, wanted) in SINUMERIK {
        let letter = commons.read(*at);
        match (letter, wanted) {
            (Some(letter), Some(wanted)) if letter.byte() != *wanted => {
                let wanted = char::from(*wanted);
                found.push(contradiction(format!(
                    "{name} is {letter}, and a SINUMERIK reads {wanted} there"
                )));
            }
            (Some(letter), None) => found.push(contradiction(format!(
                "{name} is {letter}, and a SINUMERIK has no such word; \"none\" leaves it out"
            ))),
            _ => {}
        }
    }
}

/// The letters of rotary axes, set or usual.
pub(super) fn rotary_letters(commons: &Commons) -> [Option<Letter>; 2] {
    // A chain that can't be built is told of where it is built.
    match AxisChain::from_commons(commons) {
        Ok(chain) => chain.rotaries.map(|axis| axis.map(|axis| axis.letter)),
        Err(_) => [None; 2],
    }
}

/// Rotary axes have neither each other's letter nor that of a word with another meaning, and
/// their words have a place on the tape: without it they would be lost.
fn axis_letters(rotary: [Option<Letter>; 2], addresses: &Addresses, found: &mut Vec<Diag>) {
    for letter in rotary.into_iter().flatten() {
        if addresses.format(letter).is_none() {
            found.push(contradiction(format!(
                "{letter} is a rotary axis, and the machine has no address {letter}"
            )));
        }
        if NO_ROTARY_AXIS.contains(&letter.byte()) {
            found.push(contradiction(format!(
                "{letter} can't be a rotary axis; a control reads it as something else"
            )));
        }
    }
    if rotary[0].is_some() && rotary[0] == rotary[1] {
        found.push(contradiction("both rotary axes have the same letter".into()));
    }
}

/// Letters of words that may stand in a block together: different, and neither an
/// axis nor a function.
fn word_letters(commons: &Commons, rotary: [Option<Letter>; 2], found: &mut Vec<Diag>) {
    let of = |at: LetterAt| commons.read(at);
    let taken = |letter: Letter| {
        letters::XYZ.contains(&letter)
            || rotary.contains(&Some(letter))
            || b"FGHMNST".contains(&letter.byte())
    };
    let is_center = |letter: Letter| b"IJK".contains(&letter.byte());
    if let Some(letter) = of(loc::CIRCLE_RADIUS_ADDRESS).filter(|letter| is_center(*letter)) {
        found.push(contradiction(format!("{letter} is the radius and the center of an arc")));
    }
    let named = [
        (loc::CYCLE_STEP_ADDRESS, "the peck"),
        (loc::CYCLE_DWELL_ADDRESS, "the dwell of a cycle"),
        (loc::CIRCLE_RADIUS_ADDRESS, "the radius"),
        (loc::CUTCOM_ADDRESS, "the cutter offset"),
    ];
    for (at, what) in named {
        let is_offset = |letter: &Letter| what == "the cutter offset" && letter.byte() == b'H';
        let of_cycles = [loc::CYCLE_STEP_ADDRESS, loc::CYCLE_DWELL_ADDRESS].contains(&at);
        let is_level = |letter: &Letter| of_cycles && letter.byte() == b'R';
        let is_taken = |letter: &Letter| (taken(*letter) && !is_offset(letter)) || is_level(letter);
        if let Some(letter) = of(at).filter(is_taken) {
            found.push(contradiction(format!("{letter} is {what} and something else")));
        }
    }
    for (one, other) in [(0, 1), (2, 3)] {
        let [(one, what), (other, another)] = [named[one], named[other]];
        if let Some(letter) = of(one).filter(|letter| of(other) == Some(*letter)) {
            found.push(contradiction(format!("{letter} is both {what} and {another}")));
        }
    }
}
