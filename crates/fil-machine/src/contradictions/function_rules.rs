//! No number of a function means two things.

use fil_diag::Diag;

use super::contradiction;
use super::functions::{At, GROUPS, Group, MAY_SHARE, Space};
use crate::commons::{Commons, Int};
use crate::function_code::FunctionCode;
use crate::locations::{self as loc, ControlFamily, CycleReturnCodes, FixtureForm};
use crate::osp_lengths;
use crate::setting::CodeAt;

/// The group of work offsets, whose settings are a range.
pub(super) const FIXTURE: &str = "a work offset";

/// The group of the levels that cycles return to.
pub(super) const RETURN: &str = "a level that cycles return to";

/// A number and what it stands for. Sorted by number, so that those of one stand together: scripts
/// change settings in each record.
#[derive(Clone, Copy)]
struct Function {
    space: Space,
    tenths: u32,
    what: &'static str,
    group: &'static str,
    /// Each control has it; a setting names it else.
    fixed: bool,
}

/// Finds functions of two meanings.
pub(super) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    let mut functions = Vec::with_capacity(200);
    named(commons, &mut functions);
    fixtures(commons, &mut functions);
    of_control(commons, &mut functions);
    // A stable sort: those of the settings stay in the order of the table, before the others.
    functions.sort_by_key(|function| (function.space as u8, function.tenths));
    for same in functions.chunk_by(|a, b| (a.space, a.tenths) == (b.space, b.tenths)) {
        for (index, function) in same.iter().enumerate().filter(|(_, function)| !function.fixed) {
            let before = same[..index].iter();
            let fixed = same[index..].iter().filter(|other| other.fixed);
            let other = before.chain(fixed).find(|other| {
                other.what != function.what
                    && !may_share(other.what, function.what)
                    && !(other.fixed && is_meant(function, other, &functions))
            });
            if let Some(other) = other {
                found.push(of_two_meanings(function, other));
            }
        }
    }
}

fn of_two_meanings(function: &Function, other: &Function) -> Diag {
    let letter = match function.space {
        Space::G => "G",
        Space::M => "M",
        Space::Cycle => "cycle ",
    };
    let number = FunctionCode::tenths(function.tenths);
    let message = format!("{letter}{number} is both {} and {}", other.what, function.what);
    let mut diag = contradiction(message);
    if [other.group, function.group].contains(&RETURN) {
        diag.hint = Some(
            "cycle.return_codes = 1 leaves the level out, as on lathes, where G98 and G99 are \
             feeds."
                .into(),
        );
    }
    diag
}

/// True for a number that each control has for a group, and this one for the function of a setting:
/// one of the group, one that shares it, or the settings give the group other numbers.
fn is_meant(function: &Function, fixed: &Function, all: &[Function]) -> bool {
    if fixed.group == function.group || may_share(fixed.what, function.group) {
        return true;
    }
    let of_group = |is_fixed: bool| {
        all.iter().filter(move |own| own.group == fixed.group && own.fixed == is_fixed)
    };
    let mut own = of_group(false).peekable();
    own.peek().is_some() && !own.any(|own| of_group(true).any(|n| n.tenths == own.tenths))
}

fn may_share(one: &str, other: &str) -> bool {
    MAY_SHARE.iter().any(|pair| *pair == (one, other) || *pair == (other, one))
}

/// The functions that the settings name.
fn named(commons: &Commons, functions: &mut Vec<Function>) {
    for group in GROUPS.iter().filter(|group| (group.acts)(commons)) {
        let space = space(commons, group);
        for row in group.rows {
            let (location, scale) = match row.at {
                At::Whole(at) => (Int(at.0), 10),
                At::Tenths(at) => (at, 1),
            };
            let number = commons.int_opt(location).and_then(|number| u32::try_from(number).ok());
            if let Some(tenths) = number.and_then(|number| number.checked_mul(scale)) {
                let (what, group) = (row.what, group.name);
                functions.push(Function { space, tenths, what, group, fixed: false });
            }
        }
    }
}

