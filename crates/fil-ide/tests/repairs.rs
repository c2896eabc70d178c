//! Repairs for what a run and its checks say.

use std::ops::Range;

use fil_ide::repairs::{Act, Repair, of_diag, of_finding, of_open};
use fil_ide::{Text, machine};
use filpost::locations::Location;
use filpost::{Code, Commons, Diag, Program, TextSpan};

const CL: &str = "UNITS / MM\nCYCEL / OFF\n";

fn commons(text: &str) -> Commons {
    Program::builder().machine("machine.toml", text).build_machine().unwrap()
}

fn code(number: u16) -> &'static Code {
    filpost::all_codes().into_iter().find(|code| code.number == number).unwrap()
}

/// A diagnostic of line 2 of the CL file, whose first word is what is wrong.
fn diag(number: u16) -> Diag {
    let mut place = TextSpan::line("part.ncl", 2, CL.lines().nth(1).unwrap());
    place.span = Range { start: 0, end: 5 };
    Diag::new(code(number), "").at(place)
}

/// The repairs of a hint on a machine.
fn of_hint(hint: &str, machine: &str) -> Vec<Repair> {
    of_diag(&diag(513).hint(hint), Some(&commons(machine)), "part.ncl")
}

fn titles(found: &[Repair]) -> Vec<&str> {
    found.iter().map(|repair| repair.title.as_str()).collect()
}

fn set(repair: &Repair) -> (&str, &str) {
    match &repair.act {
        Act::Set { key, value } => (key, value),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_value_that_the_hint_names_is_set_unless_it_is_there() {
    let found = of_hint("Set cycle.rapto = 1 if it is.", "");
    assert_eq!(set(&found[0]), ("cycle.rapto", "1"));
    assert!(found[0].title.starts_with("set cycle.rapto = 1 ("), "{found:?}");
    let there = of_hint("Set cycle.rapto = 1 if it is.", "cycle.rapto = 1\n");
    assert_eq!(titles(&there), ["show cycle.rapto"]);
    let none = of_hint("Set program.number_address = \"none\". Put it elsewhere.", "");
    assert_eq!(set(&none[0]), ("program.number_address", "\"none\""));
}

#[test]
fn the_choices_that_the_hint_lists_are_offered() {
    let found = of_hint("Set cycle.bore_out: 1 at feed, 2 at rapid.", "");
    assert_eq!(set(&found[0]), ("cycle.bore_out", "1"));
    assert_eq!(set(&found[1]), ("cycle.bore_out", "2"));
    // A setting that only the author can give a value is shown.
    let number = of_hint("Set program.number to another number.", "");
    assert_eq!(number[0].act, Act::Show("program.number"));
}

#[test]
fn a_word_that_was_meant_and_a_statement_are_written_into_the_cl_file() {
    let found = of_hint("did you mean CYCLE?", "");
    let Act::Write(edits) = &found[0].act else { panic!("{found:?}") };
    assert_eq!((edits[0].place.range.end.character, edits[0].text.as_str()), (5, "CYCLE"));
    // The place may be the whole record: the message names the word.
    let mut record = diag(513).hint("did you mean CYCLE or CYCLES?");
    record.message = "no handler for CYCEL".into();
    record.spans[0].span = 0..11;
    let found = of_diag(&record, None, "part.ncl");
    assert_eq!(titles(&found), ["write CYCLE", "write CYCLES"]);
    let Act::Write(edits) = &found[1].act else { panic!("{found:?}") };
    assert_eq!((edits[0].place.range.end.character, edits[0].text.as_str()), (5, "CYCLES"));
    let hint = "Remove it; if it is not, put CYCLE / OFF before it.";
    let found = of_hint(hint, "");
    assert_eq!(titles(&found), ["put CYCLE / OFF before line 2"]);
    let Act::Write(edits) = &found[0].act else { panic!("{found:?}") };
    assert_eq!((edits[0].place.range.start.line, edits[0].text.as_str()), (1, "CYCLE / OFF\n"));
    let units = of_diag(&diag(514), Some(&commons("")), "part.ncl");
    assert_eq!(titles(&units)[..2], ["put UNITS / MM first", "put UNITS / INCHES first"]);
    // In a script it would be another statement.
    assert_eq!(of_diag(&diag(513).hint(hint), None, "other.ncl"), []);
}

#[test]
fn an_unknown_word_is_listed_with_those_that_are() {
    let hint = "Check its spelling, or list it under words.without_effect in machine.toml.";
    let found = of_hint(hint, "[words]\nwithout_effect = [\"SITEWD\"]\n");
    assert_eq!(set(&found[0]), ("words.without_effect", "[\"SITEWD\", \"CYCEL\"]"));
}

#[test]
fn a_warning_can_be_allowed_and_an_error_not() {
    let warned = of_diag(&diag(572), None, "part.ncl");
    assert_eq!(set(warned.last().unwrap()), ("levels.W0572", "\"allow\""));
    let refused = of_diag(&diag(503), None, "part.ncl");
    assert!(refused.iter().all(|repair| !repair.title.contains("allow")), "{refused:?}");
}

#[test]
fn findings_of_a_check_name_their_settings() {
    let limit = of_finding("limit", "X-80 lies outside the travel -50 to 50");
    assert_eq!(titles(&limit), ["show limits.x_min", "show limits.x_max"]);
    let long = of_finding("limit", "a block goes 900 mm, and it may go 500 mm");
    assert_eq!(titles(&long), ["show limits.max_departure"]);
    assert_eq!(
        titles(&of_finding("between", "the tip leaves its line")),
        ["show rotary.tolerance"]
    );
    assert_eq!(of_finding("feed", "F100 in place of F200"), []);
    let open = of_open("NC line 7, `N70 G65 P9001` of an author: the machine has no G65");
    assert_eq!(set(&open[0]), ("effects.\"G65 P9001\"", "\"nothing\""));
    assert_eq!(of_open("NC line 7, `N70 #100=5` of an author: `#`"), []);
    assert_eq!(of_open("AUXFUN: what its M function does was not compared"), []);
}

/// What the hint of a code names is a setting, which can be set.
#[test]
fn each_setting_of_a_hint_can_be_set() {
    let mut count = 0;
    for code in filpost::all_codes() {
        for repair in of_diag(&diag(code.number), Some(&commons("")), "part.ncl") {
            let (key, value) = match &repair.act {
                Act::Set { key, value } => (key, value),
                Act::Show(key) => {
                    assert!(Location::named(key).is_some(), "{code}: {key}");
                    continue;
                }
                Act::Write(_) => continue,
            };
            count += 1;
            let said = machine::edit(&Text::new(""), key, Some(value));
            // Some values need others beside them, which the machine says then.
            let is_known = said.as_ref().err().is_none_or(|why| !why.contains("unknown"));
            assert!(is_known, "{code}: {key} = {value}: {said:?}");
        }
    }
    assert!(count > 60, "{count} repairs");
}
