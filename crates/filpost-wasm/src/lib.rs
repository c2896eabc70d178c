//! filpost for WebAssembly.
//!
//! **Goal.** Posting and the language tools where there is no file system: in a page, in node.
//!
//! **Model.** The module takes requests and gives answers, both JSON in UTF-8. [`answer`] is all
//! of it; the border (`border.rs`) hands the bytes over where the target is WebAssembly.
//!
//! **Quick start.**
//!
//! ```
//! let request = r#"{"do": "post", "ready": "fanuc-mill",
//!     "cl": "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n"}"#;
//! let answer = filpost_wasm::answer(request.as_bytes());
//! assert!(String::from_utf8(answer)?.contains("G1 G43 X1. Y2. Z3. F200. H1"));
//! # Ok::<(), std::string::FromUtf8Error>(())
//! ```
//!
//! **Limits.** Texts are in memory. It needs no thread, no clock and no file, and imports one
//! function from its host, which is told how far a run has come.
//!
//! A tool of [filpost](https://crates.io/crates/filpost), without an API of its own: its items may
//! change in any version.
#![deny(missing_docs)]

#[cfg(feature = "plot")]
mod audit;
#[cfg(feature = "plot")]
mod behind;
#[cfg(target_family = "wasm")]
mod border;
#[cfg(feature = "debug")]
mod coverage;
#[cfg(feature = "debug")]
mod debugger;
mod diagnostics;
#[cfg(any(feature = "post", feature = "navigate"))]
mod editor;
mod fields;
#[cfg(feature = "post")]
mod form;
mod job;
#[cfg(feature = "plot")]
mod judge;
mod machine;
#[cfg(feature = "plot")]
mod motions;
#[cfg(feature = "plot")]
mod plot;
#[cfg(feature = "post")]
mod post;
#[cfg(feature = "post")]
mod setup;
#[cfg(feature = "simulate")]
mod simulate;
mod watch;

use filpost::{Diag, Error};
use serde_json::{Value, json};

use diagnostics::all;
#[cfg(any(feature = "post", feature = "navigate"))]
use editor::Edited;
use fields::Fields;
pub use watch::Watch;

/// Why a request is not understood.
struct Misuse(String);

/// Why there is no program or no drawing.
enum Fault {
    /// The post, one of its files or the program is wrong.
    Setup(Error),
    /// The request is.
    Misuse(Misuse),
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Fault::Setup(error)
    }
}

impl From<Misuse> for Fault {
    fn from(misuse: Misuse) -> Self {
        Fault::Misuse(misuse)
    }
}

/// Answers a request, JSON for JSON. What is no request is answered by
/// `{"misuse": "…"}`.
pub fn answer(request: &[u8]) -> Vec<u8> {
    let answer = match serde_json::from_slice(request) {
        Ok(request) => answer_to(request),
        Err(error) => json!({ "misuse": error.to_string() }),
    };
    answer.to_string().into_bytes()
}

/// The same for values.
pub fn answer_to(request: Value) -> Value {
    answer_watched(request, &Watch::default())
}

/// The same for a request that another thread watches, and stops where it is to post.
pub fn answer_watched(request: Value, watch: &Watch) -> Value {
    read(request, watch).unwrap_or_else(|Misuse(what)| json!({ "misuse": what }))
}

#[cfg_attr(not(feature = "post"), expect(unused_variables, reason = "posts are watched"))]
fn read(request: Value, watch: &Watch) -> Result<Value, Misuse> {
    let mut fields = Fields::of(request)?;
    let what = fields.needed("do")?;
    Ok(match what.as_str() {
        #[cfg(feature = "post")]
        "post" => post::post(&job::Job::read(fields)?, watch),
        #[cfg(feature = "plot")]
        "plot" => plot::Plot::read(fields)?.draw(),
        #[cfg(feature = "plot")]
        "columns" => plot::Plot::read(fields)?.columns(),
        #[cfg(feature = "simulate")]
        "simulate" => simulate::Simulate::read(fields)?.run(),
        #[cfg(feature = "debug")]
        "debug" => debugger::debug(fields)?,
        #[cfg(feature = "debug")]
        "cover" => coverage::cover(fields)?,
        #[cfg(feature = "post")]
        "findings" => Edited::read(fields)?.findings(),
        #[cfg(feature = "post")]
        "hover" => Edited::read(fields)?.hover(),
        #[cfg(feature = "post")]
        "complete" => Edited::read(fields)?.complete(),
        #[cfg(feature = "post")]
        "fixes" => Edited::read(fields)?.fixes(),
        #[cfg(feature = "navigate")]
        "outline" => Edited::read(fields)?.outline(),
        #[cfg(feature = "navigate")]
        "definition" => Edited::read(fields)?.definition(),
        #[cfg(feature = "navigate")]
        "references" => Edited::read(fields)?.references(),
        #[cfg(feature = "navigate")]
        "rename" => Edited::read(fields)?.rename(),
        #[cfg(feature = "navigate")]
        "signature" => Edited::read(fields)?.signature(),
        #[cfg(feature = "navigate")]
        "beside" => Edited::read(fields)?.beside(),
        #[cfg(feature = "navigate")]
        "format" => Edited::read(fields)?.format(),
        #[cfg(feature = "post")]
        "new" => setup::new_post(fields)?,
        #[cfg(feature = "post")]
        "form" => form::form(fields)?,
        #[cfg(feature = "post")]
        "set" => form::set(fields)?,
        #[cfg(feature = "post")]
        "case" => form::case(fields)?,
        #[cfg(feature = "plot")]
        "verify" => judge::verify(fields)?,
        #[cfg(feature = "plot")]
        "audit" => audit::audit(fields)?,
        #[cfg(feature = "plot")]
        "behind" => behind::behind(fields)?,
        #[cfg(feature = "plot")]
        "compare" => judge::compare(fields)?,
        #[cfg(feature = "plot")]
        "motions" => motions::motions(fields)?,
        #[cfg(feature = "post")]
        "import" => setup::import(fields)?,
        #[cfg(feature = "post")]
        "ready" => ready(),
        #[cfg(feature = "post")]
        "words" => words(fields)?,
        other => return Err(Misuse(format!("`do` is `{other}`, which this module does not know"))),
    })
}

fn refused(fault: &Fault, warnings: &[Diag]) -> Value {
    match fault {
        Fault::Misuse(Misuse(what)) => json!({ "misuse": what }),
        Fault::Setup(error) => json!({ "errors": all(error.diags()), "warnings": all(warnings) }),
    }
}

/// Takes the pages of the post words, which the module of the playground does not have.
#[cfg(feature = "post")]
fn words(mut fields: Fields) -> Result<Value, Misuse> {
    filpost::word_pages::give(fields.needed("pages")?);
    fields.end()?;
    Ok(json!({}))
}

#[cfg(feature = "post")]
fn ready() -> Value {
    let posts = filpost::ready::READY.iter();
    posts.map(|post| json!({ "name": post.name, "machine": post.machine })).collect()
}

/// A range as `[line, character, line, character]`, from 0.
#[cfg(any(feature = "post", feature = "plot", feature = "navigate"))]
fn places(range: fil_ide::Range) -> [u32; 4] {
    [range.start.line, range.start.character, range.end.line, range.end.character]
}
