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

/// Where and how deep something is touched.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hit {
    /// Most that is touched, in radius, mm; 0 where nothing is.
    pub depth: f64,
    /// Where that is: X as a radius, and Z, mm.
    pub at: [f64; 2],
    /// Length along Z, mm.
    pub length: f64,
    /// From where to where along Z.
    range: Option<[f64; 2]>,
}

impl Hit {
    /// Adds a disk of a thickness that is touched at a place.
    pub fn add(&mut self, depth: f64, at: [f64; 2], step: f64) {
        if depth <= 0.0 {
            return;
        }
        let [low, high] = self.range.unwrap_or([at[1]; 2]);
        let range = [low.min(at[1]), high.max(at[1])];
        self.range = Some(range);
        self.length = range[1] - range[0] + step;
        if depth > self.depth {
            (self.depth, self.at) = (depth, at);
        }
    }
}

/// What a motion has removed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turned {
    /// mm³
    pub volume: f64,
    /// What was removed by more than the skin.
    pub touch: Hit,
    /// What was removed of the part by more than the tolerance.
    pub part: Hit,
}

/// The part that must be left: inner and outer radius of each disk, and by how much a cut may be
/// within it, mm.
#[derive(Clone, Copy)]
pub(crate) struct Kept<'p> {
    pub radii: &'p [[f64; 2]],
    pub tolerance: f64,
}

/// What a cut makes of a disk.
struct Cut {
    left: [f64; 2],
    /// In radius, mm.
    depth: f64,
    is_touched: bool,
    /// Depth of the cut in the part, mm.
    part: f64,
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

    /// Disks whose middle lies between two Z, mm.
    pub(crate) fn between(&self, low: f64, high: f64) -> std::ops::Range<usize> {
        let index = |z: f64| ((z - self.from) / self.step - 0.5).ceil().max(0.0) as usize;
        let end = index(high).min(self.disks.len());
        index(low).min(end)..end
    }

    /// Removes what an insert cuts on a straight way of its programmed point, as Z and X.
    pub(crate) fn turn(
        &mut self,
        way: [[f64; 2]; 2],
        insert: &Insert,
        skin: f64,
        kept: Option<Kept<'_>>,
    ) -> Turned {
        let is_outside = insert.along_x < 0.0;
        self.change(|index, [inner, outer], z| {
            let x = insert.reaches(way, z, 0.0)?;
            let reaches = |skin: f64| insert.reaches(way, z, skin);
            let into_part = |kept: Kept<'_>| {
                let [low, high] = kept.radii[index];
                let shy = reaches(kept.tolerance).filter(|_| low < high);
                shy.map_or(0.0, |shy| match is_outside {
                    true if shy < high.min(outer) => high.min(outer) - x.max(inner).max(low),
                    false if shy > low.max(inner) => x.min(outer).min(high) - low.max(inner),
                    _ => 0.0,
                })
            };
            let (left, depth) = match is_outside {
                true => ([inner, outer.min(x).max(inner)], outer - x.max(inner)),
                false => ([inner.max(x).min(outer), outer], x.min(outer) - inner),
            };
            let is_touched = depth > 0.0
                && reaches(skin).is_some_and(|x| if is_outside { x < outer } else { x > inner });
            let part = if depth > 0.0 { kept.map_or(0.0, into_part) } else { 0.0 };
            Some(Cut { left, depth, is_touched, part })
        })
    }

    /// Removes what a drill on the spindle axis cuts with its tip down to a Z; `radius_at` is its
    /// radius at a height over the tip.
    pub(crate) fn drill(
        &mut self,
        tip: f64,
        skin: f64,
        kept: Option<Kept<'_>>,
        radius_at: impl Fn(f64) -> f64,
    ) -> Turned {
        self.change(|index, [inner, outer], z| {
            if z <= tip {
                return None;
            }
            let radius = radius_at(z - tip);
            let is_touched = z > tip + skin && radius - skin > inner;
            let part = kept.map_or(0.0, |kept| {
                let [low, high] = kept.radii[index];
                let shy = if z > tip + kept.tolerance { radius - kept.tolerance } else { 0.0 };
                let is_in = low < high && shy > low.max(inner);
                if is_in { radius.min(outer).min(high) - low.max(inner) } else { 0.0 }
            });
            let left = [inner.max(radius).min(outer), outer];
            Some(Cut { left, depth: radius.min(outer) - inner, is_touched, part })
        })
    }

    /// Changes disks that have material.
    fn change(&mut self, next: impl Fn(usize, [f64; 2], f64) -> Option<Cut>) -> Turned {
        let mut turned = Turned::default();
        for index in 0..self.disks.len() {
            let (disk, z) = (self.disks[index], self.middle(index));
            if disk[0] >= disk[1] {
                continue;
            }
            let Some(cut) = next(index, disk, z).filter(|cut| cut.depth > 0.0) else { continue };
            turned.volume += (area(disk) - area(cut.left)) * self.step;
            let at = [if cut.left[1] < disk[1] { cut.left[1] } else { cut.left[0] }, z];
            if cut.is_touched {
                turned.touch.add(cut.depth, at, self.step);
            }
            turned.part.add(cut.part, at, self.step);
            self.disks[index] = cut.left;
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
