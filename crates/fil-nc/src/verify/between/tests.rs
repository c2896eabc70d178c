//! The path between ends, by hand arithmetic and against dense sampling.

use fil_machine::axis_chain::{AxisChain, Carries, Rotary};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use super::way::Way;
use super::*;
use crate::bend;
use crate::forward;
use crate::motion::{self, Course, Modes};
use crate::verify::expected_step;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn rotary(carries: Carries, direction: [f64; 3], center: [f64; 3]) -> Option<Rotary> {
    Some(forward::tests::rotary(carries, direction, center))
}

fn machine(rotaries: [Option<Rotary>; 2], pivot: Option<f64>) -> Forward {
    Forward::new(AxisChain { rotaries, tool: Vector3::z_axis(), pivot })
}

fn at(linear: [f64; 3], rotary: [f64; 2]) -> Position {
    Position { linear, rotary, ..Position::default() }
}

fn feed(to: Position, arc: Option<motion::Arc>) -> Move {
    Move {
        line: 7,
        course: Course::Feed,
        to,
        arc,
        rate: None,
        in_cycle: false,
        known: [true; 5],
        to_machine: [false; 5],
        modes: Modes::default(),
    }
}

/// Tip and tool of a straight motion against the line between its own ends.
fn off(forward: &Forward, from: Position, to: Position) -> (f64, f64) {
    let ends = [forward.pose(&from), forward.pose(&to)];
    let way = Way::line(ends[0].tip, ends[1].tip);
    let found = feed(to, None);
    (tip_off(forward, &from, &found, &way, 0.0), axis_off(forward, &from, &found, &ends, 0.0))
}

#[test]
fn a_table_carries_the_tip_round_a_circle() {
    let forward = machine([rotary(Carries::Table, X, [0.0; 3]), None], None);
    // The tool stands 100 above the axis while the table turns by 90 degrees: a
    // quarter circle, whose chord is off by r (1 - cos 45) = 100 (1 - 0.70710678).
    let (tip, tool) =
        off(&forward, at([0.0, 0.0, 100.0], [0.0; 2]), at([0.0, 0.0, 100.0], [90.0, 0.0]));
    assert!((tip - 29.289_322).abs() < 2.0 * EXACT_TIP, "{tip}");
    // It turns in the plane of the two ends.
    assert!(tool < 0.001, "{tool}");
    // Five degrees: 100 (1 - cos 2.5) = 0.0951777.
    let (tip, _) =
        off(&forward, at([9.0, 0.0, 100.0], [0.0; 2]), at([9.0, 0.0, 100.0], [5.0, 0.0]));
    assert!((tip - 0.095_177_7).abs() < 2.0 * EXACT_TIP, "{tip}");
}

#[test]
fn a_head_swings_the_tip_about_its_pivot() {
    let forward = machine([None, rotary(Carries::Head, Y, [0.0; 3])], Some(200.0));
    // X and Z stay: the tip swings about the pivot, 200 (1 - cos 10) = 3.0384494.
    let (tip, tool) = off(&forward, at([0.0; 3], [0.0; 2]), at([0.0; 3], [0.0, 20.0]));
    assert!((tip - 3.038_449_4).abs() < 2.0 * EXACT_TIP, "{tip}");
    assert!(tool < 0.001, "{tool}");
}

#[test]
fn a_tool_turned_about_the_vertical_leaves_the_plane_of_its_ends() {
    let head = rotary(Carries::Head, X, [0.0; 3]);
    let forward = machine([rotary(Carries::Table, Z, [0.0; 3]), head], None);
    // Tilted by 30 degrees and turned from 0 to 90: half way it is tilted by 30, the
    // plane of the ends by atan(tan 30 cos 45) = 22.20765 degrees.
    let (tip, tool) = off(&forward, at([0.0; 3], [0.0, 30.0]), at([0.0; 3], [90.0, 30.0]));
    assert!((tool - 7.792_35).abs() < 0.001, "{tool}");
    // The tip is on the axis of the table.
    assert!(tip < EXACT_TIP, "{tip}");
}

