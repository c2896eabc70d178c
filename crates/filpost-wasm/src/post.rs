//! Posting: the NC program and what made each of its blocks.

use filpost::{Commons, Diag, Event, Origin, Program, Report};
use serde_json::{Value, json};

use crate::diagnostics::all_repaired;
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
    let refused = |fault: Fault, warnings: &[Diag], machine: Option<&Commons>| match fault {
        Fault::Setup(error) => json!({
            "errors": all_repaired(error.diags(), machine, &job.cl_name),
            "warnings": all_repaired(warnings, machine, &job.cl_name),
        }),
        misuse => refused(&misuse, &[]),
    };
    let program = match job.program() {
        Ok(program) => program,
        Err(fault) => return refused(fault, &[], job.machine().as_ref()),
    };
    let machine = Some(program.commons());
    let posted = match run(job, &program, watch) {
        Ok(posted) => posted,
        Err(fault) => return refused(fault, program.warnings(), machine),
    };
    let page = program.nc_page();
    let mut answer = json!({
        "nc": page.decode_all(&posted.nc),
        "origins": origins(&posted.origins, &program.fil_files()),
        "records": posted.report.records,
        "blocks": posted.report.blocks,
        "warnings": all_repaired(
            program.warnings().iter().chain(&posted.report.warnings), machine, &job.cl_name,
        ),
    });
    if !page.is_utf8() {
        answer["encoding"] = page.name().into();
        answer["bytes"] = posted.nc.iter().map(|byte| char::from(*byte)).collect::<String>().into();
    }
    answer
}

/// What made each line, as an answer says it: CL line, record and FIL lines. Most lines of a long program are of the
/// next record on the next CL line: a row of those is their number.
fn origins(found: &[Origin], names: &[String]) -> Vec<Value> {
    let (mut said, mut line, mut record, mut row) = (Vec::new(), 0, 0, 0u64);
    for origin in found {
        let is_next = (origin.line, origin.record) == (line + 1, record + 1);
        (line, record) = (origin.line, origin.record);
        if is_next && origin.fil.is_empty() {
            row += 1;
            continue;
        }
        if row > 0 {
            said.push(json!(std::mem::take(&mut row)));
        }
        let fil = origin.fil.iter().map(|at| json!([names.get(usize::from(at.file)), at.line]));
        said.push(json!([line, record, fil.collect::<Vec<_>>()]));
    }
    if row > 0 {
        said.push(json!(row));
    }
    said
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
