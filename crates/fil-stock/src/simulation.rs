//! A program's tools moved through stock.

use std::collections::{BTreeMap, BTreeSet};

use fil_diag::{Diag, Levels};
use fil_nc::dialect::Dialect;
use fil_nc::forward::Forward;
use fil_nc::interpret::interpret;
use fil_nc::motion::{Arc, Compensation, Course, Event, Move, Position, Spindle};

use crate::errors::StockCode;
use crate::field::HeightField;
use crate::finding::{Fault, Findings, Report};
use crate::mesh::Mesh;
use crate::removal::{Contact, Wanted};
use crate::stock::Stock;
use crate::survey::Survey;
use crate::tool::{Body, Shape, Tool, Tools};
use crate::turning::{self, Profile};
use crate::way::Way;

/// Chords leave arcs by this part of a cell at most.
const OF_CELL: f64 = 1.0 / 50.0;

/// Chords leave arcs by so much at most, mm.
const MOST_OFF: f64 = 0.004;

/// Degrees that a rotary axis turns between two points of its way.
const TURN: f64 = 0.25;

/// Most pieces of one motion.
const MOST_PIECES: f64 = 20_000.0;

/// An NC program and the machine it is for.
#[derive(Clone, Copy)]
pub struct Program<'a> {
    /// Its text.
    pub text: &'a [u8],
    /// Its name in messages.
    pub name: &'a str,
    /// How the control reads it.
    pub dialect: &'a Dialect,
    /// The kinematics of the machine.
    pub forward: &'a Forward,
}

impl Program<'_> {
    /// The tool tip in the part, mm.
    pub(crate) fn tip(&self, position: &Position) -> [f64; 3] {
        if self.forward.has_rotary() || position.names_tip() {
            self.forward.tip(position).into()
        } else {
            position.linear
        }
    }
}

/// Where the zeros of work offsets lie, mm in the coordinates of the stock, by their numbers
/// ([`work_offset`](fil_nc::motion::work_offset): 54 for G54).
pub type Offsets = BTreeMap<u32, [f64; 3]>;

/// What a program is simulated with.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// The material.
    pub stock: &'a Stock,
    /// Its tools.
    pub tools: &'a Tools,
    /// The finished part, below whose surface nothing may be cut.
    pub part: Option<&'a Mesh>,
    /// How far a cut may be within the part, mm: a coarse surface lies within the true one.
    pub part_tolerance: f64,
    /// Size of a cell, mm; a four-hundredth of the stock when left out.
    pub grid: Option<f64>,
    /// Where work offsets lie in the stock; the first one that cuts lies at its zero.
    pub offsets: &'a Offsets,
    /// Levels of the codes of findings.
    pub levels: &'a Levels,
}

/// Stock after the last cut.
#[derive(Clone, Debug)]
pub enum Left {
    /// Of a mill.
    Field(HeightField),
    /// Of a lathe.
    Profile(Profile),
}

impl Left {
    /// The columns of a mill's stock.
    pub fn field(&self) -> Option<&HeightField> {
        match self {
            Left::Field(field) => Some(field),
            Left::Profile(_) => None,
        }
    }

    /// Volume of the material, mm³.
    pub fn volume(&self) -> f64 {
        match self {
            Left::Field(field) => field.volume(),
            Left::Profile(profile) => profile.volume(),
        }
    }

    /// The material as binary STL, mm.
    pub fn stl(&self) -> Vec<u8> {
        match self {
            Left::Field(field) => field.stl(),
            Left::Profile(profile) => profile.stl(),
        }
    }
}

/// What is left, and what was found.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// The stock after the last cut.
    pub left: Left,
    /// What was removed, and the findings.
    pub report: Report,
}

