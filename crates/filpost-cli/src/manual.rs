//! `filpost man`

use clap::CommandFactory;
use clap_mangen::Man;
use filpost::Error;

use crate::args::Args;
use crate::{Status, output};

/// Prints the manual page of filpost, or that of a command of it.
///
/// # Errors
/// Standard output that can't be written.
pub fn run(name: Option<&str>) -> Result<Status, Error> {
    let mut filpost = Args::command().long_version(None);
    filpost.build();
    let command = match name {
        None => filpost,
        Some(name) => match filpost.find_subcommand(name) {
            Some(command) => command.clone(),
            None => {
                output::say(&format!("error: filpost has no command `{name}`"));
                return Ok(Status::Usage);
            }
        },
    };
    let mut page = Vec::new();
    let source = concat!("filpost ", env!("CARGO_PKG_VERSION"));
    Man::new(command)
        .source(source)
        .render(&mut page)
        .map_err(|error| output::stdout_error(&error))?;
    output::print(&page)?;
    Ok(Status::Done)
}