#[test]
fn a_motion_round_its_own_line_keeps_its_distance_all_the_way() {
    let forward = machine([rotary(Carries::Table, Z, [0.0; 3]), None], None);
    // Three turns at radius 50 while Z goes down by 9: the CL file asks for a line.
    let (from, to) = (at([50.0, 0.0, 9.0], [0.0; 2]), at([50.0, 0.0, 0.0], [1080.0, 0.0]));
    let (tip, tool) = off(&forward, from, to);
    // Farthest after each half turn, on the other side: 2 r and, of the height, nothing,
    // as the foot on the line goes along.
    assert!((tip - 100.0).abs() < 1e-4, "{tip}");
    assert!(tool < 0.001, "{tool}");
}

#[test]
fn tool_tip_control_keeps_the_tip_on_its_line() {
    let forward = machine([rotary(Carries::Table, Z, [0.0; 3]), None], None);
    let controlled = |linear, turned| Position { tip_control: true, ..at(linear, [turned, 0.0]) };
    let (tip, _) = off(&forward, controlled([50.0, 0.0, 0.0], 0.0), controlled([9.0; 3], 100.0));
    assert!(tip < EXACT_TIP, "{tip}");
}

#[test]
fn what_is_not_more_than_enough_is_not_searched_for() {
    let forward = machine([rotary(Carries::Table, X, [0.0; 3]), None], None);
    let mut between = Between::default();
    let stands = at([0.0, 0.0, 100.0], [0.0; 2]);
    for (line, angle) in [(3, 5.0), (4, 10.0), (5, 10.0), (6, 4.0)] {
        let found = Move { line, ..feed(at([0.0, 0.0, 100.0], [angle, 0.0]), None) };
        let asked = Asked::line(forward.pose(&stands), forward.pose(&found.to));
        between.add(&forward, &stands, &found, &asked, [None; 2]);
    }
    // 100 (1 - cos 5) = 0.3805302, on the first line that has it.
    assert!((between.position.max - 0.380_530_2).abs() < 2.0 * EXACT_TIP, "{between:?}");
    assert_eq!(between.position.nc_line, 4);
}

#[test]
fn an_arc_is_no_distance_from_itself() {
    // A table that turns under a tool at radius 40 makes the arc that is asked for.
    let forward = machine([rotary(Carries::Table, Z, [0.0; 3]), None], None);
    let (from, to) = (at([40.0, 0.0, 3.0], [0.0; 2]), at([40.0, 0.0, 3.0], [70.0, 0.0]));
    let arc = expected_step::Arc {
        center: Point3::new(0.0, 0.0, -8.0),
        normal: Vector3::z(),
        start: forward.pose(&from).tip,
        end: forward.pose(&to),
        sweep: 70.0,
    };
    let tip = tip_off(&forward, &from, &feed(to, None), &Way::arc(&arc, [0.0, 70.0]), 0.0);
    assert!(tip < 2.0 * EXACT_TIP, "{tip}");
    // The line to the end is off by 40 (1 - cos 35) = 7.2339182.
    let (tip, _) = off(&forward, from, to);
    assert!((tip - 7.233_918_2).abs() < 2.0 * EXACT_TIP, "{tip}");
}

#[test]
fn a_helix_is_followed_turn_by_turn() {
    let forward = machine([rotary(Carries::Table, Z, [0.0; 3]), None], None);
    let (from, to) = (at([20.0, 0.0, 3.0], [0.0; 2]), at([20.0, 0.0, -9.0], [720.0, 0.0]));
    let arc = expected_step::Arc {
        center: Point3::origin(),
        normal: Vector3::z(),
        start: forward.pose(&from).tip,
        end: forward.pose(&to),
        sweep: 720.0,
    };
    let off = |from: &Position, to: Position, part| {
        tip_off(&forward, from, &feed(to, None), &Way::arc(&arc, part), 0.0)
    };
    // 2,000 points don't tell it from zero: steps of 1/1024 of two turns at radius 20 have
    // a sagitta of 0.0004, and so has the arc.
    let whole = off(&from, to, [0.0, 720.0]);
    assert!(whole < 1e-3, "{whole}");
    // The second turn by itself, 1 mm too deep in its middle.
    let middle = at([20.0, 0.0, -7.0], [540.0, 0.0]);
    let first = off(&at([20.0, 0.0, -3.0], [360.0, 0.0]), middle, [360.0, 540.0]);
    assert!((first - 1.0).abs() < 1e-4, "{first}");
}

