//! Forward kinematics: from the axes of a machine to tip and tool axis in the part.
//!
//! The chain is the one that `machine.toml` describes: the tool direction at zero
//! positions, turned by the heads, and what the tables carry, turned back. Only
//! the description of the machine is shared with the post; where its inverse
//! solves equations, this side multiplies rotations.

use fil_diag::Diag;
use fil_machine::Commons;
use fil_machine::axis_chain::{AxisChain, Carries, Rotary};
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use crate::motion::{Arc, Position};

/// Steps in which [`Forward::refine`] comes to its end; it doubles the digits in each.
const STEPS: usize = 8;

/// A step of so many degrees changes no digit any more.
const EXACT: f64 = 1e-12;

/// A tool axis with less than this of Z is square to it.
const SQUARE: f64 = 1e-5;

/// Least change of the tool axis by a degree of an axis that counts as turning it.
const TURNS: f64 = 2e-7;

/// Tip and axis of the tool in the part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Tool tip, mm.
    pub tip: Point3<f64>,
    /// Unit vector from the tip to the spindle.
    pub axis: Vector3<f64>,
}

/// How what X, Y, Z name lies in the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Turns directions of X, Y, Z into those of the part.
    pub turn: Matrix3<f64>,
    /// Tip in the part when X, Y, Z are zero, mm.
    pub origin: Point3<f64>,
}

/// The forward kinematics of a machine.
#[derive(Clone, Debug)]
pub struct Forward {
    machine: AxisChain,
}

impl Forward {
    /// The machine that the settings describe.
    ///
    /// # Errors
    /// A direction of length zero.
    pub fn from_commons(commons: &Commons) -> Result<Self, Box<Diag>> {
        Ok(Forward { machine: AxisChain::from_commons(commons)? })
    }

    /// The machine with these rotary axes.
    pub fn new(machine: AxisChain) -> Self {
        Forward { machine }
    }

    /// True when the machine has a rotary axis.
    pub fn has_rotary(&self) -> bool {
        self.machine.rotaries.iter().any(Option::is_some)
    }

    /// The rotary axes, primary first.
    pub fn rotaries(&self) -> &[Option<Rotary>; 2] {
        &self.machine.rotaries
    }

    /// Direction from the tip to the spindle when the rotary axes stand at zero.
    pub fn tool(&self) -> Vector3<f64> {
        self.machine.tool.into_inner()
    }

    /// The same machine with its tool along X at zero, where a tool axis square to Z asks
    /// for a live tool that lies so.
    #[must_use]
    pub fn with_tool_for(&self, axis: Vector3<f64>) -> Forward {
        let mut radial = self.clone();
        if axis.z.abs() < SQUARE {
            radial.machine.tool = Vector3::x_axis();
        }
        radial
    }

    /// Distance of the tip from the pivot of the heads, mm; `None` when the control
    /// keeps the tip where it is.
    pub fn pivot(&self) -> Option<f64> {
        self.machine.pivot
    }

    /// Tip and axis of the tool where the axes stand.
    pub fn pose(&self, position: &Position) -> Pose {
        Pose { tip: self.tip(position), axis: self.axis(position.rotary) }
    }

    /// The tip in the part where the axes stand, mm.
    pub fn tip(&self, position: &Position) -> Point3<f64> {
        self.frame_of(position).tip(position.linear)
    }

    /// Where X, Y, Z of a position count from in the part.
    pub fn frame_of(&self, position: &Position) -> Frame {
        match position.tilt {
            Some(tilt) => {
                Frame { turn: *tilt.turn.to_rotation_matrix().matrix(), origin: tilt.origin }
            }
            None if position.tip_control => Frame::PART,
            None => self.frame(position.rotary),
        }
    }

    /// The same stand with X, Y, Z said as another position says them: under tool-tip
    /// control, in a tilted frame, or as positions of the axes.
    pub fn restated(&self, position: &Position, like: &Position) -> Position {
        let Position { tip_control, tilt, .. } = *like;
        if position.tip_control == tip_control && position.tilt == tilt {
            return *position;
        }
        let stands = Position { tip_control, tilt, ..*position };
        let linear = self.frame_of(&stands).linear(self.tip(position));
        Position { linear, ..stands }
    }

