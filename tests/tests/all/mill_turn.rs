//! Random programs for a mill-turn machine: turning, holes along Z and square to it, milling in
//! polar interpolation, grooves on a cylinder. The back-check, which has its own reading of
//! G12.1 and G7.1, must find nothing in the program of the post, and something in one with a
//! changed coordinate.

use std::env;
use std::fmt::Write;
use std::io::Cursor;

use filpost::Program;
use filpost::nc::verify::Allowed;
use filpost::verify::NcProgram;
use filpost_tests::turning::part::Part;

/// Programs in the normal run.
const SAMPLE: u64 = 60;

fn nc_of(post: &Program, cl: &str) -> Result<String, String> {
    let mut nc = Vec::new();
    match post.stream(cl.as_bytes(), &mut nc) {
        Ok(_) => Ok(String::from_utf8(nc).unwrap()),
        Err(error) => Err(error.to_string()),
    }
}

/// What the back-check says against a program; empty when it agrees.
fn said_against(post: &Program, cl: &str, nc: &str) -> String {
    let program = NcProgram { text: nc.as_bytes(), name: "out.nc" };
    match post.start().verify(Cursor::new(cl.to_string()), program, Allowed::default()) {
        Ok((report, _)) if report.compared == 0 => "nothing was compared".to_string(),
        Ok((report, _)) => {
            let mut said: String = report.findings.iter().map(|one| format!("{one}\n")).collect();
            said.extend(report.unverified.iter().map(|one| format!("{one:?}\n")));
            said
        }
        Err(error) => error.to_string(),
    }
}

/// The seeds: a sample, or what `FILPOST_MILL_TURN=first,count` says.
fn seeds() -> std::ops::Range<u64> {
    let said = env::var("FILPOST_MILL_TURN").ok();
    let range = said.as_deref().and_then(|said| said.split_once(','));
    match range.map(|(first, count)| (first.parse::<u64>(), count.parse::<u64>())) {
        Some((Ok(first), Ok(count))) => first..first + count,
        _ => 0..SAMPLE,
    }
}

fn post() -> Program {
    Program::builder().generic("fanuc-mill-turn").build().unwrap()
}

/// The same machine with the cycles of holes, and rigid taps; settings that say what its control
/// makes of pecks.
fn post_with_cycles(pecks: &[&str]) -> Program {
    let cycles =
        ["mill_turn.face_drill_code=83", "mill_turn.side_drill_code=87", "cycle.rigid_tap_mode=29"];
    let settings = cycles.iter().chain(pecks);
    let base = Program::builder().generic("fanuc-mill-turn");
    settings.fold(base, |builder, setting| builder.set(setting)).build().unwrap()
}

fn sinumerik() -> Program {
    Program::builder().generic("sinumerik-mill-turn").build().unwrap()
}

#[test]
fn random_programs_agree_with_their_cl() {
    let posts = [
        post(),
        post_with_cycles(&[]),
        post_with_cycles(&["mill_turn.peck_form=1", "mill_turn.side_peck=2"]),
        post_with_cycles(&["mill_turn.peck_form=2", "mill_turn.side_peck=1"]),
    ];
    let mut wrong = Vec::new();
    let mut kinds = [0; 8];
    for seed in seeds() {
        let cl = Part::random(seed);
        let post = &posts[(seed % 4) as usize];
        let said = match nc_of(post, &cl) {
            Err(said) => format!("refused: {said}"),
            Ok(nc) => {
                for (count, sign) in kinds
                    .iter_mut()
                    .zip(["M51", "G12.1", "G7.1", "G84", "G88", "G83", "G87", "R0. Q"])
                {
                    *count += u32::from(nc.contains(sign));
                }
                let said = said_against(post, &cl, &nc);
                if said.is_empty() { said } else { format!("{said}{nc}") }
            }
        };
        if !said.is_empty() {
            wrong.push(format!("seed {seed}: {said}\n{cl}"));
        }
    }
    let count = wrong.len();
    assert!(
        wrong.is_empty(),
        "{count} differ; the first two:\n{}",
        wrong[..count.min(2)].join("\n")
    );
    assert!(kinds.iter().all(|count| *count > 2), "{kinds:?}");
}

