//! Codes that a user may allow.

use fil_diag::{Code, Diag};

use crate::error::{RunCode, all_codes};

/// The code of that name, `W0151` or `E0223`, where it can be allowed: a warning, or an
/// error of a FIL script that can run but may have been meant otherwise.
///
/// # Errors
/// E0713 for a name that is no code, and for an error that stands.
pub fn allowable(name: &str) -> Result<&'static Code, Box<Diag>> {
    let found = all_codes().into_iter().find(|code| code.name().eq_ignore_ascii_case(name));
    match found {
        Some(code) if fil_vm::is_allowable(code) => Ok(code),
        Some(code) => {
            RunCode::CannotAllow.err(format!("{} ({}) can't be allowed", code.name(), code.title))
        }
        None => RunCode::CannotAllow.err(format!("there is no code {name}")),
    }
}
