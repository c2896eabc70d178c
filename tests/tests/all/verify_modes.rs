//! What the back-check says of the modes a control may be in, of blocks that may be skipped,
//! of texts and of work offsets.

use fil_nc::verify::{Allowed, FindingKind, Report, Verdict};
use filpost::Diag;
use filpost_tests::back_check::{found, listed};
use filpost_tests::nc_cases::{self, NcCase};
use filpost_tests::{back_check, root};

fn check(case: &NcCase, nc: &str) -> Result<Report, Box<Diag>> {
    let commons = case.post.commons();
    let both = back_check::both(commons, nc)?;
    back_check::compare(commons, &case.cl, (nc.as_bytes(), &both), Allowed::default())
}

/// A program that depends on what the last one left, and those that no switch and no mode of
/// the control may change.
#[test]
fn what_a_control_may_be_in_is_found() {
    let cl = root().join("tests/cl/holes.ncl.1");
    let case = &nc_cases::posted_by("fanuc-mill", &cl).expect("a program");
    let left = "is left to the control: no block sets it, and the machine settings don't either";
    let start = FindingKind::StartMode;
    for (old, new, kind, said) in [
        ("G21 ", "", start, format!("the unit {left}")),
        ("G90 ", "", start, format!("whether axis words are positions or increments {left}")),
        ("G94 ", "", start, format!("what F means {left}")),
        (" G17", "", start, format!("the plane {left}")),
        ("G99 ", "", start, format!("the level that holes return to {left}")),
        (
            "\nN220",
            "\nG81 X1. Y1. Z0. R2. F9.\nN220",
            FindingKind::Cycle,
            "a cycle is on while the tool is changed".to_string(),
        ),
        (
            "\nN220",
            "\nG1 G41 D1 X12. F9.\nN220",
            FindingKind::Compensation,
            "cutter compensation is on while the tool is changed".to_string(),
        ),
        (
            "\nN220",
            "\nG41 D1 G2 X13.5 R4. F9.\nG1 G40 X1.\nN220",
            FindingKind::Compensation,
            "cutter compensation begins on an arc, it must on a line".to_string(),
        ),
        (
            "\nN130",
            "\nG1 G41 D1 X1. F9.\nN130",
            FindingKind::Compensation,
            "cutter compensation is on in a cycle".to_string(),
        ),
        (
            "\nN40 M8",
            "\n/N40 M8",
            FindingKind::Coolant,
            "coolant is off, it should be on by M8, with block delete on".to_string(),
        ),
        (
            "\nN80 X12.5",
            "\n/N80 X12.5",
            FindingKind::Missing,
            "no hole at X12.5 Y0, with block delete on".to_string(),
        ),
    ] {
        assert!(case.nc.contains(old), "{old}:\n{}", case.nc);
        let report = check(case, &case.nc.replacen(old, new, 1)).expect("a report");
        let found = report.findings.iter().any(|one| one.kind == kind && one.message == said);
        assert!(found, "{old}{}", listed(&report));
    }
}