/// TRANSMIT and TRACYL of a SINUMERIK.
#[test]
fn random_programs_of_a_sinumerik_agree_with_their_cl() {
    let post = sinumerik();
    let mut wrong = Vec::new();
    let mut kinds = [0; 3];
    for seed in seeds() {
        let cl = Part::of_machine(seed, false);
        let said = match nc_of(&post, &cl) {
            Err(said) => format!("refused: {said}"),
            Ok(nc) => {
                for (count, sign) in kinds.iter_mut().zip(["M70", "TRANSMIT", "TRACYL"]) {
                    *count += u32::from(nc.contains(sign));
                }
                let said = said_against(&post, &cl, &nc);
                if said.is_empty() { said } else { format!("{said}{nc}") }
            }
        };
        if !said.is_empty() {
            wrong.push(format!("seed {seed}: {said}\n{cl}"));
        }
    }
    let count = wrong.len();
    let first = wrong[..count.min(2)].join("\n");
    assert!(wrong.is_empty(), "{count} differ; the first two:\n{first}");
    assert!(kinds.iter().all(|count| *count > 2), "{kinds:?}");
}

/// By hand: a quarter turn on a cylinder of 40 mm is 31.416 mm of Y, and its lead 10 mm of Z; the
/// square of 24 by 24 has its corners at X and Y of 12.
#[test]
fn transmit_and_tracyl_by_hand() {
    let post = sinumerik();
    let mut cl = "UNITS / MM\nMODE / MILL\nLOADTL / 1\nSPINDL / RPM, 2000, CLW\nMULTAX / ON\n\
                  RAPID\nGOTO / 25, 0, -10, 1, 0, 0\nFEDRAT / 200, MMPM\n\
                  GOTO / 20, 0, -10, 1, 0, 0\n"
        .to_string();
    for step in 1..=30 {
        let angle = f64::from(step) * 3.0;
        let (sine, cosine) = libm::sincos(angle.to_radians());
        let z = -10.0 - f64::from(step) / 3.0;
        writeln!(
            cl,
            "GOTO / {:.7}, {:.7}, {z:.7}, {cosine:.9}, {sine:.9}, 0",
            20.0 * cosine,
            20.0 * sine
        )
        .unwrap();
    }
    cl.push_str("RAPID\nGOTO / 0, 30, -20, 0, 1, 0\nFINI\n");
    let nc = nc_of(&post, &cl).unwrap();
    let words = |line: &str| line.split_once(' ').map(|(_, rest)| rest.to_string());
    let blocks: Vec<String> = nc.lines().filter_map(words).collect();
    let at = blocks.iter().position(|block| block == "TRACYL(40)").unwrap();
    assert_eq!(blocks[at - 1], "DIAMOF");
    let quarter = 20.0 * std::f64::consts::FRAC_PI_2;
    assert_eq!(blocks[at + 1], "X20 Y1.047 Z-10.333");
    assert_eq!(blocks[at + 30], format!("Y{quarter:.3} Z-20"));
    assert_eq!(blocks[at + 31..at + 34], ["TRAFOOF", "DIAMON", "G0 X60 C90"]);
}

#[test]
fn a_changed_coordinate_is_found() {
    let posts = [post(), post_with_cycles(&[]), sinumerik()];
    let mut changed = 0;
    for seed in 0..20 {
        let by_statements = seed % 3 == 2;
        let cl = Part::of_machine(seed, !by_statements);
        let post = &posts[if by_statements { 2 } else { (seed % 2) as usize }];
        let nc = nc_of(post, &cl).unwrap();
        let lines: Vec<&str> = nc.lines().collect();
        for (number, line) in lines.iter().enumerate().step_by(5) {
            let Some(at) = line.rfind([' ']).map(|at| at + 1) else { continue };
            let is_coordinate =
                line[at..].starts_with(['X', 'Y', 'Z', 'C']) && !line.contains("G7.1");
            let Ok(value) = line[at + 1..].parse::<f64>() else { continue };
            if !is_coordinate {
                continue;
            }
            let other = format!("{}{:.3}", &line[..at + 1], value + 1.25);
            let text: String = lines
                .iter()
                .enumerate()
                .map(|(n, line)| if n == number { &*other } else { *line })
                .map(|line| format!("{line}\n"))
                .collect();
            assert!(!said_against(post, &cl, &text).is_empty(), "seed {seed}: {other}\n{text}");
            changed += 1;
        }
    }
    assert!(changed > 40, "{changed}");
}

