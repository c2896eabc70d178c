//! Busy parts: the statements of everyday work in any order that a shop could ask for, with the
//! pairs at which posts go wrong. An offset comes again, two tools follow each other, coolant is
//! switched around a change, the end of cutter compensation waits for a motion, taps stand at two
//! heights.

use super::Part;

/// Where a mill travels above the part, mm.
const ABOVE: f64 = 60.0;

/// The CL text of a milled part.
pub fn milled(seed: u64) -> String {
    let mut mill = Mill { part: Part::new(seed), tool: 0, at: [0.0; 2] };
    mill.load();
    for _ in 0..2 + mill.part.dice.below(5) {
        mill.step();
    }
    mill.part.end_of_busy()
}

/// The CL text of a turned part.
pub fn turned(seed: u64) -> String {
    let mut lathe = Lathe { part: Part::new(seed), tool: 0, by_surface: false };
    lathe.load();
    for _ in 0..2 + lathe.part.dice.below(5) {
        lathe.step();
    }
    lathe.part.end_of_busy()
}

impl Part {
    fn end_of_busy(mut self) -> String {
        if !self.dice.once_in(3) {
            self.line("SPINDL / OFF");
            self.line("COOLNT / OFF");
        }
        self.line("FINI");
        self.text
    }

    /// A tool other than the last one.
    fn other_tool(&mut self, last: usize) -> usize {
        let tool = 1 + self.dice.below(5);
        if tool >= last && last > 0 { tool + 1 } else { tool }
    }

    fn feeds(&mut self, per_turn: bool, mm: f64) {
        let unit = match (self.inch, per_turn) {
            (false, false) => "MMPM",
            (false, true) => "MMPR",
            (true, false) => "IPM",
            (true, true) => "IPR",
        };
        let number = self.length(mm);
        self.line(&format!("FEDRAT / {number}, {unit}"));
    }

    /// A cycle: its words with `{}` for lengths in mm.
    fn cycle(&mut self, words: &str, lengths: &[f64]) {
        let mut text = String::new();
        let mut lengths = lengths.iter();
        for part in words.split_inclusive("{}") {
            text.push_str(part.trim_end_matches("{}"));
            if part.ends_with("{}") {
                let mm = lengths.next().expect("a length for each place");
                text.push_str(&self.length(*mm));
            }
        }
        let text = match self.inch {
            true => text.replace("MMPM", "IPM").replace("MMPR", "IPR"),
            false => text,
        };
        self.line(&format!("CYCLE / {text}"));
    }
}

struct Mill {
    part: Part,
    tool: usize,
    at: [f64; 2],
}

impl Mill {
    fn load(&mut self) {
        let part = &mut self.part;
        if part.dice.once_in(8) {
            part.line("COOLNT / ON");
        }
        for _ in 0..1 + usize::from(part.dice.once_in(8)) {
            self.tool = part.other_tool(self.tool);
            let offset = if part.dice.once_in(2) {
                format!(", OSETNO, {}", self.tool)
            } else {
                String::new()
            };
            part.line(&format!("LOADTL / {}{offset}", self.tool));
        }
        if part.dice.once_in(10) {
            let between = part.dice.pick(&["PPRINT / CHECK", "OPSTOP", "STOP"]);
            part.line(between);
        }
        let speed = part.dice.pick(&["500", "1000", "2345"]);
        part.line(&format!("SPINDL / RPM, {speed}, CLW"));
        if !part.dice.once_in(3) {
            let coolant = part.dice.pick(&["ON", "FLOOD", "MIST"]);
            part.line(&format!("COOLNT / {coolant}"));
        }
        if part.dice.once_in(5) {
            self.offset();
        }
        self.over();
    }

    fn offset(&mut self) {
        let offset = 1 + self.part.dice.below(4);
        self.part.line(&format!("SET / OFSETL, {offset}"));
    }

    fn elsewhere(&mut self) {
        let dice = &mut self.part.dice;
        self.at = [dice.between(-50.0, 50.0), dice.between(-50.0, 50.0)];
    }

    /// At rapid to another place above the part.
    fn over(&mut self) {
        self.elsewhere();
        self.rapid(ABOVE);
    }

    fn rapid(&mut self, z: f64) {
        let [x, y] = self.at;
        self.part.rapid([x, y, z]);
    }

