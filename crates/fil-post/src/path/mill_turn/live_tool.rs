//! The positions of the axes for a live tool.

use crate::control::Control;
use crate::errors::PostCode;
use crate::operation::Target;
use crate::path::position;
use crate::path::position::Solution;
use crate::post::Post;
use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::commons::Int;
use fil_machine::locations as loc;
use nalgebra::{Point3, Vector3};

/// Tool axes nearer than this are one.
const SAME_AXIS: f64 = 1e-5;

/// A tool nearer than this to the axis of the spindle leaves C open, mm or inch.
pub(super) const CENTER: f64 = 1e-9;

const FULL: f64 = 360.0;

/// How a live tool lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lie {
    /// Along Z.
    Axial,
    /// Square to it.
    Radial,
}

pub(super) fn lie(axis: Vector3<f64>) -> Result<Lie> {
    let axis = axis.normalize();
    if (axis - Vector3::z()).norm() < SAME_AXIS {
        return Ok(Lie::Axial);
    }
    if axis.z.abs() < SAME_AXIS {
        return Ok(Lie::Radial);
    }
    PostCode::MillTurn.err(
        "the tool axis is neither parallel nor perpendicular to Z, and the machine can't tilt a tool",
    )
}

/// The machine mills by Y.
pub(super) fn has_y(control: &Control) -> bool {
    !control.tables.transforms && !control.tables.axis(1).is_off()
}

/// A face can be milled in polar interpolation.
pub(super) fn has_polar(control: &Control) -> bool {
    control.tables.transforms || tenths(control, loc::MILL_TURN_POLAR_CODE).is_some()
}

/// A function by a setting in tenths.
pub(super) fn tenths(control: &Control, at: Int) -> Option<FunctionCode> {
    let code = control.commons.int_opt(at).and_then(|code| u32::try_from(code).ok());
    code.filter(|code| *code > 0).map(FunctionCode::tenths)
}

/// A tool along Z cuts by X and C.
pub(in crate::path) fn is_cut_by_c(control: &Control) -> bool {
    control.tables.mills() && !has_y(control) && !has_polar(control)
}

/// The angle of C at which the tool is over a point of the part, degrees, the nearest to `last`.
pub(in crate::path) fn angle(tip: Point3<f64>, last: f64) -> f64 {
    let angle = libm::atan2(tip.y, tip.x).to_degrees();
    angle + FULL * ((last - angle) / FULL).round()
}

/// The positions of the axes for a live tool: C rounded as the tape has it, so that X, Y
/// and Z belong to where it really stands.
///
/// # Errors
/// A tool axis the machine can't reach; a way beside the axis of the spindle without Y.
pub fn position_of(
    post: &Post,
    point: Point3<f64>,
    axis: Vector3<f64>,
) -> Result<(Position, Solution)> {
    let last = post.path.rotary.unwrap_or_else(|| position::on_tape(post))[0];
    let has_y = has_y(&post.control);
    let asked = match lie(axis)? {
        Lie::Axial if has_y || libm::hypot(point.x, point.y) < CENTER => last,
        Lie::Axial => angle(point, last),
        Lie::Radial => libm::atan2(axis.y, axis.x).to_degrees(),
    };
    let tables = &post.control.tables;
    let c = tables.axis(3).on_tape(within_travel(post, asked, last)?)?;
    let mut linear = tables.chain().linear(point, [c, 0.0]);
    if !has_y {
        let half_digit = tables.axis(3).resolution().to_radians();
        let most = libm::hypot(point.x, point.y) * half_digit + CENTER;
        if linear.y.abs() > most.max(tables.axis(0).resolution()) {
            return PostCode::MillTurn.err(format!(
                "the tool would be {:.4} off the spindle center line, and the machine has no Y",
                linear.y
            ));
        }
        linear.y = 0.0;
    }
    Ok(([linear.x, linear.y, linear.z, c, 0.0], Solution::OfLiveTool([c, 0.0])))
}

/// Lets C turn a hole to an axial tool that X and Y don't bring there, such as one behind the axis of
/// the spindle for a turret that ends at it.
///
/// # Errors
/// As [`lie`].
pub(in crate::path) fn turn_to_hole(post: &mut Post, target: Target) -> Result<()> {
    if !post.control.tables.mills() || !has_y(&post.control) {
        return Ok(());
    }
    let (point, axis) = position::transformed(post, target);
    let last = post.path.rotary.unwrap_or_else(|| position::on_tape(post));
    let tables = &post.control.tables;
    let at = tables.chain().linear(point, last);
    let beyond = tables.exceeded([at.x, at.y, at.z]).and(AxisSet::XY);
    if lie(axis)? == Lie::Axial && !beyond.is_empty() {
        let asked = libm::atan2(point.y, point.x).to_degrees();
        post.path.rotary = Some([within_travel(post, asked, last[0])?, 0.0]);
    }
    Ok(())
}

/// The angle and whole turns on top that lies nearest to the last one within the travel.
fn within_travel(post: &Post, angle: f64, last: f64) -> Result<f64> {
    let Some(spindle) = &post.control.tables.chain().rotaries[0] else { return Ok(angle) };
    let near = angle + FULL * ((last - angle) / FULL).round();
    let allowed = |angle: &f64| {
        spindle.min.is_none_or(|min| *angle >= min) && spindle.max.is_none_or(|max| *angle <= max)
    };
    let found = [0.0, FULL, -FULL, 2.0 * FULL, -2.0 * FULL].map(|turn| near + turn);
    found.into_iter().find(allowed).ok_or_else(|| {
        fil_machine::errors::MachineCode::AxisLimit
            .diag(format!("{}{near:.3} lies outside the travel", spindle.letter))
    })
}
