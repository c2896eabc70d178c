use std::collections::HashSet;

use super::*;
use crate::commons::Kind;
use crate::locations::{Location, TABLE, ValueUnit};
use crate::setting::CodeAt;

/// Settings that say which of the functions is meant, where several are, and have a rule of
/// their own: what is in force at the start, the work offsets.
const CHOOSE: [CodeAt; 10] = [
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
const NO_FUNCTIONS: [CodeAt; 4] = [
    loc::REPOS_OPTIMISE_START_MAJOR,
    loc::REPOS_OPTIMISE_STOP_MAJOR,
    loc::REPOS_OPTIMISE_START_MINOR,
    loc::REPOS_OPTIMISE_STOP_MINOR,
];

#[test]
fn every_setting_of_a_code_is_in_the_table_once() {
    let rows = FUNCTIONS.iter().flat_map(|row| row.settings).map(|setting| setting.at.0);
    let others = CHOOSE.iter().chain(&NO_FUNCTIONS).map(|at| at.0);
    let listed: Vec<u16> = rows.chain(others).collect();
    let once: HashSet<u16> = listed.iter().copied().collect();
    assert_eq!(once.len(), listed.len(), "a setting stands in two places");
    let codes = TABLE.iter().filter(|row| row.kind == Kind::Int && row.used);
    let names_a_code = |row: &&Location| {
        row.unit == ValueUnit::Code
            || row.meaning.starts_with("G code") && row.meaning.contains("in tenths")
    };
    for row in codes.filter(names_a_code) {
        assert!(once.contains(&row.number), "{} is not in the table of functions", row.name);
    }
}

#[test]
fn a_setting_counts_tenths_where_its_row_says_so() {
    for setting in FUNCTIONS.iter().flat_map(|row| row.settings) {
        let location = Location::numbered(Kind::Int, u32::from(setting.at.0)).unwrap();
        let tenths = location.meaning.contains("in tenths");
        assert_eq!(setting.scale == 1, tenths, "{}", location.name);
        assert!(location.used, "{} names a code, and the post does not act on it", location.name);
    }
}

#[test]
fn no_reserved_number_is_that_of_two_kinds() {
    for dialect in [Dialect::Mill, Dialect::LatheA, Dialect::Sinumerik] {
        let mut reserved: Vec<(Space, FunctionCode, &Function)> = Vec::new();
        for row in FUNCTIONS.iter().filter(|row| row.when != When::OspLengths) {
            let numbers = row.standard(dialect).unwrap_or(&[]).iter().filter(|n| n.reserved);
            for code in numbers.flat_map(|n| n.codes()) {
                let space = if row.space == Space::M { Space::M } else { Space::G };
                let other = reserved.iter().find(|own| (own.0, own.1) == (space, code));
                assert!(other.is_none(), "{dialect:?}: {space:?}{code} of {row:?} and {other:?}");
                reserved.push((space, code, row));
            }
        }
    }
}

#[test]
fn standard_numbers_are_found_by_dialect() {
    let meaning = |dialect, space, tenths| {
        standard(dialect, space, FunctionCode::tenths(tenths)).map(|row| row.meaning)
    };
    let turning = Some(Meaning::TurningCycle);
    assert_eq!(meaning(Dialect::LatheA, Space::G, 900), turning);
    assert_eq!(meaning(Dialect::Mill, Space::G, 900), Some(Meaning::Distance(Distance::Absolute)));
    assert_eq!(meaning(Dialect::Sinumerik, Space::G, 700), Some(Meaning::Unit(Unit::Inch)));
    assert_eq!(meaning(Dialect::LatheA, Space::G, 700), turning);
    let numbered = Some(Meaning::Origin(Origin::NumberedOffset));
    assert_eq!(meaning(Dialect::Mill, Space::G, 541), numbered);
    assert_eq!(meaning(Dialect::Mill, Space::G, 540), Some(Meaning::Origin(Origin::WorkOffset)));
    assert_eq!(meaning(Dialect::Mill, Space::G, 5050), None);
    assert_eq!(meaning(Dialect::Mill, Space::G, 5), None);
    assert_eq!(meaning(Dialect::Mill, Space::M, 60), Some(Meaning::ToolChange));
    assert_eq!(meaning(Dialect::Mill, Space::M, 700), None);
}
