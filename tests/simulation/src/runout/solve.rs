//! Run-out of a part on a rotary table, and the transformation that follows it.
//!
//! A part clamped on a C table stands beside the table axis and leans. A probe finds,
//! in two sections of a cylinder of the part, the least and the largest reading with
//! their C positions; from these come the centers P1 and P2, the place of the line
//! P1P2 relative to the table axis, and a 3x4 matrix that takes points of the CL file
//! onto the part as it stands. The method and the formulas (1) to (6) are those of
//! P. Hadjiiski, Ts. Kaldashev and O. Karakostopulo, Mashinostroene i mashinoznanie 19;
//! the script `fil-scripts/papers/run-out.fil` does the same in FIL.
//!
//! Frame: that of the CL file, table axis along Z through the origin. Lengths are mm,
//! angles degrees. A C position is the angle of the probed point from +X, as on a
//! machine whose probe stands on the side of +X.
//!
//! ```
//! use filpost_simulation::runout::solve::{Bounds, Placing, Reading, RunOut, Section};
//! let section = |height| Section {
//!     height,
//!     least: Reading { value: 49.9, c: 270.0 },
//!     largest: Reading { value: 50.1, c: 90.0 },
//! };
//! let found = RunOut::find(&[section(20.0), section(80.0)], &Bounds::default())?;
//! assert_eq!(found.placing, Placing::Parallel);
//! assert!((found.distance - 0.1).abs() < 1e-12);
//! # Ok::<(), filpost_simulation::runout::solve::RunOutError>(())
//! ```

use std::fmt;

use nalgebra::{Matrix3, Matrix3x4, Point3, Rotation3, Unit, Vector3};

/// A reading of the probe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Radius, or value of a dial that grows outwards, mm.
    pub value: f64,
    /// C position, degrees.
    pub c: f64,
}

/// A probed section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Z of the section, mm.
    pub height: f64,
    /// The least reading.
    pub least: Reading,
    /// The largest reading, half a turn from the least.
    pub largest: Reading,
}

/// What is believed of the readings, and what counts as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// How well a center is probed, mm: a smaller lean between the sections is none,
    /// and axes that pass at a smaller distance intersect.
    pub tolerance: f64,
    /// Largest run-out of a section, largest less least reading, mm.
    pub run_out: f64,
    /// Largest angle between the axes, degrees.
    pub tilt: f64,
    /// How far the two readings of a section may miss being opposite, degrees.
    pub opposite: f64,
}

impl Default for Bounds {
    /// The values of the script: 0.001 mm, 2 mm, 1 degree, 5 degrees.
    fn default() -> Self {
        Bounds { tolerance: 0.001, run_out: 2.0, tilt: 1.0, opposite: 5.0 }
    }
}

/// How the axis of the part lies to the table axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placing {
    /// The same direction.
    Parallel,
    /// Another direction, through a common point.
    Intersecting,
    /// Another direction, and no common point.
    Skew,
}

/// Readings that give no compensation. Sections count from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RunOutError {
    /// A number that is infinite or none, or a tolerance that is not positive.
    Number,
    /// The least reading of a section is above its largest.
    Order {
        /// The section.
        section: usize,
    },
    /// More run-out than [`Bounds::run_out`].
    TooMuch {
        /// The section.
        section: usize,
        /// Its run-out, mm.
        run_out: f64,
    },
    /// The readings are further from opposite than [`Bounds::opposite`].
    NotOpposite {
        /// The section.
        section: usize,
        /// What is missing to half a turn, degrees.
        by: f64,
    },
    /// Both sections have this height (mm) and give no line.
    SameHeight(f64),
    /// A tilt (degrees) above [`Bounds::tilt`].
    TooSteep(f64),
}

impl fmt::Display for RunOutError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => write!(out, "a reading or bound is no usable number"),
            Self::Order { section } => {
                write!(out, "section {section}: the least reading is above the largest")
            }
            Self::TooMuch { section, run_out } => {
                write!(out, "section {section}: a run-out of {run_out} mm is not believed")
            }
            Self::NotOpposite { section, by } => {
                write!(out, "section {section}: the readings are {by} degrees from opposite")
            }
            Self::SameHeight(height) => write!(out, "both sections are at the height {height}"),
            Self::TooSteep(angle) => write!(out, "a tilt of {angle} degrees is not believed"),
        }
    }
}

impl std::error::Error for RunOutError {}

