//! A judge of `fil-stock` that shares nothing with it: random jobs as NC programs, whose paths are
//! sampled densely and whose tools are looked up point by point.
//!
//! Two models bracket the truth: one cut by slightly smaller tools at the samples alone, which leaves
//! too much, and one cut by tools that are larger by the distance of samples, which leaves too
//! little.

use std::fmt::Write;

/// Distance of samples along a path, mm.
const STEP: f64 = 0.01;

/// What the larger tools have more, mm.
const MORE: f64 = 0.02;

/// What the smaller tools have less, mm: more than chords leave an arc by.
const LESS: f64 = 0.01;

/// Random numbers (xorshift).
pub struct Dice(u64);

impl Dice {
    /// Dice with a seed.
    pub fn new(seed: u64) -> Dice {
        Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// From 0 to 1.
    pub fn share(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A value with two decimals.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        ((low + (high - low) * self.share()) * 100.0).round() / 100.0
    }

    /// From 0 to below a number.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.share() * count as f64) as usize).min(count - 1)
    }
}

/// A tool, mm.
#[derive(Clone, Copy, Debug)]
pub struct Cutter {
    /// Diameter.
    pub diameter: f64,
    /// Corner radius.
    pub corner: f64,
    /// Point angle, degrees; 0 for none.
    pub point: f64,
    /// Length to the holder.
    pub length: f64,
    /// Diameter of the holder.
    pub holder: f64,
}

impl Cutter {
    /// Whether the tool, larger by a length everywhere, has material at this distance from its axis,
    /// and from which height over its tip on.
    fn surface(&self, distance: f64, more: f64) -> Option<f64> {
        let radius = self.diameter / 2.0 + more;
        if distance > radius {
            return None;
        }
        if self.point > 0.0 {
            let half = (self.point / 2.0).to_radians();
            return Some(distance / half.tan() - more / half.sin());
        }
        let corner = self.corner + more.max(-self.corner);
        let center = self.diameter / 2.0 - self.corner;
        if distance <= center {
            return Some(-more);
        }
        let out = (distance - center).min(corner);
        Some(self.corner - (corner * corner - out * out).sqrt())
    }

    /// The description for `--tool`.
    pub fn description(&self) -> String {
        let point =
            if self.point > 0.0 { format!("A{}", self.point) } else { format!("R{}", self.corner) };
        format!("D{}{point}L{}H{}x50", self.diameter, self.length, self.holder)
    }
}

/// A motion of a job: through these points, close to each other, at its line of the program.
pub struct Motion {
    /// Its line.
    pub line: u32,
    /// At rapid traverse.
    pub rapid: bool,
    /// The spindle turns.
    pub turning: bool,
    /// Number of the tool.
    pub tool: usize,
    /// The tip on its way, mm.
    pub points: Vec<[f64; 3]>,
}

/// A job: its program, and its motions as the judge sees them.
pub struct Sample {
    /// Its text.
    pub program: String,
    /// By their numbers from 1.
    pub tools: Vec<Cutter>,
    /// In the order of the program.
    pub motions: Vec<Motion>,
    /// Lines so far.
    lines: u32,
}

impl Sample {
    /// A random job in stock from 0 to these sides, its top at Z0.
    pub fn new(seed: u64, sides: [f64; 2]) -> Sample {
        let mut dice = Dice::new(seed);
        let mut sample =
            Sample { program: String::new(), tools: Vec::new(), motions: Vec::new(), lines: 0 };
        sample.block("G21 G90 G94 G17 G40 G80");
        for number in 1..=2 + dice.below(2) {
            sample.tool(&mut dice, number, sides);
        }
        sample.block("M30");
        sample
    }

    fn block(&mut self, text: &str) {
        writeln!(self.program, "{text}").expect("a text");
        self.lines += 1;
    }

