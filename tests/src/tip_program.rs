//! Programs with tool-tip control (`G43.4`), written from a CL file alone: the tip as
//! the CL file has it, and the two angles of its tool axis by hand.
//!
//! The machines have a rotary axis C about Z next to the part or the base, and one about
//! X or Y next to the tool. A tool axis is then `Rz(c) Rx(a) z`, which is
//! `(sin a sin c, -sin a cos c, cos a)`, or `Rz(c) Ry(b) z`, which is
//! `(sin b cos c, sin b sin c, cos b)`, whatever carries the part and the tool.

use std::fmt::Write as _;

use filpost::{Builder, Program};

use crate::nc_cases::NcCase;
use crate::root;

/// A machine with two rotary axes.
pub struct Machine {
    /// What carries what.
    pub name: &'static str,
    /// The letter of the axis next to the tool.
    tilt: char,
    /// What the machine has besides the ready mill.
    settings: &'static [&'static str],
}

/// One of each arrangement.
pub const MACHINES: [Machine; 3] = [
    Machine {
        name: "two-tables",
        tilt: 'A',
        settings: &[
            "rotary.primary_kind=1",
            "rotary.primary_x=12.5",
            "rotary.primary_y=-7.25",
            "rotary.secondary_kind=1",
            "rotary.secondary_axis=1",
            "rotary.secondary_i=1",
            "rotary.secondary_j=0",
            "rotary.secondary_z=-60",
        ],
    },
    Machine {
        name: "table-and-head",
        tilt: 'B',
        settings: &[
            "rotary.primary_kind=1",
            "rotary.primary_x=-30",
            "rotary.secondary_kind=2",
            "rotary.secondary_axis=2",
            "rotary.secondary_i=0",
            "rotary.secondary_j=1",
            "rotary.pivot_distance=150",
            "tool.ignore_length=1",
        ],
    },
    Machine {
        name: "two-heads",
        tilt: 'A',
        settings: &[
            "rotary.primary_kind=2",
            "rotary.secondary_kind=2",
            "rotary.secondary_axis=1",
            "rotary.secondary_i=1",
            "rotary.secondary_j=0",
            "rotary.pivot_distance=220",
            "tool.ignore_length=1",
        ],
    },
];

/// Settings of all of them.
const COMMON: [&str; 10] = [
    // The programs end tool-tip control where the tool stands.
    "rotary.tip_end_retract=0",
    "rotary.primary_axis=3",
    "rotary.primary_i=0",
    "rotary.primary_j=0",
    "rotary.primary_k=1",
    "rotary.secondary_k=0",
    "address.A.format=4443",
    // One block for each motion, so that only tool-tip control keeps the tip on its line.
    "rotary.tolerance=0",
    "rotary.feed=1",
    "rapid.split=0",
];

impl Machine {
    /// The settings of the machine.
    pub fn builder(&self) -> Builder {
        let settings = COMMON.iter().chain(self.settings);
        settings
            .fold(Program::builder().generic("fanuc-mill"), |builder, setting| builder.set(setting))
    }

    /// The post of the machine.
    ///
    /// # Panics
    /// When it can't be built.
    pub fn post(&self) -> Program {
        self.builder().build().expect("a machine")
    }

    /// The angles of a tool axis: about Z, by the shorter way, and of the tilt. Upright,
    /// the first stays.
    fn angles(&self, [i, j, k]: [f64; 3], last: f64) -> [f64; 2] {
        let tilt = k.acos().to_degrees();
        if tilt < 1e-6 {
            return [last, 0.0];
        }
        let about_z = if self.tilt == 'A' { i.atan2(-j) } else { j.atan2(i) };
        let about_z = about_z.to_degrees();
        [about_z + 360.0 * ((last - about_z) / 360.0).round(), tilt]
    }

