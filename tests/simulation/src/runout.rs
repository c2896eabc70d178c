//! A cylinder with run-out on a machine with a C table, simulated: it is probed, a path
//! round it is posted, and the NC program is run on the table and the head.
//!
//! Nothing of the post is used but what it printed. Lengths are mm, angles degrees.
//! The machine: X Y Z, a table about Z written C and, where the program has B, a head
//! about Y that holds the tool along +X at B0. C and B count as motion of the tool
//! relative to the part. X Y Z is the place of the tip while the head stands at B0.

pub mod drawing;
pub mod macro_b;
pub mod solve;

use std::fmt::Write as _;

use nalgebra::{Point3, Rotation3, Unit, Vector3};

/// Radius of the probed cylinder.
pub const RADIUS: f64 = 50.0;
/// From the pivot of the head to the tip of the tool.
pub const PIVOT: f64 = 150.0;
/// Heights of the two probed sections.
pub const SECTIONS: [f64; 2] = [20.0, 80.0];
/// Heights of the three turns of the path.
pub const TURNS: [f64; 3] = [10.0, 50.0, 90.0];

/// Degrees from one point of the path to the next.
const STEP: usize = 5;
/// Points of a turn, its first one again at its end.
const POINTS: usize = 360 / STEP + 1;
/// Places that are looked at between two blocks.
const BETWEEN: usize = 4;

/// Numbers that look random and are the same in every run (SplitMix64).
pub struct Random(pub u64);

impl Random {
    /// From -1 to 1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// The cylinder as it stands on the table, in the frame of the table at C0.
#[derive(Clone, Debug)]
pub struct Cylinder {
    /// Where its axis goes through Z0.
    pub foot: Point3<f64>,
    /// Its axis, up.
    pub axis: Unit<Vector3<f64>>,
}

impl Cylinder {
    /// From the places of its axis at the lowest and the highest turn.
    pub fn through(low: [f64; 2], high: [f64; 2]) -> Self {
        let [bottom, _, top] = TURNS;
        let low = Point3::new(low[0], low[1], bottom);
        let along = Point3::new(high[0], high[1], top) - low;
        let foot = low - along * (bottom / along.z);
        Cylinder { foot, axis: Unit::new_normalize(along) }
    }

    /// How far a point lies outside of the surface.
    pub fn deviation(&self, point: &Point3<f64>) -> f64 {
        self.off_axis(point).norm() - RADIUS
    }

    /// What the probe reads at a height while the table stands at C: where a line from
    /// the table axis along machine +X leaves the cylinder.
    pub fn reading(&self, height: f64, c: f64) -> f64 {
        let start = Point3::new(0.0, 0.0, height);
        let out = Rotation3::from_axis_angle(&Vector3::z_axis(), c.to_radians()) * Vector3::x();
        let at = self.off_axis(&start);
        let flat = out - self.axis.scale(self.axis.dot(&out));
        let (a, b, c) = (flat.dot(&flat), at.dot(&flat), at.dot(&at) - RADIUS * RADIUS);
        (-b + (b * b - a * c).sqrt()) / a
    }

    /// Where a point of the part is: the part was put down with its origin at the foot,
    /// tilted the shortest way and not turned about itself.
    pub fn place(&self, point: &Point3<f64>) -> Point3<f64> {
        let tilt = Rotation3::rotation_between(&Vector3::z(), &self.axis);
        self.foot + tilt.unwrap_or_else(Rotation3::identity) * point.coords
    }

    fn off_axis(&self, point: &Point3<f64>) -> Vector3<f64> {
        let from = point - self.foot;
        from - self.axis.scale(self.axis.dot(&from))
    }
}

/// How the angle of the least reading is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Search {
    /// From four touches a quarter turn apart.
    FourTouches,
    /// The least of 360 readings, one degree apart.
    Lowest,
    /// The place of the least reading, found to the last bit.
    Least,
    /// The places of the least and of the largest reading, each found to the last bit.
    BothEnds,
}

