//! The audit: what scripts and INSERT changed in a program, and whether the rest does what the CL file asks for.

use filpost::audit::as_json;
use serde_json::Value;

use crate::diagnostics::repair_findings;
use crate::fields::Fields;
use crate::job::Job;
use crate::{Fault, Misuse, refused};

/// Answers with what `filpost post --audit=FILE` writes, or with `errors`. It has the keys of a request to post.
pub(crate) fn audit(fields: Fields) -> Result<Value, Misuse> {
    let job = Job::read(fields)?;
    Ok(audited(&job).unwrap_or_else(|fault| refused(&fault, &[])))
}

fn audited(job: &Job) -> Result<Value, Fault> {
    let program = job.program()?;
    let (_, audit) = job.start(&program)?.post_audited(&job.cl)?;
    let mut answer = as_json(&audit);
    repair_findings(&mut answer);
    Ok(answer)
}