    /// The axes that stand in the table, at zero.
    fn tables_at_zero(&self) -> &'static str {
        match self.name {
            "two-tables" => "C0. A0.",
            "table-and-head" => "C0.",
            _ => "",
        }
    }

    /// The program with tool-tip control for a CL file of the kind in
    /// `tests/tip_control`.
    ///
    /// # Panics
    /// On a statement that those files do not have.
    pub fn tip_program(&self, cl: &str) -> String {
        let inch = cl.contains("INCHES");
        let mut writer = Writer {
            machine: self,
            nc: String::new(),
            last: [None; 5],
            tool: None,
            feed: None,
            cycle: None,
            unit: if inch { 1e4 } else { 1e3 },
            before: [0.0; 3],
        };
        writer.line(&format!("%\nO0001\nG{} G90 G94 G17", if inch { 20 } else { 21 }));
        let mut rapid = false;
        for line in cl.lines() {
            let (word, rest) = line.split_once(" / ").unwrap_or((line, ""));
            match word {
                "RAPID" => rapid = true,
                "GOTO" if writer.cycle.is_some() && !rapid => writer.hole(&numbers(rest)),
                "GOTO" => {
                    writer.before.copy_from_slice(&numbers(rest)[..3]);
                    writer.goto(&numbers(rest), std::mem::take(&mut rapid));
                }
                "CYCLE" => writer.cycle = Cycle::read(rest),
                "FEDRAT" => writer.feed = numbers(rest).first().copied(),
                "LOADTL" => writer.change_tool(&numbers(rest)),
                "SPINDL" => {
                    let turn = if rest.ends_with("CCLW") { 4 } else { 3 };
                    writer.line(&format!("S{} M{turn}", numbers(rest)[0]));
                }
                "COOLNT" => writer.line(if rest == "FLOOD" { "M8" } else { "M9" }),
                "FINI" => writer.line("G49\nM30\n%"),
                _ => {
                    assert!(line.starts_with("$$") || ["PARTNO", "UNITS", "MULTAX"].contains(&word))
                }
            }
        }
        writer.nc
    }
}

/// The numbers of a statement.
fn numbers(text: &str) -> Vec<f64> {
    text.split(',').filter_map(|part| part.trim().parse().ok()).collect()
}

/// CYCLE/DRILL or CYCLE/DEEP.
struct Cycle {
    depth: f64,
    feed: f64,
    clear: f64,
    step: Option<f64>,
    /// Back to the level before the cycle, and not to the clearance.
    back: bool,
}

impl Cycle {
    /// The couplets of the statement; `None` for OFF.
    fn read(text: &str) -> Option<Cycle> {
        let after = |name: &str| {
            let (_, rest) = text.split_once(&format!("{name}, "))?;
            rest.split(',').next()?.trim().parse().ok()
        };
        Some(Cycle {
            depth: after("DEPTH")?,
            feed: after("MMPM")?,
            clear: after("CLEAR")?,
            step: after("STEP"),
            back: text.ends_with("RETURN, 0"),
        })
    }
}

struct Writer<'m> {
    machine: &'m Machine,
    nc: String,
    /// X, Y, Z, C and the tilt as they stand on the tape.
    last: [Option<f64>; 5],
    /// The length offset of a tool that has not moved yet.
    tool: Option<f64>,
    /// A feed that no motion has yet.
    feed: Option<f64>,
    cycle: Option<Cycle>,
    /// Last digits in a millimetre, an inch or a degree.
    unit: f64,
    /// Where the CL file had the tool before the cycle.
    before: [f64; 3],
}

