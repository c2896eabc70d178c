//! CL of random parts for a mill-turn machine: turning, holes along Z and square to it, milling in
//! polar interpolation, grooves on a cylinder.

use std::fmt::Write;

use crate::programs::Dice;

/// CL of a random part.
pub struct Part {
    text: String,
    mills: bool,
    /// The machine taps by live tools.
    taps: bool,
    /// The machine brings live taps in step.
    rigid: bool,
    /// Inches are millimetres less a factor.
    scale: f64,
    feeds: [&'static str; 2],
}

impl Part {
    /// With live taps.
    pub fn random(seed: u64) -> String {
        Part::of_machine(seed, true)
    }

    /// Of a machine with live taps or without them.
    pub fn of_machine(seed: u64, taps: bool) -> String {
        let mut dice = Dice::from_seed(seed);
        let inch = dice.once_in(4);
        let mut part = Part {
            text: if inch { "UNITS / INCHES\n" } else { "UNITS / MM\n" }.to_string(),
            mills: false,
            taps,
            rigid: seed % 2 == 1,
            scale: if inch { 1.0 / 25.4 } else { 1.0 },
            feeds: if inch { ["IPM", "IPR"] } else { ["MMPM", "MMPR"] },
        };
        for _ in 0..1 + dice.below(5) {
            match dice.below(5) {
                0 => part.turn(&mut dice),
                1 => part.axial_holes(&mut dice),
                2 => part.radial_holes(&mut dice),
                3 => part.contour(&mut dice),
                _ => part.groove(&mut dice),
            }
        }
        part.text.push_str("FINI\n");
        part.text
    }

    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    fn goto(&mut self, point: [f64; 3]) {
        let [x, y, z] = point.map(|value| value * self.scale);
        writeln!(self.text, "GOTO / {x:.6}, {y:.6}, {z:.6}").unwrap();
    }

    /// A point on a radius at an angle, with the tool looking at the axis.
    fn goto_around(&mut self, radius: f64, angle: f64, z: f64) {
        let (sine, cosine) = libm::sincos(angle.to_radians());
        let [x, y, z] = [radius * cosine, radius * sine, z].map(|value| value * self.scale);
        writeln!(self.text, "GOTO / {x:.6}, {y:.6}, {z:.6}, {cosine:.9}, {sine:.9}, 0").unwrap();
    }

    fn begin(&mut self, dice: &mut Dice<'_>, mills: bool) {
        if self.mills != mills {
            let mode = if mills { "MODE / MILL" } else { "MODE / TURN" };
            self.line(mode);
            self.mills = mills;
        }
        let tool = 1 + dice.below(12);
        self.line(&format!("LOADTL / {tool}"));
        let direction = dice.pick(&["CLW", "CCLW"]).to_string();
        self.line(&format!("SPINDL / RPM, {}, {direction}", 300 + dice.below(3000)));
    }

    fn turn(&mut self, dice: &mut Dice<'_>) {
        self.begin(dice, false);
        let per_turn = self.feeds[1];
        self.line(&format!("FEDRAT / {:.4}, {per_turn}", dice.between(0.1, 0.4) * self.scale));
        let radius = dice.between(5.0, 30.0);
        self.line("RAPID");
        self.goto([radius, 0.0, 3.0]);
        self.goto([radius, 0.0, -dice.between(5.0, 40.0)]);
        self.goto([radius + 4.0, 0.0, -45.0]);
        self.line("RAPID");
        self.goto([60.0, 0.0, 60.0]);
    }

    fn cycle(&mut self, dice: &mut Dice<'_>) {
        let kind = ["DRILL", "DEEP", "BRKCHP", "TAP"][dice.below(4)];
        if kind == "TAP" && self.taps {
            return self.tap(dice);
        }
        let kind = if kind == "TAP" { "DRILL" } else { kind };
        let (depth, step) = (dice.between(3.0, 15.0), dice.between(1.0, 6.0));
        let [depth, step, clear] = [depth, step, 2.0].map(|value| value * self.scale);
        let step = if kind == "DRILL" { String::new() } else { format!("STEP, {step:.4}, ") };
        let (feed, unit) = (dice.between(40.0, 200.0) * self.scale, self.feeds[0]);
        let back = if dice.once_in(3) { ", RETURN, 0" } else { "" };
        self.line(&format!(
            "CYCLE / {kind}, DEPTH, {depth:.4}, {step}{unit}, {feed:.2}, CLEAR, {clear:.4}{back}"
        ));
    }

