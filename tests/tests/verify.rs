//! The back-check: every program of the suites agrees with its CL file.

use fil_cl::Options;
use fil_nc::dialect::Dialect;
use fil_nc::interpret::events;
use fil_nc::motion::Event;
use fil_nc::verify::{Check, Report, Verdict, compare_programs, verify};
use filpost_tests::mutants;
use filpost_tests::nc_cases::{self, NcCase};

fn check(case: &NcCase, nc: &str) -> Result<Report, String> {
    let dialect = Dialect::new(&case.commons).map_err(|diag| diag.to_string())?;
    let events = events(nc.as_bytes(), "nc", &dialect).map_err(|diag| diag.to_string())?;
    let check = Check {
        cl: case.cl.as_slice(),
        cl_name: &case.name,
        options: Options::default(),
        nc: nc.as_bytes(),
        events: &events,
        commons: &case.commons,
        tolerance: None,
    };
    verify(check).map_err(|diag| diag.to_string())
}

#[test]
fn programs_agree_with_their_cl_files() {
    let mut wrong = String::new();
    for case in nc_cases::all().iter().filter(|case| !case.fil) {
        match check(case, &case.nc) {
            Ok(report) if report.verdict() == Verdict::Differs => {
                wrong += &format!("\n{}:\n", case.name);
                for finding in report.findings.iter().take(4) {
                    wrong += &format!("  {finding}\n");
                }
            }
            Ok(report) if report.verdict() == Verdict::Partly => {
                println!("{}: {:?}", case.name, report.unverified)
            }
            Ok(_) => {}
            Err(refused) => wrong += &format!("\n{}: {refused}\n", case.name),
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// What becomes of a mutant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Fate {
    /// The machine does the same.
    Same,
    /// The interpreter refuses it.
    Refused,
    /// The back-check reports it.
    Reported,
    /// Nobody sees it.
    Missed,
}

fn fate(case: &NcCase, original: &[Event], dialect: &Dialect, nc: &str) -> Fate {
    let Ok(found) = events(nc.as_bytes(), "nc", dialect) else { return Fate::Refused };
    if found == original {
        return Fate::Same;
    }
    let reported = if case.fil {
        compare_programs(original, &found, None).verdict() == Verdict::Differs
    } else {
        check_events(case, nc, &found).is_none_or(|report| report.verdict() == Verdict::Differs)
    };
    if reported { Fate::Reported } else { Fate::Missed }
}

fn check_events(case: &NcCase, nc: &str, events: &[Event]) -> Option<Report> {
    let check = Check {
        cl: case.cl.as_slice(),
        cl_name: &case.name,
        options: Options::default(),
        nc: nc.as_bytes(),
        events,
        commons: &case.commons,
        tolerance: None,
    };
    verify(check).ok()
}

#[test]
fn faults_are_found() {
    let (mut same, mut refused, mut reported) = (0, 0, 0);
    let mut missed = Vec::new();
    for case in nc_cases::all() {
        let dialect = Dialect::new(&case.commons).unwrap();
        let Ok(original) = events(case.nc.as_bytes(), "nc", &dialect) else {
            println!("refused: {}", case.name);
            continue;
        };
        for mutant in mutants::all(&case.nc) {
            match fate(&case, &original, &dialect, &mutant.text) {
                Fate::Same => same += 1,
                Fate::Refused => refused += 1,
                Fate::Reported => reported += 1,
                Fate::Missed => {
                    missed.push(format!("{}:{}: {}", case.name, mutant.line, mutant.fault))
                }
            }
        }
    }
    println!("{same} same, {refused} refused, {reported} reported, {} missed", missed.len());
    for one in &missed {
        println!("{one}");
    }
}
