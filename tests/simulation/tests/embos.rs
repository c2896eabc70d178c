//! The grid of grooves: the printed listing, the second group and random grids, run on the
//! leaning table of `filpost_simulation::embos`.

use std::fs;

use filpost::{Error, Program};
use filpost_simulation::embos::{self, Cut, Spot, cuts, picture};
use filpost_simulation::runout::Random;
use filpost_tests::posting::with_script;
use filpost_tests::{examples, root};
use nalgebra::Point3;

/// Half the last digit of C on a cylinder of 150, and those of Y and Z.
const NEAR: f64 = 0.002;

/// The last digit of the coarsest CL file, mm.
const COARSEST: f64 = 1e-3;

/// How many random grids are posted, without FILPOST_EMBOS_GRIDS.
const GRIDS: usize = 120;

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
    let post = Program::builder().machine("machine.toml", &machine);
    let post = with_script(post, "embos-grid.fil", script);
    let mut nc = Vec::new();
    post.build()?.stream(cl.as_bytes(), &mut nc)?;
    Ok(String::from_utf8(nc).expect("NC is text"))
}

fn script() -> String {
    text("fil-scripts/papers/embos-grid.fil")
}

/// The points of a CL file.
fn points(cl: &str) -> impl Iterator<Item = Point3<f64>> {
    cl.lines().filter_map(|line| line.strip_prefix("GOTO / ")).map(|numbers| {
        let numbers: Vec<f64> = numbers.split(", ").map(|n| n.parse().expect("a number")).collect();
        Point3::new(numbers[0], numbers[1], numbers[2])
    })
}

/// The points of a CL file at a radius.
fn at_radius(cl: &str, radius: f64) -> Vec<Point3<f64>> {
    points(cl).filter(|point| (point.x.hypot(point.z) - radius).abs() < COARSEST).collect()
}

/// Each cut starts and ends at its points of the CL file, and its groove lies in the disc.
fn judge(cl: &str, nc: &str, radius: f64) -> Result<Vec<Cut>, String> {
    judge_digits(cl, nc, radius, 0.0, 45.0)
}

