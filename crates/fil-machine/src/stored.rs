//! What a location of the commons can hold, and whether the post acts on it.
//!
//! The post reads a number that means nothing as absent or as the default, so a wrong
//! one would be quietly another machine. machine.toml, `--set` and POSTF(2) ask here
//! before they store one; an option file is the vendor's and is warned of instead.

use fil_diag::{Diag, Result};

use crate::address::{CHARACTERS, FORMATS, LAST_CELL, OFF, SPECIFICATIONS};
use crate::commons::{EMPTY, Kind, LAST_OUTPUT, NA};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{self as loc, Location, ValueUnit};
use crate::user_blocks;

/// The tables of letters and tape positions: their last locations, and what they hold.
const ADDRESS_TABLES: [(u32, AddressCell); 4] = [
    (CHARACTERS, AddressCell::Position),
    (FORMATS, AddressCell::Character),
    (SPECIFICATIONS, AddressCell::Format),
    (LAST_CELL, AddressCell::Specification),
];

/// What a cell of the tables of letters holds.
#[derive(Clone, Copy)]
enum AddressCell {
    Position,
    Character,
    Format,
    Specification,
}

impl AddressCell {
    /// The cell at an INTCOM location.
    fn at(kind: Kind, number: u32) -> Option<Self> {
        let cell = ADDRESS_TABLES.iter().find(|(last, _)| (1..=*last).contains(&number))?;
        (kind == Kind::Int).then_some(cell.1)
    }

    fn takes(self, value: f64) -> bool {
        match self {
            AddressCell::Position => (1.0..=f64::from(OFF)).contains(&value),
            AddressCell::Character => is_character(value),
            AddressCell::Format => (0.0..=9999.0).contains(&value),
            AddressCell::Specification => is_specification(value),
        }
    }

    fn wanted(self) -> &'static str {
        match self {
            AddressCell::Position => "a tape position is 1 to 52, 53 is none",
            AddressCell::Character => "the character of an address is 32 to 126, 0 is none",
            AddressCell::Format => {
                "a format has four digits: before and after the point, for inches and for mm"
            }
            AddressCell::Specification => {
                "a specification has the digits 0 and 1 (the third from the left 0 to 2)"
            }
        }
    }
}

/// True for a number of at most four digits, each of which means something.
fn is_specification(value: f64) -> bool {
    let digit = |place: f64| (value / place).floor() % 10.0;
    (0.0..=9999.0).contains(&value)
        && [1000.0, 100.0, 1.0].iter().all(|place| digit(*place) <= 1.0)
        && digit(10.0) <= 2.0
}

/// True for a character that prints, and for what real files hold where there is none.
fn is_character(value: f64) -> bool {
    value == 0.0 || (32.0..=126.0).contains(&value)
}

/// True for a number that a setting can hold: EMPTY, or what its unit and its choices
/// give a meaning. A flag takes the codes of ON and OFF too.
fn takes(row: &Location, value: f64) -> bool {
    let choices = row.choice_list();
    if value == EMPTY || choices.iter().any(|(choice, _)| *choice == value) {
        return true;
    }
    match row.unit {
        ValueUnit::Flag => [0.0, 1.0, 71.0, 72.0].contains(&value),
        // Real files write 53, 0 or -64 (the code 0 less 64) for an absent letter.
        ValueUnit::Letter => {
            Letter::numbered(value as i32).is_some() || [53.0, 0.0, -64.0].contains(&value)
        }
        ValueUnit::Char => is_character(value),
        ValueUnit::Code => value >= 0.0,
        _ => choices.is_empty(),
    }
}

/// Refuses a number that a location can't hold.
///
/// # Errors
/// E0605 for a number outside the choices, and for an invalid letter, character or code.
pub fn check(kind: Kind, number: u32, value: f64) -> Result<()> {
    // Absent; or a fraction, which INTCOM refuses itself.
    let is_absent = value == EMPTY || (kind == Kind::Int && value == f64::from(NA));
    if is_absent || (kind == Kind::Int && value.fract() != 0.0) {
        return Ok(());
    }
    if let Some(cell) = AddressCell::at(kind, number) {
        if cell.takes(value) {
            return Ok(());
        }
        let message = format!("{} {number} can't be {value}", kind.name());
        return Err(Box::new(MachineCode::SettingValue.diag(message).hint(cell.wanted())));
    }
    match Location::numbered(kind, number) {
        Some(row) if !takes(row, value) => Err(wrong_value(row, &value.to_string())),
        _ => Ok(()),
    }
}