    /// Where the axes stand at a share (0 to 1) of a motion that ends at `to`: X, Y, Z
    /// and the rotary axes go evenly, X, Y, Z as they are meant at the end.
    pub fn along(&self, from: &Position, to: &Position, arc: Option<&Arc>, share: f64) -> Position {
        let from = self.restated(from, to);
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let mut at = Position {
            linear: std::array::from_fn(|axis| mix(from.linear[axis], to.linear[axis])),
            rotary: std::array::from_fn(|axis| mix(from.rotary[axis], to.rotary[axis])),
            tip_control: to.tip_control,
            tilt: to.tilt,
            transformed: to.transformed,
        };
        if let Some(arc) = arc {
            let [first, second] = arc.plane();
            let turned = (arc.angle * share * if arc.ccw { 1.0 } else { -1.0 }).to_radians();
            let (sine, cosine) = libm::sincos(turned);
            let arm =
                [from.linear[first] - arc.center[first], from.linear[second] - arc.center[second]];
            at.linear[first] = arc.center[first] + arm[0] * cosine - arm[1] * sine;
            at.linear[second] = arc.center[second] + arm[0] * sine + arm[1] * cosine;
        }
        at
    }

    /// The tool axis in the part: `R(u1, r1) R(u2, r2) t`.
    pub fn axis(&self, rotary: [f64; 2]) -> Vector3<f64> {
        let by_second = self.turned(1, rotary[1], self.machine.tool.into_inner());
        self.turned(0, rotary[0], by_second)
    }

    /// A direction turned by a rotary axis at a position.
    fn turned(&self, index: usize, degrees: f64, vector: Vector3<f64>) -> Vector3<f64> {
        let Some(axis) = &self.machine.rotaries[index] else { return vector };
        let along = axis.direction.into_inner();
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        // Rodrigues' formula.
        vector * cosine
            + along.cross(&vector) * sine
            + along * (along.dot(&vector) * (1.0 - cosine))
    }

    /// The tool axis, and its change by a degree of each rotary axis; zero without one, and where
    /// it lies along it.
    fn axis_and_slopes(&self, rotary: [f64; 2]) -> (Vector3<f64>, [Vector3<f64>; 2]) {
        let by_second = self.turned(1, rotary[1], self.machine.tool.into_inner());
        let axis = self.turned(0, rotary[0], by_second);
        let slope = |index: usize, turned: &Vector3<f64>| {
            let rotary = self.machine.rotaries[index].as_ref();
            let along = rotary.map_or_else(Vector3::zeros, |rotary| rotary.direction.into_inner());
            let slope = along.cross(turned).map(f64::to_radians);
            if slope.norm() < TURNS { Vector3::zeros() } else { slope }
        };
        let second = slope(1, &by_second);
        (axis, [slope(0, &axis), self.turned(0, rotary[0], second)])
    }

    /// Where the linear axes count from in the part, without tool-tip control.
    pub fn frame(&self, rotary: [f64; 2]) -> Frame {
        if !self.has_rotary() {
            return Frame::PART;
        }
        let tool = self.machine.tool.into_inner();
        let mut head = tool;
        let mut turned: Option<Matrix3<f64>> = None;
        let mut origin = Point3::origin();
        // From the tool to the part: the secondary axis first.
        for index in [1, 0] {
            let Some(axis) = &self.machine.rotaries[index] else { continue };
            let turn = turn(axis, rotary[index]);
            match axis.carries {
                Carries::Head => head = turn * head,
                Carries::Table => {
                    origin = axis.center + turn * (origin - axis.center);
                    turned = Some(turned.map_or(*turn.matrix(), |before| turn.matrix() * before));
                }
            }
        }
        let turn = turned.unwrap_or_else(Matrix3::identity);
        // The linear axes carry the pivot, which stands above the tip at zero.
        if let Some(length) = self.machine.pivot {
            origin -= turn * (head - tool) * length;
        }
        Frame { turn, origin }
    }

    /// Most that a turn of the rotary axes by a radian may move the tip, mm.
    pub fn lever(&self, tip: Point3<f64>) -> f64 {
        let centers = self.machine.rotaries.iter().flatten();
        let reach = centers.map(|axis| (tip - axis.center).norm() + axis.center.coords.norm());
        reach.sum::<f64>() + self.machine.pivot.unwrap_or(0.0)
    }

    /// Most that a rotary axis turns at these positions for a change of the tool axis, radians;
    /// degrees. Beside a pole it is much for little.
    pub fn turn_for(&self, rotary: [f64; 2], change: f64) -> f64 {
        let (_, slopes) = self.axis_and_slopes(rotary);
        let turns = slopes.map(|slope| slope.norm()).into_iter().filter(|slope| *slope > 0.0);
        turns.map(|slope| change / slope).fold(0.0, f64::max)
    }

