//! Posting: the NC program and what made each of its blocks.

use std::io::Cursor;

use filpost::{Event, Origin, Program, Report};
use serde_json::{Value, json};

use crate::diagnostics::all;
use crate::job::Job;
use crate::{Fault, Misuse, refused};

/// A program that was posted.
struct Posted {
    nc: String,
    /// What made each line of the program.
    origins: Vec<Origin>,
    report: Report,
}

/// Answers a request to post: `nc` with `blocks`, or `errors`; always `warnings`.
pub(crate) fn post(job: &Job) -> Value {
    let program = match job.program() {
        Ok(program) => program,
        Err(fault) => return refused(&fault, &[]),
    };
    let posted = match run(job, &program) {
        Ok(posted) => posted,
        Err(fault) => return refused(&fault, program.warnings()),
    };
    let names = program.fil_files();
    let origin = |origin: &Origin| {
        let fil = origin.fil.iter().map(|at| json!([names.get(usize::from(at.file)), at.line]));
        json!([origin.line, origin.record, fil.collect::<Vec<_>>()])
    };
    json!({
        "nc": posted.nc,
        "origins": posted.origins.iter().map(origin).collect::<Vec<_>>(),
        "records": posted.report.records,
        "blocks": posted.report.blocks,
        "warnings": all(program.warnings().iter().chain(&posted.report.warnings)),
    })
}

fn run(job: &Job, program: &Program) -> Result<Posted, Fault> {
    let (mut nc, mut origins) = (Vec::new(), Vec::new());
    let watched = job.start(program)?.observe(|event| {
        if let Event::Block { text, origin, .. } = event {
            let lines = text.lines().count().max(1);
            origins.extend(std::iter::repeat_n(origin.clone(), lines));
        }
    });
    let report = watched.run_seekable(Cursor::new(job.cl.as_bytes()), &mut nc)?;
    let nc =
        String::from_utf8(nc).map_err(|_| Misuse("the NC program is not text in UTF-8".into()))?;
    Ok(Posted { nc, origins, report })
}
