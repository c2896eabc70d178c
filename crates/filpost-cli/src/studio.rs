//! `filpost studio`: starts the program of the studio, which is a crate of its own so that this
//! command is built without its page and its server.

use std::io;
use std::path::PathBuf;
use std::process::Command;

use filpost::{Diag, Error, files};

use crate::Status;
use crate::args::StudioArgs;
use crate::errors::CommandCode;

/// Name of the program.
const PROGRAM: &str = "filpost-studio";

/// Runs the studio until it ends.
///
/// # Errors
/// E0812 where its program is not there, E0701 where it can't be started.
pub fn run(args: &StudioArgs) -> Result<Status, Error> {
    let beside = beside();
    let mut command = Command::new(beside.as_deref().unwrap_or(PROGRAM.as_ref()));
    command.arg("--port").arg(args.port.to_string());
    if args.no_open {
        command.arg("--no-open");
    }
    let ended = command.arg("--").arg(&args.folder).status().map_err(|error| {
        if error.kind() == io::ErrorKind::NotFound {
            let message = format!("there is no {PROGRAM}");
            Error::Setup(vec![Diag::new(CommandCode::NoStudio, message)])
        } else {
            files::cant_read(PROGRAM.as_ref(), &error)
        }
    })?;
    Ok(if ended.success() { Status::Done } else { Status::Failed })
}

/// The program in the folder of this one.
fn beside() -> Option<PathBuf> {
    let own = std::env::current_exe().ok()?;
    let name = format!("{PROGRAM}{}", std::env::consts::EXE_SUFFIX);
    Some(own.with_file_name(name)).filter(|path| path.is_file())
}
