//! `filpost machine show --json`: settings as data, for programs that ask or change them.

use filpost::commons::EMPTY;
use filpost::locations::{Location, TABLE};
use filpost::{Commons, Program, explain, ready, user_blocks};
use serde_json::{Map, Value, json};

use super::{LETTERS, slot};

/// The settings whose name starts with `prefix`, by their name; `only` says which.
pub fn settings(commons: &Commons, prefix: &str, only: impl Fn(&Location) -> bool) -> Value {
    let posts = ready_posts();
    let rows = TABLE.iter().filter(|row| row.name.starts_with(prefix) && only(row));
    // A list of blocks fills many locations, and is shown as a list.
    let rows = rows
        .filter(|row| row.kind != filpost::Kind::Int || user_blocks::list_of(row.number).is_none());
    let mut shown: Map<String, Value> =
        rows.map(|row| (row.name.into(), setting(row, commons, &posts))).collect();
    for letter in LETTERS {
        let name = format!("address.{}", char::from(letter));
        if name.starts_with(prefix) {
            shown.insert(name, json!({"value": address(commons, letter)}));
        }
    }
    for (name, list) in user_blocks::LISTS {
        if name.starts_with(prefix) {
            shown.insert(name.into(), json!({"value": list.read(commons)}));
        }
    }
    Value::Object(shown)
}

/// A setting with what its table says of it, and the values that the ready posts have.
fn setting(row: &Location, commons: &Commons, posts: &[Commons]) -> Value {
    let choices: Vec<Value> = row
        .choice_list()
        .iter()
        .map(|(choice, meaning)| json!({"value": value(row, *choice), "meaning": meaning}))
        .collect();
    let mut seen: Vec<f64> = posts.iter().map(|post| number(row, post)).collect();
    seen.sort_by(f64::total_cmp);
    seen.dedup();
    let seen: Vec<Value> = seen.into_iter().map(|number| value(row, number)).collect();
    json!({
        "value": value(row, number(row, commons)),
        "default": value(row, row.default_value()),
        "unit": row.unit.to_string(),
        "choices": choices,
        "in_ready_posts": seen,
        "meaning": row.meaning,
        "used": row.used,
        "idle": row.idle,
        "evidence": row.evidence.to_string(),
        "common": row.kind.name(),
        "location": row.number,
    })
}

/// A number as `machine.toml` has it.
fn value(row: &Location, number: f64) -> Value {
    let choice = row.choice_list().into_iter().find(|(choice, _)| *choice == number);
    match choice {
        _ if number == EMPTY => json!("none"),
        Some((_, "yes")) => json!(true),
        Some((_, "no")) => json!(false),
        _ => {
            explain::value(number).parse::<serde_json::Number>().map_or(json!(number), Value::from)
        }
    }
}

/// A setting has another value than in other settings.
pub fn differs(row: &Location, commons: &Commons, other: &Commons) -> bool {
    number(row, commons) != number(row, other)
}

fn number(row: &Location, commons: &Commons) -> f64 {
    commons.get(row.kind, u32::from(row.number)).unwrap_or(EMPTY)
}

fn ready_posts() -> Vec<Commons> {
    let build = |post: &ready::ReadyPost| {
        let program = Program::builder().ready(post.name).build().ok()?;
        Some(program.commons().clone())
    };
    ready::READY.iter().filter_map(build).collect()
}

/// The slot of a letter.
fn address(commons: &Commons, letter: u8) -> Value {
    match slot(commons, letter) {
        None => json!("none"),
        Some(parts) => {
            let [slot, format, spec] = parts.map(|part| part as i64);
            json!({"slot": slot, "format": format, "spec": spec})
        }
    }
}
