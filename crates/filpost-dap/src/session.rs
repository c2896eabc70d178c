//! One session: requests of the client, and the runs it has had.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use filpost::debug::SharedDebugger;
use filpost::files;
use serde_json::{Value, json};

use crate::breakpoints::{What, When, named, told, watched_by};
use crate::edits::Tick;
use crate::hook::{Ask, Asks, Goal, Hook};
use crate::launch::{Launched, launch, sentences};
use crate::places::{kind_of, known, line_of};
use crate::shared::Shared;
use crate::wire;

/// A session with one client.
pub struct Session {
    shared: Arc<Shared>,
    launched: Option<Arc<Launched>>,
    stop_on_entry: bool,
    no_debug: bool,
    run: Option<(Sender<Ask>, JoinHandle<()>)>,
    number: u64,
}

type Answer = Result<Value, String>;

/// Requests that only a run that stands still can answer.
const OF_THE_RUN: &[&str] = &[
    "stackTrace",
    "scopes",
    "variables",
    "evaluate",
    "setVariable",
    "setExpression",
    "dataBreakpointInfo",
];

impl Session {
    /// A session that answers to this output.
    pub fn new(mut output: Box<dyn Write + Send>) -> Self {
        let out = move |message| wire::write(&mut output, &message);
        Session {
            shared: Arc::new(Shared::new(Box::new(out))),
            launched: None,
            stop_on_entry: false,
            no_debug: false,
            run: None,
            number: 0,
        }
    }

    /// Carries out a request; false when the session is over.
    pub fn request(&mut self, request: &Value) -> bool {
        let command = request.get("command").and_then(Value::as_str).unwrap_or_default();
        let arguments = request.get("arguments").unwrap_or(&Value::Null);
        if OF_THE_RUN.contains(&command) {
            self.ask_run(request);
            return true;
        }
        let answer = self.answer(command, arguments);
        let is_launched = command == "launch" && answer.is_ok();
        let is_initialized = command == "configurationDone" && answer.is_ok();
        self.shared.respond(request, answer);
        if is_launched {
            self.shared.event("initialized", json!({}));
        }
        if is_initialized {
            let goal = if self.stop_on_entry { Goal::In } else { Goal::Run };
            self.start(goal);
        }
        !matches!(command, "disconnect")
    }

    /// Ends what runs.
    pub fn end(&mut self) {
        self.let_go();
    }

    fn answer(&mut self, command: &str, arguments: &Value) -> Answer {
        match command {
            "initialize" => Ok(capabilities()),
            "launch" => self.launch(arguments),
            "configurationDone" if self.launched.is_some() => Ok(json!({})),
            "setBreakpoints" => self.set_breakpoints(arguments),
            "setFunctionBreakpoints" => self.set_function_breakpoints(arguments),
            "setDataBreakpoints" => self.set_data_breakpoints(arguments),
            "setExceptionBreakpoints" => {
                let filters = arguments.get("filters").and_then(Value::as_array);
                let on = filters.is_some_and(|list| list.iter().any(|one| one == "errors"));
                self.shared.breakpoints().on_errors = on;
                Ok(json!({}))
            }
            "threads" => Ok(json!({ "threads": [{ "id": 1, "name": "run" }] })),
            "continue" => self.go(Goal::Run).map(|()| json!({ "allThreadsContinued": true })),
            "next" => self.go(Goal::Over).map(|()| json!({})),
            "stepIn" => self.go(Goal::In).map(|()| json!({})),
            "stepOut" => self.go(Goal::Out).map(|()| json!({})),
            "nextRecord" => self.go(Goal::Record).map(|()| json!({})),
            "nextBlock" => self.go(Goal::Block).map(|()| json!({})),
            "stepBack" => self.go_back(0),
            "reverseContinue" => self.go_back(1),
            "pause" => {
                self.shared.pause.store(true, Ordering::SeqCst);
                Ok(json!({}))
            }
            "terminate" | "disconnect" => {
                self.let_go();
                if command == "terminate" {
                    self.shared.event("terminated", json!({}));
                }
                Ok(json!({}))
            }
            other => Err(format!("`{other}` is not known")),
        }
    }

