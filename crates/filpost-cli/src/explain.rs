//! `filpost explain`

use clap::CommandFactory;
use filpost::{Error, explain};

use crate::args::Args;
use crate::errors::CommandCode;
use crate::{Status, output};

/// Explains a subject: the words of the command line after `explain`.
///
/// # Errors
/// Standard output that can't be written.
pub fn run(subject: &[String]) -> Result<Status, Error> {
    let subject = subject.join(" ");
    let known = [command(&subject), explain::explain(&subject, CommandCode::ALL)];
    let texts: Vec<String> = known.into_iter().flatten().collect();
    if !texts.is_empty() {
        output::print(format!("{}\n", texts.join("\n\n")).as_bytes())?;
        return Ok(Status::Done);
    }
    output::say(&format!("no help for `{subject}`"));
    if let Some(near) = explain::nearest(&subject) {
        output::say(&format!("did you mean `{near}`?"));
    }
    output::say(
        "Ask for a term (tool length offset), a code (E0501), a setting (rapid.split), a CL or FIL word (CYCLE), a function \
         (POSTF 13), a location (INTCOM 1861), a G or M code (G83), a ready post (haas-mill) or an option of one (preload).",
    );
    Ok(Status::Usage)
}

/// What a command of this name does, such as `verify`.
fn command(name: &str) -> Option<String> {
    let program = Args::command();
    let found = program.find_subcommand(name.trim_start_matches("filpost "))?;
    let name = found.get_name();
    let about = found.get_about().map(ToString::to_string).unwrap_or_default();
    Some(format!("filpost {name}\n\n{about}.\nOptions: `filpost {name} --help`"))
}
