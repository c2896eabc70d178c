//! Making random programs: mostly such as a CAM system would write, with what
//! usually goes wrong put in between.

use crate::path::{Axis, Point, Unit};
use crate::programs::Dice;

use super::features::{FEATURES, Feature};
use super::geometry::add;
use super::model_motion::ends;
use super::setup::Setup;
use super::statement::{
    ArcShape, CoolantCommand, Feedrate, SpindleCommand, Statement, least_apart,
};

/// A program and the machine it is for.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The machine.
    pub setup: Setup,
    /// What the CL file says.
    pub statements: Vec<Statement>,
}

/// Texts that change the modes of the control.
const TEXTS: &[&str] = &[
    "G91", "G90", "G18", "G19", "G17", "G2", "G3", "G1", "G0", "G95", "G94", "F50.", "S700", "M8",
    "M9", "M5", "G54", "G80", "G98", "G99", "G4 P1.5", "M0", "(A NOTE)",
];

/// Codes that PREFUN gives.
const PREFUNS: &[u32] = &[91, 90, 18, 19, 17, 2, 3, 0, 1, 95, 80, 98, 99];

/// Blocks of POSTN without a motion.
const POSTNS: &[&[(char, f64)]] =
    &[&[('G', 91.0)], &[('G', 18.0)], &[('G', 2.0)], &[('F', 77.0)], &[('G', 1.0), ('F', 33.0)]];

/// Draws a program.
pub fn program(seed: u64) -> Program {
    let mut dice = Dice::from_seed(seed);
    let setup = Setup::random(&mut dice);
    let features: Vec<Feature> = FEATURES
        .iter()
        .filter(|(_, times)| dice.once_in(*times))
        .map(|(feature, _)| *feature)
        .collect();
    let mut maker = Maker::new(dice, setup, features);
    maker.begin();
    for _ in 0..3 + maker.dice.below(9) {
        maker.section();
    }
    Program { setup: maker.setup, statements: maker.statements }
}

pub(super) struct Maker {
    pub(super) dice: Dice<'static>,
    pub(super) setup: Setup,
    features: Vec<Feature>,
    statements: Vec<Statement>,
    /// Lengths are so many CL units to the millimetre.
    pub(super) size: f64,
    /// Where the tool is, in CL units.
    pub(super) at: Point,
    pub(super) compensated: bool,
    /// The spindle turns; the interpreter feeds a revolution only then.
    pub(super) turns: bool,
    /// The feed of FEDRAT is one a revolution.
    pub(super) per_revolution: bool,
}

impl Maker {
    fn new(dice: Dice<'static>, setup: Setup, features: Vec<Feature>) -> Self {
        let size = 1.0 / setup.unit.in_mm();
        Maker {
            dice,
            setup,
            features,
            statements: Vec::new(),
            size,
            at: [0.0; 3],
            compensated: false,
            turns: false,
            per_revolution: false,
        }
    }

    pub(super) fn has(&self, feature: Feature) -> bool {
        self.features.contains(&feature)
    }

    pub(super) fn say(&mut self, statement: Statement) {
        self.statements.push(statement);
    }

    /// A length drawn in mm, as the CL unit has it.
    pub(super) fn length(&mut self, low: f64, high: f64) -> f64 {
        self.dice.between(low, high) * self.size
    }

    fn begin(&mut self) {
        self.change_tool();
        self.change_feed();
    }

    fn change_feed(&mut self) {
        let feed = self.feed();
        self.per_revolution = feed.per_revolution;
        self.say(Statement::Feedrate(feed));
    }

    /// LOADTL and what follows it.
    pub(super) fn change_tool(&mut self) {
        let number = 1 + self.dice.below(9) as u32;
        let offset = self.dice.once_in(4).then(|| 10 + self.dice.below(9) as u32);
        self.say(Statement::Tool { number, offset });
        self.spindle(true);
        if self.dice.once_in(2) {
            self.say(Statement::Coolant(CoolantCommand::On));
        }
        let above = self.high_point();
        if self.rapids(20) {
            self.rapid(above);
        }
    }

    /// A rapid follows as it should; once in so many times it does not.
    pub(super) fn rapids(&mut self, times: usize) -> bool {
        !(self.dice.once_in(times) && self.has(Feature::CutsAfterFrames))
    }

