//! Rapid motions in which rotary axes turn, where the program holds positions of the axes: no
//! block of them is divided, and the tip goes as the axes bring it.

use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::AxisChain;
use fil_machine::modes::INCH;
use nalgebra::{Point3, Vector3};

use super::tip::{between, nearest, tip};
use crate::control::Control;
use crate::errors::PostCode;
use crate::operation::motion::Motion;

/// Points of each block at which the tip is looked at.
const SAMPLES: u32 = 32;

/// A tip that comes no deeper below its line is worth no word, mm.
const LEAST: f64 = 1.0;

/// The sum of two directions is no direction where it is shorter: they are opposite.
const OPPOSITE: f64 = 1e-6;

/// Positions of a rotary axis nearer than this are one, degrees.
const SAME: f64 = 1e-6;

/// Along what a tip comes down.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Along {
    TheTool,
    EitherEnd,
}

/// Warns of a rapid motion in blocks of these axes that brings the tip below the line between its
/// ends. From a place that is not known nothing is said: a tool change or a point of the machine
/// has brought the tool away.
pub(super) fn warn_of_dip(control: &mut Control, motion: &Motion, blocks: &[AxisSet]) {
    warn_in_blocks(control, motion, blocks, Along::EitherEnd);
}

/// The same where the tool is out by a way that settings give: along the tool as it stands alone.
pub(super) fn warn_of_dip_when_out(control: &mut Control, motion: &Motion, blocks: &[AxisSet]) {
    warn_in_blocks(control, motion, blocks, Along::TheTool);
}

/// Where the axes stand before a motion that turns the machine; `None` where that is not known, or
/// the program holds no positions of the axes.
pub(super) fn turns_from(control: &Control, motion: &Motion) -> Option<Position> {
    let present = control.tables.present();
    if !holds_axes(control, motion) || motion.axes.and(present) != present {
        return None;
    }
    let from = stands(control, motion)?;
    let turns =
        |n: &usize| (motion.position[*n] - from[*n]).abs() >= control.tables.axis(*n).resolution();
    AxisSet::ROTARY.and(present).numbers().any(|n| turns(&n)).then_some(from)
}

/// Warns of a rapid motion out of a cut in blocks that end there and bring the tip aside from the
/// line between its ends: what stands beside the cut is not known. Says whether it did.
pub(super) fn warn_of_sweep(control: &mut Control, from: &Position, ends: &[Position]) -> bool {
    let Some(to) = ends.last() else { return false };
    let chain = control.tables.chain();
    let line = [from, to].map(|at| tip(chain, at));
    let farthest = farthest(from, ends, |here| {
        let tip = tip(chain, here);
        (nearest(line, tip) - tip).norm()
    });
    let is_far = is_far(control, farthest);
    if is_far {
        warn(
            control,
            format!(
                "a rapid move out of a cut that turns the machine brings the tip up to \
                 {farthest:.3} from its line"
            ),
        );
    }
    is_far
}

/// The program holds positions of the axes, and a motion has one of a rotary axis.
fn holds_axes(control: &Control, motion: &Motion) -> bool {
    let tables = &control.tables;
    let is_of_axes = !tables.mills() && !tables.frame_output && !tables.tip_output;
    is_of_axes && !motion.axes.and(AxisSet::ROTARY).and(tables.present()).is_empty()
}

/// Where blocks of these axes end.
pub(super) fn ends_of(
    control: &Control,
    motion: &Motion,
    blocks: &[AxisSet],
    from: &Position,
) -> Vec<Position> {
    let mut at = *from;
    let ends = blocks.iter().map(|axes| {
        let axes = axes.and(motion.axes).and(control.tables.present());
        at = std::array::from_fn(|n| if axes.has(n) { motion.position[n] } else { at[n] });
        at
    });
    ends.collect()
}

/// The most of a measure at points of blocks that end there.
fn farthest(from: &Position, ends: &[Position], measure: impl Fn(&Position) -> f64) -> f64 {
    let (mut at, mut most) = (from, 0.0_f64);
    for end in ends {
        most = (0..=SAMPLES)
            .map(|step| measure(&between(at, end, f64::from(step) / f64::from(SAMPLES))))
            .fold(most, f64::max);
        at = end;
    }
    most
}

/// A way of the tip, mm or inch, that must be told.
fn is_far(control: &Control, way: f64) -> bool {
    way * if control.is_metric() { 1.0 } else { INCH } > LEAST
}

fn warn(control: &mut Control, message: String) {
    let hint =
        || Some("Bring the tool away before its axis changes: GOHOME, RETRCT, or a GOTO.".into());
    control.warnings.add_with(PostCode::Undivided, message, hint);
}

fn warn_in_blocks(control: &mut Control, motion: &Motion, blocks: &[AxisSet], along: Along) {
    if !holds_axes(control, motion) {
        return;
    }
    let Some(from) = stands(control, motion) else { return };
    let ends = ends_of(control, motion, blocks, &from);
    look(control, &from, &ends, along);
}

/// Warns as [`warn_of_dip`] of blocks that end at these positions.
pub(super) fn warn_of_dip_between(control: &mut Control, from: &Position, ends: &[Position]) {
    look(control, from, ends, Along::EitherEnd);
}

fn look(control: &mut Control, from: &Position, ends: &[Position], along: Along) {
    let Some(to) = ends.last() else { return };
    if (3..5).all(|n| (to[n] - from[n]).abs() < SAME) {
        return;
    }
    let chain = control.tables.chain();
    let line = [from, to].map(|at| tip(chain, at));
    let axes = match along {
        Along::TheTool => Vec::new(),
        Along::EitherEnd => either_end([from, to].map(|at| chain.axis_at([at[3], at[4]]))),
    };
    let deepest = farthest(from, ends, |here| depth_below(chain, line, &axes, here));
    if is_far(control, deepest) {
        warn(
            control,
            format!(
                "a rapid move that turns the machine brings the tip up to {deepest:.3} below its \
                 line"
            ),
        );
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

/// The directions of the tool at both ends and the middle of both. No program says where the part
/// is, and a tip that sweeps sideways under one direction cuts under another.
fn either_end(axes: [Vector3<f64>; 2]) -> Vec<Vector3<f64>> {
    let middle = (axes[0] + axes[1]).try_normalize(OPPOSITE);
    axes.into_iter().chain(middle).collect()
}

/// How deep the tip lies below a line, along the tool as it stands there or one of these
/// directions.
fn depth_below(
    chain: &AxisChain,
    line: [Point3<f64>; 2],
    axes: &[Vector3<f64>],
    at: &Position,
) -> f64 {
    let tip = tip(chain, at);
    let below = nearest(line, tip) - tip;
    let here = chain.axis_at([at[3], at[4]]);
    axes.iter().chain([&here]).map(|axis| below.dot(axis)).fold(0.0, f64::max)
}