    fn goto(&mut self, z: f64) {
        let [x, y] = self.at;
        self.part.goto([x, y, z]);
    }

    fn step(&mut self) {
        match self.part.dice.below(15) {
            0..=2 => self.face(),
            3..=4 => self.compensated(),
            5..=7 => self.holes(),
            8 => self.arc(),
            9 => self.offset(),
            10 => {
                if self.part.dice.once_in(2) {
                    let before =
                        self.part.dice.pick(&["SPINDL / OFF", "COOLNT / OFF", "OPSTOP", "STOP"]);
                    self.part.line(before);
                }
                self.load();
            }
            11 => {
                let stop = self.part.dice.pick(&["STOP", "OPSTOP"]);
                self.part.line(stop);
                self.part.line("SPINDL / RPM, 900, CLW");
            }
            12 => {
                let kind = self.part.dice.pick(&["ON", "OFF", "MIST", "FLOOD"]);
                self.part.line(&format!("COOLNT / {kind}"));
            }
            13 => {
                let spin = ["SPINDL / RPM, 1500, CLW", "SPINDL / ON", "SPINDL / RPM, 800, CCLW"];
                let spin = self.part.dice.pick(&spin);
                self.part.line(spin);
            }
            _ => {
                let wait = self.part.dice.pick(&["DELAY / 1.5", "DELAY / REV, 6", "PPRINT / NEXT"]);
                self.part.line(wait);
            }
        }
    }

    fn face(&mut self) {
        self.over();
        self.rapid(2.0);
        let per_turn = self.part.dice.once_in(3);
        self.part.feeds(per_turn, if per_turn { 0.15 } else { 300.0 });
        self.goto(-3.0);
        for _ in 0..1 + self.part.dice.below(3) {
            self.elsewhere();
            self.goto(-3.0);
        }
        self.rapid(ABOVE);
    }

    fn arc(&mut self) {
        let radius = [5.0, 7.5, 12.0][self.part.dice.below(3)];
        let center = [0, 1].map(|_| self.part.dice.below(40) as f64 - 20.0);
        self.at = [center[0] - radius, center[1]];
        self.rapid(ABOVE);
        self.rapid(2.0);
        self.part.feeds(false, 250.0);
        self.goto(-1.0);
        let [x, y] = center;
        let to = [[x, y - radius], [x + radius, y], [x, y + radius]][self.part.dice.below(3)];
        let z = if self.part.dice.once_in(2) { -1.0 } else { -2.0 };
        self.part.arc([x, y, -1.0], radius, [to[0], to[1], z]);
        self.at = to;
        self.rapid(ABOVE);
    }

    /// Around a corner with cutter compensation, which ends before the way off, before the retract
    /// or behind it.
    fn compensated(&mut self) {
        self.at = [-30.0, -30.0];
        self.rapid(ABOVE);
        self.rapid(2.0);
        self.part.feeds(false, 300.0);
        self.goto(-2.0);
        let side = self.part.dice.pick(&["LEFT", "RIGHT"]);
        let tool = self.tool;
        let offset = if self.part.dice.once_in(2) { format!(", {tool}") } else { String::new() };
        self.part.line(&format!("CUTCOM / {side}{offset}"));
        for at in [[0.0, -30.0], [0.0, 30.0]] {
            self.at = at;
            self.goto(-2.0);
        }
        let ends = self.part.dice.below(3);
        if ends == 0 {
            self.part.line("CUTCOM / OFF");
        }
        self.at = [-30.0, 30.0];
        self.goto(-2.0);
        if ends == 1 {
            self.part.line("CUTCOM / OFF");
        }
        self.rapid(ABOVE);
        if ends == 2 {
            self.part.line("CUTCOM / OFF");
        }
    }

