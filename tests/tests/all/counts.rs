//! Everything counts: an item of a record that is changed must change the program
//! or what is said about it, or the table of things without effect has the row; and
//! so must a setting of the machine.

use std::collections::{BTreeMap, HashMap};
use std::env;

use filpost::locations::{Location, TABLE};
use filpost::no_effect::{self, NoEffect};
use filpost_tests::counts::corpus::{Part, parts};
use filpost_tests::counts::excuse::Setting;
use filpost_tests::counts::settings::{Pair, unseen};
use filpost_tests::counts::statement::{Change, Statement};
use filpost_tests::counts::trial::Window;
use filpost_tests::counts::walk;
use filpost_tests::posting::Prepared;
use filpost_tests::sample;

/// Statements of one form that are tried in the normal run.
const SAMPLE: usize = 2;

/// What was tried and what was not noticed.
#[derive(Default)]
struct Tally {
    tried: usize,
    excused: usize,
    /// Rows of the table that excuse something.
    rows: Vec<NoEffect>,
    of_sections: usize,
    /// Statements in texts that the post refuses as they are.
    refused: usize,
    /// Changes that nothing notices: how often, and where first.
    quiet: BTreeMap<String, (usize, String)>,
}

/// One of so many settings is tried in the whole run, of four times as many in the normal one.
const SETTINGS_SAMPLE: usize = 8;

/// FILPOST_COUNTS=all tries every statement and every setting, and not a sample.
fn all() -> bool {
    env::var("FILPOST_COUNTS").is_ok_and(|value| value == "all")
}

/// Tries the statements of a file; `seen` counts those of one form.
fn try_part(part: &Part, seen: &mut HashMap<String, usize>, tally: &mut Tally) {
    let chosen =
        |statement: &Statement, count| !statement.major.is_empty() && (count <= SAMPLE || all());
    let left = walk::each(part, seen, chosen, |window, machine, setting| {
        let statement = &setting.all[setting.at];
        let place = format!("{} line {}: {}", part.name, statement.line, statement.text);
        tally.try_statement(window, machine, setting, &place);
    });
    tally.of_sections += left.of_sections;
    tally.refused += left.refused;
}

impl Tally {
    /// Tries all changes of a statement.
    fn try_statement(
        &mut self,
        window: &Window<'_>,
        machine: &Prepared,
        setting: Setting<'_>,
        place: &str,
    ) {
        let statement = &setting.all[setting.at];
        for (index, change, noticed) in window.tried(machine) {
            self.tried += 1;
            if noticed {
                continue;
            }
            let ignored = statement.is_text() && window.is_ignored();
            match setting.excuse(index, change) {
                _ if ignored => self.excused += 1,
                Some(excuse) => {
                    self.excused += 1;
                    self.rows.extend(excuse.row());
                }
                None => {
                    let name = name(statement, index, change);
                    self.quiet.entry(name).or_insert_with(|| (0, place.to_string())).0 += 1;
                }
            }
        }
    }
}

/// The class of a change: `Other 5 of CYCLE DEPTH`.
fn name(statement: &Statement, index: usize, change: Change) -> String {
    let major = &statement.major;
    if index >= statement.items.len() {
        return format!("{change:?} of {major}");
    }
    match statement.word_before(index) {
        Some(word) => format!("{change:?} number of {major} {word}"),
        None if statement.is_number(index) => format!("{change:?} number {} of {major}", index + 1),
        None if statement.is_text() => format!("{change:?} text of {major}"),
        None => format!("{change:?} {} of {major}", statement.item(index)),
    }
}

#[test]
fn changed_items_are_noticed() {
    let (mut tally, mut seen) = (Tally::default(), HashMap::new());
    for part in parts() {
        try_part(&part, &mut seen, &mut tally);
    }
    println!(
        "{} changes tried, {} without effect by the table; {} statements for sections, {} in texts \
         that are refused",
        tally.tried, tally.excused, tally.of_sections, tally.refused
    );
    for (name, (count, place)) in &tally.quiet {
        println!("{count} times: {name}, first in {place}");
    }
    if all() {
        let of_items = no_effect::rows().filter(|row| row.item != "*");
        let needless: Vec<NoEffect> = of_items.filter(|row| !tally.rows.contains(row)).collect();
        assert!(needless.is_empty(), "rows that no file needs: {needless:#?}");
    }
    assert!(tally.quiet.is_empty(), "{} kinds of changes are not noticed", tally.quiet.len());
    assert!(tally.tried > 1000, "too few changes to prove anything");
}

/// Settings whose value in a file changes no program, and what they are there for.
const NOT_SEEN_IN_PROGRAMS: [&str; 6] = [
    // It begins comments, which are not compared.
    "message.out_char",
    // They describe the axes a second time: a machine that contradicts them is refused.
    "rotary.eia_sense",
    "rotary.zero_at_z",
    // MODE sets it, and a machine file that does is refused.
    "mill_turn.mode",
    // Another one alone contradicts mode.position.
    "mode.absolute_code",
    // Says to `verify` how a program with tool-tip control begins.
    "rotary.tip_control",
];

#[test]
fn changed_settings_are_noticed() {
    let mut pairs: Vec<Pair> = parts().into_iter().filter_map(Pair::new).collect();
    assert!(pairs.len() >= 8, "too few pairs to prove anything");
    let rows = TABLE.iter().filter(|row| row.used && !NOT_SEEN_IN_PROGRAMS.contains(&row.name));
    let step = match () {
        () if all() => 1,
        () if sample::is_whole() => SETTINGS_SAMPLE,
        () => 4 * SETTINGS_SAMPLE,
    };
    let rows: Vec<&Location> = rows.step_by(step).collect();
    let quiet: Vec<String> = rows.iter().flat_map(|row| unseen(&mut pairs, row)).collect();
    println!("{} settings tried on {} pairs", rows.len(), pairs.len());
    assert!(quiet.is_empty(), "{} values are not noticed:\n{}", quiet.len(), quiet.join("\n"));
}
