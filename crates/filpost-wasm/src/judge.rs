//! Judging a program: against its CL file, and against another program.

use filpost::nc::diff::{self, Options};
use filpost::nc::source::Source;
use filpost::nc::verify::Allowed;
use filpost::verify::as_json;
use filpost::{CodePage, Error, tape_style};
use serde_json::{Value, json};

use crate::diagnostics::repair_findings;
use crate::fields::Fields;
use crate::job::Job;
use crate::machine::MachineOf;
use crate::{Fault, Misuse, refused};

/// Answers with what `filpost verify --format json` prints of `nc`, or with `errors`. It has the keys of a request
/// to post; with `fil` the program is compared with a second run, without it with the path of the CL file.
pub(crate) fn verify(mut fields: Fields) -> Result<Value, Misuse> {
    let nc = fields.needed("nc")?;
    let job = Job::read(fields)?;
    Ok(verified(&job, &nc).unwrap_or_else(|fault| refused(&fault, &[])))
}

fn verified(job: &Job, nc: &str) -> Result<Value, Fault> {
    let program = job.program()?;
    let bytes = in_page(program.nc_page(), nc);
    let source = Source::memory(&bytes);
    let cl = std::io::Cursor::new(job.cl.as_bytes());
    let run = job.start(&program)?;
    let (report, reference) =
        run.verify_source(cl, (&source, "the program"), Allowed::default())?;
    let mut answer = as_json(&report, reference);
    repair_findings(&mut answer);
    Ok(answer)
}

/// Answers with `equal` and the `differences` of two programs, `nc` and `other`, in words; `lines` are those of
/// `other` and of `nc`. `tolerance`, `ignore` and `diameter` are those of a case.
pub(crate) fn compare(mut fields: Fields) -> Result<Value, Misuse> {
    let machine = MachineOf::read(&mut fields)?;
    let nc = fields.needed("nc")?;
    let other = fields.needed("other")?;
    let mut options = Options { diameter: fields.flag("diameter")?, ..Options::default() };
    if let Some(tolerance) = fields.decimal("tolerance")? {
        if !tolerance.is_finite() || tolerance < 0.0 {
            return Err(Misuse(format!("tolerance: {tolerance} is no length")));
        }
        options.tolerance = tolerance;
    }
    for entry in fields.texts("ignore")? {
        let wrong = |entry| Misuse(format!("ignore: there is no {entry}"));
        options.ignore.add(&entry).map_err(wrong)?;
    }
    fields.end()?;
    Ok(match compared(&machine, options, &nc, &other) {
        Ok(answer) => answer,
        Err(error) => refused(&Fault::Setup(error), &[]),
    })
}

fn compared(machine: &MachineOf, options: Options, nc: &str, other: &str) -> Result<Value, Error> {
    let commons = machine.builder().build_machine()?;
    let page = tape_style::page(&commons);
    let options = Options { page, ..options };
    let texts = [(other, "the other program"), (nc, "the program")];
    let [first, second] = texts
        .map(|(text, name)| diff::read(&in_page(page, text), name, &options).map_err(Error::Run));
    let (first, second) = (first?, second?);
    let found = diff::compare(&first, &second, &options).map_err(Error::Run)?;
    let differences = found.differences.iter().map(|difference| {
        let message = diff::sentence(difference, &first, &second);
        json!({ "lines": difference.lines, "message": message })
    });
    Ok(
        json!({ "equal": found.differences.is_empty(), "differences": differences.collect::<Vec<_>>() }),
    )
}

fn in_page(page: CodePage, text: &str) -> Vec<u8> {
    page.encode(text).map_or_else(|_| text.as_bytes().to_vec(), std::borrow::Cow::into_owned)
}