    fn holes(&mut self) {
        self.over();
        match self.part.dice.below(10) {
            0 => self.part.cycle("DRILL, DEPTH, {}, MMPM, {}, CLEAR, {}", &[10.0, 120.0, 2.0]),
            1 => self
                .part
                .cycle("DEEP, DEPTH, {}, STEP, {}, MMPM, {}, CLEAR, {}", &[20.0, 6.0, 90.0, 3.0]),
            2 => self
                .part
                .cycle("BRKCHP, DEPTH, {}, STEP, {}, MMPR, {}, CLEAR, {}", &[20.0, 6.0, 0.12, 3.0]),
            3 => self.part.cycle("BORE, DEPTH, {}, MMPR, {}, CLEAR, {}", &[12.0, 0.1, 2.0]),
            4 => self.part.cycle("REAM, DEPTH, {}, MMPM, {}, CLEAR, {}", &[9.0, 88.0, 2.0]),
            5 => self
                .part
                .cycle("FACE, DEPTH, {}, MMPM, {}, CLEAR, {}, DWELL, 0.5", &[2.0, 50.0, 2.0]),
            6 => self.part.cycle(
                "DRILL, DEPTH, {}, MMPM, {}, CLEAR, {}, RETURN, {}",
                &[10.0, 120.0, 2.0, 20.0],
            ),
            7 => self.part.cycle("CSINK, DEPTH, {}, MMPM, {}, CLEAR, {}", &[3.0, 60.0, 2.0]),
            _ if self.part.inch => {
                self.part.cycle("TAP, DEPTH, {}, TPI, 20, CLEAR, {}", &[12.0, 5.0])
            }
            _ => self.part.cycle("TAP, DEPTH, {}, MMPR, 1.25, CLEAR, {}", &[12.0, 5.0]),
        }
        for _ in 0..1 + self.part.dice.below(3) {
            self.elsewhere();
            let z = [0.0, 0.0, 0.0, 5.0, -4.0][self.part.dice.below(5)];
            self.goto(z);
            if self.part.dice.once_in(20) {
                let between =
                    self.part.dice.pick(&["COOLNT / OFF", "COOLNT / ON", "PPRINT / HOLE"]);
                self.part.line(between);
            }
        }
        self.part.line("CYCLE / OFF");
        self.rapid(ABOVE);
    }
}

/// Where the turret stands clear of the part: radius and Z, mm.
const CLEAR: [f64; 3] = [70.0, 0.0, 20.0];

struct Lathe {
    part: Part,
    tool: usize,
    /// The speed is a surface speed.
    by_surface: bool,
}

impl Lathe {
    fn load(&mut self) {
        self.tool = self.part.other_tool(self.tool);
        self.part.line(&format!("LOADTL / {0}, OSETNO, {0}", self.tool));
        self.spin();
        if !self.part.dice.once_in(3) {
            self.part.line("COOLNT / ON");
        }
        self.part.rapid(CLEAR);
    }

    fn spin(&mut self) {
        self.by_surface = self.part.dice.once_in(2);
        let sense = self.part.dice.pick(&["CLW", "CLW", "CCLW"]);
        let speed = match (self.by_surface, self.part.inch) {
            (true, false) => format!("SMM, {}", self.part.dice.pick(&["120", "180"])),
            (true, true) => format!("SFM, {}", self.part.dice.pick(&["400", "600"])),
            (false, _) => format!("RPM, {}", self.part.dice.pick(&["600", "1100"])),
        };
        let limit = if self.by_surface { ", MAXRPM, 2500" } else { "" };
        self.part.line(&format!("SPINDL / {speed}, {sense}{limit}"));
    }

    fn step(&mut self) {
        let x = [20.0, 22.5, 30.0][self.part.dice.below(3)];
        let z = [-15.0, -20.25, -33.0][self.part.dice.below(3)];
        match self.part.dice.below(14) {
            0..=2 => {
                self.part.rapid([x, 0.0, 3.0]);
                let per_turn = !self.part.dice.once_in(3);
                self.part.feeds(per_turn, if per_turn { 0.2 } else { 120.0 });
                self.part.goto([x, 0.0, z]);
                self.part.goto([x + 3.0, 0.0, z - 1.5]);
                self.part.rapid(CLEAR);
            }
            3 => {
                self.part.rapid([35.0, 0.0, 0.0]);
                self.part.feeds(true, 0.2);
                self.part.goto([-0.8, 0.0, 0.0]);
                self.part.goto([-0.8, 0.0, 2.0]);
                self.part.rapid(CLEAR);
            }
            4..=5 => self.corner(x, z),
            6 => self.compensated(x, z),
            7..=8 => self.thread(x, z),
            9 => self.drill(),
            10 => self.load(),
            11 => {
                let stop = self.part.dice.pick(&["STOP", "OPSTOP"]);
                self.part.line(stop);
                self.spin();
            }
            12 => self.spin(),
            _ => {
                let wait = self.part.dice.pick(&["DELAY / 1", "DELAY / REV, 4"]);
                self.part.line(wait);
            }
        }
    }

