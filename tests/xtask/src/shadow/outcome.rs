//! Making one program and noting what came of it.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use filpost::nc::verify::Allowed;
use filpost::verify::NcProgram;
use filpost::{Diag, Error, Program, Run};
use twox_hash::XxHash3_64;

use super::inputs::{Input, Posts};
use super::record::{PANICKED, Record, Status};

/// Without an NC program.
const NONE: &str = "-";

/// What came of an input.
pub fn of(input: &Input, posts: &Posts) -> Record {
    caught(|| input.posted(posts)).unwrap_or_else(|| Record {
        status: Status::Panicked,
        nc: NONE.to_string(),
        codes: Vec::new(),
        findings: Vec::new(),
    })
}

/// `None` after a panic. What was under construction is dropped; programs that are shared
/// never change.
fn caught<T>(run: impl FnOnce() -> T) -> Option<T> {
    catch_unwind(AssertUnwindSafe(run)).ok()
}

/// The record of a machine that makes no post.
pub fn no_post(diags: &[Diag]) -> Record {
    Record {
        status: Status::NoPost,
        nc: NONE.to_string(),
        codes: codes(diags.iter(), ""),
        findings: Vec::new(),
    }
}

/// The record of a CL text that goes through a program in runs begun by `start`; `cl_name` is
/// what those call it.
pub fn posted<'o>(
    program: &Program,
    start: impl Fn() -> Run<'o>,
    (cl, cl_name): (&[u8], &str),
) -> Record {
    let mut nc = Vec::new();
    match start().stream_seekable(Cursor::new(cl), &mut nc) {
        Ok(report) => Record {
            status: Status::Posted,
            nc: hash(&nc),
            codes: codes(program.warnings().iter().chain(&report.warnings), cl_name),
            findings: caught(|| found(start(), cl, &nc, cl_name))
                .unwrap_or_else(|| vec![PANICKED.to_string()]),
        },
        Err(error) => refused(&error, cl_name),
    }
}

fn refused(error: &Error, cl_name: &str) -> Record {
    Record {
        status: Status::Refused,
        nc: NONE.to_string(),
        codes: codes(error.diags().iter(), cl_name),
        findings: Vec::new(),
    }
}

/// What verify finds in a program, with lines of it and of the CL file, or the codes by which
/// it refuses.
fn found(run: Run<'_>, cl: &[u8], nc: &[u8], cl_name: &str) -> Vec<String> {
    let nc = NcProgram { text: nc, name: "out.nc" };
    let report = match run.verify(Cursor::new(cl.to_vec()), nc, Allowed::default()) {
        Ok((report, _)) => report,
        Err(error) => return codes(error.diags().iter(), cl_name),
    };
    let line = |line: Option<u32>| line.map_or(NONE.to_string(), |line| line.to_string());
    let findings = report
        .findings
        .iter()
        .map(|one| format!("{}:{}:{}", one.kind.name(), line(one.nc_line), line(one.cl_line)));
    let unverified =
        report.unverified.iter().map(|one| format!("unverified:{}", line(one.cl_line)));
    let mut found: Vec<String> = findings.chain(unverified).collect();
    found.sort();
    found
}

/// Codes with their places, sorted.
fn codes<'d>(diags: impl Iterator<Item = &'d Diag>, cl_name: &str) -> Vec<String> {
    let mut codes: Vec<String> = diags.map(|diag| placed(diag, cl_name)).collect();
    codes.sort();
    codes
}

/// A code with its line of the CL file; where it has none, with its first file and line.
fn placed(diag: &Diag, cl_name: &str) -> String {
    let code = diag.code.name();
    let in_cl = diag.spans.iter().find(|place| place.file == cl_name);
    match in_cl.or(diag.spans.first()) {
        None => code,
        Some(place) if place.file == cl_name => format!("{code}:{}", place.line),
        Some(place) => {
            let file = Path::new(&place.file).file_name().unwrap_or_default().to_string_lossy();
            format!("{code}:{}:{}", file.replace(' ', "_"), place.line)
        }
    }
}

/// A hash that is the same on each platform.
pub fn hash(bytes: &[u8]) -> String {
    format!("{:016x}", XxHash3_64::oneshot(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(cl: &str) -> Record {
        let program = Program::builder().generic("fanuc-mill").build().unwrap();
        posted(&program, || program.start(), (cl.as_bytes(), "CL"))
    }

    #[test]
    fn a_program_has_a_hash_and_codes_have_lines() {
        let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\n";
        let one = record(&format!("{cl}FINI\n"));
        assert_eq!((one.status, one.findings.len()), (Status::Posted, 0));
        let other = record(&format!("{cl}GOTO / 1, 2, 4\nFINI\n"));
        assert_ne!(one.nc, other.nc);
        let wrong = record(&format!("{cl}CYCLE / CAM\nFINI\n"));
        assert_eq!(wrong.to_string(), "refused - E0506:5");
    }

    #[test]
    fn what_verify_finds_has_both_lines() {
        let program = Program::builder().generic("fanuc-mill").build().unwrap();
        let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
        let mut nc = Vec::new();
        program.stream(cl.as_bytes(), &mut nc).unwrap();
        let wrong = String::from_utf8(nc).unwrap().replace("X1.", "X9.");
        let found = found(program.start(), cl.as_bytes(), wrong.as_bytes(), "CL");
        assert!(found.iter().any(|one| one.ends_with(":4")), "{found:?}");
    }

    #[test]
    fn a_panic_is_caught() {
        assert_eq!(caught(|| -> u8 { panic!("of a test") }), None);
        assert_eq!(caught(|| 7), Some(7));
    }
}