/// How a part stands, and the matrix that follows it.
#[derive(Clone, Debug, PartialEq)]
pub struct RunOut {
    /// P1 and P2, the centers of the sections, mm.
    pub centers: [Point3<f64>; 2],
    /// Direction cosines (2) of the part's axis; it points up.
    pub direction: Unit<Vector3<f64>>,
    /// Angle (3) between the axes, degrees.
    pub angle: f64,
    /// Distance (4) of the axes, mm.
    pub distance: f64,
    /// How the axes lie.
    pub placing: Placing,
    /// Rows of the transformation (5): columns A, B, C turn, column D moves (mm).
    /// Probing sees neither a slide of the part along its own axis nor a turn about it;
    /// the matrix has none.
    pub matrix: Matrix3x4<f64>,
}

impl RunOut {
    /// From two sections to the matrix.
    ///
    /// # Errors
    /// Readings that contradict each other or are not believed.
    pub fn find(sections: &[Section; 2], bounds: &Bounds) -> Result<Self, RunOutError> {
        if !(bounds.tolerance.is_finite() && bounds.tolerance > 0.0) {
            return Err(RunOutError::Number);
        }
        let centers = [center(1, &sections[0], bounds)?, center(2, &sections[1], bounds)?];
        let mut along = centers[1] - centers[0];
        if along.z == 0.0 {
            return Err(RunOutError::SameHeight(centers[0].z));
        }
        along *= along.z.signum();
        let table = Vector3::z();
        let across = along.cross(&table);
        let sine = across.norm() / along.norm();
        let angle = sine.asin().to_degrees();
        if !angle.is_finite() {
            return Err(RunOutError::Number);
        }
        if angle > bounds.tilt {
            return Err(RunOutError::TooSteep(angle));
        }
        if across.norm() <= bounds.tolerance {
            return Ok(Self::parallel(centers, along, angle));
        }
        let distance = (centers[0].coords.dot(&across) / across.norm()).abs();
        let intersect = distance <= bounds.tolerance;
        let origin = centers[0] - along * (centers[0].z / along.z);
        let direction = Unit::new_normalize(along);
        let (fi, psi) = ((-direction.y).atan2(direction.z), direction.x.asin());
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), fi)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), psi);
        Ok(RunOut {
            centers,
            direction,
            angle,
            distance,
            placing: if intersect { Placing::Intersecting } else { Placing::Skew },
            matrix: matrix(turn.matrix(), &origin.coords),
        })
    }

    /// What is left of the lean can't be told from the error of the probe.
    fn parallel(centers: [Point3<f64>; 2], along: Vector3<f64>, angle: f64) -> Self {
        let mut middle = nalgebra::center(&centers[0], &centers[1]).coords;
        middle.z = 0.0;
        RunOut {
            centers,
            direction: Unit::new_normalize(along),
            angle,
            distance: middle.norm(),
            placing: Placing::Parallel,
            matrix: matrix(&Matrix3::identity(), &middle),
        }
    }

    /// True when the tool axis has to be turned along with the points (6).
    pub fn turns_axis(&self) -> bool {
        self.placing != Placing::Parallel
    }

    /// A point of the CL file on the part as it stands (5), mm.
    pub fn point(&self, point: Point3<f64>) -> Point3<f64> {
        Point3::from(self.matrix * point.to_homogeneous())
    }

    /// A tool axis of the CL file on the part as it stands. The paper adds column D
    /// here too (6); a direction has no place, so it is left out.
    pub fn axis(&self, axis: Vector3<f64>) -> Vector3<f64> {
        if self.turns_axis() { self.matrix.fixed_columns::<3>(0) * axis } else { axis }
    }

    /// The TRANS statement of a CL file that makes a post do this.
    pub fn statement(&self) -> String {
        let numbers: Vec<String> =
            self.matrix.transpose().iter().map(|number| format!("{number:.17}")).collect();
        let option = if self.turns_axis() { "" } else { ", OPTION, 10" };
        format!("TRANS / {}{option}", numbers.join(", "))
    }
}

