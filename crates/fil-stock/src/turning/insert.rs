//! Turning inserts: the edge in the plane of X and Z.

/// Halvings of the search for the place of an insert where it cuts deepest.
const STEPS: usize = 48;

/// An insert, mm. Its programmed point is the imaginary tip: where the tangents of its nose along X
/// and Z meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Insert {
    /// Radius of the nose.
    pub nose: f64,
    /// Its tip points to the spindle axis (-1) or away from it (1), as that of a boring bar.
    pub along_x: f64,
    /// Its tip points to Z- (-1) or Z+ (1).
    pub along_z: f64,
    /// Width of a grooving insert, with a nose at both sides.
    pub width: Option<f64>,
    /// Angle between the trailing edge and Z, degrees; not of a grooving insert.
    pub trailing: f64,
    /// Length of the trailing edge along Z.
    pub edge: f64,
}

impl Insert {
    /// An insert by the number of its tip direction (1 to 4), as in the tool table of a control.
    pub fn pointing(nose: f64, direction: u32) -> Option<Insert> {
        let (along_x, along_z) = match direction {
            1 => (1.0, 1.0),
            2 => (1.0, -1.0),
            3 => (-1.0, -1.0),
            4 => (-1.0, 1.0),
            _ => return None,
        };
        Some(Insert { nose, along_x, along_z, width: None, trailing: 5.0, edge: 10.0 })
    }

    /// From where to where it is along Z, from its programmed point to the side of its body.
    fn span(&self) -> [f64; 2] {
        [0.0, self.width.unwrap_or(self.edge)]
    }

    /// How far the edge is behind its tip along X, at a distance from the tip along Z to the side
    /// of its body, within the span and beside it by `skin` less. The edge is `skin` further back.
    fn depth(&self, at: f64, skin: f64) -> f64 {
        let nose = (self.nose - skin).max(0.0);
        // A nose that is smaller than the skin leaves a sharp corner that far back.
        let center = self.nose.max(skin);
        let round = |from_center: f64| {
            let out = from_center.abs().min(nose);
            center - (nose * nose - out * out).sqrt()
        };
        let from_center = at - self.nose;
        if from_center <= 0.0 {
            return round(from_center);
        }
        if let Some(width) = self.width {
            return round((from_center - (width - 2.0 * self.nose)).max(0.0));
        }
        let (sine, cosine) = libm::sincos(self.trailing.to_radians());
        if from_center <= nose * sine {
            return round(from_center);
        }
        // The edge goes on from the nose along its tangent.
        let edge = self.nose + (from_center * sine - (self.nose - skin)) / cosine;
        edge.max(center - nose)
    }

    /// The X to which the edge comes over a Z while its programmed point goes from one place to
    /// another (Z, X): the least for a tool outside, the greatest for one inside. `None` where it
    /// does not come there. With `skin` the edge is smaller all round.
    pub(crate) fn reaches(&self, [from, to]: [[f64; 2]; 2], z: f64, skin: f64) -> Option<f64> {
        let [low, high] = self.span();
        let (low, high) = (low + skin, high - skin);
        let body = -self.along_z;
        // Distance from the tip to the side of the body, at the start and for the whole way.
        let start = (z - from[0]) * body;
        let change = (to[0] - from[0]) * body;
        let (mut first, mut last) = (0.0f64, 1.0f64);
        if change.abs() < 1e-12 {
            if start < low || start > high {
                return None;
            }
        } else {
            let shares = [(start - low) / change, (start - high) / change];
            first = first.max(shares[0].min(shares[1]));
            last = last.min(shares[0].max(shares[1]));
            if first > last {
                return None;
            }
        }
        // Away from the side that is cut: convex, as the edge is.
        let side = -self.along_x;
        let off = |share: f64| {
            (from[1] + (to[1] - from[1]) * share) * side + self.depth(start - change * share, skin)
        };
        for _ in 0..STEPS {
            let third = (last - first) / 3.0;
            if off(first + third) <= off(last - third) {
                last -= third;
            } else {
                first += third;
            }
        }
        Some(off((first + last) / 2.0).min(off(first)).min(off(last)) * side)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn inserts() -> impl Strategy<Value = Insert> {
        (0.0..1.2f64, 1..=4u32, proptest::option::of(3.0..6.0f64), 1.0..40.0f64).prop_map(
            |(nose, direction, width, trailing)| {
                let insert = Insert::pointing(nose, direction).expect("a direction");
                Insert { width, trailing, ..insert }
            },
        )
    }

    proptest! {
        /// No sample of the way comes farther than what is found, and one about as far.
        #[test]
        fn an_insert_reaches_what_samples_do(
            insert in inserts(), from in proptest::array::uniform2(-8.0..8.0f64),
            to in proptest::array::uniform2(-8.0..8.0f64), z in -20.0..20.0f64,
        ) {
            let side = -insert.along_x;
            let mut farthest: Option<f64> = None;
            for step in 0..=2000 {
                let share = f64::from(step) / 2000.0;
                let tip = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
                let at = (z - tip[0]) * -insert.along_z;
                if (0.0..=insert.width.unwrap_or(insert.edge)).contains(&at) {
                    let x = tip[1] * side + insert.depth(at, 0.0);
                    farthest = Some(farthest.map_or(x, |known| known.min(x)));
                }
            }
            let found = insert.reaches([from, to], z, 0.0).map(|x| x * side);
            if let (Some(found), Some(farthest)) = (found, farthest) {
                prop_assert!(found <= farthest + 1e-6, "{} {}", found, farthest);
                prop_assert!(found >= farthest - 0.2, "{} {}", found, farthest);
            }
            prop_assert!(found.is_some() || farthest.is_none());
        }

        /// The smaller edge is as far back as the skin, and never in front of the edge.
        #[test]
        fn a_smaller_edge_is_further_back(insert in inserts(), share in 0.01..0.99f64) {
            let skin = 0.01;
            let at = insert.span()[1] * share;
            let back = insert.depth(at, skin) - insert.depth(at, 0.0);
            prop_assert!(back >= skin - 1e-9, "{insert:?} at {at}: {back}");
        }
    }
}
