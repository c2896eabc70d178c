//! Motions that turn the machine, divided by the post: the back-check, which bounds how
//! far the tip leaves its line, agrees on random machines and on real files.

use std::path::{Path, PathBuf};
use std::{env, fs};

use fil_nc::verify::{Allowed, Report, Verdict};
use filpost::verify::NcProgram;
use filpost::{Program, Unit};
use filpost_tests::{back_check, sample};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// Paths posted for random machines in the whole run.
const PATHS: usize = 1_500;

/// Paths that come to a limit, in the whole run.
const LIMITED: usize = 400;

/// Carries, direction, center.
type Rotary = (u8, [f64; 3], [f64; 3]);

/// Point, tilt and turn of the tool in radians, rapid.
type Target = ([f64; 3], f64, f64, bool);

fn rotaries() -> impl Strategy<Value = [Rotary; 2]> {
    let kinds = prop_oneof![Just([1u8, 1]), Just([1, 2]), Just([2, 2]), Just([1, 0]), Just([0, 2])];
    let directions = prop_oneof![
        Just([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
        Just([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]),
        Just([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        Just([[0.0, 0.0, 1.0], [0.0, -1.0, 1.0]]),
    ];
    let centers = proptest::array::uniform2(proptest::array::uniform3(-150.0..150.0f64));
    (kinds, directions, centers).prop_map(|(kinds, directions, centers)| {
        [0, 1].map(|n| (kinds[n], directions[n], centers[n]))
    })
}

fn targets() -> impl Strategy<Value = Vec<Target>> {
    let point = proptest::array::uniform3(-80.0..80.0f64);
    let tilt = prop_oneof![Just(0.0), 0.001..0.6f64];
    let turn = prop_oneof![Just(0.0), -3.0..3.0f64];
    proptest::collection::vec((point, tilt, turn, proptest::bool::weighted(0.2)), 2..8)
}

fn post(rotaries: &[Rotary; 2], pivot: Option<f64>, tolerance: f64, form: u8) -> Program {
    let mut settings = vec![
        format!("rotary.tolerance={tolerance}"),
        format!("rotary.feed={form}"),
        "rotary.feed_max=100000".to_string(),
        // Random tool axes pass poles.
        "rotary.axis_tolerance=0".to_string(),
        "feed.upm_max=99999".to_string(),
        "feed.inverse_max=99999".to_string(),
    ];
    settings.extend(pivot.map(|pivot| format!("rotary.pivot_distance={pivot}")));
    // The real files change tools, which no control counts here.
    settings.push("tool.ignore_length=1".to_string());
    for ((kind, direction, center), (name, letter)) in
        rotaries.iter().zip([("primary", 3), ("secondary", 2)])
    {
        settings.push(format!("rotary.{name}_kind={kind}"));
        settings.push(format!("rotary.{name}_axis={letter}"));
        for (parts, names) in [(direction, ["i", "j", "k"]), (center, ["x", "y", "z"])] {
            let part = |(value, part)| format!("rotary.{name}_{part}={value:?}");
            settings.extend(parts.iter().zip(names).map(part));
        }
    }
    let builder = Program::builder().generic("fanuc-mill");
    settings.iter().fold(builder, |builder, set| builder.set(set)).build().expect("a machine")
}

fn cl(targets: &[Target], feed: f64, lintol: Option<f64>) -> String {
    let lintol = lintol.map_or(String::new(), |most| format!("LINTOL / {most}\n"));
    let mut cl = format!("UNITS / MM\n{lintol}MULTAX / ON\nFEDRAT / {feed}, MMPM\n");
    for (number, ([x, y, z], tilt, turn, rapid)) in targets.iter().enumerate() {
        let (i, j, k) = (tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos());
        let rapid = if *rapid || number == 0 { "RAPID\n" } else { "" };
        cl += &format!("{rapid}GOTO / {x:.10}, {y:.10}, {z:.10}, {i:.10}, {j:.10}, {k:.10}\n");
    }
    cl + "FINI\n"
}

/// The program, and what the back-check says of it when the tip may leave its line by
/// `between`; `None` where the machine can't make the path.
fn checked(post: &Program, cl: &str, between: f64) -> Option<(String, Report)> {
    let mut nc = Vec::new();
    post.stream(cl.as_bytes(), &mut nc).ok()?;
    let nc = String::from_utf8(nc).expect("ASCII");
    let allowed = Allowed { between: Some(between), ..Allowed::default() };
    let report = back_check::check(post.commons(), cl, &nc, allowed);
    Some((nc.clone(), report.unwrap_or_else(|diag| panic!("{diag}\n{cl}\n{nc}"))))
}

/// On every machine, in every form of the feed, the tip stays as near to its line as the
/// machine or LINTOL says, and the feeds are right.
#[test]
fn the_tip_stays_near_its_line_and_goes_at_its_feed() {
    let mut runner = TestRunner::deterministic();
    let pivots = proptest::option::of(80.0..300.0f64);
    let tolerances = prop_oneof![Just(0.02), 0.02..0.5f64];
    let by_lintol = any::<bool>();
    let all = (rotaries(), pivots, targets(), tolerances, by_lintol, 50.0..3000.0f64, 0u8..4);
    let (mut paths, mut divided) = (0, 0);
    for _ in 0..sample::of(PATHS) {
        let (rotaries, pivot, targets, tolerance, by_lintol, feed, form) =
            all.new_tree(&mut runner).unwrap().current();
        let (of_machine, lintol) =
            if by_lintol { (5.0, Some(tolerance)) } else { (tolerance, None) };
        let post = post(&rotaries, pivot, of_machine, form);
        let cl = cl(&targets, (feed * 10.0).round() / 10.0, lintol);
        let Some((nc, report)) = checked(&post, &cl, tolerance) else { continue };
        let seen = format!("{:#?}\n{rotaries:?} {pivot:?} {form}\n{cl}\n{nc}", report.findings);
        assert_eq!(report.verdict(), Verdict::Agrees, "{seen}");
        paths += 1;
        let blocks = nc.lines().filter(|line| line.contains(['X', 'Y', 'Z', 'B', 'C'])).count();
        divided += usize::from(blocks > 4 * targets.len());
    }
    println!("{paths} paths agree, {divided} of them divided");
    assert!(paths > sample::of(PATHS) / 3 && divided * 3 > paths, "{divided} of {paths}");
}

/// A path that goes steadily round, so that it comes to the limits of the primary axis:
/// start and step of the turn in degrees, the tilt, and how many points.
fn winding() -> impl Strategy<Value = (f64, f64, f64, usize)> {
    let step = prop_oneof![5.0..40.0f64, -40.0..-5.0f64];
    (-180.0..180.0f64, step, 10.0..60.0f64, 4usize..40)
}

fn winding_cl((start, step, tilt, count): (f64, f64, f64, usize)) -> String {
    let mut cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nMULTAX / ON\n".to_string();
    cl += "FEDRAT / 500, MMPM\nRAPID\n";
    for number in 0..count {
        let (turn, tilt) = ((start + step * number as f64).to_radians(), tilt.to_radians());
        let (i, j, k) = (tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos());
        let (x, y, z) = (40.0 * turn.cos(), 40.0 * turn.sin(), 0.5 * number as f64);
        cl += &format!("GOTO / {x:.9}, {y:.9}, {z:.9}, {i:.12}, {j:.12}, {k:.12}\n");
    }
    cl + "FINI\n"
}

/// Turns the flags of the settings round where the first axis turns far.
const REPOS: &str = "_REPOS=MACRO/FROM1,TO1,RETDST,APPDST,SPNOFF,COLOFF,OPTSTP,NEWAXS,RETFED\n\
    IF(ABSF(TO1-FROM1).LT.300)THEN\nRETDST=RETDST+12.5\nAPPDST=7\nSPNOFF=1-SPNOFF\n\
    COLOFF=1-COLOFF\nOPTSTP=1-OPTSTP\nNEWAXS=1-NEWAXS\nRETFED=333\nENDIF\nTERMAC\nFINI\n";

/// At a limit of the primary axis the tool goes out, the machine turns, and the tool comes
/// back: the back-check agrees, and no axis is ever past its limit. Where nothing leads on,
/// no program is written.
#[test]
fn at_a_limit_the_tool_goes_out_and_comes_back() {
    let mut runner = TestRunner::deterministic();
    let kinds = prop_oneof![Just([1u8, 1]), Just([1, 2]), Just([2, 2])];
    let flags = proptest::array::uniform6(any::<bool>());
    let all = (kinds, -400.0..-100.0f64, 100.0..400.0f64, winding(), flags, 0u8..4);
    let (mut changes, mut refused) = (0, 0);
    for number in 0..sample::of(LIMITED) {
        let (kinds, min, max, path, flags, form) = all.new_tree(&mut runner).unwrap().current();
        let table = |kind, direction| (kind, direction, [3.0, -7.0, -20.0]);
        let rotaries = [table(kinds[0], [0.0, 0.0, 1.0]), table(kinds[1], [0.0, 1.0, 0.0])];
        let plain = post(&rotaries, Some(150.0), 0.05, form);
        let [spindle, coolant, one_block, next_axis, split, stop] = flags.map(u8::from);
        let by_macro = number % 2 == 1;
        let settings = [
            format!("rotary.primary_min={min:.3}"),
            format!("rotary.primary_max={max:.3}"),
            format!("repos.feed_method={}", u8::from(!by_macro)),
            "repos.retract_distance=50".to_string(),
            "repos.approach_distance=5".to_string(),
            format!("repos.retract_spindle={spindle}"),
            format!("repos.approach_spindle={spindle}"),
            format!("repos.retract_coolant={coolant}"),
            format!("repos.approach_coolant={coolant}"),
            format!("repos.retract_opstop={stop}"),
            format!("repos.skip_rotary={one_block}"),
            format!("repos.new_tool_axis={next_axis}"),
            format!("rapid.split={split}"),
        ];
        let builder = Program::builder().commons(plain.commons().clone());
        let machine = settings.iter().fold(builder, |builder, set| builder.set(set));
        let machine = match by_macro {
            true => machine.fil("repos.fil", REPOS),
            false => machine,
        };
        let machine = machine.build().expect("a machine");
        let cl = winding_cl(path).replace("MULTAX", "COOLNT / ON\nMULTAX");
        let Some((nc, report)) = checked(&machine, &cl, 0.05) else {
            refused += 1;
            continue;
        };
        let seen = format!("{:#?}\n{settings:?} {kinds:?} {form}\n{cl}\n{nc}", report.findings);
        assert_eq!(report.verdict(), Verdict::Agrees, "{seen}");
        changes += usize::from(checked(&plain, &cl, 0.05).is_some_and(|(other, _)| other != nc));
    }
    println!("{changes} paths change positions at a limit, {refused} are refused");
    assert!(changes > sample::of(LIMITED) / 8, "{changes}");
}

/// A head that leans and stays so while the table turns holds the tip far from where X, Y and
/// Z say: on the axis of the table, where they hardly move, the tip goes along an arc.
#[test]
fn a_head_that_leans_while_the_table_turns() {
    let rotaries = [(1, [0.0, 0.0, 1.0], [0.0; 3]), (2, [0.0, 1.0, 0.0], [0.0; 3])];
    let post = post(&rotaries, Some(200.0), 0.02, 0);
    let lean = 45f64.to_radians();
    let (out, down) = (200.0 * lean.sin(), 200.0 * (1.0 - lean.cos()));
    let at = |degrees: f64| {
        let turn = degrees.to_radians();
        ([-out * turn.cos(), -out * turn.sin(), down], lean, turn, false)
    };
    let cl = cl(&[at(0.0), at(10.0)], 500.0, None);
    let (nc, report) = checked(&post, &cl, 0.02).expect("a program");
    assert_eq!(report.verdict(), Verdict::Agrees, "{:#?}\n{nc}", report.findings);
    // An arc of 10 degrees with a radius of 141.4 mm is 0.54 mm high; each part may have 0.02.
    let parts = nc.lines().filter(|line| line.contains('C')).count();
    assert!(parts > 5, "{nc}");
}

/// Half circles square to a leaning tool, far from the axes of the machine: there the last
/// digit of an angle is several of X, Y and Z.
#[test]
fn arcs_on_a_long_lever() {
    let kinds: [[u8; 2]; 3] = [[1, 1], [1, 2], [2, 2]];
    for number in 0..30u32 {
        let rotaries = [0, 1].map(|n| {
            let direction = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]][n];
            let kind = kinds[number as usize % 3][n];
            (kind, direction, [300.0 + f64::from(number), -400.0, 250.0])
        });
        let pivot = rotaries.iter().any(|(kind, ..)| *kind == 2).then_some(420.5);
        let post = post(&rotaries, pivot, 0.02, 0);
        let (turn, tilt) = (0.21 * f64::from(number), 0.2 + 0.03 * f64::from(number));
        let (i, j, k) = (tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos());
        // Along the circle's plane, square to the tool.
        let (u, v) = (-5.0 * turn.sin(), 5.0 * turn.cos());
        let axis = format!("{i:.10}, {j:.10}, {k:.10}");
        let cl = format!(
            "UNITS / MM\nMULTAX / ON\nFEDRAT / 500, MMPM\nRAPID\n\
             GOTO / 10, 20, 30, {axis}\n\
             CIRCLE / {:.8}, {:.8}, 30, {axis}, 5\nGOTO / {:.8}, {:.8}, 30, {axis}\nFINI\n",
            10.0 + u,
            20.0 + v,
            10.0 + 2.0 * u,
            20.0 + 2.0 * v
        );
        let (nc, report) = checked(&post, &cl, 0.05).expect("a program");
        assert_eq!(report.verdict(), Verdict::Agrees, "{:#?}\n{cl}{nc}", report.findings);
    }
}

/// Without division the tip leaves its line, which is said.
#[test]
fn an_undivided_motion_is_said() {
    let table = [(1, [0.0, 0.0, 1.0], [0.0; 3]), (1, [0.0, 1.0, 0.0], [0.0; 3])];
    let targets = [([60.0, 0.0, 10.0], 0.1, 0.0, false), ([0.0, 60.0, 10.0], 0.4, 1.5, false)];
    for (tolerance, lintol) in [(0.0, ""), (0.01, "LINTOL / OFF\n")] {
        let post = post(&table, None, tolerance, 0);
        let cl = cl(&targets, 500.0, None).replace("MULTAX", &format!("{lintol}MULTAX"));
        let outcome = post.stream(cl.as_bytes(), &mut Vec::new()).expect("a program");
        let codes: Vec<String> = outcome.warnings.iter().map(|diag| diag.code.name()).collect();
        assert!(codes.contains(&"W0591".to_string()), "{codes:?}");
    }
}

/// Real files of several systems that turn the machine.
const FILES: [&str; 7] = [
    "cl/nx/TORETC_250_BOK.cls",
    "cl/nx/ust_a.cls",
    "cl-more/catia/1_linear_5x_linear_5x_PATH1.aptsource",
    "cl-more/catia/2_circle-cylndr_circle-cylndr_5x_circle-cylndr_5x_PATH1.aptsource",
    "cl-more/catia/1_linear_3x_linear_3x_PATH1.aptsource",
    "cl-more/catia/circle-cylndr-helical_3x_PATH1.aptsource",
    "cl-more/catia/milling_MILLING_PATH1_FRONT.aptsource",
];

fn data() -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data = env::var_os("FILPOST_DATA").map_or(here.join("../../shared/data"), PathBuf::from);
    if data.join("cl").is_dir() {
        return Some(data);
    }
    println!("skipped: no folder {}", data.join("cl").display());
    None
}

/// Real five-axis files post for tables and for heads, and the tip stays on its line.
#[test]
fn real_files_stay_on_their_lines() {
    let Some(data) = data() else { return };
    let machines: [[Rotary; 2]; 3] = [
        [(1, [0.0, 0.0, 1.0], [0.0; 3]), (1, [1.0, 0.0, 0.0], [0.0, 0.0, -50.0])],
        [(1, [0.0, 0.0, 1.0], [20.0, 5.0, 0.0]), (2, [0.0, 1.0, 0.0], [0.0; 3])],
        [(2, [0.0, 0.0, 1.0], [0.0; 3]), (2, [0.0, 1.0, 0.0], [0.0; 3])],
    ];
    let mut turning = 0;
    for name in FILES {
        let cl = fs::read(data.join(name)).expect(name);
        let says = cl.windows(5).any(|word| word == b"UNIT/" || word == b"UNITS");
        for (rotaries, pivot) in machines.iter().zip([None, Some(120.0), Some(250.0)]) {
            let post = post(rotaries, pivot, 0.05, 0);
            let start = || {
                let run = post.start();
                if says { run } else { run.units(Unit::Mm) }
            };
            let mut nc = Vec::new();
            if let Err(error) = start().stream(&cl[..], &mut nc) {
                // Cutter compensation in a plane that this machine does not turn upright.
                assert_eq!(error.diags()[0].code.name(), "E0544", "{name}: {error}");
                continue;
            }
            let program = NcProgram { text: &nc, name: "out.nc" };
            let allowed = Allowed { between: Some(0.05), ..Allowed::default() };
            let (report, _) = start().verify(&cl[..], program, allowed).expect(name);
            assert_eq!(report.verdict(), Verdict::Agrees, "{name}: {:#?}", report.findings);
            if let Some(between) = report.between {
                println!("{name}: {} mm off its line at most", between.position.max);
                turning += 1;
            }
        }
    }
    assert!(turning > 2, "{turning} programs turn the machine at feed");
}
