//! The JSON schema of `machine.toml`.

use filpost::effects::Effect;
use filpost::locations::{Location, TABLE, ValueUnit};
use filpost::{Level, LevelProfile, user_blocks};
use serde_json::{Map, Value, json};

/// The JSON schema of `machine.toml`, from the table of locations.
pub fn schema() -> Value {
    let mut properties = Map::new();
    for row in TABLE {
        let mut path: Vec<&str> = row.name.split('.').collect();
        let key = path.pop().unwrap_or(row.name);
        let group = path.into_iter().fold(&mut properties, |map, part| inner(map, part));
        group.insert(key.into(), setting(row));
    }
    let text = json!({"type": "string"});
    for about in ["name", "description", "origin", "base", "chain"] {
        properties.insert(about.into(), text.clone());
    }
    let blocks = json!({"type": "array", "items": text, "maxItems": 10});
    for (name, _) in user_blocks::LISTS {
        if let Some((group, key)) = name.split_once('.') {
            inner(&mut properties, group).insert(key.into(), blocks.clone());
        }
    }
    properties.insert("address".into(), addresses());
    properties.insert("learned".into(), learned());
    properties.insert("levels".into(), levels());
    let value = json!({"type": ["string", "number", "boolean"]});
    properties.insert(
        "options".into(),
        json!({
            "type": "object",
            "description": "Values of options of the post: `filpost posts NAME` lists them.",
            "additionalProperties": value,
        }),
    );
    properties.insert("option".into(), declarations());
    properties.insert("effects".into(), effects());
    properties.insert("simulate".into(), simulate());
    for kind in ["int", "rel", "dbl"] {
        let numbers = json!({"type": "object", "patternProperties": {"^[0-9]+$": number()}});
        inner(&mut properties, "imported").insert(kind.into(), numbers.clone());
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
    if matches!(row.unit, ValueUnit::Letter | ValueUnit::Char) {
        forms.push(json!({"type": "string", "minLength": 1, "maxLength": 1}));
    }
    if choices.is_empty() {
        forms.push(json!({"type": "number"}));
    } else {
        forms.push(json!({"enum": choices.iter().map(|(value, _)| value).collect::<Vec<_>>()}));
    }
    if row.name == "tape.encoding" {
        forms.push(json!({"type": "string"}));
    }
    let listed: Vec<String> =
        choices.iter().map(|(value, meaning)| format!("{value} = {meaning}")).collect();
    let mut description = row.meaning.to_string();
    if !listed.is_empty() {
        description.push_str(&format!(" {}.", listed.join(", ")));
    }
    json!({"anyOf": forms, "description": description})
}

/// `[learned]`: what `filpost learn` could not decide.
fn learned() -> Value {
    let settings = json!({
        "type": "array",
        "items": {"type": "string"},
        "description": "Settings as KEY=VALUE: with these values the proven programs come out the \
            same. `filpost post` warns where one would change a program.",
    });
    let programs = json!({
        "type": "array",
        "items": {"type": "string"},
        "description": "Proven programs that come out differently. `filpost post` warns while \
            there are any.",
    });
    json!({
        "type": "object",
        "properties": {"undecided": settings, "unequal": programs},
        "additionalProperties": false,
    })
}

/// `[levels]`: the profile, and the level of all codes or of one.
fn levels() -> Value {
    let level = json!({"enum": Level::ALL.map(Level::name)});
    json!({
        "type": "object",
        "description": "What happens to findings that may not be what is meant.",
        "properties": {
            "profile": {"enum": LevelProfile::ALL.map(LevelProfile::name)},
            "all": level,
        },
        "patternProperties": {"^[EW][0-9]{4}$": level},
        "additionalProperties": false,
    })
}

/// `[option.NAME]`: the declaration of an option of the post.
fn declarations() -> Value {
    let text = json!({"type": "string"});
    let value = json!({"type": ["string", "number", "boolean"]});
    let settings = json!({"type": "object"});
    json!({
        "type": "object",
        "description": "Options of the post, which `--option NAME=VALUE` and `[options]` choose.",
        "patternProperties": {"^[a-z0-9-]+$": {
            "type": "object",
            "properties": {
                "type": {"enum": ["bool", "integer", "length", "choice", "text"]},
                "default": value,
                "base_default": value,
                "group": text,
                "help": text,
                "min": {"type": "number"},
                "max": {"type": "number"},
                "set": text,
                "yes": settings,
                "no": settings,
                "choices": {"anyOf": [
                    {"type": "array", "items": text},
                    {"type": "object", "additionalProperties": settings},
                ]},
            },
            "required": ["type", "default", "group", "help"],
            "additionalProperties": false,
        }},
        "additionalProperties": false,
    })
}

/// `[effects]`: a block, a word or a pattern, and what it does.
fn effects() -> Value {
    json!({
        "type": "object",
        "description": "What calls and codes of the shop do.",
        "additionalProperties": {"enum": Effect::ALL.map(Effect::name)},
    })
}

/// `[simulate]`: what `filpost simulate` cuts.
fn simulate() -> Value {
    let text = |description: &str| json!({"type": "string", "description": description});
    let length =
        |description: &str| json!({"type": ["number", "string"], "description": description});
    let texts = |pattern: &str, description: &str| {
        json!({
            "type": "object",
            "description": description,
            "patternProperties": {pattern: {"type": "string"}},
            "additionalProperties": false,
        })
    };
    json!({
        "type": "object",
        "description": "What `filpost simulate` and `filpost verify --stock` cut.",
        "properties": {
            "stock": text("The stock: `box 100x80x30 at X,Y,Z`, `cylinder 60x100`, `tube 60x20x100`, `auto`, or an STL file."),
            "part": text("The STL file of the finished part."),
            "part_tol": length("Depth that a cut may be within the part, mm; 0.05 by default."),
            "grid": length("Size of a cell, mm; a 400th of the stock by default."),
            "tools": texts("^[0-9]+$", "Sizes of tools by their numbers: `1 = \"D10R0.5L50H40x60\"`."),
            "offsets": texts("^[A-Z]", "Zeros of further work offsets in the first one: `G55 = \"60,0,0\"`."),
        },
        "additionalProperties": false,
    })
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
