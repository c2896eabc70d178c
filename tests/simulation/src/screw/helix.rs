//! What passes cut in space. A point of the part at radius r in the plane of the axis
//! meets the cutter when the part has turned by some angle; it is cut when at that
//! angle it lies in the cutter.

use super::passes::Pass;
use super::section::{Point, plus};
use super::{Cutter, Job};

/// Further than this from the cutter in the plane of the axis nothing is cut, mm.
const REACH: f64 = 12.0;

/// Deepest cut of the passes of one kind of cutter below the finished section, mm,
/// along normals of the section `spacing` apart.
pub fn undercut(job: &Job, passes: &[Pass], ball: bool, spacing: f64) -> f64 {
    let tools = tools(job, passes, ball);
    let samples = job.section.samples(spacing);
    samples.iter().fold(0.0, |deepest, (point, normal)| {
        let cut = |depth: f64| {
            let point = plus(*point, *normal, -depth);
            tools.iter().any(|tool| cuts(job, tool, point))
        };
        if !cut(deepest) {
            return deepest;
        }
        let depth = deepen(cut, deepest);
        let end = plus(*point, *normal, -depth);
        // Behind a lip another wall is nearer.
        let depth = depth.min(job.section.distance(end));
        let [first, last] = job.section.ends();
        let beside = end[0] < first || end[0] > last;
        // Beside the groove the surface of the blank may be nearer.
        deepest.max(if beside { depth.min(job.section.top() - end[1]) } else { depth })
    })
}

/// True when the balls reach each point that lies `height` from the section.
pub fn reaches(job: &Job, passes: &[Pass], height: f64, spacing: f64) -> bool {
    let tools = tools(job, passes, true);
    job.section.samples(spacing).into_iter().all(|(point, normal)| {
        let point = plus(point, normal, height);
        job.section.distance(point) < height - 1e-9
            || point[1] > job.section.top()
            || tools.iter().any(|tool| cuts(job, tool, point))
    })
}

/// A cutter with the place of its tip in the section and beside the plane of the axis.
struct Tool<'j> {
    cutter: &'j Cutter,
    tip: Point,
    across: f64,
}

/// The cutters of one kind with the places of their tips.
fn tools<'j>(job: &'j Job, passes: &[Pass], ball: bool) -> Vec<Tool<'j>> {
    let tool = |pass: &Pass| {
        let cutter = job.cutter(pass.tool)?;
        Some(Tool { cutter, tip: pass.place(job), across: pass.across })
    };
    passes.iter().filter_map(tool).filter(|tool| tool.cutter.ball == ball).collect()
}

/// The greatest depth that is cut, from one that is.
fn deepen(cut: impl Fn(f64) -> bool, from: f64) -> f64 {
    let (mut good, mut bad) = (from, from + 0.001);
    while cut(bad) {
        (good, bad) = (bad, bad + 2.0 * (bad - from));
    }
    for _ in 0..40 {
        let middle = (good + bad) / 2.0;
        if cut(middle) { good = middle } else { bad = middle }
    }
    good
}

/// True when a pass cuts a point of the section.
fn cuts(job: &Job, tool: &Tool<'_>, point: Point) -> bool {
    let Tool { cutter, tip, across } = tool;
    let radius = cutter.diameter / 2.0;
    let lead = job.pitch / std::f64::consts::TAU;
    let [along, high] = [point[0] - tip[0], point[1]];
    if cutter.ball {
        let center = tip[1] + radius;
        // A positive turn of A brings the point from the plane of the axis towards +Y.
        let lead = if job.left { -lead } else { lead };
        let gap = |turn: f64| {
            (along - lead * turn).powi(2)
                + (high * turn.sin() - across).powi(2)
                + (high * turn.cos() - center).powi(2)
        };
        let near = gap(0.0) < (radius + REACH).powi(2)
            && (high - center.hypot(*across)).abs() < radius
            && along.abs() < radius + lead.abs();
        return near && gap(lowest(gap, 1.0)) < radius * radius;
    }
    if high <= tip[1] || along.abs() > radius + REACH {
        return false;
    }
    let gap = |turn: f64| (along - lead * turn).powi(2) + (high * turn.sin()).powi(2);
    let range = (tip[1] / high).acos();
    along.abs() < radius + lead * range && gap(lowest(gap, range)) < radius * radius
}

/// Where a function with one valley within `-range` to `range` is lowest: by sections of
/// the golden ratio, each of which asks for one value.
fn lowest(value: impl Fn(f64) -> f64, range: f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_895;
    let (mut low, mut high) = (-range, range);
    let [mut first, mut second] = [high - 2.0 * range * SHARE, low + 2.0 * range * SHARE];
    let [mut at_first, mut at_second] = [value(first), value(second)];
    for _ in 0..32 {
        if at_first < at_second {
            (high, second, at_second) = (second, first, at_first);
            first = high - (high - low) * SHARE;
            at_first = value(first);
        } else {
            (low, first, at_first) = (first, second, at_second);
            second = low + (high - low) * SHARE;
            at_second = value(second);
        }
    }
    (low + high) / 2.0
}
