//! The back-check: every program of the suites agrees with what it comes from, and
//! small faults put into them are found.
//!
//! `tests/verify/agree.txt` and `tests/verify/faults.txt` list what was not compared
//! and what was not found; `FILPOST_UPDATE=1` writes them anew.

use std::collections::{BTreeMap, HashSet};
use std::fmt::Write as _;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use fil_machine::axis_chain::AxisChain;
use fil_nc::forward::Forward;
use fil_nc::motion::Event;
use fil_nc::verify::{Allowed, FindingKind, Programs, Report, Verdict, compare_programs};
use filpost::Diag;
use filpost::verify::{NcProgram, Reference};
use filpost_tests::back_check::{self, Both, listed};
use filpost_tests::mutants::{self, Mutant};
use filpost_tests::nc_cases::{self, NcCase};
use filpost_tests::root;
use filpost_tests::same_events;

use super::verify_idle::{IDLE, ROUNDED};

/// Share of the faults that change what the machine does which must be found.
const FOUND: f64 = 0.9963;

/// Of so many faults one is tried in the normal run; all with `FILPOST_FAULTS=all`.
const SAMPLE: usize = 16;

fn events(case: &NcCase, nc: &str) -> Result<Both, Box<Diag>> {
    back_check::both(case.post.commons(), nc)
}

fn against_cl(case: &NcCase, nc: &str, both: &Both) -> Result<Report, Box<Diag>> {
    let program = (nc.as_bytes(), both);
    back_check::compare(case.post.commons(), &case.cl, program, Allowed::default())
}

fn check(case: &NcCase, nc: &str) -> Result<Report, Box<Diag>> {
    against_cl(case, nc, &events(case, nc)?)
}

/// What a program does with the blocks left out that may be skipped.
fn left_out(both: &Both) -> &[Event] {
    &both.left_out.as_ref().unwrap_or(&both.all).events
}

/// Compares with another program, whichever way the switch is.
fn against_program(case: &NcCase, original: &Both, found: &Both) -> Report {
    let compare = |mut reference: &[Event], mut found: &[Event]| {
        let programs = Programs {
            reference: &mut reference,
            found: &mut found,
            commons: case.post.commons(),
            allowed: &Allowed::default(),
        };
        compare_programs(programs).expect("events that were read")
    };
    let report = compare(&original.all.events, &found.all.events);
    if original.left_out.is_none() && found.left_out.is_none() {
        return report;
    }
    report.with_blocks_left_out(compare(left_out(original), left_out(found)))
}

/// Compares with a file of `tests/verify`, or writes it anew.
fn same_as(name: &str, found: &str) {
    let path = root().join("tests/verify").join(name);
    if std::env::var_os("FILPOST_UPDATE").is_some_and(|value| value == "1") {
        std::fs::write(&path, found).expect("the list is written");
    }
    let wanted = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(found, wanted, "{name}; FILPOST_UPDATE=1 writes it anew");
}

