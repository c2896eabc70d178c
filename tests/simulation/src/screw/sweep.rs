//! What passes leave and cut in the plane of the axis, as the paper counts: an end
//! mill is a rectangle, a ball a circle, both open above.

use super::passes::Pass;
use super::section::{Point, Section, plus};
use super::{Cutter, Job};

/// Distance of the columns that the stock is cut into, mm.
const COLUMN: f64 = 0.002;

/// What a sweep found.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// Deepest cut below the finished section, mm.
    pub gouge: f64,
    /// Deepest cut of roughing into the allowance, mm.
    pub into_stock: f64,
    /// Highest step of roughing above the allowance, mm.
    pub step: f64,
    /// Highest scallop of finishing, mm.
    pub scallop: f64,
}

/// Sweeps all passes over the section and compares with the job.
///
/// # Errors
/// What is beyond the limits of the job by more than its tolerance.
pub fn check(job: &Job, passes: &[Pass]) -> Result<Report, String> {
    let mut report = Report::default();
    let mut finishing = false;
    let mut tools: [Vec<(&Cutter, Point)>; 2] = [Vec::new(), Vec::new()];
    for pass in passes {
        let cutter = job.cutter(pass.tool).ok_or("an unknown cutter")?;
        if finishing && !cutter.ball {
            return Err("an end mill after a ball".to_string());
        }
        finishing = cutter.ball;
        let place = pass.place(job);
        let clearance = clearance(&job.section, cutter, place);
        report.gouge = report.gouge.max(-clearance);
        if !cutter.ball {
            report.into_stock = report.into_stock.max(job.stock - clearance);
        }
        tools[usize::from(cutter.ball)].push((cutter, place));
    }
    for kind in &tools {
        if kind.iter().any(|(cutter, _)| *cutter != kind[0].0) {
            return Err("several cutters where one is chosen".to_string());
        }
    }
    report.step = left(&job.section, &tools[0]) - job.stock;
    report.scallop = left(&job.section, &tools[1]);
    let limits = [
        ("gouge", report.gouge, 0.0),
        ("cut into the allowance", report.into_stock, 0.0),
        ("step", report.step, job.rough),
        ("scallop", report.scallop, job.finish),
    ];
    for (name, value, limit) in limits {
        if value > limit + job.tolerance {
            return Err(format!("{name} {value:.4}, allowed {limit}"));
        }
    }
    Ok(report)
}

/// Roughing goes level by level, and the outer passes of each touch the allowance.
///
/// # Errors
/// The level that does not.
pub fn check_levels(job: &Job, passes: &[Pass]) -> Result<(), String> {
    let mills = passes.iter().filter(|pass| job.cutter(pass.tool).is_some_and(|c| !c.ball));
    let mills: Vec<&Pass> = mills.collect();
    let mut above = job.section.top();
    for level in mills.chunk_by(|a, b| a.from[1] == b.from[1]) {
        if above - level[0].from[1] > job.depth + job.tolerance {
            return Err(format!("level {} is too deep", level[0].from[1]));
        }
        above = level[0].from[1];
        let radius = job.cutter(level[0].tool).map_or(0.0, |cutter| cutter.diameter / 2.0);
        let places = level.iter().map(|pass| pass.place(job));
        let xs: Vec<f64> = places.map(|place| place[0]).collect();
        let low = xs.iter().copied().fold(f64::INFINITY, f64::min) - radius;
        let high = xs.iter().copied().fold(f64::NEG_INFINITY, f64::max) + radius;
        for (x, outward) in [(low, -0.05), (high, 0.05)] {
            let off = job.section.signed([x, level[0].from[1]]);
            let beyond = job.section.signed([x + outward, level[0].from[1]]);
            if (off - job.stock).abs() > job.tolerance || beyond > off - 0.000_1 {
                return Err(format!("level {} stops {off:.4} off the section", level[0].from[1]));
            }
        }
    }
    Ok(())
}