    pub(super) fn spindle(&mut self, must: bool) {
        self.turns = true;
        if !must && !self.per_revolution && self.dice.once_in(5) {
            self.turns = false;
            return self.say(Statement::Spindle(SpindleCommand::Off));
        }
        let speed = 100.0 + self.dice.below(5000) as f64;
        let ccw = self.dice.once_in(4);
        self.say(Statement::Spindle(SpindleCommand::Turn { speed, ccw }));
    }

    pub(super) fn feed(&mut self) -> Feedrate {
        let per_revolution = self.turns && self.dice.once_in(6);
        let digits = if self.setup.unit == Unit::Mm { 100.0 } else { 1000.0 };
        let range = if per_revolution { (0.05, 0.6) } else { (20.0, 900.0) };
        let range = (range.0 * self.size, range.1 * self.size);
        let value = self.dice.between(range.0, range.1).max(2.0 / digits);
        Feedrate { value: (value * digits).round() / digits, per_revolution }
    }

    pub(super) fn point(&mut self) -> Point {
        [self.length(-80.0, 80.0), self.length(-80.0, 80.0), self.length(-20.0, 20.0)]
    }

    pub(super) fn high_point(&mut self) -> Point {
        [self.length(-80.0, 80.0), self.length(-80.0, 80.0), self.length(30.0, 60.0)]
    }

    pub(super) fn rapid(&mut self, to: Point) {
        self.say(Statement::Rapid(to));
        self.at = to;
    }

    pub(super) fn cut(&mut self, to: Point) {
        self.say(Statement::Feed(to));
        self.at = to;
    }

    /// A stretch of the program.
    fn section(&mut self) {
        match self.dice.below(14) {
            0..=3 => self.milling(),
            4..=6 if self.has(Feature::Cycles) => self.holes(),
            7 | 8 if self.has(Feature::Cutcom) => self.contour(),
            9 if self.has(Feature::Tools) => self.change_tool(),
            10 if self.has(Feature::Frames) && !self.compensated => self.frame(),
            11 if self.has(Feature::UnitChanges) && self.setup.ready == "fanuc-mill" => {
                self.change_unit()
            }
            12 if self.has(Feature::Skips) => self.skipped(),
            _ => self.milling(),
        }
    }

    fn milling(&mut self) {
        if self.dice.once_in(2) {
            let to = self.high_point();
            self.rapid(to);
        }
        for _ in 0..1 + self.dice.below(6) {
            self.aside();
            self.motion();
        }
    }

    /// A feed motion of some kind.
    pub(super) fn motion(&mut self) {
        match self.dice.below(6) {
            0 | 1 if self.has(Feature::Arcs) => self.arc(),
            2 if self.has(Feature::Deltas) => self.delta(),
            3 if self.has(Feature::Tiny) => self.tiny(),
            _ => {
                let point = self.point();
                let to = std::array::from_fn(|axis| {
                    if self.dice.once_in(3) { self.at[axis] } else { point[axis] }
                });
                self.cut(to);
            }
        }
    }

    fn delta(&mut self) {
        let by = [self.length(-9.0, 9.0), self.length(-9.0, 9.0), self.length(-2.0, 2.0)];
        let rapid = self.dice.once_in(4);
        self.say(Statement::Delta { by, rapid });
        self.at = add(self.at, by);
    }

    fn tiny(&mut self) {
        if self.dice.once_in(2) && self.has(Feature::Arcs) {
            let exponent = self.dice.between(-3.5, -0.5);
            let radius = libm::exp10(exponent) * self.size;
            return self.arc_of(radius);
        }
        let exponent = self.dice.between(-5.0, -1.0);
        let reach = libm::exp10(exponent);
        let by = [self.length(-reach, reach), self.length(-reach, reach), 0.0];
        let to = std::array::from_fn(|axis| self.at[axis] + by[axis]);
        self.cut(to);
    }

    pub(super) fn arc(&mut self) {
        let radius = match self.dice.below(8) {
            0 => self.length(500.0, 9000.0),
            1 => self.length(0.05, 1.0),
            _ => self.length(1.0, 60.0),
        };
        self.arc_of(radius);
    }

