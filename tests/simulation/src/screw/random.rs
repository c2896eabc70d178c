//! Random jobs: grooves of all kinds, with random measures and with the round ones of a
//! drawing, whose fillets touch the floor at a level of roughing and whose balls are as
//! wide as the groove.

use super::section::{Point, Section, Step};
use super::{Cutter, Job};

/// Numbers from a fixed row.
pub struct Dice(u64);

impl Dice {
    /// The row of a seed.
    pub fn new(seed: u64) -> Self {
        Dice(seed)
    }

    /// A number of a range.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// True in a share of all cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    /// A multiple of `step` in a range.
    pub fn round(&mut self, low: f64, high: f64, step: f64) -> f64 {
        (self.between(low, high + step) / step).floor() * step
    }

    /// One of a list.
    pub fn one<T: Copy>(&mut self, list: &[T]) -> T {
        list[(self.between(0.0, list.len() as f64) as usize).min(list.len() - 1)]
    }
}

/// A job with a random section.
pub fn job(dice: &mut Dice) -> Job {
    let makers = [any_walls, drawn, u_groove, one_upright, round_bottom, shelf, pointed];
    let section = dice.one(&makers)(dice);
    let [first, last] = section.ends();
    let mut job = Job::new(section, 1.0);
    job.pitch = (last - first) * dice.between(1.05, 3.0);
    job.turns = dice.between(0.5, 6.0);
    job.start = dice.between(-80.0, 80.0);
    job.left = dice.chance(0.5);
    job.stock = if dice.chance(0.5) {
        dice.one(&[0.0, 0.1, 0.2, 0.3, 0.5])
    } else {
        dice.between(0.0, 1.0)
    };
    job.rough = dice.between(0.2, 2.0);
    job.depth = dice.between(0.5, 10.0);
    job.finish = dice.between(0.01, 0.2);
    // A list for narrow grooves too.
    job.cutters.push(Cutter { number: 10, diameter: 1.5, ..job.cutters[0] });
    job.cutters.push(Cutter { number: 11, diameter: 0.6, ..job.cutters[0] });
    job
}

/// Two walls with fillets, a floor.
fn any_walls(dice: &mut Dice) -> Section {
    let top = dice.between(15.0, 60.0);
    let depth = dice.between(2.0, 10.0_f64.min(top - 5.0));
    let slope = |dice: &mut Dice| {
        if dice.chance(0.2) { 0.0 } else { depth * dice.between(0.05, 1.2) }
    };
    let [left, right] = [slope(dice), slope(dice)];
    let floor = dice.between(4.0, 18.0);
    let largest = 3.0_f64.min(0.9 * depth).min(0.45 * floor);
    let mut fillet = || if dice.chance(0.1) { 0.0 } else { dice.between(0.5, largest) };
    trapezoid(top, depth, [left, floor, right], [fillet(), fillet()])
}

/// The same with the measures of a drawing.
fn drawn(dice: &mut Dice) -> Section {
    let top = dice.round(15.0, 50.0, 0.5);
    let depth = dice.round(4.0, 9.0, 0.5);
    let slope = |dice: &mut Dice| {
        let degrees: f64 = dice.one(&[0.0, 5.0, 15.0, 30.0, 45.0]);
        depth * degrees.to_radians().tan()
    };
    let [left, right] = [slope(dice), slope(dice)];
    let floor = dice.round(8.0, 18.0, 1.0);
    let radii = [dice.round(1.0, 3.0, 0.5), dice.round(1.0, 3.0, 0.5)];
    trapezoid(top, depth, [left, floor, right], radii)
}

/// Upright walls with a half circle below.
fn u_groove(dice: &mut Dice) -> Section {
    let radius = dice.one(&[1.5, 2.5, 4.0, 6.0]);
    let top = dice.round(15.0, 40.0, 0.5);
    let depth = radius + dice.between(0.3, 6.0);
    trapezoid(top, depth, [0.0, 2.0 * radius, 0.0], [radius, radius])
}

/// An upright wall, an arc, a slope that it touches.
fn one_upright(dice: &mut Dice) -> Section {
    let radius = dice.one(&[1.5, 2.5, 4.0, dice.0 as f64 / 1e19 + 2.0]);
    let top = dice.round(15.0, 40.0, 0.5);
    let depth = radius + dice.between(0.5, 5.0);
    let slope = dice.between(10.0_f64, 50.0).to_radians();
    let bottom = top - depth;
    // The slope leaves the arc where it is as steep.
    let center = [radius, bottom + radius];
    let touch = [center[0] + radius * slope.cos(), center[1] - radius * slope.sin()];
    let end = [touch[0] + (top - touch[1]) * slope.tan(), top];
    let arc = Step::Arc { to: touch, center, hollow: true };
    let steps = vec![Step::Line([0.0, center[1]]), arc, Step::Line(end)];
    let section = Section { from: [0.0, top], steps };
    if dice.chance(0.5) { section.mirrored() } else { section }
}

/// An arc.
fn round_bottom(dice: &mut Dice) -> Section {
    let radius = dice.between(4.0, 12.0);
    let top = dice.round(20.0, 40.0, 0.5);
    let above = dice.between(0.0, 0.6 * radius);
    let half = (radius * radius - above * above).sqrt();
    let center = [half, top + above];
    let arc = Step::Arc { to: [2.0 * half, top], center, hollow: true };
    Section { from: [0.0, top], steps: vec![arc] }
}

/// A shelf in the left wall, lips above both.
fn shelf(dice: &mut Dice) -> Section {
    let top = dice.round(20.0, 40.0, 1.0);
    let upper = dice.round(2.5, 4.0, 0.5);
    let depth = upper + dice.round(2.5, 5.0, 0.5);
    let wide = dice.round(3.0, 6.0, 1.0);
    let floor = dice.round(8.0, 14.0, 1.0);
    let points: [Point; 8] = [
        [-2.0, top],
        [0.0, top],
        [upper, top - upper],
        [upper + wide, top - upper],
        [upper + wide + 2.0, top - depth],
        [upper + wide + 2.0 + floor, top - depth],
        [upper + wide + 2.0 + floor + depth, top],
        [upper + wide + 4.0 + floor + depth, top],
    ];
    let mut fillet = || dice.one(&[0.0, 0.5, 1.0, 1.2]);
    let radii = [fillet(), fillet(), fillet(), fillet(), fillet(), fillet()];
    Section::rounded(&points, &radii)
}

/// Two slopes and a fillet.
fn pointed(dice: &mut Dice) -> Section {
    let top = dice.round(15.0, 40.0, 0.5);
    let depth = dice.round(4.0, 8.0, 0.5);
    let [left, right] = [dice.round(3.0, 8.0, 0.5), dice.round(3.0, 8.0, 0.5)];
    let points = [[0.0, top], [left, top - depth], [left + right, top]];
    Section::rounded(&points, &[dice.one(&[0.75, 1.0, 1.5, 2.0])])
}

fn trapezoid(top: f64, depth: f64, [left, floor, right]: [f64; 3], radii: [f64; 2]) -> Section {
    let points =
        [[0.0, top], [left, top - depth], [left + floor, top - depth], [left + floor + right, top]];
    Section::rounded(&points, &radii)
}
