//! Faces at random tilts on random chains, written in tilted frames of each family of
//! controls: what they do on the machine is what the CL file asks for.
//!
//! `FILPOST_FRAMES=20000` tries as many programs.

use std::env;
use std::fmt::Write as _;

use fil_machine::axis_chain::AxisChain;
use fil_machine::chains::CHAINS;
use fil_nc::forward::Forward;
use fil_nc::verify::{Allowed, Verdict};
use filpost::Program;
use filpost_tests::back_check;
use nalgebra::{Isometry3, Point3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

/// Programs in the normal run.
const USUAL: u64 = 90;

/// The ready posts, one of each family, and what makes them write frames.
const POSTS: [(&str, &[&str]); 3] = [
    ("fanuc-5x-tables", &["rotary.tip_output=0", "rotary.frame_output=1"]),
    ("heidenhain-5x", &[]),
    ("sinumerik-5x", &[]),
];

/// Numbers that are the same in each run.
struct Random(u64);

impl Random {
    /// From 0 to below 1.
    fn share(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    fn below(&mut self, most: usize) -> usize {
        (self.share() * most as f64) as usize
    }

    fn direction(&mut self) -> Unit<Vector3<f64>> {
        let [x, y, z] = [0; 3].map(|_| self.between(-1.0, 1.0));
        Unit::try_new(Vector3::new(x, y, z), 0.1).unwrap_or_else(Vector3::z_axis)
    }
}

/// A CL file under construction: what it says is seen through TRANS.
struct Cl {
    text: String,
    /// From the part to the points of the file.
    back: Isometry3<f64>,
    /// Lengths are divided by it.
    unit: f64,
}

impl Cl {
    fn point(&self, point: Point3<f64>) -> String {
        let point = self.back * point / self.unit;
        format!("{:.9}, {:.9}, {:.9}", point.x, point.y, point.z)
    }

    fn vector(&self, vector: Vector3<f64>) -> String {
        let vector = self.back * vector;
        format!("{:.9}, {:.9}, {:.9}", vector.x, vector.y, vector.z)
    }

    fn line(&mut self, text: &str) {
        writeln!(self.text, "{text}").expect("a text");
    }

    fn goto(&mut self, point: Point3<f64>) {
        let text = format!("GOTO / {}", self.point(point));
        self.line(&text);
    }
}

/// A face of the part: its frame, with the tool along Z.
fn face(cl: &mut Cl, random: &mut Random, number: usize, frame: &Isometry3<f64>) {
    let at = |x: f64, y: f64, z: f64| frame * Point3::new(x, y, z);
    let axis = frame * Vector3::z();
    cl.line(&format!("LOADTL / {number}"));
    let text = format!("TLAXIS / {}", cl.vector(axis));
    cl.line(&text);
    let (x, y) = (random.between(-40.0, 40.0), random.between(-40.0, 40.0));
    let radius = random.between(2.0, 30.0);
    cl.line("RAPID");
    cl.goto(at(x, y, 60.0));
    cl.goto(at(x, y, 1.0));
    cl.goto(at(x + 10.0, y, 1.0));
    let clockwise = random.share() < 0.5;
    let (side, normal) = if clockwise { (-1.0, -axis) } else { (1.0, axis) };
    let text = format!(
        "CIRCLE / {}, {}, {:.9}",
        cl.point(at(x + 10.0, y + side * radius, 1.0)),
        cl.vector(normal),
        radius / cl.unit
    );
    cl.line(&text);
    cl.goto(at(x + 10.0 + radius, y + side * radius, 1.0));
    cl.goto(at(x + 10.0 + radius, y + side * (radius + 10.0), 1.0));
    cl.line("RAPID");
    cl.goto(at(x + 10.0 + radius, y + side * (radius + 10.0), 40.0));
    if random.share() < 0.7 {
        let depth = random.between(3.0, 20.0) / cl.unit;
        let feed = if cl.unit == 1.0 { "MMPM, 100" } else { "IPM, 5" };
        let clear = 3.0 / cl.unit;
        cl.line(&format!("CYCLE / DRILL, DEPTH, {depth:.4}, {feed}, CLEAR, {clear:.4}"));
        cl.goto(at(x, y, 0.0));
        cl.goto(at(x + 7.0, y - 5.0, 0.0));
        cl.line("CYCLE / OFF");
        cl.line("RAPID");
        cl.goto(at(x + 7.0, y - 5.0, 60.0));
    }
}

/// A random position of the rotary axes within their travel.
fn angles(chain: &AxisChain, random: &mut Random) -> [f64; 2] {
    let upright = random.share() < 0.15;
    [0, 1].map(|n| match &chain.rotaries[n] {
        Some(rotary) => {
            let low = rotary.min.unwrap_or(-180.0).max(-180.0);
            let high = rotary.max.unwrap_or(180.0).min(180.0);
            let square = random.share() < 0.3;
            let angle = random.between(low, high);
            let angle = if square { (angle / 90.0).round() * 90.0 } else { angle };
            if upright && low <= 0.0 && high >= 0.0 { 0.0 } else { angle.clamp(low, high) }
        }
        None => 0.0,
    })
}

fn post(chain: &str, (ready, settings): (&str, &[&str])) -> Program {
    let start = Program::builder().generic(ready).set(&format!("chain=\"{chain}\""));
    // Chains of one axis leave the second one of the ready post there.
    let one = ["table-a", "table-b", "head-b"].contains(&chain);
    let start = if one { start.set("rotary.secondary_kind=0") } else { start };
    let builder = settings.iter().fold(start, |builder, setting| builder.set(setting));
    builder.build().unwrap_or_else(|error| panic!("{chain} {ready}: {error}"))
}

fn program(chain: &AxisChain, random: &mut Random) -> String {
    let inches = random.share() < 0.25;
    let moved = random.share() < 0.3;
    let trans = match moved {
        true => Isometry3::from_parts(
            Translation3::new(random.between(-9.0, 9.0), random.between(-9.0, 9.0), 5.0),
            UnitQuaternion::from_axis_angle(&random.direction(), random.between(-3.0, 3.0)),
        ),
        false => Isometry3::identity(),
    };
    let unit = if inches { 25.4 } else { 1.0 };
    let mut cl = Cl { text: String::new(), back: trans.inverse(), unit };
    cl.line("PARTNO / FACES");
    cl.line(if inches { "UNITS / INCHES" } else { "UNITS / MM" });
    cl.line(if inches { "FEDRAT / 20, IPM" } else { "FEDRAT / 500, MMPM" });
    if moved {
        let turn = trans.rotation.to_rotation_matrix();
        let rows: Vec<String> = (0..3)
            .map(|n| {
                let row = turn.matrix().row(n);
                let by = trans.translation.vector[n] / unit;
                format!("{:.12}, {:.12}, {:.12}, {by:.9}", row[0], row[1], row[2])
            })
            .collect();
        cl.line(&format!("TRANS / {}", rows.join(", ")));
    }
    let forward = Forward::new(chain.clone());
    for number in 1..=2 + random.below(2) {
        let axis = forward.axis(angles(chain, random));
        let lies = Rotation3::rotation_between(&Vector3::z(), &axis).unwrap_or_else(|| {
            Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        });
        let about =
            Rotation3::from_axis_angle(&Unit::new_normalize(axis), random.between(-3.0, 3.0));
        let origin =
            Translation3::new(random.between(-60.0, 60.0), random.between(-60.0, 60.0), 0.0);
        let frame = Isometry3::from_parts(origin, UnitQuaternion::from(about * lies));
        face(&mut cl, random, number, &frame);
    }
    cl.line("FINI");
    cl.text
}

#[test]
fn faces_in_tilted_frames_do_what_the_cl_file_asks_for() {
    let count = env::var("FILPOST_FRAMES").ok().and_then(|n| n.parse().ok()).unwrap_or(USUAL);
    let chains: Vec<_> = CHAINS.iter().filter(|chain| chain.name != "table-c").collect();
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let (mut frames, mut arcs, mut poles) = (0, 0, 0);
    for number in 0..count {
        let chain = chains[random.below(chains.len())].name;
        let settings = POSTS[random.below(POSTS.len())];
        let post = post(chain, settings);
        let machine = AxisChain::from_commons(post.commons()).expect("a chain");
        let cl = program(&machine, &mut random);
        let mut nc = Vec::new();
        let name = format!("program {number}, {chain}, {}", settings.0);
        match post.stream(cl.as_bytes(), &mut nc) {
            Err(error) if error.to_string().contains("pole") => {
                poles += 1;
                continue;
            }
            done => done.unwrap_or_else(|error| panic!("{name}: {error}\n{cl}")),
        };
        let nc = String::from_utf8_lossy(&nc);
        let report = back_check::check(post.commons(), &cl, &nc, Allowed::default())
            .unwrap_or_else(|diag| panic!("{name}: {diag}\n{cl}\n{nc}"));
        assert_eq!(report.verdict(), Verdict::Agrees, "{name}: {:#?}\n{cl}\n{nc}", report.findings);
        let motions = cl.matches("GOTO").count() as u64;
        assert_eq!((report.compared, report.matched), (motions, motions), "{name}\n{cl}\n{nc}");
        let off = report.position.max;
        assert!(off < 0.0035, "{name}: {off}\n{cl}\n{nc}");
        frames += ["G68.2", "PLANE SPATIAL", "CYCLE800(0"]
            .map(|word| nc.matches(word).count())
            .iter()
            .sum::<usize>();
        arcs += [" G2 ", " G3 ", " DR+", " DR-"]
            .map(|word| nc.matches(word).count())
            .iter()
            .sum::<usize>();
    }
    println!(
        "{count} programs, {frames} tilted work planes, {arcs} arcs, {poles} refused at poles"
    );
    assert!(poles * 50 <= count, "{poles} of {count} refused at poles");
    assert!(frames as u64 > count && arcs as u64 > count, "{frames} frames, {arcs} arcs");
}
