//! Pictures of a job: what the passes cut and leave, and how they go round the blank.

use super::passes::Pass;
use super::section::plus;
use super::{Cutter, Job, sweep};
use filpost_tests::picture::{Pen, Picture};

const THIN: Pen = Pen::full("#999", 1.0);
const PART: Pen = Pen::full("black", 2.0);
const CUT: Pen = Pen::full("#1565c0", 1.5);
const LEFT: Pen = Pen::full("#e65100", 1.0);
const STEP: Pen = Pen::full("#b71c1c", 2.0);
const LIMIT: Pen = Pen::dashed("#2e7d32", 1.2);

/// The section after roughing, and beside it after finishing.
pub fn section(job: &Job, passes: &[Pass]) -> Picture {
    let mut picture = Picture::default();
    let [first, last] = job.section.ends();
    let shift = last - first + 9.0;
    for (index, ball) in [false, true].into_iter().enumerate() {
        let shift = shift * index as f64;
        let tools: Vec<(&Cutter, [f64; 2])> = passes
            .iter()
            .filter_map(|pass| Some((job.cutter(pass.tool)?, pass.place(job))))
            .filter(|(cutter, _)| cutter.ball == ball)
            .collect();
        part(&mut picture, job, &tools, shift);
        if ball {
            finishing(&mut picture, &tools, shift);
        } else {
            roughing(&mut picture, job, &tools, shift);
        }
        let diameter = tools.first().map_or(0.0, |(cutter, _)| cutter.diameter);
        let text = if ball { "finishing: ball" } else { "roughing: end mill" };
        let middle = (first + last) / 2.0 + shift;
        picture.text(
            [middle, job.section.top() + 3.4],
            &format!("{text} {diameter}, {} passes", tools.len()),
        );
    }
    picture
}

/// The blank, the finished section, and the stock that is left on it.
fn part(picture: &mut Picture, job: &Job, tools: &[(&Cutter, [f64; 2])], shift: f64) {
    let [first, last] = job.section.ends();
    let top = job.section.top();
    let mut line: Vec<[f64; 2]> = vec![[first - 3.0 + shift, top]];
    line.extend(job.section.samples(0.2).iter().map(|(point, _)| [point[0] + shift, point[1]]));
    line.push([last + 3.0 + shift, top]);
    let bottom = line.iter().map(|point| point[1]).fold(top, f64::min) - 2.0;
    let corners = [[last + 3.0 + shift, bottom], [first - 3.0 + shift, bottom]];
    picture.area(&[line.clone(), corners.to_vec()].concat(), Pen::full("none", 0.0), "#e0e0e0");
    let count = ((last - first) / 0.02) as usize;
    let stock = (0..=count).map(|index| {
        let x = first + (last - first) * index as f64 / count as f64;
        [x + shift, sweep::surface(&job.section, tools, x)]
    });
    let back = line[1..line.len() - 1].iter().rev().copied();
    picture.area(&stock.chain(back).collect::<Vec<_>>(), LEFT, "#ffcc80");
    picture.line(&line, PART);
}

/// The tips in the order of the passes, and the section without the allowance.
fn roughing(picture: &mut Picture, job: &Job, tools: &[(&Cutter, [f64; 2])], shift: f64) {
    let samples = job.section.samples(0.1).into_iter();
    let offset = samples.map(|(point, normal)| plus(point, normal, job.stock));
    let kept = offset.filter(|point| job.section.distance(*point) > job.stock - 1e-6);
    let line: Vec<[f64; 2]> = kept.map(|point| [point[0] + shift, point[1]]).collect();
    picture.line(&line, LIMIT);
    for (index, (_, tip)) in tools.iter().enumerate() {
        let x = tip[0] + shift;
        picture.line(&[[x, tip[1]], [x, tip[1] + 0.4]], CUT);
        picture.text([x, tip[1] + 0.9], &(index + 1).to_string());
    }
    step_and_ends(picture, tools, &line, shift);
    if let Some((cutter, tip)) = tools.first() {
        let [x, radius] = [tip[0] + shift, cutter.diameter / 2.0];
        let top = job.section.top() + 2.5;
        let outline =
            [[x - radius, top], [x - radius, tip[1]], [x + radius, tip[1]], [x + radius, top]];
        picture.line(&outline, CUT);
    }
}

