//! Runs that stop where somebody wants to look.

use std::io::{Cursor, sink};

use serde_json::{Map, Value};

use crate::fields::Fields;
use crate::job::Job;
use crate::{Fault, Misuse, refused};

/// Keys of the debugger; the others are those of a request to post.
const OWN: [&str; 4] = ["breakpoints", "step", "from", "watched"];

/// Answers a request to run to a place, as [`filpost_dap::look`] does; or with `errors`.
pub(crate) fn debug(mut fields: Fields) -> Result<Value, Misuse> {
    let own = OWN.iter().filter_map(|key| Some(((*key).to_string(), fields.value(key)?)));
    let request = Value::Object(own.collect::<Map<_, _>>());
    let job = Job::read(fields)?;
    Ok(looked(&job, &request).unwrap_or_else(|fault| refused(&fault, &[])))
}

fn looked(job: &Job, request: &Value) -> Result<Value, Fault> {
    let program = job.builder()?.debug(true).build()?;
    let start = job.start(&program)?;
    let answer = filpost_dap::look(&program, &job.cl_name, request, |debugger| {
        let cl = Cursor::new(job.cl.as_bytes());
        start.debug(debugger).stream_seekable(cl, sink()).map(|_| ())
    });
    Ok(answer.map_err(Misuse)?)
}
