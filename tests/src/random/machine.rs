//! What LinuxCNC's interpreter does with a program of the post: its steps with
//! the modes in force, lengths in mm. Many programs run in one process.

use std::path::Path;

use crate::path::{Axis, Point, Unit};
use crate::rs274::{self, Canon, words};

use super::expected::{Compensation, Coolant, Rate, Turning};
use super::geometry::axes;
use super::setup::{CenterForm, Setup};

/// What a step of the machine does.
#[derive(Clone, Debug, PartialEq)]
pub enum NcAct {
    /// Rapid to a point.
    Rapid(Point),
    /// Straight line at feed.
    Feed(Point),
    /// Arc or helix at feed.
    Arc {
        /// End.
        to: Point,
        /// Center; the coordinate along the normal means nothing.
        center: Point,
        /// Normal of the plane.
        normal: Axis,
        /// Counterclockwise seen against the normal.
        ccw: bool,
        /// Full turns besides the arc to the end.
        turns: u32,
    },
    /// Pass of a thread.
    Thread {
        /// End.
        to: Point,
        /// How far it goes in one turn.
        lead: f64,
    },
    /// Tool change.
    Tool(u32),
    /// Dwell in seconds.
    Dwell(f64),
    /// Program stop.
    Stop,
    /// Optional stop.
    OptionalStop,
}

impl NcAct {
    /// Where a motion ends.
    pub fn end(&self) -> Option<Point> {
        match self {
            NcAct::Rapid(to)
            | NcAct::Feed(to)
            | NcAct::Arc { to, .. }
            | NcAct::Thread { to, .. } => Some(*to),
            _ => None,
        }
    }
}

/// A step of the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct NcStep {
    /// What it does.
    pub act: NcAct,
    /// Where it begins.
    pub from: Point,
    /// Line of the NC program, 1-based.
    pub line: usize,
    /// The feed in force.
    pub feed: Rate,
    /// The spindle.
    pub spindle: Turning,
    /// The coolant.
    pub coolant: Coolant,
    /// Cutter compensation.
    pub compensation: Compensation,
    /// Number of the length offset; 0 for none.
    pub length: u32,
    /// Highest speed of the spindle; 0 for none.
    pub limit: f64,
}

/// A program as a run of the interpreter takes it.
pub struct Tape<'a> {
    /// The NC text, whole.
    pub nc: &'a str,
    /// The machine it was made for.
    pub setup: &'a Setup,
    /// Blocks with a skip mark are left out.
    pub skipping: bool,
}

