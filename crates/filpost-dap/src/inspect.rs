//! Requests that look at a run that stands still, or set something in it.

use filpost::Kind;
use filpost::cl::record::WordView;
use filpost::debug::{DebugState, Held, evaluate, shown};
use filpost::locations::Location;
use serde_json::{Value, json};

use crate::breakpoints::watch_id;
use crate::edits::{Edit, NewWord};
use crate::hook::Hook;

/// References of the scopes; arrays follow.
const NAMES: u64 = 1;
const PARAMETERS: u64 = 2;
const RECORD: u64 = 3;
const SETTINGS: u64 = 4;
const CONTROL: u64 = 5;
const TAPE: u64 = 6;
const ARRAYS: u64 = 100;

/// Elements of an array that are shown at a time.
const MOST_ELEMENTS: usize = 1000;
/// Blocks that the scope of the tape shows.
const BLOCKS_SHOWN: u64 = 10;

type Answer = Result<Value, String>;

/// Answers a request.
pub fn answer(request: &Value, hook: &mut Hook, state: &mut DebugState<'_, '_>) {
    let arguments = request.get("arguments").unwrap_or(&Value::Null);
    let text = |key: &str| arguments.get(key).and_then(Value::as_str).unwrap_or_default();
    let reference = arguments.get("variablesReference").and_then(Value::as_u64).unwrap_or(0);
    let answer = match request.get("command").and_then(Value::as_str).unwrap_or_default() {
        "stackTrace" => Ok(stack(hook, state)),
        "scopes" => Ok(scopes(state)),
        "variables" => Ok(json!({ "variables": variables(reference, state) })),
        "evaluate" => evaluated(text("expression"), text("context"), hook, state),
        "setVariable" => set(reference, text("name"), text("value"), hook, state),
        "setExpression" => assign(text("expression"), text("value"), hook, state),
        "dataBreakpointInfo" => Ok(watchable(reference, text("name"), state)),
        other => Err(format!("`{other}` is not known")),
    };
    hook.shared().respond(request, answer);
}

/// All that there is to see of a run that stands still: where it is, its values by scope, and the
/// values of expressions.
pub fn show(watched: &[String], hook: &Hook, state: &DebugState<'_, '_>) -> Value {
    let mut scopes = scopes(state);
    for scope in scopes["scopes"].as_array_mut().into_iter().flatten() {
        let mut list = variables(scope["variablesReference"].as_u64().unwrap_or(0), state);
        for value in &mut list {
            let reference = value["variablesReference"].as_u64().unwrap_or(0);
            if reference != 0 {
                value["elements"] = elements(reference, state).into();
            }
        }
        scope["variables"] = list.into();
    }
    let watched = watched.iter().map(|text| match evaluate(text, state) {
        Ok(value) => json!({ "expression": text, "value": shown(&value) }),
        Err(diag) => json!({ "expression": text, "why": diag.message }),
    });
    json!({
        "frames": stack(hook, state)["stackFrames"],
        "scopes": scopes["scopes"],
        "watched": watched.collect::<Vec<_>>(),
        "blocks": state.blocks(),
    })
}

fn stack(hook: &Hook, state: &DebugState<'_, '_>) -> Value {
    let mut frames = Vec::new();
    for frame in state.fil.stack() {
        let path = hook.files().path_of(&frame.place.file);
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        frames.push(json!({
            "id": frames.len() + 1,
            "name": frame.title,
            "source": { "name": name, "path": path },
            "line": frame.place.line,
            "column": frame.place.column(),
        }));
    }
    if let Some(record) = state.fil.record.as_deref() {
        let cl = &hook.files().cl;
        let name = format!("record {}: {}", record.number, state.fil.vocabulary.name(record.major));
        frames.push(json!({
            "id": frames.len() + 1,
            "name": name,
            "source": { "name": cl.file_name().map(|name| name.to_string_lossy()), "path": cl },
            "line": record.line.max(1),
            "column": 1,
        }));
    }
    let count = frames.len();
    json!({ "stackFrames": frames, "totalFrames": count })
}

fn scopes(state: &DebugState<'_, '_>) -> Value {
    let scope = |name: &str, reference: u64, expensive: bool| json!({ "name": name, "variablesReference": reference, "expensive": expensive });
    let mut scopes = Vec::new();
    if !state.fil.parameters().is_empty() {
        scopes.push(scope("Parameters", PARAMETERS, false));
    }
    scopes.push(scope("Names", NAMES, false));
    if state.fil.record.is_some() {
        scopes.push(scope("Record", RECORD, false));
    }
    scopes.push(scope("Control", CONTROL, false));
    scopes.push(scope("Tape", TAPE, false));
    scopes.push(scope("Settings that differ from the default", SETTINGS, true));
    json!({ "scopes": scopes })
}

fn variable(name: &str, value: &str) -> Value {
    json!({ "name": name, "value": value, "variablesReference": 0 })
}

