//! Random programs of four and five axes on the shipped chains, in each form of output: the
//! post makes them, `fil-nc` follows them, and they do what the generator meant.
//!
//! `FILPOST_FIVE=20000` tries as many programs, `FILPOST_FIVE_FROM` begins at a seed.

use std::collections::BTreeMap;
use std::env;

use fil_machine::axis_chain::AxisChain;
use fil_machine::chains::CHAINS;
use fil_nc::forward::Forward;
use fil_nc::motion::Event;
use fil_nc::verify::{Allowed, Verdict};
use filpost::Program;
use filpost_tests::back_check;
use nalgebra::{Point3, Rotation3, Unit, Vector3};
use rayon::prelude::*;

/// Programs in the normal run.
const USUAL: u64 = 200;

/// Refusals that a random path may meet: limits, poles, what frames and tip control leave out,
/// arcs that run back from their neighbors.
const MAY_REFUSE: [&str; 8] =
    ["E0511", "E0523", "E0524", "E0527", "E0528", "E0560", "E0588", "E0589"];

/// Ready posts and what makes them write one form.
const FORMS: [(&str, &[&str]); 12] = [
    ("fanuc-5x-tables", &["rotary.tip_output=0"]),
    ("fanuc-5x-tables", &["rotary.tip_output=0", "rotary.feed=2"]),
    (
        "fanuc-5x-tables",
        &["rotary.tip_output=0", "repos.feed_method=1", "repos.retract_distance=80"],
    ),
    ("fanuc-5x-tables", &["rotary.tip_output=0", "rotary.frame_output=1", "home.retract_z=300"]),
    ("fanuc-5x-tables", &[]),
    ("fanuc-5x-tables", &["rotary.tip_form=1", "rotary.tip_control=1"]),
    ("haas-trunnion-tcpc", &["repos.optimise=1"]),
    ("sinumerik-5x", &[]),
    ("sinumerik-5x", &["rotary.tip_form=1", "rotary.frame_output=0"]),
    ("sinumerik-5x", &["rotary.tip_output=0", "rotary.frame_output=0"]),
    ("heidenhain-5x", &[]),
    ("heidenhain-5x", &["rotary.tip_form=1", "rotary.frame_output=0", "rotary.tip_control=1"]),
];

/// Numbers that are the same in each run.
struct Random(u64);

impl Random {
    fn of_seed(seed: u64) -> Self {
        let mut random = Random((seed + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        (0..8).for_each(|_| {
            random.share();
        });
        random
    }

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

    fn happens(&mut self, share: f64) -> bool {
        self.share() < share
    }
}

/// A line of a CL file, and where the tool shall come to, mm.
#[derive(Clone)]
struct Line {
    text: String,
    target: Option<(Point3<f64>, Vector3<f64>)>,
}

/// A program under construction.
struct Maker<'a> {
    random: Random,
    chain: &'a AxisChain,
    forward: Forward,
    /// Lengths are divided by it.
    unit: f64,
    lines: Vec<Line>,
    /// Where the tool stands, mm, and the rotary axes, degrees.
    at: Point3<f64>,
    angles: [f64; 2],
}

impl Maker<'_> {
    fn say(&mut self, text: impl Into<String>) {
        self.lines.push(Line { text: text.into(), target: None });
    }

    fn axis(&self) -> Vector3<f64> {
        self.forward.axis(self.angles)
    }

    fn numbers(&self, point: Point3<f64>) -> String {
        let [x, y, z] = [point.x, point.y, point.z].map(|value| value / self.unit);
        format!("{x:.9}, {y:.9}, {z:.9}")
    }

    /// GOTO `off` along the tool from where it is meant to stand.
    fn goto(&mut self, off: f64) {
        let (point, axis) = (self.at + self.axis() * off, self.axis());
        let text = format!(
            "GOTO / {}, {:.10}, {:.10}, {:.10}",
            self.numbers(point),
            axis.x,
            axis.y,
            axis.z
        );
        self.lines.push(Line { text, target: Some((point, axis)) });
    }

    fn rapid(&mut self, off: f64) {
        self.say("RAPID");
        self.goto(off);
    }