/// What a block of INSERT switches, the CL file asks for; its messages may be of another
/// system. A work offset that nobody asks for may be allowed.
#[test]
fn no_false_alarm_of_texts_and_offsets() {
    let post = filpost::Program::builder().generic("fanuc-mill").build().expect("a post");
    let cl = |text: &str| {
        format!(
            "UNITS / MM\nLOADTL / 1\nSPINDL / 900, CLW\nRAPID\nGOTO / 0, 0, 5\n\
             INSERT / {text}\nFEDRAT / 500, MMPM\nGOTO / 1, 2, 3\nGOTO / 4, 4, 4\nFINI\n"
        )
    };
    for text in [
        "M8",
        "G55",
        "M4",
        "S400",
        "N7 (TURN THE PART)",
        "MSG(\"TURN\")",
        "!TURN",
        "* - TURN",
        "G91",
        "T5 M6",
        "G43 H9",
        "G4 P500",
        "; TURN",
    ] {
        let cl = cl(text);
        let mut nc = Vec::new();
        let posted = post.stream(cl.as_bytes(), &mut nc);
        let nc = String::from_utf8(nc).expect("a text");
        if posted.is_err() {
            continue;
        }
        let report = back_check::check(post.commons(), &cl, &nc, Allowed::default());
        let report = report.unwrap_or_else(|diag| panic!("{text}: {diag}\n{nc}"));
        assert_eq!(report.verdict(), Verdict::Agrees, "{text}{}\n{nc}", listed(&report));
        let other = back_check::check(post.commons(), &cl_without(&cl), &nc, Allowed::default());
        let other = other.unwrap_or_else(|diag| panic!("{text}: {diag}\n{nc}"));
        let is_text = nc.contains("TURN");
        assert_eq!(other.verdict() == Verdict::Differs, !is_text && text != "G91", "{text}{nc}");
    }
    let cl = cl_without(&cl(""));
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc).expect("a program");
    let nc = String::from_utf8(nc).expect("a text").replacen("G0 X0.", "G55 G0 X0.", 1);
    let check = |offsets: Vec<u32>| {
        let allowed = Allowed { offsets, ..Allowed::default() };
        back_check::check(post.commons(), &cl, &nc, allowed).expect("a report").verdict()
    };
    assert_eq!(check(Vec::new()), Verdict::Differs);
    assert_eq!(check(vec![54]), Verdict::Differs);
    assert_eq!(check(vec![54, 55]), Verdict::Agrees);
    let named = ["G55", "g54.1p3", "E4", "G59.1", "55", ""].map(fil_nc::motion::work_offset);
    assert_eq!(named, [Some(55), Some(541_003), Some(1_000_004), Some(591_000), None, None]);
}

/// A CL file without its INSERT.
fn cl_without(cl: &str) -> String {
    let lines = cl.lines().filter(|line| !line.starts_with("INSERT"));
    lines.fold(String::new(), |text, line| text + line + "\n")
}

/// Seconds of a dwell in Klartext have three decimals, whatever letter other controls use.
#[test]
fn a_rounded_dwell_of_klartext_agrees() {
    let post = filpost::Program::builder().generic("heidenhain-tnc640").build().expect("a post");
    let cl = "UNITS / MM\nLOADTL / 1\nSPINDL / 500, CLW\nFEDRAT / 100, MMPM\nGOTO / 0, 0, 0\n\
              DELAY / 3.4375\nGOTO / 1, 2, 3\nFINI\n";
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc).expect("a program");
    let nc = String::from_utf8(nc).expect("a text");
    let check = |nc: &str| {
        let report = back_check::check(post.commons(), cl, nc, Allowed::default());
        report.expect("a report").verdict()
    };
    assert_eq!(check(&nc), Verdict::Agrees, "{nc}");
    assert_eq!(check(&nc.replace("3.438", "3.439")), Verdict::Differs, "{nc}");
}

/// The same for a SINUMERIK, whose functions have other numbers.
#[test]
fn what_a_sinumerik_may_be_in_is_found() {
    let case = &nc_cases::posted_by("sinumerik-840d", &root().join("tests/cl/planes.ncl.1"))
        .expect("a program");
    for (old, mode) in [
        ("G710 ", "the unit"),
        ("G90 ", "whether axis words are positions or increments"),
        ("G94 ", "what F means"),
        (" G17", "the plane"),
    ] {
        assert!(case.nc.contains(old), "{old}:\n{}", case.nc);
        let report = check(case, &case.nc.replacen(old, "", 1)).expect("a report");
        let found = |(kind, message): (FindingKind, &str)| {
            kind == FindingKind::StartMode && message.starts_with(mode)
        };
        let mut findings = report.findings.iter();
        assert!(findings.any(|one| found((one.kind, &one.message))), "{old}{}", listed(&report));
    }
}

