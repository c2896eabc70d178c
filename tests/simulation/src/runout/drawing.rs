//! The pictures of the page on run-out.

use super::{Cylinder, Probed, RADIUS};
use filpost_tests::picture::{Pen, Picture};

/// How many times larger the run-out is drawn in the sections.
const LARGER: f64 = 150.0;
const TABLE: Pen = Pen::dashed("#888888", 1.2);
const PART: Pen = Pen::full("#1b5e9c", 2.0);
const PROBE: Pen = Pen::full("#b3261e", 1.2);
const BEFORE: Pen = Pen::full("#b3261e", 2.0);
const NOISY: Pen = Pen::full("#1b5e9c", 1.2);
const AFTER: Pen = Pen::full("#1a7f37", 2.0);
const GRID: Pen = Pen::full("#cccccc", 1.0);

/// Both sections from above and the axes from the side, run-out enlarged.
pub fn sections(cylinder: &Cylinder, probed: &[Probed; 2]) -> Picture {
    let mut picture = Picture::default();
    for (index, section) in probed.iter().enumerate() {
        let middle = [index as f64 * 170.0, 0.0];
        from_above(&mut picture, middle, index + 1, section);
    }
    from_the_side(&mut picture, [330.0, -60.0], cylinder, probed);
    picture
}

fn from_above(picture: &mut Picture, middle: [f64; 2], number: usize, section: &Probed) {
    let Probed { height, least: [min, cmin], largest: [max, cmax] } = *section;
    let eccentric = LARGER * (max - min) / 2.0;
    let at = |radius: f64, c: f64| {
        let (sine, cosine) = c.to_radians().sin_cos();
        [middle[0] + radius * cosine, middle[1] + radius * sine]
    };
    let center = at(eccentric, cmax);
    picture.circle(middle, RADIUS, TABLE);
    cross(picture, middle, 6.0, TABLE);
    picture.circle(center, RADIUS, PART);
    picture.circle(center, 1.5, PART);
    picture.line(&[at(RADIUS - eccentric, cmin), at(RADIUS + eccentric, cmax)], PROBE);
    for (radius, c, name) in [(RADIUS - eccentric, cmin, "MIN"), (RADIUS + eccentric, cmax, "MAX")]
    {
        picture.circle(at(radius, c), 2.0, PROBE);
        // Outside of the dashed circle too.
        let [x, y] = at(radius.max(RADIUS) + 14.0, c);
        picture.text([x, y - 2.0], name);
    }
    let label = |picture: &mut Picture, line: f64, text: String| {
        picture.text([middle[0], -RADIUS - 29.0 - 9.0 * line], &text);
    };
    let (sine, cosine) = (cmax + 90.0).to_radians().sin_cos();
    let beside = [center[0] + 9.0 * cosine, center[1] + 9.0 * sine - 2.0];
    picture.text(beside, &format!("P{number}"));
    picture.text([middle[0], RADIUS + 30.0], &format!("Section {number}, Z{height}"));
    label(picture, 0.0, format!("MIN {min:.2} at C{cmin:.1}"));
    label(picture, 1.0, format!("MAX {max:.2} at C{cmax:.1}"));
}

/// Y to the right, Z up, as seen from +X.
fn from_the_side(picture: &mut Picture, foot: [f64; 2], cylinder: &Cylinder, probed: &[Probed; 2]) {
    let top = 120.0;
    let side = |height: f64| {
        let lean = cylinder.axis.y / cylinder.axis.z;
        [foot[0] + LARGER * (cylinder.foot.y + lean * height), foot[1] + height]
    };
    picture.line(&[[foot[0] - 62.0, foot[1]], [foot[0] + 62.0, foot[1]]], GRID);
    picture.line(&[[foot[0], foot[1] - 10.0], [foot[0], foot[1] + top + 5.0]], TABLE);
    picture.line(&[side(-5.0), side(top)], PART);
    let [bottom, upper] = [side(0.0), side(top)];
    let outline =
        [-RADIUS, RADIUS].map(|by| [[bottom[0] + by, bottom[1]], [upper[0] + by, upper[1]]]);
    for edge in outline {
        picture.line(&edge, Pen { width: 1.0, ..PART });
    }
    for (index, section) in probed.iter().enumerate() {
        let at = side(section.height);
        picture.line(&[[at[0] - RADIUS, at[1]], [at[0] + RADIUS, at[1]]], PROBE);
        picture.circle(at, 1.5, PART);
        picture.text([at[0] + 9.0, at[1] + 3.0], &format!("P{}", index + 1));
    }
    picture.text([foot[0], RADIUS + 30.0], "From the side (+X)");
    picture.text([foot[0], foot[1] - 19.0], "dashed: table axis");
    picture.text([foot[0], foot[1] - 28.0], "blue: the part");
}

/// Degrees of C are millimetres of the drawing.
const FULL: f64 = 360.0;
/// Half the height of a strip.
const HALF: f64 = 40.0;

/// Deviation over C before and after, and after it once more, enlarged. Each curve is C
/// (degrees) and deviation (mm).
pub fn over_c(before: &[[f64; 2]], after: &[[f64; 2]], noisy: &[[f64; 2]]) -> Picture {
    let mut picture = Picture::default();
    strip(&mut picture, 0.0, "+0.1", "-0.1");
    curve(&mut picture, before, 0.0, 0.1, BEFORE);
    curve(&mut picture, after, 0.0, 0.1, AFTER);
    picture.text(
        [FULL / 2.0, HALF + 12.0],
        "mm off the surface; red: without compensation; green: with it",
    );
    let low = -130.0;
    strip(&mut picture, low, "+2 µm", "-2 µm");
    curve(&mut picture, noisy, low, 0.002, NOISY);
    curve(&mut picture, after, low, 0.002, AFTER);
    let text = "the same 50 times larger; blue: compensated from readings wrong by up to 1 µm";
    picture.text([FULL / 2.0, low + HALF + 12.0], text);
    picture
}

fn strip(picture: &mut Picture, middle: f64, top: &str, bottom: &str) {
    for height in [-HALF, 0.0, HALF] {
        picture.line(&[[0.0, middle + height], [FULL, middle + height]], GRID);
    }
    for c in [0.0, 90.0, 180.0, 270.0, 360.0] {
        picture.line(&[[c, middle - HALF], [c, middle + HALF]], GRID);
        picture.text([c, middle - HALF - 10.0], &format!("C{c}"));
    }
    picture.text([-18.0, middle + HALF - 2.0], top);
    picture.text([-18.0, middle - HALF - 2.0], bottom);
    picture.text([-18.0, middle - 2.0], "0");
}

fn curve(picture: &mut Picture, points: &[[f64; 2]], middle: f64, full: f64, pen: Pen) {
    let points: Vec<[f64; 2]> =
        points.iter().map(|[c, off]| [*c, middle + off / full * HALF]).collect();
    picture.line(&points, pen);
}

fn cross(picture: &mut Picture, at: [f64; 2], size: f64, pen: Pen) {
    picture.line(&[[at[0] - size, at[1]], [at[0] + size, at[1]]], pen);
    picture.line(&[[at[0], at[1] - size], [at[0], at[1] + size]], pen);
}
