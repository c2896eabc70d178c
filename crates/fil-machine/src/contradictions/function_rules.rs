//! No number of a function means two things.

use fil_diag::Diag;

use super::contradiction;
use crate::commons::Commons;
use crate::function_code::FunctionCode;
use crate::functions::{self, Dialect, FUNCTIONS, Meaning, Origin, Space};
use crate::locations::{self as loc, ControlFamily, FixtureForm};
use crate::setting::CodeAt;

/// The kind of work offsets, whose settings are a range.
const FIXTURE: &str = "a work offset";

/// Titles and kinds of functions that may have one number: a control tells them apart by the other
/// words of the block, or they are one to it.
const MAY_SHARE: &[(&str, &str)] = &[
    ("a preset of the axes", "the spindle speed limit"),
    ("a preset of the axes", "the cycle of a thread"),
    ("deep drilling", "chip breaking"),
    // A shop stops at each OPSTOP.
    ("a stop", "an optional stop"),
    ("a hole", "a hole by a live tool"),
    ("deep drilling", "a hole by a live tool"),
    ("chip breaking", "a hole by a live tool"),
    ("the spindle clockwise", "the default direction of the spindle"),
    ("the spindle counterclockwise", "the default direction of the spindle"),
    // M5 of a SINUMERIK makes the axis C the spindle again.
    ("the spindle's stop", "the switch to turning"),
    ("the spindle", "the switch to turning"),
    // M30 ends the program of a mill and rewinds it.
    ("the end of the program", "the end with rewind"),
    // M99 ends a program as well.
    ("a call of a program", "the end of the program"),
    ("a call of a program", "the end with rewind"),
    ("tool length offset by G53 to G59", "the tool length offset"),
    ("tool length offset by G53 to G59", "the cancel of the tool length offset"),
];

/// A number and what it stands for. Sorted by number, so that those of one stand together: scripts
/// change settings in each record.
#[derive(Clone, Copy)]
struct Function {
    space: Space,
    code: FunctionCode,
    what: &'static str,
    kind: &'static str,
    meaning: Meaning,
    /// Each control has it; a setting names it else.
    fixed: bool,
}

impl Function {
    fn of(row: &functions::Function, code: FunctionCode, commons: &Commons, fixed: bool) -> Self {
        let what = if fixed { row.kind } else { row.title };
        let space = space(commons, row.space);
        Function { space, code, what, kind: row.kind, meaning: row.meaning, fixed }
    }
}

/// Finds functions of two meanings.
pub(super) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    let mut functions = Vec::with_capacity(200);
    named(commons, &mut functions);
    fixtures(commons, &mut functions);
    of_control(commons, &mut functions);
    // A stable sort: those of the settings stay in the order of the table, before the others.
    functions.sort_by_key(|function| (function.space, function.code));
    for same in functions.chunk_by(|a, b| (a.space, a.code) == (b.space, b.code)) {
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
    let message = format!("{letter}{} is both {} and {}", function.code, other.what, function.what);
    let mut diag = contradiction(message);
    if [other.meaning, function.meaning].contains(&Meaning::ReturnPlane) {
        diag.hint = Some(
            "cycle.return_codes = 1 leaves out the return plane, as on lathes, where G98 and G99 are feed modes."
                .into(),
        );
    }
    diag
}

/// True for a number that each control has for a kind, and this one for the function of a setting:
/// one of the kind, one that shares it, or the settings give the kind other numbers.
fn is_meant(function: &Function, fixed: &Function, all: &[Function]) -> bool {
    if fixed.kind == function.kind || may_share(fixed.what, function.kind) {
        return true;
    }
    let of_kind = |is_fixed: bool| {
        all.iter().filter(move |own| own.kind == fixed.kind && own.fixed == is_fixed)
    };
    let mut own = of_kind(false).peekable();
    own.peek().is_some() && !own.any(|own| of_kind(true).any(|n| n.code == own.code))
}

fn may_share(one: &str, other: &str) -> bool {
    MAY_SHARE.iter().any(|pair| *pair == (one, other) || *pair == (other, one))
}

/// The functions that the settings name.
fn named(commons: &Commons, functions: &mut Vec<Function>) {
    let dialect = Dialect::of(commons);
    let is_there = |row: &&functions::Function| {
        row.standard(dialect).is_some() && row.when.is_reserved(commons)
    };
    for row in FUNCTIONS.iter().filter(is_there) {
        let codes = row.settings.iter().filter_map(|setting| setting.code(commons));
        functions.extend(codes.map(|code| Function::of(row, code, commons, false)));
    }
}

/// The functions that each control of the family has.
fn of_control(commons: &Commons, functions: &mut Vec<Function>) {
    let dialect = Dialect::of(commons);
    let is_klartext = commons.read(loc::CONTROL_FAMILY) == ControlFamily::Klartext;
    // Klartext has no preparatory functions.
    let is_there = |row: &&functions::Function| {
        row.when.is_reserved(commons) && (row.space == Space::M || !is_klartext)
    };
    for row in FUNCTIONS.iter().filter(is_there) {
        let numbers = row.standard(dialect).unwrap_or(&[]).iter().filter(|n| n.reserved);
        let codes = numbers.flat_map(|n| n.codes());
        functions.extend(codes.map(|code| Function::of(row, code, commons, true)));
    }
}

/// Cycles are functions of their own in word address alone.
fn space(commons: &Commons, space: Space) -> Space {
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    match space {
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
        code: FunctionCode::whole(number),
        what: FIXTURE,
        kind: FIXTURE,
        meaning: Meaning::Origin(Origin::WorkOffset),
        fixed: false,
    }));
}

/// What a number between those of the work offsets means on this machine besides; `None` for one
/// that is a work offset alone.
pub(super) fn other_than_a_fixture(commons: &Commons, number: u16) -> Option<&'static str> {
    let mut functions = Vec::new();
    named(commons, &mut functions);
    of_control(commons, &mut functions);
    let code = FunctionCode::whole(number);
    let is_other =
        |other: &&Function| (other.space, other.code) == (Space::G, code) && other.kind != FIXTURE;
    functions.iter().find(is_other).map(|other| other.what)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_shared_meanings_are_those_of_the_table() {
        let names = FUNCTIONS.iter().flat_map(|row| [row.kind, row.title]);
        for (one, other) in MAY_SHARE {
            assert!(names.clone().any(|name| name == *one), "{one}");
            assert!(names.clone().any(|name| name == *other), "{other}");
        }
    }
}
