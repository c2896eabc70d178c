//! filpost for WebAssembly: posting and the language tools over texts in memory.
//!
//! The module takes requests and gives answers, both JSON in UTF-8. [`answer`] is all of
//! it; the border (`border.rs`) hands the bytes over where the target is WebAssembly. It needs no
//! thread, no clock and no file, and imports nothing from its host.
//!
//! ```
//! let request = r#"{"do": "post", "ready": "fanuc-mill",
//!     "cl": "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n"}"#;
//! let answer = filpost_wasm::answer(request.as_bytes());
//! assert!(String::from_utf8(answer)?.contains("G1 G43 X1. Y2. Z3. F200. H1"));
//! # Ok::<(), std::string::FromUtf8Error>(())
//! ```
#![deny(missing_docs)]

#[cfg(target_family = "wasm")]
mod border;
mod diagnostics;
mod editor;
mod job;
mod post;

use serde::Deserialize;
use serde_json::{Value, json};

use editor::Edited;
use job::Job;

/// What a page asks for.
#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
enum Request {
    /// The NC program of a CL file.
    Post(Box<Job>),
    /// What is wrong in an edited text.
    Findings(Edited),
    /// What stands at a place of an edited text.
    Hover(Edited),
    /// What may stand at a place of an edited text.
    Complete(Edited),
    /// The posts inside the crate.
    Ready,
}

/// Answers a request, JSON for JSON. What is no request is answered by
/// `{"misuse": "…"}`.
pub fn answer(request: &[u8]) -> Vec<u8> {
    let answer = match serde_json::from_slice(request) {
        Ok(Request::Post(job)) => post::post(&job),
        Ok(Request::Findings(edited)) => edited.findings(),
        Ok(Request::Hover(edited)) => edited.hover(),
        Ok(Request::Complete(edited)) => edited.complete(),
        Ok(Request::Ready) => ready(),
        Err(error) => json!({ "misuse": error.to_string() }),
    };
    answer.to_string().into_bytes()
}

fn ready() -> Value {
    let posts = filpost::ready::READY.iter();
    posts.map(|post| json!({ "name": post.name, "machine": post.machine })).collect()
}
