//! `filpost fmt`

use std::io::{self, Read};
use std::path::Path;

use filpost::syntax::format_bytes;
use filpost::{Error, files};

use crate::args::FmtArgs;
use crate::output::{self, Target};
use crate::{Status, render, summary};

/// How the files came out.
#[derive(Default)]
struct Counts {
    changed: u64,
    refused: u64,
}

/// Formats FIL files. One that can't be formatted is left as it is, the others
/// are formatted all the same.
///
/// # Errors
/// Standard output that can't be written to.
pub fn run(args: &FmtArgs) -> Result<Status, Error> {
    let mut counts = Counts::default();
    for path in &args.files {
        match format_file(args, path) {
            Ok(true) => {
                counts.changed += 1;
                if args.check || !is_stream(path) {
                    output::print(format!("{}\n", output::input_name(path)).as_bytes())?;
                }
            }
            Ok(false) => {}
            Err(error) => {
                counts.refused += 1;
                for diag in error.diags() {
                    render::to_stderr(diag);
                }
            }
        }
    }
    output::say(&line(args, &counts));
    let failed = counts.refused > 0 || (args.check && counts.changed > 0);
    Ok(if failed { Status::Failed } else { Status::Done })
}

/// Formats a file, or only looks at it; true when it had another layout.
fn format_file(args: &FmtArgs, path: &Path) -> Result<bool, Error> {
    let bytes = read(path)?;
    let name = output::input_name(path);
    let formatted = format_bytes(&name, &bytes, args.encoding.as_deref()).map_err(Error::Setup)?;
    let changed = formatted != bytes;
    if args.check {
        return Ok(changed);
    }
    if is_stream(path) {
        output::print(&formatted)?;
    } else if changed {
        let failed = |error: io::Error| files::cant_write(path, &error);
        Target::new(Some(path)).write(|output| output.write_all(&formatted).map_err(failed))?;
    }
    Ok(changed)
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    if !is_stream(path) {
        return files::read(path);
    }
    let mut bytes = Vec::new();
    let read = io::stdin().lock().read_to_end(&mut bytes);
    read.map_err(|error| files::cant_read(Path::new("standard input"), &error))?;
    Ok(bytes)
}

fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn line(args: &FmtArgs, counts: &Counts) -> String {
    let verb = if args.check { "to be formatted" } else { "formatted" };
    format!(
        "{}: {} {verb}, {} refused",
        summary::counted(args.files.len() as u64, "file"),
        counts.changed,
        counts.refused
    )
}
