//! Other values of settings with which every pair comes out the same: what no pair decides.

use std::collections::{BTreeMap, BTreeSet};

use filpost::commons::EMPTY;
use filpost::locations::ValueUnit;
use filpost::{Commons, stored};

use crate::candidates::{self, Alternatives, OTHER_CODE};
use crate::change::{self, Changes, Key, Machine, Value};
use crate::noted::{Noted, Reach};
use crate::readings;
use crate::trial::{Bench, State, Trial};

/// Values of one setting that are kept.
const MOST_VALUES: usize = 6;

/// Settings with other values that make the same programs, in the order of the table; then what
/// changes a machine into one of the others, which make the same programs too.
pub(crate) fn find(
    bench: &Bench<'_>,
    alternatives: &Alternatives,
    state: &State,
    others: &[Machine],
) -> Vec<Changes> {
    let Some(commons) = state.machine.commons() else { return Vec::new() };
    let mut candidates: Vec<Changes> = Vec::new();
    for index in alternatives.rows() {
        let row = change::row(*index);
        let now = change::number(&commons, *index);
        let mut values: Vec<f64> = Vec::new();
        match row.unit {
            ValueUnit::Flag | ValueUnit::Choice => {
                values.extend(row.choice_list().iter().map(|(value, _)| *value));
            }
            // Another number is as good as the one that a post has.
            ValueUnit::Code if now != EMPTY => values.push(OTHER_CODE),
            _ => values.extend(alternatives.of_posts(*index)),
        }
        values.retain(|value| {
            *value != now
                && *value != EMPTY
                && stored::check(row.kind, row.number.into(), *value).is_ok()
        });
        values.sort_by(f64::total_cmp);
        values.dedup();
        values.truncate(MOST_VALUES);
        candidates.extend(values.into_iter().map(|value| candidates::set(*index, value)));
    }
    for letter in b'A'..=b'Z' {
        candidates.extend(readings::other_forms(&commons, letter));
    }
    for list in 0..filpost::user_blocks::IN_COMMONS.len() {
        let other = Value::Texts(vec!["(OTHER)".into()]);
        candidates.push(vec![(Key::Texts(list), other)]);
    }
    // What no run reads decides nothing, without a trial.
    let noted = Noted::new(bench, state);
    let reach = |one: &Changes| noted.as_ref().map_or(Reach::Wrong, |noted| noted.reach_of(one));
    let machines: Vec<Option<Machine>> = candidates
        .iter()
        .map(|one| (reach(one) != Reach::None).then(|| state.machine.with(one)))
        .collect();
    let trials = bench.in_threads(machines.len(), Trial::Worse, |at| {
        machines[at].as_ref().map_or(Trial::Inert, |machine| bench.attempt(machine, state))
    });
    let inert = candidates.into_iter().zip(trials).filter(|(_, trial)| *trial == Trial::Inert);
    let inert = inert.map(|(changes, _)| changes);
    let mut kept: BTreeMap<Vec<Key>, usize> = BTreeMap::new();
    let few = |changes: &Changes| {
        let keys = changes.iter().map(|(key, _)| *key).collect();
        let count = kept.entry(keys).or_default();
        *count += 1;
        *count <= MOST_VALUES
    };
    let into_others = others.iter().map(|other| difference(&state.machine, other));
    inert.chain(into_others.filter(|changes| !changes.is_empty())).filter(few).collect()
}

/// What changes a machine into another one over the same base.
fn difference(machine: &Machine, other: &Machine) -> Changes {
    let keys: BTreeSet<Key> = machine.changes.keys().chain(other.changes.keys()).copied().collect();
    let to = |key: Key| (key, change::read_changed(other, key));
    keys.into_iter()
        .map(to)
        .filter(|(key, to)| change::read_changed(machine, *key) != *to)
        .collect()
}

/// Changes over settings as `--set` takes them; several are lines of one text.
pub(crate) fn text_of(changes: &Changes, commons: &Commons) -> String {
    let mut settings = Vec::new();
    for (key, value) in changes {
        let name = change::name(*key);
        match value {
            Value::Address(to) => {
                let Value::Address(now) = change::read(commons, *key) else { continue };
                let numbers = [
                    ("slot", now.slot, to.slot),
                    ("format", now.format, to.format),
                    ("spec", now.spec, to.spec),
                ];
                for (cell, _, to) in numbers.iter().filter(|(_, now, to)| now != to) {
                    settings.push(format!("{name}.{cell}={to}"));
                }
            }
            Value::Number(_) | Value::Texts(_) => {
                settings.push(format!("{name}={}", change::shown(*key, value)));
            }
        }
    }
    settings.join("\n")
}
