//! Requests that are being answered: how far they have come, and what stops them.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use filpost_wasm::Watch;
use serde_json::{Value, json};

/// Longest ticket, bytes.
const LONGEST_TICKET: usize = 64;

/// The requests with a ticket, which the page draws.
#[derive(Default)]
pub(crate) struct Works(Mutex<HashMap<String, Watch>>);

impl Works {
    /// Answers a request about another one, by its ticket: its `share` from 0 to 1, or null where it is not being
    /// answered. `None` where the request is none of these.
    pub fn answer(&self, request: &Value) -> Option<Value> {
        let what = request["do"].as_str()?;
        if !matches!(what, "watch" | "stop") {
            return None;
        }
        let works = self.works();
        let watch = request["ticket"].as_str().and_then(|ticket| works.get(ticket));
        if let (Some(watch), "stop") = (watch, what) {
            watch.stop();
        }
        Some(json!({ "share": watch.map(Watch::share) }))
    }

    /// Answers a request; one with a `ticket` can be asked for while `work` does it.
    pub fn watched(&self, mut request: Value, work: impl FnOnce(Value, &Watch) -> Value) -> Value {
        let ticket = request.as_object_mut().and_then(|fields| fields.remove("ticket"));
        let watch = Watch::default();
        match ticket {
            Some(Value::String(ticket)) if ticket.len() <= LONGEST_TICKET => {
                self.works().insert(ticket.clone(), watch.clone());
                let answer = work(request, &watch);
                self.works().remove(&ticket);
                answer
            }
            _ => work(request, &watch),
        }
    }

    fn works(&self) -> MutexGuard<'_, HashMap<String, Watch>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_is_stopped_by_its_ticket_while_it_is_answered() {
        let works = Works::default();
        let ask = |what: &str| works.answer(&json!({ "do": what, "ticket": "a" }));
        let answer = works.watched(json!({ "do": "post", "ticket": "a" }), |request, watch| {
            assert_eq!(request, json!({ "do": "post" }));
            assert_eq!(ask("watch"), Some(json!({ "share": 0.0 })));
            ask("stop");
            let post = json!({ "do": "post", "ready": "fanuc-mill", "cl": "FINI\n" });
            filpost_wasm::answer_watched(post, watch)
        });
        assert_eq!(answer["errors"][0]["code"], "E0711");
        assert_eq!(ask("watch"), Some(json!({ "share": null })));
        assert_eq!(works.answer(&json!({ "do": "post" })), None);
    }
}