/// A and B, the ends of the last level, and the step h: how far the corner that the last
/// two levels leave stands off the wall. `wall` is the section without the allowance.
fn step_and_ends(
    picture: &mut Picture,
    tools: &[(&Cutter, [f64; 2])],
    wall: &[[f64; 2]],
    shift: f64,
) {
    let mut levels: Vec<f64> = tools.iter().map(|(_, tip)| tip[1]).collect();
    levels.dedup();
    let [.., before, last] = levels[..] else { return };
    let at_last = tools.iter().filter(|(_, tip)| tip[1] == last);
    let edges =
        at_last.map(|(cutter, tip)| [-1.0, 1.0].map(|side| tip[0] + side * cutter.diameter / 2.0));
    let [a, b] = edges.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [left, right]| {
        [a.min(left), b.max(right)]
    });
    for (x, side, name) in [(a, -1.0, "A"), (b, 1.0, "B")] {
        picture.circle([x + shift, last], 0.12, STEP);
        picture.text([x + shift + side * 0.9, last - 1.5], name);
    }
    let corner = [b + shift, before];
    let away = |point: &[f64; 2]| (point[0] - corner[0]).hypot(point[1] - corner[1]);
    let foot = wall.iter().min_by(|p, q| away(p).total_cmp(&away(q)));
    if let Some(foot) = foot {
        picture.line(&[corner, *foot], STEP);
        picture.text([corner[0] - 0.9, corner[1]], "h");
    }
}

/// The balls, and the path of their centers.
fn finishing(picture: &mut Picture, tools: &[(&Cutter, [f64; 2])], shift: f64) {
    let center =
        |(cutter, tip): &(&Cutter, [f64; 2])| [tip[0] + shift, tip[1] + cutter.diameter / 2.0];
    for tool in tools {
        picture.circle(center(tool), tool.0.diameter / 2.0, THIN);
        picture.circle(center(tool), 0.08, CUT);
    }
    picture.line(&tools.iter().map(center).collect::<Vec<_>>(), LIMIT);
}

/// The surface of the blank unrolled, X to the right and A upward, with the passes of the
/// first level of roughing.
pub fn unrolled(job: &Job, passes: &[Pass]) -> Picture {
    let first = passes.first().map_or(0.0, |pass| pass.from[1]);
    let count = passes.iter().take_while(|pass| pass.from[1] == first).count();
    // Degrees are drawn as far as they are on a blank a tenth as thick.
    let place = |at: [f64; 3]| [at[0], at[2] / 20.0];
    let mut picture = Picture::default();
    let angles = passes.iter().flat_map(|pass| [pass.from[2], pass.to[2]]);
    let (low, high) = angles.fold((0.0_f64, 0.0_f64), |(low, high), a| (low.min(a), high.max(a)));
    let [start, end] = [job.start, job.start + job.length()];
    let corners = [[start, low], [end, low], [end, high], [start, high]];
    let corners = corners.map(|[x, a]| [x, a / 20.0]);
    picture.area(&corners, Pen::full("none", 0.0), "#e0e0e0");
    let mut turn = (low / 360.0).ceil();
    while turn * 360.0 <= high {
        let a = turn * 360.0 + 0.0;
        picture.line(&[[start, a / 20.0], [end, a / 20.0]], THIN);
        picture.text([start - 6.0, a / 20.0 - 0.5], &format!("A{a}"));
        turn += 1.0;
    }
    for (index, pass) in passes.iter().take(count).enumerate() {
        picture.line(&[place(pass.from), place(pass.to)], CUT);
        let [x, a] = place(pass.from);
        picture.text([x, if index % 2 == 0 { a - 3.0 } else { a + 0.8 }], &(index + 1).to_string());
    }
    for pair in passes.windows(2).take(count.saturating_sub(1)) {
        picture.line(&[place(pair[0].to), place(pair[1].from)], LIMIT);
    }
    picture.text(
        [(start + end) / 2.0, high / 20.0 + 1.0],
        "blank, unrolled: X to the right, A upward",
    );
    picture.text(
        [(start + end) / 2.0, low / 20.0 - 5.0],
        &format!("first level: passes 1 to {count} at Z{first}; dashed: from one to the next"),
    );
    picture
}
