//! The checker alone, without a post: moves the machine by an NC program, and compares the path of the
//! tool with the CL file.
//!
//! `cargo run -p fil-nc --example check -- part.ncl part.nc machine.toml`
//!
//! The status is 0 when they agree, else 1.

use std::fs;
use std::process::ExitCode;

use fil_nc::cl::{Options, Reader};
use fil_nc::diag::Diag;
use fil_nc::dialect::Dialect;
use fil_nc::interpret::{PassedOver, Running};
use fil_nc::machine::files::lay_over;
use fil_nc::machine::locations::default_commons;
use fil_nc::machine::{Commons, Unit};
use fil_nc::source::Source;
use fil_nc::verify::{Allowed, Check, Report, Verdict, verify};

/// Compares a program with its CL file, both in mm unless the CL file says its unit.
///
/// # Errors
/// A machine that makes no sense, a program that can't be followed, a CL file that can't be
/// read.
fn check(cl: &[u8], nc: &[u8], machine: &str) -> Result<Report, Vec<Diag>> {
    let mut commons = default_commons();
    lay_over(&mut commons, "machine.toml", machine)?;
    compare(cl, nc, &commons).map_err(|diag| vec![*diag])
}

fn compare(cl: &[u8], nc: &[u8], commons: &Commons) -> Result<Report, Box<Diag>> {
    let dialect = Dialect::new(commons)?;
    let source = Source::memory(nc);
    let passed = PassedOver::default();
    verify(Check {
        cl: Reader::new(cl, "the CL file", Options::default()),
        cl_name: "the CL file",
        unit: Some(Unit::Mm),
        nc: &source,
        nc_name: "the program",
        events: &mut Running::new(&source, "the program", &dialect).passing_over(&passed),
        passed: &passed,
        commons,
        allowed: Allowed::default(),
        skips_blocks: dialect.leaves_blocks_out(),
    })
}

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let [cl, nc, machine] = &names[..] else {
        eprintln!("usage: check PART.ncl PART.nc MACHINE.toml");
        return ExitCode::from(2);
    };
    let (Ok(cl), Ok(nc), Ok(machine)) = (fs::read(cl), fs::read(nc), fs::read_to_string(machine))
    else {
        eprintln!("one of the files can't be read");
        return ExitCode::FAILURE;
    };
    match check(&cl, &nc, &machine) {
        Ok(report) => {
            report.findings.iter().for_each(|found| println!("{found:?}"));
            println!("{:?}, {} motions compared", report.verdict(), report.compared);
            ExitCode::from(u8::from(report.verdict() != Verdict::Agrees))
        }
        Err(diags) => {
            diags.iter().for_each(|diag| eprintln!("{diag}"));
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
const CL: &[u8] = b"LOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nGOTO / 4, 2, 3\nFINI\n";

#[test]
fn a_right_program_agrees() {
    let nc = b"G21 G90 G94\nM6 T1\nG43 H1\nG1 X1. Y2. Z3. F200.\nX4.\nM30\n";
    let report = check(CL, nc, "").unwrap();
    assert_eq!((report.verdict(), report.compared), (Verdict::Agrees, 2), "{report:?}");
}

#[test]
fn a_wrong_program_differs() {
    let nc = b"G21 G90 G94\nM6 T1\nG43 H1\nG1 X1. Y2. Z3. F200.\nX4.5\nM30\n";
    let report = check(CL, nc, "").unwrap();
    assert_eq!(report.verdict(), Verdict::Differs, "{report:?}");
}
