//! Descriptions of stock.

use fil_diag::Diag;

use crate::errors::StockCode;
use crate::mesh::Mesh;
use crate::units::{numbers, split_unit};

/// What a program starts from, mm in the coordinates of the part.
#[derive(Clone, Debug, PartialEq)]
pub enum Stock {
    /// A box.
    Box(Size),
    /// A cylinder along Z, or a tube.
    Cylinder {
        /// Center of the lower face.
        at: [f64; 3],
        /// Diameter.
        diameter: f64,
        /// Diameter of the bore; 0 without one.
        bore: f64,
        /// Length along Z.
        height: f64,
    },
    /// A closed surface.
    Mesh(Mesh),
    /// The box around all cuts, its top at Z0.
    Auto,
}

/// A box by its corners, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// The corner with the least X, Y, Z.
    pub least: [f64; 3],
    /// The corner with the greatest X, Y, Z.
    pub most: [f64; 3],
}

impl Stock {
    /// Stock from a description: `box 100x80x30`, `cylinder 60x100` (diameter and height),
    /// `tube 60x20x100`, `auto`; `at X,Y,Z` at the end places the corner with the least
    /// coordinates, or the center of the lower face. Without it the top is at Z0, and X0 Y0 is
    /// that corner or center. `None` where the text describes none of these: it may be a file.
    ///
    /// # Errors
    /// E0965
    pub fn read(text: &str) -> Result<Option<Stock>, Box<Diag>> {
        let flat = text.replace([':', '@'], " ");
        let mut words = flat.split_whitespace().filter(|word| *word != "at");
        let kind = words.next().unwrap_or_default().to_ascii_lowercase();
        let count = match kind.as_str() {
            "box" | "tube" => 3,
            "cylinder" => 2,
            "auto" => 0,
            _ => return Ok(None),
        };
        let wrong = |what: &str| StockCode::BadDescription.diag(format!("stock `{text}`: {what}"));
        if count == 0 {
            return match words.next() {
                None => Ok(Some(Stock::Auto)),
                Some(_) => Err(wrong("`auto` stands alone")),
            };
        }
        let (sizes, unit) = split_unit(words.next().unwrap_or_default());
        let sizes = numbers(&sizes.to_ascii_lowercase(), 'x', unit)
            .filter(|sizes| sizes.len() == count && sizes.iter().all(|size| *size > 0.0))
            .ok_or_else(|| wrong("its sizes are not all there: box 100x80x30, cylinder 60x100"))?;
        let at = words.next().map(|at| {
            let (at, own) = split_unit(at);
            let unit = if own == 1.0 { unit } else { own };
            let at = numbers(at, ',', unit);
            at.and_then(|at| <[f64; 3]>::try_from(at).ok())
                .ok_or_else(|| wrong("its place is not X,Y,Z"))
        });
        let at = at.transpose()?;
        if words.next().is_some() {
            return Err(wrong("a description is a kind, sizes and a place"));
        }
        let height = sizes[count - 1];
        let at = at.unwrap_or([0.0, 0.0, -height]);
        Ok(Some(match kind.as_str() {
            "box" => Stock::Box(Size {
                least: at,
                most: [at[0] + sizes[0], at[1] + sizes[1], at[2] + height],
            }),
            _ => {
                let bore = if count == 3 { sizes[1] } else { 0.0 };
                if bore >= sizes[0] {
                    return Err(wrong("its bore is as wide as itself"));
                }
                Stock::Cylinder { at, diameter: sizes[0], bore, height }
            }
        }))
    }

    /// The box around it; `cuts` is that around all cuts of the program.
    pub(crate) fn size(&self, cuts: Option<Size>) -> Option<Size> {
        match self {
            Stock::Box(size) => Some(*size),
            Stock::Cylinder { at, diameter, height, .. } => {
                let radius = diameter / 2.0;
                Some(Size {
                    least: [at[0] - radius, at[1] - radius, at[2]],
                    most: [at[0] + radius, at[1] + radius, at[2] + height],
                })
            }
            Stock::Mesh(mesh) => Some(mesh.size()),
            Stock::Auto => {
                let mut size = cuts?;
                size.most[2] = 0.0;
                (size.least[2] < 0.0).then_some(size)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_and_cylinders() {
        let read = |text| Stock::read(text).expect("a description").expect("stock");
        let block = Stock::Box(Size { least: [0.0, 0.0, -30.0], most: [100.0, 80.0, 0.0] });
        assert_eq!(read("box 100x80x30"), block);
        assert_eq!(read("box:100x80x30@0,0,-30"), block);
        let inch = Stock::Box(Size { least: [0.0, 0.0, -25.4], most: [101.6, 3.0 * 25.4, 0.0] });
        assert_eq!(read("box 4x3x1in at 0,0,-1"), inch);
        let bar = Stock::Cylinder { at: [1.0, 2.0, 3.0], diameter: 60.0, bore: 0.0, height: 100.0 };
        assert_eq!(read("cylinder 60x100 at 1,2,3"), bar);
        assert_eq!(read("auto"), Stock::Auto);
        assert_eq!(Stock::read("part.stl").expect("no error"), None);
    }

    #[test]
    fn wrong_descriptions_are_refused() {
        for text in [
            "box",
            "box 100x80",
            "box 100x80x0",
            "box 1x1x1 at 1,2",
            "tube 20x30x5",
            "auto 3",
            "box 1x1x1 at 1,2,3 4",
            "cylinder ax5",
        ] {
            assert_eq!(Stock::read(text).expect_err(text).code.name(), "E0965", "{text}");
        }
    }
}
