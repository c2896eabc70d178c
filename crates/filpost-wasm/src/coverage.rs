//! What of the scripts runs of several jobs have exercised.

use std::io::{Cursor, sink};
use std::sync::{Arc, Mutex, PoisonError};

use filpost::coverage::{Coverage, Recorder, Share, never};
use filpost::debug::SharedDebugger;
use serde_json::{Value, json};

use crate::Misuse;
use crate::fields::Fields;
use crate::job::Job;

/// Answers with the `files` that `jobs`, each with the keys of a request to post, have run: their `lines`, each with how
/// often it ran, the shares, and in words what never came. A job without a post tells nothing; one that is refused tells
/// what ran until then.
pub(crate) fn cover(mut fields: Fields) -> Result<Value, Misuse> {
    let jobs = fields.list("jobs")?;
    fields.end()?;
    let mut coverage = Coverage::default();
    for job in jobs {
        run(&Job::read(Fields::of(job)?)?, &mut coverage);
    }
    let files = coverage.files().map(|(name, file)| {
        let missed = file.branches().into_iter().filter(|branch| branch.count == 0);
        json!({
            "name": name,
            "lines": file.lines().into_iter().collect::<Vec<_>>(),
            "line_share": share(file.line_share()),
            "branch_share": share(file.branch_share()),
            "never": missed.map(|branch| json!([branch.line, never(&branch)])).collect::<Vec<_>>(),
        })
    });
    Ok(json!({ "files": files.collect::<Vec<_>>() }))
}

fn run(job: &Job, coverage: &mut Coverage) {
    let program = job.builder().and_then(|builder| Ok(builder.debug(true).build()?));
    let Ok(program) = program else { return };
    let recorder = Arc::new(Mutex::new(Recorder::default()));
    let debugger: SharedDebugger = recorder.clone();
    if let Ok(run) = job.start(&program) {
        // Why a run is refused, the request to post tells.
        let _ = run.debug(&debugger).stream_seekable(Cursor::new(job.cl.as_bytes()), sink());
    }
    coverage.add(&program, &recorder.lock().unwrap_or_else(PoisonError::into_inner));
}

fn share(share: Share) -> Value {
    json!([share.hit, share.all])
}
