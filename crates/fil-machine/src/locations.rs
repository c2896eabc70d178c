//! The table of common locations: number, name, unit, default, meaning, evidence.
//!
//! `data/locations.tsv` is the one source. From it come the constants the post
//! reads its settings with, the keys of `machine.toml`, the report of
//! `filpost machine show` and the page of machine settings in the docs.
//! A constant exists for each location the post acts on.

use std::collections::HashMap;
use std::sync::OnceLock;

use crate::address::{CHARACTERS, FORMATS, SPECIFICATIONS};
use crate::commons::{Commons, Dbl, EMPTY, Int, Kind, Rel};
use crate::letter::Letter;
use crate::setting::{
    CharacterAt, Choice, CodeAt, Flag, FromNumber, LetterAt, OptionalChoice, OptionalRealChoice,
    RealChoice,
};

pub use crate::value_unit::{Evidence, ValueUnit};

/// One row of the table.
#[derive(Debug, PartialEq)]
pub struct Location {
    /// Which common.
    pub kind: Kind,
    /// Location number, 1-based.
    pub number: u16,
    /// Key in `machine.toml`.
    pub name: &'static str,
    /// What the value counts.
    pub unit: ValueUnit,
    /// Value when nothing sets it.
    pub default: f64,
    /// `1=one thing|2=another` for flags and choices.
    pub choices: &'static str,
    /// What it is, in a sentence; empty in WebAssembly where the post does not act on it.
    pub meaning: &'static str,
    /// Where we know it from.
    pub evidence: Evidence,
    /// The post acts on it.
    pub used: bool,
    /// Why the post does not act on it; empty where it does, where no reason is given, and in
    /// WebAssembly.
    pub idle: &'static str,
}

impl Location {
    /// The row of a key of `machine.toml`; an [old key](crate::renamed) gives the row of the new one.
    pub fn named(name: &str) -> Option<&'static Location> {
        static NAMES: OnceLock<HashMap<&'static str, &'static Location>> = OnceLock::new();
        let names = NAMES.get_or_init(|| TABLE.iter().map(|row| (row.name, row)).collect());
        names.get(crate::renamed::key(name).unwrap_or(name)).copied()
    }

    /// The row of a location, if it has a name.
    pub fn numbered(kind: Kind, number: u32) -> Option<&'static Location> {
        static ROWS: OnceLock<[Vec<Option<&'static Location>>; 3]> = OnceLock::new();
        let rows = ROWS.get_or_init(|| {
            [Kind::Int, Kind::Rel, Kind::Dbl].map(|kind| {
                let mut rows = vec![None; kind.size() + 1];
                for row in TABLE.iter().filter(|row| row.kind == kind) {
                    rows[usize::from(row.number)] = Some(row);
                }
                rows
            })
        });
        rows[kind as usize].get(number as usize).copied().flatten()
    }

    /// The choices as pairs of value and meaning.
    pub fn choice_list(&self) -> Vec<(f64, &'static str)> {
        self.choices
            .split('|')
            .filter_map(|choice| choice.split_once('='))
            .filter_map(|(value, text)| Some((value.parse().ok()?, text)))
            .collect()
    }

    /// The default as FIL sees it: absent is [`EMPTY`].
    pub fn default_value(&self) -> f64 {
        match self.kind {
            Kind::Int if self.default == f64::from(crate::commons::NA) => EMPTY,
            _ => self.default,
        }
    }
}

include!(concat!(env!("OUT_DIR"), "/locations.rs"));

/// Tape positions of a mill's letters when nothing else is said.
const DEFAULT_SLOTS: [(u8, i32); 26] = [
    (b'N', 1),
    (b'G', 2),
    (b'X', 3),
    (b'Y', 4),
    (b'Z', 5),
    (b'I', 6),
    (b'J', 7),
    (b'K', 8),
    (b'R', 9),
    (b'A', 10),
    (b'B', 11),
    (b'C', 12),
    (b'P', 13),
    (b'F', 14),
    (b'S', 15),
    (b'T', 16),
    (b'D', 17),
    (b'H', 18),
    (b'M', 19),
    (b'Q', 20),
    (b'E', 53),
    (b'L', 53),
    (b'O', 53),
    (b'U', 53),
    (b'V', 53),
    (b'W', 53),
];

/// Format and specification of a letter when nothing else is said.
fn default_format(letter: u8) -> (i32, i32) {
    match letter {
        b'N' => (4040, 0),
        b'G' | b'M' => (2020, 0),
        b'D' | b'H' => (2020, 0),
        b'S' | b'T' => (5050, 0),
        b'P' => (5050, 0),
        b'F' => (3342, 1),
        _ => (3443, 1),
    }
}

/// Codes of motions, without that of a thread, which may be a cycle of its own.
pub const MOTION_CODES: [CodeAt; 6] =
    [RAPID_CODE_XY, RAPID_CODE_Z, ROTARY_RAPID_CODE, LINEAR_CODE, CIRCLE_CW_CODE, CIRCLE_CCW_CODE];

/// Codes of the canned cycles.
pub const CYCLE_CODES: [CodeAt; 11] = [
    CYCLE_DRILL_CODE,
    CYCLE_CSINK_CODE,
    CYCLE_DEEP_CODE,
    CYCLE_BRKCHP_CODE,
    CYCLE_TAP_CODE,
    CYCLE_TAP_LEFT_CODE,
    CYCLE_BORE_CODE,
    CYCLE_REAM_CODE,
    CYCLE_FACE_CODE,
    CYCLE_THRU_CODE,
    CYCLE_MILL_CODE,
];

/// What is added to X, Y and Z of each point of the input.
pub const INPUT_TRANSLATE: [Dbl; 3] = [INPUT_TRANSLATE_X, INPUT_TRANSLATE_Y, INPUT_TRANSLATE_Z];