    fn launch(&mut self, arguments: &Value) -> Answer {
        let flag = |key: &str| arguments.get(key).and_then(Value::as_bool).unwrap_or(false);
        self.stop_on_entry = flag("stopOnEntry");
        self.no_debug = flag("noDebug");
        self.launched = Some(Arc::new(launch(arguments)?));
        Ok(json!({}))
    }

    /// Begins a run from the first record; an earlier one ends silently.
    fn start(&mut self, goal: Goal) {
        let Some(launched) = self.launched.clone() else { return };
        self.let_go();
        self.number += 1;
        let number = self.number;
        self.shared.run.store(number, Ordering::SeqCst);
        self.shared.is_stopped.store(false, Ordering::SeqCst);
        if self.no_debug {
            self.shared.breakpoints().forget();
        }
        let (asks, asked) = channel();
        let shared = Arc::clone(&self.shared);
        let hook = Hook::new(
            Arc::clone(&shared),
            Asks::Client(asked),
            number,
            goal,
            launched.files.clone(),
        );
        let debugger: SharedDebugger = Arc::new(Mutex::new(hook));
        let thread = std::thread::spawn(move || {
            let ended = launched.run(&debugger);
            if shared.counts(number) {
                tell_end(&shared, &launched, ended);
            }
        });
        self.run = Some((asks, thread));
    }

    /// Lets go of the run: it ends as soon as it looks up.
    fn let_go(&mut self) {
        self.shared.run.store(0, Ordering::SeqCst);
        if let Some((asks, thread)) = self.run.take() {
            drop(asks);
            // Nobody waits for its result, so a panic in it changes nothing.
            let _ = thread.join();
        }
        self.shared.is_stopped.store(false, Ordering::SeqCst);
    }

    fn go(&mut self, goal: Goal) -> Result<(), String> {
        let Some((asks, _)) = &self.run else { return Err("nothing runs".to_string()) };
        if !self.shared.is_stopped.swap(false, Ordering::SeqCst) {
            return Err("the run does not stand still".to_string());
        }
        asks.send(Ask::Go(goal)).map_err(|_| "the run is over".to_string())
    }

    fn go_back(&mut self, way: usize) -> Answer {
        if !self.shared.is_stopped.load(Ordering::SeqCst) {
            return Err("the run does not stand still".to_string());
        }
        let Some(tick) = self.shared.ways_back()[way] else {
            return Err("this is the start of the run".to_string());
        };
        self.replay(tick);
        Ok(json!({}))
    }

    fn replay(&mut self, tick: Tick) {
        self.shared.edits().forget_behind(tick);
        self.start(Goal::Until(tick));
    }

    fn ask_run(&mut self, request: &Value) {
        let is_stopped = self.shared.is_stopped.load(Ordering::SeqCst);
        let sent = match &self.run {
            Some((asks, _)) if is_stopped => asks.send(Ask::Answer(request.clone())).is_ok(),
            _ => false,
        };
        if !sent {
            self.shared.respond(request, Err("the run does not stand still".to_string()));
        }
    }

    fn set_breakpoints(&mut self, arguments: &Value) -> Answer {
        let path = arguments.pointer("/source/path").and_then(Value::as_str).unwrap_or_default();
        let path = PathBuf::from(path);
        let asked = arguments.get("breakpoints").and_then(Value::as_array);
        let asked: Vec<&Value> = asked.into_iter().flatten().collect();
        let launched = self.launched.clone().ok_or("nothing is launched")?;
        let kind = kind_of(&path, &launched.files, launched.nc.as_deref(), launched.program());
        let (mut new, mut answers) = (Vec::new(), Vec::new());
        for one in asked {
            let line = one.get("line").and_then(Value::as_u64).unwrap_or(0);
            let placed = When::read(one).and_then(|when| {
                let what = kind.place(line).ok_or("nothing runs in this line or after it")?;
                Ok((what, when))
            });
            match placed {
                Ok((what, when)) => {
                    let line = line_of(&what);
                    new.push((what, when));
                    answers.push(Ok(line));
                }
                Err(message) => answers.push(Err((line, message))),
            }
        }
        let ids = self.shared.breakpoints().replace(|what| kind.has(what), new);
        let mut ids = ids.into_iter();
        let answers = answers.into_iter().map(|answer| match answer {
            Ok(line) => told(ids.next(), line, None),
            Err((line, message)) => told(None, Some(line), Some(&message)),
        });
        Ok(json!({ "breakpoints": answers.collect::<Vec<_>>() }))
    }

