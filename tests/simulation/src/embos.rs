//! Grooves cut with a disc into a cylinder whose table leans, read from the NC
//! text: where the disc touches the cylinder, and whether its plane holds the groove there.
//!
//! Frame of the machine: the cylinder's axis goes through the origin between Y and Z, at the
//! angle of the table to Y (45 degrees in the paper), C turns it, the disc lies in a plane of X
//! and Y. At C0 the part's +Z points to +X. Lengths are mm, angles degrees.

use fil_nc::text::read_block;
use filpost_tests::picture::{Pen, Picture};
use nalgebra::{Point3, Vector3};

/// A way of the disc in the material.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    /// Line of the program, 1-based.
    pub line: u32,
    /// X, Y, Z and C at the start.
    pub from: [f64; 4],
    /// X, Y, Z and C at the end.
    pub to: [f64; 4],
    /// Angle at which the table leans.
    pub lean: f64,
}

/// A place on the cylinder: angle of the part (degrees), way along its axis, radius.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// From the part's +Z towards +X, -180 to 180.
    pub angle: f64,
    /// Part Y.
    pub along: f64,
    /// Distance from the axis of the cylinder.
    pub radius: f64,
}

fn axis(lean: f64) -> Vector3<f64> {
    let (sine, cosine) = lean.to_radians().sin_cos();
    Vector3::new(0.0, cosine, sine)
}

impl Spot {
    /// Where the disc at X, Y, Z touches the part turned to C on a table that leans so.
    pub fn of([x, y, z, c]: [f64; 4], lean: f64) -> Self {
        let at = Vector3::new(x, y, z);
        let along = at.dot(&axis(lean));
        let out = at - axis(lean) * along;
        let part_x = axis(lean).cross(&Vector3::x());
        let angle = out.dot(&part_x).atan2(out.x).to_degrees() + c;
        Spot { angle: angle - 360.0 * (angle / 360.0).round(), along, radius: out.norm() }
    }

    /// The place in the machine while the part stands at C.
    fn in_machine(&self, c: f64, lean: f64) -> Vector3<f64> {
        let (sine, cosine) = (self.angle - c).to_radians().sin_cos();
        let part_x = axis(lean).cross(&Vector3::x());
        axis(lean) * self.along + (Vector3::x() * cosine + part_x * sine) * self.radius
    }

    /// The place in the frame of the part.
    pub fn in_part(&self) -> Point3<f64> {
        let (sine, cosine) = self.angle.to_radians().sin_cos();
        Point3::new(self.radius * sine, self.along, self.radius * cosine)
    }
}

impl Cut {
    /// The place at a part of the way, 0 to 1.
    pub fn at(&self, part: f64) -> Spot {
        Spot::of(self.axes(part), self.lean)
    }

    fn axes(&self, part: f64) -> [f64; 4] {
        std::array::from_fn(|axis| self.from[axis] + part * (self.to[axis] - self.from[axis]))
    }

    /// By how many degrees the groove leaves the plane of the disc where it is cut: the
    /// places before and behind are looked at with the part standing still.
    pub fn out_of_disc(&self, part: f64) -> f64 {
        let c = self.axes(part)[3];
        let [before, behind] =
            [part - 0.001, part + 0.001].map(|at| self.at(at).in_machine(c, self.lean));
        let way = behind - before;
        (way.z / way.norm()).abs().asin().to_degrees()
    }
}

/// The cuts of a program on a table that leans so: motions with G01 in which more than X moves.
///
/// # Errors
/// A block that is no block, a motion with G00 closer than `clear` to the axis, or a head that does
/// not stand upright (A0): its disc would stand across the groove.
pub fn cuts(nc: &str, clear: f64, lean: f64) -> Result<Vec<Cut>, String> {
    let mut at = [0.0; 4];
    let mut rapid = true;
    let mut found = Vec::new();
    for (line, text) in (1..).zip(nc.lines()).filter(|(_, text)| text.starts_with('N')) {
        let block = read_block(text.as_bytes(), "nc", line).map_err(|diag| diag.to_string())?;
        let from = at;
        let mut moves = false;
        for word in &block.words {
            let value = word.number.value();
            match (word.letter, b"XYZC".iter().position(|letter| *letter == word.letter)) {
                (b'G', _) if value == 0.0 || value == 1.0 => rapid = value == 0.0,
                (b'A', _) if value != 0.0 => {
                    return Err(format!("line {line}: the head stands at A{value}"));
                }
                (_, Some(axis)) if !block.words.iter().any(|word| word.letter == b'H') => {
                    at[axis] = value;
                    moves = true;
                }
                _ => {}
            }
        }
        // The first block comes from wherever the machine stands.
        if moves && rapid && !found.is_empty() && at[0].abs().min(from[0].abs()) < clear {
            return Err(format!("line {line}: rapid move at X {}", at[0]));
        }
        // In and out X moves alone, but for the last digit of a coarse CL file.
        let goes_along = (1..4).any(|axis| (from[axis] - at[axis]).abs() > 0.01);
        if !rapid && goes_along {
            found.push(Cut { line, from, to: at, lean });
        }
    }
    Ok(found)
}

