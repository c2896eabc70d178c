//! Programs with tool-tip control, written from the CL file without the post.

use fil_nc::verify::{Allowed, FindingKind, Report, Verdict};
use filpost::plot::{self, Text};
use filpost::{Diag, Program};
use filpost_tests::back_check;
use filpost_tests::tip_program::{MACHINES, Machine, cases, part};

fn check(post: &Program, cl: &str, nc: &str) -> Result<Report, Box<Diag>> {
    back_check::check(post.commons(), cl, nc, Allowed::default())
}

/// The plain program of the post and the one with tool-tip control move the tool alike.
#[test]
fn both_forms_agree_with_the_cl_file() {
    for case in cases() {
        let cl = String::from_utf8_lossy(&case.cl);
        let report = check(&case.post, &cl, &case.nc).unwrap_or_else(|d| panic!("{d}"));
        let name = &case.name;
        assert_eq!(
            report.verdict(),
            Verdict::Agrees,
            "{name}: {:#?}\n{}",
            report.findings,
            case.nc
        );
        let motions = cl.matches("GOTO").count() as u64;
        assert_eq!((report.compared, report.matched), (motions, motions), "{name}");
        let off = (report.position.max, report.axis.max);
        println!("{name}: tip off by at most {} mm, axis by {} degrees", off.0, off.1);
        // Half of a last digit in X, Y and Z: rounded angles do not move the tip.
        let digit = if cl.contains("INCHES") { 25.4e-4 } else { 1e-3 };
        let most = 0.5 * digit * 3f64.sqrt() + 1e-7;
        assert!(!name.ends_with("tip") || off.0 < most, "{name}: {off:?}");
        // The control keeps the tip on its line; axes that go evenly do not.
        let Some(between) = report.between else { continue };
        let (way, controlled) = (between.position.max, name.ends_with("tip"));
        assert!(if controlled { way < most } else { way > 1.0 }, "{name}: {way}");
    }
}

fn machine(name: &str) -> &'static Machine {
    MACHINES.iter().find(|machine| machine.name == name).expect("a machine")
}

/// One fault in the program for two tables, and what must be said.
#[test]
fn faults_are_said_in_a_machinists_words() {
    let machine = machine("two-tables");
    let nc = machine.tip_program(&part());
    let first = |old: &str, new: &str| {
        assert!(nc.contains(old), "{old}:\n{nc}");
        check(&machine.post(), &part(), &nc.replacen(old, new, 1))
    };
    for (old, new, kind, said) in [
        ("X30.5", "X31.5", FindingKind::Position, "X off by 1 (X31.5 in place of X30.5)"),
        (
            "Z5.855",
            "Z5.854",
            FindingKind::Position,
            "Z deeper by 0.0006 (Z5.854 in place of Z5.8546)",
        ),
        (
            "A24.518",
            "A24.618",
            FindingKind::Axis,
            "the tool is tilted 0.1002 degrees away from its axis",
        ),
        (
            "A24.518",
            "A-24.518",
            FindingKind::Axis,
            "the tool is tilted 49.0358 degrees away from its axis",
        ),
        ("F420.0", "F42.0", FindingKind::Feed, "feed 42 mm/min, it should be 420 mm/min"),
        ("H15", "H5", FindingKind::Tool, "length offset 5 is active, it should be 15"),
        (
            "G43.4 H15",
            "G43 H15",
            FindingKind::Position,
            "X off by 35.4535 (X31.251 in place of X-4.2025), Y off by 34.6006 (Y-14.499 in place of Y20.1016), Z higher by 0.2951 (Z48.75 in place of Z48.4549)",
        ),
        ("G49\nM30", "M30", FindingKind::Tool, "TCPC is active, it should be off"),
        ("M8\n", "M9\n", FindingKind::Coolant, "coolant is off, it should be on by M8"),
    ] {
        let report = first(old, new);
        let report = report.unwrap_or_else(|diag| panic!("{new}: {diag}"));
        let found = report.findings.first().expect(new);
        assert_eq!((found.kind, found.message.as_str()), (kind, said), "{new}");
    }
    for (old, new, code, place) in [
        ("G43.4 H15", "H15", "E0905", (8, 1)),
        ("G43.4 H15", "G43.4", "E0911", (8, 1)),
        ("G0 C0. A0.", "G0 C0.", "E0911", (8, 1)),
        ("G0 C0. A0.", "G0 C0. A1.", "E0905", (8, 1)),
        ("G49\nT6", "T6", "E0905", (21, 1)),
    ] {
        let refused = first(old, new).expect_err(new);
        let at = &refused.spans[0];
        assert_eq!((refused.code.name(), (at.line, at.column())), (code.into(), place), "{new}");
    }
}

