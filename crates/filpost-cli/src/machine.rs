//! `filpost machine`

use std::path::Path;

use filpost::locations::{Location, TABLE};
use filpost::{Commons, Error, Kind, Post, files, ready, settings};
use serde_json::{Map, Value, json};

use crate::args::{Chosen, MachineArgs, MachineCommand};
use crate::output::{self, Target};
use crate::{Status, explain, setup, summary};

/// Letters of the address table.
const LETTERS: std::ops::RangeInclusive<u8> = b'A'..=b'Z';

/// INTCOM offsets of the format and the specification of a tape position.
const FORMAT: u32 = 105;
const SPECIFICATION: u32 = 158;

/// Tape position of a letter the machine lacks.
const NOT_USED: f64 = 53.0;

/// Imports or shows machine settings.
///
/// # Errors
/// Files that can't be read or written; wrong settings.
pub fn run(args: &MachineArgs) -> Result<Status, Error> {
    match &args.command {
        MachineCommand::Import { file, output, encoding } => {
            import(file, output.as_deref(), encoding.as_deref())?;
        }
        MachineCommand::Show { chosen, prefix } => show(chosen, prefix.as_deref())?,
        MachineCommand::Schema => output::print(format!("{:#}\n", schema()).as_bytes())?,
    }
    Ok(Status::Done)
}

fn import(file: &Path, output: Option<&Path>, encoding: Option<&str>) -> Result<(), Error> {
    let name = file.display().to_string();
    let text = files::read_text(file, encoding)?;
    let imported = settings::read_option_file(&name, &text).map_err(Error::Run)?;
    let title = Value::String(imported.title).to_string();
    let toml = format!("name = {title}\n\n{}", settings::write_toml(&imported.commons));
    Target::new(output).write(|writer| {
        writer.write_all(toml.as_bytes()).map_err(|error| output::stdout_error(&error))
    })?;
    summary::warnings(&imported.warnings);
    Ok(())
}

fn show(chosen: &Chosen, prefix: Option<&str>) -> Result<(), Error> {
    let builder = match setup::named(chosen, None)? {
        Some(named) => named.builder,
        None => {
            let generic = Post::builder().ready(ready::GENERIC_MILL);
            chosen.set.iter().fold(generic, |builder, setting| builder.set(setting))
        }
    };
    let post = builder.build()?;
    summary::warnings(post.warnings());
    let prefix = prefix.unwrap_or("");
    output::print_with(|out| {
        for row in TABLE.iter().filter(|row| row.name.starts_with(prefix)) {
            let value = explain::shown_value(row, post.commons());
            let used = if row.used { "used" } else { "not used" };
            writeln!(
                out,
                "{:<28} {value}\n{:>28} {} {}, {}, {}, {used}: {}",
                row.name,
                "",
                row.kind.name(),
                row.number,
                row.unit,
                row.evidence,
                row.meaning
            )?;
        }
        if prefix.is_empty() || "address".starts_with(prefix) {
            for letter in LETTERS {
                writeln!(out, "{}", address(post.commons(), letter))?;
            }
        }
        Ok(())
    })
}

/// A letter with its tape position, format and specification.
fn address(commons: &Commons, letter: u8) -> String {
    let int = |location: u32| commons.get(Kind::Int, location).unwrap_or(NOT_USED);
    let name = char::from(letter);
    let slot = int(u32::from(filpost::address::letter(letter)));
    if !(1.0..NOT_USED).contains(&slot) {
        return format!("address.{name:<20} none");
    }
    let (format, specification) = (int(FORMAT + slot as u32), int(SPECIFICATION + slot as u32));
    let format = explain::value(format);
    format!("address.{name:<20} slot {slot}, format {format}, spec {specification}")
}

/// The JSON schema of `machine.toml`, from the table of locations.
fn schema() -> Value {
    let mut properties = Map::new();
    for row in TABLE {
        let mut path: Vec<&str> = row.name.split('.').collect();
        let key = path.pop().unwrap_or(row.name);
        let group = path.into_iter().fold(&mut properties, |map, part| inner(map, part));
        group.insert(key.into(), setting(row));
    }
    let text = json!({"type": "string"});
    for about in ["name", "description", "origin"] {
        properties.insert(about.into(), text.clone());
    }
    let blocks = json!({"type": "array", "items": text, "maxItems": 10});
    inner(&mut properties, "blocks").insert("start".into(), blocks.clone());
    inner(&mut properties, "blocks").insert("end".into(), blocks);
    properties.insert("address".into(), addresses());
    for kind in ["int", "rel", "dbl"] {
        let numbers = json!({"type": "object", "patternProperties": {"^[0-9]+$": number()}});
        properties.insert(kind.into(), numbers);
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "machine.toml of filpost",
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
    })
}

/// The properties of a table within a table, made when it is not there.
fn inner<'m>(map: &'m mut Map<String, Value>, part: &str) -> &'m mut Map<String, Value> {
    let empty = || json!({"type": "object", "properties": {}, "additionalProperties": false});
    let table = map.entry(part).or_insert_with(empty);
    table["properties"].as_object_mut().expect("tables of the schema have properties")
}

fn number() -> Value {
    json!({"anyOf": [{"type": "number"}, {"const": "none"}]})
}

fn setting(row: &Location) -> Value {
    let choices = row.choice_list();
    let mut forms = vec![json!({"const": "none"})];
    if choices.iter().any(|(_, meaning)| matches!(*meaning, "yes" | "no")) {
        forms.push(json!({"type": "boolean"}));
    }
    if matches!(row.unit, "letter" | "char") {
        forms.push(json!({"type": "string", "minLength": 1, "maxLength": 1}));
    }
    if choices.is_empty() {
        forms.push(json!({"type": "number"}));
    } else {
        forms.push(json!({"enum": choices.iter().map(|(value, _)| value).collect::<Vec<_>>()}));
    }
    let listed: Vec<String> =
        choices.iter().map(|(value, meaning)| format!("{value} = {meaning}")).collect();
    let mut description = row.meaning.to_string();
    if !listed.is_empty() {
        description.push_str(&format!(" {}.", listed.join(", ")));
    }
    json!({"anyOf": forms, "description": description})
}

fn addresses() -> Value {
    let whole = json!({"type": "integer"});
    let text = json!({"type": "string", "maxLength": 1});
    json!({
        "type": "object",
        "patternProperties": {"^[A-Z]$": {
            "type": "object",
            "properties": {"slot": whole, "format": whole, "spec": whole, "char": text},
            "additionalProperties": false,
        }},
        "additionalProperties": false,
    })
}
