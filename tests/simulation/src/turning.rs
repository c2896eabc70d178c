//! A judge of turning in `fil-stock` that shares nothing with it: random jobs as NC programs, whose paths are
//! sampled densely, and inserts that are looked up point by point.
//!
//! Over each disk two radii bracket the true one: what is left by inserts that are smaller by the
//! distance of samples, and by ones that are larger.

use std::fmt::Write;

use crate::stock::Dice;

/// Distance of samples along a path, mm.
const STEP: f64 = 0.01;

/// What brackets are wider by, mm: more than samples and chords are off.
const WIDER: f64 = 0.02;

/// Distance of the places at which an edge is looked up, mm.
const FINE: f64 = 0.005;

/// Room of the table before the tip, mm.
const BEFORE: f64 = 0.1;

/// An insert, mm and degrees; its point is where the tangents of its nose along X and Z meet.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// Radius of the nose.
    pub nose: f64,
    /// Tip direction, 2 (inside) or 3 (outside): its body lies towards Z+.
    pub direction: u32,
    /// Width; 0 of one that has a trailing edge instead.
    pub width: f64,
    /// Angle of the trailing edge.
    pub trailing: f64,
    /// Length of the trailing edge along Z.
    pub length: f64,
}

impl Edge {
    fn reach(&self) -> f64 {
        if self.width > 0.0 { self.width } else { self.length }
    }

    /// True for a point of its body; `along` Z from the tip to the body, `away` from the side that is cut.
    fn has(&self, along: f64, away: f64) -> bool {
        if along < 0.0 || away < 0.0 || along > self.reach() {
            return false;
        }
        let in_circle = |center: f64| {
            let [u, v] = [along - center, away - self.nose];
            u * u + v * v <= self.nose * self.nose
        };
        if away >= self.nose && (along < self.nose || self.width > 0.0) {
            return true;
        }
        if along < self.nose {
            return in_circle(self.nose);
        }
        if self.width > 0.0 {
            return along <= self.width - self.nose || in_circle(self.width - self.nose);
        }
        // Beyond the nose the body ends at the line that touches it at the angle of the edge.
        let (sine, cosine) = self.trailing.to_radians().sin_cos();
        let [u, v] = [along - self.nose, away - self.nose];
        let touches_nose = u * cosine + v * sine <= 0.0;
        if touches_nose { in_circle(self.nose) } else { u * sine - v * cosine <= self.nose }
    }

    /// How far its edge is behind the tip at a distance along Z; halved, as a body has no gaps.
    fn depth(&self, along: f64) -> Option<f64> {
        let (mut out, mut inside) = (0.0, 60.0);
        if !self.has(along, inside) {
            return None;
        }
        if self.has(along, out) {
            return Some(out);
        }
        for _ in 0..30 {
            let middle = (out + inside) / 2.0;
            if self.has(along, middle) {
                inside = middle;
            } else {
                out = middle;
            }
        }
        Some(inside)
    }

    /// The depth at places [`FINE`] apart, from [`BEFORE`] the tip to as much beyond its reach.
    fn table(&self) -> Vec<Option<f64>> {
        let count = ((self.reach() + 2.0 * BEFORE) / FINE).ceil() as usize;
        (0..=count).map(|index| self.depth(index as f64 * FINE - BEFORE)).collect()
    }

    /// The description for `--tool`.
    pub fn description(&self) -> String {
        let Edge { nose, direction, width, trailing, length } = self;
        match width {
            0.0 => format!("Q{direction}R{nose}A{trailing}S{length}"),
            _ => format!("Q{direction}R{nose}W{width}"),
        }
    }
}

/// A motion of a job.
pub struct Motion {
    /// Its line of the program.
    pub line: u32,
    /// At rapid traverse.
    pub rapid: bool,
    /// The spindle turns.
    pub turning: bool,
    /// Number of the tool, from 0.
    pub tool: usize,
    /// Z and radius of the tip on its way, mm.
    pub points: Vec<[f64; 2]>,
}

