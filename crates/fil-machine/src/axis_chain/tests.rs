use nalgebra::Rotation3;

use super::*;

fn axis(carries: Carries, direction: [f64; 3]) -> Option<Rotary> {
    Some(Rotary {
        carries,
        direction: Unit::new_normalize(Vector3::from(direction)),
        center: Point3::origin(),
        letter: ROTARY_LETTERS[0],
        axis: 0,
        min: None,
        max: None,
        zones: Zones::default(),
    })
}

fn machine(first: Option<Rotary>, second: Option<Rotary>) -> AxisChain {
    AxisChain { rotaries: [first, second], tool: Vector3::z_axis(), pivot: None }
}

/// The solution turned back must give the tool axis it was asked for.
fn forward(machine: &AxisChain, angles: [f64; 2]) -> Vector3<f64> {
    machine.rotaries.iter().zip(angles).rev().fold(
        machine.tool.into_inner(),
        |tool, (rotary, angle)| match rotary {
            Some(r) => Rotation3::from_axis_angle(&r.direction, angle.to_radians()) * tool,
            None => tool,
        },
    )
}

#[test]
fn one_table_about_y_brings_the_point_under_the_tool() {
    let machine = machine(axis(Carries::Table, [0.0, 1.0, 0.0]), None);
    let c = 4.884_f64.to_radians();
    let angles = machine.solve(Vector3::new(libm::sin(c), 0.0, libm::cos(c)), [0.0; 2]).unwrap();
    assert!((angles[0] - 4.884).abs() < 1e-9);
    let point = machine.linear(Point3::new(81.0 * libm::sin(c), 7.0, 81.0 * libm::cos(c)), angles);
    assert!((point - Point3::new(0.0, 7.0, 81.0)).norm() < 1e-9);
    let sideways = machine.solve(Vector3::new(0.0, 0.3, 1.0), [0.0; 2]);
    assert_eq!(sideways.unwrap_err().code.name(), "E0508");
}

#[test]
fn five_axis_solutions_reach_the_axis_for_every_arrangement() {
    let x = [1.0, 0.0, 0.0];
    let z = [0.0, 0.0, 1.0];
    let nutating = [0.0, -1.0, 1.0];
    for (first, second) in [(z, x), (z, [0.0, 1.0, 0.0]), (z, nutating)] {
        for (a, b) in [
            (Carries::Table, Carries::Table),
            (Carries::Table, Carries::Head),
            (Carries::Head, Carries::Head),
        ] {
            let machine = machine(axis(a, first), axis(b, second));
            for step in 0..60 {
                let tilt = f64::from(step) * 0.026;
                let turn = f64::from(step) * 0.41;
                let want = Vector3::new(
                    libm::sin(tilt) * libm::cos(turn),
                    libm::sin(tilt) * libm::sin(turn),
                    libm::cos(tilt),
                );
                let angles = machine.solve(want, [0.0; 2]).unwrap();
                assert!((forward(&machine, angles) - want).norm() < 1e-6, "{angles:?}");
            }
        }
    }
}

#[test]
fn limits_choose_the_other_solution() {
    let mut second = axis(Carries::Table, [1.0, 0.0, 0.0]).unwrap();
    second.min = Some(0.0);
    let machine = machine(axis(Carries::Table, [0.0, 0.0, 1.0]), Some(second));
    for tilt in [0.2_f64, -0.2] {
        let angles =
            machine.solve(Vector3::new(0.0, libm::sin(tilt), libm::cos(tilt)), [0.0; 2]).unwrap();
        assert!(angles[1] >= 0.0);
    }
}

#[test]
fn a_pivot_moves_the_linear_axes_with_the_head() {
    let mut machine = machine(None, axis(Carries::Head, [0.0, 1.0, 0.0]));
    machine.pivot = Some(100.0);
    let point = machine.linear(Point3::origin(), [0.0, 90.0]);
    assert!((point - Point3::new(100.0, 0.0, -100.0)).norm() < 1e-9);
}