/// Without FIL the CL file is the reference, with FIL a second run.
#[test]
fn programs_agree_with_what_they_come_from() {
    let (mut list, mut wrong) = (String::new(), String::new());
    for case in nc_cases::all() {
        let program = NcProgram { text: case.nc.as_bytes(), name: "out.nc" };
        let verified = case.post.start().verify(Cursor::new(&case.cl), program, Allowed::default());
        let (report, reference) = match verified {
            Ok(verified) => verified,
            Err(refused) => {
                for diag in refused.diags() {
                    let _ = writeln!(list, "{}: {diag}", case.name);
                }
                continue;
            }
        };
        assert_eq!(reference == Reference::SecondRun, case.fil, "{}", case.name);
        if report.verdict() == Verdict::Differs {
            let _ = writeln!(wrong, "{}:{}", case.name, listed(&report));
        }
        if reference == Reference::SecondRun {
            let _ = writeln!(list, "{}: compared with a second run", case.name);
        }
        for open in &report.unverified {
            let _ = writeln!(list, "{}: {}", case.name, open.what);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    same_as("agree.txt", &list);
}

/// What becomes of a fault.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Fate {
    /// The machine does the same.
    Same,
    /// The interpreter refuses the program.
    Refused,
    /// The back-check reports it.
    Reported,
    /// Nobody sees it.
    Missed,
}

fn fate(case: &NcCase, original: &Both, nc: &str) -> Fate {
    let Ok(found) = events(case, nc) else { return Fate::Refused };
    if found.all.refused.len() > original.all.refused.len() {
        return Fate::Refused;
    }
    let same = same_events::same(&found.all.events, &original.all.events)
        && same_events::same(left_out(&found), left_out(original));
    if same {
        return Fate::Same;
    }
    let report = if case.fil {
        Ok(against_program(case, original, &found))
    } else {
        against_cl(case, nc, &found)
    };
    match report {
        Ok(report) if report.verdict() != Verdict::Differs => Fate::Missed,
        _ => Fate::Reported,
    }
}

/// The blocks of a program behind its number and name.
fn unnumbered(nc: &str) -> String {
    nc.lines().filter(|line| !line.starts_with('O')).collect::<Vec<_>>().join("\n")
}

/// A program of a ready post with rotary axes.
fn of_rotary_posts(case: &NcCase) -> bool {
    let is_ready = filpost::ready::READY
        .iter()
        .any(|ready| case.name.strip_prefix(ready.name).is_some_and(|rest| rest.starts_with('/')));
    let chain = AxisChain::from_commons(case.post.commons()).expect("a chain");
    case.name.starts_with("corpus/posts/") || is_ready && chain.has_rotary()
}

/// How many faults of each fate a program has, and a list of those that nobody sees.
#[derive(Default)]
struct Fates {
    counts: BTreeMap<Fate, usize>,
    missed: String,
    /// Those of them that move an axis by more than a rounding.
    of_axes: String,
}

/// What becomes of the faults of a program.
fn faults_of(case: &NcCase, step: usize, first: usize) -> Fates {
    let mut fates = Fates::default();
    let Ok(original) = events(case, &case.nc) else { return fates };
    for mutant in mutants::all(&case.nc, step, first) {
        let fate = fate(case, &original, &mutant.text);
        *fates.counts.entry(fate).or_default() += 1;
        if fate == Fate::Missed {
            let axis = mutant.word.is_some_and(|word| b"XYZABCUVW".contains(&word));
            let rounds = ROUNDED.iter().any(|name| case.name.starts_with(name));
            let said = format!("{} line {}: {}\n", case.name, mutant.line, mutant.fault);
            let idle = IDLE.iter().any(|(name, letter, block)| {
                let is_there = case.name.starts_with(name) && mutant.fault.contains(block);
                is_there && mutant.word == Some(*letter)
            });
            let excused = rounds && mutant.slight || idle || near_poses(case, &original, &mutant);
            fates.of_axes.push_str(if axis && !excused { &said } else { "" });
            fates.missed.push_str(&said);
        }
    }
    fates
}

/// The fault moves no tip by more than a rounding, and no tool out of its direction. How a live
/// tool of a lathe lies is in the CL file: without MULTAX along the spindle.
fn near_poses(case: &NcCase, original: &Both, mutant: &Mutant) -> bool {
    let forward = Forward::from_commons(case.post.commons()).expect("a machine");
    if case.name.contains("mill-turn") && String::from_utf8_lossy(&case.cl).contains("MULTAX") {
        return false;
    }
    let Ok(found) = events(case, &mutant.text) else { return false };
    forward.has_rotary()
        && same_events::near_poses(&found.all.events, &original.all.events, &forward)
}

/// Programs that get faults, each with its number among all.
fn cases_for_faults() -> Vec<(usize, NcCase)> {
    let mut of_mills = HashSet::new();
    // The ready mills write many programs alike: one of those gets the faults. Those of the
    // posts with rotary axes have the forms of other cases, and arcs as lines whose last digit
    // the rounding leaves open.
    let mut gets_faults = |case: &NcCase| {
        (!case.name.starts_with("corpus/mills/") || of_mills.insert(unnumbered(&case.nc)))
            && !of_rotary_posts(case)
    };
    nc_cases::all().into_iter().enumerate().filter(|(_, case)| gets_faults(case)).collect()
}

#[test]
fn faults_are_found() {
    let all = std::env::var_os("FILPOST_FAULTS").is_some_and(|value| value == "all");
    let step = if all { 1 } else { SAMPLE };
    let cases = cases_for_faults();
    // Each processor takes the next program that is left.
    let next = AtomicUsize::new(0);
    let found: Mutex<BTreeMap<usize, Fates>> = Mutex::default();
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..processors {
            scope.spawn(|| {
                while let Some((turn, case)) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let of_case = faults_of(case, step, *turn);
                    found.lock().expect("no thread failed").insert(*turn, of_case);
                }
            });
        }
    });
    let Fates { mut counts, mut missed, mut of_axes } = Fates::default();
    for of_case in found.into_inner().expect("no thread failed").values() {
        of_case.counts.iter().for_each(|(fate, count)| *counts.entry(*fate).or_default() += count);
        missed.push_str(&of_case.missed);
        of_axes.push_str(&of_case.of_axes);
    }
    let count = |fate| counts.get(&fate).copied().unwrap_or(0);
    println!("{counts:?}\n{missed}");
    assert!(of_axes.is_empty(), "{of_axes}");
    let least = if all { 50_000 } else { 2_500 };
    assert!(count(Fate::Reported) > least, "only {} faults were put in", count(Fate::Reported));
    if !all {
        let listed = std::fs::read_to_string(root().join("tests/verify/faults.txt"));
        let listed = listed.expect("the list");
        let known = |missed: &str| listed.lines().any(|line| line == missed);
        let new: Vec<&str> = missed.lines().filter(|missed| !known(missed)).collect();
        return assert!(new.is_empty(), "{new:#?}");
    }
    let share = count(Fate::Reported) as f64 / (count(Fate::Reported) + count(Fate::Missed)) as f64;
    assert!(share >= FOUND, "{share}:\n{missed}");
    assert!(count(Fate::Refused) > 0);
    same_as("faults.txt", &missed);
}