/// Each of these would break a tap, tear its thread or drill another hole.
#[test]
fn a_changed_cycle_of_a_live_tool_is_found() {
    let post = post();
    let folder = filpost_tests::root().join("corpus/lathe/fanuc-mill-turn/live-taps");
    let [cl, nc] =
        ["part.ncl", "expected.nc"].map(|name| std::fs::read_to_string(folder.join(name)).unwrap());
    assert_eq!(said_against(&post, &cl, &nc), "");
    for (word, other) in [
        ("G84 Z-14. R0. F750.", "G84 Z-14. R0. F700."),
        ("G84 Z-14. R0. F750.", "G84 Z-15. R0. F750."),
        ("G84 Z-14. R0. F750.", "G84 Z-14. R-2. F750."),
        ("G84 Z-14. R0. F750.", "G84 Z-14. R0. Q2. F750."),
        ("G84 Z-14. R0. F750.", "G84 Z-14. R0. P500 F750."),
        ("G84 Z-14. R0. F750.", "G83 Z-14. R0. F750."),
        ("G84 Z-14. R0. F750.", "G88 Z-14. R0. F750."),
        ("G88 X36. R0. F635.", "G88 X37. R0. F635."),
        ("G88 X36. R0. F635.", "G84 X36. R0. F635."),
        ("G88 X36. R0. F635.", "G88 X136. R0. F635."),
        ("N80 Z8.\nN90 G13.1", "N80 Z8."),
        ("M13", "M14"),
    ] {
        assert!(nc.contains(word), "{word}");
        let changed = nc.replacen(word, other, 1);
        assert!(!said_against(&post, &cl, &changed).is_empty(), "{other}\n{changed}");
    }
}

/// A peck of another depth or kind, and one whose control says nothing of it.
#[test]
fn a_changed_peck_of_a_live_tool_is_found() {
    let cl = "UNITS / MM\nMODE / MILL\nLOADTL / 3\nSPINDL / RPM, 1000, CLW\nMULTAX / ON\nRAPID\n\
              GOTO / 20, 0, 10, 0, 0, 1\nCYCLE / DEEP, DEPTH, 12, STEP, 5, MMPM, 90, CLEAR, 3\n\
              GOTO / 10, 0, 0, 0, 0, 1\nRAPID\nGOTO / 30, 0, -10, 1, 0, 0\n\
              GOTO / 0, 25, -10, 0, 1, 0\nCYCLE / OFF\nFINI\n";
    let settings = ["mill_turn.peck_form=1", "mill_turn.side_peck=2"];
    let post = post_with_cycles(&settings);
    let nc = nc_of(&post, cl).unwrap();
    assert_eq!(said_against(&post, cl, &nc), "", "{nc}");
    for (word, other) in [
        ("G83 Z-12. R0. Q5.", "G83 Z-12. R0. Q4."),
        ("G83 Z-12. R0. Q5.", "G83 Z-12. R0."),
        ("G83 Z-12. R0. Q5.", "G83 Z-12. R0. Q0."),
        ("G83 Z-12. R0. Q5.", "G83 Z-12.5 R0. Q5."),
        ("G87 X26. R0. Q10.", "G87 X26. R0. Q5."),
    ] {
        assert!(nc.contains(word), "{word}: {nc}");
        let changed = nc.replacen(word, other, 1);
        assert!(!said_against(&post, cl, &changed).is_empty(), "{other}\n{changed}");
    }
    for other in [
        &[][..],
        &["mill_turn.peck_form=1"],
        &["mill_turn.peck_form=1", "mill_turn.side_peck=1"],
        &["mill_turn.peck_form=2", "mill_turn.side_peck=2"],
    ] {
        let other = post_with_cycles(other);
        assert!(!said_against(&other, cl, &nc).is_empty(), "{nc}");
    }
}

/// The rapid has ended where polar interpolation begins, and nothing is milled in it; a diameter
/// rounds otherwise than the length in the plane.
#[test]
fn polar_interpolation_may_begin_without_a_way() {
    for x in ["60", "60.0005"] {
        let cl = format!(
            "PARTNO / 1\nUNITS / MM\nMODE / MILL\nLOADTL / 5\nSPINDL / RPM, 1800, CLW\nMULTAX / ON\n\
             RAPID\nGOTO / 45, 0, 50, 1, 0, 0\nMULTAX / OFF\nRAPID\nGOTO / {x}, 0, 50\nMODE / TURN\n\
             LOADTL / 6\nSPINDL / RPM, 500, CLW\nRAPID\nGOTO / 40, 0, 2\nFINI\n"
        );
        for post in [post(), sinumerik()] {
            let nc = nc_of(&post, &cl).unwrap();
            assert_eq!(said_against(&post, &cl, &nc), "", "{nc}");
        }
    }
}
