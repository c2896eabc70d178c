//! What must be known of a whole program before it is simulated.

use std::collections::{BTreeMap, BTreeSet};

use fil_diag::{Diag, TextSpan};
use fil_nc::interpret::interpret;
use fil_nc::motion::{Course, Event, Move, Position};

use crate::errors::StockCode;
use crate::simulation::{Job, Offsets, Program};
use crate::stock::Size;
use crate::tool::Body;

/// A tool axis with less than this beside Z is upright.
const UPRIGHT: f64 = 1e-7;

/// Axes of turning, a bit each.
const X_AND_Z: usize = 0b101;

/// How a tool is first used: the line of its first cut.
#[derive(Default)]
pub(crate) struct Survey {
    /// Axes that a block names, a bit each. One that none names does not move: it is known well
    /// enough.
    named: usize,
    /// The first line at feed of each tool, if its position is known.
    pub tools: BTreeMap<u32, u32>,
    /// The box around the ends of cuts, by the axes that are not known there.
    cuts: BTreeMap<usize, Size>,
    /// Work offsets of motions at feed, each with the line of the first.
    fixtures: Vec<(Option<u32>, u32)>,
    moved_zero: Option<u32>,
    tilted: BTreeMap<usize, u32>,
}

impl Survey {
    /// Reads a program.
    ///
    /// # Errors
    /// What has no sure meaning on the machine.
    pub fn of(program: &Program<'_>) -> Result<Survey, Box<Diag>> {
        let mut survey = Survey::default();
        interpret(program.text, program.name, program.dialect, &mut |event| {
            if let Event::Move(motion) = event {
                survey.take(&motion, program);
            }
        })?;
        Ok(survey)
    }

    fn take(&mut self, motion: &Move, program: &Program<'_>) {
        let unknown = unknown(motion);
        self.named |= !unknown & 31;
        if motion.course == Course::Machine {
            return;
        }
        if is_tilted(&motion.to, program) {
            self.tilted.entry(unknown).or_insert(motion.line);
        }
        if motion.course == Course::Rapid {
            return;
        }
        let modes = &motion.modes;
        self.tools.entry(modes.tool).or_insert(motion.line);
        let tip = program.tip(&motion.to);
        let size = self.cuts.entry(unknown).or_insert(Size { least: tip, most: tip });
        size.add(tip);
        let fixture = modes.frame.fixture;
        if !self.fixtures.iter().any(|(known, _)| *known == fixture) {
            self.fixtures.push((fixture, motion.line));
        }
        if modes.frame.moved_zero.is_some() {
            self.moved_zero.get_or_insert(motion.line);
        }
    }

    /// True when the end of a motion is known.
    pub fn knows(&self, motion: &Move) -> bool {
        unknown(motion) & self.named == 0
    }

    /// True when X and Z are known at the end of a motion of a lathe: C and Y do not change what an
    /// insert cuts.
    pub fn knows_turning(&self, motion: &Move) -> bool {
        unknown(motion) & self.named & X_AND_Z == 0
    }

    /// The first work offset that cuts: the stock counts from it. `None` where nothing cuts.
    fn first_fixture(&self) -> Option<Option<u32>> {
        self.fixtures.first().map(|(fixture, _)| *fixture)
    }

    /// Where a work offset lies in the stock, mm; `None` where that is not known.
    pub fn shift(&self, fixture: Option<u32>, offsets: &Offsets) -> Option<[f64; 3]> {
        let given = fixture.and_then(|fixture| offsets.get(&fixture).copied());
        let is_first = self.first_fixture().is_none_or(|first| first == fixture);
        given.or(is_first.then_some([0.0; 3]))
    }

    /// The box around all cuts.
    pub fn cuts(&self) -> Option<Size> {
        let known = self.cuts.iter().filter(|(unknown, _)| **unknown & self.named == 0);
        known.map(|(_, size)| *size).reduce(|mut all, size| {
            all.add(size.least);
            all.add(size.most);
            all
        })
    }

    /// Refuses a program that would be simulated wrongly.
    ///
    /// # Errors
    /// E0961, E0962
    pub fn refuse(&self, program: &Program<'_>, job: &Job<'_>) -> Result<(), Box<Diag>> {
        let at = |line: u32, what: String| {
            let text = program.text.split(|byte| *byte == b'\n').nth(line as usize - 1);
            let text = String::from_utf8_lossy(text.unwrap_or_default()).trim_end().to_string();
            Err(Box::new(Diag::new(StockCode::NotSimulated, what).at(TextSpan::line(
                program.name,
                line,
                text,
            ))))
        };
        let mut tilted = self.tilted.iter().filter(|(unknown, _)| **unknown & self.named == 0);
        if let Some((_, line)) = tilted.next().filter(|_| !program.dialect.is_lathe()) {
            return at(*line, "the tool axis is tilted".into());
        }
        let mut fixtures = self.fixtures.iter();
        if let Some((_, line)) =
            fixtures.find(|(fixture, _)| self.shift(*fixture, job.offsets).is_none())
        {
            let what =
                "a second work offset: its place beside the first one is not known (--offset)";
            return at(*line, what.into());
        }
        if let Some(line) = self.moved_zero {
            return at(line, "the origin was moved by a statement before this motion".into());
        }
        let unknown: BTreeSet<u32> =
            self.tools.keys().copied().filter(|tool| !job.tools.contains_key(tool)).collect();
        let list =
            |all: &BTreeSet<u32>| all.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
        let is_insert = |tool: &&u32| {
            matches!(job.tools.get(*tool).map(|tool| tool.body), Some(Body::Insert(_)))
        };
        if let Some(tool) =
            self.tools.keys().find(is_insert).filter(|_| !program.dialect.is_lathe())
        {
            return StockCode::BadDescription
                .err(format!("tool {tool} of a mill is a turning insert"));
        }
        match unknown.first() {
            None => Ok(()),
            Some(0) => StockCode::UnknownTool
                .err_with("the program cuts without a tool number", "Give tool 0 a size: --tool 0=D10."),
            Some(first) => Err(Box::new(
                Diag::new(StockCode::UnknownTool, format!("no size is given for tool {}", list(&unknown)))
                    .hint(format!(
                        "Give its diameter and corner radius, such as --tool {first}=D10R0.5, or the CL file with --cl."
                    )),
            )),
        }
    }
}

/// The axes that are not known where a motion ends, a bit each. Before its length offset is
/// active, nothing says where the tip of a tool is along it.
fn unknown(motion: &Move) -> usize {
    let known = |axis: usize| motion.known[axis] && !(axis == 2 && motion.modes.length.uncalled);
    (0..5).map(|axis| usize::from(!known(axis)) << axis).sum()
}

fn is_tilted(position: &Position, program: &Program<'_>) -> bool {
    let [x, y, z]: [f64; 3] = program.forward.axis(position.rotary).into();
    x.abs().max(y.abs()) > UPRIGHT || z < 0.0
}
