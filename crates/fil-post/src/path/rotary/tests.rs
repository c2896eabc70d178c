use nalgebra::Point3;
use proptest::prelude::*;

use super::*;
use crate::path::tip::tip;
use crate::path::trial::{HEAD_AND_TABLE, HEADS, TABLES, coordinates, post};

/// Tool axes of the upper half, of any length.
fn axes() -> impl Strategy<Value = Vector3<f64>> {
    ([-1.0..1.0, -1.0..1.0, 0.05..1.0], 0.5..2.0)
        .prop_map(|(axis, length): ([f64; 3], f64)| Vector3::from(axis).normalize() * length)
}

proptest! {
    /// The axes of a solution, turned forward, bring the tip to its point and the tool along its axis.
    #[test]
    fn the_machine_goes_where_the_cl_file_says(
        point in coordinates(), axis in axes(), last in [-170.0..170.0, -170.0..170.0],
    ) {
        for machine in [&TABLES[..], &HEAD_AND_TABLE, &HEADS] {
            let mut post = post(machine);
            post.path.rotary = Some(last);
            let target = Target { point: Point3::from(point), axis, word: 0 };
            let (position, solution) = position_of(&post, target).expect("a tool axis in reach");
            let chain = post.control.tables.chain();
            let (at, along) = (tip(chain, &position), chain.axis_at([position[3], position[4]]));
            prop_assert!((at - target.point).norm() < 1e-6, "{at} for {}", target.point);
            prop_assert!((along - axis.normalize()).norm() < 1e-6, "{along} for {axis}");
            let Solution::Angles { angles, turns, .. } = solution else {
                panic!("no angles of a machine that turns");
            };
            prop_assert_eq!(angles, [position[3], position[4]]);
            prop_assert_eq!(turns.map(|turn| turn.degrees), angles);
        }
    }

    /// To ask again from where a solution has brought the machine turns nothing.
    #[test]
    fn a_solution_is_its_own_nearest(
        point in coordinates(), axis in axes(), last in [-170.0..170.0, -170.0..170.0],
    ) {
        let mut post = post(&TABLES);
        post.path.rotary = Some(last);
        let target = Target { point: Point3::from(point), axis, word: 0 };
        let (first, solution) = position_of(&post, target).expect("a tool axis in reach");
        establish(&mut post, solution).expect("the first tool");
        let (second, _) = position_of(&post, target).expect("a tool axis in reach");
        let apart = (0..AXES).map(|number| (first[number] - second[number]).abs());
        prop_assert!(apart.fold(0.0, f64::max) < 1e-9, "{first:?} and {second:?}");
        prop_assert!(turned(Some([first[3], first[4]]), post.path.rotary).is_none());
    }
}

#[test]
fn a_machine_without_rotary_axes_stands_at_the_point() {
    let post = post(&[]);
    let target = Target { point: Point3::new(1.0, 2.0, 3.0), axis: Vector3::z(), word: 0 };
    let (position, solution) = position_of(&post, target).unwrap();
    assert_eq!(position, [1.0, 2.0, 3.0, 0.0, 0.0]);
    assert!(matches!(solution, Solution::Still));
    let leaning = Target { axis: Vector3::new(0.1, 0.0, 1.0), ..target };
    assert_eq!(position_of(&post, leaning).unwrap_err().code.name(), "E0508");
}

/// What the look-ahead has chosen counts for one motion.
#[test]
fn a_chosen_position_goes_before_the_last_one() {
    let mut post = post(&TABLES);
    post.path.rotary = Some([0.0; 2]);
    post.path.turning.chosen = Some([170.0, -30.0]);
    let axis = post.control.tables.chain().axis_at([180.0, -30.0]);
    let target = Target { point: Point3::origin(), axis, word: 0 };
    let (position, solution) = position_of(&post, target).unwrap();
    assert!((position[3] - 180.0).abs() < 1e-6 && (position[4] + 30.0).abs() < 1e-6);
    establish(&mut post, solution).unwrap();
    assert_eq!(post.path.turning.chosen, None);
}
