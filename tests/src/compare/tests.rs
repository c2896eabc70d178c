//! Hand-made paths: one that agrees, and what is said when it is changed.

use super::{Difference, compare};
use crate::path::{Action, Arc, Axis, Hole, Point, Step, ToolPath, Unit};

fn path(actions: Vec<Action>) -> ToolPath {
    let steps = actions.into_iter().zip(1..).map(|(action, line)| Step { line, action });
    ToolPath { unit: Some(Unit::Mm), steps: steps.collect() }
}

fn arc(to: Point, ccw: bool) -> Action {
    let center = [15.0, 0.0, 0.0];
    Action::Arc(Arc { to, center, normal: Axis::Z, ccw, turns: 1 }, Some(100.0))
}

fn feed(to: Point) -> Action {
    Action::Feed(to, Some(100.0))
}

/// Tool, rapid, feed, half circle, rapid up, two holes, rapid up.
fn cl() -> ToolPath {
    let hole = |x| Action::Hole(Hole { at: [x, 5.0], bottom: -3.0, clearance: 1.0 }, Some(50.0));
    path(vec![
        Action::Tool(1),
        Action::Rapid([10.0, 0.0, 5.0]),
        feed([10.0, 0.0, 0.0]),
        arc([20.0, 0.0, 0.0], true),
        Action::Rapid([20.0, 0.0, 5.0]),
        hole(20.0),
        hole(30.0),
        Action::Rapid([30.0, 5.0, 5.0]),
    ])
}

/// The same as an interpreter gives it: split rapid, machine point, expanded cycle.
fn nc() -> Vec<Action> {
    let drill = Some(50.0);
    vec![
        Action::Reference([0.0, 0.0, 0.0]),
        Action::Tool(1),
        Action::Rapid([10.0, 0.0, 0.0]),
        Action::Rapid([10.0, 0.0, 5.0]),
        feed([10.0, 0.0, 0.0]),
        arc([20.0, 0.0, 0.0], true),
        Action::Rapid([20.0, 0.0, 5.0]),
        Action::Rapid([20.0, 5.0, 5.0]),
        Action::Rapid([20.0, 5.0, 1.0]),
        Action::Feed([20.0, 5.0, -1.0], drill),
        Action::Rapid([20.0, 5.0, 1.0]),
        Action::Rapid([20.0, 5.0, -0.75]),
        Action::Feed([20.0, 5.0, -3.0], drill),
        Action::Rapid([20.0, 5.0, 1.0]),
        Action::Rapid([30.0, 5.0, 1.0]),
        Action::Feed([30.0, 5.0, -3.0], drill),
        Action::Rapid([30.0, 5.0, 5.0]),
    ]
}

fn differences(change: impl Fn(&mut Vec<Action>)) -> Vec<Difference> {
    let mut actions = nc();
    change(&mut actions);
    compare(&cl(), &path(actions))
}

/// Exactly one difference, which says this and names these lines.
fn one(change: impl Fn(&mut Vec<Action>), what: &str, cl_line: u32, nc_line: u32) {
    let found = differences(change);
    let lines = (Some(cl_line), Some(nc_line));
    match &found[..] {
        [only] if only.what.contains(what) && (only.cl_line, only.nc_line) == lines => {}
        _ => panic!("{what} expected at {lines:?}: {found:?}"),
    }
}

#[test]
fn the_same_path_has_no_difference() {
    assert_eq!(differences(|_| {}), []);
}

#[test]
fn inches_of_the_cl_are_millimetres_of_the_nc() {
    let inch = cl().steps.iter().map(|step| step.action.scaled(1.0 / 25.4)).collect();
    let inch = ToolPath { unit: Some(Unit::Inch), ..path(inch) };
    assert_eq!(compare(&inch, &path(nc())), []);
    assert!(!compare(&ToolPath { unit: Some(Unit::Mm), ..inch }, &path(nc())).is_empty());
}

#[test]
fn a_turned_arc_is_reported() {
    one(|nc| nc[5] = arc([20.0, 0.0, 0.0], false), "clockwise (G2), should be", 4, 6);
}

#[test]
fn a_moved_center_is_reported() {
    let center = [15.0, 0.01, 0.0];
    let moved = Arc { to: [20.0, 0.0, 0.0], center, normal: Axis::Z, ccw: true, turns: 1 };
    one(|nc| nc[5] = Action::Arc(moved, None), "arc with center X15.0000 Y0.0100", 4, 6);
}

#[test]
fn a_changed_digit_is_reported() {
    one(|nc| nc[4] = feed([10.0, 0.0, 0.001]), "Z0.0010, should be feed to", 3, 5);
    one(|nc| nc[4] = Action::Feed([10.0, 0.0, 0.0], Some(1000.0)), "feed rate 1000", 3, 5);
}

#[test]
fn rapid_and_feed_are_told_apart() {
    one(|nc| nc[4] = Action::Rapid([10.0, 0.0, 0.0]), "rapid to X10.0000", 3, 5);
    one(|nc| nc[6] = feed([20.0, 0.0, 5.0]), "in place of rapid", 5, 7);
}

#[test]
fn a_rapid_goes_down_last() {
    let (cl, mut low) = (
        path(vec![Action::Rapid([0.0, 0.0, 9.0]), Action::Rapid([9.0, 0.0, 1.0])]),
        vec![Action::Rapid([0.0, 0.0, 9.0]), Action::Rapid([9.0, 0.0, 9.0])],
    );
    low.push(Action::Rapid([9.0, 0.0, 1.0]));
    assert_eq!(compare(&cl, &path(low.clone())), []);
    low[1] = Action::Rapid([0.0, 0.0, 1.0]);
    assert!(!compare(&cl, &path(low)).is_empty());
}

#[test]
fn a_missing_hole_is_reported() {
    one(|nc| _ = nc.drain(14..16), "no hole at X30.0000 Y5.0000", 7, 15);
    one(|nc| _ = nc.drain(7..13), "no hole at X20.0000 Y5.0000", 6, 8);
}

#[test]
fn a_hole_too_deep_or_too_shallow_is_reported() {
    for z in [-3.1, -2.9] {
        one(|nc| nc[15] = Action::Feed([30.0, 5.0, z], None), "should be Z-3.0000", 7, 16);
    }
}

#[test]
fn rapid_into_the_hole_is_reported() {
    one(|nc| nc[11] = Action::Rapid([20.0, 5.0, -1.5]), "rapid into the hole", 6, 12);
    let low = |nc: &mut Vec<Action>| nc[8] = Action::Rapid([20.0, 5.0, 0.2]);
    assert!(differences(low)[0].what.contains("rapid into the hole, down to Z0.2000"));
}

#[test]
fn missing_and_added_steps_are_reported() {
    one(|nc| _ = nc.remove(4), "no feed to X10.0000", 3, 5);
    one(|nc| nc.insert(5, feed([11.0, 0.0, 0.0])), "asks for no feed to X11.0000", 4, 6);
    one(|nc| nc[1] = Action::Tool(2), "tool 2, should be tool 1", 1, 2);
    one(|nc| _ = nc.remove(1), "no change to tool 1", 1, 2);
    let more = differences(|nc| nc.push(feed([0.0; 3])));
    assert_eq!((more.len(), more[0].cl_line, more[0].nc_line), (1, None, Some(18)));
    let less = differences(|nc| nc.truncate(6));
    assert!(less.len() >= 4, "{less:?}");
}