/// A program for the ready mill, with one word changed, and what must be said.
#[test]
fn findings_are_a_machinists_words() {
    let cl = root().join("tests/cl/holes.ncl.1");
    let case = &nc_cases::posted_by("fanuc-mill", &cl).expect("a program");
    for (old, new, kind, said) in [
        (
            "Z-7.25",
            "Z-7.55",
            FindingKind::Cycle,
            "the hole is deeper by 0.3 (Z-7.55 in place of Z-7.25)",
        ),
        ("X25.", "X26.", FindingKind::Position, "X off by 1 (X26 in place of X25)"),
        (
            "M3",
            "M4",
            FindingKind::Spindle,
            "the spindle is counterclockwise, it should be clockwise",
        ),
        ("S2500", "S250", FindingKind::Speed, "the spindle has 250 rpm, it should be 2500 rpm"),
        ("F120.", "F1200.", FindingKind::Feed, "feed 1200 mm/min, it should be 120 mm/min"),
        ("T12", "T13", FindingKind::Tool, "changes to tool 13, it should be tool 12"),
        ("H12", "H1", FindingKind::Tool, "length offset 1 is active, it should be 12"),
        ("Q4.", "Q5.", FindingKind::Cycle, "the hole is deeper by 1 (Z-3.5 in place of Z-2.5)"),
        ("P500", "P50", FindingKind::Dwell, "dwell of 0.05 s, it should be 0.5 s"),
        ("\nN80 X12.5", "\n", FindingKind::Missing, "no hole at X12.5 Y0"),
        ("M8", "M9", FindingKind::Coolant, "coolant is off, it should be on by M8"),
        ("M8", "M7", FindingKind::Coolant, "coolant is on by M7, it should be on by M8"),
        (
            "M8",
            "M8 M50",
            FindingKind::Auxiliary,
            "M50: neither the CL file nor the settings ask for it",
        ),
        ("M30", "M2", FindingKind::End, "the program ends with M2, it should be M30"),
    ] {
        assert!(case.nc.contains(old), "{old}:\n{}", case.nc);
        let report = check(case, &case.nc.replacen(old, new, 1)).expect("a report");
        let first = report.findings.first().expect(new);
        assert_eq!((first.kind, first.message.as_str()), (kind, said), "{new}{}", listed(&report));
    }
}

