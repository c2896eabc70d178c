//! Lathes: inserts and drills on the spindle axis through a profile.

mod holder;
pub(crate) mod insert;
mod part;
mod profile;

use std::collections::BTreeSet;

use fil_diag::Diag;
use fil_nc::interpret::interpret;
use fil_nc::motion::{Compensation, Course, Event, Move, Position, Spindle};

use crate::errors::StockCode;
use crate::finding::{Fault, Findings, Report};
use crate::removal::SKIN;
use crate::simulation::{Job, Left, Program, Simulated, chord_degrees};
use crate::survey::Survey;
use crate::tool::{Body, Tool};

pub use insert::Insert;
pub use profile::Profile;
use profile::{Hit, Kept};

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
    let profile = Profile::new(job.stock, job.grid)?;
    let report = Report { stock: profile.volume(), cell: profile.step(), ..Report::default() };
    let mut running = Turning {
        program,
        job,
        survey,
        report,
        findings: Findings::new(job.levels),
        at: None,
        plan: Position::default(),
        part: job.part.map(|part| part::of(part, &profile)),
        profile,
        without_holder: BTreeSet::new(),
    };
    interpret(program.text, program.name, program.dialect, &mut |event| {
        if let Event::Move(motion) = event {
            running.take(&motion);
        }
    })?;
    let Turning { profile, mut report, findings, without_holder, .. } = running;
    findings.end(&mut report);
    report.without_holder = without_holder.into_iter().collect();
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
    /// Inner and outer radius of the part in each disk.
    part: Option<Vec<[f64; 2]>>,
    without_holder: BTreeSet<u32>,
}

impl Turning<'_> {
    fn take(&mut self, motion: &Move) {
        let from = std::mem::replace(&mut self.plan, motion.to);
        let is_known = motion.course != Course::Machine && self.survey.knows_turning(motion);
        let end = is_known.then(|| [motion.to.linear[2], motion.to.linear[0]]);
        let start = std::mem::replace(&mut self.at, end);
        if motion.course == Course::Machine {
            return;
        }
        self.report.motions += 1;
        let Some(tool) = self.job.tools.get(&motion.modes.tool) else { return };
        if let Some(reason) = live(&from, motion) {
            self.leave_out(reason, motion);
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
        let kept = self.part.as_deref();
        let kept = kept.map(|radii| Kept { radii, tolerance: self.job.part_tolerance });
        let turned = match &tool.body {
            Body::Insert(insert) => self.profile.turn(way, insert, SKIN, kept),
            Body::Shape(_) if way.iter().any(|[_, x]| x.abs() >= ON_AXIS) => {
                if self.is_in_stock(way, tool) {
                    self.leave_out("drill or mill away from the spindle axis", motion);
                }
                return;
            }
            Body::Shape(shape) => {
                let tip = way[0][0].min(way[1][0]);
                self.profile.drill(tip, SKIN, kept, |height| shape.radius_at(height))
            }
        };
        // The holder follows: what the edge has just cut is not there any more.
        let holder = holder::touched(&self.profile, way, tool, SKIN);
        if turned.volume > 0.0 {
            *self.report.removed.entry(motion.modes.tool).or_default() += turned.volume;
            if tool.holder.is_empty() || tool.length.is_none() {
                self.without_holder.insert(motion.modes.tool);
            }
        }
        let is_rapid = motion.course == Course::Rapid;
        let stands = motion.modes.spindle.turn == Spindle::Off;
        let touch = if is_rapid { StockCode::RapidInStock } else { StockCode::SpindleStands };
        let is_wrong = is_rapid || stands;
        let hits = [
            (touch, if is_wrong { turned.touch } else { Hit::default() }),
            (StockCode::HolderInStock, holder),
            (StockCode::BelowPart, turned.part),
        ];
        for (code, hit) in hits.into_iter().filter(|(_, hit)| hit.depth > 0.0) {
            let ([x, z], Hit { depth, length, .. }) = (hit.at, hit);
            let fault =
                Fault { code: Some(code), depth, length, at: [x, 0.0, z], ..Fault::default() };
            self.add(&fault, motion);
        }
    }

    /// True when a drill or mill away from the spindle axis may be in the stock.
    fn is_in_stock(&self, way: [[f64; 2]; 2], tool: &Tool) -> bool {
        let Body::Shape(shape) = &tool.body else { return false };
        let tip = way[0][0].min(way[1][0]);
        let x = way.map(|[_, x]| x.abs());
        let least = x[0].min(x[1]) - shape.radius() + SKIN;
        let most = x[0].max(x[1]) + shape.radius() - SKIN;
        let disks = self.profile.between(tip + SKIN, f64::INFINITY);
        self.profile.disks()[disks]
            .iter()
            .any(|[inner, outer]| inner < outer && least < *outer && most > *inner)
    }

    /// Notes a motion that is not simulated.
    fn leave_out(&mut self, reason: &'static str, motion: &Move) {
        // A live tool at rapid removes nothing anyway.
        if motion.course != Course::Rapid {
            let code = Some(StockCode::NotTurning);
            self.add(&Fault { code, reason, ..Fault::default() }, motion);
        }
    }

    fn note(&mut self, code: StockCode, motion: &Move) {
        self.add(&Fault { code: Some(code), ..Fault::default() }, motion);
    }

    fn add(&mut self, fault: &Fault, motion: &Move) {
        self.findings.add(fault, motion.line, motion.modes.tool, self.report.motions);
    }
}

/// Why a motion is none of turning, if it is.
fn live(from: &Position, motion: &Move) -> Option<&'static str> {
    let to = &motion.to;
    if to.transformed || to.names_tip() {
        return Some("live tool in polar or cylindrical coordinates");
    }
    if motion.course != Course::Rapid && (from.rotary != to.rotary || to.linear[1] != 0.0) {
        return Some("live tool: Y or C moves");
    }
    (motion.modes.master.is_side == Some(true)).then_some("cut in the sub-spindle")
}