/// The start, the tool change and the end in the shop's own words: to points of the
/// machine that stand in the settings, tables to zero, tool-tip control off.
#[test]
fn start_and_tool_change_in_words_of_the_shop() {
    let machine = machine("two-tables");
    let blocks = r#"blocks.start=["G40 G49 G80 G54", "G91 G28 Z0.", "G90 G53 G0 X-400. Y0."]"#;
    let post = machine.builder().set(blocks).build().expect("a machine");
    let start = "G40 G49 G80 G54\nG91 G28 Z0.\nG90 G53 G0 X-400. Y0.\n";
    let change = "G49\nG91 G28 Z0.\nG90 G53 G0 X-400. Y0.\nT6";
    let nc = machine
        .tip_program(&part())
        .replace("T5 M6", &format!("{start}T5 M6"))
        .replace("G49\nT6", change)
        .replace("G49\nM30", "G49 G53 G0 Z0.\nM30");
    let report = check(&post, &part(), &nc).expect("a report");
    let said: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
    let machine_point = "goes to a point of the machine that neither the CL file nor the settings \
                         ask for";
    assert_eq!(said, [format!("NC line 34 (CL line 32): {machine_point}")], "{nc}");
    assert_eq!((report.compared, report.matched), (14, 14));
    let report = check(&post, &part(), &nc.replace("G49 G53 G0 Z0.", "G49")).expect("a report");
    assert_eq!(report.verdict(), Verdict::Agrees, "{:#?}\n{nc}", report.findings);
}

/// Many posts turn the tables first. Then the control must take the part as it lies with
/// the tables at zero, which a setting says.
#[test]
fn tables_that_are_turned_first() {
    let machine = machine("two-tables");
    let turned_first = |nc: &str, offset: &str, point: &str, angles: &str| {
        let old = format!("G0 C0. A0.\nG43.4 {offset}\nG0 {point} {angles}\n");
        assert!(nc.contains(&old), "{nc}");
        nc.replace(&old, &format!("G0 {angles}\nG43.4 {offset} {point}\n"))
    };
    let nc = machine.tip_program(&part());
    let nc = turned_first(&nc, "H15", "X31.251 Y-14.499 Z48.75", "C125.048 A20.123");
    let nc = turned_first(&nc, "H6", "X-18.203 Y4.407 Z57.3", "C-62.619 A17.445");
    let refused = check(&machine.post(), &part(), &nc).expect_err("turned tables");
    assert_eq!((refused.code.name(), refused.spans[0].line), ("E0905".into(), 8), "{nc}");
    let post = machine.builder().set("rotary.tip_control=1").build().expect("a machine");
    let report = check(&post, &part(), &nc).expect("a report");
    assert_eq!(report.verdict(), Verdict::Agrees, "{:#?}\n{nc}", report.findings);
}

/// Under tool-tip control a picture shows straight lines between the points of the CL
/// file; without it the tip leaves them where the machine turns.
#[test]
fn the_picture_shows_the_tip_going_straight() {
    let cl_points: Vec<[f64; 3]> = part()
        .lines()
        .filter_map(|line| line.strip_prefix("GOTO / "))
        .map(|numbers| {
            let mut numbers = numbers.split(", ").map(|n| n.parse::<f64>().expect("a number"));
            std::array::from_fn(|_| numbers.next().expect("a coordinate"))
        })
        .collect();
    for case in cases().iter().filter(|case| case.name.starts_with("five-axes")) {
        let text = Text { name: "out.nc", bytes: case.nc.as_bytes() };
        let path = plot::program(text, case.post.commons()).expect("a picture").path;
        let straight = case.name.ends_with("tip");
        for piece in &path.pieces {
            let points = &path.points[piece.range()];
            let end = points.last().expect("an end");
            let near = |point: &&[f64; 3]| (0..3).all(|n| (point[n] - end[n]).abs() < 3e-3);
            assert!(cl_points.iter().any(|point| near(&point)), "{}: {end:?}", case.name);
            assert!(!straight || points.len() == 2, "{} line {}", case.name, piece.line);
        }
        let bent = path.pieces.iter().filter(|piece| piece.end - piece.start > 2).count();
        assert!(straight || bent > 5, "{}: {bent} motions with a bend", case.name);
    }
}

/// The travel is that of the machine's axes, in whatever form the program is written.
#[test]
fn the_travel_of_the_axes_is_looked_at_in_both_forms() {
    let outside = |form: &str| {
        let case = cases().into_iter().find(|case| case.name == format!("five-axes/{form}"));
        let case = case.expect("a case");
        let limits = ["limits.check=1", "limits.x_max=70", "limits.z_min=0"];
        let builder = limits.iter().fold(machine("table-and-head").builder(), |b, set| b.set(set));
        let post = builder.build().expect("a machine");
        let report = check(&post, &part(), &case.nc).expect("a report");
        let axis = |message: &str| message.chars().next();
        report.findings.iter().map(|f| (f.kind, f.cl_line, axis(&f.message))).collect::<Vec<_>>()
    };
    let found = outside("table-and-head-tip");
    assert!(
        found.len() > 5 && found.iter().all(|(kind, ..)| *kind == FindingKind::Limit),
        "{found:?}"
    );
    assert_eq!(found, outside("table-and-head-axes"));
}