/// Simulates a program.
///
/// # Errors
/// What has no sure meaning on the machine; E0961 for tools without a size, E0962 for a program
/// that three axes in one coordinate system do not describe, E0963 for too many cells, E0965 for
/// stock without a volume, such as `auto` of a program without cuts below Z0.
pub fn simulate(program: &Program<'_>, job: &Job<'_>) -> Result<Simulated, Box<Diag>> {
    let survey = Survey::of(program)?;
    survey.refuse(program, job)?;
    if program.dialect.is_lathe() {
        return turning::simulate(program, job, &survey);
    }
    let Some(size) = job.stock.size(survey.cuts()) else {
        return StockCode::BadDescription.err("stock `auto`: the program has no cut below Z0");
    };
    let field = HeightField::new(job.stock, &size, job.grid)?;
    if field.volume() <= 0.0 {
        return match job.stock {
            Stock::Auto => StockCode::BadDescription
                .err("stock `auto`: the box around the cuts has no width; give its sides"),
            _ => StockCode::BadDescription.err("the stock has no volume"),
        };
    }
    let [x, y] = field.grid().step;
    let mut running = Running {
        program,
        job,
        survey: &survey,
        part: job.part.map(|part| field.part(part)),
        report: Report { stock: field.volume(), cell: x.max(y), ..Report::default() },
        field,
        findings: Findings::new(job.levels),
        at: None,
        shift: None,
        plan: Position::default(),
        without_holder: BTreeSet::new(),
    };
    interpret(program.text, program.name, program.dialect, &mut |event| {
        if let Event::Move(motion) = event {
            running.take(&motion);
        }
    })?;
    let Running { field, mut report, findings, without_holder, .. } = running;
    findings.end(&mut report);
    report.without_holder = without_holder.into_iter().collect();
    Ok(Simulated { left: Left::Field(field), report })
}

struct Running<'a> {
    program: &'a Program<'a>,
    job: &'a Job<'a>,
    survey: &'a Survey,
    field: HeightField,
    part: Option<Vec<f32>>,
    findings: Findings<'a>,
    report: Report,
    /// The tip; `None` while it is not known.
    at: Option<[f64; 3]>,
    /// Where the work offset lies in the stock.
    shift: Option<[f64; 3]>,
    /// Where the axes are.
    plan: Position,
    without_holder: BTreeSet<u32>,
}

