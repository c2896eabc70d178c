//! The back-check on machines with two rotary axes of every arrangement: a posted
//! path agrees to the last digit, and a last digit that is changed is found.

use fil_machine::axis_chain::AxisChain;
use fil_nc::forward::Forward;
use fil_nc::motion::{Event, Move};
use fil_nc::verify::{Allowed, FindingKind, Report, Verdict};
use filpost::{Commons, Program};
use filpost_tests::{back_check, sample};
use nalgebra::Point3;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// A rotary axis: 1 a table, 2 a head; its direction and a point on it.
#[derive(Clone, Copy, Debug)]
struct Rotary {
    kind: u8,
    direction: [f64; 3],
    center: [f64; 3],
}

/// A target: point, tilt and turn of the tool axis in radians, rapid.
type Target = ([f64; 3], f64, f64, bool);

fn rotaries() -> impl Strategy<Value = [Rotary; 2]> {
    let kinds = prop_oneof![Just([1, 1]), Just([1, 2]), Just([2, 2])];
    let directions = prop_oneof![
        Just([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
        Just([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]),
        Just([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        Just([[0.0, 0.0, 1.0], [0.0, -1.0, 1.0]]),
    ];
    let centers = proptest::array::uniform2(proptest::array::uniform3(-150.0..150.0f64));
    (kinds, directions, centers).prop_map(|(kinds, directions, centers)| {
        [0, 1].map(|n| Rotary { kind: kinds[n], direction: directions[n], center: centers[n] })
    })
}

fn target() -> impl Strategy<Value = Target> {
    (
        proptest::array::uniform3(-120.0..120.0f64),
        // A lean below 1e-5 leaves open which way a post turns the machine.
        prop_oneof![Just(0.0), 3e-5..1e-4f64, 0.01..0.7f64],
        -3.0..3.0f64,
        any::<bool>(),
    )
}

fn targets() -> impl Strategy<Value = Vec<Target>> {
    proptest::collection::vec(target(), 1..12)
}

fn post(rotaries: &[Rotary; 2], pivot: Option<f64>, split: bool) -> Program {
    let mut builder = Program::builder().generic("fanuc-mill");
    let mut set = |key: &str, value: f64| {
        let builder_now = std::mem::replace(&mut builder, Program::builder());
        builder = builder_now.set(&format!("{key}={value}"));
    };
    // Programs made by hand end tool-tip control where the tool stands.
    set("rotary.tip_end_retract", 0.0);
    // The lines are divided by hand, so the tool may lean out of the plane of its ends.
    set("rotary.axis_tolerance", 0.0);
    let names = ["primary", "secondary"];
    for ((rotary, name), letter) in rotaries.iter().zip(names).zip([3.0, 2.0]) {
        set(&format!("rotary.{name}_kind"), rotary.kind.into());
        set(&format!("rotary.{name}_axis"), letter);
        for (n, part) in ["i", "j", "k"].into_iter().enumerate() {
            set(&format!("rotary.{name}_{part}"), rotary.direction[n]);
        }
        for (n, part) in ["x", "y", "z"].into_iter().enumerate() {
            set(&format!("rotary.{name}_{part}"), rotary.center[n]);
        }
    }
    if let Some(pivot) = pivot {
        set("rotary.pivot_distance", pivot);
    }
    set("rapid.split", f64::from(u8::from(split)));
    // One block for each motion, which the tests divide themselves.
    set("rotary.tolerance", 0.0);
    set("rotary.feed", 1.0);
    builder.build().expect("a machine")
}

fn cl(targets: &[Target]) -> String {
    let mut cl = "UNITS / MM\nMULTAX / ON\nFEDRAT / 500., MMPM\n".to_string();
    for (point, tilt, turn, rapid) in targets {
        let [x, y, z] = point;
        let (i, j, k) = (tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos());
        let rapid = if *rapid { "RAPID\n" } else { "" };
        cl += &format!("{rapid}GOTO / {x:.10}, {y:.10}, {z:.10}, {i:.10}, {j:.10}, {k:.10}\n");
    }
    cl + "FINI\n"
}

fn check(commons: &Commons, cl: &str, nc: &str) -> Option<Report> {
    check_allowed(commons, cl, nc, Allowed::default())
}

fn check_allowed(commons: &Commons, cl: &str, nc: &str, allowed: Allowed) -> Option<Report> {
    back_check::check(commons, cl, nc, allowed).ok()
}

/// The program with the last digit of an axis word one up.
fn one_up(nc: &str, letters: &[char], which: usize) -> Option<String> {
    let digits: Vec<usize> = nc
        .match_indices(char::is_numeric)
        .map(|(at, _)| at)
        .filter(|at| !nc[at + 1..].starts_with(char::is_numeric))
        .filter(|at| {
            let word = nc[..*at].rfind(|c: char| c.is_ascii_alphabetic()).map(|at| &nc[at..]);
            let decimals = nc[..*at].rfind('.').is_some_and(|point| at - point == 3);
            decimals && word.is_some_and(|word| word.starts_with(letters))
        })
        .collect();
    let at = *digits.get(which % digits.len().max(1))?;
    let digit = nc.as_bytes()[at] - b'0';
    let mut changed = nc.to_string();
    changed.replace_range(at..=at, &((digit + 1) % 10).to_string());
    Some(changed)
}

/// The changed block is a rapid that another one goes on from, as out of a cut: where it stops no
/// last digit is asked for.
fn is_a_stop(nc: &str, changed: &str) -> bool {
    let mut rapid = false;
    let rapids: Vec<bool> = nc
        .lines()
        .map(|line| {
            let has = |code: &str| line.split(' ').any(|word| word == code);
            rapid = has("G0") || rapid && !has("G1");
            rapid && line.contains(['X', 'Y', 'Z', 'B', 'C'])
        })
        .collect();
    let at = nc.lines().zip(changed.lines()).position(|(one, other)| one != other);
    at.is_some_and(|at| rapids[at] && rapids.get(at + 1) == Some(&true))
}

/// The program with tool-tip control: the angles of the plain one, which has a block for
/// each target, and the tips of the CL file. The tables begin at 0.
fn with_tip_control(rotaries: &[Rotary; 2], targets: &[Target], plain: &str) -> Option<String> {
    let blocks: Vec<&str> =
        plain.lines().filter(|line| line.contains(['X', 'Y', 'Z', 'B', 'C'])).collect();
    if blocks.len() != targets.len() {
        return None;
    }
    let letters = ['C', 'B'];
    let tables = (0..2).filter(|n| rotaries[*n].kind == 1).map(|n| format!(" {}0.", letters[n]));
    let mut nc = format!("G21 G90 G94 G17\nG0{}\nG43.4 H1\n", tables.collect::<String>());
    for (block, (point, _, _, rapid)) in blocks.iter().zip(targets) {
        let words = block.split(' ').filter(|word| word.starts_with(letters));
        let angles: String = words.map(|word| format!(" {word}")).collect();
        let g = if *rapid { "G0" } else { "G1 F500." };
        let [x, y, z] = point.map(|value| (value * 1000.0).round() / 1000.0);
        nc += &format!("{g} X{x:?} Y{y:?} Z{z:?}{angles}\n");
    }
    Some(nc + "G49\nM30\n")
}

/// Paths posted for random machines in the whole run.
const PATHS: usize = 2_000;

/// Programs of which a last digit was changed, and those of them that were reported.
#[derive(Default)]
struct Faults {
    put: usize,
    found: usize,
    /// Rapids of the programs may stop on their way.
    has_stops: bool,
}

impl Faults {
    fn put_into(&mut self, commons: &Commons, targets: &[Target], nc: &str, which: usize) {
        // Along the primary axis its own position makes no difference to the tool.
        let upright = targets.iter().any(|(_, tilt, ..)| *tilt == 0.0);
        let letters = ['X', 'Y', 'Z', 'B', 'C'];
        let letters = if upright { &letters[..3] } else { &letters };
        let Some(changed) = one_up(nc, letters, which) else { return };
        if self.has_stops && is_a_stop(nc, &changed) {
            return;
        }
        let report = check(commons, &cl(targets), &changed);
        self.put += 1;
        self.found += usize::from(report.is_none_or(|it| it.verdict() == Verdict::Differs));
    }

    fn are_found(&self) {
        let Faults { put, found, .. } = self;
        println!("{found} of {put} changed last digits found");
        // An axis that rests may stand at its exact position or at its rounded one, so that
        // either of two last digits is right.
        let most_missed = 1 + put * 6 / 1000;
        assert!(*put > sample::of(PATHS) / 2 && put - found <= most_missed, "{found} of {put}");
    }
}

#[test]
fn posted_paths_agree_and_a_changed_last_digit_is_found() {
    let mut runner = TestRunner::deterministic();
    let pivots = proptest::option::of(80.0..300.0f64);
    let all = (rotaries(), pivots, any::<bool>(), targets(), any::<usize>());
    let mut faults = Faults { has_stops: true, ..Faults::default() };
    for _ in 0..sample::of(PATHS) {
        let (rotaries, pivot, split, targets, which) = all.new_tree(&mut runner).unwrap().current();
        // Where a rapid of a leaning tool stops on its way no last digit is asked for.
        let leans = rotaries.iter().any(|rotary| rotary.kind == 2);
        let post = post(&rotaries, pivot, split && !leans);
        let cl = cl(&targets);
        let mut nc = Vec::new();
        if post.stream(cl.as_bytes(), &mut nc).is_err() {
            // The machine can't reach the axis.
            continue;
        }
        let nc = String::from_utf8(nc).unwrap();
        let report = check(post.commons(), &cl, &nc).unwrap();
        assert_eq!(report.verdict(), Verdict::Agrees, "{:#?}\n{cl}\n{nc}", report.findings);
        faults.put_into(post.commons(), &targets, &nc, which);
    }
    faults.are_found();
}

/// A line with points between its ends, and the two programs that make it.
struct Divided {
    /// The points between.
    with_points: String,
    /// The middle one left out.
    without_one: String,
    ends: [Point3<f64>; 2],
}

/// Points between the ends of a divided line.
const POINTS: usize = 3;

/// Divides the last line of a program as another post would: the tip on the line, even
/// shares of the rotary axes, or of the turn of the tool in its plane, everything rounded.
fn divided(post: &Program, targets: &[Target], nc: &str, in_plane: bool) -> Option<Divided> {
    let machine = AxisChain::from_commons(post.commons()).ok()?;
    let moves = moves(post.commons(), nc);
    let (to, from) = (moves.last()?, moves.get(moves.len().checked_sub(2)?)?);
    let [.., (start, ..), (end, ..)] = targets else { return None };
    let ends = [Point3::from(*start), Point3::from(*end)];
    let forward = Forward::from_commons(post.commons()).ok()?;
    let axes = [from, to].map(|end| forward.axis(end.to.rotary));
    let mut last = from.to.rotary;
    let mut block = |share: f64| {
        let even = [0, 1].map(|n| {
            let (from, to) = (from.to.rotary[n], to.to.rotary[n]);
            from + (to - from) * share
        });
        let rotary = if in_plane && share < 1.0 {
            machine.solve(axes[0].slerp(&axes[1], share), last).ok()?
        } else {
            even
        };
        last = rotary;
        let on_the_way = machine.linear(ends[0] + (ends[1] - ends[0]) * share, rotary).coords;
        let [x, y, z] = if share == 1.0 { to.to.linear } else { on_the_way.into() };
        Some(format!("G1 X{x:.3} Y{y:.3} Z{z:.3} C{:.3} B{:.3} F500.", rotary[0], rotary[1]))
    };
    let lines: Vec<&str> = nc.lines().collect();
    let (before, after) = (&lines[..to.line as usize - 1], &lines[to.line as usize..]);
    let shares = (1..=POINTS + 1).map(|n| n as f64 / (POINTS + 1) as f64);
    let blocks: Vec<String> = shares.map(&mut block).collect::<Option<_>>()?;
    let program =
        |blocks: &[String]| [before.join("\n"), blocks.join("\n"), after.join("\n")].join("\n");
    let with_points = program(&blocks);
    let mut fewer = blocks;
    fewer.remove(POINTS / 2);
    Some(Divided { with_points, without_one: program(&fewer), ends })
}

fn moves(commons: &Commons, nc: &str) -> Vec<Move> {
    let events = back_check::events(commons, nc).expect("a program");
    let moves = events.iter().filter_map(|event| match event {
        Event::Move(found) => Some(*found),
        _ => None,
    });
    moves.collect()
}

/// How far the tip leaves the line in those of the last blocks that turn the machine,
/// by many samples.
fn sampled(commons: &Commons, nc: &str, blocks: usize, [a, b]: [Point3<f64>; 2]) -> f64 {
    const SAMPLES: u32 = 2_000;
    let forward = Forward::from_commons(commons).expect("a machine");
    let moves = moves(commons, nc);
    let pairs = moves[moves.len() - blocks - 1..].windows(2);
    let pairs = pairs.filter(|pair| pair[0].to.rotary != pair[1].to.rotary);
    let tips = pairs.flat_map(|pair| {
        let forward = &forward;
        let (from, to) = (pair[0].to, pair[1].to);
        (0..=SAMPLES).map(move |n| {
            let share = f64::from(n) / f64::from(SAMPLES);
            forward.pose(&forward.along(&from, &to, None, share)).tip
        })
    });
    let way = b - a;
    let off = tips.map(|tip| {
        let along = (way.dot(&(tip - a)) / way.norm_squared()).clamp(0.0, 1.0);
        (a + way * along - tip).norm()
    });
    off.fold(0.0, f64::max)
}

/// Lines divided by another post agree on every machine; how far the tip leaves them is
/// what samples say, and a point left out is found when it makes that too much.
#[test]
fn divided_lines_agree_and_a_point_left_out_is_found() {
    let mut runner = TestRunner::deterministic();
    let pivots = proptest::option::of(80.0..300.0f64);
    let all = (rotaries(), pivots, proptest::collection::vec(target(), 2), any::<bool>());
    let (mut lines, mut worse) = (0, 0);
    for _ in 0..sample::of(PATHS / 4) {
        let (rotaries, pivot, mut targets, in_plane) = all.new_tree(&mut runner).unwrap().current();
        (targets[0].3, targets[1].3) = (true, false);
        let post = &mut post(&rotaries, pivot, false);
        let cl = cl(&targets);
        let mut nc = Vec::new();
        if post.stream(cl.as_bytes(), &mut nc).is_err() {
            continue;
        }
        let nc = String::from_utf8(nc).unwrap();
        let Some(divided) = divided(post, &targets, &nc, in_plane) else { continue };
        let commons = post.commons();
        let report = check(commons, &cl, &divided.with_points).unwrap();
        let seen = format!(
            "{:#?}\n{rotaries:?} {pivot:?}\n{cl}\n{nc}{}",
            report.findings, divided.with_points
        );
        assert_eq!(report.verdict(), Verdict::Agrees, "{seen}");
        // A tool that does not turn makes no such motion.
        let Some(between) = report.between else { continue };
        let max = between.position.max;
        let dense = sampled(commons, &divided.with_points, POINTS + 1, divided.ends);
        assert!((max - dense).abs() < 1e-4, "{max} {dense}\n{seen}");
        let dense = sampled(commons, &divided.without_one, POINTS, divided.ends);
        let limit = max * 1.2;
        let allowed = Allowed { between: Some(limit), ..Allowed::default() };
        let report = check_allowed(commons, &cl, &divided.without_one, allowed).unwrap();
        let found = report.findings.iter().any(|finding| finding.kind == FindingKind::Between);
        assert_eq!(found, dense > limit, "{dense} {limit}\n{seen}");
        lines += 1;
        worse += usize::from(found);
    }
    println!("{lines} divided lines agree; without a point {worse} are off by more");
    assert!(lines > sample::of(PATHS) / 8 && worse * 3 > lines, "{worse} of {lines}");
}

#[test]
fn paths_with_tool_tip_control_agree_and_a_changed_last_digit_is_found() {
    let mut runner = TestRunner::deterministic();
    let all = (rotaries(), proptest::option::of(80.0..300.0f64), targets(), any::<usize>());
    let mut faults = Faults::default();
    for _ in 0..sample::of(PATHS) {
        let (rotaries, pivot, targets, which) = all.new_tree(&mut runner).unwrap().current();
        let post = post(&rotaries, pivot, false);
        let cl = cl(&targets);
        let mut plain = Vec::new();
        if post.stream(cl.as_bytes(), &mut plain).is_err() {
            continue;
        }
        let plain = String::from_utf8(plain).unwrap();
        let Some(nc) = with_tip_control(&rotaries, &targets, &plain) else { continue };
        let report = check(post.commons(), &cl, &nc).unwrap_or_else(|| panic!("{cl}\n{nc}"));
        assert_eq!(report.verdict(), Verdict::Agrees, "{:#?}\n{cl}\n{nc}", report.findings);
        faults.put_into(post.commons(), &targets, &nc, which);
    }
    faults.are_found();
}

/// Tip and tool go along a divided line in step: found are last digits of a point on it, and one
/// that is moved along the line by little.
#[test]
fn a_point_of_a_divided_line_out_of_step_is_found() {
    let cl = "LOADTL / 1; SPINDL / RPM, 3000, CLW; MULTAX / ON; RAPID; GOTO / 10, 5, 50, 0, 0, 1; \
              FEDRAT / 100, MMPM; GOTO / 10, 5, 0, 0, 0, 1; LINTOL / 0.05; \
              GOTO / 30, 15, 0, 0, -0.2588190451, 0.9659258263";
    let nc = "%\nO0001 (T)\nG21 G90 G94 G17\nT1 M6\nS3000 M3\nG0 X10. Y5.\nA0. C0.\nG43 Z50. H1\n\
              G1 Z0. F100.\nG93 X14. Y9.607 Z-0.435 A3. F22.361\nX18. Y14.177 Z-1.215 A6. F22.36\n\
              X22. Y18.686 Z-2.336 A9. F22.361\nX26. Y23.112 Z-3.795 A12. F22.359\n\
              X30. Y27.43 Z-5.586 A15. F22.361\nG94\nM30\n%\n";
    let found = |nc: &str| back_check::found("haas-trunnion", &[], cl, nc);
    assert_eq!(found(nc), "");
    // The same line, in step: uneven parts.
    let whole = "X18. Y14.177 Z-1.215 A6. F22.36\n";
    assert!(!found(&nc.replace(whole, "")).contains("from its position"));
    for (old, new, said) in [
        ("X22.", "X22.001", "during the move the tip is"),
        ("A9.", "A9.002", "during the move the tip is"),
        ("A9.", "A8.998", "during the move the tip is"),
        ("Z-2.336", "Z-2.337", "during the move the tip is"),
        // On the line in every digit, and turned by too little for it.
        ("X22. Y18.686 Z-2.336 A9.", "X22.008 Y18.69 Z-2.337 A9.", "from its position"),
    ] {
        assert!(nc.contains(old), "{old}");
        let found = found(&nc.replacen(old, new, 1));
        assert!(found.contains(said), "{new}: {found}");
    }
}
