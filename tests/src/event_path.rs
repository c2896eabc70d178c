//! The tool path of an NC program as our own interpreter sees it, in the form in
//! which LinuxCNC's is read, so that the two can be compared.

use fil_nc::motion::{Course, Event, Move, Rate};

use crate::path::{Action, Arc, Axis, Point, Step, ToolPath, Unit};

/// The path of events in mm. Motions that four decimals of `unit` do not show are left
/// out, as LinuxCNC does not print them; arcs are kept.
pub fn event_path(events: &[Event], unit: Unit) -> ToolPath {
    let mut at = [0.0; 3];
    let printed = |point: [f64; 3]| point.map(|value| (value / unit.in_mm() * 1e4).round());
    let mut steps = Vec::new();
    for event in events {
        match event {
            Event::Move(motion) => {
                let moves = printed(motion.to.linear) != printed(at) || motion.arc.is_some();
                let from = std::mem::replace(&mut at, motion.to.linear);
                if moves {
                    steps.push(Step { line: motion.line, action: action(motion, from) });
                }
            }
            Event::ToolChange { line, tool, .. } => {
                steps.push(Step { line: *line, action: Action::Tool(*tool) });
            }
            Event::Dwell { .. }
            | Event::Auxiliary { .. }
            | Event::LeftToControl { .. }
            | Event::ToolMeasured { .. }
            | Event::End { .. } => {}
        }
    }
    ToolPath { unit: Some(Unit::Mm), steps }
}

fn action(motion: &Move, from: Point) -> Action {
    let to = motion.to.linear;
    let rate = match motion.rate {
        Some(Rate::PerMinute(rate)) => Some(rate),
        // As LinuxCNC says it of a straight line.
        Some(Rate::Inverse(rate)) if motion.arc.is_none() => Some(rate * distance(from, to)),
        _ => None,
    };
    match (motion.course, motion.arc) {
        (Course::Machine, _) => Action::Reference(to),
        (Course::Rapid, _) => Action::Rapid(to),
        (_, None) => Action::Feed(to, rate),
        (_, Some(arc)) => {
            let normal = [Axis::X, Axis::Y, Axis::Z][arc.normal];
            let arc = Arc { to, center: arc.center, normal, ccw: arc.ccw, turns: 1 };
            Action::Arc(arc, rate)
        }
    }
}

fn distance(from: Point, to: Point) -> f64 {
    from.iter().zip(to).map(|(one, other)| (one - other).powi(2)).sum::<f64>().sqrt()
}

/// What is not the same in two paths, step by step; lengths may differ by `tolerance`
/// mm. The lines must be the same too.
pub fn differences(ours: &ToolPath, theirs: &ToolPath, tolerance: f64) -> Vec<String> {
    let unit = theirs.unit.map_or(1.0, Unit::in_mm);
    let mut list = Vec::new();
    for (index, own) in ours.steps.iter().enumerate() {
        let other = theirs.steps.get(index).map(|s| Step { action: s.action.scaled(unit), ..*s });
        let same = other.as_ref().is_some_and(|other| {
            own.line == other.line && same(&own.action, &other.action, tolerance)
        });
        if !same {
            list.push(format!("ours {own:?}\ntheirs {other:?}"));
        }
    }
    if theirs.steps.len() > ours.steps.len() {
        list.push(format!("{} more steps of theirs", theirs.steps.len() - ours.steps.len()));
    }
    list
}

fn same(own: &Action, other: &Action, tolerance: f64) -> bool {
    let point =
        |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance);
    let rate = |a: &Option<f64>, b: &Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() < 0.01,
        (a, b) => a.is_none() == b.is_none(),
    };
    match (own, other) {
        (Action::Tool(a), Action::Tool(b)) => a == b,
        (Action::Rapid(a), Action::Rapid(b)) | (Action::Reference(a), Action::Reference(b)) => {
            point(a, b)
        }
        (Action::Feed(a, f), Action::Feed(b, g)) => point(a, b) && rate(f, g),
        (Action::Arc(a, f), Action::Arc(b, g)) => {
            let in_plane = a
                .normal
                .plane()
                .iter()
                .all(|axis| (a.center[*axis] - b.center[*axis]).abs() < tolerance);
            point(&a.to, &b.to)
                && in_plane
                && (a.normal, a.ccw, a.turns) == (b.normal, b.ccw, b.turns)
                && rate(f, g)
        }
        _ => false,
    }
}