/// A text of INSERT has its place between two motions.
#[test]
fn a_text_of_insert_that_is_moved_is_found() {
    let post = filpost::Program::builder().generic("fanuc-mill").build().expect("a post");
    let cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / 0, 0, 50\n\
              INSERT / M50\nFEDRAT / 100, MMPM\nGOTO / 1, 0, 50\nGOTO / 2, 0, 50\nFINI\n";
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc).expect("a program");
    let nc = String::from_utf8(nc).expect("ASCII");
    let check = |nc: &str| back_check::check(post.commons(), cl, nc, Allowed::default());
    assert_eq!(check(&nc).expect("a report").verdict(), Verdict::Agrees);
    let mut lines: Vec<&str> = nc.lines().collect();
    let text = lines.iter().position(|line| line.ends_with("M50")).expect("the text");
    let moved = lines.remove(text);
    lines.insert(text + 1, moved);
    let report = check(&lines.join("\n")).expect("a report");
    assert!(report.findings[0].message.contains("is elsewhere"), "{}", listed(&report));
}

/// The machine may name the work offsets that its programs choose.
#[test]
fn a_machine_allows_offsets() {
    let cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / 0, 0, 50\nFINI\n";
    let machine = |allowed: &str| {
        let text = format!("base = \"fanuc-mill\"\nverify.allowed_offsets = [{allowed}]\n");
        filpost::Program::builder().machine("machine.toml", &text).build().expect("a post")
    };
    let post = machine("");
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc).expect("a program");
    let nc = String::from_utf8(nc).expect("ASCII").replacen("G0 X", "G55 G0 X", 1);
    let verdict = |allowed: &str| {
        let post = machine(allowed);
        let report = back_check::check(post.commons(), cl, &nc, Allowed::default());
        report.expect("a report").verdict()
    };
    assert_eq!(verdict(""), Verdict::Differs);
    assert_eq!(verdict("'G54'"), Verdict::Differs);
    assert_eq!(verdict("'G54', 'G55'"), Verdict::Agrees);
}

/// A tool that the program measures is another one than that of the tool table.
#[test]
fn a_tool_that_the_program_measures_is_found() {
    let cl = root().join("tests/verify/again.ncl");
    let case = &nc_cases::posted_by("heidenhain-tnc640", &cl).expect("a program");
    let call = case.nc.find("TOOL CALL").expect("a tool");
    let line = case.nc[..call].rfind('\n').expect("a line before it") + 1;
    let with = |text: &str| format!("{}{text}\n{}", &case.nc[..line], &case.nc[line..]);
    let report = check(case, &with("3 TOOL DEF 1")).expect("a report");
    assert_eq!(report.verdict(), Verdict::Agrees, "{}", listed(&report));
    let report = check(case, &with("3 TOOL DEF 1 L+0 R+5")).expect("a report");
    assert_eq!(report.findings[0].kind, FindingKind::Tool, "{}", listed(&report));
}

/// What the CL file switches behind a tool change or a stop, where machines stop the spindle and
/// the coolant, must be switched behind it.
#[test]
fn what_is_not_switched_on_again_is_found() {
    let cases = nc_cases::posted(&root().join("tests/verify/again.ncl"));
    let behind = "is not switched on again after the tool change or stop";
    let (spindle, coolant) = (FindingKind::Spindle, FindingKind::Coolant);
    for (post, old, new, kind) in [
        ("fanuc-mill", "S800 M3\nN100", "S800\nN100", spindle),
        ("fanuc-mill", "N100 M8\n", "", coolant),
        ("fanuc-mill", "N140 M0\nN150 S800 M3\n", "N150 S800 M3\nN140 M0\n", spindle),
        ("heidenhain-tnc640", "TOOL CALL 2 Z S800\n10 M3\n", "TOOL CALL 2 Z S800\n", spindle),
        ("heidenhain-tnc640", "11 M8\n", "", coolant),
        ("sinumerik-840d", "S800 M3\nN120", "S800\nN120", spindle),
    ] {
        let case = cases.iter().find(|case| case.name.starts_with(post)).expect("a program");
        assert!(check(case, &case.nc).expect("a report").findings.is_empty(), "{post}");
        assert!(case.nc.contains(old), "{old}:\n{}", case.nc);
        let report = check(case, &case.nc.replacen(old, new, 1)).expect("a report");
        let said = |one: &str| one.starts_with("the ") && one.ends_with(behind);
        let found = report.findings.iter().any(|one| one.kind == kind && said(&one.message));
        assert!(found, "{post} {old}{}", listed(&report));
    }
}

