//! MACHIN/name,n: which post the CL file is for. The choice of the machine is
//! made before the run; the record itself writes nothing.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::post::Post;

/// Passes.
///
/// # Errors
/// None.
pub fn handle(_: &mut Post, _: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    Ok(())
}