/// Runs programs and gives the steps of each, or what the interpreter says against it.
pub fn run(rs274: &Path, tapes: &[Tape<'_>]) -> Vec<Result<Vec<NcStep>, String>> {
    match tapes {
        [] => Vec::new(),
        [tape] => vec![run_batch(rs274, tapes).map(|mut all| all.remove(0)).map_err(|said| {
            let lines = tape.nc.lines().count();
            format!("the interpreter refuses the program of {lines} lines: {said}")
        })],
        _ => match run_batch(rs274, tapes) {
            Ok(all) => all.into_iter().map(Ok).collect(),
            Err(_) => {
                let (left, right) = tapes.split_at(tapes.len() / 2);
                [run(rs274, left), run(rs274, right)].concat()
            }
        },
    }
}

/// One process for all of them; it stops at the first fault.
fn run_batch(rs274: &Path, tapes: &[Tape<'_>]) -> Result<Vec<Vec<NcStep>>, String> {
    let mut text = String::new();
    let mut lines = 0;
    // For each program the number of the line before its first one.
    let mut starts = Vec::new();
    for tape in tapes {
        for line in reset(tape.setup) {
            lines += 1;
            text.push_str(&format!("N{lines} {line}\n"));
        }
        starts.push(lines);
        let mut motion_code = None;
        for line in tape.nc.lines() {
            lines += 1;
            let block = for_interpreter(line, tape.skipping);
            let block = with_lone_code(&block, &mut motion_code);
            if !block.is_empty() {
                text.push_str(&format!("N{lines} {block}"));
            }
            text.push('\n');
        }
    }
    text.push_str("M30\n");
    let calls = rs274::parse(&rs274::interpret(rs274, &text)?)?;
    let mut all = Vec::new();
    for (part, (tape, start)) in parts(&calls).zip(tapes.iter().zip(starts)) {
        all.push(Reading::new(tape, start).all(part)?);
    }
    if all.len() == tapes.len() { Ok(all) } else { Err("a program has no end".to_string()) }
}

/// Stands before each program in the calls.
const MARK: &str = "next program";

fn parts(calls: &[rs274::Call]) -> impl Iterator<Item = &[rs274::Call]> {
    calls.split(|call| call.canon == Canon::Comment(MARK.to_string())).skip(1)
}

/// Brings the control to the state of a new process, or, for a hostile machine,
/// to modes that the start of a program must not rely on. Its lines have numbers,
/// so that the calls of a program end where they begin.
fn reset(setup: &Setup) -> Vec<&'static str> {
    let mut lines = vec!["G40", "G80", "G49", "G54", "G21", "G90", "G94", "G17", "G98", "M5", "M9"];
    lines.extend(["G0 Z0", "G0 X0 Y0", "T0 M6", "F0", "S0"]);
    if setup.hostile {
        lines.extend(["G95", "G18", "G91"]);
        lines.push(if setup.unit == Unit::Mm { "G20" } else { "G21" });
    }
    lines.extend(["G8", "G97"]);
    lines.push(if setup.center == CenterForm::Absolute { "G90.1" } else { "G91.1" });
    lines.push("(next program)");
    lines
}

/// A block as the interpreter gets it: without number and skip mark; empty for tape
/// marks, the program number and the end code, which the verdict looks at.
fn for_interpreter(line: &str, skipping: bool) -> String {
    let block = line.trim();
    let (skip, block) = match block.strip_prefix('/') {
        Some(rest) => (true, rest),
        None => (false, block),
    };
    let outside = block.is_empty() || block.starts_with(['%', 'O', '(']);
    if outside || (skip && skipping) {
        return String::new();
    }
    match without_number(block) {
        "M30" | "M2" | "M02" => String::new(),
        plain => plain.to_string(),
    }
}

/// The interpreter refuses G2 and G3, and G1 before any F, in a block without axes,
/// where other controls take them for the blocks that follow. So the code goes into
/// the next block that moves and has no motion code of its own.
fn with_lone_code(block: &str, waiting: &mut Option<u32>) -> String {
    const MOTIONS: [u32; 16] = [0, 1, 2, 3, 33, 73, 76, 80, 81, 82, 83, 84, 85, 86, 88, 89];
    let codes = words(block, 'G');
    let motion = codes.iter().copied().find(|code| MOTIONS.contains(code));
    let moves =
        ['X', 'Y', 'Z', 'I', 'J', 'K', 'R'].into_iter().any(|letter| block.contains(letter));
    let lone = !block.chars().any(|c| c.is_ascii_alphabetic() && c != 'G');
    match (motion, *waiting) {
        (Some(code @ (1..=3)), _) if lone => {
            *waiting = Some(code);
            let others = codes.iter().filter(|other| **other != code);
            others.map(|other| format!("G{other} ")).collect::<String>().trim().to_string()
        }
        (None, Some(code)) if moves => format!("G{code} {block}"),
        (Some(_), _) => {
            *waiting = None;
            block.to_string()
        }
        (None, _) => block.to_string(),
    }
}

/// The K of a block.
fn lead(block: &str) -> Option<f64> {
    block.split(' ').find_map(|word| word.strip_prefix('K')?.parse().ok())
}

/// A block without its sequence number.
pub fn without_number(block: &str) -> &str {
    match block.strip_prefix('N') {
        Some(rest) => rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start(),
        None => block,
    }
}

/// The state of the control while its calls are read.
struct Reading<'a> {
    lines: Vec<&'a str>,
    start: usize,
    skipping: bool,
    /// Lines whose words of compensation and length are taken.
    scanned: usize,
    unit: f64,
    at: Point,
    plane: Axis,
    feed: f64,
    per_revolution: bool,
    speed: f64,
    /// S is a surface speed, m/min, up to this highest speed.
    surface: bool,
    limit: f64,
    /// The lead along the path of the last threading move, in units of the program.
    lead: f64,
    in_step: bool,
    turns: Option<bool>,
    coolant: Coolant,
    compensation: Compensation,
    length: u32,
    selected: u32,
    dwell_factor: f64,
}

impl<'a> Reading<'a> {
    fn new(tape: &Tape<'a>, start: usize) -> Self {
        let setup = tape.setup;
        // A hostile control stands at the other unit before the program.
        let metric = (setup.unit == Unit::Mm) != setup.hostile;
        Reading {
            lines: tape.nc.lines().collect(),
            start,
            skipping: tape.skipping,
            scanned: 0,
            unit: if metric { 1.0 } else { Unit::Inch.in_mm() },
            at: [0.0; 3],
            plane: if setup.hostile { Axis::Y } else { Axis::Z },
            feed: 0.0,
            per_revolution: setup.hostile,
            speed: 0.0,
            surface: false,
            limit: 0.0,
            lead: 0.0,
            in_step: false,
            turns: None,
            coolant: Coolant { flood: false, mist: false },
            compensation: Compensation::Off,
            length: 0,
            selected: 0,
            dwell_factor: setup.dwell_factor,
        }
    }

    fn all(mut self, calls: &[rs274::Call]) -> Result<Vec<NcStep>, String> {
        let mut steps = Vec::new();
        for call in calls {
            let line = call.line.map_or(0, |line| line as usize);
            if line > self.start + self.lines.len() {
                break;
            }
            let own = line.saturating_sub(self.start);
            self.scan(own);
            if let Some(act) = self.take(&call.canon)? {
                let from = self.at;
                self.at = act.end().unwrap_or(from);
                let stays = matches!(act, NcAct::Rapid(_) | NcAct::Feed(_)) && from == self.at;
                if !stays {
                    steps.push(self.step(act, from, own));
                }
            }
        }
        Ok(steps)
    }