    fn tool(&mut self, dice: &mut Dice, number: usize, sides: [f64; 2]) {
        let diameter = [4.0, 6.0, 8.0, 10.0][dice.below(4)];
        let kind = dice.below(4);
        let cutter = Cutter {
            diameter,
            corner: [0.0, 0.5, diameter / 2.0, 0.0][kind],
            point: if kind == 3 { [90.0, 118.0][dice.below(2)] } else { 0.0 },
            length: dice.between(6.0, 14.0),
            holder: diameter + dice.between(4.0, 12.0),
        };
        self.tools.push(cutter);
        let mut at = [dice.between(-5.0, sides[0]), dice.between(-5.0, sides[1]), 20.0];
        self.block(&format!("T{number} M6"));
        self.block(&format!("G0 X{:.2} Y{:.2}", at[0], at[1]));
        self.block(&format!("G43 Z20. H{number}"));
        // The rapid down from where the machine has changed the tool.
        self.push(number, true, false, vec![at]);
        let mut turning = dice.below(6) > 0;
        // A spindle that nothing stops turns on: a change alone says nothing of it.
        self.block(if turning { "S900 M3" } else { "S900 M5" });
        for _ in 0..8 + dice.below(10) {
            let to = [
                dice.between(-8.0, sides[0] + 8.0),
                dice.between(-8.0, sides[1] + 8.0),
                if dice.below(3) == 0 {
                    dice.between(0.5, 10.0)
                } else {
                    dice.between(-12.0, -0.5)
                },
            ];
            match dice.below(8) {
                0 => {
                    let up = [at[0], at[1], 10.0];
                    self.go(number, true, turning, &mut at, up);
                    let over = [to[0], to[1], 10.0];
                    self.go(number, true, turning, &mut at, over);
                }
                1 => self.go(number, true, turning, &mut at, to),
                2 => {
                    let level = [to[0], to[1], at[2]];
                    self.go(number, false, turning, &mut at, level);
                }
                3 => {
                    let down = [at[0], at[1], to[2]];
                    self.go(number, false, turning, &mut at, down);
                }
                4 => self.arc(dice, number, turning, &mut at),
                5 => {
                    turning = !turning;
                    self.block(if turning { "M3" } else { "M5" });
                }
                _ => self.go(number, false, turning, &mut at, to),
            }
        }
        let up = [at[0], at[1], 20.0];
        self.go(number, true, turning, &mut at, up);
    }

    fn go(&mut self, tool: usize, rapid: bool, turning: bool, at: &mut [f64; 3], to: [f64; 3]) {
        let [x, y, z] = to;
        let word = if rapid { "G0" } else { "G1 F300." };
        self.block(&format!("{word} X{x:.2} Y{y:.2} Z{z:.2}"));
        let length =
            (0..3).map(|axis| (to[axis] - at[axis]) * (to[axis] - at[axis])).sum::<f64>().sqrt();
        let count = (length / STEP).ceil().max(1.0) as usize;
        let point = |index: usize| {
            let share = index as f64 / count as f64;
            [0, 1, 2].map(|axis| at[axis] + (to[axis] - at[axis]) * share)
        };
        let points = (0..=count).map(point).collect();
        self.push(tool, rapid, turning, points);
        *at = to;
    }

    /// A quarter, half, three quarters or a whole turn, level or as a helix.
    fn arc(&mut self, dice: &mut Dice, tool: usize, turning: bool, at: &mut [f64; 3]) {
        let arm = [dice.between(-9.0, 9.0), dice.between(1.0, 9.0)];
        let center = [at[0] + arm[0], at[1] + arm[1]];
        let quarters = 1 + dice.below(4);
        let ccw = dice.below(2) == 0;
        let rise = if dice.below(2) == 0 { 0.0 } else { dice.between(-3.0, 1.0) };
        let mut spoke = [-arm[0], -arm[1]];
        let start = spoke;
        for _ in 0..quarters {
            spoke = if ccw { [-spoke[1], spoke[0]] } else { [spoke[1], -spoke[0]] };
        }
        let to = [center[0] + spoke[0], center[1] + spoke[1], at[2] + rise];
        let word = if ccw { "G3" } else { "G2" };
        let end =
            if quarters == 4 { String::new() } else { format!(" X{:.2} Y{:.2}", to[0], to[1]) };
        self.block(&format!("{word}{end} Z{:.2} I{:.2} J{:.2} F300.", to[2], arm[0], arm[1]));
        let angle = quarters as f64 * std::f64::consts::FRAC_PI_2 * if ccw { 1.0 } else { -1.0 };
        let length = angle.abs() * arm[0].hypot(arm[1]) + rise.abs();
        let count = (length / STEP).ceil() as usize;
        let from = at[2];
        let point = |index: usize| {
            let share = index as f64 / count as f64;
            let (sine, cosine) = (angle * share).sin_cos();
            [
                center[0] + start[0] * cosine - start[1] * sine,
                center[1] + start[0] * sine + start[1] * cosine,
                from + rise * share,
            ]
        };
        let points = (0..=count).map(point).collect();
        self.push(tool, false, turning, points);
        *at = to;
    }

    fn push(&mut self, tool: usize, rapid: bool, turning: bool, points: Vec<[f64; 3]>) {
        self.motions.push(Motion { line: self.lines, rapid, turning, tool, points });
    }
}