/// A text that another record has written before is not that of INSERT, and F of REPEAT is the
/// user's own.
#[test]
fn texts_and_words_of_the_user_are_not_those_of_records() {
    let said = |ready: &str, cl: &str, nc: &str| {
        let post = filpost::Program::builder().generic(ready).build().expect("a machine");
        let report = back_check::check(post.commons(), cl, nc, Allowed::default());
        listed(&report.expect("a report"))
    };
    let cl = "UNITS / MM\nLOADTL / 1\nOPSTOP\nDELAY / 0.5\nFEDRAT / 300, MMPM\nGOTO / 1, 2, 3\n\
              INSERT / M1\nINSERT / G4 P500\nGOTO / 4, 2, 3\nFINI\n";
    let nc = "%\nO0001\nG21 G90 G94 G17\nT1 M6\nM1\nG4 P500\nG1 G43 X1. Y2. Z3. F300. H1\nM1\n\
              G4 P500\nX4.\nM30\n%\n";
    assert_eq!(said("fanuc-mill", cl, nc), "");
    let gone = nc.replacen("H1\nM1\n", "H1\n", 1);
    assert_ne!(said("fanuc-mill", cl, &gone), "");
    let gone = nc.replacen("M6\nM1\n", "M6\n", 1);
    assert_ne!(said("fanuc-mill", cl, &gone), "");
    let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 300, MMPM\nGOTO / 1, 2, 3\nREPEAT / 6, 200\n\
              GOTO / 4, 2, 3\nREPEAT / OFF\nGOTO / 5, 2, 3\nFINI\n";
    let nc = "0 BEGIN PGM 1 MM\n1 TOOL CALL 1 Z\n2 L X+1 Y+2 Z+3 R0 F300\n3 L X+4 F200\n\
              4 L X+5 F300\n5 M30\n6 END PGM 1 MM\n";
    assert_eq!(said("heidenhain-tnc640", cl, nc), "");
    let slow = nc.replace("X+5 F300", "X+5 F200");
    assert!(said("heidenhain-tnc640", cl, &slow).contains("it should be 300"));
}

/// Of a helix that turns by less than a last digit only its rise is left.
#[test]
fn a_helix_without_a_turn_is_a_line() {
    let post = filpost::Program::builder().generic("heidenhain-tnc640").build().expect("a machine");
    let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 300, MMPM\nGOTO / 2.2248, 1.6, 0\n\
              CIRCLE / 2.2248, 1.5998, 0, 0, 0, 1, 0.0002\nGOTO / 2.2246, 1.5998, 0.8\nFINI\n";
    let nc = "0 BEGIN PGM 1 MM\n1 TOOL CALL 1 Z\n2 L X+2.225 Y+1.6 Z+0 R0 F300\n3 L Z+0.8\n\
              4 M30\n5 END PGM 1 MM\n";
    let said = |nc: &str| {
        let report = back_check::check(post.commons(), cl, nc, Allowed::default());
        listed(&report.expect("a report"))
    };
    assert_eq!(said(nc), "");
    assert_ne!(said(&nc.replace("Z+0.8", "Z+0.9")), "");
    assert_ne!(said(&nc.replace("Z+0.8", "X+2.235 Z+0.8")), "");
}

