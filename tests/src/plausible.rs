//! Parts as shops post them: each is right work for each machine that has its functions, so that a
//! refusal, a warning and a finding of verify are each counted as what they cost.

pub mod busy;

use std::fmt::Write;

use crate::programs::Dice;

/// Mills that parts are posted for.
pub const MILLS: &[&str] = &[
    "haas-mill",
    "fanuc-mill",
    "mazak-mill",
    "mitsubishi-mill",
    "brother-mill",
    "linuxcnc-mill",
    "mach3-mill",
    "mach4-mill",
    "okuma-mill",
    "sinumerik-840d",
    "sinumerik-828d",
    "heidenhain-tnc640",
    "tormach-mill",
];

/// Lathes that parts are posted for.
pub const LATHES: &[&str] =
    &["fanuc-lathe", "haas-lathe", "okuma-lathe", "sinumerik-lathe", "linuxcnc-lathe"];

/// The other ready posts for mills, with rotary axes and for hobby controls among them.
pub const MORE_MILLS: &[&str] = &[
    "centroid-mill",
    "fanuc-5x-head",
    "fanuc-5x-tables",
    "fanuc-mill-a",
    "fanuc-mill-b",
    "fluidnc",
    "grbl",
    "haas-mill-a",
    "haas-trunnion",
    "haas-trunnion-tcpc",
    "heidenhain-5x",
    "hurco-mill",
    "linuxcnc-5x",
    "marlin-mill",
    "masso-mill",
    "mazak-5x",
    "robodrill-5x",
    "robodrill-a",
    "sinumerik-5x",
    "syntec-mill",
    "uccnc-mill",
];

/// The other ready posts for lathes, those with live tools among them.
pub const MORE_LATHES: &[&str] =
    &["dn-mill-turn", "fanuc-mill-turn", "haas-lathe-y", "sinumerik-mill-turn"];

/// The CL text of a part under construction.
struct Part {
    dice: Dice<'static>,
    text: String,
    inch: bool,
    /// Digits behind the point that the CAM system writes.
    digits: usize,
}

/// The CL text of a milled part.
pub fn milled(seed: u64) -> String {
    let mut part = Part::new(seed);
    let offsets = part.dice.once_in(3);
    if offsets {
        part.line("SET / OFSETL, 1");
    }
    let tools = 1 + part.dice.below(5);
    let first = 1 + part.dice.below(15);
    for number in 0..tools {
        if number > 0 && part.dice.once_in(6) {
            let stop = part.dice.pick(&["OPSTOP", "STOP"]);
            part.line(stop);
        }
        if offsets && number > 0 && part.dice.once_in(2) {
            let offset = 1 + part.dice.below(4);
            part.line(&format!("SET / OFSETL, {offset}"));
        }
        part.mill_with(first + number);
    }
    part.end()
}

/// The CL text of a turned part.
pub fn turned(seed: u64) -> String {
    let mut part = Part::new(seed);
    let first = 1 + part.dice.below(4);
    for number in 0..1 + part.dice.below(4) {
        part.turn_with(first + number);
    }
    part.end()
}

impl Part {
    fn new(seed: u64) -> Part {
        let mut dice = Dice::from_seed(seed);
        let inch = dice.once_in(4);
        let digits = if dice.once_in(3) { 6 } else { 3 + usize::from(inch) };
        let mut part = Part { dice, text: String::new(), inch, digits };
        let number = 1 + part.dice.below(7999);
        let title = match part.dice.below(3) {
            0 => "HOUSING-A".to_string(),
            1 => format!("BRACKET {}", number % 9),
            _ => number.to_string(),
        };
        part.line(&format!("PARTNO / {title}"));
        part.line(if inch { "UNITS / INCHES" } else { "UNITS / MM" });
        part
    }

    fn end(mut self) -> String {
        if self.dice.once_in(3) {
            self.line("END");
        }
        self.line("FINI");
        self.text
    }

    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// A length in millimetres as the CL file writes it.
    fn length(&self, mm: f64) -> String {
        let length = if self.inch { mm / 25.4 } else { mm };
        format!("{length:.*}", self.digits)
    }

    /// One of some lengths in millimetres, as the CL file writes it.
    fn one_of(&mut self, lengths: &[f64]) -> String {
        let mm = lengths[self.dice.below(lengths.len())];
        self.length(mm)
    }

    fn goto(&mut self, [x, y, z]: [f64; 3]) {
        let [x, y, z] = [x, y, z].map(|value| self.length(value));
        writeln!(self.text, "GOTO / {x}, {y}, {z}").expect("a text takes it");
    }

    fn rapid(&mut self, point: [f64; 3]) {
        self.line("RAPID");
        self.goto(point);
    }