/// Refuses what a script or a debugger can't store while a program is written: a number that
/// the location can't hold, the mode of a mill-turn machine, which changes with a block, and the
/// encoding, which is one for the whole program.
///
/// # Errors
/// E0605, as [`check`].
pub fn check_in_run(kind: Kind, number: u32, value: f64) -> Result<()> {
    let mode = loc::MILL_TURN_MODE;
    if (kind, number) == (Kind::Int, mode.number.into()) {
        let message = "mill_turn.mode: no block would bring the machine to that mode";
        let diag = MachineCode::SettingValue.diag(message);
        return Err(Box::new(diag.hint("carry out MODE/MILL or MODE/TURN")));
    }
    if (kind, number) == (Kind::Int, loc::TAPE_ENCODING.number.into()) {
        let message = "tape.encoding: a program has one encoding from its first to its last byte";
        let diag = MachineCode::SettingValue.diag(message);
        return Err(Box::new(diag.hint("set it in machine.toml or with --set")));
    }
    check(kind, number, value)
}

/// The number in a text with more around it, `"-5"` or `M8`; `None` for a number alone, and for
/// what holds more than one.
fn number_within(text: &str) -> Option<f64> {
    let is_part = |letter: char| letter.is_ascii_digit() || matches!(letter, '-' | '.');
    let alone = text.trim_matches(|letter| !is_part(letter));
    if alone == text { None } else { alone.parse().ok() }
}

/// E0605 for a value that a setting does not take.
pub(crate) fn wrong_value(row: &Location, value: &str) -> Box<Diag> {
    let message = format!("`{}` can't be {value} (unit {})", row.name, row.unit);
    let diag = MachineCode::SettingValue.diag(message);
    if row.choices.is_empty() {
        let alone = number_within(value).filter(|number| takes(row, *number));
        let hint = alone.map(|number| format!("write the number alone: {} = {number}", row.name));
        return match hint {
            Some(hint) => Box::new(diag.hint(hint)),
            None => diag,
        };
    }
    Box::new(diag.hint(format!("choose one of {}", row.choices.replace('|', ", "))))
}

/// True for a location that the post reads as it acts, or writes. A value in any other
/// is kept, and changes nothing.
pub fn acts(kind: Kind, number: u32) -> bool {
    let last_output = LAST_OUTPUT as u32;
    let is_in_a_list = match kind {
        Kind::Int => {
            u16::try_from(number).is_ok_and(|number| user_blocks::list_of(number).is_some())
        }
        Kind::Dbl => (last_output + 1..=last_output + Letter::COUNT as u32).contains(&number),
        Kind::Rel => false,
    };
    is_in_a_list
        || AddressCell::at(kind, number).is_some()
        || Location::numbered(kind, number).is_some_and(|row| row.used)
}

/// What a location is called: the name of its setting, or its common and number.
pub fn title(kind: Kind, number: u32) -> String {
    match Location::numbered(kind, number) {
        Some(row) => row.name.to_string(),
        None => format!("{} {number}", kind.name()),
    }
}

/// Two blanks, as packed texts of option files have them: nothing is said.
pub(crate) const BLANKS: f64 = 8224.0;

/// True where a value changes nothing, and is not what the location has anyway.
pub fn is_idle(kind: Kind, number: u32, value: f64) -> bool {
    let said = match Location::numbered(kind, number) {
        Some(row) => value != row.default_value(),
        None => value != EMPTY && value != BLANKS,
    };
    said && !acts(kind, number) && !is_title(kind, number)
}

/// The packed text of the machine's name, which stands in the second line of an option file
/// too.
fn is_title(kind: Kind, number: u32) -> bool {
    kind == Kind::Int && (2019..=2039).contains(&number)
}

