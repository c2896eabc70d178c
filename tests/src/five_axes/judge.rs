//! What comes of a program: the post makes it, `fil-nc` follows it, and the tool comes to each
//! point that the generator meant.

use std::collections::BTreeMap;
use std::env;

use fil_machine::address::Addresses;
use fil_machine::letter::letters;
use fil_machine::locations as loc;
use fil_nc::forward::Forward;
use fil_nc::motion::Event;
use fil_nc::verify::{Allowed, Verdict};
use filpost::Program;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use super::maker::Line;
use crate::back_check;

/// Millimetres of an inch.
const INCH: f64 = 25.4;

/// What came of a program.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Nothing is found, and the tool comes to each point.
    Agrees,
    /// The code of the refusal.
    Refused(String),
    /// What differs, without its numbers, and with them.
    Differs(String, String),
}

/// The CL file of lines.
pub fn text(lines: &[Line]) -> String {
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

/// A refusal, by the post or by the check; one that is not expected is a difference.
fn refused(kind: &str, told: &str, may_refuse: &[&str]) -> Outcome {
    let code = told.find('E').and_then(|at| told.get(at..at + 5)).unwrap_or_default();
    match may_refuse.iter().any(|start| code.starts_with(start)) {
        true => Outcome::Refused(code.to_string()),
        false => differs(kind, told),
    }
}

/// Posts a program and follows what comes out; the program too. Other refusals than the given
/// ones are differences.
pub fn judge(post: &Program, lines: &[Line], may_refuse: &[&str]) -> (Outcome, String) {
    let cl = text(lines);
    let mut nc = Vec::new();
    if let Err(error) = post.stream(cl.as_bytes(), &mut nc) {
        return (refused("refused", &error.to_string(), may_refuse), String::new());
    }
    let nc = String::from_utf8_lossy(&nc).into_owned();
    let report = match back_check::check(post.commons(), &cl, &nc, Allowed::default()) {
        Ok(report) => report,
        Err(diag) => return (refused("not read", &diag.to_string(), may_refuse), nc),
    };
    if report.verdict() == Verdict::Differs {
        let told: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
        return (differs("found", &told.join("; ")), nc);
    }
    match missed(post, lines, &nc) {
        Some(told) => (differs("missed", &told), nc),
        None => (Outcome::Agrees, nc),
    }
}

/// How far the last digits of X, Y and Z leave the tip from where it is meant, mm.
fn rounding(post: &Program, metric: bool) -> f64 {
    let commons = post.commons();
    let addresses = Addresses::from_commons(commons, metric);
    let unit = if metric { 1.0 } else { INCH };
    let manual = commons.read(loc::MOTION_RESOLUTION_MANUAL) == loc::MotionResolutionManual::Yes;
    let by_hand = commons.dbl_opt(loc::MOTION_RESOLUTION).filter(|_| manual).unwrap_or(0.0);
    let half = |letter| {
        0.5 * by_hand + addresses.format(letter).map_or(0.0, |format| 0.5 * format.unscale(1))
    };
    let halves = letters::XYZ.map(|letter| half(letter) * unit);
    // Some of each for the last digits of the angles.
    1.5 * halves.iter().map(|half| half * half).sum::<f64>().sqrt()
}

/// The first target that the tool does not come to, in the order of the program.
fn missed(post: &Program, lines: &[Line], nc: &str) -> Option<String> {
    let forward = Forward::from_commons(post.commons()).expect("a chain");
    let program = back_check::both(post.commons(), nc).expect("a program that was read");
    let events = program.all.events;
    let bound = 0.01_f64.max(rounding(post, !text(lines).contains("INCH")));
    let mut targets = lines.iter().filter_map(|line| line.target).peekable();
    for event in &events {
        let Event::Move(made) = event else { continue };
        let pose = forward.pose(&made.to);
        // Rounded angles move the tip of a machine whose axes lie far away.
        let is_there = |(point, axis): &(Point3<f64>, Vector3<f64>)| {
            (pose.tip - point).norm() < bound && pose.axis.angle(axis).to_degrees() < 0.003
        };
        while targets.peek().is_some_and(is_there) {
            targets.next();
        }
    }
    targets.next().map(|(point, axis)| format!("{point:.4}, {axis:.6}"))
}

/// Leaves out lines as long as the same differs.
fn shrunk(post: &Program, lines: &[Line], kind: &str, may_refuse: &[&str]) -> Vec<Line> {
    let mut lines = lines.to_vec();
    let mut at = lines.len();
    while at > 0 {
        at -= 1;
        let mut fewer = lines.clone();
        fewer.remove(at);
        if matches!(judge(post, &fewer, may_refuse).0, Outcome::Differs(other, _) if other == kind)
        {
            lines = fewer;
        }
    }
    lines
}

/// Judges a program; the story of one that differs, told as that of `what`, has the fewest lines
/// that still differ so.
pub fn tried(post: &Program, lines: &[Line], may_refuse: &[&str], what: &str) -> (Outcome, String) {
    let (outcome, _) = judge(post, lines, may_refuse);
    let Outcome::Differs(kind, _) = &outcome else { return (outcome, String::new()) };
    let small = shrunk(post, lines, kind, may_refuse);
    let (again, nc) = judge(post, &small, may_refuse);
    (outcome, format!("{what}: {again:?}\n{}---\n{nc}", text(&small)))
}

/// Tries the programs of many seeds: as many as the variable `name` says, from the seed that
/// `name` with `_FROM` says. Tells what came of them: how many there are, how many agree, and how
/// many kinds of differences there are.
pub fn try_seeds(
    name: &str,
    usual: u64,
    try_seed: fn(u64) -> (Outcome, String),
) -> (u64, u64, usize) {
    let number = |name: &str| env::var(name).ok().and_then(|n| n.parse::<u64>().ok());
    let count = number(name).unwrap_or(usual);
    let from = number(&format!("{name}_FROM")).unwrap_or(0);
    let (agree, kinds) = tell((from..from + count).into_par_iter().map(try_seed).collect());
    (count, agree, kinds)
}

/// Tells what came of programs, with the first story of each kind of difference: how many agree,
/// and how many kinds there are.
fn tell(tried: Vec<(Outcome, String)>) -> (u64, usize) {
    let (count, mut agree, mut refused) = (tried.len(), 0, BTreeMap::<String, u64>::new());
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
    (agree, stories.len())
}