    /// An arc in XY about a center, seen from above counterclockwise, to a point.
    fn arc(&mut self, [x, y, z]: [f64; 3], radius: f64, to: [f64; 3]) {
        let [x, y, z, radius] = [x, y, z, radius].map(|value| self.length(value));
        self.line(&format!("CIRCLE / {x}, {y}, {z}, 0, 0, 1, {radius}"));
        self.goto(to);
    }

    /// A feed: its word of the unit, and the number.
    fn feed(&mut self) -> (&'static str, String) {
        let per_turn = self.dice.once_in(4);
        let mm = [[100.0, 200.0, 350.0, 800.0], [0.05, 0.08, 0.1, 0.12]][usize::from(per_turn)];
        let mm = mm[self.dice.below(4)];
        let unit = match (self.inch, per_turn) {
            (false, false) => "MMPM",
            (false, true) => "MMPR",
            (true, false) => "IPM",
            (true, true) => "IPR",
        };
        (unit, self.length(mm))
    }

    fn say_feed(&mut self) {
        let (unit, number) = self.feed();
        self.line(&format!("FEDRAT / {number}, {unit}"));
    }

    /// LOADTL, SPINDL and COOLNT.
    fn load(&mut self, tool: usize) {
        let offset = match self.dice.below(4) {
            0 => format!(", OSETNO, {tool}"),
            1 => format!(", LENGTH, {}, OSETNO, {tool}", self.length(80.0)),
            _ => String::new(),
        };
        self.line(&format!("LOADTL / {tool}{offset}"));
        let speed = self.dice.pick(&["500", "800", "1200", "2400", "4000"]);
        self.line(&format!("SPINDL / RPM, {speed}, CLW"));
        let coolant = self.dice.pick(&["ON", "FLOOD", "MIST", ""]);
        if !coolant.is_empty() {
            self.line(&format!("COOLNT / {coolant}"));
        }
    }

    fn leave(&mut self, point: [f64; 3]) {
        self.rapid(point);
        if self.dice.once_in(2) {
            self.line("SPINDL / OFF");
            self.line("COOLNT / OFF");
        }
    }

    fn mill_with(&mut self, tool: usize) {
        if self.dice.once_in(3) {
            self.line(&format!("PPRINT / OP {tool}"));
        }
        self.load(tool);
        let (x, y) = (self.dice.between(-100.0, 100.0), self.dice.between(-80.0, 80.0));
        self.rapid([x, y, 50.0]);
        match self.dice.below(6) {
            0 => self.face(x, y),
            1 => self.contour(x, y, tool),
            2 => self.thread(x, y),
            _ => self.holes(x, y),
        }
        self.leave([x, y, 50.0]);
    }

    fn face(&mut self, x: f64, y: f64) {
        self.rapid([x, y, 5.0]);
        self.say_feed();
        self.goto([x, y, -1.0]);
        for row in 0..2 + self.dice.below(3) {
            let (from, to) = if row % 2 == 0 { (x, x + 80.0) } else { (x + 80.0, x) };
            let y = y + 15.0 * row as f64;
            self.goto([from, y, -1.0]);
            self.goto([to, y, -1.0]);
        }
    }

    /// Lines and arcs, in half of them with cutter compensation.
    fn contour(&mut self, x: f64, y: f64, tool: usize) {
        let z = -5.0;
        self.rapid([x, y, 3.0]);
        self.say_feed();
        self.goto([x, y, z]);
        let compensated = self.dice.once_in(2);
        if compensated {
            let side = self.dice.pick(&["LEFT", "RIGHT"]);
            self.line(&format!("CUTCOM / {side}, {tool}"));
        }
        self.goto([x + 12.0, y, z]);
        self.goto([x + 40.0, y, z]);
        let radius = [8.0, 9.5, 13.7][self.dice.below(3)];
        self.arc([x + 40.0, y + radius, z], radius, [x + 40.0 + radius, y + radius, z]);
        self.goto([x + 40.0 + radius, y + 40.0, z]);
        self.arc([x + 40.0, y + 40.0, z], radius, [x + 40.0 - radius, y + 40.0, z]);
        self.goto([x + 10.0, y + 60.0, z]);
        if compensated {
            self.line("CUTCOM / OFF");
            self.goto([x, y + 70.0, z]);
        }
    }

    /// A milled thread of three turns.
    fn thread(&mut self, x: f64, y: f64) {
        let radius = 8.0;
        self.rapid([x, y, 2.0]);
        self.say_feed();
        self.goto([x, y, 0.0]);
        for half in 0..6 {
            let z = -0.75 * f64::from(half);
            let to = if half % 2 == 0 { x - 2.0 * radius } else { x };
            self.arc([x - radius, y, z], radius, [to, y, z - 0.75]);
        }
        self.goto([x - radius, y, -4.5]);
    }

