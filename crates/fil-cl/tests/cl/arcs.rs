//! Random arcs and helices, written as each CAM system writes them and read back.
//!
//! `FILPOST_ARCS=20000` makes that many of each form.

use std::f64::consts::{PI, TAU};

use fil_cl::{Options, Reader, Record, Vocabulary, Word, words};
use proptest::prelude::*;

type Vector = [f64; 3];

/// An arc: from `start` about `axis`, by the right-hand rule, through `sweep` radians.
#[derive(Clone, Copy, Debug)]
struct Arc {
    center: Vector,
    axis: Vector,
    /// A unit vector from the center to the start.
    out: Vector,
    radius: f64,
    sweep: f64,
    /// Height of the end above the start along the axis.
    rise: f64,
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|at| a[at] * b[at]).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn add(a: Vector, b: Vector, by: f64) -> Vector {
    std::array::from_fn(|at| a[at] + b[at] * by)
}

fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn unit(a: Vector) -> Vector {
    a.map(|part| part / norm(a))
}

impl Arc {
    fn at(&self, angle: f64) -> Vector {
        let across = cross(self.axis, self.out);
        let round = add(self.out.map(|part| part * libm::cos(angle)), across, libm::sin(angle));
        let up = add(self.center, self.axis, self.rise * angle / self.sweep);
        add(up, round, self.radius)
    }

    fn start(&self) -> Vector {
        self.at(0.0)
    }

    fn end(&self) -> Vector {
        self.at(self.sweep)
    }

    /// The direction in which it departs, in its plane.
    fn departure(&self) -> Vector {
        cross(self.axis, self.out)
    }

    /// Full turns besides the way from start to end, which is above 0 and at most one turn.
    fn turns(&self) -> f64 {
        (self.sweep / TAU - 1e-9).floor()
    }

    /// Distance in the plane between the end and the start, or the point opposite of it.
    fn chords(&self) -> [f64; 2] {
        let half = self.sweep / 2.0;
        [libm::sin(half), libm::cos(half)].map(|part| 2.0 * self.radius * part.abs())
    }
}

/// How an axis may lie.
#[derive(Clone, Copy, PartialEq)]
enum Axes {
    /// Z, upwards.
    Up,
    /// Along X, Y or Z, either way.
    Principal,
    /// Anyhow.
    Any,
}

prop_compose! {
    /// Arcs from tiny to huge, from nearly nothing to nearly a turn, halves and whole turns.
    fn arcs(axes: Axes, most_turns: u32, rises: bool)(
        which in 0..3usize,
        up in any::<bool>(),
        tilt in [-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64]
            .prop_filter("a direction", |tilt| norm(*tilt) > 0.1),
        tilted in prop::bool::weighted(0.4),
        begin in prop_oneof![(0..8u32).prop_map(|eighth| f64::from(eighth) * PI / 4.0), 0.0..TAU],
        part in prop_oneof![
            5 => 0.02..0.98f64,
            1 => 0.0005..0.02f64,
            1 => 0.98..0.9995f64,
            1 => Just(0.5),
            1 => Just(0.25),
            1 => Just(1.0),
        ],
        turns in 0..=most_turns,
        size in -1.0..3.5f64,
        rise in prop_oneof![Just(0.0), -1.0..1.0f64],
        center in [-500.0..500.0f64, -500.0..500.0f64, -50.0..50.0f64],
    ) -> Arc {
        let mut axis = [0.0; 3];
        axis[which] = if up { 1.0 } else { -1.0 };
        let axis = match axes {
            Axes::Up => [0.0, 0.0, 1.0],
            Axes::Any if tilted => unit(tilt),
            _ => axis,
        };
        let least = (0..3).min_by(|a, b| axis[*a].abs().total_cmp(&axis[*b].abs())).unwrap();
        let mut other = [0.0; 3];
        other[least] = 1.0;
        let first = unit(cross(axis, other));
        let second = cross(axis, first);
        let out = add(first.map(|part| part * libm::cos(begin)), second, libm::sin(begin));
        let radius = libm::exp10(size);
        let rise = if rises { rise * radius } else { 0.0 };
        Arc { center, axis, out, radius, sweep: TAU * (part + f64::from(turns)), rise }
    }
}