    /// Turns the rotary axes by up to so many degrees, within their travel.
    fn turn(&mut self, most: f64) {
        for n in 0..2 {
            let Some(rotary) = &self.chain.rotaries[n] else { continue };
            let to = self.angles[n] + self.random.between(-most, most);
            self.angles[n] =
                to.max(rotary.min.unwrap_or(f64::MIN)).min(rotary.max.unwrap_or(f64::MAX));
        }
    }

    fn step(&mut self, most: f64) {
        for n in 0..3 {
            self.at[n] += self.random.between(-most, most);
        }
    }

    fn feed(&mut self) {
        let feed = self.random.between(50.0, 2000.0);
        match self.unit {
            1.0 => self.say(format!("FEDRAT / {feed:.1}, MMPM")),
            _ => self.say(format!("FEDRAT / {:.2}, IPM", feed / 25.4)),
        }
    }

    /// A quarter of a circle about the tool.
    fn arc(&mut self) {
        self.goto(0.0);
        let axis = self.axis();
        let across = axis.cross(&Vector3::new(0.3, 0.5, 0.7)).normalize();
        let radius = self.random.between(2.0, 25.0);
        let left = self.random.happens(0.5);
        let normal = if left { axis } else { -axis };
        let center = self.at - across * radius;
        let [i, j, k] = [normal.x, normal.y, normal.z];
        let center_text = self.numbers(center);
        self.say(format!(
            "CIRCLE / {center_text}, {i:.10}, {j:.10}, {k:.10}, {:.9}",
            radius / self.unit
        ));
        let quarter =
            Rotation3::from_axis_angle(&Unit::new_normalize(normal), std::f64::consts::FRAC_PI_2);
        self.at = center + quarter * (across * radius);
        self.goto(0.0);
    }

    fn hole(&mut self) {
        let (depth, clear) = (self.random.between(2.0, 15.0), 3.0);
        let feed = if self.unit == 1.0 { "MMPM, 100" } else { "IPM, 5" };
        self.rapid(20.0);
        let deep = match self.random.below(6) {
            1 => format!("FACE, DEPTH, {:.5}", depth / self.unit),
            2 => format!("BRKCHP, DEPTH, {:.5}, STEP, {:.5}", depth / self.unit, 1.5 / self.unit),
            3 => format!("CSINK, DEPTH, {:.5}", depth / self.unit),
            0 => format!("DEEP, DEPTH, {:.5}, STEP, {:.5}", depth / self.unit, 2.0 / self.unit),
            _ => format!("DRILL, DEPTH, {:.5}", depth / self.unit),
        };
        let returns = if self.random.happens(0.3) { ", RETURN, 0" } else { "" };
        self.say(format!("CYCLE / {deep}, {feed}, CLEAR, {:.5}{returns}", clear / self.unit));
        for _ in 0..1 + self.random.below(3) {
            self.goto(0.0);
            if let Some(line) = self.lines.last_mut() {
                let axis = line.target.map_or(Vector3::z(), |(_, axis)| axis);
                line.target = Some((self.at - axis * depth, axis));
            }
            // The next hole of the same face.
            let across = self.axis().cross(&Vector3::new(0.2, 0.9, 0.4)).normalize();
            self.at += across * self.random.between(3.0, 30.0);
        }
        self.say("CYCLE / OFF");
        self.rapid(20.0);
    }

    /// Upright motions without a tool axis.
    fn upright(&mut self) {
        self.rapid(80.0);
        self.angles = [0.0; 2];
        if (self.axis() - Vector3::z()).norm() > 1e-9 {
            return;
        }
        self.rapid(80.0);
        self.say("MULTAX / OFF");
        for _ in 0..1 + self.random.below(3) {
            self.step(10.0);
            let text = format!("GOTO / {}", self.numbers(self.at));
            self.lines.push(Line { text, target: Some((self.at, Vector3::z())) });
        }
        self.say("MULTAX / ON");
        self.rapid(80.0);
    }

    /// Up to the machine's own level, and to another place.
    fn retract(&mut self) {
        self.say("RETRCT");
        self.turn(60.0);
        self.step(40.0);
        self.rapid(80.0);
        self.goto(0.0);
    }