const FIRST: Pen = Pen::full("#1565c0", 2.5);
const SECOND: Pen = Pen::full("#c62828", 2.5);
const THIN: Pen = Pen::full("#777", 1.2);
const AXIS: Pen = Pen::dashed("#777", 1.0);
/// Radius of the disc in the picture; the paper gives none.
const DISC: f64 = 30.0;

/// Tool and cylinder along the cylinder's axis and from +X, and the cylinder unrolled.
pub fn picture(first: &[Cut], second: &[Cut]) -> Picture {
    let mut picture = Picture::default();
    let radius = first[0].at(0.0).radius;
    along_the_axis(&mut picture, radius);
    from_x(&mut picture, [260.0, 0.0], radius, first);
    unrolled(&mut picture, [470.0, 0.0], &[(first, FIRST), (second, SECOND)]);
    picture
}

/// The cuts of both programs of a grid on the unrolled cylinder, and nothing else.
pub fn grid(first: &[Cut], second: &[Cut]) -> Picture {
    const LARGER: f64 = 5.0;
    let mut picture = Picture::default();
    let place = |round: f64, along: f64| [LARGER * round, LARGER * along];
    let mut field = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for (cuts, pen) in [(second, SECOND), (first, FIRST)] {
        for cut in cuts {
            let ends = [0.0, 0.5, 1.0].map(|part| {
                let spot = cut.at(part);
                let [round, along] = [spot.radius * spot.angle.to_radians(), spot.along];
                let [left, low, right, high] = field;
                field = [left.min(round), low.min(along), right.max(round), high.max(along)];
                place(round, along)
            });
            picture.line(&ends, pen);
        }
    }
    let [left, low, right, high] = field;
    let corners = [[left, low], [right, low], [right, high], [left, high], [left, low]];
    picture.line(&corners.map(|[round, along]| place(round, along)), AXIS);
    let middle = (left + right) / 2.0;
    picture.text(place(middle, high + 4.0), "round the cylinder to the right, along it upward");
    picture
        .text(place(middle, low - 9.0), "blue: first program, EMBOSL; red: second program, EMBOSR");
    picture
}

fn along_the_axis(picture: &mut Picture, radius: f64) {
    picture.circle([0.0, 0.0], radius, THIN);
    picture.line(&[[-130.0, 0.0], [130.0, 0.0]], AXIS);
    for (side, pen, name) in [(1.0, FIRST, "EMBOSL"), (-1.0, SECOND, "EMBOSR")] {
        // The disc lies in a plane at 45 degrees to the view: a narrow ellipse.
        let center = side * (radius + DISC);
        let rim: Vec<[f64; 2]> = (0..=72)
            .map(|step| {
                let (sine, cosine) = f64::from(step * 5).to_radians().sin_cos();
                [center + DISC * cosine, DISC * sine * 0.5_f64.sqrt()]
            })
            .collect();
        picture.line(&rim, pen);
        picture.text([center, DISC + 4.0], name);
        picture.text([center, -DISC - 10.0], if side > 0.0 { "+X" } else { "-X" });
    }
    picture.text([0.0, -18.0], "C");
    picture.text([0.0, 118.0], "along the axis of the cylinder");
}

/// Y to the right and Z up: the cylinder leans, the disc is seen on its edge.
fn from_x(picture: &mut Picture, middle: [f64; 2], radius: f64, cuts: &[Cut]) {
    let place = |y: f64, z: f64| [middle[0] + y, middle[1] + z];
    let h = 0.5_f64.sqrt();
    let corner = |along: f64, across: f64| place((along - across) * h, (along + across) * h);
    let outline = [
        corner(-60.0, -radius),
        corner(60.0, -radius),
        corner(60.0, radius),
        corner(-60.0, radius),
        corner(-60.0, -radius),
    ];
    picture.line(&outline, THIN);
    picture.line(&[corner(-75.0, 0.0), corner(75.0, 0.0)], AXIS);
    let [_, y, z, c] = cuts[0].from;
    // The grooves as they stand while the first one begins.
    for cut in cuts {
        let ends = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| cut.at(part).in_machine(c, cut.lean));
        picture.line(&ends.map(|at| place(at.y, at.z)), FIRST);
    }
    picture.line(&[place(y - DISC, z), place(y + DISC, z)], Pen::full("black", 2.5));
    picture.text(place(y - DISC - 16.0, z - 3.5), "disc");
    picture.text(place(0.0, 118.0), "from +X: Y right, Z up");
}

/// Round the cylinder to the right, along it up.
fn unrolled(picture: &mut Picture, corner: [f64; 2], groups: &[(&[Cut], Pen)]) {
    const LARGER: f64 = 3.0;
    let place = |spot: &Spot| {
        let round = spot.radius * spot.angle.to_radians();
        [corner[0] + LARGER * round, corner[1] + LARGER * (spot.along - 22.0)]
    };
    for (cuts, pen) in groups {
        for cut in *cuts {
            picture.line(&[place(&cut.at(0.0)), place(&cut.at(1.0))], *pen);
        }
    }
    picture.text([corner[0], 118.0], "the cylinder unrolled");
    picture.text([corner[0], -80.0], "blue: EMBOSL");
    picture.text([corner[0], -95.0], "red: EMBOSR");
}