fn held(name: &str, value: &Held) -> Value {
    let mut told = variable(name, &shown(value));
    told["evaluateName"] = name.into();
    told
}

fn variables(reference: u64, state: &DebugState<'_, '_>) -> Vec<Value> {
    match reference {
        NAMES => names(state),
        PARAMETERS => {
            state.fil.parameters().iter().map(|(name, value)| held(name, value)).collect()
        }
        RECORD => words(state),
        SETTINGS => state
            .changed_settings()
            .iter()
            .map(|(name, _, _, value)| variable(name, &shown(&Held::Number(*value))))
            .collect(),
        CONTROL => control(state),
        TAPE => tape(state),
        _ => elements(reference, state),
    }
}

fn names(state: &DebugState<'_, '_>) -> Vec<Value> {
    let names = state.fil.names();
    let mut list: Vec<Value> = names.iter().map(|(name, value)| held(name, value)).collect();
    for (number, (name, length)) in (ARRAYS..).zip(state.fil.arrays()) {
        let mut told = variable(&name, &format!("{length} elements"));
        told["variablesReference"] = number.into();
        told["indexedVariables"] = length.into();
        list.push(told);
    }
    list
}

fn elements(reference: u64, state: &DebugState<'_, '_>) -> Vec<Value> {
    let arrays = state.fil.arrays();
    let array = reference.checked_sub(ARRAYS).and_then(|number| arrays.get(number as usize));
    let Some((name, length)) = array else { return Vec::new() };
    let element = |index: usize| {
        let value = state.fil.element(name, index).unwrap_or(Held::Unset);
        let mut told = variable(&index.to_string(), &shown(&value));
        told["evaluateName"] = format!("{name}({index})").into();
        told
    };
    (1..=(*length).min(MOST_ELEMENTS)).map(element).collect()
}

fn words(state: &DebugState<'_, '_>) -> Vec<Value> {
    let Some(record) = state.fil.record.as_deref() else { return Vec::new() };
    let word = |n: usize| {
        let value = match record.word(n, state.fil.vocabulary) {
            Some(WordView::Number(number)) => number.to_string(),
            Some(WordView::Word { name, code }) => format!("{name} (word {code})"),
            Some(WordView::Text(text)) => shown(&Held::Text(text.to_string())),
            _ => "EMPTY".to_string(),
        };
        let mut told = variable(&n.to_string(), &value);
        told["evaluateName"] = format!("POSTF(7,{n})").into();
        told
    };
    (1..=record.len()).map(word).collect()
}

fn control(state: &DebugState<'_, '_>) -> Vec<Value> {
    let modes = state.modes();
    let mut list: Vec<Value> = modes.iter().map(|(name, value)| variable(name, value)).collect();
    for (letter, value, is_sure) in state.last_words() {
        let doubt = if is_sure { "" } else { " (the control may have another one)" };
        list.push(variable(&letter.to_string(), &format!("{value}{doubt}")));
    }
    list
}

fn tape(state: &DebugState<'_, '_>) -> Vec<Value> {
    let pending = state.pending_block();
    let words: Vec<String> =
        pending.iter().map(|(letter, value)| format!("{letter}{value}")).collect();
    let pending = if words.is_empty() { "empty".to_string() } else { words.join(" ") };
    let mut list = vec![
        variable("blocks", &state.blocks().to_string()),
        variable("block in the making", &pending),
    ];
    let texts = state.last_blocks(BLOCKS_SHOWN);
    let first = state.blocks() + 1 - (texts.len() as u64).min(state.blocks());
    for (number, text) in (first..).zip(texts) {
        list.push(variable(&format!("block {number}"), &text));
    }
    list
}

/// An expression; in the console `NAME=expression` sets.
fn evaluated(text: &str, context: &str, hook: &Hook, state: &mut DebugState<'_, '_>) -> Answer {
    if context == "repl"
        && let Some((name, value)) = text.split_once('=')
    {
        let set = assign(name, value, hook, state)?;
        return Ok(json!({ "result": set["value"], "variablesReference": 0 }));
    }
    let value = evaluate(text, state).map_err(|diag| diag.message.clone())?;
    Ok(json!({ "result": shown(&value), "variablesReference": 0 }))
}

fn set(
    reference: u64,
    name: &str,
    value: &str,
    hook: &Hook,
    state: &mut DebugState<'_, '_>,
) -> Answer {
    let edit = match reference {
        NAMES | PARAMETERS => Edit::Name(name.to_string(), value_of(value, state)?),
        RECORD => Edit::Word(index(name)?, word(value, state)?),
        SETTINGS => {
            let row = Location::named(name).ok_or("there is no such setting")?;
            Edit::Common(row.kind, u32::from(row.number), number(value, state)?)
        }
        CONTROL | TAPE => {
            return Err(
                "the state of the control follows from the blocks; it can't be set".to_string()
            );
        }
        _ => {
            let arrays = state.fil.arrays();
            let array = reference.checked_sub(ARRAYS).and_then(|at| arrays.get(at as usize));
            let (array, _) = array.ok_or("there is no such variable")?;
            Edit::Element(array.clone(), index(name)?, value_of(value, state)?)
        }
    };
    apply(edit, hook, state)
}

