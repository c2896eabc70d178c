//! Making random programs for a lathe: turning and facing moves, arcs, threads,
//! holes on the axis, tools with offsets, surface speeds.

use crate::path::{Axis, Point, Unit};
use crate::programs::Dice;

use super::geometry::add;
use super::make::Program;
use super::model_motion::ends;
use super::setup::Setup;
use super::statement::{
    ArcShape, CoolantCommand, CutcomCommand, CycleKind, CycleShape, Feedrate, SpindleCommand,
    Statement, Trans, least_apart,
};

/// Texts that change the modes of the control.
const TEXTS: &[&str] = &[
    "G98", "G99", "G97", "G0", "G1", "G2", "G3", "F0.77", "S700", "M8", "M9", "M5", "M0",
    "(A NOTE)", "G17",
];

/// Draws a program for a Fanuc lathe.
pub fn program(seed: u64) -> Program {
    let mut dice = Dice::from_seed(seed);
    let setup = Setup::lathe(&mut dice);
    let texts = dice.once_in(3);
    made(dice, setup, texts)
}

/// Draws a program for a lathe of LinuxCNC, which takes other texts than Fanuc's.
pub fn linuxcnc_program(seed: u64) -> Program {
    let mut dice = Dice::from_seed(seed);
    let setup = Setup::linuxcnc_lathe(&mut dice);
    made(dice, setup, false)
}

fn made(dice: Dice<'static>, setup: Setup, texts: bool) -> Program {
    let size = 1.0 / setup.unit.in_mm();
    let mut maker =
        Maker { texts, dice, setup, statements: Vec::new(), size, at: [0.0; 3], threads: false };
    maker.change_tool();
    maker.feed();
    for _ in 0..3 + maker.dice.below(9) {
        maker.section();
    }
    Program { setup: maker.setup, statements: maker.statements }
}

struct Maker {
    dice: Dice<'static>,
    setup: Setup,
    statements: Vec<Statement>,
    /// Lengths are so many CL units to the millimetre.
    size: f64,
    /// Where the tool is, in CL units.
    at: Point,
    /// Texts stand between the motions.
    texts: bool,
    /// Passes of a thread are cut, which takes turns of the spindle.
    threads: bool,
}

impl Maker {
    fn say(&mut self, statement: Statement) {
        self.statements.push(statement);
    }

    fn length(&mut self, low: f64, high: f64) -> f64 {
        self.dice.between(low, high) * self.size
    }

    fn change_tool(&mut self) {
        let number = 1 + self.dice.below(9) as u32;
        let offset = self.dice.once_in(4).then(|| 10 + self.dice.below(9) as u32);
        self.say(Statement::Tool { number, offset });
        self.spindle();
        if self.dice.once_in(2) {
            self.say(Statement::Coolant(CoolantCommand::On));
        }
        if !self.dice.once_in(12) {
            self.away();
        }
    }

    fn spindle(&mut self) {
        let ccw = self.dice.once_in(3);
        let command = if self.dice.once_in(2) && !self.threads {
            // Without a limit the post refuses a surface speed, where the machine does not
            // take it.
            let limit = self.dice.once_in(2) || !self.setup.takes_surface_speed_without_limit();
            let limit = limit.then(|| 1000.0 + self.dice.below(2000) as f64);
            SpindleCommand::Surface { speed: 50.0 + self.dice.below(300) as f64, ccw, limit }
        } else {
            SpindleCommand::Turn { speed: 100.0 + self.dice.below(3000) as f64, ccw }
        };
        self.say(Statement::Spindle(command));
    }

    fn feed(&mut self) {
        let per_revolution = !self.dice.once_in(4);
        let digits = if self.setup.unit == Unit::Mm { 1000.0 } else { 10_000.0 };
        let range = if per_revolution { (0.05, 0.6) } else { (20.0, 400.0) };
        let value = self.length(range.0, range.1).max(2.0 / digits);
        let value = (value * digits).round() / digits;
        self.say(Statement::Feedrate(Feedrate { value, per_revolution }));
    }

    fn point(&mut self) -> Point {
        [self.length(2.0, 60.0), 0.0, self.length(-80.0, 2.0)]
    }

    /// A rapid clear of the part.
    fn away(&mut self) {
        let to = [self.length(62.0, 90.0), 0.0, self.length(3.0, 20.0)];
        self.say(Statement::Rapid(to));
        self.at = to;
    }