/// The same for a lathe: surface speed, its limit, functions of the operator and the shop.
#[test]
fn findings_of_a_lathe() {
    let cl = root().join("tests/verify/surface-speed.ncl");
    let case = &nc_cases::posted_by("fanuc-lathe", &cl).expect("a program");
    let limit = "the limit of the spindle speed is";
    for (old, new, kind, said) in [
        ("G50 S2500", "G50 S250", FindingKind::Speed, &*format!("{limit} 250, it should be 2500")),
        ("N30 G50 S2500\n", "", FindingKind::Speed, &format!("{limit} none, it should be 2500")),
        (
            "G96 S180",
            "G97 S180",
            FindingKind::Speed,
            "the spindle has 180 rpm, it should be a surface speed of 180 m/min",
        ),
        (
            "S183",
            "S18",
            FindingKind::Speed,
            "the spindle has a surface speed of 18 m/min, it should be a surface speed of 182.88 m/min",
        ),
        ("N70 M1\n", "", FindingKind::Auxiliary, "no M1"),
        ("M1\n", "M0\n", FindingKind::Auxiliary, "no M1"),
        ("M61", "M62", FindingKind::Auxiliary, "no M61"),
        (
            "N60 G1 Z-30. F0.2\nN70 M1",
            "N60 M1\nN70 G1 Z-30. F0.2",
            FindingKind::Auxiliary,
            "M1 is elsewhere, it should be between lines 9 and 11",
        ),
    ] {
        assert!(case.nc.contains(old), "{old}:\n{}", case.nc);
        let report = check(case, &case.nc.replacen(old, new, 1)).expect("a report");
        let found = report.findings.iter().any(|one| one.kind == kind && one.message == said);
        assert!(found, "{new}{}", listed(&report));
    }
}

/// After a tool change H alone takes no length offset up.
#[test]
fn a_length_offset_is_called_again_after_a_tool_change() {
    let cl = root().join("tests/cl/holes.ncl.1");
    let case = &nc_cases::posted_by("fanuc-mill", &cl).expect("a program");
    let last = case.nc.rfind("G43 ").expect("a second length offset");
    let mut without = case.nc.clone();
    without.replace_range(last..last + 4, "");
    let report = check(case, &without).expect("a report");
    let first = report.findings.first().expect("a finding");
    assert_eq!(first.kind, FindingKind::Tool, "{}", listed(&report));
    assert!(first.message.starts_with("no length offset is active"), "{first}");
}

/// A feed in inverse time is the time that the way of the tip takes: 29.7001 mm here.
#[test]
fn inverse_time_is_compared_with_a_feed() {
    let cases = nc_cases::all();
    let named = |case: &&NcCase| case.name == "verify/inverse-time-table-table";
    let case = cases.iter().find(named).expect("a program");
    let report = check(case, &case.nc.replace("F13.47", "F26.94")).expect("a report");
    let said = "feed 26.94 blocks per minute, which is 800.1213 mm/min on this move of 29.7001, it should be 400 mm/min";
    let found: Vec<(FindingKind, &str)> =
        report.findings.iter().map(|found| (found.kind, found.message.as_str())).collect();
    assert_eq!(found, [(FindingKind::Feed, said)], "{}", listed(&report));
}

