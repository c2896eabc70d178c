//! What may stand between the motions of a program, in any mixture: texts and functions that
//! change modes or move the machine, frames, skipped blocks, tool axes without motions.

use nalgebra::Vector3;

use super::maker::Maker;

/// How a control is spoken to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Words of a letter and a number.
    WordAddress,
    /// A SINUMERIK.
    Sinumerik,
    /// A Heidenhain control.
    Klartext,
}

impl Family {
    /// Texts that an operator would write by hand.
    fn texts(self) -> &'static [&'static str] {
        match self {
            Family::WordAddress => &[
                "G4 P500",
                "M8",
                "M9",
                "M5",
                "M1",
                "M3",
                "S900",
                "G90",
                "G94",
                "G17",
                "G19",
                "G54",
                "G55",
                "G40",
                "G80",
                "F100.",
                "(HELLO)",
                "G0 A30.",
                "G0 B20.",
                "G0 C90.",
                "G0 Z200.",
                "G0 X5.",
                "G1 Z150. F500.",
                "G69",
                "G91",
                "G93",
                "G20",
            ],
            Family::Sinumerik => &[
                "G4 F1",
                "M8",
                "M9",
                "M5",
                "M1",
                "M3",
                "S900",
                "G90",
                "G94",
                "G17",
                "G19",
                "G54",
                "G55",
                "G40",
                "; HELLO",
                "G0 A30",
                "G0 C90",
                "G0 Z200",
                "G0 X5",
                "G1 Z150 F500",
                "TRAFOOF",
                "D1",
                "G91",
                "G700",
                "CYCLE800()",
            ],
            Family::Klartext => &[
                "M8",
                "M9",
                "M5",
                "M1",
                "M3",
                "; HELLO",
                "L A-30 FMAX",
                "L C+90 FMAX",
                "L Z+200 FMAX",
                "L X+5 FMAX",
                "L Z+150 F500",
                "PLANE RESET STAY",
                "FUNCTION RESET TCPM",
                "M129",
            ],
        }
    }
}

/// Statements without a number that is random.
const PLAIN: [&str; 41] = [
    "TRANS / NOMORE",
    "OPSKIP / ON",
    "OPSKIP / OFF",
    "STOP",
    "OPSTOP",
    "SPINDL / OFF",
    "SPINDL / ON",
    "SPINDL / RPM, 700, CLW",
    "COOLNT / OFF",
    "COOLNT / MIST",
    "AUXFUN / 8",
    "AUXFUN / 5",
    "PREFUN / 90",
    "PREFUN / 55",
    "PREFUN / 17",
    "GOHOME",
    "RETRCT",
    "SET / OFSETL, 2",
    "SET / OFSETL, 54",
    "CLAMP / ON",
    "CLAMP / OFF",
    "ROTABL / 90",
    "ROTABL / INCR, 45",
    "DELAY / 0.5",
    "DELAY / REV, 5",
    "LINTOL / OFF",
    "LINTOL / ON",
    "FEDRAT / 0.2, MMPR",
    "FEDRAT / INVERS, AUTO",
    "FEDRAT / INVERS, OFF",
    "MULTAX / OFF",
    "MULTAX / ON",
    "REPEAT / ALL, NEXT",
    "SEQNO / OFF",
    "PPRINT / HELLO",
    "LOADTL / 1",
    "LOADTL / 4",
    "CYCLE / OFF",
    "CUTCOM / OFF",
    "CUTCOM / LEFT, 4",
    "RAPID",
];

impl Maker<'_> {
    /// One thing out of everything.
    pub(super) fn mix(&mut self, family: Family) {
        match self.random.below(10) {
            0 => self.translate(),
            1 => self.from(),
            2 => self.axis_alone(),
            3 => self.hole_of_another_kind(),
            4 | 5 => {
                let texts = family.texts();
                let text = texts[self.random.below(texts.len())];
                self.say(format!("INSERT / {text}"));
            }
            _ => {
                let statement = PLAIN[self.random.below(PLAIN.len())];
                if statement == "TRANS / NOMORE" {
                    self.shift = Vector3::zeros();
                }
                self.say(statement);
            }
        }
    }

    fn translate(&mut self) {
        let [x, y, z] = [0; 3].map(|_| self.random.between(-20.0, 20.0));
        self.shift = Vector3::new(x, y, z);
        let [x, y, z] = [x, y, z].map(|value| value / self.unit);
        self.say(format!("TRANS / {x:.9}, {y:.9}, {z:.9}"));
    }

    /// FROM between motions.
    fn from(&mut self) {
        let away = Vector3::new(0.0, 0.0, self.random.between(-30.0, 60.0));
        let text = format!("FROM / {}", self.numbers(self.at + away));
        self.say(text);
    }

    /// A tool axis by TLAXIS, and a point without one.
    fn axis_alone(&mut self) {
        self.turn(20.0);
        let axis = self.axis();
        self.say(format!("TLAXIS / {:.10}, {:.10}, {:.10}", axis.x, axis.y, axis.z));
        self.step(10.0);
        let text = format!("GOTO / {}", self.numbers(self.at));
        self.aim(text, self.at, axis);
    }

    /// Holes whose tool leans another way from hole to hole, or that lie on two levels, with
    /// rapids and texts between.
    fn hole_of_another_kind(&mut self) {
        let feed = if self.unit == 1.0 { "MMPM, 100" } else { "IPM, 5" };
        let kind = ["DRILL", "TAP", "BORE", "REAM"][self.random.below(4)];
        let returns = ["", ", RETURN, 0", ", RETURN, 10"][self.random.below(3)];
        let depth = self.random.between(2.0, 15.0);
        self.rapid(20.0);
        let [depth_text, clear] = [depth, 3.0].map(|value| value / self.unit);
        self.say(format!(
            "CYCLE / {kind}, DEPTH, {depth_text:.5}, {feed}, CLEAR, {clear:.5}{returns}"
        ));
        for _ in 0..1 + self.random.below(4) {
            if self.random.happens(0.3) {
                self.turn(30.0);
            }
            if self.random.happens(0.3) {
                let level = self.random.between(-10.0, 10.0);
                self.at += self.axis() * level;
            }
            let (at, axis) = (self.at, self.axis());
            let [i, j, k] = [axis.x, axis.y, axis.z];
            let text = format!("GOTO / {}, {i:.10}, {j:.10}, {k:.10}", self.numbers(at));
            self.aim(text, at - axis * depth, axis);
            if self.random.happens(0.1) {
                self.rapid(30.0);
            }
            let across = axis.cross(&Vector3::new(0.2, 0.9, 0.4)).normalize();
            self.at += across * self.random.between(3.0, 30.0);
        }
        self.say("CYCLE / OFF");
        self.rapid(20.0);
    }
}