    /// Rotary positions near `rotary` at which the tool lies exactly along `axis`,
    /// by Newton's method; positions that do not turn the tool stay as they are.
    pub fn refine(&self, rotary: [f64; 2], axis: Vector3<f64>) -> [f64; 2] {
        if !self.has_rotary() {
            return rotary;
        }
        let mut at = rotary;
        for _ in 0..STEPS {
            let (stands, slopes) = self.axis_and_slopes(at);
            let step = least_squares(slopes, axis - stands);
            at = [at[0] + step[0], at[1] + step[1]];
            if step.iter().all(|step| step.abs() < EXACT) {
                break;
            }
        }
        at
    }
}

impl Frame {
    /// The part itself.
    const PART: Frame = Frame {
        turn: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        origin: Point3::new(0.0, 0.0, 0.0),
    };

    /// The tip in the part for positions of the linear axes, mm.
    pub fn tip(&self, linear: [f64; 3]) -> Point3<f64> {
        self.origin + self.turn * Vector3::from(linear)
    }

    /// The positions of the linear axes that bring the tip to a point of the part, mm.
    pub fn linear(&self, tip: Point3<f64>) -> [f64; 3] {
        (self.turn.transpose() * (tip - self.origin)).into()
    }
}

fn turn(axis: &Rotary, degrees: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&axis.direction, degrees.to_radians())
}