    fn set_function_breakpoints(&mut self, arguments: &Value) -> Answer {
        let is_one = |what: &What| matches!(what, What::Record(_) | What::Block(_) | What::Part(_));
        let launched = self.launched.clone().ok_or("nothing is launched")?;
        let read = |name: &str| known(named(name)?, launched.program());
        Ok(self.set_named(arguments, "name", is_one, read))
    }

    fn set_data_breakpoints(&mut self, arguments: &Value) -> Answer {
        let is_one =
            |what: &What| matches!(what, What::Name(_) | What::Common(..) | What::Address(_));
        let read = |id: &str| watched_by(id).ok_or_else(|| format!("`{id}` can't be watched"));
        Ok(self.set_named(arguments, "dataId", is_one, read))
    }

    fn set_named(
        &mut self,
        arguments: &Value,
        key: &str,
        old: impl Fn(&What) -> bool,
        read: impl Fn(&str) -> Result<What, String>,
    ) -> Value {
        let asked = arguments.get("breakpoints").and_then(Value::as_array);
        let placed: Vec<Result<(What, When), String>> = asked
            .into_iter()
            .flatten()
            .map(|one| {
                let name = one.get(key).and_then(Value::as_str).unwrap_or_default();
                Ok((read(name)?, When::read(one)?))
            })
            .collect();
        let new = placed.iter().flatten().cloned().collect();
        let mut ids = self.shared.breakpoints().replace(old, new).into_iter();
        let answers = placed.iter().map(|placed| match placed {
            Ok(_) => told(ids.next(), None, None),
            Err(message) => told(None, None, Some(message)),
        });
        json!({ "breakpoints": answers.collect::<Vec<_>>() })
    }
}

/// Tells how the run ended, and writes its program where that is asked for.
fn tell_end(shared: &Shared, launched: &Launched, ended: Result<Vec<u8>, filpost::Error>) {
    let written = ended.map_err(|error| sentences(&error)).and_then(|nc| {
        let Some(path) = launched.nc.as_ref().filter(|_| launched.writes) else { return Ok(()) };
        if !shared.edits().is_empty() {
            return Err("values were set by hand: the program is not written".to_string());
        }
        let cant = |error| files::cant_write(path, &error);
        let done = files::write_whole(path, |out| out.write_all(&nc).map_err(cant));
        done.map_err(|error| sentences(&error))
    });
    let code = match written {
        Ok(()) => 0,
        Err(message) => {
            shared.output("stderr", &message);
            1
        }
    };
    shared.event("exited", json!({ "exitCode": code }));
    shared.event("terminated", json!({}));
}

fn capabilities() -> Value {
    json!({
        "supportsConfigurationDoneRequest": true,
        "supportsFunctionBreakpoints": true,
        "supportsConditionalBreakpoints": true,
        "supportsHitConditionalBreakpoints": true,
        "supportsLogPoints": true,
        "supportsEvaluateForHovers": true,
        "supportsStepBack": true,
        "supportsSetVariable": true,
        "supportsSetExpression": true,
        "supportsDataBreakpoints": true,
        "supportsTerminateRequest": true,
        "exceptionBreakpointFilters": [
            { "filter": "errors", "label": "Where the run is refused", "default": true },
        ],
    })
}