/// The same of a CL file whose last digit is so large, mm, on a table that leans so, degrees.
fn judge_digits(
    cl: &str,
    nc: &str,
    radius: f64,
    digit: f64,
    lean: f64,
) -> Result<Vec<Cut>, String> {
    let found = cuts(nc, radius + 1.0, lean)?;
    let points = at_radius(cl, radius);
    for cut in &found {
        for spot in [cut.at(0.0), cut.at(1.0)] {
            let near = points.iter().any(|point| (point - spot.in_part()).norm() < NEAR + digit);
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

/// A random grid.
struct Grid {
    cl: String,
    radius: f64,
    /// Angle at which the table leans, degrees.
    lean: f64,
}

/// A grid of a few grooves on a cylinder of any size, for one side, anywhere around it; points with
/// so many decimals, and axes with eight or as many. Every other one names its angle, 0 and 90
/// among them.
fn grid(random: &mut Random, side: f64, decimals: usize) -> Grid {
    let whole = |random: &mut Random, from: f64, to: f64| {
        (from + (random.unit() + 1.0) / 2.0 * (to - from)).round()
    };
    let axis = decimals.max(8);
    let radius = whole(random, 15.0, 150.0);
    let group = if side > 0.0 { "EMBOSL" } else { "EMBOSR" };
    let named = whole(random, -20.0, 110.0).clamp(0.0, 90.0);
    let (lean, word) = match random.unit() > 0.0 {
        true => (named, format!(", ATANGL, {named}")),
        false => (45.0, String::new()),
    };
    let (sine, cosine) = lean.to_radians().sin_cos();
    let mut cl =
        format!("PARTNO / 7\nUNITS / MM\nMULTAX / ON\nFEDRAT / 30, MMPM\nCYCLE / {group}{word}\n");
    for _ in 0..3 {
        let (mut angle, mut along) = (180.0 * random.unit(), 140.0 * random.unit());
        let count = whole(random, 2.0, 6.0) as usize;
        let step = 2.0_f64.sqrt() * (4.0 + 3.0 * random.unit());
        let mut point = |rapid: bool, at: f64, angle: f64, along: f64| {
            let (sine, cosine) = angle.to_radians().sin_cos();
            let before = if rapid { "RAPID\n" } else { "" };
            cl += &format!(
                "{before}GOTO / {:.decimals$}, {along:.decimals$}, {:.decimals$}, {sine:.axis$}, 0.0, \
                 {cosine:.axis$}\n",
                at * sine,
                at * cosine
            );
        };
        point(true, radius + 20.0, angle, along);
        point(true, radius + 2.0, angle, along);
        point(false, radius, angle, along);
        for _ in 0..count {
            angle += step * sine;
            along += side * radius * (step * cosine).to_radians();
            point(false, radius, angle, along);
        }
        point(false, radius + 20.0, angle, along);
    }
    Grid { cl: cl + "CYCLE / OFF\nFINI\n", radius, lean }
}

#[test]
fn random_grids_lie_in_the_plane_of_the_disc() {
    let mut random = Random(filpost_simulation::seed(5));
    let grids = filpost_simulation::jobs("FILPOST_EMBOS_GRIDS", GRIDS);
    let [mut first, mut cuts, mut refused] = [0; 3];
    let mut furthest: f64 = 0.0;
    for index in 0..grids {
        let side = if index % 2 == 0 { 1.0 } else { -1.0 };
        let decimals = 3 + index / 2 % 8;
        let Grid { cl, radius, lean } = grid(&mut random, side, decimals);
        let digit = 10.0_f64.powi(-(decimals as i32));
        let nc = post(&script(), &cl).unwrap_or_else(|error| panic!("{index}: {error}\n{cl}"));
        let found = judge_digits(&cl, &nc, radius, digit, lean)
            .unwrap_or_else(|fault| panic!("{index}: {fault}\n{cl}{nc}"));
        assert!(found.len() >= 6, "{index}: {nc}");
        first += usize::from(side > 0.0);
        cuts += found.len();
        let out = found.iter().flat_map(|cut| [0.1, 0.5, 0.9].map(|part| cut.out_of_disc(part)));
        furthest = out.fold(furthest, f64::max);
        // Along the cylinder and round it both sides are alike.
        if (3.0..=87.0).contains(&lean) {
            let turned = cl
                .replace("EMBOSL", "EMBOSX")
                .replace("EMBOSR", "EMBOSL")
                .replace("EMBOSX", "EMBOSR");
            assert!(post(&script(), &turned).is_err(), "{index}: the other side jams the disc");
            refused += 1;
        }
    }
    let second = grids - first;
    let row = format!("| {grids} | {first} | {second} | {cuts} | {furthest:.2} | {refused} |\n");
    println!("{row}");
    if [GRIDS, 500].contains(&grids) && !filpost_simulation::is_seeded() {
        assert!(text("docs/papers/embos.md").contains(&row), "{row}");
    }
}

/// Grooves on a random cone, every tool axis square to its axis, and its least radius.
fn cone(random: &mut Random, side: f64) -> (String, f64) {
    let between =
        |random: &mut Random, from: f64, to: f64| from + (random.unit() + 1.0) / 2.0 * (to - from);
    let slope = between(random, -15.0, 15.0).to_radians().tan();
    let middle = between(random, 60.0, 120.0);
    let radius = |along: f64| middle + slope * along;
    let lean = between(random, 20.0, 70.0).round();
    let (sine, cosine) = lean.to_radians().sin_cos();
    let group = if side > 0.0 { "EMBOSL" } else { "EMBOSR" };
    let mut cl = format!(
        "PARTNO / 7\nUNITS / MM\nMULTAX / ON\nFEDRAT / 30, MMPM\nCYCLE / {group}, ATANGL, {lean}\n"
    );
    let mut least = f64::INFINITY;
    for _ in 0..3 {
        let (mut angle, mut along) = (between(random, -170.0, 170.0), between(random, -40.0, 20.0));
        let mut point = |before: &str, out: f64, angle: f64, along: f64| {
            let at = radius(along) + out;
            least = least.min(radius(along));
            let (sine, cosine) = angle.to_radians().sin_cos();
            cl += &format!(
                "{before}GOTO / {:.10}, {along:.10}, {:.10}, {sine:.10}, 0.0, {cosine:.10}\n",
                at * sine,
                at * cosine
            );
        };
        point("RAPID\n", 40.0, angle, along);
        point("RAPID\n", 15.0, angle, along);
        point("", 0.0, angle, along);
        for _ in 0..5 {
            // Small steps: on a cone a groove at one angle is no straight way of Y and C.
            for _ in 0..100 {
                let step = 0.02;
                angle += (step * sine / radius(along + side * step * cosine / 2.0)).to_degrees();
                along += side * step * cosine;
            }
            point("", 0.0, angle, along);
        }
        point("", 40.0, angle, along);
    }
    (cl + "CYCLE / OFF\nFINI\n", least)
}

#[test]
fn grooves_on_random_cones_lie_in_the_plane_of_the_disc() {
    let mut random = Random(filpost_simulation::seed(9));
    let cones = filpost_simulation::jobs("FILPOST_EMBOS_GRIDS", 60);
    for index in 0..cones {
        let side = if index % 2 == 0 { 1.0 } else { -1.0 };
        let (cl, least) = cone(&mut random, side);
        let lean = cl.split("ATANGL, ").nth(1).and_then(|rest| rest.lines().next());
        let lean: f64 = lean.expect("an angle").parse().expect("a number");
        let nc = post(&script(), &cl).unwrap_or_else(|error| panic!("{index}: {error}\n{cl}"));
        let found = cuts(&nc, least + 1.0, lean).unwrap_or_else(|it| panic!("{index}: {it}\n{nc}"));
        assert_eq!(found.len(), 15, "{index}: {nc}");
        let points: Vec<Point3<f64>> = points(&cl).collect();
        for cut in &found {
            for spot in [cut.at(0.0), cut.at(1.0)] {
                let near = points.iter().any(|point| (point - spot.in_part()).norm() < NEAR);
                assert!(near, "{index}, line {}: {spot:?}\n{cl}{nc}", cut.line);
            }
            for part in [0.1, 0.5, 0.9] {
                let out = cut.out_of_disc(part);
                assert!(out < 0.5, "{index}, line {}: out of the disc by {out}", cut.line);
            }
        }
    }
    println!("grooves on cones: {cones} posted, each cut lies in the plane of the disc");
}

/// A head whose travel allows it turned over is refused: it would reach the same tool axis with its
/// disc across the groove.
#[test]
fn a_head_that_can_turn_over_is_refused() {
    let machine = text("corpus/papers/embos-grooves/machine.toml");
    let (cl, nc) = first();
    let run = |machine: &str| {
        let script = script();
        let post = Program::builder().machine("machine.toml", machine);
        let post = with_script(post, "embos-grid.fil", &script);
        let mut nc = Vec::new();
        post.build().and_then(|post| post.stream(cl.as_bytes(), &mut nc)).map(|_| nc)
    };
    assert_eq!(run(&machine).expect("it is posted"), nc.as_bytes());
    for (from, to) in [
        ("secondary_min = -180", "secondary_min = -270"),
        ("secondary_max = 0", "secondary_max = 1"),
        ("secondary_min = -180\n", ""),
        ("secondary_max = 0\n", ""),
    ] {
        let changed = machine.replace(from, to);
        assert_ne!(changed, machine, "{from} is not in the machine");
        let error = run(&changed).expect_err(to).to_string();
        assert!(error.contains("the head can turn over"), "{from}: {error}");
    }
}

/// Each of these changes of the script shows in its programs.
#[test]
fn changes_of_the_script_are_found() {
    for (from, to) in [
        ("TRANS/0,0,-1,0,0,1,0,0,1,0,0,0", "TRANS/0,0,1,0,0,1,0,0,-1,0,0,0"),
        ("POSTF(2,3,780,EMCTR+180)", "POSTF(2,3,780,EMCTR)"),
        ("POSTF(2,3,780,EMCTR+180)", "POSTF(2,3,780,EMCTR+90)"),
        ("POSTF(2,3,487,EMCOS)", "POSTF(2,3,487,1)"),
        ("EMZVAL = EMY*EMSIN", "EMZVAL = EMY"),
        ("EMZVAL = EMY*EMSIN", "EMZVAL = -EMY*EMSIN"),
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

/// Both programs of the grid of the corpus: the cuts of each lie in the disc, and the picture shows
/// all of them.
#[test]
fn the_picture_shows_the_whole_grid() {
    let [first, second] = ["first", "second"].map(|group| {
        let folder = format!("corpus/papers/embos-grid-{group}");
        let [cl, nc] = ["grooves.ncl", "grid.nc"].map(|name| text(&format!("{folder}/{name}")));
        judge(&cl, &nc, 81.0).expect("right")
    });
    assert!(first.len() >= 50 && first.len() == second.len());
    embos::grid(&first, &second).check(&root().join("docs/papers/embos-unrolled.svg"));
}