    pub(super) fn arc_of(&mut self, radius: f64) {
        let normal = match self.dice.below(4) {
            0 if !self.compensated => Axis::X,
            1 if !self.compensated => Axis::Y,
            _ => Axis::Z,
        };
        // No arc goes further than the table of the machine.
        let widest = (150.0 * self.size / radius).min(6.0).to_degrees();
        let fine = self.has(Feature::FineArcs);
        let narrowest = (if fine { 3e-6 } else { 0.05 * self.size } / radius).to_degrees();
        let apart = least_apart(self.size, radius);
        let sweep = match self.dice.below(8) {
            0 if widest > 300.0 => 360.0,
            1 if fine && widest > 190.0 => 180.0 + self.dice.between(-0.01, 0.01),
            2 if fine && widest > 300.0 => 360.0 - self.dice.between(1e-4, 1.0),
            3 if fine => libm::exp10(self.dice.between(-4.0, 0.0)).max(narrowest),
            _ => self.dice.between(narrowest.max(1.0).min(widest), widest),
        };
        let helix = self.dice.once_in(4) && !self.compensated;
        let turns = widest > 300.0 && helix && self.dice.once_in(2);
        let times = if turns { 1 + self.dice.below(3) as u32 } else { 0 };
        let open = times == 0 && sweep != 360.0;
        let sweep = if open { sweep.clamp(apart, 360.0 - apart) } else { sweep };
        let shape = ArcShape {
            normal,
            ccw: self.dice.once_in(2),
            radius,
            start: if self.dice.once_in(3) {
                90.0 * self.dice.below(4) as f64
            } else {
                self.dice.between(0.0, 360.0)
            },
            sweep,
            times,
            rise: if helix { self.length(-5.0, 5.0) } else { 0.0 },
        };
        self.say(Statement::Arc(shape));
        (_, self.at) = ends(&shape, self.at);
    }

    /// Something that stands between motions.
    pub(super) fn aside(&mut self) {
        match self.dice.below(24) {
            0 | 1 => self.change_feed(),
            2 => self.spindle(false),
            3 => {
                let commands = [CoolantCommand::Off, CoolantCommand::On];
                let command = commands[self.dice.below(2)];
                self.say(Statement::Coolant(command));
            }
            4 => {
                let seconds = 0.5 * (1 + self.dice.below(9)) as f64;
                self.say(Statement::Delay(seconds));
            }
            5 => {
                let stops = [Statement::Stop, Statement::OptionalStop];
                let stop = stops[self.dice.below(2)].clone();
                self.say(stop);
            }
            6 => self.say(Statement::Message("A MESSAGE")),
            7 => {
                let text = ["100, INCR, 5", "OFF", "ON"][self.dice.below(3)];
                self.say(Statement::Seqno(text));
            }
            8..=12 if self.has(Feature::Texts) => self.text(),
            13 if self.has(Feature::TextMotions) && !self.compensated => self.text_motion(),
            14 if self.has(Feature::Repeats) => {
                let value = 5.0 + self.dice.below(50) as f64;
                self.say(Statement::RepeatFeed(value));
                self.motion();
                self.motion();
                self.say(Statement::RepeatOff);
            }
            _ => {}
        }
    }

    fn text(&mut self) {
        let statement = match self.dice.below(5) {
            0 => Statement::Prefun(PREFUNS[self.dice.below(PREFUNS.len())]),
            1 => Statement::Auxfun([8, 9, 5][self.dice.below(3)]),
            2 => Statement::Postn(POSTNS[self.dice.below(POSTNS.len())]),
            _ => Statement::Insert(TEXTS[self.dice.below(TEXTS.len())]),
        };
        let stops = matches!(statement, Statement::Auxfun(5) | Statement::Insert("M5"));
        if stops && self.per_revolution {
            return;
        }
        self.turns &= !stops;
        self.say(statement);
    }

    fn text_motion(&mut self) {
        let statement = match self.dice.below(4) {
            0 => Statement::Insert("G1 X5. F50."),
            1 => Statement::Insert("G0 Z60."),
            2 => Statement::Insert("G53 G0 Z0."),
            _ => Statement::Postn(&[('G', 1.0), ('X', 5.0), ('F', 44.0)]),
        };
        self.say(statement);
    }
}