const TOOL: &str = "LOADTL / 1; SPINDL / RPM, 1000, CLW; FEDRAT / 200, MMPM";
const DOWN: &str = "RAPID; GOTO / 0, 0, 50; GOTO / 0, 0, 10";
const FANUC: &str = "%; O0001 (1); G21 G90 G94 G17; T1 M6; S1000 M3; G0 X0. Y0.; G43 Z50. H1; \
                     G1 Z10. F200.";
const SINUMERIK: &str = "%_N_N_1_MPF; G710 G90 G94 G17; T1 M6; D1; S1000 M3; G0 X0 Y0; Z50; \
                         G1 Z10 F200";

/// A line in two blocks may begin where an axis stands at a point of the machine: the first
/// block leaves that axis there.
#[test]
fn a_line_in_two_blocks_from_a_point_of_the_machine_agrees() {
    for (method, text, blocks) in
        [(1, "G28 Z0", ["X5. Y5.", "G43 Z5. H1"]), (2, "G53 G0 X0 Y0", ["G1 Z5.", "X5. Y5."])]
    {
        let settings = [format!("linear.method={method}")];
        let settings = [settings[0].as_str()];
        let cl = format!("{TOOL}; {DOWN}; INSERT / {text}; GOTO / 5, 5, 5");
        let [first, second] = blocks;
        let nc = format!("{FANUC}; {text}; {first}; {second}; M30; %");
        assert_eq!(found("fanuc-mill", &settings, &cl, &nc), "");
        // A first block that ends beside the corner, or moves what it should leave.
        for (old, new) in [("X5. Y5.", "X5. Y6."), (first, "X5. Y5. Z6.")] {
            let wrong = nc.replacen(old, new, 1);
            assert_ne!(found("fanuc-mill", &settings, &cl, &wrong), "", "{wrong}");
        }
    }
    let cl = format!("{TOOL}; {DOWN}; INSERT / G75 Z0; GOTO / 5, 5, 5");
    let nc = format!("{SINUMERIK}; G75 Z0; X5 Y5; Z5; M30");
    assert_eq!(found("sinumerik-840d", &["linear.method=1"], &cl, &nc), "");
}

/// `G30` goes to the second reference point, and to one of a number by its P.
#[test]
fn the_number_of_a_reference_point_is_read() {
    let cl = |text: &str| format!("{TOOL}; {DOWN}; INSERT / {text}; RAPID; GOTO / 5, 5, 50");
    let nc = |text: &str| format!("{FANUC}; {text}; G0 X5. Y5.; G43 Z50. H1; M30; %");
    for text in ["G30 Z0", "G30 P2 Z0", "G30 P4 Z0"] {
        assert_eq!(found("fanuc-mill", &[], &cl(text), &nc(text)), "");
    }
    for text in ["G30 P1 Z0", "G30 P5 Z0", "G28 P2 Z0"] {
        // An author's block that is not followed leaves Z where it was, and the length on.
        let said = found("fanuc-mill", &[], &cl(text), &nc(text));
        assert!(!said.is_empty(), "{text}");
        let said = found("fanuc-mill", &[], &cl("G30 Z0"), &nc(text));
        assert!(said.contains("no reference point") || said.contains("nothing takes it"), "{said}");
    }
}

