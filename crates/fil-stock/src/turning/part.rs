//! The finished part of a lathe: an STL file as outer and inner radius over Z.

use crate::mesh::Mesh;
use crate::turning::profile::Profile;

/// Sides of an inner outline that span more than this about the axis are flats, not chords of a
/// bore, radians.
const FLAT: f64 = std::f64::consts::PI / 6.0;

/// Direction of the ray that finds out if the axis is in material, radians. An odd one: no edge of
/// a usual part lies on it.
const RAY: f64 = 0.723_6;

/// Inner and outer radius of a part in the middle of each disk, mm: no turned surface may lie between
/// them. Both are 0 where there is no part.
pub(crate) fn of(part: &Mesh, profile: &Profile) -> Vec<[f64; 2]> {
    let mut sections = vec![Section::default(); profile.disks().len()];
    for triangle in part.triangles() {
        let z = triangle.map(|corner| corner[2]);
        let (low, high) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
        for index in profile.between(low, high) {
            let at = profile.middle(index);
            let mut ends = [0, 1, 2].into_iter().filter_map(|from| {
                let (a, b) = (triangle[from], triangle[(from + 1) % 3]);
                // One end counts as above: each side of a triangle is cut once or not at all.
                ((a[2] >= at) != (b[2] >= at)).then(|| {
                    let share = (at - a[2]) / (b[2] - a[2]);
                    [0, 1].map(|axis| a[axis] + (b[axis] - a[axis]) * share)
                })
            });
            if let (Some(one), Some(other)) = (ends.next(), ends.next()) {
                sections[index].add([one, other]);
            }
        }
    }
    sections.iter().map(Section::radii).collect()
}

/// A section of the part square to the axis.
#[derive(Clone, Debug)]
struct Section {
    least: f64,
    most: f64,
    /// The axis is in material: a ray from it leaves the part an odd number of times.
    is_solid: bool,
}

impl Default for Section {
    fn default() -> Section {
        Section { least: f64::INFINITY, most: 0.0, is_solid: false }
    }
}

impl Section {
    fn add(&mut self, side: [[f64; 2]; 2]) {
        let radii = side.map(|[x, y]| libm::hypot(x, y));
        self.most = self.most.max(radii[0]).max(radii[1]);
        self.least = self.least.min(radii[0]).min(radii[1]);
        let cross = side[0][0] * side[1][1] - side[0][1] * side[1][0];
        let dot = side[0][0] * side[1][0] + side[0][1] * side[1][1];
        if libm::atan2(cross, dot).abs() > FLAT {
            let long = libm::hypot(side[1][0] - side[0][0], side[1][1] - side[0][1]);
            self.least = self.least.min(cross.abs() / long.max(1e-12));
        }
        let (sine, cosine) = libm::sincos(RAY);
        let turned = side.map(|[x, y]| [x * cosine + y * sine, y * cosine - x * sine]);
        let [a, b] = turned;
        if (a[1] >= 0.0) != (b[1] >= 0.0) {
            let x = a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1]);
            self.is_solid ^= x > 0.0;
        }
    }

    fn radii(&self) -> [f64; 2] {
        match self.most > 0.0 {
            false => [0.0; 2],
            true if self.is_solid => [0.0, self.most],
            true => [self.least, self.most],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock::Stock;

    /// A turned part, written as STL and read again.
    #[test]
    fn a_tube_has_its_radii() {
        let stock = |text: &str| Stock::read(text).expect("stock").expect("a cylinder");
        let profile = |text: &str| Profile::new(&stock(text), Some(0.5)).expect("a profile");
        let around = profile("cylinder 60x50");
        for (text, radii) in [("tube 40x20x30", [10.0, 20.0]), ("cylinder 40x30", [0.0, 20.0])] {
            let mesh = Mesh::read("part.stl", &profile(text).stl()).expect("a mesh");
            let found = of(&mesh, &around);
            for (index, [inner, outer]) in found.iter().enumerate() {
                let wanted = if around.middle(index) > -30.0 { radii } else { [0.0; 2] };
                // Diagonals of the quads lie on chords of the bore.
                assert!((inner - wanted[0]).abs() < 0.006, "{text} {index} {inner}");
                assert!((outer - wanted[1]).abs() < 1e-4, "{text} {index} {outer}");
            }
        }
    }

    #[test]
    fn flats_of_a_hexagon_are_no_chords_of_a_bore() {
        let corner = |at: usize| {
            let (sine, cosine) = libm::sincos(at as f64 * std::f64::consts::FRAC_PI_3);
            [10.0 * cosine, 10.0 * sine]
        };
        let mut section = Section::default();
        (0..6).for_each(|at| section.add([corner(at), corner(at + 1)]));
        assert!((section.least - 10.0 * (3.0f64).sqrt() / 2.0).abs() < 1e-9);
        assert!(section.is_solid);
    }
}