    /// A fillet or a rounded edge.
    fn corner(&mut self, x: f64, z: f64) {
        self.part.rapid([x, 0.0, 3.0]);
        self.part.feeds(true, 0.2);
        self.part.goto([x, 0.0, z]);
        let (center, normal, to) = match self.part.dice.once_in(2) {
            true => ([x + 5.0, 0.0, z], "0, -1, 0", [x + 5.0, 0.0, z - 5.0]),
            false => {
                self.part.goto([x + 1.0, 0.0, z]);
                ([x + 1.0, 0.0, z - 5.0], "0, 1, 0", [x + 6.0, 0.0, z - 5.0])
            }
        };
        let [x, y, z] = center.map(|value| self.part.length(value));
        let radius = self.part.length(5.0);
        self.part.line(&format!("CIRCLE / {x}, {y}, {z}, {normal}, {radius}"));
        self.part.goto(to);
        self.part.rapid(CLEAR);
    }

    fn compensated(&mut self, x: f64, z: f64) {
        self.part.rapid([x, 0.0, 5.0]);
        let side = self.part.dice.pick(&["RIGHT", "LEFT"]);
        self.part.line(&format!("CUTCOM / {side}"));
        self.part.feeds(true, 0.1);
        self.part.goto([x, 0.0, 1.0]);
        self.part.goto([x, 0.0, z]);
        let ends_first = self.part.dice.once_in(2);
        if ends_first {
            self.part.line("CUTCOM / OFF");
        }
        self.part.goto([x + 5.0, 0.0, z]);
        if !ends_first {
            self.part.line("CUTCOM / OFF");
        }
        self.part.rapid(CLEAR);
    }

    /// A whole thread, at revolutions per minute.
    fn thread(&mut self, x: f64, z: f64) {
        if self.by_surface {
            self.part.line("SPINDL / RPM, 500, CLW");
            self.by_surface = false;
        }
        self.part.rapid([x + 4.0, 0.0, 6.0]);
        let lead = [1.25, 1.5, 2.0][self.part.dice.below(3)];
        let taper = if self.part.dice.once_in(3) { 1.0 } else { 0.0 };
        let last = self.part.dice.below(3);
        let angle = self.part.dice.pick(&["60", "55", "0"]);
        let unit = if self.part.inch { "IPR" } else { "MMPR" };
        let [from, top, to, lead, first, height, clear] =
            [x, 5.0, z, lead, 0.3, 0.92, 2.0].map(|mm| self.part.length(mm));
        let end = self.part.length(x + taper);
        self.part.line(&format!(
            "THREAD / AUTO, {from}, 0, {top}, TO, {end}, 0, {to}, {unit}, {lead}, DEEP, {first}, \
             LAST, {last}, TYPE, 0, {height}, {angle}, FEDTO, {clear}, OUT"
        ));
        self.part.rapid(CLEAR);
    }

    /// A hole on the axis, at revolutions per minute.
    fn drill(&mut self) {
        if self.by_surface {
            self.part.line("SPINDL / RPM, 800, CLW");
            self.by_surface = false;
        }
        self.part.rapid([0.0, 0.0, 5.0]);
        match self.part.dice.below(3) {
            0 => self.part.cycle("DRILL, DEPTH, {}, MMPR, {}, CLEAR, {}", &[20.0, 0.1, 2.0]),
            1 => self
                .part
                .cycle("DEEP, DEPTH, {}, STEP, {}, MMPR, {}, CLEAR, {}", &[40.0, 12.0, 0.1, 2.0]),
            _ => self
                .part
                .cycle("DRILL, DEPTH, {}, MMPM, {}, CLEAR, {}, DWELL, 0.5", &[9.0, 60.0, 1.0]),
        }
        self.part.goto([0.0, 0.0, 0.0]);
        self.part.line("CYCLE / OFF");
        self.part.rapid([0.0, 0.0, 20.0]);
        self.part.rapid(CLEAR);
    }
}
