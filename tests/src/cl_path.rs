//! The tool path a CL file asks for, as the checker of `fil-nc` reads it without any post, in
//! the form in which LinuxCNC's is read.
//!
//! Covers what a three-axis mill without cutter compensation by the control
//! does: rapid and feed motions, arcs about a principal axis, drilling cycles
//! along Z, tool changes. A file that asks for more is refused, not read
//! half.

use std::io::Read;

use fil_cl::{Options, Reader};
use fil_nc::forward::Pose;
use fil_nc::motion::{Compensation, Rate};
use fil_nc::verify::{self, ClPath, ExpectedStep};

use crate::path::{Action, Arc, Axis, Hole, Point, Step, ToolPath, Unit};

/// How far an axis may be from a principal one.
const STRAIGHT: f64 = 1e-6;

/// The path of a CL text, in mm; `name` is what messages show.
///
/// # Errors
/// A CL text that cannot be read, and a statement this module does not cover.
pub fn cl_path(input: impl Read + Send, name: &str) -> Result<ToolPath, String> {
    cl_path_in(input, name, None)
}

/// The same of a CL text that does not say its unit itself.
///
/// # Errors
/// As [`cl_path`].
pub fn cl_path_in(
    input: impl Read + Send,
    name: &str,
    unit: Option<fil_machine::Unit>,
) -> Result<ToolPath, String> {
    let mut steps = Vec::new();
    let reader = Reader::new(input, name, Options::default());
    for step in ClPath::new(reader, name, [0.0; 3]).in_unit(unit) {
        let verify::Step { line, what } = step.map_err(|diag| diag.to_string())?;
        let parts = match what {
            ExpectedStep::Arc(arc, rate) => {
                turns_of(*arc).into_iter().map(|arc| ExpectedStep::Arc(arc.into(), rate)).collect()
            }
            other => vec![other],
        };
        for what in &parts {
            let action = action(what).map_err(|reason| format!("CL line {line}: {reason}"))?;
            steps.extend(action.map(|action| Step { line, action }));
        }
    }
    Ok(ToolPath { unit: Some(Unit::Mm), steps })
}

fn action(what: &ExpectedStep) -> Result<Option<Action>, String> {
    Ok(Some(match what {
        ExpectedStep::Rapid(pose) => Action::Rapid(tip(pose)?),
        ExpectedStep::Feed(pose, rate) => Action::Feed(tip(pose)?, minute(*rate)),
        ExpectedStep::Arc(arc, rate) => Action::Arc(self::arc(arc)?, minute(*rate)),
        ExpectedStep::Hole(hole) => {
            let [x, y, z] = tip(&hole.start)?;
            let clearance = z + hole.clear.unwrap_or(0.0);
            let hole_at = Hole { at: [x, y], bottom: z - hole.depth, clearance };
            Action::Hole(hole_at, minute(hole.rate))
        }
        ExpectedStep::Tool { number, .. } => Action::Tool(*number),
        ExpectedStep::Thread(..) | ExpectedStep::Insert { .. } | ExpectedStep::Unknown { .. } => {
            return Err(format!("{what:?} is not covered by this comparison"));
        }
        ExpectedStep::Compensation(side, _) if *side != Compensation::Off => {
            return Err("cutter compensation is not covered".to_string());
        }
        _ => return Ok(None),
    }))
}

/// A rate in mm a minute; `None` for the other kinds of feed.
fn minute(rate: Option<Rate>) -> Option<f64> {
    match rate {
        Some(Rate::PerMinute(rate)) => Some(rate),
        _ => None,
    }
}

/// The tip of an upright tool.
fn tip(pose: &Pose) -> Result<Point, String> {
    if (pose.axis.z - 1.0).abs() > STRAIGHT {
        return Err("the tool axis is not Z".to_string());
    }
    Ok(pose.tip.coords.into())
}

/// A helix of several turns as full turns and the rest.
fn turns_of(arc: verify::Arc) -> Vec<verify::Arc> {
    const TURN: f64 = 360.0;
    let rise = arc.normal * arc.normal.dot(&(arc.end.tip - arc.start));
    let mut parts = Vec::new();
    let (mut start, mut sweep) = (arc.start, arc.sweep);
    while sweep > TURN + 1e-6 {
        let tip = start + rise * (TURN / arc.sweep);
        let end = Pose { tip, ..arc.end };
        parts.push(verify::Arc { start, end, sweep: TURN, ..arc });
        (start, sweep) = (tip, sweep - TURN);
    }
    parts.push(verify::Arc { start, sweep, ..arc });
    parts
}

fn arc(arc: &verify::Arc) -> Result<Arc, String> {
    let along = (0..3).find(|axis| arc.normal[*axis].abs() > 1.0 - STRAIGHT);
    let index = along.ok_or("the axis of the circle is not X, Y or Z")?;
    Ok(Arc {
        to: tip(&arc.end)?,
        center: arc.center.coords.into(),
        normal: [Axis::X, Axis::Y, Axis::Z][index],
        ccw: arc.normal[index] > 0.0,
        turns: 1,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(text: &str) -> Result<Vec<Action>, String> {
        let path = cl_path(text.as_bytes(), "test")?;
        Ok(path.steps.into_iter().map(|step| step.action).collect())
    }

    #[test]
    fn rapid_holds_once_and_the_feed_stays() {
        let text = "UNITS / MM\nLOADTL / 2\nFEDRAT / 10.,  IPM\nRAPID\nGOTO / 1., 2., 3.\n\
                    GOTO / 1., 2., 0.\nFINI\n";
        let (start, end) = ([1.0, 2.0, 3.0], [1.0, 2.0, 0.0]);
        let expect = [Action::Tool(2), Action::Rapid(start), Action::Feed(end, Some(254.0))];
        assert_eq!(steps(text).unwrap(), expect);
    }

    #[test]
    fn a_circle_turns_about_its_axis() {
        let text = "UNITS / MM\nGOTO / 1., 0., 0.\nCIRCLE / 0., 0., 0., 0., 0., -1., 1.\n\
                    GOTO / 0., -1., 0.\n";
        let Action::Arc(arc, None) = steps(text).unwrap()[1] else { panic!("no arc") };
        assert_eq!((arc.to, arc.normal, arc.ccw), ([0.0, -1.0, 0.0], Axis::Z, false));
    }

    #[test]
    fn holes_go_down_from_their_start() {
        let text = "UNITS / MM\nCYCLE / DRILL, DEPTH, 3.5, MMPM, 50., CLEAR, 1.\n\
                    GOTO / 1., 2., 0.5\nCYCLE / OFF\nGOTO / 1., 2., 5.\n";
        let hole = Hole { at: [1.0, 2.0], bottom: -3.0, clearance: 1.5 };
        let expect = [Action::Hole(hole, Some(50.0)), Action::Feed([1.0, 2.0, 5.0], Some(50.0))];
        assert_eq!(steps(text).unwrap(), expect);
    }

    #[test]
    fn what_is_not_covered_is_refused() {
        for text in [
            "TRACUT / 1., 0., 0.\n",
            "CUTCOM / LEFT\n",
            "INSERT / G91\n",
            "GOTO / 0., 0., 0., 1., 0., 0.\n",
            "GOTO / 1., 0., 0.\nCIRCLE / 0., 0., 0., 0., 0.6, 0.8, 1.\nGOTO / 0., 0., 0.\n",
            "CYCLE / DRILL, 3.5, 50.\n",
        ] {
            assert!(steps(text).is_err(), "{text}");
        }
    }
}
