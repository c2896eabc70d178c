//! Settings over a base, and how they are written.

use std::collections::BTreeMap;
use std::sync::Arc;

use filpost::commons::EMPTY;
use filpost::locations::{self, Location, ValueUnit};
use filpost::{Commons, Kind, Letter, stored, user_blocks};

use crate::bases::Base;

/// What a change sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Key {
    /// A row of the table of settings, by its index.
    Setting(usize),
    /// Tape position and number format of a letter.
    Letter(u8),
    /// A list of texts of the machine, by its index.
    Texts(usize),
}

/// The new value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    /// Of a setting.
    Number(f64),
    /// Of a letter.
    Address(Address),
    /// Of a list of texts.
    Texts(Vec<String>),
}

/// Where a letter stands in a block and how its numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Address {
    pub slot: i32,
    pub format: i32,
    pub spec: i32,
}

/// Tape position of a letter that is not written.
pub(crate) const UNUSED: i32 = 53;

/// INTCOM offsets of the format and the specification of a tape position.
const FORMATS: u32 = 105;
const SPECIFICATIONS: u32 = 158;

/// Some changes that belong together.
pub(crate) type Changes = Vec<(Key, Value)>;

/// A base with changes over it.
#[derive(Clone, Debug)]
pub(crate) struct Machine {
    pub base: Arc<Base>,
    pub changes: BTreeMap<Key, Value>,
}

impl Machine {
    /// A base as it is.
    pub fn new(base: Arc<Base>) -> Machine {
        Machine { base, changes: BTreeMap::new() }
    }

    /// The same with further changes; what is as in the base is no change.
    pub fn with(&self, changes: &[(Key, Value)]) -> Machine {
        let mut machine = self.clone();
        for (key, value) in changes {
            if read(machine.base.commons(), *key) == *value {
                machine.changes.remove(key);
            } else {
                machine.changes.insert(*key, value.clone());
            }
        }
        machine
    }

    /// The same without a change.
    pub fn without(&self, key: Key) -> Machine {
        let mut machine = self.clone();
        machine.changes.remove(&key);
        machine
    }

    /// The same changes over another base.
    pub fn over(&self, base: &Arc<Base>) -> Machine {
        let changes: Changes = self.changes.iter().map(|(k, v)| (*k, v.clone())).collect();
        Machine::new(Arc::clone(base)).with(&changes)
    }

    /// Its settings; `None` for a value that its location can't hold.
    pub fn commons(&self) -> Option<Commons> {
        let mut commons = self.base.commons().clone();
        for (key, value) in &self.changes {
            write(&mut commons, *key, value)?;
        }
        Some(commons)
    }

    /// Short explanations are the likelier ones.
    pub fn price(&self) -> f64 {
        let options = self.base.options.len() as f64 * SETTING;
        options + self.changes.iter().map(|(key, value)| price_of(*key, value)).sum::<f64>()
    }
}

/// Price of a setting.
const SETTING: f64 = 0.3;

/// Price of a code that the machine does not have: other work may need it.
const NO_CODE: f64 = 0.6;

/// Price of a letter, whose format and position are seen in each of its words.
const LETTER: f64 = 0.15;

/// Price of a word of a text, and of one that moves an axis.
const TEXT: f64 = 0.4;
const MOVING_TEXT: f64 = 1.2;

/// More for M codes and messages in a text of the start: they belong to a tool change.
const ODD_TEXT: f64 = 0.05;

fn price_of(key: Key, value: &Value) -> f64 {
    match value {
        Value::Number(EMPTY) if is_code(key) => NO_CODE,
        Value::Number(_) => SETTING,
        Value::Address(_) => LETTER,
        Value::Texts(texts) => {
            let text = texts.join("\n");
            let words = crate::words::blocks(text.as_bytes()).into_iter().flat_map(|b| b.words);
            let is_start = key == Key::Texts(0);
            let price = |letter: u8| match letter {
                _ if b"XYZABCUVW".contains(&letter) => MOVING_TEXT,
                0 | b'M' if is_start => TEXT + ODD_TEXT,
                _ => TEXT,
            };
            words.map(|word| price(word.letter)).sum()
        }
    }
}

fn is_code(key: Key) -> bool {
    matches!(key, Key::Setting(index) if row(index).unit == ValueUnit::Code)
}

