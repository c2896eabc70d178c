//! The passes of an NC program of a screw, read from its text.

use fil_nc::text::read_block;

use super::Job;

/// A cut: the tip goes in a line of X, Z and A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Line of the program, 1-based.
    pub line: u32,
    /// Tool in the spindle.
    pub tool: u32,
    /// X, Z and A at the start.
    pub from: [f64; 3],
    /// X, Z and A at the end.
    pub to: [f64; 3],
    /// Y, which stays.
    pub across: f64,
}

/// Rounding of a word of three decimals to the nearest, with a little over.
const ROUNDING: f64 = 0.000_51;

/// What is in force.
struct State {
    at: [f64; 4],
    feeds: bool,
    inverse: bool,
    rate: Option<f64>,
    tool: u32,
    spindle: bool,
    speed: f64,
    offset: Option<u32>,
}

/// Index of the coordinates in [`State::at`].
const LETTERS: [u8; 4] = *b"XYZA";

/// Reads the passes and looks at all motion on the way: cuts follow the helix at
/// the feed of their cutter from beside the blank to beside the blank, everything
/// else stays out of it.
///
/// # Errors
/// The line and what is wrong there.
pub fn read(job: &Job, nc: &str) -> Result<Vec<Pass>, String> {
    let mut state = State {
        at: [f64::NAN; 4],
        feeds: false,
        inverse: false,
        rate: None,
        tool: 0,
        spindle: false,
        speed: 0.0,
        offset: None,
    };
    let mut passes = Vec::new();
    for (line, text) in (1..).zip(nc.lines()) {
        let fault = |what: String| format!("line {line} `{text}`: {what}");
        if let Some(pass) = state.block(job, text, line).map_err(fault)? {
            passes.push(pass);
        }
    }
    if state.inverse {
        return Err("the program ends in G93".to_string());
    }
    Ok(passes)
}

impl State {
    fn block(&mut self, job: &Job, text: &str, line: u32) -> Result<Option<Pass>, String> {
        if text.starts_with('O') {
            return Ok(None);
        }
        let block = read_block(text.as_bytes(), "nc", line).map_err(|diag| diag.to_string())?;
        let from = self.at;
        self.rate = None;
        for word in &block.words {
            let value = word.number.value();
            match (word.letter, value) {
                (b'X' | b'Y' | b'Z' | b'A', _) => {
                    let index = LETTERS.iter().position(|letter| *letter == word.letter);
                    self.at[index.unwrap_or(0)] = value;
                }
                (b'G', 0.0) => self.feeds = false,
                (b'G', 1.0) => self.feeds = true,
                (b'G', 93.0) => self.inverse = true,
                (b'G', 94.0) => self.inverse = false,
                (b'G', 17.0 | 21.0 | 43.0 | 90.0) | (b'N', _) => {}
                (b'F', _) => self.rate = Some(value),
                (b'S', _) => self.speed = value,
                (b'T', _) => self.tool = value as u32,
                (b'H', _) => self.offset = Some(value as u32),
                (b'M', 6.0) => (self.spindle, self.offset) = (false, None),
                (b'M', 3.0) => self.spindle = true,
                (b'M', 30.0) => self.spindle = false,
                _ => return Err(format!("{}{value} is not expected", char::from(word.letter))),
            }
        }
        if from.map(f64::to_bits) == self.at.map(f64::to_bits) {
            return Ok(None);
        }
        let all = [from, self.at].concat();
        if !self.feeds {
            return self.idle(job, &from).map(|()| None);
        }
        if all.iter().any(|value| value.is_nan()) {
            return Err("a cut begins at an unknown place".to_string());
        }
        let place = |at: [f64; 4]| [at[0], at[2], at[3]];
        let across = self.at[1];
        let pass = Pass { line, tool: self.tool, from: place(from), to: place(self.at), across };
        let may_be_aside = job.plane && job.cutter(self.tool).is_some_and(|cutter| cutter.ball);
        if from[1] != across || across != 0.0 && !may_be_aside {
            return Err("the tool is not in the plane of the axis".to_string());
        }
        self.cut(job, &pass).map(|()| Some(pass))
    }

    /// A rapid stays above the blank or on one side of it.
    fn idle(&self, job: &Job, from: &[f64; 4]) -> Result<(), String> {
        let radius = job.cutter(self.tool).map_or(0.0, |cutter| cutter.diameter / 2.0);
        let above =
            |at: &[f64; 4]| at[2].is_nan() || at[2] >= job.section.top() + job.clear - ROUNDING;
        let side = |at: &[f64; 4]| beside(job, at[0], radius);
        let one_side = side(from) != 0 && side(from) == side(&self.at);
        if above(from) && above(&self.at) || one_side {
            return Ok(());
        }
        Err("a rapid goes through the blank".to_string())
    }

    /// A cut follows the helix through the whole blank at the right feed.
    fn cut(&self, job: &Job, pass: &Pass) -> Result<(), String> {
        let cutter = job.cutter(self.tool).ok_or("no cutter of the list is in the spindle")?;
        if !self.spindle || self.speed != cutter.speed || self.offset != Some(cutter.number) {
            return Err("spindle or length offset is not that of the cutter".to_string());
        }
        if pass.from[1] != pass.to[1] {
            return Err("Z moves in a cut".to_string());
        }
        let [start, end] = [pass.from, pass.to].map(|at| at[0] - job.lead() * at[2]);
        if (start - end).abs() > 2.0 * ROUNDING {
            return Err("X and A are not in step".to_string());
        }
        let sides = [pass.from, pass.to].map(|at| beside(job, at[0], cutter.diameter / 2.0));
        if sides[0] * sides[1] != -1 {
            return Err("the cut does not run out of the blank on both sides".to_string());
        }
        let turns = (pass.to[2] - pass.from[2]).abs() / 360.0;
        let way = turns * job.pitch.hypot(std::f64::consts::TAU * job.section.top());
        let feed = self.rate.filter(|_| self.inverse).ok_or("no feed of inverse time")? * way;
        if (feed / cutter.feed - 1.0).abs() > 0.001 {
            return Err(format!("the feed at the surface is {feed:.3}"));
        }
        Ok(())
    }
}

/// -1 left of the blank with the clearance, 1 right of it, else 0.
fn beside(job: &Job, x: f64, radius: f64) -> i32 {
    let off = radius + job.clear - ROUNDING;
    if x <= job.start - off {
        -1
    } else if x >= job.start + job.length() + off {
        1
    } else {
        0
    }
}

impl Pass {
    /// Where in the section the tip is at A = 0.
    pub fn place(&self, job: &Job) -> [f64; 2] {
        [self.from[0] - job.lead() * self.from[2], self.from[1]]
    }
}