/// Numbers as a system writes them.
fn list(values: &[f64], decimals: usize) -> String {
    let text: Vec<String> = values.iter().map(|value| format!("{value:.decimals$}")).collect();
    text.join(",")
}

/// What was read: the CIRCLE and the two points beside it.
#[derive(Debug)]
struct Found {
    circle: fil_cl::Circle,
    turns: f64,
    start: Vector,
    end: Vector,
}

fn read(text: &str) -> Result<Found, String> {
    let mut reader = Reader::new(text.as_bytes(), "a", Options::default());
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let (mut circle, mut points) = (None, Vec::new());
    while reader.read(&mut vocab, &mut record).map_err(|diag| diag.to_string())? {
        if let Some(found) = record.circle() {
            let times = record.data.iter().position(|word| *word == Word::Minor(words::TIMES));
            let turns = times.map_or(0.0, |at| match record.data[at + 1] {
                Word::Number(turns) => turns,
                _ => f64::NAN,
            });
            assert_eq!(points.len(), 1, "the start before the arc");
            circle = Some((found, turns));
        } else if let Some(point) = record.point() {
            points.push(point);
        }
    }
    let (circle, turns) = circle.ok_or("no CIRCLE")?;
    let [start, end] = points[..] else { return Err(format!("{} points", points.len())) };
    Ok(Found { circle, turns, start, end })
}

/// The arc that is read back is the one that was written, within what `decimals` can hold.
fn check(arc: &Arc, text: &str, decimals: usize) -> Result<(), TestCaseError> {
    let found = read(text).map_err(|diag| TestCaseError::fail(format!("{diag}\n{text}")))?;
    let last = libm::exp10(-(decimals as f64));
    prop_assert!(norm(add(found.start, arc.start(), -1.0)) < 2.0 * last, "start\n{}", text);
    // The end lies in the plane across the axis, which has seven decimals.
    let slack = 3.0 * last + 2e-7 * arc.radius;
    prop_assert!(norm(add(found.end, arc.end(), -1.0)) < slack, "end {:?}\n{}", found, text);
    let axis = unit(found.circle.axis);
    prop_assert!(norm(add(axis, arc.axis, -1.0)) < 1e-3, "axis {:?}\n{}", axis, text);
    let off = add(found.circle.center, arc.center, -1.0);
    let across = add(off, arc.axis, -dot(off, arc.axis));
    prop_assert!(norm(across) < 2.0 * last + 1e-6 * arc.radius, "center\n{}", text);
    if let Some(radius) = found.circle.radius {
        // Where it is left out, it is the distance of two rounded points.
        prop_assert!((radius - arc.radius).abs() < 2.0 * last, "radius {}\n{}", radius, text);
    }
    // The sweep as the post works it out: whole turns are those whose ends agree.
    let [from, to] = [found.start, found.end].map(|point| {
        let out = add(point, found.circle.center, -1.0);
        add(out, axis, -dot(out, axis))
    });
    let turn = libm::atan2(dot(axis, cross(from, to)), dot(from, to)).rem_euclid(TAU);
    let rest = arc.sweep - TAU * arc.turns();
    let slack = 8.0 * last / arc.radius + 2e-5;
    let off = (turn - rest).rem_euclid(TAU);
    prop_assert!(off.min(TAU - off) < slack, "sweep {} not {}\n{}", turn, rest, text);
    // A whole turn is written as TIMES or as an end at the start.
    let written = found.turns;
    let is_whole = (rest - TAU).abs() < slack || rest < slack;
    let expected = arc.turns();
    prop_assert!(
        written == expected || is_whole && written == expected + 1.0,
        "{} turns, not {}\n{}",
        written,
        expected,
        text
    );
    Ok(())
}

