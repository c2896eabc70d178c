//! The settings of a machine as a form: each with its text, its default, its choices, what the base
//! has, and what this machine.toml says.

use std::collections::HashMap;

use fil_ide::{Text, machine};
use filpost::commons::{EMPTY, NA};
use filpost::locations::{Location, TABLE};
use filpost::{Commons, Kind, OptionKind, PostOption, Program, user_blocks};
use serde_json::{Value, json};

use crate::fields::{Fields, Named};
use crate::{Fault, Misuse, refused};

/// Answers with the `base`, the `settings`, the `options` and the `blocks` of a `machine.toml`; FIL files may declare
/// options too. `errors` where the machine can't be read.
pub(crate) fn form(mut fields: Fields) -> Result<Value, Misuse> {
    let text = fields.needed("text")?;
    let fil = fields.files("fil")?;
    fields.end()?;
    let own: HashMap<String, String> = machine::values(&Text::new(&text)).into_iter().collect();
    let base = own.get("base").map(|name| name.trim_matches(['"', '\'']).to_string());
    let of_base = base.as_ref().map_or(String::new(), |name| format!("base = {name:?}\n"));
    let made = commons(&text, &fil).and_then(|now| Ok((now, commons(&of_base, &[])?)));
    let (now, before) = match made {
        Ok(made) => made,
        Err(error) => return Ok(refused(&Fault::Setup(error), &[])),
    };
    let rows = TABLE.iter().filter(|row| !is_block_text(row));
    Ok(json!({
        "base": base,
        "settings": rows.map(|row| setting(row, &now, &before, &own)).collect::<Vec<_>>(),
        "options": now.options().all().iter().map(|option| post_option(option, &own)).collect::<Vec<_>>(),
        "blocks": user_blocks::LISTS.iter().map(|(name, list)| {
            json!({ "key": name, "value": list.read(&now), "base": list.read(&before), "own": own.get(*name) })
        }).collect::<Vec<_>>(),
    }))
}

/// The settings of a machine.toml and of the options that FIL files declare.
fn commons(text: &str, fil: &[Named]) -> Result<Commons, filpost::Error> {
    let builder = Program::builder().machine("machine.toml", text);
    let builder = fil.iter().fold(builder, |builder, file| builder.fil(&file.name, &file.text));
    builder.build_machine()
}

/// A location that holds letters of a user block: the lists are shown as texts.
fn is_block_text(row: &Location) -> bool {
    row.kind == Kind::Int && user_blocks::list_of(row.number).is_some()
}

fn setting(
    row: &Location,
    now: &Commons,
    before: &Commons,
    own: &HashMap<String, String>,
) -> Value {
    let value = |at: &Commons| number(at.get(row.kind, u32::from(row.number)).unwrap_or(EMPTY));
    let choices: Vec<Value> = row.choice_list().into_iter().map(|pair| json!(pair)).collect();
    json!({
        "key": row.name,
        "meaning": row.meaning,
        "unit": row.unit.to_string(),
        "choices": choices,
        "default": number(row.default_value()),
        "base": value(before),
        "value": value(now),
        "own": own.get(row.name),
        "acts": row.used,
    })
}

/// A value; null for none.
fn number(value: f64) -> Value {
    if value == EMPTY || value == f64::from(NA) { Value::Null } else { json!(value) }
}

fn post_option(option: &PostOption, own: &HashMap<String, String>) -> Value {
    let choices = match &option.kind {
        OptionKind::Choice(names) => names.clone(),
        OptionKind::Bool => vec!["yes".to_string(), "no".to_string()],
        OptionKind::Integer { .. } | OptionKind::Length { .. } | OptionKind::Text => Vec::new(),
    };
    json!({
        "name": option.name,
        "kind": option.kind.name(),
        "values": option.kind.values(),
        "choices": choices,
        "default": option.default.to_string(),
        "value": option.value.to_string(),
        "group": option.group,
        "help": option.help,
        "own": own.get(&format!("options.{}", option.name)),
    })
}

/// Answers with the `text` of a `machine.toml` in which a key has a value as TOML writes it, or is not there
/// where the value is null; or with `why` not.
pub(crate) fn set(mut fields: Fields) -> Result<Value, Misuse> {
    let text = Text::new(&fields.needed("text")?);
    let key = fields.needed("key")?;
    let value = fields.text("value")?;
    fields.end()?;
    Ok(match machine::edit(&text, &key, value.as_deref()) {
        Ok((range, new)) => {
            let (from, to) = (text.byte(range.start), text.byte(range.end));
            let whole = text.as_str();
            json!({ "text": format!("{}{new}{}", &whole[..from], &whole[to..]) })
        }
        Err(why) => json!({ "why": why }),
    })
}

/// Answers with the keys of a case.toml as `case`, or with `why` it is none.
pub(crate) fn case(mut fields: Fields) -> Result<Value, Misuse> {
    let text = fields.needed("text")?;
    fields.end()?;
    Ok(match toml::from_str::<Value>(&text) {
        Ok(keys) => json!({ "case": keys }),
        Err(error) => json!({ "why": error.message() }),
    })
}