/// A machine of any arrangement: table/table, table/head, head/head.
fn machines() -> impl Strategy<Value = Forward> {
    let carries = prop_oneof![
        Just([Carries::Table, Carries::Table]),
        Just([Carries::Table, Carries::Head]),
        Just([Carries::Head, Carries::Head]),
    ];
    let directions = prop_oneof![
        Just([Z, X]),
        Just([Z, Y]),
        Just([X, Y]),
        Just([[0.0, 0.0, -1.0], [0.0, -1.0, 1.0]]),
    ];
    let centers = proptest::array::uniform2(proptest::array::uniform3(-150.0..150.0f64));
    (carries, directions, centers, proptest::option::of(50.0..400.0)).prop_map(
        |(carries, directions, centers, pivot)| {
            machine([0, 1].map(|n| rotary(carries[n], directions[n], centers[n])), pivot)
        },
    )
}

/// Two ends: small steps as of a path, and turns of up to half a circle, each with
/// tool-tip control or without.
fn ends() -> impl Strategy<Value = (Position, Position)> {
    let point = proptest::array::uniform3(-150.0..150.0f64);
    let angles = proptest::array::uniform2(-180.0..180.0f64);
    let scale = prop_oneof![Just(0.02), Just(0.2), Just(1.0)];
    let by = (proptest::array::uniform3(-80.0..80.0f64), [-180.0..180.0f64, -180.0..180.0f64]);
    let control = proptest::array::uniform2(any::<bool>());
    (point, angles, by, scale, control).prop_map(|(point, angles, (way, turn), scale, control)| {
        let to = at(
            std::array::from_fn(|n| point[n] + scale * way[n]),
            std::array::from_fn(|n| angles[n] + scale * turn[n]),
        );
        let [before, after] = control;
        let from = Position { tip_control: before, ..at(point, angles) };
        (from, Position { tip_control: after, ..to })
    })
}

/// An arc of an NC block that begins at a point.
fn arc_from(start: [f64; 3], normal: usize, angle: f64) -> motion::Arc {
    let mut center = start;
    center[(normal + 1) % 3] += 12.0;
    motion::Arc { center, normal, ccw: angle > 0.0, angle: angle.abs() }
}

/// Distance of a point from a segment, by its three cases.
fn from_segment(point: Vector3<f64>, a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    let way = b - a;
    if way.dot(&(point - a)) <= 0.0 {
        return (point - a).norm();
    }
    if way.dot(&(point - b)) >= 0.0 {
        return (point - b).norm();
    }
    way.cross(&(point - a)).norm() / way.norm()
}

/// Angle between a direction and the way from one to another, degrees.
fn from_plane(axis: Vector3<f64>, a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    let normal = a.cross(&b).normalize();
    let beside = axis - normal * normal.dot(&axis);
    let within = a.cross(&beside).dot(&normal) >= 0.0 && beside.cross(&b).dot(&normal) >= 0.0;
    let off = if within {
        libm::asin(normal.dot(&axis)).abs()
    } else {
        axis.angle(&a).min(axis.angle(&b))
    };
    off.to_degrees()
}

/// Points of a motion.
const SAMPLES: u32 = 5_000;

fn samples() -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(|n| f64::from(n) / f64::from(SAMPLES))
}

