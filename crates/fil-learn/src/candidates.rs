//! Settings that are worth a trial, from the table of settings, the ready posts and what the
//! proven programs have.

use std::collections::{BTreeMap, BTreeSet};

use filpost::commons::EMPTY;
use filpost::locations::{self, Location, ValueUnit};
use filpost::{Commons, ready, stored};

use crate::change::{self, Changes, Key, Value};
use crate::facts::Facts;
use crate::readings;
use crate::trial::Bench;

/// Values that are sensible for many settings.
const COMMON_NUMBERS: [f64; 15] =
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 10.0, 50.0, 90.0, 100.0, 360.0, 1000.0, 0.1, 0.01, 0.001];

/// The alternatives of settings.
pub(crate) struct Alternatives {
    /// Settings of the ready posts, by name.
    posts: Vec<Commons>,
    /// Rows that a search may change.
    rows: Vec<usize>,
}

impl Alternatives {
    /// Those that `keep` does not name; `posts` are the settings of [`ready_posts`].
    pub fn new(keep: &[String], posts: Vec<Commons>) -> Alternatives {
        let kept = |row: &Location| {
            keep.iter().any(|key| {
                row.name == key || (key.ends_with('.') && row.name.starts_with(key.as_str()))
            })
        };
        let rows = locations::TABLE.iter().enumerate();
        let rows = rows.filter(|(_, row)| row.used && acts_on_programs(row) && !kept(row));
        Alternatives { rows: rows.map(|(index, _)| index).collect(), posts }
    }

    /// The rows that a search may change.
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// A few values of each setting whose values are not a short list: where none of them changes
    /// a program, no other will. `reaches` says which rows may matter.
    pub fn probes(&self, commons: &Commons, reaches: impl Fn(usize) -> bool) -> Vec<Changes> {
        let mut probes = Vec::new();
        for index in self.rows.iter().filter(|index| reaches(**index)) {
            let row = change::row(*index);
            let now = change::number(commons, *index);
            let values = match row.unit {
                _ if !has_many_values(row) => Vec::new(),
                ValueUnit::Code if now == EMPTY => Vec::new(),
                ValueUnit::Code => vec![OTHER_CODE],
                ValueUnit::Letter => vec![f64::from(b'E' - b'A' + 1), EMPTY],
                _ if now == EMPTY => vec![1.0, 50.0],
                _ => vec![2.0 * now + 1.0, (0.5 * now).floor()],
            };
            let holds = |value: &f64| {
                *value != now && stored::check(row.kind, row.number.into(), *value).is_ok()
            };
            probes.extend(values.into_iter().filter(holds).map(|value| set(*index, value)));
        }
        probes
    }

    /// Single settings and groups of them; of settings with many values those that act.
    pub fn all(
        &self,
        commons: &Commons,
        facts: &Facts,
        acting: &BTreeSet<usize>,
        reaches: impl Fn(usize) -> bool,
    ) -> Vec<Changes> {
        let mut found = Vec::new();
        for index in self.rows.iter().filter(|index| reaches(**index)) {
            let row = change::row(*index);
            let is_absent_code =
                row.unit == ValueUnit::Code && change::number(commons, *index) == EMPTY;
            if has_many_values(row) && !is_absent_code && !acting.contains(index) {
                continue;
            }
            let values = self.values(*index, commons, facts);
            found.extend(values.into_iter().map(|value| set(*index, value)));
        }
        found.extend(self.groups(commons, reaches));
        for letter in b'A'..=b'Z' {
            found.extend(readings::other_forms(commons, letter));
            found.extend(self.addresses(commons, letter));
        }
        found
    }

    /// Values of a setting that are worth a trial, other than its own.
    fn values(&self, index: usize, commons: &Commons, facts: &Facts) -> Vec<f64> {
        let row = change::row(index);
        let now = change::number(commons, index);
        let mut values: Vec<f64> = row.choice_list().iter().map(|(value, _)| *value).collect();
        values.extend(self.of_posts(index));
        values.push(row.default_value());
        match row.unit {
            ValueUnit::Code => values.extend(self.codes(now, facts)),
            ValueUnit::Count if looks_like_code(row) => {
                values.extend(facts.codes.iter().map(|code| code * 10.0));
                values.extend(facts.codes.iter().copied());
            }
            ValueUnit::Letter => {
                let letters = facts.letters_missing.iter();
                values.extend(letters.map(|letter| f64::from(letter - b'A' + 1)));
                values.push(EMPTY);
            }
            ValueUnit::Format => {
                let digits = |decimals: i32| [3, 4, 5].map(|whole| whole * 10 + decimals);
                let forms = (0..=4).flat_map(digits).map(|digits| f64::from(digits * 101));
                values.extend(forms);
                values.push(EMPTY);
            }
            ValueUnit::Char => values.extend([EMPTY, 40.0, 41.0, 59.0, 32.0, 37.0, 47.0]),
            ValueUnit::Choice | ValueUnit::Flag | ValueUnit::Plain => {}
            ValueUnit::Ratio => {
                values.extend(&facts.ratios);
                values.extend(facts.ratios.iter().map(|ratio| ratio * now));
                values.extend(COMMON_NUMBERS);
                values.extend([-1.0, 60.0, 0.5, 100.0]);
            }
            _ => {
                values.extend(&facts.numbers);
                values.extend(COMMON_NUMBERS);
                values.extend(&facts.differences);
                if now != EMPTY {
                    values.extend(facts.differences.iter().map(|by| now + by));
                }
            }
        }
        let holds = |value: &f64| {
            *value != now
                && stored::check(row.kind, row.number.into(), *value).is_ok()
                && (*value == EMPTY || row.kind != filpost::Kind::Int || value.fract() == 0.0)
        };
        values.retain(holds);
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    }

