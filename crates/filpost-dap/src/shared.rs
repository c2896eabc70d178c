//! What the thread that reads requests and the thread of the run share.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde_json::{Value, json};

use crate::breakpoints::Breakpoints;
use crate::edits::{Edits, Tick};

/// Where messages go: to a client, or to whoever asked for one look.
pub type Out = Box<dyn FnMut(Value) + Send>;

/// The connection to the client and what is set by it.
pub struct Shared {
    out: Mutex<(Out, u64)>,
    breakpoints: Mutex<Breakpoints>,
    edits: Mutex<Edits>,
    ways_back: Mutex<[Option<Tick>; 2]>,
    /// The client wants the run to stand still.
    pub pause: AtomicBool,
    /// The run stands still and takes requests.
    pub is_stopped: AtomicBool,
    /// The number of the run that counts; one with a lower number is to end silently.
    pub run: AtomicU64,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Shared {
    /// Nothing is set.
    pub fn new(out: Out) -> Self {
        Shared {
            out: Mutex::new((out, 0)),
            breakpoints: Mutex::default(),
            edits: Mutex::default(),
            ways_back: Mutex::default(),
            pause: AtomicBool::new(false),
            is_stopped: AtomicBool::new(false),
            run: AtomicU64::new(0),
        }
    }

    /// The breakpoints.
    pub fn breakpoints(&self) -> MutexGuard<'_, Breakpoints> {
        lock(&self.breakpoints)
    }

    /// What was set by hand.
    pub fn edits(&self) -> MutexGuard<'_, Edits> {
        lock(&self.edits)
    }

    /// Where a step back and a step to the block before lead to.
    pub fn ways_back(&self) -> [Option<Tick>; 2] {
        *lock(&self.ways_back)
    }

    /// Sets them, as the run stands still.
    pub fn set_ways_back(&self, ways: [Option<Tick>; 2]) {
        *lock(&self.ways_back) = ways;
    }

    /// True when this run is the one that counts.
    pub fn counts(&self, run: u64) -> bool {
        self.run.load(Ordering::SeqCst) == run
    }

    /// Sends an event.
    pub fn event(&self, event: &str, body: Value) {
        self.send(json!({ "type": "event", "event": event, "body": body }));
    }

    /// Sends a line of output of a category of the protocol.
    pub fn output(&self, category: &str, text: &str) {
        self.event("output", json!({ "category": category, "output": format!("{text}\n") }));
    }

    /// Answers a request.
    pub fn respond(&self, request: &Value, answer: Result<Value, String>) {
        let mut response = json!({
            "type": "response",
            "request_seq": request.get("seq"),
            "command": request.get("command"),
            "success": answer.is_ok(),
        });
        match answer {
            Ok(body) => response["body"] = body,
            Err(message) => {
                response["body"] = json!({ "error": { "id": 1, "format": message } });
                response["message"] = message.into();
            }
        }
        self.send(response);
    }

    fn send(&self, mut message: Value) {
        let mut out = lock(&self.out);
        out.1 += 1;
        message["seq"] = out.1.into();
        (out.0)(message);
    }
}