/// A text that takes the length of the tool off, as on a way to a point of the machine, does not
/// say that what the CL file moves behind it goes without.
#[test]
fn a_way_behind_a_text_that_takes_the_length_off_is_found_without_it() {
    let missing = "no length offset is active, it should be 1";
    for text in ["G53 G0 Z0 D0", "SUPA G0 Z0 D0", "D0"] {
        let cl = format!("{TOOL}; {DOWN}; INSERT / {text}; RAPID; GOTO / 20, 0, 50");
        let nc = format!("{SINUMERIK}; {text}; G0 X20 Y0; Z50; M30");
        let said = found("sinumerik-840d", &[], &cl, &nc);
        assert!(said.contains(missing), "{text}: {said}");
        let right = nc.replace("; Z50; M30", "; D1 Z50; M30");
        let said = found("sinumerik-840d", &[], &cl, &right);
        assert!(text == "D0" || said.is_empty(), "{text}: {said}");
    }
    let text = "G91 G28 Z0 G49";
    let cl = format!("{TOOL}; {DOWN}; INSERT / {text}; RAPID; GOTO / 20, 0, 50");
    let nc = format!("{FANUC}; {text}; G90; G0 X20. Y0.; Z50.; M30; %");
    let said = found("fanuc-mill", &[], &cl, &nc);
    assert!(said.contains(missing), "{said}");
    let right = nc.replace("; Z50.; M30", "; G43 Z50. H1; M30");
    assert_eq!(found("fanuc-mill", &[], &cl, &right), "");
    // At the end it may stay off.
    let cl = format!("{TOOL}; {DOWN}; INSERT / {text}");
    let nc = format!("{FANUC}; {text}; M30; %");
    assert_eq!(found("fanuc-mill", &[], &cl, &nc), "");
}

/// The first motion of a live tool is a hole on the side: X, which goes along it, is not known
/// before.
#[test]
fn the_first_hole_of_a_live_tool_on_the_side_agrees() {
    let cl = "MODE / MILL; LOADTL / 7; SPINDL / RPM, 3000, CLW; FEDRAT / 150, MMPM; \
              CYCLE / DRILL, DEPTH, 5, MMPM, 100, CLEAR, 2; GOTO / 30, 0, -5, 1, 0, 0; \
              CYCLE / OFF";
    let nc = "%; O0001 (1); G21 G99 G18; M51; T0707; G97 S3000 M13; G0 Z-5. C0.; X64.; \
              G1 G98 X50. F100.; G0 X64.; M15; M50; M30; %";
    assert_eq!(found("fanuc-mill-turn", &[], cl, nc), "");
    // Z and C come behind the R level.
    let across = nc.replace("G0 Z-5. C0.; X64.", "G0 X63.; Z-5. C0.; X64.");
    assert_ne!(found("fanuc-mill-turn", &[], cl, &across), "");
    let deep = nc.replace("G1 G98 X50.", "G1 G98 X49.");
    assert_ne!(found("fanuc-mill-turn", &[], cl, &deep), "");
}

/// SPINDL/ON turns on as the spindle turned before it stood, also for the next tap.
#[test]
fn a_tap_behind_spindl_on_turns_as_before() {
    let cl = "LOADTL / 1; SPINDL / RPM, 300, CCLW; FEDRAT / 200, MMPM; RAPID; GOTO / 0, 0, 50; \
              SPINDL / OFF; SPINDL / ON; CYCLE / TAP, DEPTH, 10, MMPR, 1, CLEAR, 2; \
              GOTO / 5, 0, 0; CYCLE / OFF";
    let nc = "%_N_N_1_MPF; G710 G90 G94 G17; T1 M6; D1; S300 M4; G0 X0 Y0; Z50; M5; S300 M4; \
              MCALL CYCLE84(2,0,2,-10,,0,4,,-1,0,300,300); X5; MCALL; M30";
    let said = found("sinumerik-840d", &[], cl, nc);
    assert_eq!(said, "");
    let clockwise = nc.replace(",,0,4,,-1,", ",,0,3,,1,");
    let said = found("sinumerik-840d", &[], cl, &clockwise);
    assert!(said.contains("the spindle is clockwise, it should be counterclockwise"), "{said}");
}

