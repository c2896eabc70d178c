//! `filpost post` with many CL files.

use filpost::Error;

use crate::Status;
use crate::args::PostArgs;

/// Posts many CL files.
///
/// # Errors
/// None yet.
pub fn run(_: &PostArgs) -> Result<Status, Error> {
    Ok(Status::Usage)
}