/// The row of a setting.
pub(crate) fn row(index: usize) -> &'static Location {
    &locations::TABLE[index]
}

/// The key of a setting by its name.
pub(crate) fn key(name: &str) -> Option<Key> {
    locations::TABLE.iter().position(|row| row.name == name).map(Key::Setting)
}

/// What a machine has for a key.
pub(crate) fn read(commons: &Commons, key: Key) -> Value {
    match key {
        Key::Setting(index) => Value::Number(number(commons, index)),
        Key::Letter(letter) => Value::Address(address(commons, letter)),
        Key::Texts(list) => Value::Texts(user_blocks::IN_COMMONS[list].1.read(commons)),
    }
}

/// What a machine with changes has for a key.
pub(crate) fn read_changed(machine: &Machine, key: Key) -> Value {
    let changed = machine.changes.get(&key).cloned();
    changed.unwrap_or_else(|| read(machine.base.commons(), key))
}

/// The number of a setting.
pub(crate) fn number(commons: &Commons, index: usize) -> f64 {
    let row = row(index);
    commons.get(row.kind, u32::from(row.number)).unwrap_or(EMPTY)
}

/// Where a letter stands and how its numbers are written.
pub(crate) fn address(commons: &Commons, letter: u8) -> Address {
    let int = |location: u32| match commons.get(Kind::Int, location) {
        Ok(value) if value != EMPTY => value as i32,
        _ => 0,
    };
    let slot = int(u32::from(Letter::of(letter).number()));
    if !(1..UNUSED).contains(&slot) {
        return Address { slot: UNUSED, format: 0, spec: 0 };
    }
    let (format, spec) = (int(FORMATS + slot as u32), int(SPECIFICATIONS + slot as u32));
    Address { slot, format, spec }
}

fn write(commons: &mut Commons, key: Key, value: &Value) -> Option<()> {
    match (key, value) {
        (Key::Setting(index), Value::Number(value)) => {
            let row = row(index);
            stored::check(row.kind, row.number.into(), *value).ok()?;
            commons.set(row.kind, row.number.into(), *value).ok()?;
        }
        (Key::Letter(letter), Value::Address(to)) => {
            locations::set_address(commons, letter, to.slot, (to.format, to.spec));
        }
        (Key::Texts(list), Value::Texts(texts)) => {
            let fits = |text: &String| {
                text.len() <= 2 * usize::from(user_blocks::BLOCK_INTEGERS) && text.is_ascii()
            };
            let few = texts.len() <= usize::from(user_blocks::MAX_BLOCKS);
            (few && texts.iter().all(fits)).then_some(())?;
            user_blocks::IN_COMMONS[list].1.store(commons, texts);
        }
        _ => return None,
    }
    Some(())
}

/// The name of what is set, as `machine.toml` has it.
pub(crate) fn name(key: Key) -> String {
    match key {
        Key::Setting(index) => row(index).name.into(),
        Key::Letter(letter) => format!("address.{}", char::from(letter)),
        Key::Texts(list) => user_blocks::IN_COMMONS[list].0.into(),
    }
}

/// A value as `machine.toml` has it.
pub(crate) fn shown(key: Key, value: &Value) -> String {
    match value {
        Value::Number(value) if *value == EMPTY => "\"none\"".into(),
        Value::Number(value) => match key {
            Key::Setting(index) => {
                let choices = row(index).choice_list();
                match choices.iter().find(|(choice, _)| choice == value) {
                    Some((_, "yes")) => "true".into(),
                    Some((_, "no")) => "false".into(),
                    _ => value.to_string(),
                }
            }
            _ => value.to_string(),
        },
        Value::Address(Address { slot, .. }) if *slot == UNUSED => {
            format!("{{ slot = {slot} }}")
        }
        Value::Address(Address { slot, format, spec }) => {
            format!("{{ slot = {slot}, format = {format}, spec = {spec} }}")
        }
        Value::Texts(texts) => format!("{texts:?}"),
    }
}

/// What a choice or a code means, for the reader of `machine.toml`; empty where the value
/// says it.
pub(crate) fn meaning(key: Key) -> &'static str {
    match key {
        Key::Setting(index) => row(index).meaning,
        Key::Letter(_) | Key::Texts(_) => "",
    }
}
