//! Rapid motions in which rotary axes turn, where the program holds positions of the axes: no
//! block of them is divided, and the tip goes as the axes bring it.

use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::AxisChain;
use nalgebra::Point3;

use super::tip::{between, nearest, tip};
use crate::control::Control;
use crate::control::word_address::motion::Motion;
use crate::errors::PostCode;

/// Points of each block at which the tip is looked at.
const SAMPLES: u32 = 32;

/// A tip that comes no deeper below its line is worth no word, mm.
const LEAST: f64 = 1.0;

/// Positions of a rotary axis nearer than this are one, degrees.
const SAME: f64 = 1e-6;

/// Warns of a rapid motion in blocks of these axes that brings the tip below the line between its
/// ends, along the tool as it stands there. From a place that is not known nothing is said: a
/// tool change or a point of the machine has brought the tool away.
pub(super) fn warn_of_dip(control: &mut Control, motion: &Motion, blocks: &[AxisSet]) {
    let tables = &control.tables;
    let is_of_axes = !tables.mills() && !tables.frame_output && !tables.tip_output;
    if !is_of_axes || motion.axes.and(AxisSet::ROTARY).and(tables.present()).is_empty() {
        return;
    }
    let Some(from) = stands(control, motion) else { return };
    let moved = |from: &Position, axes: AxisSet| {
        let axes = axes.and(motion.axes).and(tables.present());
        std::array::from_fn(|n| if axes.has(n) { motion.position[n] } else { from[n] })
    };
    let to: Position = moved(&from, AxisSet::ALL);
    if (3..5).all(|n| (to[n] - from[n]).abs() < SAME) {
        return;
    }
    let chain = tables.chain();
    let line = [&from, &to].map(|at| tip(chain, at));
    let (mut at, mut deepest) = (from, 0.0_f64);
    for axes in blocks {
        let end = moved(&at, *axes);
        deepest = (0..=SAMPLES)
            .map(|step| between(&at, &end, f64::from(step) / f64::from(SAMPLES)))
            .map(|here| depth_below(chain, line, &here))
            .fold(deepest, f64::max);
        at = end;
    }
    let mm = if control.is_metric() { 1.0 } else { 25.4 };
    if deepest * mm > LEAST {
        let message = format!(
            "a rapid motion that turns the machine brings the tip up to {deepest:.3} below its line"
        );
        let hint = || {
            Some("Bring the tool away before its axis changes: GOHOME, RETRCT, or a GOTO.".into())
        };
        control.warnings.add_with(PostCode::Undivided, message, hint);
    }
}

/// Where the axes stand; `None` where that of one is not known.
fn stands(control: &Control, motion: &Motion) -> Option<Position> {
    let mut from = Position::default();
    for number in control.tables.present().numbers() {
        let at = control.stands(number)?;
        from[number] = control.tables.axis(number).near(at, motion.position[number]);
    }
    Some(from)
}

/// How deep the tip lies below a line, along the tool.
fn depth_below(chain: &AxisChain, line: [Point3<f64>; 2], at: &Position) -> f64 {
    let tip = tip(chain, at);
    (nearest(line, tip) - tip).dot(&chain.axis_at([at[3], at[4]]))
}