/// Start and end are clear of each other, or the same.
fn is_clear(arc: &Arc, least: f64) -> bool {
    arc.chords().iter().all(|chord| *chord > least || *chord < 1e-9)
}

fn circle(arc: &Arc, axis: Vector, decimals: usize) -> String {
    format!("CIRCLE/{},{}", list(&arc.center, decimals), list(&axis, 7))
}

fn goto(point: Vector, decimals: usize) -> String {
    format!("GOTO/{}\n", list(&point, decimals))
}

/// `arc` between the points that come before and after it.
fn between(sign: &str, arc: &Arc, statement: &str, decimals: usize) -> String {
    let [start, end] = [arc.start(), arc.end()].map(|point| goto(point, decimals));
    format!("{sign}{start}{statement}\n{end}")
}

const NX: &str = "TOOL PATH/A,TOOL,B\n";
const FFCAM: &str = "PPRINT/APTCL-SPEC,MAKINO-FF,1\n";
const SOLIDWORKS: &str = "TRNTYP/WORLD,0,0,0\n";
const CAMWORKS: &str = "BOX/0,0,0,1,1,1\n";
const CATIA: &str = "$$*CATIA0\n";
const CREO: &str = "$$*          Pro/CLfile  Version 8.0\n";

fn with_times(statement: &str, turns: f64) -> String {
    let times = if turns > 0.0 { format!(",TIMES,{turns}") } else { String::new() };
    format!("{statement}{times}")
}

/// An arc as TLON writes it: the direction of departure, the circle, and the line from the
/// center to the end, whose second intersection ends an arc above half a turn.
fn by_geometry(sign: &str, arc: &Arc, is_cylinder: bool) -> String {
    let decimals = 5;
    let (center, end) = (arc.center, arc.end());
    let line: Vec<f64> = center.into_iter().chain(end).collect();
    let count = match arc.sweep {
        sweep if sweep < PI - 1e-9 => String::new(),
        sweep if sweep > TAU - 1e-9 => ",3,INTOF".to_string(),
        _ => ",2,INTOF".to_string(),
    };
    let along = arc.axis.map(f64::abs);
    let (round, stop) = if is_cylinder {
        let plane = format!(
            "PLANE/(POINT/{}),PERPTO,(VECTOR/{})",
            list(&center, decimals),
            list(&arc.axis, 6)
        );
        let axis = if dot(arc.axis, along) > 0.0 { arc.axis } else { arc.axis.map(|part| -part) };
        (
            format!("CYLNDR/{},$\n{},{:.5}", list(&center, decimals), list(&axis, 7), arc.radius),
            format!(
                "PLANE/PERPTO,({plane}),$\n(POINT/{}),(POINT/{})",
                list(&center, decimals),
                list(&end, decimals)
            ),
        )
    } else {
        (
            format!("CIRCLE/{},$\n{:.5}", list(&center, decimals), arc.radius),
            format!("LINE/{}", list(&line, decimals)),
        )
    };
    format!(
        "{sign}{}INDIRV/{}\nTLON,GOFWD/({round}),ON{count},$\n({stop})\n",
        goto(arc.start(), decimals),
        list(&arc.departure(), 5)
    )
}

fn helical(arc: &Arc) -> String {
    let rounds = arc.sweep / TAU;
    let mut axis = arc.axis;
    // CATIA's axis does not tell the sense.
    if axis.iter().sum::<f64>() < 0.0 {
        axis = axis.map(|part| -part);
    }
    format!(
        "{CATIA}{}HELICAL/CENTER,{},INDIRV,{},AXIS,{},PITCH,{:.6},RADIUS,{:.5},ANGLE,{:.6},\
         HEIGHT,{:.5},ROUND,{:.6},END,{}\n",
        goto(arc.start(), 5),
        list(&arc.center, 5),
        list(&arc.departure(), 5),
        list(&axis, 6),
        arc.rise.abs() / rounds,
        arc.radius,
        arc.sweep.to_degrees(),
        arc.rise.abs(),
        rounds,
        list(&arc.end(), 5)
    )
}