/// The factors of the two vectors whose sum comes nearest to `target`; 0 for a
/// vector that is zero, or along the other.
fn least_squares([a, b]: [Vector3<f64>; 2], target: Vector3<f64>) -> [f64; 2] {
    let (aa, ab, bb) = (a.dot(&a), a.dot(&b), b.dot(&b));
    let (at, bt) = (a.dot(&target), b.dot(&target));
    let determinant = aa * bb - ab * ab;
    if determinant > 1e-9 * aa * bb && aa > 0.0 && bb > 0.0 {
        return [(at * bb - bt * ab) / determinant, (bt * aa - at * ab) / determinant];
    }
    if bb > aa {
        [0.0, bt / bb]
    } else if aa > 0.0 {
        [at / aa, 0.0]
    } else {
        [0.0, 0.0]
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use nalgebra::Unit;
    use proptest::prelude::*;

    /// What it carries, its direction, a point on it.
    type Axis = Option<(Carries, [f64; 3], [f64; 3])>;

    pub(crate) fn rotary(carries: Carries, direction: [f64; 3], center: [f64; 3]) -> Rotary {
        Rotary {
            carries,
            direction: Unit::new_normalize(Vector3::from(direction)),
            center: Point3::from(center),
            letter: fil_machine::Letter::of(b'A'),
            axis: 0,
            min: None,
            max: None,
            zones: Default::default(),
        }
    }

    fn machine(axes: [Axis; 2], pivot: Option<f64>) -> AxisChain {
        let rotaries = axes.map(|axis| axis.map(|(kind, way, center)| rotary(kind, way, center)));
        AxisChain { rotaries, tool: Vector3::z_axis(), pivot }
    }

    fn near(a: Vector3<f64>, b: Vector3<f64>, within: f64) -> bool {
        (a - b).norm() < within
    }

    #[test]
    fn a_table_about_x_turns_the_part_back() {
        let table = Some((Carries::Table, [1.0, 0.0, 0.0], [0.0; 3]));
        let forward = Forward { machine: machine([table, None], None) };
        let position =
            Position { linear: [5.0, 0.0, 100.0], rotary: [30.0, 0.0], ..Position::default() };
        let pose = forward.pose(&position);
        // The table at A30: what stands upright at Z100 lies at 30 degrees in the part.
        assert!(near(pose.tip.coords, Vector3::new(5.0, -50.0, 86.602_540_378), 1e-9));
        assert!(near(pose.axis, Vector3::new(0.0, -0.5, 0.866_025_403_8), 1e-9));
    }

    #[test]
    fn a_head_swings_the_tip_about_its_pivot() {
        let head = Some((Carries::Head, [0.0, 1.0, 0.0], [0.0; 3]));
        let forward = Forward { machine: machine([None, head], Some(100.0)) };
        let position =
            Position { linear: [100.0, 0.0, -100.0], rotary: [0.0, 90.0], ..Position::default() };
        let pose = forward.pose(&position);
        assert!(near(pose.tip.coords, Vector3::zeros(), 1e-9));
        assert!(near(pose.axis, Vector3::x(), 1e-9));
    }

    #[test]
    fn a_frame_goes_both_ways() {
        let table = |direction, center| Some((Carries::Table, direction, center));
        let both = [table([1.0, 0.0, 0.0], [0.0, 3.0, -40.0]), table([0.0, 0.0, 1.0], [7.0; 3])];
        let frame = Forward { machine: machine(both, None) }.frame([33.0, -120.0]);
        let linear = frame.linear(frame.tip([1.0, -2.0, 3.0]));
        assert!(near(Vector3::from(linear), Vector3::new(1.0, -2.0, 3.0), 1e-12));
    }

    #[test]
    fn the_tip_goes_straight_under_tool_tip_control() {
        let table = Some((Carries::Table, [0.0, 0.0, 1.0], [0.0; 3]));
        let forward = Forward { machine: machine([table, None], None) };
        let at = |linear, turned, tip_control| Position {
            linear,
            rotary: [turned, 0.0],
            tip_control,
            ..Position::default()
        };
        // Half way from the table at 0 to the table at 90 degrees.
        let tip = |from, to| forward.pose(&forward.along(&from, &to, None, 0.5)).tip.coords;
        let straight = tip(at([10.0, 0.0, 0.0], 0.0, true), at([0.0, 10.0, 0.0], 90.0, true));
        assert!(near(straight, Vector3::new(5.0, 5.0, 0.0), 1e-12));
        // The axes stand while the table turns: the tip goes along a quarter circle.
        let round = tip(at([10.0, 0.0, 0.0], 0.0, false), at([10.0, 0.0, 0.0], 90.0, false));
        assert!(near(round, Vector3::new(50f64.sqrt(), 50f64.sqrt(), 0.0), 1e-12));
        // Where tool-tip control begins, the start is said anew.
        let begins = tip(at([10.0, 0.0, 0.0], 90.0, false), at([0.0, 20.0, 0.0], 90.0, true));
        assert!(near(begins, Vector3::new(0.0, 15.0, 0.0), 1e-12));
    }

    fn carries() -> impl Strategy<Value = [Carries; 2]> {
        prop_oneof![
            Just([Carries::Table, Carries::Table]),
            Just([Carries::Table, Carries::Head]),
            Just([Carries::Head, Carries::Head]),
        ]
    }

    fn directions() -> impl Strategy<Value = [[f64; 3]; 2]> {
        prop_oneof![
            Just([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
            Just([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]),
            Just([[0.0, 0.0, -1.0], [0.0, -1.0, 1.0]]),
            Just([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        ]
    }

    fn point() -> impl Strategy<Value = [f64; 3]> {
        proptest::array::uniform3(-200.0..200.0)
    }

    proptest! {
        /// What the post's inverse finds for a target comes back as that target.
        #[test]
        fn forward_undoes_the_inverse(
            carries in carries(),
            directions in directions(),
            centers in proptest::array::uniform2(point()),
            pivot in proptest::option::of(50.0..400.0),
            tip in point(),
            tilt in 0.0..0.7f64,
            around in -3.1..3.1f64,
            last in proptest::array::uniform2(-90.0..90.0),
        ) {
            let axes = [0, 1].map(|n| Some((carries[n], directions[n], centers[n])));
            let machine = machine(axes, pivot);
            let axis = Vector3::new(libm::sin(tilt) * libm::cos(around), libm::sin(tilt) * libm::sin(around), libm::cos(tilt));
            let rotary = machine.solve(axis, last).unwrap();
            let linear = machine.linear(Point3::from(tip), rotary);
            let forward = Forward { machine };
            let position = Position { linear: linear.coords.into(), rotary, ..Position::default() };
            let controlled = Position { tip_control: true, ..position };
            let pose = forward.pose(&position);
            prop_assert!(near(pose.tip.coords, Vector3::from(tip), 1e-6), "{:?}", pose);
            prop_assert!(near(pose.axis, axis, 2e-5), "{:?}", pose);
            let restated = forward.restated(&position, &controlled);
            prop_assert!(near(Vector3::from(restated.linear), Vector3::from(tip), 1e-6));
            prop_assert_eq!(forward.pose(&restated), pose);
            let back = forward.restated(&restated, &position);
            prop_assert!(near(Vector3::from(back.linear), linear.coords, 1e-9));
        }

        /// Angles rounded on a tape are refined to the exact ones.
        #[test]
        fn refining_finds_the_exact_angles(
            carries in carries(),
            directions in directions(),
            exact in [5.0..170.0f64, 5.0..80.0f64],
            off in proptest::array::uniform2(-5e-4..5e-4f64),
        ) {
            let axes = [0, 1].map(|n| Some((carries[n], directions[n], [0.0; 3])));
            let forward = Forward { machine: machine(axes, None) };
            let found = forward.refine([exact[0] + off[0], exact[1] + off[1]], forward.axis(exact));
            prop_assert!((found[0] - exact[0]).abs() < 1e-7 && (found[1] - exact[1]).abs() < 1e-7);
        }
    }
}