/// Least distance of a cutter from the finished part, negative inside of it.
fn clearance(section: &Section, cutter: &Cutter, tip: Point) -> f64 {
    let radius = cutter.diameter / 2.0;
    if cutter.ball {
        let center = [tip[0], tip[1] + radius];
        let inside = section.height(center[0]) > center[1];
        return if inside { -radius } else { section.distance(center) - radius };
    }
    let bottom =
        (0..=400).map(|share| [tip[0] + radius * (f64::from(share) / 200.0 - 1.0), tip[1]]);
    let sides = (0..=200).flat_map(|share| {
        let z = tip[1] + (section.top() - tip[1]) * f64::from(share) / 200.0;
        [[tip[0] - radius, z], [tip[0] + radius, z]]
    });
    bottom.chain(sides).map(|point| section.signed(point)).fold(f64::INFINITY, f64::min)
}

/// How far the stock that is left reaches from the section, columns along X.
fn left(section: &Section, tools: &[(&Cutter, Point)]) -> f64 {
    let [first, last] = section.ends();
    let count = ((last - first) / COLUMN).ceil() as usize;
    let column = |index: usize| {
        let x = first + (last - first) * (index as f64 + 0.5) / count as f64;
        let z = surface(section, tools, x);
        if z > section.height(x) { section.distance([x, z]) } else { 0.0 }
    };
    (0..count).map(column).fold(0.0, f64::max)
}

/// Z of what tools leave at an X.
pub fn surface(section: &Section, tools: &[(&Cutter, Point)], x: f64) -> f64 {
    let cut = tools.iter().filter_map(|(cutter, tip)| bottom(cutter, *tip, x));
    cut.fold(section.top(), f64::min)
}

/// Z of the lower side of a cutter at an X.
fn bottom(cutter: &Cutter, tip: Point, x: f64) -> Option<f64> {
    let radius = cutter.diameter / 2.0;
    let across = x - tip[0];
    if across.abs() > radius {
        return None;
    }
    let drop = if cutter.ball { (radius * radius - across * across).sqrt() } else { radius };
    Some(tip[1] + radius - drop)
}

/// Width that an end mill has at a level when it keeps the allowance.
pub fn width(job: &Job, level: f64) -> f64 {
    let [first, last] = job.section.ends();
    let free =
        |x: f64| job.section.height(x) <= level && job.section.distance([x, level]) >= job.stock;
    let count = ((last - first) / COLUMN) as usize;
    let open = (0..=count).map(|index| first + index as f64 * COLUMN).filter(|x| free(*x));
    open.fold(None, |range: Option<(f64, f64)>, x| Some((range.map_or(x, |r| r.0), x)))
        .map_or(0.0, |range| range.1 - range.0)
}

/// True when a ball reaches each point that lies `height` from the section: some
/// place of its center covers the point and cuts nothing.
pub fn ball_reaches(section: &Section, radius: f64, height: f64) -> bool {
    section.samples(0.03).into_iter().all(|(point, normal)| {
        let point = plus(point, normal, height);
        if section.distance(point) < height - 1e-9 || point[1] > section.top() {
            return true;
        }
        let free = |angle: f64| {
            let center = plus(point, [angle.cos(), angle.sin()], radius - 1e-9);
            if center[1] < section.height(center[0]) { 0.0 } else { section.distance(center) }
        };
        let best = |middle: f64, step: f64| {
            let angles = (-180..=180).map(|index| middle + f64::from(index) * step);
            angles.max_by(|a, b| free(*a).total_cmp(&free(*b))).unwrap_or(middle)
        };
        if free(normal[1].atan2(normal[0])) >= radius {
            return true;
        }
        let angle = best(best(0.0, 1f64.to_radians()), 0.01f64.to_radians());
        // A ball as wide as the groove is free at one place only.
        free(best(angle, 0.0001f64.to_radians())) >= radius - 2e-4
    })
}
