//! Posting: the NC program and what made each of its blocks.

use filpost::{Event, Origin, Program, Report};
use serde_json::{Value, json};

use crate::diagnostics::all;
use crate::job::Job;
use crate::watch::Watch;
use crate::{Fault, refused};

/// A program that was posted.
struct Posted {
    nc: Vec<u8>,
    /// What made each line of the program.
    origins: Vec<Origin>,
    report: Report,
}

/// Answers a request to post: `nc` with `blocks`, or `errors`; always `warnings`. Where the
/// program is not in UTF-8, `encoding` names how it is and `bytes` has a character for each byte,
/// U+0000 to U+00FF: it is they that go to the control.
pub(crate) fn post(job: &Job, watch: &Watch) -> Value {
    let program = match job.program() {
        Ok(program) => program,
        Err(fault) => return refused(&fault, &[]),
    };
    let posted = match run(job, &program, watch) {
        Ok(posted) => posted,
        Err(fault) => return refused(&fault, program.warnings()),
    };
    let names = program.fil_files();
    // Most lines of a long program are of the next record on the next line: a page reads them without an object each.
    let (mut line, mut record) = (0, 0);
    let origin = |origin: &Origin| {
        let is_next = (origin.line, origin.record) == (line + 1, record + 1);
        (line, record) = (origin.line, origin.record);
        if is_next && origin.fil.is_empty() {
            return json!(0);
        }
        let fil = origin.fil.iter().map(|at| json!([names.get(usize::from(at.file)), at.line]));
        json!([line, record, fil.collect::<Vec<_>>()])
    };
    let page = program.nc_page();
    let mut answer = json!({
        "nc": page.decode_all(&posted.nc),
        "origins": posted.origins.iter().map(origin).collect::<Vec<_>>(),
        "records": posted.report.records,
        "blocks": posted.report.blocks,
        "warnings": all(program.warnings().iter().chain(&posted.report.warnings)),
    });
    if !page.is_utf8() {
        answer["encoding"] = page.name().into();
        answer["bytes"] = posted.nc.iter().map(|byte| char::from(*byte)).collect::<String>().into();
    }
    answer
}

fn run(job: &Job, program: &Program, watch: &Watch) -> Result<Posted, Fault> {
    let (mut nc, mut origins) = (Vec::new(), Vec::new());
    let watched = job.start(program)?.cancel(watch.token()).observe(|event| {
        if let Event::Block { text, origin, .. } = event {
            let lines = text.lines().count().max(1);
            origins.extend(std::iter::repeat_n(origin.clone(), lines));
        }
    });
    let report = watched.stream_seekable(watch.reading(&job.cl), &mut nc)?;
    Ok(Posted { nc, origins, report })
}