    fn step(&self, act: NcAct, from: Point, line: usize) -> NcStep {
        let spindle = match self.turns {
            Some(ccw) if self.surface => Turning::Surface { speed: self.speed, ccw },
            Some(ccw) => Turning::At { speed: self.speed, ccw },
            None => Turning::Stopped,
        };
        NcStep {
            act,
            from,
            line,
            feed: Rate { value: self.feed * self.unit, per_revolution: self.per_revolution },
            spindle,
            coolant: self.coolant,
            compensation: self.compensation,
            length: self.length,
            limit: self.limit,
        }
    }

    /// Takes the words of compensation and length up to a line: the calls tell
    /// neither which offset it is nor, while it looks ahead, when it begins.
    fn scan(&mut self, line: usize) {
        while self.scanned < line.min(self.lines.len()) {
            let block = self.lines[self.scanned];
            self.scanned += 1;
            if block.trim().starts_with('/') && self.skipping {
                continue;
            }
            let codes = words(block, 'G');
            let offset = words(block, 'D').first().copied().unwrap_or(0);
            for code in codes {
                match code {
                    40 => self.compensation = Compensation::Off,
                    41 => self.compensation = Compensation::Left(offset),
                    42 => self.compensation = Compensation::Right(offset),
                    43 => self.length = words(block, 'H').first().copied().unwrap_or(0),
                    49 => self.length = 0,
                    96 => {
                        self.surface = true;
                        self.limit = f64::from(words(block, 'D').first().copied().unwrap_or(0));
                    }
                    97 => self.surface = false,
                    33 => self.lead = lead(block).unwrap_or(0.0),
                    _ => {}
                }
            }
        }
    }

    fn take(&mut self, canon: &Canon) -> Result<Option<NcAct>, String> {
        match canon {
            Canon::Traverse(to) => return Ok(Some(NcAct::Rapid(self.point(to)))),
            Canon::Feed(to) if self.in_step => return Ok(Some(self.pass(self.point(to)))),
            Canon::Feed(to) => return Ok(Some(NcAct::Feed(self.point(to)))),
            Canon::Arc { end, center, turns, height, .. } => {
                return Ok(Some(self.arc(*end, *center, *turns, *height)));
            }
            Canon::Tap(_) => return Err("rigid tapping is not in these programs".to_string()),
            Canon::ChangeTool => return Ok(Some(NcAct::Tool(self.selected))),
            Canon::Dwell(time) => return Ok(Some(NcAct::Dwell(time / self.dwell_factor))),
            Canon::Stop => return Ok(Some(NcAct::Stop)),
            Canon::OptionalStop => return Ok(Some(NcAct::OptionalStop)),
            Canon::Plane(normal) => self.plane = *normal,
            Canon::Units(unit) => self.unit = unit.in_mm(),
            Canon::FeedRate(rate) => self.feed = *rate,
            Canon::PerMinute(on) => self.per_revolution = !on,
            Canon::SelectTool(tool) => self.selected = *tool,
            Canon::SpindleSpeed(speed) => self.speed = *speed,
            Canon::SpindleOn(ccw) => self.turns = Some(*ccw),
            Canon::SpindleOff => self.turns = None,
            Canon::Flood(on) => self.coolant.flood = *on,
            Canon::Mist(on) => self.coolant.mist = *on,
            Canon::Synchronised(on) => self.in_step = *on,
            Canon::Comment(_) | Canon::Other(_) => {}
        }
        Ok(None)
    }

    /// A pass of a thread; its lead counts along the path in the program.
    fn pass(&self, to: Point) -> NcAct {
        let ways = [0, 1, 2].map(|axis| (to[axis] - self.at[axis]).abs());
        let length = ways.into_iter().fold(0.0, f64::hypot);
        let longest = ways.into_iter().fold(0.0, f64::max);
        let share = if length > 0.0 { longest / length } else { 1.0 };
        NcAct::Thread { to, lead: self.lead * share * self.unit }
    }

    fn point(&self, to: &[f64; 6]) -> Point {
        [to[0], to[1], to[2]].map(|value| value * self.unit)
    }

    fn arc(&self, end: [f64; 2], center: [f64; 2], turns: i32, height: f64) -> NcAct {
        let [first, second, along] = axes(self.plane);
        let place = |pair: [f64; 2]| {
            let mut point = [0.0; 3];
            point[first] = pair[0] * self.unit;
            point[second] = pair[1] * self.unit;
            point[along] = height * self.unit;
            point
        };
        NcAct::Arc {
            to: place(end),
            center: place(center),
            normal: self.plane,
            ccw: turns > 0,
            turns: turns.unsigned_abs().saturating_sub(1),
        }
    }
}