    fn cut(&mut self, to: Point) {
        self.say(Statement::Feed(to));
        self.at = to;
    }

    fn section(&mut self) {
        match self.dice.below(12) {
            0..=5 => self.turning(),
            6 => self.thread(),
            7 => self.holes(),
            8 => self.change_tool(),
            9 => self.contour(),
            10 => self.shifted(),
            _ => self.skipped(),
        }
    }

    fn turning(&mut self) {
        if self.dice.once_in(2) {
            self.away();
        }
        for _ in 0..1 + self.dice.below(6) {
            self.aside();
            self.motion();
        }
    }

    fn motion(&mut self) {
        match self.dice.below(6) {
            0 | 1 => self.arc(),
            2 => {
                let by = [self.length(-3.0, 3.0), 0.0, self.length(-9.0, 9.0)];
                let rapid = self.dice.once_in(4);
                self.say(Statement::Delta { by, rapid });
                self.at = add(self.at, by);
            }
            3 => {
                let exponent = self.dice.between(-5.0, -1.0);
                let reach = libm::exp10(exponent);
                let by = [self.length(-reach, reach), 0.0, self.length(-reach, reach)];
                let to = add(self.at, by);
                self.cut(to);
            }
            _ => {
                let point = self.point();
                let to = std::array::from_fn(|axis| {
                    if self.dice.once_in(3) { self.at[axis] } else { point[axis] }
                });
                self.cut(to);
            }
        }
    }

    fn arc(&mut self) {
        // Of an arc of a few last digits the model can say little.
        let least = if self.dice.once_in(20) { -2.5 } else { -1.2 };
        let exponent = self.dice.between(least, 2.5);
        let radius = libm::exp10(exponent) * self.size;
        let widest = (60.0 * self.size / radius).min(6.0).to_degrees();
        let sweep = match self.dice.below(8) {
            0 if widest > 300.0 => 360.0,
            1 if widest > 190.0 => 180.0 + self.dice.between(-0.01, 0.01),
            2 => libm::exp10(self.dice.between(-4.0, 0.0)).max((3e-6 / radius).to_degrees()),
            _ => self.dice.between(1f64.min(widest), widest),
        };
        let apart = least_apart(self.size, radius);
        let sweep = if sweep == 360.0 { sweep } else { sweep.clamp(apart, 360.0 - apart) };
        let shape = ArcShape {
            normal: Axis::Y,
            ccw: self.dice.once_in(2),
            radius,
            start: if self.dice.once_in(3) {
                90.0 * self.dice.below(4) as f64
            } else {
                self.dice.between(0.0, 360.0)
            },
            sweep,
            times: 0,
            rise: 0.0,
        };
        self.say(Statement::Arc(shape));
        (_, self.at) = ends(&shape, self.at);
    }

    /// Passes of a thread, each from its own diameter.
    fn thread(&mut self) {
        self.away();
        let digits = if self.setup.unit == Unit::Mm { 1000.0 } else { 10_000.0 };
        let lead = (self.length(0.5, 5.0) * digits).round() / digits;
        let start = [self.length(10.0, 40.0), 0.0, self.length(3.0, 6.0)];
        let end = self.length(-40.0, -5.0);
        let taper = if self.dice.once_in(3) { self.length(0.1, 2.0) } else { 0.0 };
        self.threads = true;
        self.spindle();
        self.say(Statement::Thread(lead));
        for pass in 0..1 + self.dice.below(3) {
            let x = start[0] - pass as f64 * 0.2 * self.size;
            self.say(Statement::Rapid([x, 0.0, start[2]]));
            if self.dice.once_in(6) {
                self.aside();
            }
            self.cut([x + taper, 0.0, end]);
            self.say(Statement::Rapid([start[0] + 5.0 * self.size, 0.0, end]));
        }
        self.say(Statement::ThreadOff);
        self.threads = false;
        if !self.dice.once_in(3) {
            self.feed();
        }
        self.away();
    }