/// The rows of the matrix that each point of the input goes through.
pub const INPUT_MATRIX: [Dbl; 12] = [
    INPUT_MATRIX_AX,
    INPUT_MATRIX_BX,
    INPUT_MATRIX_CX,
    INPUT_MATRIX_DX,
    INPUT_MATRIX_AY,
    INPUT_MATRIX_BY,
    INPUT_MATRIX_CY,
    INPUT_MATRIX_DY,
    INPUT_MATRIX_AZ,
    INPUT_MATRIX_BZ,
    INPUT_MATRIX_CZ,
    INPUT_MATRIX_DZ,
];

/// X, Y and Z of the home position.
pub const HOME: [Dbl; 3] = [HOME_X, HOME_Y, HOME_Z];

/// Least and greatest X, Y, Z of the machine, mm.
pub const LINEAR_LIMITS: [(Dbl, Dbl); 3] =
    [(LIMITS_X_MIN, LIMITS_X_MAX), (LIMITS_Y_MIN, LIMITS_Y_MAX), (LIMITS_Z_MIN, LIMITS_Z_MAX)];

/// Least and greatest A, B, C of the machine, degrees.
pub const ROTARY_LIMITS: [(Dbl, Dbl); 3] =
    [(LIMITS_A_MIN, LIMITS_A_MAX), (LIMITS_B_MIN, LIMITS_B_MAX), (LIMITS_C_MIN, LIMITS_C_MAX)];

/// How the travel of A, B, C is given.
pub const TRAVEL_KINDS: [Choice<TravelKind>; 3] = [LIMITS_A_KIND, LIMITS_B_KIND, LIMITS_C_KIND];

/// Whether A, B, C stay within a zone.
pub const IN_ZONES: [Flag; 3] = [LIMITS_A_ZONES, LIMITS_B_ZONES, LIMITS_C_ZONES];

/// What happens where X, Y, Z leave their travel.
pub const LINEAR_EXCEEDED: [Choice<Exceeded>; 3] =
    [REPOS_X_EXCEEDED, REPOS_Y_EXCEEDED, REPOS_Z_EXCEEDED];

/// Where X, Y, Z, A, B, C stand for a tool change, mm and degrees.
pub const CHANGE_POSITION: [Dbl; 6] =
    [TOOL_CHANGE_X, TOOL_CHANGE_Y, TOOL_CHANGE_Z, TOOL_CHANGE_A, TOOL_CHANGE_B, TOOL_CHANGE_C];

/// Codes of the spindle ranges.
pub const RANGE_CODES: [CodeAt; 6] = [
    SPINDLE_RANGE1_CODE,
    SPINDLE_RANGE2_CODE,
    SPINDLE_RANGE3_CODE,
    SPINDLE_RANGE4_CODE,
    SPINDLE_RANGE5_CODE,
    SPINDLE_RANGE6_CODE,
];

/// Least and greatest speed of each spindle range, rpm.
pub const RANGE_SPEEDS: [(Rel, Rel); 6] = [
    (SPINDLE_RANGE1_MIN, SPINDLE_RANGE1_MAX),
    (SPINDLE_RANGE2_MIN, SPINDLE_RANGE2_MAX),
    (SPINDLE_RANGE3_MIN, SPINDLE_RANGE3_MAX),
    (SPINDLE_RANGE4_MIN, SPINDLE_RANGE4_MAX),
    (SPINDLE_RANGE5_MIN, SPINDLE_RANGE5_MAX),
    (SPINDLE_RANGE6_MIN, SPINDLE_RANGE6_MAX),
];

/// Commons of a machine that nothing has been said about yet: the defaults of
/// the table and the address table of a mill.
pub fn default_commons() -> Commons {
    let mut commons = Commons::absent();
    for row in TABLE.iter().filter(|row| !row.name.ends_with("_listed")) {
        commons
            .set(row.kind, u32::from(row.number), row.default_value())
            .expect("defaults of the table fit their commons");
    }
    for (letter, slot) in DEFAULT_SLOTS {
        set_address(&mut commons, letter, slot, default_format(letter));
    }
    commons
}

/// Puts an address at a tape position (53: not used) with its format and
/// specification.
pub fn set_address(commons: &mut Commons, letter: u8, slot: i32, (format, spec): (i32, i32)) {
    let index = u32::from(Letter::of(letter).number());
    let mut set = |location: u32, value: i32| {
        commons.set(Kind::Int, location, f64::from(value)).expect("address locations are in range");
    };
    set(index, slot);
    if (1..53).contains(&slot) {
        set(CHARACTERS + slot as u32, i32::from(letter));
        set(FORMATS + slot as u32, format);
        set(SPECIFICATIONS + slot as u32, spec);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn names_and_numbers_are_unique() {
        let names: HashSet<_> = TABLE.iter().map(|row| row.name).collect();
        let numbers: HashSet<_> = TABLE.iter().map(|row| (row.kind, row.number)).collect();
        assert_eq!((names.len(), numbers.len()), (TABLE.len(), TABLE.len()));
    }

    #[test]
    fn defaults_are_among_their_choices() {
        for row in TABLE.iter().filter(|row| !row.choices.is_empty()) {
            let known = row.choice_list().iter().any(|(value, _)| *value == row.default);
            assert!(known || row.default_value() == EMPTY, "{}", row.name);
        }
    }

    #[test]
    fn no_named_location_of_a_setting_lies_in_the_address_table() {
        let inside = TABLE.iter().filter(|row| row.kind == Kind::Int && row.number <= 211);
        assert!(inside.into_iter().all(|row| row.name.ends_with("_listed")));
    }
}