    /// Taps by a lead, with the live tool turning clockwise.
    fn tap(&mut self, dice: &mut Dice<'_>) {
        let speed = 100 + dice.below(900);
        let (depth, clear) = (dice.between(3.0, 15.0) * self.scale, 3.0 * self.scale);
        let lead = match dice.once_in(2) {
            true => format!("TPI, {}", 8 + dice.below(40)),
            false => format!("{}, {:.4}", self.feeds[1], dice.between(0.5, 2.5) * self.scale),
        };
        self.line(&format!("SPINDL / RPM, {speed}, CLW"));
        let high = if self.rigid && dice.once_in(2) { "HIGH, " } else { "" };
        self.line(&format!("CYCLE / TAP, {high}DEPTH, {depth:.4}, {lead}, CLEAR, {clear:.4}"));
    }

    fn axial_holes(&mut self, dice: &mut Dice<'_>) {
        self.begin(dice, true);
        let radius = dice.between(4.0, 40.0);
        self.line("RAPID");
        self.goto([radius, 0.0, 5.0]);
        self.cycle(dice);
        for _ in 0..1 + dice.below(4) {
            let (sine, cosine) = libm::sincos(dice.between(-3.1, 3.1));
            self.goto([radius * cosine, radius * sine, 0.0]);
        }
        self.line("CYCLE / OFF");
    }

    fn radial_holes(&mut self, dice: &mut Dice<'_>) {
        self.begin(dice, true);
        self.line("MULTAX / ON");
        let radius = dice.between(18.0, 60.0);
        let mut angle = dice.between(-180.0, 180.0);
        let z = -dice.between(1.0, 30.0);
        self.line("RAPID");
        self.goto_around(radius + 5.0, angle, z);
        self.cycle(dice);
        for _ in 0..1 + dice.below(4) {
            self.goto_around(radius, angle, z - dice.between(0.0, 5.0));
            angle += dice.between(-170.0, 170.0);
        }
        self.line("CYCLE / OFF");
        self.line("RAPID");
        self.goto_around(radius + 20.0, angle, z);
        self.line("MULTAX / OFF");
    }

    /// A contour around the axis: lines no nearer than the least radius, and an arc.
    fn contour(&mut self, dice: &mut Dice<'_>) {
        self.begin(dice, true);
        let side = dice.between(6.0, 25.0);
        let turned = dice.between(-3.1, 3.1);
        let corner = |number: usize| {
            let (sine, cosine) = libm::sincos(turned + number as f64 * 1.1);
            [side * cosine, side * sine]
        };
        let [x, y] = corner(0);
        self.line("RAPID");
        self.goto([x, y, 5.0]);
        let (feed, unit) = (dice.between(50.0, 400.0) * self.scale, self.feeds[0]);
        self.line(&format!("FEDRAT / {feed:.2}, {unit}"));
        self.goto([x, y, -2.0]);
        let mut last = [x, y];
        for number in 1..2 + dice.below(5) {
            let [x, y] = corner(number);
            self.goto([x, y, -2.0]);
            last = [x, y];
            if dice.once_in(3) {
                // An arc about the axis to the next corner.
                let [radius, depth] = [side, -2.0].map(|value| value * self.scale);
                self.line(&format!("CIRCLE / 0, 0, {depth:.6}, 0, 0, 1, {radius:.6}"));
                let (sine, cosine) = libm::sincos(turned + number as f64 * 1.1 + 0.7);
                last = [side * cosine, side * sine];
                self.goto([last[0], last[1], -2.0]);
                break;
            }
        }
        self.line("RAPID");
        self.goto([last[0], last[1], 5.0]);
    }

    fn groove(&mut self, dice: &mut Dice<'_>) {
        self.begin(dice, true);
        self.line("MULTAX / ON");
        let radius = dice.between(10.0, 50.0);
        let mut angle = dice.between(-180.0, 180.0);
        let mut z = -dice.between(1.0, 20.0);
        self.line("RAPID");
        self.goto_around(radius + 5.0, angle, z);
        let (feed, unit) = (dice.between(50.0, 400.0) * self.scale, self.feeds[0]);
        self.line(&format!("FEDRAT / {feed:.2}, {unit}"));
        self.goto_around(radius, angle, z);
        let way = if dice.once_in(2) { 1.0 } else { -1.0 };
        for _ in 0..2 + dice.below(8) {
            angle += way * dice.between(0.5, 4.0);
            z -= dice.between(0.0, 1.0);
            self.goto_around(radius, angle, z);
        }
        self.line("RAPID");
        self.goto_around(radius + 5.0, angle, z);
        self.line("MULTAX / OFF");
    }
}