/// The center of a section: half the run-out towards the largest reading. What the two
/// positions lack to half a turn is shared between them.
fn center(number: usize, section: &Section, bounds: &Bounds) -> Result<Point3<f64>, RunOutError> {
    let Section { height, least, largest } = *section;
    if ![height, least.value, least.c, largest.value, largest.c].iter().all(|n| n.is_finite()) {
        return Err(RunOutError::Number);
    }
    let run_out = largest.value - least.value;
    // Without run-out the noise of the probe may put the least reading above the largest.
    if run_out < -2.0 * bounds.tolerance {
        return Err(RunOutError::Order { section: number });
    }
    let run_out = run_out.max(0.0);
    if run_out > bounds.run_out {
        return Err(RunOutError::TooMuch { section: number, run_out });
    }
    let by = largest.c - least.c - 180.0;
    let by = by - 360.0 * (by / 360.0).round();
    if by.abs() > bounds.opposite {
        return Err(RunOutError::NotOpposite { section: number, by });
    }
    let (sine, cosine) = (largest.c - by / 2.0).to_radians().sin_cos();
    Ok(Point3::new(run_out / 2.0 * cosine, run_out / 2.0 * sine, height))
}

fn matrix(turn: &Matrix3<f64>, by: &Vector3<f64>) -> Matrix3x4<f64> {
    let mut matrix = Matrix3x4::zeros();
    matrix.fixed_columns_mut::<3>(0).copy_from(turn);
    matrix.set_column(3, by);
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(height: f64, eccentric: [f64; 2]) -> Section {
        let [x, y] = eccentric;
        let (half, c) = (x.hypot(y), y.atan2(x).to_degrees());
        Section {
            height,
            least: Reading { value: 50.0 - half, c: c - 180.0 },
            largest: Reading { value: 50.0 + half, c },
        }
    }

    fn find(first: Section, second: Section) -> Result<RunOut, RunOutError> {
        RunOut::find(&[first, second], &Bounds::default())
    }

    #[test]
    fn the_matrix_takes_the_nominal_axis_to_the_line() {
        let found = find(section(20.0, [0.06, -0.02]), section(100.0, [0.03, 0.08])).unwrap();
        assert_eq!(found.placing, Placing::Skew);
        for center in found.centers {
            let back = found.point(Point3::new(0.0, 0.0, center.z / found.direction.z));
            let off = (back - found.point(Point3::origin())).cross(&found.direction);
            assert!(off.norm() < 1e-12);
        }
        assert!((found.axis(Vector3::z()) - found.direction.into_inner()).norm() < 1e-15);
        assert!(found.point(Point3::origin()).z.abs() < 1e-15);
    }

    #[test]
    fn the_order_of_the_sections_does_not_matter() {
        let (low, high) = (section(20.0, [0.06, -0.02]), section(100.0, [0.03, 0.08]));
        let (up, down) = (find(low, high).unwrap(), find(high, low).unwrap());
        assert!((up.matrix - down.matrix).norm() < 1e-12);
        assert!((up.distance - down.distance).abs() < 1e-12);
    }

    #[test]
    fn placings_are_told_apart() {
        let placing = |a, b| find(section(20.0, a), section(100.0, b)).unwrap().placing;
        assert_eq!(placing([0.06, 0.08], [0.06, 0.0805]), Placing::Parallel);
        assert_eq!(placing([0.02, 0.04], [0.05, 0.1]), Placing::Intersecting);
        assert_eq!(placing([0.02, 0.04], [0.05, 0.0]), Placing::Skew);
        assert_eq!(placing([0.0, 0.0], [0.0, 0.0]), Placing::Parallel);
    }

    #[test]
    fn contradictions_are_refused() {
        let good = section(20.0, [0.1, 0.0]);
        let swapped = Section { least: good.largest, largest: good.least, ..good };
        assert_eq!(find(swapped, good), Err(RunOutError::Order { section: 1 }));
        assert_eq!(find(good, good), Err(RunOutError::SameHeight(20.0)));
        let steep = find(good, section(21.0, [0.0, 0.1])).unwrap_err();
        assert!(matches!(steep, RunOutError::TooSteep(angle) if angle > 8.0));
        let mut aside = section(100.0, [0.1, 0.0]);
        aside.least.c += 6.0;
        let by = find(good, aside).unwrap_err();
        assert!(matches!(by, RunOutError::NotOpposite { section: 2, by } if by < -5.9));
        let far = find(good, section(100.0, [1.1, 0.0])).unwrap_err();
        assert!(matches!(far, RunOutError::TooMuch { section: 2, .. }));
        let mut none = good;
        none.height = f64::NAN;
        assert_eq!(find(none, good), Err(RunOutError::Number));
    }
}