/// In another plane than CUTCOM names the cutter goes aside along another axis.
#[test]
fn a_cutter_compensated_in_another_plane_than_its_record_is_found() {
    let cl = format!(
        "{TOOL}; {DOWN}; CUTCOM / LEFT, 5, YZPLAN; GOTO / 0, 0, 5; GOTO / 0, 10, 5; CUTCOM / OFF; \
         GOTO / 0, 10, 8; CUTCOM / RIGHT, 5, ZXPLAN; GOTO / 0, 10, 5; GOTO / 5, 10, 5; \
         CUTCOM / OFF; GOTO / 5, 10, 8"
    );
    let nc =
        format!("{FANUC}; G19; G41 Z5. D5; Y10.; G40 Z8.; G18; G42 Z5. D5; X5.; G40 Z8.; M30; %");
    let check = |nc: &str| found("fanuc-mill", &[], &cl, nc);
    assert_eq!(check(&nc), "");
    for (old, new, said) in [
        ("; G19", "", "in the plane XY, it should be YZ"),
        ("G19", "G17", "in the plane XY, it should be YZ"),
        ("G18", "G17", "in the plane XY, it should be ZX"),
        ("; G18", "", "in the plane YZ, it should be ZX"),
    ] {
        let wrong = check(&nc.replacen(old, new, 1));
        assert!(wrong.contains(said), "{new}: {wrong}");
    }
}

/// What the machine's own blocks switch is asked for, and what the CL file asks for behind them
/// must be there: a record on again, or one that was on before and that no record switches off.
#[test]
fn what_blocks_of_the_settings_switch_is_asked_for() {
    let again = "SPINDL / RPM, 1000, CLW; COOLNT / ON";
    let (part, next) = (format!("{TOOL}; COOLNT / ON; {DOWN}"), "FEDRAT / 200, MMPM");
    let cl = format!("{part}; LOADTL / 2; {again}; {next}; GOTO / 0, 0, 5");
    let first = FANUC.replace("; G0 X0.", "; M8; G0 X0.");
    let cut = "G43 X0. Y0. Z5. H2";
    let nc = |before: &str, after: &str, end: &str| {
        format!("{first}; {before}T2 M6; {after}S1000 M3; M8; {cut}; {end}M30; %")
    };
    let coolant = "coolant is off, it should be on by M8";
    let spindle = "the spindle is off, it should be clockwise";
    let none = "first_change_before=[\"\"]";
    let lists = |lists: &[&str]| -> Vec<String> {
        [none].iter().chain(lists).map(|list| format!("blocks.{list}")).collect()
    };
    let said = |settings: &[&str], cl: &str, nc: &str| {
        let settings = lists(settings);
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        found("fanuc-mill", &settings, cl, nc)
    };
    let before = "change_before=[\"M9\", \"M5\"]";
    for (list, nc, wrong) in [
        (before, nc("M9; M5; ", "", ""), vec![coolant, spindle]),
        (
            "last_change_before=[\"G91 G28 Z0 M9\", \"G90\"]",
            nc("G91 G28 Z0 M9; G90; ", "", ""),
            vec![coolant],
        ),
        ("end=[\"M5\", \"M9\"]", nc("", "", "M5; M9; "), vec![coolant, spindle]),
        (
            "start=[\"G21 G90 G94 G17\", \"M7\"]",
            nc("", "", "").replace("G17; T1", "G17; M7; T1"),
            vec![],
        ),
        ("last_change_after=[\"M9\"]", nc("", "M9; ", ""), vec![]),
    ] {
        assert_eq!(said(&[list], &cl, &nc), "", "{list}");
        // Where no setting asks for it.
        let said = said(&[], &cl, &nc);
        assert!(wrong.iter().all(|wrong| said.contains(wrong)), "{list}: {said}");
    }
    // Before the blocks, it must be on.
    let early = nc("M9; M5; ", "", "").replace("; G1 Z10.", "; M9; G1 Z10.");
    assert!(said(&[before], &cl, &early).contains(coolant), "{early}");
    // A block that is not there leaves the coolant on.
    let gone = nc("M5; ", "", "M9; ");
    let asks_twice = [before, "end=[\"M9\"]"];
    assert_ne!(said(&asks_twice, &cl, &gone), "");
    // No record switches it on again, and the tool cuts.
    let once = cl.replace(&format!("{again}; "), "");
    let dry = nc("M9; M5; ", "", "").replace("; S1000 M3; M8; G43", "; G43");
    let found = said(&[before], &once, &dry);
    assert!(found.contains(coolant) && found.contains("off while the tool cuts"), "{found}");
    let only_rapid = once.replace(next, "RAPID");
    let moved = dry.replace("G43 X0. Y0. Z5.", "G0 G43 X0. Y0. Z5.");
    assert_eq!(said(&[before], &only_rapid, &moved), "");
}