    fn holes(&mut self, x: f64, y: f64) {
        let kinds = ["DRILL", "DEEP", "BRKCHP", "BORE", "REAM", "TAP", "DRILL"];
        let kind = self.dice.pick(&kinds);
        let depth = self.one_of(&[4.0, 12.0, 25.0, 31.75]);
        let clear = self.one_of(&[2.0, 3.0, 5.0]);
        let step = match kind {
            "DEEP" | "BRKCHP" => format!(", STEP, {}", self.length(3.0)),
            _ => String::new(),
        };
        let feed = match (kind, self.inch) {
            ("TAP", false) => "MMPR, 1.25".to_string(),
            ("TAP", true) => "TPI, 20".to_string(),
            _ => {
                let (unit, number) = self.feed();
                format!("{unit}, {number}")
            }
        };
        let more = match self.dice.below(6) {
            0 => format!(", RETURN, {}", self.length(10.0)),
            _ => String::new(),
        };
        let words = format!("DEPTH, {depth}{step}, {feed}, CLEAR, {clear}{more}");
        self.line(&format!("CYCLE / {kind}, {words}"));
        for hole in 0..1 + self.dice.below(5) {
            let across = hole as f64;
            self.goto([x + 12.5 * across, y + 20.0 * (across % 2.0), 0.0]);
        }
        self.line("CYCLE / OFF");
    }

    fn turn_with(&mut self, tool: usize) {
        self.load(tool);
        let feed = self.one_of(&[0.1, 0.15, 0.2, 0.25]);
        let unit = if self.inch { "IPR" } else { "MMPR" };
        self.line(&format!("FEDRAT / {feed}, {unit}"));
        let radius = self.dice.between(20.0, 40.0);
        self.rapid([radius + 10.0, 0.0, 5.0]);
        match self.dice.below(5) {
            0 => self.turn(radius),
            1 => {
                self.rapid([radius, 0.0, 0.0]);
                self.goto([-0.5, 0.0, 0.0]);
                self.goto([-0.5, 0.0, 2.0]);
            }
            2 => {
                self.rapid([radius + 2.0, 0.0, -12.0]);
                self.goto([radius - 4.0, 0.0, -12.0]);
                self.line("DELAY / 0.5");
                self.goto([radius + 2.0, 0.0, -12.0]);
            }
            3 => self.drill(unit),
            _ => self.cut_thread(radius, unit),
        }
        self.leave([radius + 30.0, 0.0, 50.0]);
    }

    fn turn(&mut self, radius: f64) {
        for pass in 0..1 + self.dice.below(3) {
            let at = radius - 2.0 * pass as f64;
            self.rapid([at, 0.0, 2.0]);
            self.goto([at, 0.0, -30.0]);
            self.goto([radius + 5.0, 0.0, -30.0]);
            self.rapid([radius + 5.0, 0.0, 2.0]);
        }
    }

    fn drill(&mut self, unit: &str) {
        self.rapid([0.0, 0.0, 5.0]);
        let [depth, step, feed, clear] = [25.0, 4.0, 0.1, 2.0].map(|mm| self.length(mm));
        let words = format!("DEPTH, {depth}, STEP, {step}, {unit}, {feed}, CLEAR, {clear}");
        self.line(&format!("CYCLE / DEEP, {words}"));
        self.goto([0.0, 0.0, 0.0]);
        self.line("CYCLE / OFF");
    }

    fn cut_thread(&mut self, radius: f64, unit: &str) {
        self.rapid([radius + 3.0, 0.0, 5.0]);
        let lead = [1.0, 1.5, 2.0][self.dice.below(3)];
        let [x, from, to, lead, first, height] =
            [radius, 5.0, -20.0, lead, 0.3, 0.6134 * lead].map(|mm| self.length(mm));
        self.line(&format!(
            "THREAD / AUTO, {x}, 0, {from}, TO, {x}, 0, {to}, {unit}, {lead}, DEEP, {first}, TYPE, 0, \
             {height}, 60, FEDTO, {height}, OUT, TIMES, 1"
        ));
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn each_ready_post_is_a_mill_or_a_lathe() {
        let listed: Vec<&str> =
            [MILLS, MORE_MILLS, LATHES, MORE_LATHES].into_iter().flatten().copied().collect();
        let posts: BTreeSet<&str> = filpost::ready::READY.iter().map(|post| post.name).collect();
        assert_eq!(listed.len(), posts.len());
        assert_eq!(listed.into_iter().collect::<BTreeSet<_>>(), posts);
    }
}