impl Running<'_> {
    fn take(&mut self, motion: &Move) {
        let from = std::mem::replace(&mut self.plan, motion.to);
        let is_known = motion.course != Course::Machine && self.survey.knows(motion);
        self.shift = self.survey.shift(motion.modes.frame.fixture, self.job.offsets);
        let end = is_known.then(|| self.tip(&motion.to)).flatten();
        let start = std::mem::replace(&mut self.at, end);
        if motion.course == Course::Machine {
            return;
        }
        self.report.motions += 1;
        let Some(tool) = self.job.tools.get(&motion.modes.tool) else { return };
        let Body::Shape(shape) = tool.body else { return };
        if motion.modes.compensation.side != Compensation::Off && motion.course != Course::Rapid {
            self.note(StockCode::Compensated, motion);
        }
        match (start, end) {
            (Some(start), Some(end)) => {
                for way in self.ways(&from, motion, start, end) {
                    self.go(&way, (tool, &shape), motion);
                }
            }
            (None, Some(end)) if motion.course == Course::Rapid => {
                self.report.ends_only += 1;
                self.go(&Way::line(end, end), (tool, &shape), motion);
            }
            _ if motion.course == Course::Rapid => self.report.ends_only += 1,
            _ => self.note(StockCode::UnknownStart, motion),
        }
    }

    /// The tip in the stock; `None` where the place of the work offset is not known.
    fn tip(&self, position: &Position) -> Option<[f64; 3]> {
        let (tip, shift) = (self.program.tip(position), self.shift?);
        Some([0, 1, 2].map(|axis| tip[axis] + shift[axis]))
    }

    /// The ways of the tip in a motion.
    fn ways(&self, from: &Position, motion: &Move, start: [f64; 3], end: [f64; 3]) -> Vec<Way> {
        let turned = (0..2)
            .map(|axis| (motion.to.rotary[axis] - from.rotary[axis]).abs())
            .fold(0.0, f64::max);
        let turned = if motion.to.names_tip() { 0.0 } else { turned };
        if turned == 0.0 {
            match &motion.arc {
                None => return vec![Way::line(start, end)],
                Some(arc) if arc.normal == 2 && start[2] == end[2] && !motion.to.names_tip() => {
                    let [x, y, _] = self.shift.unwrap_or_default();
                    let center = [arc.center[0] + x, arc.center[1] + y];
                    let degrees = if arc.ccw { arc.angle } else { -arc.angle };
                    if !self.program.forward.has_rotary() {
                        return vec![Way::arc(start, center, degrees)];
                    }
                }
                Some(_) => {}
            }
        }
        let by_arc = motion
            .arc
            .as_ref()
            .map_or(0.0, |arc| arc.angle / chord_degrees(arc, from, self.report.cell));
        let count = by_arc.max(turned / TURN).ceil().clamp(1.0, MOST_PIECES) as u32;
        let mut at = start;
        let piece = |index: u32| {
            let share = f64::from(index) / f64::from(count);
            let forward = self.program.forward;
            let place = forward.along(from, &motion.to, motion.arc.as_ref(), share);
            let next = if index == count { end } else { self.tip(&place).unwrap_or(end) };
            Way::line(std::mem::replace(&mut at, next), next)
        };
        (1..=count).map(piece).collect()
    }

    /// Moves a tool along a way.
    fn go(&mut self, way: &Way, (tool, shape): (&Tool, &Shape), motion: &Move) {
        let is_rapid = motion.course == Course::Rapid;
        // A tool that goes down makes its own hole before its holder comes there.
        let before = (!way.is_vertical()).then(|| self.holder(way, tool));
        let stands = motion.modes.spindle.turn == Spindle::Off;
        let wanted = Wanted {
            touch: is_rapid || stands,
            center: if way.is_plunge() && !is_rapid { tool.toothless } else { 0.0 },
            part: self.part.as_deref().map(|part| (part, self.job.part_tolerance)),
        };
        let removed = self.field.cut(way, shape, wanted);
        let holder = before.unwrap_or_else(|| self.holder(way, tool));
        if removed.volume > 0.0 {
            *self.report.removed.entry(motion.modes.tool).or_default() += removed.volume;
            if tool.holder.is_empty() || tool.length.is_none() {
                self.without_holder.insert(motion.modes.tool);
            }
        }
        let touch = if is_rapid { StockCode::RapidInStock } else { StockCode::SpindleStands };
        let contacts = [
            (touch, removed.touch),
            (StockCode::HolderInStock, holder),
            (StockCode::BelowPart, removed.part),
            (StockCode::CenterPlunge, removed.center),
        ];
        for (code, contact) in contacts.iter().filter(|(_, contact)| contact.is_some()) {
            let Contact { depth, at, .. } = *contact;
            let (code, length) = (Some(*code), contact.length(way));
            self.add(&Fault { code, depth, length, at, ..Fault::default() }, motion);
        }
    }

    /// What the holder of a tool touches on a way.
    fn holder(&mut self, way: &Way, tool: &Tool) -> Contact {
        self.field.touched_by_holder(way, &tool.holder, tool.length.unwrap_or(f64::INFINITY))
    }

    /// A finding without a place in the stock.
    fn note(&mut self, code: StockCode, motion: &Move) {
        self.add(&Fault { code: Some(code), ..Fault::default() }, motion);
    }

    fn add(&mut self, fault: &Fault, motion: &Move) {
        self.findings.add(fault, motion.line, motion.modes.tool, self.report.motions);
    }
}

/// Degrees of an arc whose chord is near enough for a size of cells, mm.
pub(crate) fn chord_degrees(arc: &Arc, from: &Position, cell: f64) -> f64 {
    let [first, second] = arc.plane().map(|axis| from.linear[axis] - arc.center[axis]);
    let radius = libm::hypot(first, second).max(1e-9);
    let off = (cell * OF_CELL).min(MOST_OFF);
    let half = libm::acos((1.0 - off / radius).clamp(-1.0, 1.0));
    (2.0 * half.to_degrees()).min(30.0)
}
