//! Letters and numbers as they are written: what a control would read as another word.

use fil_diag::Diag;

use super::contradiction;
use crate::address::{Addresses, FORMATS};
use crate::commons::{Commons, Int};
use crate::letter::{Letter, letters};
use crate::locations::{self as loc, ControlFamily};

/// Letters that are one word on each control: no other address prints them.
const OF_ONE_WORD: &[u8] = b"FGMNOST";

/// Letters that may print X, Y or Z: further axes along them.
const LINEAR: &[u8] = b"UVWXYZ";

/// Finds addresses that are read as others, and numbers that are read as others.
pub(super) fn check(commons: &Commons, addresses: &Addresses, found: &mut Vec<Diag>) {
    // Klartext has words of its own.
    if commons.read(loc::CONTROL_FAMILY) != ControlFamily::Klartext {
        characters(commons, addresses, found);
    }
    for letter in Letter::all() {
        dropped_zeros(commons, addresses, letter, found);
    }
}

/// Each letter of the tape prints a letter, and no other one prints the same. The second set of
/// letters (INTCOM 27 to 52) is not written.
fn characters(commons: &Commons, addresses: &Addresses, found: &mut Vec<Diag>) {
    let mut printed_by = [None; Letter::COUNT + 1];
    for letter in Letter::all() {
        let Some(position) = addresses.position(letter) else { continue };
        let character = char::from(addresses.slot(position).character).to_ascii_uppercase();
        let Some(word) = Letter::of_character(character) else {
            found.push(contradiction(format!(
                "{letter} prints `{character}`, which begins no word"
            )));
            continue;
        };
        let is_axis = LINEAR.contains(&letter.byte());
        let is_taken =
            OF_ONE_WORD.contains(&word.byte()) || letters::XYZ.contains(&word) && !is_axis;
        if word != letter && is_taken {
            found.push(contradiction(format!(
                "{letter} prints `{character}`, which a control reads as another word"
            )));
        }
        let other = &mut printed_by[word.index()];
        match *other {
            Some(_) if is_idle(commons, letter) => {}
            Some(before) if !is_idle(commons, before) => {
                found.push(contradiction(format!("{before} and {letter} both print `{character}`")))
            }
            _ => *other = Some(letter),
        }
    }
}

/// No motion has words of A, B and C on a machine without the axis.
fn is_idle(commons: &Commons, letter: Letter) -> bool {
    b"ABC".contains(&letter.byte())
        && !super::letters::rotary_letters(commons).contains(&Some(letter))
}

/// Zeros that are dropped at the end come back where a control fills the number up to all its
/// digits, which are those behind a point that is not printed: the zeros in front must be there,
/// and no control fills a whole number up. Functions are written as they are, and the number of a
/// block names nothing.
fn dropped_zeros(commons: &Commons, addresses: &Addresses, letter: Letter, found: &mut Vec<Diag>) {
    let Some(position) = addresses.position(letter) else { return };
    let format = &addresses.slot(position).format;
    let is_exact = [letters::G, letters::M, letters::N].contains(&letter);
    if is_exact || !format.drop_whole_zeros || format.point {
        return;
    }
    let digits = commons.int(Int(FORMATS as u16 + position.index() as u16));
    let has_whole = [false, true].map(|metric| format.with_digits(digits, metric).decimals == 0);
    let what = match (has_whole.contains(&true), format.leading) {
        (true, _) => "has whole numbers: 10 would be read as 1",
        (_, false) => "leading zeros too: its decimal point would be unknown",
        _ => return,
    };
    let mut diag =
        contradiction(format!("{letter} drops the zeros at the end of its numbers, and {what}"));
    diag.hint = Some(format!("set the third digit of address.{letter}.spec to 0"));
    found.push(diag);
}
