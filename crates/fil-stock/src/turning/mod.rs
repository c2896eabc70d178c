//! Lathes: inserts and drills on the spindle axis through a profile.

pub(crate) mod insert;
mod profile;

use fil_diag::{Diag, TextSpan};
use fil_nc::interpret::interpret;
use fil_nc::motion::{Compensation, Course, Event, Move, Position, Spindle};

use crate::errors::StockCode;
use crate::finding::{Fault, Findings, Report};
use crate::removal::SKIN;
use crate::simulation::{Job, Left, Program, Simulated, chord_degrees};
use crate::survey::Survey;
use crate::tool::{Body, Shape, Tool};

pub use insert::Insert;
pub use profile::Profile;
use profile::Turned;

/// A tool off the spindle axis by less is on it, mm.
const ON_AXIS: f64 = 1e-6;

/// Simulates a program of a lathe.
///
/// # Errors
/// As [`simulate`](crate::simulate).
pub(crate) fn simulate(
    program: &Program<'_>,
    job: &Job<'_>,
    survey: &Survey,
) -> Result<Simulated, Box<Diag>> {
    if job.part.is_some() {
        return StockCode::NotSimulated.err("a part can't be compared on a lathe");
    }
    let profile = Profile::new(job.stock, job.grid)?;
    let report = Report { stock: profile.volume(), cell: profile.step(), ..Report::default() };
    let mut running = Turning {
        program,
        job,
        survey,
        profile,
        report,
        findings: Findings::new(job.levels),
        at: None,
        plan: Position::default(),
        refused: None,
    };
    interpret(program.text, program.name, program.dialect, &mut |event| {
        if let Event::Move(motion) = event {
            running.take(&motion);
        }
    })?;
    if let Some(refused) = running.refused {
        return Err(refused);
    }
    let Turning { profile, mut report, findings, .. } = running;
    findings.end(&mut report);
    Ok(Simulated { left: Left::Profile(profile), report })
}

struct Turning<'a> {
    program: &'a Program<'a>,
    job: &'a Job<'a>,
    survey: &'a Survey,
    profile: Profile,
    report: Report,
    findings: Findings<'a>,
    /// Z and X of the programmed point; `None` while they are not known.
    at: Option<[f64; 2]>,
    plan: Position,
    /// Why the program can't be simulated.
    refused: Option<Box<Diag>>,
}

impl Turning<'_> {
    fn take(&mut self, motion: &Move) {
        let from = std::mem::replace(&mut self.plan, motion.to);
        let is_known = motion.course != Course::Machine && self.survey.knows(motion);
        let end = is_known.then(|| [motion.to.linear[2], motion.to.linear[0]]);
        let start = std::mem::replace(&mut self.at, end);
        if motion.course == Course::Machine || self.refused.is_some() {
            return;
        }
        self.report.motions += 1;
        let Some(tool) = self.job.tools.get(&motion.modes.tool) else { return };
        if let Some(why) = live(&from, motion) {
            self.refuse(motion, why);
            return;
        }
        if motion.modes.compensation.side != Compensation::Off && motion.course != Course::Rapid {
            self.note(StockCode::Compensated, motion);
        }
        match (start, end) {
            (Some(start), Some(end)) => {
                let mut at = start;
                for next in self.points(&from, motion, end) {
                    self.go([std::mem::replace(&mut at, next), next], tool, motion);
                }
            }
            (None, Some(end)) if motion.course == Course::Rapid => {
                self.report.ends_only += 1;
                self.go([end, end], tool, motion);
            }
            _ if motion.course == Course::Rapid => self.report.ends_only += 1,
            _ => self.note(StockCode::UnknownStart, motion),
        }
    }

    /// Points along a motion, its end last.
    fn points(&self, from: &Position, motion: &Move, end: [f64; 2]) -> Vec<[f64; 2]> {
        let Some(arc) = &motion.arc else { return vec![end] };
        let step = chord_degrees(arc, from, self.report.cell);
        let count = (arc.angle / step).ceil().max(1.0) as u32;
        let point = |index: u32| {
            if index == count {
                return end;
            }
            let share = f64::from(index) / f64::from(count);
            let place = self.program.forward.along(from, &motion.to, Some(arc), share);
            [place.linear[2], place.linear[0]]
        };
        (1..=count).map(point).collect()
    }

    fn go(&mut self, way: [[f64; 2]; 2], tool: &Tool, motion: &Move) {
        let turned = match &tool.body {
            Body::Insert(insert) => self.profile.turn(way, insert, SKIN),
            Body::Shape(shape) => match self.drilled(way, shape) {
                Some(turned) => turned,
                None => {
                    let what = "a drill or mill beside the spindle axis";
                    self.refuse(motion, what);
                    return;
                }
            },
        };
        if turned.volume > 0.0 {
            *self.report.removed.entry(motion.modes.tool).or_default() += turned.volume;
        }
        let is_rapid = motion.course == Course::Rapid;
        let stands = motion.modes.spindle.turn == Spindle::Off;
        if turned.depth > 0.0 && (is_rapid || stands) {
            let code = if is_rapid { StockCode::RapidInStock } else { StockCode::SpindleStands };
            let [x, z] = turned.at;
            let Turned { depth, length, .. } = turned;
            self.add(&Fault { code, depth, length, at: [x, 0.0, z] }, motion);
        }
    }

    /// What a drill on the axis removes; `None` of one that is in the stock elsewhere.
    fn drilled(&mut self, way: [[f64; 2]; 2], shape: &Shape) -> Option<Turned> {
        let tip = way[0][0].min(way[1][0]);
        if way.iter().all(|[_, x]| x.abs() < ON_AXIS) {
            return Some(self.profile.drill(tip, SKIN, |height| shape.radius_at(height)));
        }
        let mut copy = self.profile.clone();
        let reach = way.iter().map(|[_, x]| x.abs()).fold(0.0, f64::max) + shape.radius();
        let turned = copy.drill(tip, SKIN, |_| reach);
        (turned.volume == 0.0).then_some(turned)
    }

    fn refuse(&mut self, motion: &Move, what: &str) {
        let line = motion.line;
        let text = self.program.text.split(|byte| *byte == b'\n').nth(line as usize - 1);
        let text = String::from_utf8_lossy(text.unwrap_or_default()).trim_end().to_string();
        let place = TextSpan::line(self.program.name, line, text);
        self.refused = Some(Box::new(Diag::new(StockCode::NotSimulated, what).at(place)));
    }

    fn note(&mut self, code: StockCode, motion: &Move) {
        self.add(&Fault { code, depth: 0.0, length: 0.0, at: [0.0; 3] }, motion);
    }

    fn add(&mut self, fault: &Fault, motion: &Move) {
        self.findings.add(fault, motion.line, motion.modes.tool, self.report.motions);
    }
}

/// Why a motion is none of turning, if it is.
fn live(from: &Position, motion: &Move) -> Option<&'static str> {
    let to = &motion.to;
    if to.transformed || to.names_tip() {
        return Some("a live tool in polar or cylindrical coordinates");
    }
    if motion.course != Course::Rapid && (from.rotary != to.rotary || to.linear[1] != 0.0) {
        return Some("a live tool: Y or C moves");
    }
    (motion.modes.master.is_side == Some(true)).then_some("a cut in the sub-spindle")
}