    fn section(&mut self, number: usize) {
        self.say(format!("LOADTL / {number}"));
        self.say("SPINDL / RPM, 2000, CLW");
        if self.random.happens(0.2) {
            let offset = 1 + self.random.below(3);
            self.say(format!("SET / OFSETL, {offset}"));
        }
        if self.random.happens(0.3) {
            let lintol = self.random.between(0.005, 0.1);
            self.say(format!("LINTOL / {:.6}", lintol / self.unit));
        }
        if self.random.happens(0.3) {
            self.say("COOLNT / ON");
        }
        self.feed();
        if self.random.happens(0.15) {
            self.say("FEDRAT / INVERS, AUTO");
        }
        let lean = if self.random.happens(0.2) { 90.0 } else { 50.0 };
        self.angles = [0.0; 2];
        self.turn(lean);
        self.at = Point3::origin();
        self.step(60.0);
        self.rapid(80.0);
        self.goto(0.0);
        for _ in 0..2 + self.random.below(8) {
            match self.random.below(14) {
                0 => {
                    self.rapid(80.0);
                    self.turn(60.0);
                    self.step(40.0);
                    self.rapid(80.0);
                    self.goto(0.0);
                }
                1 => self.arc(),
                2 => self.hole(),
                3 => {
                    self.feed();
                    self.step(15.0);
                    self.goto(0.0);
                }
                4 => self.turn(40.0),
                5 => self.say("DELAY / 1"),
                6 => self.upright(),
                7 => self.retract(),
                _ => {
                    let most = if self.random.happens(0.3) { 25.0 } else { 5.0 };
                    self.turn(most);
                    self.step(12.0);
                    self.goto(0.0);
                }
            }
        }
        self.rapid(80.0);
    }
}

/// What came of a program.
#[derive(Clone, Debug, PartialEq)]
enum Outcome {
    Agrees,
    Refused(String),
    /// What differs, without its numbers, and with them.
    Differs(String, String),
}

/// The lines of a program of a machine.
fn program(chain: &AxisChain, random: Random) -> Vec<Line> {
    let mut maker = Maker {
        random,
        chain,
        forward: Forward::new(chain.clone()),
        unit: 1.0,
        lines: Vec::new(),
        at: Point3::origin(),
        angles: [0.0; 2],
    };
    let inches = maker.random.happens(0.15);
    maker.unit = if inches { 25.4 } else { 1.0 };
    maker.say(if inches { "UNITS / INCHES" } else { "UNITS / MM" });
    maker.say("MULTAX / ON");
    for number in 1..=1 + maker.random.below(3) {
        maker.section(number);
    }
    maker.say("FINI");
    maker.lines
}

fn post(chain: &str, (ready, settings): (&str, &[&str]), random: &mut Random) -> Program {
    let start = Program::builder().ready(ready).set(&format!("chain=\"{chain}\""));
    let start = start.set("home.retract_z=400");
    let one = ["table-a", "table-b", "table-c", "head-b"].contains(&chain);
    let start = if one { start.set("rotary.secondary_kind=0") } else { start };
    let mut builder = settings.iter().fold(start, |builder, setting| builder.set(setting));
    if chain == "table-c" {
        // Its tool lies along X, which no tilted frame of a control knows.
        builder = builder.set("rotary.frame_output=0");
    }
    for axis in ["primary", "secondary"] {
        for part in ["x", "y", "z"] {
            let at = random.between(-80.0, 80.0);
            builder = builder.set(&format!("rotary.{axis}_{part}={at:.3}"));
        }
    }
    builder.build().unwrap_or_else(|error| panic!("{chain} {ready}: {error}"))
}

fn text(lines: &[Line]) -> String {
    lines.iter().map(|line| format!("{}\n", line.text)).collect()
}

/// A message without its numbers and names.
fn class(message: &str) -> String {
    message.chars().filter(|c| !c.is_ascii_digit() && !"-.".contains(*c)).collect()
}

fn differs(kind: &str, told: &str) -> Outcome {
    let short: String = class(told).chars().take(60).collect();
    Outcome::Differs(format!("{kind} {short}"), told.to_string())
}