/// Sets a name, `NAME(index)`, `POSTF(7,n)`, or a location by its name or as `INTCOM 1861`.
fn assign(target: &str, value: &str, hook: &Hook, state: &mut DebugState<'_, '_>) -> Answer {
    let target = target.trim();
    let edit = if let Some((name, rest)) = target.split_once('(') {
        let inside = rest.strip_suffix(')').ok_or("a `)` is missing")?;
        let position = |text: &str, state: &DebugState<'_, '_>| {
            let number = number(text, state)?;
            whole_number(number)
        };
        match inside.split_once(',') {
            Some((which, n)) if name.trim() == "POSTF" && which.trim() == "7" => {
                Edit::Word(position(n, state)?, word(value, state)?)
            }
            Some(_) => return Err("only names, elements and POSTF(7,n) can be set".to_string()),
            None => {
                let at = position(inside, state)?;
                Edit::Element(name.trim().to_string(), at, value_of(value, state)?)
            }
        }
    } else if state.fil.value(target).is_some() {
        Edit::Name(target.to_string(), value_of(value, state)?)
    } else {
        let (kind, location) = common(target).ok_or("no script uses this name")?;
        Edit::Common(kind, location, number(value, state)?)
    };
    apply(edit, hook, state)
}

fn apply(edit: Edit, hook: &Hook, state: &mut DebugState<'_, '_>) -> Answer {
    edit.apply(state)?;
    let value = match &edit {
        Edit::Name(_, value) | Edit::Element(_, _, value) => shown(value),
        Edit::Common(_, _, value) => shown(&Held::Number(*value)),
        Edit::Word(_, NewWord::Number(value)) => value.to_string(),
        Edit::Word(_, NewWord::Text(text)) => shown(&Held::Text(text.clone())),
        Edit::Word(_, NewWord::Minor(name)) => name.clone(),
    };
    hook.shared().edits().note(hook.tick(), edit);
    Ok(json!({ "value": value, "variablesReference": 0 }))
}

/// A location by the name of its setting or as `INTCOM 1861`.
fn common(text: &str) -> Option<(Kind, u32)> {
    if let Some(row) = Location::named(&text.to_ascii_lowercase()) {
        return Some((row.kind, u32::from(row.number)));
    }
    let upper = text.to_ascii_uppercase();
    let (kind, number) = upper.split_once(char::is_whitespace)?;
    let kind = [Kind::Int, Kind::Rel, Kind::Dbl].into_iter().find(|known| known.name() == kind)?;
    Some((kind, number.trim().parse().ok()?))
}

fn value_of(text: &str, state: &DebugState<'_, '_>) -> Result<Held, String> {
    evaluate(text, state).map_err(|diag| diag.message.clone())
}

fn number(text: &str, state: &DebugState<'_, '_>) -> Result<f64, String> {
    match value_of(text, state)? {
        Held::Number(number) => Ok(number),
        other => Err(format!("{} is no number", shown(&other))),
    }
}

fn index(text: &str) -> Result<usize, String> {
    text.trim().parse().map_err(|_| format!("`{text}` is no number of a word"))
}

fn whole_number(number: f64) -> Result<usize, String> {
    let whole = number as usize;
    if whole as f64 == number { Ok(whole) } else { Err(format!("{number} counts nothing")) }
}

/// A word of a record: a vocabulary word that was named before, else a value of FIL.
fn word(text: &str, state: &DebugState<'_, '_>) -> Result<NewWord, String> {
    let name = text.trim().to_ascii_uppercase();
    if state.fil.value(&name).is_none() && state.fil.vocabulary.find(&name).is_some() {
        return Ok(NewWord::Minor(name));
    }
    match value_of(text, state)? {
        Held::Number(number) => Ok(NewWord::Number(number)),
        Held::Text(text) => Ok(NewWord::Text(text)),
        Held::Unset => Err(format!("{text} was never set")),
    }
}

fn watchable(reference: u64, name: &str, state: &DebugState<'_, '_>) -> Value {
    let may = matches!(reference, 0 | NAMES | PARAMETERS | SETTINGS | CONTROL);
    let is_letter = reference == CONTROL;
    let id = if may { watch_id(name, is_letter, state) } else { None };
    match id {
        Some(id) => json!({
            "dataId": id,
            "description": format!("{name}, when it gets another value"),
            "accessTypes": ["write"],
        }),
        None => json!({ "dataId": null, "description": format!("{name} can't be watched") }),
    }
}
