//! The grid of grooves: the printed listing, the second group and random grids, run on the
//! leaning table of `filpost_simulation::embos`.

use std::fs;

use filpost::{Error, Program};
use filpost_simulation::embos::{Cut, Spot, cuts, picture};
use filpost_simulation::runout::Random;
use filpost_tests::{examples, root};
use nalgebra::Point3;

/// Half the last digit of C on a cylinder of 150, and those of Y and Z.
const NEAR: f64 = 0.002;

fn text(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn first() -> (String, String) {
    (
        text("corpus/papers/embos-grooves/grooves.ncl"),
        text("corpus/papers/embos-grooves/figure-7.nc"),
    )
}

fn second() -> (String, String) {
    let folder = "corpus/papers/embos-second-group";
    (text(&format!("{folder}/grooves.ncl")), text(&format!("{folder}/second-group.nc")))
}

fn post(script: &str, cl: &str) -> Result<String, Error> {
    let machine = text("corpus/papers/embos-grooves/machine.toml");
    let post = Program::builder().machine("machine.toml", &machine).fil("embos-grid.fil", script);
    let mut nc = Vec::new();
    post.build()?.run(cl.as_bytes(), &mut nc)?;
    Ok(String::from_utf8(nc).expect("NC is text"))
}

fn script() -> String {
    text("fil-scripts/papers/embos-grid.fil")
}

/// The points of a CL file at a radius.
fn at_radius(cl: &str, radius: f64) -> Vec<Point3<f64>> {
    let points = cl.lines().filter_map(|line| line.strip_prefix("GOTO / ")).map(|numbers| {
        let numbers: Vec<f64> = numbers.split(", ").map(|n| n.parse().expect("a number")).collect();
        Point3::new(numbers[0], numbers[1], numbers[2])
    });
    points.filter(|point| (point.x.hypot(point.z) - radius).abs() < 1e-6).collect()
}

/// Each cut starts and ends at its points of the CL file, and its groove lies in the disc.
fn judge(cl: &str, nc: &str, radius: f64) -> Result<Vec<Cut>, String> {
    let found = cuts(nc, radius + 1.0)?;
    let points = at_radius(cl, radius);
    for cut in &found {
        for spot in [cut.at(0.0), cut.at(1.0)] {
            let near = points.iter().any(|point| (point - spot.in_part()).norm() < NEAR);
            if !near {
                return Err(format!("line {}: {spot:?} is no point of the groove", cut.line));
            }
        }
        for part in [0.1, 0.5, 0.9] {
            let out = cut.out_of_disc(part);
            if out > 0.3 {
                return Err(format!("line {}: the groove leaves the disc by {out}", cut.line));
            }
        }
    }
    Ok(found)
}

#[test]
fn both_groups_lie_in_the_plane_of_the_disc() {
    for ((cl, nc), side) in [(first(), 81.0), (second(), -81.0)] {
        let found = judge(&cl, &nc, 81.0).expect("the program is right");
        assert_eq!(found.len(), 12);
        assert!(found.iter().all(|cut| cut.from[0] == side && cut.to[0] == side));
        assert_eq!(post(&script(), &cl).expect("it is posted"), nc);
    }
}

/// On the unrolled cylinder one group rises and the other falls, both at 45 degrees.
#[test]
fn the_groups_cross_at_right_angles() {
    let slope = |cut: &Cut| {
        let [from, to]: [Spot; 2] = [cut.at(0.0), cut.at(1.0)];
        (to.along - from.along).atan2(from.radius * (to.angle - from.angle).to_radians())
    };
    let [one, other] = [first(), second()].map(|(cl, nc)| judge(&cl, &nc, 81.0).expect("right"));
    for (one, other) in one.iter().zip(&other) {
        let between = (slope(one) - slope(other)).to_degrees().abs();
        assert!((between.rem_euclid(180.0) - 90.0).abs() < 0.2, "{between}");
    }
}

/// A grid of a few grooves on a cylinder of any size, for one side.
fn grid(random: &mut Random, side: f64) -> (String, f64) {
    let whole = |random: &mut Random, from: f64, to: f64| {
        (from + (random.unit() + 1.0) / 2.0 * (to - from)).round()
    };
    let radius = whole(random, 15.0, 150.0);
    let group = if side > 0.0 { "EMBOSL" } else { "EMBOSR" };
    let mut cl =
        format!("PARTNO / 7\nUNITS / MM\nMULTAX / ON\nFEDRAT / 30, MMPM\nCYCLE / {group}\n");
    for _ in 0..3 {
        let (mut angle, foot) = (60.0 * random.unit(), 40.0 * random.unit());
        let count = whole(random, 2.0, 6.0) as usize;
        let step = 4.0 + 3.0 * random.unit();
        let mut point = |rapid: bool, at: f64, angle: f64| {
            let (sine, cosine) = angle.to_radians().sin_cos();
            let y = foot + side * radius * angle.to_radians();
            let before = if rapid { "RAPID\n" } else { "" };
            cl += &format!(
                "{before}GOTO / {:.10}, {y:.10}, {:.10}, {sine:.10}, 0.0, {cosine:.10}\n",
                at * sine,
                at * cosine
            );
        };
        point(true, radius + 20.0, angle);
        point(true, radius + 2.0, angle);
        point(false, radius, angle);
        for _ in 0..count {
            angle += step;
            point(false, radius, angle);
        }
        point(false, radius + 20.0, angle);
    }
    (cl + "CYCLE / OFF\nFINI\n", radius)
}

#[test]
fn random_grids_lie_in_the_plane_of_the_disc() {
    let mut random = Random(5);
    for index in 0..60 {
        let side = if index % 2 == 0 { 1.0 } else { -1.0 };
        let (cl, radius) = grid(&mut random, side);
        let nc = post(&script(), &cl).unwrap_or_else(|error| panic!("{index}: {error}\n{cl}"));
        let found =
            judge(&cl, &nc, radius).unwrap_or_else(|fault| panic!("{index}: {fault}\n{nc}"));
        assert!(found.len() >= 6, "{index}: {nc}");
        let turned =
            cl.replace("EMBOSL", "EMBOSX").replace("EMBOSR", "EMBOSL").replace("EMBOSX", "EMBOSR");
        assert!(post(&script(), &turned).is_err(), "{index}: the other side jams the disc");
    }
}

/// Each of these changes of the script shows in its programs.
#[test]
fn changes_of_the_script_are_found() {
    for (from, to) in [
        ("TRANS/0,0,-1,0,0,1,0,0,1,0,0,0", "TRANS/0,0,1,0,0,1,0,0,-1,0,0,0"),
        ("POSTF(2,3,780,EMCTR+180)", "POSTF(2,3,780,EMCTR)"),
        ("POSTF(2,3,780,EMCTR+180)", "POSTF(2,3,780,EMCTR+90)"),
        ("POSTF(2,3,487,1/SQRTF(2))", "POSTF(2,3,487,1)"),
        ("EMZVAL = EMY/SQRTF(2)", "EMZVAL = EMY"),
        ("EMZVAL = EMY/SQRTF(2)", "EMZVAL = -EMY/SQRTF(2)"),
        ("  REPEAT/Z,EMZVAL\n", ""),
    ] {
        let changed = script().replace(from, to);
        assert_ne!(changed, script(), "{from} is not in the script");
        let (cl, _) = second();
        let nc = post(&changed, &cl);
        assert!(nc.is_err() || nc.is_ok_and(|nc| judge(&cl, &nc, 81.0).is_err()), "{from}");
    }
}

#[test]
fn the_page_shows_the_program_and_the_picture() {
    let page = text("docs/papers/embos.md");
    let shown = examples::blocks(&page);
    assert!(shown.iter().any(|block| block.words == ["nc"] && block.text == second().1));
    let [one, other] = [first(), second()].map(|(cl, nc)| judge(&cl, &nc, 81.0).expect("right"));
    picture(&one, &other).check(&root().join("docs/papers/embos.svg"));
}