/// A job.
pub struct Sample {
    /// Its text.
    pub program: String,
    /// By their numbers less 1.
    pub tools: Vec<Edge>,
    /// In the order of the program.
    pub motions: Vec<Motion>,
    lines: u32,
    at: [f64; 2],
    turning: bool,
}

impl Sample {
    /// A random job in a tube from Z0 down, mm.
    pub fn new(seed: u64, [bore, outside, length]: [f64; 3]) -> Sample {
        let mut dice = Dice::new(seed);
        let mut sample = Sample {
            program: String::new(),
            tools: Vec::new(),
            motions: Vec::new(),
            lines: 0,
            at: [0.0; 2],
            turning: true,
        };
        sample.block("G21 G99 G18 G40");
        for number in 1..=3 {
            let inside = dice.below(3) == 0;
            sample.tool(&mut dice, number, inside);
            let middle = (bore + outside) / 2.0;
            let [low, high] =
                if inside { [bore - 1.0, middle - 1.0] } else { [middle + 1.0, outside + 1.0] };
            let clear = if inside { bore - 2.0 } else { outside + 3.0 };
            for _ in 0..2 + dice.below(3) {
                sample.pass(&mut dice, [low, high, clear], length);
            }
            sample.go(true, [50.0, sample.at[1]]);
        }
        sample.block("M30");
        sample
    }

    fn block(&mut self, text: &str) {
        writeln!(self.program, "{text}").expect("a text");
        self.lines += 1;
    }

    fn tool(&mut self, dice: &mut Dice, number: usize, inside: bool) {
        let nose = [0.0, 0.4, 0.8][dice.below(3)];
        let width = if dice.below(3) == 0 { 3.0 } else { 0.0 };
        let direction = if inside { 2 } else { 3 };
        let trailing = dice.between(3.0, 35.0);
        self.tools.push(Edge { nose, direction, width, trailing, length: dice.between(4.0, 9.0) });
        self.block(&format!("T0{number}0{number}"));
        self.turning = dice.below(6) > 0;
        self.block(if self.turning { "G97 S900 M3" } else { "M5" });
        self.at = [50.0, if inside { 2.0 } else { 60.0 }];
        self.block(&format!("G0 X{:.2} Z50.", 2.0 * self.at[1]));
    }

    /// Down to a radius, along the part, over a cone or an arc, off, and back at rapid traverse, at
    /// times too early.
    fn pass(&mut self, dice: &mut Dice, [low, high, clear]: [f64; 3], length: f64) {
        let radius = dice.between(low, high);
        self.go(true, [2.0, clear]);
        self.go(true, [2.0, radius]);
        let mut z = -dice.between(2.0, length * 0.6);
        self.go(false, [z, radius]);
        let step = if clear > radius { 1.5 } else { -1.5 };
        z -= 3.0;
        match dice.below(3) {
            0 => self.go(false, [z, radius + step]),
            1 => self.arc([z, radius + step], dice.between(2.5, 6.0), dice.below(2) == 0),
            _ => {}
        }
        if dice.below(4) > 0 {
            self.go(true, [self.at[0], clear]);
        }
        self.go(true, [2.0, if dice.below(2) == 0 { clear } else { self.at[1] }]);
    }

