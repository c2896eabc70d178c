//! Holders of a lathe in the plane of X and Z: the shank of a turning tool, a boring bar, the holder
//! of a drill.

use crate::tool::{Body, Tool};
use crate::turning::profile::{Hit, Profile};

/// Straight move of a programmed point: Z and X at its ends, mm.
pub(crate) type Way = [[f64; 2]; 2];

/// A piece of a holder as a rectangle beside the programmed point, mm. `along` is its range from
/// the point to the side of the insert's body along Z, `across` that away from the cut surface along
/// X.
struct Piece {
    along: [f64; 2],
    across: [f64; 2],
}

/// What the holder of a tool touches on a way.
pub(crate) fn touched(profile: &Profile, way: Way, tool: &Tool, skin: f64) -> Hit {
    let Some(length) = tool.length else { return Hit::default() };
    let mut hit = Hit::default();
    match tool.body {
        Body::Insert(insert) => {
            let (body, side) = (-insert.along_z, -insert.along_x);
            for piece in pieces(tool, length, side > 0.0) {
                piece.touches(profile, way, (body, side), skin, &mut hit);
            }
        }
        // A drill comes from Z+, and its holder is round about the spindle axis.
        Body::Shape(_) => {
            let mut from = length;
            for piece in &tool.holder {
                let radius = piece.radius;
                let piece = Piece { along: [from, from + piece.length], across: [-radius, radius] };
                from = piece.along[1];
                piece.touches(profile, way, (1.0, 1.0), skin, &mut hit);
            }
        }
    }
    hit
}

/// The pieces of the holder of an insert. That of a tool outside goes away from the spindle axis,
/// each piece as wide along Z as its first number and flush with the tip. A boring bar goes along Z,
/// each piece as thick along X as its first number, all about the middle of the first one.
fn pieces(tool: &Tool, length: f64, is_outside: bool) -> impl Iterator<Item = Piece> + '_ {
    let mut from = if is_outside { length } else { 0.0 };
    let middle = length + tool.holder.first().map_or(0.0, |piece| piece.radius);
    tool.holder.iter().map(move |piece| {
        let far = from + piece.length;
        let near = std::mem::replace(&mut from, far);
        let thick = piece.radius;
        match is_outside {
            true => Piece { along: [0.0, 2.0 * thick], across: [near, far] },
            false => Piece { along: [near, far], across: [middle - thick, middle + thick] },
        }
    })
}

impl Piece {
    fn touches(
        &self,
        profile: &Profile,
        [from, to]: Way,
        (body, side): (f64, f64),
        skin: f64,
        hit: &mut Hit,
    ) {
        let (low, high) = (self.along[0] + skin, self.along[1] - skin);
        let change = (to[0] - from[0]) * body;
        for (index, [inner, outer]) in profile.disks().iter().copied().enumerate() {
            let z = profile.middle(index);
            let start = (z - from[0]) * body;
            // The part of the way on which the piece is over this disk.
            let (first, last) = match change.abs() < 1e-12 {
                true if start < low || start > high => continue,
                true => (0.0, 1.0),
                false => {
                    let shares = [(start - low) / change, (start - high) / change];
                    let first = shares[0].min(shares[1]).max(0.0);
                    let last = shares[0].max(shares[1]).min(1.0);
                    if first > last {
                        continue;
                    }
                    (first, last)
                }
            };
            let x = [first, last].map(|share| from[1] + (to[1] - from[1]) * share);
            let ends = [x[0].min(x[1]), x[0].max(x[1])];
            let [near, far] = self.across;
            let (least, most) = match side > 0.0 {
                true => (ends[0] + near, ends[1] + far),
                false => (ends[0] - far, ends[1] - near),
            };
            // Material is on both sides of the spindle axis.
            for (least, most) in [(least + skin, most - skin), (-most + skin, -least - skin)] {
                if inner < outer && least < outer && most > inner && least < most && most > 0.0 {
                    // The skin only decides if there is a touch.
                    let (least, most) = (least - skin, most + skin);
                    let (depth, at) = match side > 0.0 && least > inner {
                        true => (outer - least, least),
                        false => (most.min(outer) - inner.max(least), most.min(outer)),
                    };
                    hit.add(depth, [at, z], profile.step());
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock::Stock;

    fn depth(stock: &str, way: Way, tool: &str) -> f64 {
        let stock = Stock::read(stock).expect("stock").expect("a cylinder");
        let profile = Profile::new(&stock, Some(0.1)).expect("a profile");
        touched(&profile, way, &Tool::read(tool).expect("a tool"), 0.01).depth
    }

    #[test]
    fn the_shank_of_a_tool_outside() {
        // 12 deep with 10 below the shank; the shank is 20 wide from the tip to Z+.
        let groove = [[-30.0, 60.0], [-30.0, 38.0]];
        assert!((depth("cylinder 100x60", groove, "Q3R0.2W3L10H20x100") - 2.0).abs() < 0.02);
        assert_eq!(depth("cylinder 100x60", groove, "Q3R0.2W3L13H20x100"), 0.0);
        // Beside the end of the stock there is nothing to touch.
        assert_eq!(depth("cylinder 100x60", [[1.0, 60.0], [1.0, 0.0]], "Q3R0.8L5H20x100"), 0.0);
    }

    #[test]
    fn a_boring_bar_in_a_bore() {
        // Tip at X20 (radius): the bar is from 4 to 18 (L2, 14 thick) in a bore of radius 20.
        let in_bore = [[5.0, 20.0], [-40.0, 20.0]];
        assert_eq!(depth("tube 100x40x60", in_bore, "Q2R0.4L2H14x80"), 0.0);
        // A bar that is 45 thick reaches beyond the axis, to a radius of 27 on the other side.
        assert!((depth("tube 100x40x60", in_bore, "Q2R0.4L2H45x80") - 7.0).abs() < 0.02);
        // Its holder, 30 behind the tip, is wider than the bore.
        assert!(depth("tube 100x40x60", in_bore, "Q2R0.4L2H14x30H60x40") > 1.0);
        assert_eq!(depth("tube 100x40x60", in_bore, "Q2R0.4L2H14x50H60x40"), 0.0);
    }

    #[test]
    fn the_holder_of_a_drill() {
        let hole = [[5.0, 0.0], [-30.0, 0.0]];
        assert!(depth("tube 50x10x60", hole, "D10A118L25H30x40") > 9.9);
        assert_eq!(depth("tube 50x10x60", hole, "D10A118L31H30x40"), 0.0);
    }
}
