//! `filpost explain`

use filpost::{Error, explain};

use crate::errors::CommandCode;
use crate::{Status, output};

/// Explains a subject: the words of the command line after `explain`.
///
/// # Errors
/// Standard output that can't be written.
pub fn run(subject: &[String]) -> Result<Status, Error> {
    let subject = subject.join(" ");
    if let Some(text) = explain::explain(&subject, CommandCode::ALL) {
        output::print(format!("{text}\n").as_bytes())?;
        return Ok(Status::Done);
    }
    output::say(&format!("no help for `{subject}`"));
    if let Some(near) = explain::nearest(&subject) {
        output::say(&format!("did you mean `{near}`?"));
    }
    output::say(
        "Ask for a code (E0501), a setting (rapid.split), a CL or FIL word (CYCLE), a function \
         (POSTF 13), a location (INTCOM 1861), a G or M code (G83), a ready post (haas-mill) or an option of one (preload).",
    );
    Ok(Status::Usage)
}