fn cases() -> ProptestConfig {
    let cases = std::env::var("FILPOST_ARCS").ok().and_then(|count| count.parse().ok());
    ProptestConfig {
        cases: cases.unwrap_or(300),
        max_global_rejects: 1_000_000,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn creo_with_an_axis(arc in arcs(Axes::Any, 0, true)) {
        let statement = format!("{},{:.10}", circle(&arc, arc.axis, 10), arc.radius);
        check(&arc, &between(CREO, &arc, &statement, 10), 10)?;
    }

    #[test]
    fn creo_without_an_axis(arc in arcs(Axes::Up, 0, true)) {
        let statement = format!("CIRCLE/{},{:.10}", list(&arc.center, 10), arc.radius);
        check(&arc, &between(CREO, &arc, &statement, 10), 10)?;
    }

    #[test]
    fn generic_files(arc in arcs(Axes::Any, 0, true)) {
        let statement = format!("{},{:.6}", circle(&arc, arc.axis, 6), arc.radius);
        check(&arc, &between("UNITS/MM\n", &arc, &statement, 6), 6)?;
    }

    /// NX and FFCAM turn the axis round, and write TIMES for full turns.
    #[test]
    fn nx_and_ffcam(arc in arcs(Axes::Any, 5, true), is_nx in any::<bool>()) {
        let turned = arc.axis.map(|part| -part);
        let statement =
            format!("{},{:.4},0.0600,0.5000,10.0000,1.0000", circle(&arc, turned, 4), arc.radius);
        let statement = with_times(&statement, arc.turns());
        let sign = if is_nx { NX } else { FFCAM };
        check(&arc, &between(sign, &arc, &statement, 4), 4)?;
    }

    #[test]
    fn solidworks_cam(arc in arcs(Axes::Principal, 0, true)) {
        let statement = circle(&arc, arc.axis, 4);
        check(&arc, &between(SOLIDWORKS, &arc, &statement, 4), 4)?;
    }

    /// CAMWorks: the axis is the same for both senses.
    #[test]
    fn camworks(arc in arcs(Axes::Principal, 0, true)) {
        let is_back = arc.axis.iter().sum::<f64>() < 0.0;
        let word = if is_back { "CLOCKWISE" } else { "COUNTERCLOCKWISE" };
        let statement =
            format!("{},{:.6},{word} ", circle(&arc, arc.axis.map(f64::abs), 6), arc.radius);
        check(&arc, &between(CAMWORKS, &arc, &statement, 6), 6)?;
    }

    /// CATIA, and Creo with CIRC_INTERPOLATION APT_FORMAT.
    #[test]
    fn by_geometry_in_a_plane_of_the_part(
        arc in arcs(Axes::Principal, 0, false).prop_filter("clear ends", |arc| is_clear(arc, 5e-3)),
        sign in prop::sample::select(&[CATIA, CREO, "UNITS/MM\n"][..]),
    ) {
        check(&arc, &by_geometry(sign, &arc, false), 5)?;
    }

    #[test]
    fn by_geometry_on_a_cylinder(
        arc in arcs(Axes::Any, 0, false).prop_filter("clear ends", |arc| is_clear(arc, 5e-3)),
    ) {
        check(&arc, &by_geometry(CATIA, &arc, true), 5)?;
    }

    #[test]
    fn helices_of_catia(
        arc in arcs(Axes::Principal, 6, true).prop_filter("clear ends", |arc| is_clear(arc, 5e-3)),
    ) {
        check(&arc, &helical(&arc), 5)?;
    }

    /// NCL has no arcs, so those of others are refused.
    #[test]
    fn ncl_has_none(arc in arcs(Axes::Any, 0, false)) {
        let statement = format!("{},{:.4}", circle(&arc, arc.axis, 4), arc.radius);
        let text = between("REMARK a.as NCLCAM 2020\n", &arc, &statement, 4);
        prop_assert!(read(&text).unwrap_err().contains("E0417"));
    }

    /// An arc whose statement is of another system than its file is refused, or is the same
    /// arc; read by the opposite rule it is none of the forms.
    #[test]
    fn forms_of_other_systems(
        arc in arcs(Axes::Principal, 0, false).prop_filter("clear ends", |arc| is_clear(arc, 5e-3)),
        form in 0..5usize,
        sign in prop::sample::select(&[CREO, NX, FFCAM, SOLIDWORKS, CAMWORKS, CATIA, "UNITS/MM\n"][..]),
    ) {
        let turned = arc.axis.map(|part| -part);
        let word = if arc.axis.iter().sum::<f64>() < 0.0 { "CLOCKWISE" } else { "COUNTERCLOCKWISE" };
        let statement = match form {
            0 => format!("{},{:.6}", circle(&arc, arc.axis, 6), arc.radius),
            1 => format!("{},{:.6},0.06,0.5,10.0,1.0", circle(&arc, turned, 6), arc.radius),
            2 => circle(&arc, arc.axis, 6),
            3 => format!("{},{:.6},{word}", circle(&arc, arc.axis.map(f64::abs), 6), arc.radius),
            _ => String::new(),
        };
        let text = match form {
            4 => by_geometry(sign, &arc, false),
            _ => between(sign, &arc, &statement, 6),
        };
        if read(&text).is_ok() {
            check(&arc, &text, 5)?;
        }
    }
}

/// MOVARC of ISO 4343 tells the sweep; the GOTO to the end must say the same.
#[test]
fn movarc_is_a_circle_that_ends_where_it_says() {
    let read = |center: &str, degrees: &str, end: &str| {
        let text = format!(
            "RAPID\nGOTO/0.0,0.0,-1.0\nMOVARC/{center}, ANGLE, {degrees}\nGOTO/{end}\nGOTO/9,9,9\nFINI\n"
        );
        let mut reader = Reader::new(text.as_bytes(), "t", Options::default());
        let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
        let mut records = Vec::new();
        loop {
            match reader.read(&mut vocab, &mut record) {
                Ok(true) => records.push(record.clone()),
                Ok(false) => return Ok(records),
                Err(diag) => return Err(diag.code.number),
            }
        }
    };
    const UP: &str = "5.0, 0.0, -1.0, 0.0, 0.0, 1.0, 5.0";
    const DOWN: &str = "5.0, 0.0, -1.0, 0.0, 0.0, -1.0, 5.0";
    for (center, degrees, end) in [
        (UP, "180.0", "10.0,0.0,-1.0"),
        (UP, "90.0", "5.0,-5.0,-1.0"),
        (UP, "270.0", "5.0,5.0,-1.0"),
        (DOWN, "90.0", "5.0,5.0,-1.0"),
        (UP, "360.0", "0.0,0.0,-1.0"),
        (UP, "360.0", "0.0,0.0,-3.0"),
        (UP, "180.005", "10.0,0.0,-1.0"),
    ] {
        let records = read(center, degrees, end).unwrap_or_else(|code| panic!("{code} {degrees}"));
        let circle = records[2].circle().unwrap();
        assert_eq!((circle.radius, circle.center), (Some(5.0), [5.0, 0.0, -1.0]));
        assert_eq!(records.len(), 6);
    }
    for (center, degrees, end) in [
        (UP, "90.0", "5.0,5.0,-1.0"),
        (DOWN, "90.0", "5.0,-5.0,-1.0"),
        (UP, "180.1", "10.0,0.0,-1.0"),
        (UP, "360.0", "10.0,0.0,-1.0"),
        (UP, "0.05", "0.0,0.0,-1.0"),
        (UP, "-90.0", "5.0,5.0,-1.0"),
        (UP, "720.0", "0.0,0.0,-3.0"),
        ("5.0, 0.0, -1.0, 0.0, 0.0, 1.0", "90.0", "5.0,-5.0,-1.0"),
    ] {
        assert_eq!(read(center, degrees, end).err(), Some(408), "{center} {degrees} {end}");
    }
}
