//! Programs of four and five axes under construction.

use fil_machine::axis_chain::AxisChain;
use fil_nc::forward::Forward;
use nalgebra::{Point3, Rotation3, Unit, Vector3};

use super::mixed::Family;
use super::numbers::Random;

/// A line of a CL file, and where the tool shall come to, mm.
#[derive(Clone)]
pub struct Line {
    /// As it stands in the file.
    pub text: String,
    /// The tip and the tool axis.
    pub target: Option<(Point3<f64>, Vector3<f64>)>,
}

/// A program under construction.
pub(super) struct Maker<'a> {
    pub(super) random: Random,
    chain: &'a AxisChain,
    forward: Forward,
    /// Lengths are divided by it.
    pub(super) unit: f64,
    lines: Vec<Line>,
    /// Where the tool stands, mm, and the rotary axes, degrees.
    pub(super) at: Point3<f64>,
    pub(super) angles: [f64; 2],
    /// What TRANS adds to points, mm.
    pub(super) shift: Vector3<f64>,
    /// The control whose texts are mixed in.
    mixed: Option<Family>,
}

impl Maker<'_> {
    pub(super) fn say(&mut self, text: impl Into<String>) {
        self.lines.push(Line { text: text.into(), target: None });
    }

    pub(super) fn axis(&self) -> Vector3<f64> {
        self.forward.axis(self.angles)
    }

    pub(super) fn numbers(&self, point: Point3<f64>) -> String {
        let [x, y, z] = [point.x, point.y, point.z].map(|value| value / self.unit);
        format!("{x:.9}, {y:.9}, {z:.9}")
    }

    /// GOTO `off` along the tool from where it is meant to stand.
    pub(super) fn goto(&mut self, off: f64) {
        let (point, axis) = (self.at + self.axis() * off, self.axis());
        let text = format!(
            "GOTO / {}, {:.10}, {:.10}, {:.10}",
            self.numbers(point),
            axis.x,
            axis.y,
            axis.z
        );
        self.aim(text, point, axis);
    }

    /// A line that brings the tool to a point.
    pub(super) fn aim(&mut self, text: String, point: Point3<f64>, axis: Vector3<f64>) {
        self.lines.push(Line { text, target: Some((point + self.shift, axis)) });
    }

    pub(super) fn rapid(&mut self, off: f64) {
        self.say("RAPID");
        self.goto(off);
    }

    /// Turns the rotary axes by up to so many degrees, within their travel.
    pub(super) fn turn(&mut self, most: f64) {
        for n in 0..2 {
            let Some(rotary) = &self.chain.rotaries[n] else { continue };
            let to = self.angles[n] + self.random.between(-most, most);
            self.angles[n] =
                to.max(rotary.min.unwrap_or(f64::MIN)).min(rotary.max.unwrap_or(f64::MAX));
        }
    }

    pub(super) fn step(&mut self, most: f64) {
        for n in 0..3 {
            self.at[n] += self.random.between(-most, most);
        }
    }

    pub(super) fn feed(&mut self) {
        let feed = self.random.between(50.0, 2000.0);
        match self.unit {
            1.0 => self.say(format!("FEDRAT / {feed:.1}, MMPM")),
            _ => self.say(format!("FEDRAT / {:.2}, IPM", feed / 25.4)),
        }
    }

    /// A quarter of a circle about the tool.
    pub(super) fn arc(&mut self) {
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

    pub(super) fn hole(&mut self) {
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
                line.target = Some((self.at + self.shift - axis * depth, axis));
            }
            // The next hole of the same face.
            let across = self.axis().cross(&Vector3::new(0.2, 0.9, 0.4)).normalize();
            self.at += across * self.random.between(3.0, 30.0);
        }
        self.say("CYCLE / OFF");
        self.rapid(20.0);
    }

    /// Upright motions without a tool axis.
    pub(super) fn upright(&mut self) {
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
            self.aim(text, self.at, Vector3::z());
        }
        self.say("MULTAX / ON");
        self.rapid(80.0);
    }

    /// Up to the machine's own level, and to another place.
    pub(super) fn retract(&mut self) {
        self.say("RETRCT");
        self.turn(60.0);
        self.step(40.0);
        self.rapid(80.0);
        self.goto(0.0);
    }

    pub(super) fn section(&mut self, number: usize) {
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
            if let Some(family) = self.mixed
                && self.random.happens(0.2)
            {
                self.mix(family);
            }
        }
        self.rapid(80.0);
    }
}

/// The lines of a program of a machine, with everything that may stand between motions where the
/// family of its control is given.
pub fn program(chain: &AxisChain, random: Random, mixed: Option<Family>) -> Vec<Line> {
    let mut maker = Maker {
        random,
        chain,
        forward: Forward::new(chain.clone()),
        unit: 1.0,
        lines: Vec::new(),
        at: Point3::origin(),
        angles: [0.0; 2],
        shift: Vector3::zeros(),
        mixed,
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
