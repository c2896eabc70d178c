//! Posting: the NC program, what made each of its blocks, and its drawing.

use std::collections::HashMap;
use std::io::Cursor;

use filpost::nc::plot::{LineCause, html};
use filpost::plot::{self, Text};
use filpost::{Event, Origin, Program, Report};
use serde_json::{Value, json};

use crate::diagnostics::all;
use crate::job::{Fault, Job};

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
        Err(fault) => return refused(&fault, Vec::new()),
    };
    let posted = match run(job, &program) {
        Ok(posted) => posted,
        Err(fault) => return refused(&fault, all(program.warnings())),
    };
    let names = program.fil_files();
    let origin = |origin: &Origin| {
        let fil = origin.fil.iter().map(|at| json!([names.get(usize::from(at.file)), at.line]));
        json!([origin.line, origin.record, fil.collect::<Vec<_>>()])
    };
    let mut answer = json!({
        "nc": posted.nc,
        "origins": posted.origins.iter().map(origin).collect::<Vec<_>>(),
        "records": posted.report.records,
        "blocks": posted.report.blocks,
        "warnings": all(program.warnings().iter().chain(&posted.report.warnings)),
    });
    if job.plot {
        match drawing(job, &program, &posted) {
            Ok(page) => answer["plot"] = page.into(),
            Err(error) => answer["no_plot"] = json!(all(error.diags())),
        }
    }
    answer
}

fn refused(fault: &Fault, warnings: Vec<Value>) -> Value {
    match fault {
        Fault::Misuse(what) => json!({ "misuse": what }),
        Fault::Setup(error) => json!({ "errors": all(error.diags()), "warnings": warnings }),
    }
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
    let nc = String::from_utf8(nc)
        .map_err(|_| Fault::Misuse("the NC program is not text in UTF-8".into()))?;
    Ok(Posted { nc, origins, report })
}

/// The page with the path of the program, whose lines name what made them.
fn drawing(job: &Job, program: &Program, posted: &Posted) -> Result<String, filpost::Error> {
    let text = Text { name: "the program", bytes: posted.nc.as_bytes() };
    let mut drawing = plot::program(text, program.commons())?;
    let notes = &mut drawing.notes;
    notes.source_name.clone_from(&job.cl_name);
    notes.source = Some(job.cl.clone());
    let texts = program.fil_texts();
    let mut numbers = HashMap::new();
    for origin in &posted.origins {
        let stack = *numbers.entry(&origin.fil).or_insert_with(|| {
            if origin.fil.is_empty() {
                return 0;
            }
            notes.stacks.push(stack(&texts, origin));
            notes.stacks.len() as u32
        });
        notes.causes.push(LineCause { line: origin.line, stack });
    }
    Ok(html(&drawing))
}

/// The FIL lines of a block, innermost first.
fn stack(texts: &[(String, std::sync::Arc<str>)], origin: &Origin) -> String {
    let lines = origin.fil.iter().filter_map(|at| {
        let (name, text) = texts.get(usize::from(at.file))?;
        let line = text.lines().nth((at.line as usize).checked_sub(1)?)?;
        Some(format!("{name}:{}  {}", at.line, line.trim()))
    });
    lines.collect::<Vec<_>>().join("\n")
}