/// The functions that each control of the family has.
fn of_control(commons: &Commons, functions: &mut Vec<Function>) {
    let family = commons.read(loc::CONTROL_FAMILY);
    for group in GROUPS.iter().filter(|group| (group.acts)(commons)) {
        let numbers = match (group.space, family) {
            // Klartext has no preparatory functions.
            (Space::G | Space::Cycle, ControlFamily::Klartext) => continue,
            (_, ControlFamily::Sinumerik) => group.sinumerik,
            _ => group.fixed,
        };
        let (space, what) = (space(commons, group), group.name);
        functions.extend(numbers.iter().map(|number| Function {
            space,
            tenths: u32::from(*number) * 10,
            what,
            group: what,
            fixed: true,
        }));
    }
}

/// Cycles are functions of their own in word address alone.
fn space(commons: &Commons, group: &Group) -> Space {
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    match group.space {
        Space::Cycle if by_words => Space::G,
        space => space,
    }
}

/// Work offsets from the lowest to the highest, and the usual one.
fn fixtures(commons: &Commons, functions: &mut Vec<Function>) {
    let number = |at: CodeAt| commons.read(at).and_then(|number| u16::try_from(number).ok());
    let ends = [loc::FIXTURE_MIN_CODE, loc::FIXTURE_MAX_CODE].map(number);
    let [Some(first), Some(last)] = ends else { return };
    if first > last {
        return;
    }
    if commons.read(loc::FIXTURE_FORM) != FixtureForm::GCode {
        return;
    }
    let usual = number(loc::FIXTURE_DEFAULT_CODE);
    // A range may run over other functions (G54 to G129): SET refuses those that it would choose.
    functions.extend([first, last].into_iter().chain(usual).map(|number| Function {
        space: Space::G,
        tenths: u32::from(number) * 10,
        what: FIXTURE,
        group: FIXTURE,
        fixed: false,
    }));
}

/// What a number between those of the work offsets means on this machine besides; `None` for one
/// that is a work offset alone.
pub(super) fn other_than_a_fixture(commons: &Commons, number: u16) -> Option<&'static str> {
    let mut functions = Vec::new();
    named(commons, &mut functions);
    of_control(commons, &mut functions);
    let tenths = u32::from(number) * 10;
    let is_other = |other: &&Function| {
        (other.space, other.tenths) == (Space::G, tenths) && other.group != FIXTURE
    };
    functions.iter().find(is_other).map(|other| other.what)
}

pub(super) fn always(_: &Commons) -> bool {
    true
}

/// G54 to G59 call the length of a tool, as on an Okuma OSP.
pub(super) fn lengths_by_g54(commons: &Commons) -> bool {
    osp_lengths::are_meant(commons)
}

/// They choose a work offset.
pub(super) fn no_lengths_by_g54(commons: &Commons) -> bool {
    !osp_lengths::are_meant(commons)
}

pub(super) fn has_taps(commons: &Commons) -> bool {
    commons.read(loc::CYCLE_TAP_CODE).is_some()
}

/// Lathes whose feeds are G98 and G99 have a turning cycle for G92.
pub(super) fn has_presets(commons: &Commons) -> bool {
    commons.read(loc::FEED_UPM_CODE) != Some(98)
}

/// A control that returns from holes by code means nothing else by it.
pub(super) fn returns_by_codes(commons: &Commons) -> bool {
    // A machine without a tapping cycle has none for left-hand threads either.
    let mut cycles = loc::CYCLE_CODES.iter().filter(|at| **at != loc::CYCLE_TAP_LEFT_CODE);
    cycles.any(|at| commons.read(*at).is_some())
        && commons.read(loc::CYCLE_RETURN_CODES) != CycleReturnCodes::No
        && commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::super::functions::{CHOOSE, NO_FUNCTIONS};
    use super::*;
    use crate::commons::Kind;
    use crate::locations::{Location, TABLE, ValueUnit};

    fn number(at: At) -> u16 {
        match at {
            At::Whole(at) => at.0,
            At::Tenths(at) => at.0,
        }
    }

    #[test]
    fn every_setting_of_a_code_is_in_the_table_once() {
        let rows = GROUPS.iter().flat_map(|group| group.rows).map(|row| number(row.at));
        let others = CHOOSE.iter().chain(NO_FUNCTIONS).map(|at| at.0);
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
    fn names_of_shared_meanings_are_those_of_the_table() {
        let whats = || GROUPS.iter().flat_map(|group| group.rows).map(|row| row.what);
        let names = || GROUPS.iter().map(|group| group.name).chain(whats());
        for (one, other) in MAY_SHARE {
            assert!(names().any(|name| name == *one), "{one}");
            assert!(names().any(|name| name == *other), "{other}");
        }
    }
}
