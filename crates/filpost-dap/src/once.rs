//! One look: a run from the start to one place, in one call and one thread.
//!
//! A run with the same input does the same. So a host that keeps no run asks for the next place by
//! the last one: the run goes there again, and from there on.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use filpost::debug::SharedDebugger;
use filpost::locations::Location;
use filpost::{Error, Program};
use serde_json::{Value, json};

use crate::breakpoints::{What, When, named, watched_by};
use crate::edits::Tick;
use crate::hook::{Ask, Asks, Files, Goal, Hook};
use crate::places::{kind_of, known, line_of};
use crate::shared::Shared;

/// What the run tells, apart from its blocks.
type Told = Arc<Mutex<Vec<Value>>>;

/// Runs a program to the place that a request asks for, and tells what there is to see.
///
/// `run` starts a run of the program with the debugger and throws its blocks away; `cl` is the name of the CL file. The program
/// is built with [`Builder::debug`](filpost::Builder::debug). The request has
/// - `breakpoints`: `{file, line}`, `{nc}` (a line of the program), `{name}` (`record CYCLE`, `block G83`,
///   `macro NAME`) or `{watch}` (a name, a setting, `address X`), each with `condition`, `hitCondition` and `logMessage` where wanted;
/// - `step`: `run`, `in`, `over`, `out`, `record`, `block`, or `here` for no step, and `from`, the `here` or `back` of
///   an answer; without `from` the step begins at the start of the run;
/// - `watched`: expressions.
///
/// The answer has `placed` (of each breakpoint its `line`, or `why` it has none), `said`, and where the run
/// stands still `stopped` (`reason`, `text`, `hits`, `here`, `back`, `back_block`) with `frames`, `scopes`, `watched` and the
/// number of `blocks`. A run that came to its end has none of these, and one that was refused has its `refusal`.
///
/// # Errors
/// What is wrong with the request, in a sentence.
pub fn look(
    program: &Program,
    cl: &str,
    request: &Value,
    run: impl FnOnce(&SharedDebugger) -> Result<(), Error>,
) -> Result<Value, String> {
    let names = program.fil_files();
    let fil = names.iter().map(PathBuf::from).collect();
    let files = Files { cl: PathBuf::from(cl), fil, names };
    let told = Told::default();
    let out = Arc::clone(&told);
    let shared = Arc::new(Shared::new(Box::new(move |message| note(&out, message))));
    let asked = request["breakpoints"].as_array().map(Vec::as_slice).unwrap_or_default();
    let places: Vec<_> = asked.iter().map(|one| placed(one, &files, program)).collect();
    shared.breakpoints().on_errors = true;
    shared.breakpoints().replace(|_| false, places.iter().flatten().cloned().collect());
    let (goal, asks) = way(request)?;
    let hook =
        Arc::new(Mutex::new(Hook::new(Arc::clone(&shared), Asks::Known(asks), 0, goal, files)));
    let debugger: SharedDebugger = hook.clone();
    let ended = run(&debugger);
    let hook = hook.lock().unwrap_or_else(PoisonError::into_inner);
    let told = told.lock().unwrap_or_else(PoisonError::into_inner);
    let mut answer = json!({ "placed": places.iter().map(told_place).collect::<Vec<_>>() });
    answer["said"] = told.iter().filter_map(|one| one.get("output")).cloned().collect();
    let of = |event: &str| told.iter().rfind(|one| one["event"] == event).map(|one| &one["body"]);
    if let (Some(stopped), Some(Value::Object(shown))) = (of("stopped"), of("shown")) {
        answer["stopped"] = json!({
            "reason": stopped["reason"], "text": stopped["text"],
            "hits": hits(&stopped["hitBreakpointIds"], &places),
            "here": as_json(Some(hook.tick())),
            "back": as_json(hook.before()),
            "back_block": as_json(hook.before_block()),
        });
        for (key, value) in shown {
            answer[key] = value.clone();
        }
    } else if let Err(error) = ended {
        answer["refusal"] = error.diags().first().map(ToString::to_string).into();
    }
    Ok(answer)
}

/// Keeps what the run tells; the blocks themselves are in the program that the host has.
fn note(told: &Told, message: Value) {
    let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
    match message["event"].as_str() {
        Some("output") if message["body"]["category"] == "stdout" => {}
        Some("output") => {
            let text = message["body"]["output"].as_str().unwrap_or_default().trim_end();
            told.push(json!({ "output": text }));
        }
        _ => told.push(message),
    }
}

type Placed = Result<(What, When), String>;

fn placed(asked: &Value, files: &Files, program: &Program) -> Placed {
    let text = |key: &str| asked[key].as_str();
    let what = if let Some(line) = asked["nc"].as_u64() {
        What::Nc(line)
    } else if let Some(name) = text("name") {
        known(named(name)?, program)?
    } else if let Some(name) = text("watch") {
        watched(name.trim())
    } else {
        let path = Path::new(text("file").unwrap_or_default());
        let line = asked["line"].as_u64().unwrap_or(0);
        let place = kind_of(path, files, None, program).place(line);
        place.ok_or("nothing runs in this line or after it")?
    };
    Ok((what, When::read(asked)?))
}

/// What is watched under a name: an identifier, a setting, or else a name of FIL.
fn watched(name: &str) -> What {
    if let Some(what) = watched_by(name) {
        return what;
    }
    match Location::named(&name.to_ascii_lowercase()) {
        Some(row) => What::Common(row.kind, u32::from(row.number)),
        None => What::Name(name.to_ascii_uppercase()),
    }
}

fn told_place(placed: &Placed) -> Value {
    match placed {
        Ok((what, _)) => json!({ "line": line_of(what) }),
        Err(why) => json!({ "why": why }),
    }
}

/// The places in the request of the breakpoints that were hit: those that could be placed are numbered from 1.
fn hits(ids: &Value, places: &[Placed]) -> Vec<usize> {
    let there: Vec<usize> = (0..places.len()).filter(|number| places[*number].is_ok()).collect();
    let ids = ids.as_array().into_iter().flatten().filter_map(Value::as_u64);
    ids.filter_map(|id| there.get(usize::try_from(id).ok()?.checked_sub(1)?).copied()).collect()
}

/// How the run begins, and what is asked of it then.
fn way(request: &Value) -> Result<(Goal, VecDeque<Ask>), String> {
    let step = match request["step"].as_str().unwrap_or("run") {
        "run" => Some(Goal::Run),
        "in" => Some(Goal::In),
        "over" => Some(Goal::Over),
        "out" => Some(Goal::Out),
        "record" => Some(Goal::Record),
        "block" => Some(Goal::Block),
        "here" => None,
        other => return Err(format!("there is no step `{other}`")),
    };
    let texts = request["watched"].as_array().into_iter().flatten();
    let show = Ask::Show(texts.filter_map(Value::as_str).map(str::to_string).collect());
    Ok(match (tick(&request["from"]), step) {
        (Some(tick), Some(step)) => (Goal::Until(tick), VecDeque::from([Ask::Go(step), show])),
        (Some(tick), None) => (Goal::Until(tick), VecDeque::from([show])),
        (None, step) => (step.unwrap_or(Goal::In), VecDeque::from([show])),
    })
}

fn tick(value: &Value) -> Option<Tick> {
    Some(Tick { number: value["number"].as_u64()?, is_over: value["is_over"].as_bool()? })
}

fn as_json(tick: Option<Tick>) -> Value {
    match tick {
        Some(Tick { number, is_over }) => json!({ "number": number, "is_over": is_over }),
        None => Value::Null,
    }
}