/// Posts a program and follows what comes out; the program too.
fn judge(post: &Program, lines: &[Line]) -> (Outcome, String) {
    let cl = text(lines);
    let mut nc = Vec::new();
    if let Err(error) = post.run(cl.as_bytes(), &mut nc) {
        let told = error.to_string();
        let code = told.find('E').map_or("", |at| told.get(at..at + 5).unwrap_or(""));
        let outcome = match MAY_REFUSE.contains(&code) {
            true => Outcome::Refused(code.to_string()),
            false => differs("refused", &told),
        };
        return (outcome, String::new());
    }
    let nc = String::from_utf8_lossy(&nc).into_owned();
    let report = match back_check::check(post.commons(), &cl, &nc, Allowed::default()) {
        Ok(report) => report,
        Err(diag) => return (differs("not read", &diag.to_string()), nc),
    };
    if report.verdict() != Verdict::Agrees {
        let told: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
        return (differs("found", &told.join("; ")), nc);
    }
    match missed(post, lines, &nc) {
        Some(told) => (differs("missed", &told), nc),
        None => (Outcome::Agrees, nc),
    }
}

/// The first target that the tool does not come to, in the order of the program.
fn missed(post: &Program, lines: &[Line], nc: &str) -> Option<String> {
    let forward = Forward::from_commons(post.commons()).expect("a chain");
    let events = back_check::events(post.commons(), nc).expect("a program that was read");
    let mut targets = lines.iter().filter_map(|line| line.target).peekable();
    for event in &events {
        let Event::Move(made) = event else { continue };
        let pose = forward.pose(&made.to);
        // Rounded angles move the tip of a machine whose axes lie far away.
        let is_there = |(point, axis): &(Point3<f64>, Vector3<f64>)| {
            (pose.tip - point).norm() < 0.01 && pose.axis.angle(axis).to_degrees() < 0.003
        };
        while targets.peek().is_some_and(is_there) {
            targets.next();
        }
    }
    targets.next().map(|(point, axis)| format!("{point:.4}, {axis:.6}"))
}

/// Leaves out lines as long as the same differs.
fn shrunk(post: &Program, lines: &[Line], kind: &str) -> Vec<Line> {
    let mut lines = lines.to_vec();
    let mut at = lines.len();
    while at > 0 {
        at -= 1;
        let mut fewer = lines.clone();
        fewer.remove(at);
        if matches!(judge(post, &fewer).0, Outcome::Differs(other, _) if other == kind) {
            lines = fewer;
        }
    }
    lines
}

fn try_seed(seed: u64) -> (Outcome, String) {
    let mut random = Random::of_seed(seed);
    let form = FORMS[random.below(FORMS.len())];
    let chain = CHAINS[random.below(CHAINS.len())].name;
    let post = post(chain, form, &mut random);
    let machine = AxisChain::from_commons(post.commons()).expect("a chain");
    let lines = program(&machine, random);
    let (outcome, _) = judge(&post, &lines);
    let Outcome::Differs(kind, _) = &outcome else { return (outcome, String::new()) };
    let small = shrunk(&post, &lines, kind);
    let (again, nc) = judge(&post, &small);
    let story = format!("seed {seed}, {chain}, {form:?}: {again:?}\n{}---\n{nc}", text(&small));
    (outcome, story)
}

#[test]
fn random_programs_of_five_axes_do_what_they_ask_for() {
    let number = |name| env::var(name).ok().and_then(|n| n.parse::<u64>().ok());
    let (count, from) = (number("FILPOST_FIVE").unwrap_or(USUAL), number("FILPOST_FIVE_FROM"));
    let from = from.unwrap_or(0);
    let tried: Vec<_> = (from..from + count).into_par_iter().map(try_seed).collect();
    let (mut agree, mut refused) = (0, BTreeMap::<String, u64>::new());
    let mut stories = BTreeMap::<String, (u64, String)>::new();
    for (outcome, story) in tried {
        match outcome {
            Outcome::Agrees => agree += 1,
            Outcome::Refused(code) => *refused.entry(code).or_default() += 1,
            Outcome::Differs(kind, _) => stories.entry(kind).or_insert((0, story)).0 += 1,
        }
    }
    println!("{count} programs: {agree} agree, refused {refused:?}");
    for (kind, (times, story)) in &stories {
        println!("=== {times} times: {kind}\n{story}");
    }
    assert!(stories.is_empty(), "{} kinds of differences", stories.len());
    assert!(agree * 2 > count, "too few programs are posted to prove anything");
}