impl Writer<'_> {
    fn line(&mut self, line: &str) {
        self.nc += line;
        self.nc.push('\n');
    }

    fn change_tool(&mut self, numbers: &[f64]) {
        if self.tool.is_some() || self.last[0].is_some() {
            self.line("G49");
        }
        self.line(&format!("T{} M6", numbers[0]));
        self.tool = Some(*numbers.last().expect("a tool"));
        self.last = [None; 5];
    }

    /// A hole in single moves along the tool axis; after a peck they come back to 0.2 mm
    /// above it.
    fn hole(&mut self, start: &[f64]) {
        let Some(Cycle { depth, feed, clear, step, back }) = self.cycle else { return };
        let at = |height: f64| -> Vec<f64> {
            let point = (0..3).map(|n| start[n] + start[n + 3] * height);
            point.chain(start[3..].iter().copied()).collect()
        };
        self.goto(&at(clear), true);
        self.feed = Some(feed);
        let mut reached = clear;
        while let Some(step) = step.filter(|step| reached - step > -depth) {
            reached -= step;
            self.goto(&at(reached), false);
            self.goto(&at(clear), true);
            self.goto(&at(reached + 0.2), true);
        }
        self.goto(&at(-depth), false);
        let before: f64 = (0..3).map(|n| (self.before[n] - start[n]) * start[n + 3]).sum();
        self.goto(&at(if back { before } else { clear }), true);
    }

    fn goto(&mut self, numbers: &[f64], rapid: bool) {
        let c = self.last[3].unwrap_or(0.0);
        let [c, tilt] = self.machine.angles([numbers[3], numbers[4], numbers[5]], c);
        let to = [numbers[0], numbers[1], numbers[2], c, tilt];
        let letters = ['X', 'Y', 'Z', 'C', self.machine.tilt];
        let g = if rapid { "G0" } else { "G1" };
        if let Some(offset) = self.tool.take() {
            let zero = self.machine.tables_at_zero();
            if !zero.is_empty() {
                self.line(&format!("G0 {zero}"));
                self.last[3] = Some(0.0);
                self.last[4] = zero.contains('A').then_some(0.0);
            }
            self.line(&format!("G43.4 H{offset}"));
        }
        let mut block = g.to_string();
        for (n, letter) in letters.iter().enumerate() {
            let value = (to[n] * self.unit).round() / self.unit;
            if self.last[n].replace(value) != Some(value) {
                let _ = write!(block, " {letter}{value:?}");
            }
        }
        if let Some(feed) = self.feed.take_if(|_| !rapid) {
            let _ = write!(block, " F{feed:?}");
        }
        self.line(&block);
    }
}

/// The CL file of the tests.
///
/// # Panics
/// When it is not there.
pub fn part() -> String {
    file("five-axes.ncl")
}

fn file(name: &str) -> String {
    std::fs::read_to_string(root().join("tests/tip_control").join(name)).expect("a CL file")
}

/// The CL file on each machine, as the post writes it and with tool-tip control; holes
/// on the machine that turns them along its Z.
///
/// # Panics
/// When the post refuses it.
pub fn cases() -> Vec<NcCase> {
    let mut cases: Vec<NcCase> =
        MACHINES.iter().flat_map(|machine| both(machine, "five-axes")).collect();
    cases.extend(both(&MACHINES[0], "holes"));
    cases.extend(both(&MACHINES[1], "inches"));
    cases
}

/// A CL file on a machine, as the post writes it without and with tool-tip control, and
/// with it by hand.
fn both(machine: &Machine, name: &str) -> [NcCase; 3] {
    let cl = file(&format!("{name}.ncl"));
    let run = |post: Program| {
        let mut nc = Vec::new();
        post.stream(cl.as_bytes(), &mut nc).expect("a program");
        String::from_utf8(nc).expect("text")
    };
    let posted = machine
        .builder()
        .set("rotary.tip_output=1")
        .set("address.G.format=2121")
        .build()
        .expect("a machine");
    let forms = [
        ("axes", run(machine.post())),
        ("tip", machine.tip_program(&cl)),
        ("posted-tip", run(posted)),
    ];
    forms.map(|(form, nc)| NcCase {
        name: format!("{name}/{}-{form}", machine.name),
        cl: cl.clone().into_bytes(),
        nc,
        post: machine.post(),
        fil: false,
    })
}