    fn go(&mut self, rapid: bool, to: [f64; 2]) {
        let word = if rapid { "G0" } else { "G1" };
        let feed = if rapid { "" } else { " F0.2" };
        self.block(&format!("{word} X{:.2} Z{:.2}{feed}", 2.0 * to[1], to[0]));
        let from = self.at;
        let way = (to[0] - from[0]).hypot(to[1] - from[1]);
        let count = (way / STEP).ceil().max(1.0);
        let point = |index: u32| {
            let share = f64::from(index) / count;
            [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
        };
        self.note(rapid, (0..=count as u32).map(point).collect(), to);
    }

    /// An arc by its radius, less than a half circle.
    fn arc(&mut self, to: [f64; 2], radius: f64, clockwise: bool) {
        let word = if clockwise { "G2" } else { "G3" };
        self.block(&format!("{word} X{:.2} Z{:.2} R{radius:.2} F0.2", 2.0 * to[1], to[0]));
        let from = self.at;
        let chord = [to[0] - from[0], to[1] - from[1]];
        let half = chord[0].hypot(chord[1]) / 2.0;
        let off = (radius * radius - half * half).max(0.0).sqrt() / (2.0 * half);
        // Z to the right and X up: clockwise has its center at the right of the way.
        let side = if clockwise { 1.0 } else { -1.0 };
        let center = [
            (from[0] + to[0]) / 2.0 + side * chord[1] * off,
            (from[1] + to[1]) / 2.0 - side * chord[0] * off,
        ];
        let angle = |at: [f64; 2]| (at[1] - center[1]).atan2(at[0] - center[0]);
        let (first, mut turn) = (angle(from), angle(to) - angle(from));
        let tau = std::f64::consts::TAU;
        turn = if clockwise { -((-turn).rem_euclid(tau)) } else { turn.rem_euclid(tau) };
        let count = (radius * turn.abs() / STEP).ceil().max(1.0);
        let point = |index: u32| {
            let (sine, cosine) = (first + turn * f64::from(index) / count).sin_cos();
            [center[0] + radius * cosine, center[1] + radius * sine]
        };
        self.note(false, (0..=count as u32).map(point).collect(), to);
    }

    fn note(&mut self, rapid: bool, points: Vec<[f64; 2]>, to: [f64; 2]) {
        self.at = to;
        let tool = self.tools.len() - 1;
        self.motions.push(Motion { line: self.lines, rapid, turning: self.turning, tool, points });
    }
}

/// What is left, as the judge sees it: of each disk the least and the most that its inner and outer radius may be.
pub struct Turned {
    middles: Vec<f64>,
    /// Inner and outer radius, each from the least to the most.
    pub disks: Vec<[[f64; 2]; 2]>,
}

impl Turned {
    /// A tube with these middles of its disks.
    pub fn new(middles: Vec<f64>, [bore, outside]: [f64; 2]) -> Turned {
        let disks = vec![[[bore, bore], [outside, outside]]; middles.len()];
        Turned { middles, disks }
    }

    /// Cuts; says whether a touch must be found, and whether it may be, by a margin in mm.
    pub fn cut(&mut self, motion: &Motion, edge: &Edge, margin: f64) -> [bool; 2] {
        let inside = edge.direction == 2;
        let side = if inside { -1.0 } else { 1.0 };
        let mut said = [false; 2];
        let table = edge.table();
        let depth = |along: f64| table[((along + BEFORE) / FINE).round() as usize];
        for (z, disk) in self.middles.iter().zip(&mut self.disks) {
            // The nearest that the edge surely comes, and perhaps; counted away from the side that is cut.
            let (mut surely, mut perhaps) = (f64::INFINITY, f64::INFINITY);
            for [at, tip] in &motion.points {
                let along = z - at;
                if !(-WIDER..=edge.reach() + WIDER).contains(&along) {
                    continue;
                }
                let three = [-WIDER, 0.0, WIDER].map(|off| depth(along + off));
                let least = three.iter().flatten().copied().fold(f64::INFINITY, f64::min);
                perhaps = perhaps.min(tip * side + least - WIDER);
                if let [Some(a), Some(b), Some(c)] = three {
                    surely = surely.min(tip * side + a.max(b).max(c) + WIDER);
                }
            }
            let [inner, outer] = disk;
            if inner[1] >= outer[0] {
                continue;
            }
            let (now, bound) = if inside { (inner, -outer[0]) } else { (outer, inner[1]) };
            let (mut left, mut most) = ([now[0] * side, now[1] * side], [0.0; 2]);
            if inside {
                left.swap(0, 1);
            }
            said[0] |= surely + margin < left[0];
            said[1] |= perhaps < left[1];
            most[0] = left[0].min(perhaps).max(bound);
            most[1] = left[1].min(surely).max(bound);
            *now = if inside { [-most[1], -most[0]] } else { most };
        }
        said
    }
}
