//! Stock of a lathe as a profile: outer and inner radius over Z.

use fil_diag::Diag;

use crate::errors::StockCode;
use crate::field::MAX_CELLS;
use crate::stock::Stock;
use crate::turning::insert::Insert;

/// Cells along the stock where no size of a cell is given.
const CELLS_ALONG: f64 = 2000.0;

/// Least size of a cell where none is given, mm.
const LEAST_STEP: f64 = 0.01;

/// Corners of a circle in an STL file.
const CORNERS: usize = 96;

/// Material that turns about Z, in disks of equal thickness, each from an inner to an outer radius.
/// There is none where both are equal. The surface is exact in the middle of each disk.
#[derive(Clone, Debug)]
pub struct Profile {
    /// The least Z, mm.
    from: f64,
    /// Thickness of a disk, mm.
    step: f64,
    /// Inner and outer radius, mm.
    disks: Vec<[f64; 2]>,
}

/// What a motion has removed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turned {
    /// mm³
    pub volume: f64,
    /// Most that was removed, in radius, by more than the skin, and where (X radius, Z); 0 where
    /// nothing was.
    pub depth: f64,
    pub at: [f64; 2],
    /// Along Z, mm.
    pub length: f64,
}

impl Profile {
    /// Stock before the first cut.
    ///
    /// # Errors
    /// E0962 for stock that is no cylinder about Z, E0963 for too many cells.
    pub(crate) fn new(stock: &Stock, step: Option<f64>) -> Result<Profile, Box<Diag>> {
        let &Stock::Cylinder { at, diameter, bore, height } = stock else {
            return StockCode::NotSimulated.err_with(
                "stock of a lathe that is no cylinder",
                "Write it as `cylinder:60x100` or `tube:60x20x100`, its face at Z0.",
            );
        };
        if at[0] != 0.0 || at[1] != 0.0 {
            return StockCode::NotSimulated.err("stock of a lathe beside the spindle axis");
        }
        let step = step.unwrap_or((height / CELLS_ALONG).max(LEAST_STEP));
        let count = (height / step - 1e-9).ceil().max(1.0);
        if count > MAX_CELLS as f64 {
            return StockCode::TooFine.err(format!("cells of {step} mm are {count}"));
        }
        let disks = vec![[bore / 2.0, diameter / 2.0]; count as usize];
        Ok(Profile { from: at[2], step: height / count, disks })
    }

    /// Thickness of a disk, mm.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Inner and outer radius of each disk, mm, that with the least Z first.
    pub fn disks(&self) -> &[[f64; 2]] {
        &self.disks
    }

    /// The middle of a disk, mm.
    pub fn middle(&self, disk: usize) -> f64 {
        self.from + (disk as f64 + 0.5) * self.step
    }

    /// Volume of the material, mm³.
    pub fn volume(&self) -> f64 {
        self.disks.iter().map(|disk| area(*disk)).sum::<f64>() * self.step
    }

    /// Removes what an insert cuts on a straight way of its programmed point, as Z and X.
    pub(crate) fn turn(&mut self, way: [[f64; 2]; 2], insert: &Insert, skin: f64) -> Turned {
        let is_outside = insert.along_x < 0.0;
        self.change(|[inner, outer], z| {
            let x = insert.reaches(way, z, 0.0)?;
            let shy = insert.reaches(way, z, skin);
            Some(if is_outside {
                let is_touched = shy.is_some_and(|x| x < outer);
                ([inner, outer.min(x).max(inner)], outer - x.max(inner), is_touched)
            } else {
                let is_touched = shy.is_some_and(|x| x > inner);
                ([inner.max(x).min(outer), outer], x.min(outer) - inner, is_touched)
            })
        })
    }

    /// Removes what a drill on the spindle axis cuts with its tip down to a Z; `radius_at` is its
    /// radius at a height over the tip.
    pub(crate) fn drill(&mut self, tip: f64, skin: f64, radius_at: impl Fn(f64) -> f64) -> Turned {
        self.change(|[inner, outer], z| {
            if z <= tip {
                return None;
            }
            let radius = radius_at(z - tip);
            let is_touched = z > tip + skin && radius - skin > inner;
            Some(([inner.max(radius).min(outer), outer], radius.min(outer) - inner, is_touched))
        })
    }

    /// Changes disks that have material: to what, by how much, and whether that is more than a
    /// touch.
    fn change(&mut self, next: impl Fn([f64; 2], f64) -> Option<([f64; 2], f64, bool)>) -> Turned {
        let mut turned = Turned { volume: 0.0, depth: 0.0, at: [0.0; 2], length: 0.0 };
        let mut touched = [f64::INFINITY, f64::NEG_INFINITY];
        for index in 0..self.disks.len() {
            let (disk, z) = (self.disks[index], self.middle(index));
            if disk[0] >= disk[1] {
                continue;
            }
            let Some((left, depth, is_touched)) = next(disk, z) else { continue };
            if depth <= 0.0 {
                continue;
            }
            turned.volume += (area(disk) - area(left)) * self.step;
            if is_touched {
                touched = [touched[0].min(z), touched[1].max(z)];
                if depth > turned.depth {
                    (turned.depth, turned.at) =
                        (depth, [if left[1] < disk[1] { left[1] } else { left[0] }, z]);
                }
            }
            self.disks[index] = left;
        }
        if turned.depth > 0.0 {
            turned.length = touched[1] - touched[0] + self.step;
        }
        turned
    }

    /// The material as binary STL, mm, about Z.
    pub fn stl(&self) -> Vec<u8> {
        let mut facets = crate::mesh::Facets::new();
        let corner = |index: usize, radius: f64, z: f64| {
            let turn = std::f64::consts::TAU * (index % CORNERS) as f64 / CORNERS as f64;
            let (sine, cosine) = libm::sincos(turn);
            [radius * cosine, radius * sine, z]
        };
        let mut index = 0;
        while index < self.disks.len() {
            let begin = index;
            let [inner, outer] = self.disks[begin];
            while self.disks.get(index) == Some(&[inner, outer]) {
                index += 1;
            }
            if inner >= outer {
                continue;
            }
            let [low, high] = [begin, index].map(|disk| self.from + disk as f64 * self.step);
            for side in 0..CORNERS {
                let ring =
                    |radius: f64, z: f64| [corner(side, radius, z), corner(side + 1, radius, z)];
                let ([a, b], [c, d]) = (ring(outer, low), ring(outer, high));
                facets.quad([a, b, d, c]);
                let ([e, f], [g, h]) = (ring(inner, low), ring(inner, high));
                if inner > 0.0 {
                    facets.quad([f, e, g, h]);
                }
                facets.quad([e, f, b, a]);
                facets.quad([h, g, c, d]);
            }
        }
        facets.finish()
    }
}

fn area([inner, outer]: [f64; 2]) -> f64 {
    std::f64::consts::PI * (outer * outer - inner * inner)
}
