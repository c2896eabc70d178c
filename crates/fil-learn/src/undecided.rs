//! Other values of settings with which every pair comes out the same: what no pair decides.

use std::collections::BTreeMap;

use filpost::commons::EMPTY;
use filpost::locations::ValueUnit;
use filpost::{Commons, stored};

use crate::candidates::{self, Alternatives, OTHER_CODE};
use crate::change::{self, Changes, Key, Machine, Value};
use crate::noted::{Noted, Reach};
use crate::readings;
use crate::trial::{Bench, State, Trial};

/// Values of one setting that are kept.
const MOST_VALUES: usize = 3;

/// Settings with other values that make the same programs, in the order of the table.
pub(crate) fn find(bench: &Bench<'_>, alternatives: &Alternatives, state: &State) -> Vec<Changes> {
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
            ValueUnit::Code => {}
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
    for list in 0..filpost::user_blocks::LISTS.len() {
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
    let mut kept: BTreeMap<Key, usize> = BTreeMap::new();
    let inert = candidates.into_iter().zip(trials).filter(|(_, trial)| *trial == Trial::Inert);
    inert
        .map(|(changes, _)| changes)
        .filter(|changes| {
            let count = kept.entry(changes[0].0).or_default();
            *count += 1;
            *count <= MOST_VALUES
        })
        .collect()
}

/// A change over settings as `--set` takes it.
pub(crate) fn settings_of(changes: &Changes, commons: &Commons) -> Vec<String> {
    let mut settings = Vec::new();
    for (key, value) in changes {
        let name = change::name(*key);
        match value {
            Value::Address(to) => {
                let Value::Address(now) = change::read(commons, *key) else { continue };
                if to.format != now.format {
                    settings.push(format!("{name}.format={}", to.format));
                }
                if to.spec != now.spec {
                    settings.push(format!("{name}.spec={}", to.spec));
                }
            }
            Value::Number(_) | Value::Texts(_) => {
                settings.push(format!("{name}={}", change::shown(*key, value)));
            }
        }
    }
    settings
}