/// Programs that are none of this machine or not of this part.
#[test]
fn bad_programs_are_refused() {
    let cl = root().join("tests/cl/planes.ncl.1");
    let case = &nc_cases::posted_by("fanuc-mill", &cl).expect("a program");
    let half = case.nc.len() / 2;
    let conversational = "BEGIN PGM 11 MM\n1 L X+0 Y+0 R0 FMAX\n2 END PGM 11 MM\n";
    let foreign = case.nc.replacen("G17", "G17 G68.2", 1);
    for (nc, code) in [
        (&case.nc[..half], "E0912"),
        (&case.nc[..case.nc.rfind("M30").expect("an end") + 1], "E0902"),
        (conversational, "E0902"),
        (foreign.as_str(), "E0904"),
        ("", "E0912"),
    ] {
        let refused = check(case, nc).expect_err("refused");
        assert_eq!(refused.code.name(), code, "{refused}\n{nc}");
    }
    let inch = check(case, &case.nc.replacen("G21", "G20", 1)).expect("a report");
    assert_eq!(inch.findings[0].kind, FindingKind::Units, "{}", listed(&inch));
}

/// A program that is cut off anywhere before its end is never taken as right.
#[test]
fn programs_cut_off_are_found() {
    for case in nc_cases::posted(&root().join("tests/cl/planes.ncl.1")) {
        let end = case.nc.rfind("M30").expect("an end") + "M30".len();
        for cut in 0..end {
            let said = check(&case, &case.nc[..cut]);
            let agrees = said.is_ok_and(|report| report.verdict() == Verdict::Agrees);
            assert!(!agrees, "{} cut at {cut}:\n{}", case.name, &case.nc[..cut]);
        }
    }
}

/// Whatever a program or a CL file holds, the check comes to an end.
#[test]
fn any_bytes_come_to_an_end() {
    let mut seed = 7u64;
    let mut next = move |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    for mut case in nc_cases::all().into_iter().filter(|case| !case.cl.is_empty()) {
        for _ in 0..30 {
            let mut nc: Vec<u8> = case.nc.clone().into_bytes();
            for _ in 0..3 {
                let (at, other) = (next(nc.len()), next(nc.len()));
                nc[at] = nc[other];
            }
            let (at, other) = (next(case.cl.len()), next(case.cl.len()));
            let kept = std::mem::replace(&mut case.cl[at], b' ');
            case.cl.swap(at, other);
            let _ = check(&case, &String::from_utf8_lossy(&nc));
            case.cl.swap(at, other);
            case.cl[at] = kept;
        }
    }
}

/// The real files, where they are at hand.
#[test]
fn real_files_agree() {
    let data =
        std::env::var_os("FILPOST_DATA").map_or(root().join("../shared/data"), PathBuf::from);
    let mut count = 0;
    for folder in ["cl/creo", "cl/nx"] {
        for path in nc_cases::files_in(&Path::new(&data).join(folder)) {
            for case in nc_cases::posted(&path) {
                let report =
                    check(&case, &case.nc).unwrap_or_else(|d| panic!("{}: {d}", case.name));
                assert_eq!(report.verdict(), Verdict::Agrees, "{}:{}", case.name, listed(&report));
                println!("{}: {} motions agree", case.name, report.compared);
                count += 1;
            }
        }
    }
    if count == 0 {
        println!("skipped: no CL files in {}", data.display());
    }
}

/// A long program is read and compared in about a second (in a release build).
#[test]
fn a_long_program_agrees() {
    const MOTIONS: usize = 200_000;
    let mut cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 3000., CLW\nRAPID\nGOTO / 0., 0., 5.\n\
                  FEDRAT / 500., MMPM\n"
        .to_string();
    for n in 0..MOTIONS {
        let angle = n as f64 * 0.01;
        let _ = writeln!(
            cl,
            "GOTO / {:.5}, {:.5}, {:.5}",
            angle.cos() * 90.0,
            angle.sin() * 70.0,
            angle / -500.0
        );
    }
    cl.push_str("FINI\n");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("long.ncl");
    std::fs::write(&path, cl).expect("the CL file");
    let case = &nc_cases::posted_by("fanuc-mill", &path).expect("a program");
    let start = Instant::now();
    let report = check(case, &case.nc).expect("a report");
    println!("{} motions in {:.2?}", report.compared, start.elapsed());
    assert_eq!(report.verdict(), Verdict::Agrees, "{}", listed(&report));
    assert_eq!(report.compared, MOTIONS as u64 + 1);
}