/// The same in texts of the other families, and of another mode of speed.
#[test]
fn blocks_of_the_settings_of_other_controls_are_read() {
    let cl =
        format!("{TOOL}; COOLNT / ON; {DOWN}; LOADTL / 2; COOLNT / ON; RAPID; GOTO / 0, 0, 50");
    let klartext = "0 BEGIN PGM 1 MM; 1 TOOL CALL 1 Z; 2 TOOL CALL 1 Z S1000; 3 M3; 4 M8; \
                    5 L X+0 Y+0 R0 FMAX; 6 L Z+50 FMAX; 7 L Z+10 F200; 8 L Z+0 R0 FMAX M91 M9; \
                    9 TOOL CALL 2 Z; 10 M8; 11 L X+0 Y+0 FMAX; 12 L Z+50 FMAX; 13 M30; \
                    14 END PGM 1 MM";
    let sinumerik = format!(
        "{}; SUPA G0 Z0 D0 M9; T2 M6; D1; M8; G0 X0 Y0; Z50; M30",
        SINUMERIK.replace("; G0 X0", "; M8; G0 X0")
    );
    for (ready, nc, text) in [
        ("heidenhain-tnc640", klartext, "L Z+0 R0 FMAX M91 M9"),
        ("sinumerik-840d", &sinumerik, "SUPA G0 Z0 D0 M9"),
    ] {
        let list = format!("blocks.change_before=[\"{text}\"]");
        let settings = [list.as_str(), "blocks.first_change_before=[\"\"]"];
        assert_eq!(found(ready, &settings, &cl, nc), "", "{ready}");
        let said = found(ready, &[], &cl, nc);
        assert!(said.contains("coolant is off, it should be on by M8"), "{ready}: {said}");
    }
    let speed = "SPINDL / SFM, 200, CLW, MAXRPM, 3000";
    let cl = format!(
        "LOADTL / 1; {speed}; FEDRAT / 0.2, MMPR; {DOWN}; LOADTL / 2; {speed}; RAPID; \
         GOTO / 0, 0, 50"
    );
    let nc = "%; O0001 (1); G21 G99 G18; T0101; G50 S3000; G96 S61 M3; G0 X0. Z50.; G1 Z10. F0.2; \
              G97 S300 M3; T0202; G50 S3000; G96 S61 M3; G0 X0. Z50.; M30; %";
    let settings = ["blocks.change_before=[\"G97 S300 M3\"]", "blocks.first_change_before=[\"\"]"];
    assert_eq!(found("fanuc-lathe", &settings, &cl, nc), "");
    let said = found("fanuc-lathe", &[], &cl, nc);
    assert!(said.contains("m/min"), "{said}");
}

#[test]
fn a_dwell_by_x_beside_milliseconds_in_p_is_read() {
    let cl =
        "RAPID; GOTO / 0, 0, 50; FEDRAT / 100, MMPM; GOTO / 0, 0, 5; DELAY / 2; GOTO / 9, 0, 5";
    let nc = |dwell: &str| {
        format!(
            "%\nO0001 (T)\nG21 G90 G94 G17\nG0 X0. Y0.\nZ50.\nG1 Z5. F100.\n{dwell}\nX9.\nM30\n%\n"
        )
    };
    let found = |dwell: &str| back_check::found("fanuc-mill", &[], cl, &nc(dwell));
    assert_eq!(found("G4 P2000"), "");
    assert_eq!(found("G4 X2."), "");
    assert!(found("G4 X3.").contains("dwell"), "{}", found("G4 X3."));
}
