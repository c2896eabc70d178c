//! A job: what is to be made, and its CL file.

use std::fmt::Write;

use super::section::{Point, Section, Step};

/// A cutter of the list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutter {
    /// Tool number.
    pub number: u32,
    /// A ball; else an end mill.
    pub ball: bool,
    /// Diameter, mm.
    pub diameter: f64,
    /// Spindle speed, rpm.
    pub speed: f64,
    /// Feed at the surface of the blank, mm/min.
    pub feed: f64,
}

/// What is to be made.
#[derive(Clone, Debug)]
pub struct Job {
    /// The section of the groove at A = 0.
    pub section: Section,
    /// Pitch, mm.
    pub pitch: f64,
    /// Turns of the blank.
    pub turns: f64,
    /// Where the blank begins along X, mm.
    pub start: f64,
    /// A left-hand groove.
    pub left: bool,
    /// Balls stand beside the plane of the axis.
    pub plane: bool,
    /// Starts of the groove.
    pub starts: usize,
    /// Allowance of roughing, mm.
    pub stock: f64,
    /// Height of the steps of roughing above the allowance, mm.
    pub rough: f64,
    /// Largest depth of a level of roughing, mm.
    pub depth: f64,
    /// Height of the scallops of finishing, mm.
    pub finish: f64,
    /// Clearance, mm.
    pub clear: f64,
    /// The list of cutters.
    pub cutters: Vec<Cutter>,
    /// What the checks allow, mm: the rounding of the NC program and of the CL file.
    pub tolerance: f64,
}

impl Job {
    /// A job on a right-hand screw of four turns with common allowances and cutters.
    pub fn new(section: Section, pitch: f64) -> Self {
        let list = [(1, false, 12.0), (2, false, 8.0), (3, false, 5.0), (4, false, 3.0)];
        let balls =
            [(5, true, 12.0), (6, true, 8.0), (7, true, 5.0), (8, true, 3.0), (9, true, 1.5)];
        let cutter = |&(number, ball, diameter): &(u32, bool, f64)| Cutter {
            number,
            ball,
            diameter,
            speed: 2000.0 + 10.0 * f64::from(number),
            feed: 300.0 + f64::from(number),
        };
        Job {
            section,
            pitch,
            turns: 4.0,
            start: 0.0,
            left: false,
            plane: false,
            starts: 1,
            stock: 0.5,
            rough: 1.0,
            depth: 1000.0,
            finish: 0.05,
            clear: 2.0,
            cutters: list.iter().chain(&balls).map(cutter).collect(),
            tolerance: 0.001,
        }
    }

    /// The CL file of the job.
    pub fn cl(&self) -> String {
        let mut text = String::from("PARTNO / SCREW 1\nMACHIN / MILL, 1\nUNITS / MM\n");
        for cutter in &self.cutters {
            let Cutter { number, diameter, speed, feed, .. } = cutter;
            let kind = if cutter.ball { "BALL" } else { "MILL" };
            let _ = writeln!(
                text,
                "SCREW / CUTTER, {kind}, {number}, DIAMTR, {diameter}, RPM, {speed}, FEDRAT, {feed}"
            );
        }
        let Job { pitch, turns, start, stock, rough, depth, finish, clear, .. } = self;
        let _ = writeln!(
            text,
            "SCREW / PITCH, {pitch}, TURN, {turns}, DIAMTR, {}, STOCK, {stock}, ROUGH, {rough}, $\n  \
             FINISH, {finish}, CLEAR, {clear}, TOLER, 0, DEPTH, {depth}, START, {start}{}{}{}",
            2.0 * self.section.top(),
            if self.left { ", LEFT" } else { "" },
            if self.plane { ", PLANE" } else { "" },
            if self.starts > 1 { format!(", TIMES, {}", self.starts) } else { String::new() }
        );
        text + &self.section.cl() + "SCREW / OFF\nFINI\n"
    }

    /// The job of a CL file; what the file lacks is 0.
    ///
    /// # Errors
    /// A statement that is none of those of a job.
    pub fn read(cl: &str) -> Result<Self, String> {
        let joined = cl.replace("$\n", "");
        let mut job = Job::new(Section { from: [0.0; 2], steps: Vec::new() }, 0.0);
        job.cutters.clear();
        let mut points = Vec::new();
        for line in joined.lines().filter(|line| !line.starts_with("$$")) {
            let (word, rest) = line.split_once('/').unwrap_or((line, ""));
            let items = Items(rest.split(',').map(str::trim).collect());
            match (word.trim(), items.0[0]) {
                ("SCREW", "CUTTER") => job.cutters.push(Cutter::read(&items)),
                ("SCREW", "PITCH") => job.couplets(&items),
                ("CIRCLE", _) => points.push((items.place(), Some(items.number(4) < 0.0))),
                ("GOTO", _) => points.push((items.place(), None)),
                ("SCREW", "OFF") | ("PARTNO" | "MACHIN" | "UNITS" | "FINI", _) => {}
                _ => return Err(format!("`{line}` is no statement of a job")),
            }
        }
        let mut center = None;
        for (index, (place, hollow)) in points.into_iter().enumerate() {
            match (hollow, center.take()) {
                (Some(hollow), _) => center = Some((place, hollow)),
                (None, _) if index == 0 => job.section.from = place,
                (None, None) => job.section.steps.push(Step::Line(place)),
                (None, Some((center, hollow))) => {
                    job.section.steps.push(Step::Arc { to: place, center, hollow });
                }
            }
        }
        Ok(job)
    }

    fn couplets(&mut self, items: &Items<'_>) {
        self.pitch = items.after("PITCH");
        self.turns = items.after("TURN");
        self.start = items.after("START");
        self.left = items.0.contains(&"LEFT");
        self.plane = items.0.contains(&"PLANE");
        self.starts = (items.after("TIMES") as usize).max(1);
        self.stock = items.after("STOCK");
        self.rough = items.after("ROUGH");
        if items.0.contains(&"DEPTH") {
            self.depth = items.after("DEPTH");
        }
        self.finish = items.after("FINISH");
        self.clear = items.after("CLEAR");
    }

    /// Length of the blank, mm.
    pub fn length(&self) -> f64 {
        self.turns * self.pitch
    }

    /// Travel along X for a degree of A, mm.
    pub fn lead(&self) -> f64 {
        let sense = if self.left { -1.0 } else { 1.0 };
        sense * self.pitch / 360.0
    }

    /// The cutter of that number.
    pub fn cutter(&self, number: u32) -> Option<&Cutter> {
        self.cutters.iter().find(|cutter| cutter.number == number)
    }
}

/// What stands after the slash of a statement.
struct Items<'t>(Vec<&'t str>);

impl Items<'_> {
    fn number(&self, index: usize) -> f64 {
        self.0.get(index).and_then(|item| item.parse().ok()).unwrap_or(0.0)
    }

    fn after(&self, name: &str) -> f64 {
        self.0.iter().position(|item| *item == name).map_or(0.0, |at| self.number(at + 1))
    }

    fn place(&self) -> Point {
        [self.number(0), self.number(2)]
    }
}

impl Cutter {
    fn read(items: &Items<'_>) -> Self {
        Cutter {
            number: (items.after("MILL") + items.after("BALL")) as u32,
            ball: items.0.contains(&"BALL"),
            diameter: items.after("DIAMTR"),
            speed: items.after("RPM"),
            feed: items.after("FEDRAT"),
        }
    }
}
