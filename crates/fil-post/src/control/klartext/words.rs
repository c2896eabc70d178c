//! POSTN: M functions, each in a line of its own, or a straight line of the words that an `L`
//! may hold.
//!
//! A line has no motion function that stays in force, so G says how it moves: 0 is FMAX, 1 a
//! feed, as F does alone. `L F100` without an axis sets the feed.

use fil_diag::Result;
use fil_machine::letters::{F, G, M};
use fil_machine::{FunctionCode, Letter};

use super::phrase::Head;
use super::{function, refuse_auxiliary};
use crate::cause::Cause;
use crate::control::Control;
use crate::control::needs::Act;
use crate::errors::PostCode;

/// Letters of axes.
const AXES: &[u8] = b"ABCUVWXYZ";

/// Writes the words; each value as it is given, in the order that a line has.
///
/// # Errors
/// A word that no line takes, axes without G,0, G,1 or F, and a value that does not fit.
pub fn write(control: &mut Control, words: &[(Letter, f64, Cause)]) -> Result<()> {
    if words.iter().all(|(letter, ..)| *letter == M) {
        return words.iter().try_for_each(|&(_, value, cause)| {
            let code = auxiliary(value)?;
            control.because(cause, |control| function(control, M, code))
        });
    }
    let rapid = moves_in_rapid(words)?;
    let before = control.before_others()?;
    control.require_unit()?;
    control.require(Act::Block)?;
    for &(letter, value, cause) in words.iter().filter(|(letter, ..)| *letter != G) {
        match letter {
            M => {
                let code = auxiliary(value)?;
                control.block.m(code, cause);
            }
            _ => control.because(cause, |control| control.word(letter, value))?,
        }
    }
    let moved = [0, 1].map(|number| control.block_has(control.tables.axis(number).letter));
    for (stands, _) in control.klartext.stands.iter_mut().zip(moved).filter(|(_, moved)| *moved) {
        *stands = None;
    }
    let phrase = &mut control.klartext.phrase;
    (phrase.head, phrase.rapid) = (Head::Line, rapid);
    control.write_block()?;
    if moved.contains(&true) && control.state.compensates() {
        control.state.moved_in_plane();
    }
    control.doubt_changes(before)
}

fn auxiliary(value: f64) -> Result<FunctionCode> {
    let Some(code) = FunctionCode::of_value(value) else {
        return PostCode::Family.err(format!("POSTN: M{value} is no function"));
    };
    refuse_auxiliary(code)?;
    Ok(code)
}

/// True for FMAX, false for a feed.
fn moves_in_rapid(words: &[(Letter, f64, Cause)]) -> Result<bool> {
    let has = |letter: Letter| words.iter().any(|(one, ..)| *one == letter);
    let strange = words
        .iter()
        .find(|(letter, ..)| !matches!(*letter, F | G | M) && !AXES.contains(&letter.byte()));
    if let Some((letter, value, _)) = strange {
        return PostCode::Family.err(format!(
            "POSTN: a line of Klartext has axes, F and M, and {letter}{value} has no meaning there"
        ));
    }
    let moves = words.iter().any(|(letter, ..)| AXES.contains(&letter.byte()));
    if !moves && words.iter().any(|(letter, ..)| *letter == G) {
        return PostCode::Family.err(
            "POSTN: a Klartext line has no modal motion function, so G without an axis has no effect",
        );
    }
    let codes: Vec<f64> =
        words.iter().filter(|(letter, ..)| *letter == G).map(|(_, value, _)| *value).collect();
    match (&codes[..], has(F)) {
        ([0.0], false) => Ok(true),
        ([1.0], _) | ([], true) => Ok(false),
        ([0.0], true) => {
            PostCode::Family.err("POSTN: FMAX replaces F, so G0 and F can't be combined")
        }
        ([], false) => PostCode::Family.err(
            "POSTN: a Klartext line has no modal motion function; write G,0 for FMAX, or G,1 or F for a feed",
        ),
        _ => PostCode::Family.err(
            "POSTN: of the G functions only 0 (FMAX) and 1 (a feed) have a meaning in Klartext",
        ),
    }
}