proptest! {
    /// No sample is farther from the line than what is found, and what is found is
    /// on the way.
    #[test]
    fn the_farthest_tip_is_found(forward in machines(), (from, to) in ends()) {
        let [a, b] = [from, to].map(|at| forward.pose(&at).tip.coords);
        let tip = |share| forward.pose(&forward.along(&from, &to, None, share)).tip.coords;
        let dense = samples().map(|share| from_segment(tip(share), a, b)).fold(0.0, f64::max);
        let (found, _) = off(&forward, from, to);
        // Between two samples the path can be farther by an eighth of its bend.
        let coarse = bend::of_tip(&forward, &from, &to, None) / 8.0 / f64::from(SAMPLES * SAMPLES);
        prop_assert!(found >= dense - EXACT_TIP, "{found} {dense}");
        prop_assert!(found <= dense + coarse + EXACT_TIP, "{found} {dense}");
    }

    /// The same for the tool, against the great circle.
    #[test]
    fn the_farthest_tool_is_found(forward in machines(), (from, to) in ends()) {
        let [a, b] = [from, to].map(|at| forward.axis(at.rotary));
        prop_assume!(a.cross(&b).norm() > 1e-3);
        let axis = |share| forward.axis(forward.along(&from, &to, None, share).rotary);
        let dense = samples().map(|share| from_plane(axis(share), a, b)).fold(0.0, f64::max);
        let (_, found) = off(&forward, from, to);
        // Where the nearer end changes, the angle has an edge that samples miss.
        let turned = (0..2).map(|n| (to.rotary[n] - from.rotary[n]).abs()).sum::<f64>();
        let exact = 2.0 * EXACT_AXIS.to_degrees();
        prop_assert!(found >= dense - exact, "{found} {dense}");
        prop_assert!(found <= dense + turned / f64::from(2 * SAMPLES) + exact, "{found} {dense}");
    }

    /// And against an arc of the CL file, by its own points.
    #[test]
    fn the_farthest_tip_from_an_arc_is_found(
        forward in machines(),
        (from, to) in ends(),
        radius in 5.0..200.0f64,
        sweep in 10.0..170.0f64,
    ) {
        // A flat arc from the start of the motion.
        let start = forward.pose(&from).tip;
        let spoke = Vector3::new(radius, 0.0, 0.0);
        let on = |degrees: f64| {
            let (sine, cosine) = libm::sincos(degrees.to_radians());
            start - spoke + Vector3::new(cosine, sine, 0.0) * radius
        };
        let end = Pose { tip: on(sweep), axis: Vector3::z() };
        let arc =
            expected_step::Arc { center: start - spoke, normal: Vector3::z(), start, end, sweep };
        let points: Vec<Point3<f64>> = (0..=1_000).map(|n| on(sweep * f64::from(n) / 1e3)).collect();
        let tip = |share| forward.pose(&forward.along(&from, &to, None, share)).tip;
        let nearest = |tip: Point3<f64>| {
            points.iter().map(|point| (point - tip).norm()).fold(f64::MAX, f64::min)
        };
        let dense = (0..=300).map(|n| nearest(tip(f64::from(n) / 300.0))).fold(0.0, f64::max);
        let found = tip_off(&forward, &from, &feed(to, None), &Way::arc(&arc, [0.0, sweep]), 0.0);
        // Never too small. Nor too large, but for points so far away that the place at the
        // same angle need not be the nearest.
        let spacing = radius * sweep.to_radians() / 1e3;
        prop_assert!(found >= dense - spacing - EXACT_TIP, "{found} {dense}");
        let coarse = bend::of_tip(&forward, &from, &to, None) / 8.0 / 90_000.0;
        let far = dense > radius / 2.0;
        prop_assert!(far || found <= dense + coarse + spacing + EXACT_TIP, "{found} {dense}");
    }

    /// The curve never bends more than its bound.
    #[test]
    fn the_bend_is_bounded(
        forward in machines(),
        (from, to) in ends(),
        arc in proptest::option::of((0usize..3, -400.0..400.0f64)),
    ) {
        let arc = arc.map(|(normal, angle)| arc_from(from.linear, normal, angle));
        let step = 1e-3;
        let second = |curve: &dyn Fn(f64) -> Vector3<f64>, share: f64| {
            (curve(share - step) - 2.0 * curve(share) + curve(share + step)).norm() / step / step
        };
        let along = |share| forward.along(&from, &to, arc.as_ref(), share);
        let tip = |share| forward.pose(&along(share)).tip.coords;
        let axis = |share| forward.axis(along(share).rotary);
        let [of_tip, of_axis] = [
            bend::of_tip(&forward, &from, &to, arc.as_ref()),
            bend::of_axis(&forward, &from, &to),
        ];
        for share in (1..200).map(|n| f64::from(n) / 200.0) {
            prop_assert!(second(&tip, share) <= of_tip * (1.0 + 1e-9) + 1e-3);
            prop_assert!(second(&axis, share) <= of_axis * (1.0 + 1e-9) + 1e-6);
        }
    }
}