/// A probe whose readings are wrong by at most `noise`.
pub struct Probe {
    /// Largest error of a reading.
    pub noise: f64,
    /// Where the errors come from.
    pub random: Random,
    /// How it finds the least reading.
    pub search: Search,
}

/// What the probe reports of a section.
#[derive(Clone, Copy, Debug)]
pub struct Probed {
    /// Z of the section.
    pub height: f64,
    /// Least reading and its C.
    pub least: [f64; 2],
    /// Largest reading and its C, half a turn away.
    pub largest: [f64; 2],
}

impl Probe {
    /// Probes a section.
    pub fn section(&mut self, cylinder: &Cylinder, height: f64) -> Probed {
        let c = match self.search {
            Search::FourTouches => {
                let [east, north, west, south] =
                    [0.0, 90.0, 180.0, 270.0].map(|c| self.read(cylinder, height, c));
                (south - north).atan2(west - east).to_degrees()
            }
            Search::Lowest => self.lowest(cylinder, height),
            Search::Least | Search::BothEnds => self.outmost(cylinder, height, 1.0),
        };
        let opposite = match self.search {
            Search::BothEnds => self.outmost(cylinder, height, -1.0),
            _ => c + 180.0,
        };
        let mut at = |c: f64| [self.read(cylinder, height, c), c.rem_euclid(360.0)];
        Probed { height, least: at(c), largest: at(opposite) }
    }

    /// A search that compares readings, as the paper seems to do.
    fn lowest(&mut self, cylinder: &Cylinder, height: f64) -> f64 {
        let readings: Vec<f64> =
            (0..360).map(|c| self.read(cylinder, height, f64::from(c))).collect();
        let least = (0..360).min_by(|a, b| readings[*a].total_cmp(&readings[*b]));
        least.expect("there are readings") as f64
    }

    /// The place of the least reading times `sign`, by ever smaller steps.
    fn outmost(&self, cylinder: &Cylinder, height: f64, sign: f64) -> f64 {
        let reading = |c: f64| sign * cylinder.reading(height, c);
        let nearer = |a: &f64, b: &f64| reading(*a).total_cmp(&reading(*b));
        let mut at = (0..360).map(f64::from).min_by(nearer).expect("there are readings");
        let mut step = 1.0;
        while step > 1e-7 {
            at = [at - step, at, at + step].into_iter().min_by(nearer).expect("three places");
            step /= 1.5;
        }
        at
    }

    fn read(&mut self, cylinder: &Cylinder, height: f64, c: f64) -> f64 {
        cylinder.reading(height, c) + self.noise * self.random.unit()
    }
}

/// The CL file: what was probed, and turns round the nominal cylinder with the tool
/// along its radius. `on` is the form of RUNOUT that begins the compensation.
pub fn cl_file(sections: &[Probed], on: &str) -> String {
    let mut cl = String::from("PARTNO / RUN-OUT\nUNITS / MM\n");
    for (index, section) in sections.iter().enumerate() {
        let Probed { height, least: [min, cmin], largest: [max, cmax] } = section;
        let _ = writeln!(
            cl,
            "RUNOUT / PROBE, {}, ZCOORD, {height:.10}, MIN, {min:.10}, CMIN, {cmin:.10},  $\n\
             MAX, {max:.10}, CMAX, {cmax:.10}",
            index + 1
        );
    }
    let _ = writeln!(cl, "{on}\nFEDRAT / 100.000000,  MMPM\nMULTAX / ON");
    for height in TURNS {
        for angle in (0..=360).step_by(STEP) {
            let Point3 { coords } = nominal(angle as f64, height);
            let [x, y, i, j] = [coords.x, coords.y, coords.x / RADIUS, coords.y / RADIUS];
            let _ = writeln!(
                cl,
                "GOTO / {x:.10}, {y:.10}, {height:.10}, {i:.10}, {j:.10}, 0.0000000000"
            );
        }
    }
    cl.push_str("FINI\n");
    cl
}

/// A point of the nominal cylinder.
fn nominal(angle: f64, height: f64) -> Point3<f64> {
    let (sine, cosine) = angle.to_radians().sin_cos();
    Point3::new(RADIUS * cosine, RADIUS * sine, height)
}