/// What a motion does for sure, or may do.
#[derive(Clone, Copy, Debug, Default)]
pub struct Verdict {
    /// It must be found.
    pub must: bool,
    /// It may be found; where this is false, nothing may be.
    pub may: bool,
}

/// What a motion does: rapid in stock or cutting with a stopped spindle, holder, part.
#[derive(Clone, Copy, Debug, Default)]
pub struct Verdicts {
    /// The tool touches material.
    pub touch: Verdict,
    /// The holder does.
    pub holder: Verdict,
    /// The tool is below the part.
    pub part: Verdict,
}

/// The two models of the stock over the same points.
pub struct Model {
    /// The points, with their columns and rows.
    columns: Vec<f64>,
    rows: Vec<f64>,
    /// Cut by smaller tools at the samples.
    pub most: Vec<f64>,
    /// Cut by larger tools.
    pub least: Vec<f64>,
    bottom: f64,
    part: fn(f64, f64) -> f64,
}

impl Model {
    /// Stock up to Z0 over these X and Y; `part` gives the height of the part.
    pub fn new(columns: Vec<f64>, rows: Vec<f64>, bottom: f64, part: fn(f64, f64) -> f64) -> Model {
        let cells = columns.len() * rows.len();
        Model { columns, rows, most: vec![0.0; cells], least: vec![0.0; cells], bottom, part }
    }

    /// Cuts with a motion; `margin` is what a finding may be off by, mm.
    pub fn cut(&mut self, motion: &Motion, cutter: &Cutter, margin: f64) -> Verdicts {
        let mut verdicts = Verdicts::default();
        let vertical = motion.points.iter().all(|point| point[..2] == motion.points[0][..2]);
        let before = (self.most.clone(), self.least.clone());
        if !vertical {
            self.holder(motion, cutter, margin, &mut verdicts.holder);
        }
        for point in &motion.points {
            self.around(*point, cutter.diameter / 2.0 + MORE, |model, cell, distance, part| {
                if let Some(surface) = cutter.surface(distance, MORE) {
                    let surface = point[2] + surface;
                    verdicts.touch.may |= surface < before.0[cell];
                    verdicts.part.may |= surface < part.min(before.0[cell]);
                    model.least[cell] = model.least[cell].min(surface.max(model.bottom));
                }
                if let Some(surface) = cutter.surface(distance, -LESS) {
                    let surface = point[2] + surface;
                    model.most[cell] = model.most[cell].min(surface.max(model.bottom));
                }
                if let Some(surface) = cutter.surface(distance, -margin) {
                    let surface = point[2] + surface;
                    let has = before.1[cell] > model.bottom;
                    verdicts.touch.must |= has && surface + margin < before.1[cell];
                }
                if let Some(surface) = cutter.surface(distance, -2.0 * margin) {
                    let surface = point[2] + surface;
                    let has = before.1[cell] > model.bottom;
                    verdicts.part.must |= has && surface + margin < part.min(before.1[cell]);
                }
            });
        }
        if vertical {
            self.holder(motion, cutter, margin, &mut verdicts.holder);
        }
        verdicts
    }

    fn holder(&mut self, motion: &Motion, cutter: &Cutter, margin: f64, verdict: &mut Verdict) {
        let radius = cutter.holder / 2.0;
        for point in &motion.points {
            let height = point[2] + cutter.length;
            self.around(*point, radius + MORE, |model, cell, distance, _| {
                let solid = model.least[cell] > model.bottom;
                verdict.may |= height - MORE < model.most[cell];
                verdict.must |=
                    solid && distance < radius - margin && height + margin < model.least[cell];
            });
        }
    }

    /// The points around a tool, each with its distance and the height of the part there.
    fn around(
        &mut self,
        at: [f64; 3],
        radius: f64,
        mut each: impl FnMut(&mut Model, usize, f64, f64),
    ) {
        let step = self.columns[1] - self.columns[0];
        let first = |values: &[f64], center: f64| {
            (((center - radius - values[0]) / step).floor().max(0.0) as usize).min(values.len())
        };
        for row in first(&self.rows, at[1])..self.rows.len() {
            let y = self.rows[row];
            if y > at[1] + radius {
                break;
            }
            for column in first(&self.columns, at[0])..self.columns.len() {
                let x = self.columns[column];
                if x > at[0] + radius {
                    break;
                }
                let distance = (x - at[0]).hypot(y - at[1]);
                let part = (self.part)(x, y);
                each(self, row * self.columns.len() + column, distance, part);
            }
        }
    }
}