    /// Codes that the proven programs have and ours lack; none for one that ours have too often.
    fn codes(&self, now: f64, facts: &Facts) -> Vec<f64> {
        let mut codes = facts.codes_missing.clone();
        if now == EMPTY {
            // A code that is in force at the start is one that the proven programs leave out.
            codes.extend(&facts.codes_in_excess);
            return codes;
        }
        codes.extend(&facts.codes);
        if facts.codes_in_excess.contains(&now) {
            codes.push(EMPTY);
        }
        codes
    }

    /// What the ready posts have for a setting.
    pub fn of_posts(&self, index: usize) -> Vec<f64> {
        self.posts.iter().map(|commons| change::number(commons, index)).collect()
    }

    /// A group of settings as a ready post has it.
    fn groups(&self, commons: &Commons, reaches: impl Fn(usize) -> bool) -> Vec<Changes> {
        let mut by_group: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for index in &self.rows {
            by_group.entry(group(*index)).or_default().push(*index);
        }
        let mut seen = BTreeSet::new();
        let mut found = Vec::new();
        for rows in by_group.values().filter(|rows| rows.iter().any(|index| reaches(*index))) {
            for post in &self.posts {
                let value = |index: &usize| change::number(post, *index);
                let differ = rows.iter().filter(|at| value(at) != change::number(commons, **at));
                let changes: Changes =
                    differ.map(|at| (Key::Setting(*at), Value::Number(value(at)))).collect();
                if changes.len() > 1 && seen.insert(format!("{changes:?}")) {
                    found.push(changes);
                }
            }
        }
        found
    }

    /// The digits of a letter as a ready post has them, at its place.
    fn addresses(&self, commons: &Commons, letter: u8) -> Vec<Changes> {
        let now = change::address(commons, letter);
        let mut found: Vec<Changes> = Vec::new();
        for post in &self.posts {
            let of_post = change::address(post, letter);
            if of_post.slot == change::UNUSED || now.slot == change::UNUSED {
                continue;
            }
            let to = change::Address { slot: now.slot, ..of_post };
            let changes = vec![(Key::Letter(letter), Value::Address(to))];
            if to != now && !found.contains(&changes) {
                found.push(changes);
            }
        }
        found
    }
}

/// Settings of the ready posts, by name.
pub(crate) fn ready_posts(bench: &Bench<'_>) -> Vec<Commons> {
    let build = |index: usize| {
        filpost::Program::builder().generic(ready::READY[index].name).build_machine().ok()
    };
    bench.in_threads(ready::READY.len(), None, build).into_iter().flatten().collect()
}

/// One setting as changes.
pub(crate) fn set(index: usize, value: f64) -> Changes {
    vec![(Key::Setting(index), Value::Number(value))]
}

/// The group of a setting: what precedes the point of its name.
pub(crate) fn group(index: usize) -> &'static str {
    change::row(index).name.split('.').next().unwrap_or_default()
}

/// A setting that can show in a program, and is no text.
fn acts_on_programs(row: &Location) -> bool {
    const OTHERS: [&str; 6] =
        ["list.", "blocks.", "package.", "control.family", "tape.leader", "tape.trailer"];
    const RISKY: [&str; 7] = [
        "tape.encoding",
        "tape.block_macro",
        "tape.edit_macro",
        "mill_turn.mode",
        "input.creo_records",
        "program.time_stamp",
        "limits.",
    ];
    !OTHERS.iter().chain(&RISKY).any(|begin| row.name.starts_with(begin))
        && row.unit != ValueUnit::Plain
}

/// A setting whose values are a short list.
pub(crate) fn has_few_values(key: Key) -> bool {
    matches!(key, Key::Setting(index) if !has_many_values(change::row(index)))
}

/// Each number could be a value, not only a few.
fn has_many_values(row: &Location) -> bool {
    !matches!(row.unit, ValueUnit::Flag | ValueUnit::Choice | ValueUnit::Char | ValueUnit::Plain)
}

/// A code that no machine has.
pub(crate) const OTHER_CODE: f64 = 77.0;

/// A count that is a code with its digit after the point.
fn looks_like_code(row: &Location) -> bool {
    row.name.ends_with("_code") || row.name.ends_with("_mode")
}