/// W0651 for these locations, which the post does not act on.
pub fn without_effect(locations: &[(Kind, u32)]) -> Diag {
    let (named, others): (Vec<_>, Vec<_>) = locations
        .iter()
        .copied()
        .partition(|(kind, number)| Location::numbered(*kind, *number).is_some());
    let named: Vec<String> = named.into_iter().map(|(kind, number)| title(kind, number)).collect();
    let (named, others) = (named.join(", "), ranges(&others).join(", "));
    let message = match (named.as_str(), others.as_str()) {
        (named, "") => format!("the post does not act on {named}"),
        ("", others) => format!("the post does not act on {others}"),
        (named, others) => {
            format!("the post does not act on {named}; what {others} mean is not published")
        }
    };
    *MachineCode::UnusedSetting.diag(message)
}

/// Locations without a name, those that follow each other as `INTCOM 4601 to 4606`.
fn ranges(locations: &[(Kind, u32)]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut last = None;
    for &(kind, number) in locations {
        match (names.last_mut(), last) {
            (Some(name), Some((first, before))) if before == (kind, number.wrapping_sub(1)) => {
                *name = format!("{} {first} to {number}", kind.name());
                last = Some((first, (kind, number)));
            }
            _ => {
                names.push(title(kind, number));
                last = Some((number, (kind, number)));
            }
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commons::Commons;
    use crate::locations::{TABLE, default_commons};

    fn takes(kind: Kind, number: u32, value: f64) -> bool {
        match check(kind, number, value) {
            Ok(()) => true,
            Err(diag) => {
                assert_eq!(diag.code.name(), "E0605");
                false
            }
        }
    }

    #[test]
    fn a_number_in_a_text_keeps_its_sign_and_its_point() {
        for (text, number) in [
            ("\"-100.5\"", Some(-100.5)),
            ("\".5\"", Some(0.5)),
            ("M8", Some(8.0)),
            ("-5", None),
            ("\"1-2\"", None),
            ("none", None),
        ] {
            assert_eq!(number_within(text), number, "{text}");
        }
    }

    #[test]
    fn a_location_takes_what_means_something() {
        for (number, good, bad) in [
            (24, 53.0, 0.0),
            (76, 88.0, 7.0),
            (129, 3443.0, 10_000.0),
            (182, 1121.0, 31.0),
            (1870, 0.0, 9.0),
            (1849, 72.0, 2.0),
            (510, 1.0, -1.0),
            (1844, 40.0, 7.0),
            (9003, 15.0, 40.0),
        ] {
            assert!(takes(Kind::Int, number, good), "{number} = {good}");
            assert!(!takes(Kind::Int, number, bad), "{number} = {bad}");
            assert!(takes(Kind::Int, number, EMPTY), "{number} EMPTY");
        }
        assert!(takes(Kind::Int, 5000, 7.0) && takes(Kind::Dbl, 486, -2.0));
    }

    #[test]
    fn the_machine_that_nothing_is_said_of_is_taken() {
        let held = |commons: &Commons, kind, number| commons.get(kind, number).unwrap();
        let commons = default_commons();
        for number in 1..=211 {
            assert!(takes(Kind::Int, number, held(&commons, Kind::Int, number)), "{number}");
        }
        for row in TABLE.iter().filter(|row| !row.name.ends_with("_listed")) {
            let value = held(&commons, row.kind, row.number.into());
            assert!(takes(row.kind, row.number.into(), value), "{} = {value}", row.name);
        }
    }

    #[test]
    fn what_acts_is_a_used_setting_a_letter_a_block_or_a_last_value() {
        for (kind, number) in [(Kind::Int, 1870), (Kind::Int, 25), (Kind::Dbl, 379)] {
            assert!(acts(kind, number), "{}", title(kind, number));
        }
        for (kind, number) in [(Kind::Int, 5000), (Kind::Dbl, 382), (Kind::Rel, 999)] {
            assert!(!acts(kind, number), "{}", title(kind, number));
        }
    }
}
