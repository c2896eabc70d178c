//! `filpost post --each-tool`: a CL file and a program for each tool change.

use std::ffi::OsString;
use std::fs::File;
use std::path::{Path, PathBuf};

use filpost::tool_files::{self, Change};
use filpost::{Error, files};

use crate::args::PostArgs;
use crate::job::Job;
use crate::output::{self, Target};
use crate::posts::Posts;
use crate::{Status, post, setup};

/// Writes the CL files, all of them before the first program, and posts each.
///
/// # Errors
/// A CL file without a tool change; a change that is no program by itself; as a run of the post.
pub fn run(args: &PostArgs, cl: &Path) -> Result<Status, Error> {
    let options = setup::cl_options(args.reading.encoding.as_deref(), &args.cl_reading, args.raw)?;
    let name = output::input_name(cl);
    let changes = tool_files::changes(output::open(cl)?, &name, options).map_err(Error::Run)?;
    if changes.all.is_empty() {
        let message = format!("{name} has no tool change");
        return Err(Error::Run(filpost::RunCode::ToolFile.diag(message)));
    }
    let output = args.output.as_deref().unwrap_or(Path::new(""));
    let jobs = jobs(&changes.all, args, cl, output);
    let inputs = [cl];
    output::refuse_over(jobs.iter().map(|job| job.cl.as_path()), inputs)?;
    let text_of = |number: usize| -> Result<File, Error> {
        let cant = |error| files::cant_write(&jobs[number].cl, &error);
        let mut text = output::temporary_file().map_err(cant)?;
        let written = changes.write_one(number, output::open(cl)?, &name, options, &mut text);
        written.map_err(Error::Run).map(|()| text)
    };
    let texts = (0..jobs.len()).map(text_of).collect::<Result<Vec<_>, _>>()?;
    for (job, mut text) in jobs.iter().zip(texts) {
        Target::new(Some(&job.cl)).write(|out| {
            let copied = std::io::copy(&mut text, out);
            copied.map(|_| ()).map_err(|error| files::cant_write(&job.cl, &error))
        })?;
    }
    let posts = Posts::new(args);
    for job in &jobs {
        match post::carry_out(&posts, job)? {
            Status::Done => {}
            status => return Ok(status),
        }
    }
    Ok(Status::Done)
}

/// A job for each change: the file names have the number of the tool, and behind a tool that comes
/// again how often it has come.
fn jobs(changes: &[Change], args: &PostArgs, cl: &Path, output: &Path) -> Vec<Job> {
    let times = |at: usize| changes[..=at].iter().filter(|c| c.tool == changes[at].tool).count();
    let of_change = |at: usize| {
        let mark = match times(at) {
            1 => format!("_t{}", changes[at].tool),
            again => format!("_t{}_{again}", changes[at].tool),
        };
        let nc = marked(output, &mark, output.extension());
        let map = args.map.as_ref().map(|named| match named {
            Some(named) => marked(named, &mark, named.extension()),
            None => post::beside(&nc),
        });
        let audit = args.audit.clone().flatten();
        Job {
            cl: marked(output, &mark, cl.extension()),
            output: Some(nc),
            listing: None,
            map,
            audit: audit.map(|named| marked(&named, &mark, named.extension())),
        }
    };
    (0..changes.len()).map(of_change).collect()
}

/// A path with a mark behind the name, before the extension.
fn marked(path: &Path, mark: &str, extension: Option<&std::ffi::OsStr>) -> PathBuf {
    let mut name = OsString::from(path.file_stem().unwrap_or_default());
    name.push(mark);
    if let Some(extension) = extension {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}