    /// Holes on the axis of the part.
    fn holes(&mut self) {
        let level = [0.0, 0.0, self.length(20.0, 40.0)];
        self.say(Statement::Rapid(level));
        const KINDS: [CycleKind; 6] = [
            CycleKind::Drill,
            CycleKind::Csink,
            CycleKind::Deep,
            CycleKind::Brkchp,
            CycleKind::Ream,
            CycleKind::Bore,
        ];
        let kind = KINDS[self.dice.below(KINDS.len())];
        let depth = self.length(1.0, 18.0);
        let retract = self.length(5.0, 15.0);
        let shape = CycleShape {
            kind,
            depth,
            clear: self.length(0.5, 4.0),
            feed: None,
            step: kind.pecks().then(|| depth / (1.5 + self.dice.below(5) as f64)),
            retract: [None, Some(0.0), Some(retract)][self.dice.below(3)],
            dwell: self.dice.once_in(2).then(|| 0.25 * (1 + self.dice.below(8)) as f64),
        };
        self.say(Statement::Cycle(shape));
        for _ in 0..1 + self.dice.below(2) {
            let hole = [0.0, 0.0, self.length(-5.0, 2.0)];
            self.say(Statement::Hole(hole));
            self.at = hole;
        }
        self.say(Statement::CycleOff);
        self.away();
    }

    /// A contour under nose compensation.
    fn contour(&mut self) {
        self.away();
        let left = self.dice.once_in(2);
        self.say(Statement::Cutcom(CutcomCommand::On { left, offset: None }));
        if self.dice.once_in(10) {
            // Compensation that begins on an arc.
            self.arc();
        } else {
            let to = self.point();
            self.cut(to);
        }
        for _ in 0..1 + self.dice.below(4) {
            self.motion();
        }
        self.say(Statement::Cutcom(CutcomCommand::Off));
        self.away();
    }

    /// A frame: shifted, mirrored along Z for the other side of the part, or turned half about
    /// it for a tool behind the axis.
    fn shifted(&mut self) {
        let shift = [self.length(-2.0, 2.0), 0.0, self.length(-5.0, 5.0)];
        self.away();
        let (about, angle, mirror) = match self.dice.below(6) {
            0 => (Axis::Y, 180.0, true),
            1 => (Axis::Z, 180.0, false),
            2 => (Axis::Z, 0.0, true),
            _ => (Axis::Y, 0.0, false),
        };
        let plain = angle == 0.0 && !mirror;
        self.say(Statement::Trans(if plain {
            Trans::Shift(shift)
        } else {
            Trans::Matrix { about, angle, mirror, shift, points_only: true }
        }));
        self.away();
        // In a frame where left is right the post refuses compensation.
        if self.dice.once_in(if plain { 3 } else { 12 }) {
            self.contour();
        } else {
            self.turning();
        }
        self.say(Statement::TransOff);
        self.away();
    }

    fn skipped(&mut self) {
        self.say(Statement::Skip(true));
        for _ in 0..1 + self.dice.below(3) {
            if self.dice.once_in(3) { self.away() } else { self.motion() }
        }
        self.say(Statement::Skip(false));
        self.away();
    }

    fn aside(&mut self) {
        match self.dice.below(16) {
            0 | 1 => self.feed(),
            2 => self.spindle(),
            3 => {
                let commands = [CoolantCommand::Off, CoolantCommand::On];
                let command = commands[self.dice.below(2)];
                self.say(Statement::Coolant(command));
            }
            4 => {
                let seconds = 0.5 * (1 + self.dice.below(9)) as f64;
                self.say(Statement::Delay(seconds));
            }
            5 if self.dice.once_in(2) => {
                let turns = (1 + self.dice.below(12)) as f64;
                if !self.dice.once_in(6) {
                    let speed = 100.0 + self.dice.below(3000) as f64;
                    self.say(Statement::Spindle(SpindleCommand::Turn { speed, ccw: false }));
                }
                self.say(Statement::DelayTurns(turns));
            }
            5 => self.say(Statement::OptionalStop),
            6 => self.say(Statement::Message("A MESSAGE")),
            7 if !self.threads => {
                self.say(Statement::Spindle(SpindleCommand::Off));
                // A feed a turn of a spindle that stands is refused.
                self.say(Statement::Spindle(SpindleCommand::Turn { speed: 500.0, ccw: false }));
            }
            8..=10 if self.texts => {
                let text = TEXTS[self.dice.below(TEXTS.len())];
                self.say(Statement::Insert(text));
            }
            _ => {}
        }
    }
}