/// Positions of X, Y, Z, B and C.
type Axes = [f64; 5];

/// The axes after each motion block of an NC program, in absolute coordinates.
pub fn positions(nc: &str) -> Vec<Axes> {
    let mut now = [0.0; 5];
    let mut found = Vec::new();
    for block in nc.lines().filter(|line| line.starts_with('N') && !line.contains('(')) {
        let mut moves = false;
        for word in block.split_whitespace() {
            let (letter, value) = word.split_at(1);
            if let Some(axis) = "XYZBC".find(letter) {
                now[axis] = value.parse().unwrap_or_else(|_| panic!("{word} in {block}"));
                moves = true;
            }
        }
        if moves {
            found.push(now);
        }
    }
    found
}

/// The tip of the tool and its direction, from the tip up, in the frame of the table.
pub fn tool(axes: &Axes) -> (Point3<f64>, Vector3<f64>) {
    let [x, y, z, b, c] = *axes;
    let (sine, cosine) = b.to_radians().sin_cos();
    let held = Vector3::new(cosine, 0.0, -sine);
    let pivot = Point3::new(x + PIVOT, y, z);
    let table = Rotation3::from_axis_angle(&Vector3::z_axis(), c.to_radians());
    (table * (pivot - held * PIVOT), table * held)
}

/// What is left at the part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// Largest distance of the tip from the surface.
    pub radial: f64,
    /// Largest less least such distance within a turn.
    pub run_out: f64,
    /// Largest distance of the tip from the point of the part that the CL file names.
    pub place: f64,
    /// Largest lean of the tool along the axis of the part: the angle that is missing
    /// to a right angle.
    pub lean: f64,
}

impl Residual {
    /// The worse of two.
    pub fn worse(self, other: Self) -> Self {
        Residual {
            radial: self.radial.max(other.radial),
            run_out: self.run_out.max(other.run_out),
            place: self.place.max(other.place),
            lean: self.lean.max(other.lean),
        }
    }
}

/// Measures a program of [`cl_file`] at the cylinder, at its blocks and at places between
/// them: all axes move in step.
pub fn residual(nc: &str, cylinder: &Cylinder) -> Residual {
    let path = positions(nc);
    assert_eq!(path.len(), TURNS.len() * POINTS, "each GOTO moves the machine:\n{nc}");
    let turns = path.chunks(POINTS).zip(TURNS);
    turns.fold(Residual::default(), |worst, (turn, height)| {
        worst.worse(of_turn(&between(turn), height, cylinder))
    })
}

fn of_turn(path: &[Axes], height: f64, cylinder: &Cylinder) -> Residual {
    let mut worst = Residual::default();
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (index, axes) in path.iter().enumerate() {
        let angle = (STEP * index) as f64 / BETWEEN as f64;
        let (tip, held) = tool(axes);
        let off = cylinder.deviation(&tip);
        assert!(off.is_finite(), "{axes:?}");
        (low, high) = (low.min(off), high.max(off));
        worst = worst.worse(Residual {
            radial: off.abs(),
            run_out: 0.0,
            place: (tip - cylinder.place(&nominal(angle, height))).norm(),
            lean: held.dot(&cylinder.axis).asin().to_degrees().abs(),
        });
    }
    Residual { run_out: high - low, ..worst }
}

/// C, from 0 to 360, and the distance of the tip from the surface in the middle turn of a
/// program of [`cl_file`].
pub fn deviations(nc: &str, cylinder: &Cylinder) -> Vec<[f64; 2]> {
    let path = between(&positions(nc)[POINTS..2 * POINTS]);
    let start = path[0][4];
    path.iter().map(|axes| [axes[4] - start, cylinder.deviation(&tool(axes).0)]).collect()
}

fn between(path: &[Axes]) -> Vec<Axes> {
    let steps = |pair: &[Axes]| {
        let [from, to] = [pair[0], pair[1]];
        (0..BETWEEN).map(move |step| {
            let part = step as f64 / BETWEEN as f64;
            std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
        })
    };
    path.windows(2).flat_map(steps).chain(path.last().copied()).collect()
}
