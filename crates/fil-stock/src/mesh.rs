//! STL files: read as triangles, and a height field written as one.

use fil_diag::Diag;

use crate::errors::StockCode;
use crate::field::{Grid, HeightField};
use crate::stock::Size;

/// Three corners, mm.
pub type Triangle = [[f64; 3]; 3];

/// Bytes before the triangles of a binary file: a text and their number.
const HEAD: usize = 84;

/// Bytes of a triangle of a binary file.
const BINARY: usize = 50;

/// How far outside of a triangle, in shares of it, a point counts as on its edge: two triangles
/// that share an edge leave no gap between them.
const ON_EDGE: f64 = 1e-9;

/// A surface of triangles; at least one.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    triangles: Vec<Triangle>,
    size: Size,
}

impl Mesh {
    /// The triangles of an STL file, ASCII or binary, in mm and the coordinates of the part; `name`
    /// is for the message.
    ///
    /// # Errors
    /// E0964
    pub fn read(name: &str, bytes: &[u8]) -> Result<Mesh, Box<Diag>> {
        let wrong = |what: &str| StockCode::BadMesh.diag(format!("{name}: {what}"));
        let triangles = match binary(bytes) {
            Some(triangles) => triangles,
            None => ascii(bytes).map_err(|what| wrong(&what))?,
        };
        if triangles.iter().flatten().flatten().any(|value| !value.is_finite() || value.abs() > 1e7)
        {
            return Err(wrong("a corner is no point within 10 km"));
        }
        let mut size = Size { least: [f64::INFINITY; 3], most: [f64::NEG_INFINITY; 3] };
        for corner in triangles.iter().flatten() {
            size.add(*corner);
        }
        if triangles.is_empty() {
            return Err(wrong("it has no triangle"));
        }
        Ok(Mesh { triangles, size })
    }

    /// The box around it.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Its triangles.
    pub(crate) fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The greatest and the least Z of the surface over each cell's center; infinite where there
    /// is none.
    pub(crate) fn heights(&self, grid: &Grid) -> (Vec<f32>, Vec<f32>) {
        let mut top = vec![f32::NEG_INFINITY; grid.cells()];
        let mut bottom = vec![f32::INFINITY; grid.cells()];
        for triangle in &self.triangles {
            let bounds = [0, 1].map(|axis| {
                let values = triangle.map(|corner| corner[axis]);
                [
                    values.into_iter().fold(f64::INFINITY, f64::min),
                    values.into_iter().fold(f64::NEG_INFINITY, f64::max),
                ]
            });
            for row in grid.range(1, bounds[1]) {
                for column in grid.range(0, bounds[0]) {
                    let Some(z) = height(triangle, grid.center(column, row)) else { continue };
                    let cell = row * grid.columns + column;
                    top[cell] = top[cell].max(z as f32);
                    bottom[cell] = bottom[cell].min(z as f32);
                }
            }
        }
        (top, bottom)
    }
}

impl Size {
    /// Grows to a point.
    pub(crate) fn add(&mut self, point: [f64; 3]) {
        for (axis, at) in point.into_iter().enumerate() {
            self.least[axis] = self.least[axis].min(at);
            self.most[axis] = self.most[axis].max(at);
        }
    }
}

/// Z of a triangle over a point; `None` beside it, and for an upright one.
fn height([a, b, c]: &Triangle, at: [f64; 2]) -> Option<f64> {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let from_a = |point: &[f64; 3]| [point[0] - a[0], point[1] - a[1]];
    let (ab, ac, ap) = (from_a(b), from_a(c), [at[0] - a[0], at[1] - a[1]]);
    let area = cross(ab, ac);
    if area == 0.0 {
        return None;
    }
    let (of_b, of_c) = (cross(ap, ac) / area, cross(ab, ap) / area);
    let is_in = of_b >= -ON_EDGE && of_c >= -ON_EDGE && of_b + of_c <= 1.0 + ON_EDGE;
    is_in.then(|| a[2] + of_b * (b[2] - a[2]) + of_c * (c[2] - a[2]))
}

/// The triangles of a binary file, told by its length.
fn binary(bytes: &[u8]) -> Option<Vec<Triangle>> {
    let count = bytes.get(HEAD - 4..HEAD)?;
    let count = u32::from_le_bytes(count.try_into().ok()?) as usize;
    let body = &bytes[HEAD..];
    if count.checked_mul(BINARY) != Some(body.len()) {
        return None;
    }
    let number =
        |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    let corner =
        |facet: &[u8], at: usize| [0, 1, 2].map(|axis| number(&facet[12 + at * 12 + axis * 4..]));
    Some(body.chunks_exact(BINARY).map(|facet| [0, 1, 2].map(|at| corner(facet, at))).collect())
}

/// The triangles of an ASCII file.
fn ascii(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let text =
        std::str::from_utf8(bytes).map_err(|_| "it is not complete, or no STL".to_string())?;
    if !text.trim_start().starts_with("solid") {
        return Err("it does not begin with `solid`".into());
    }
    let mut corners: Vec<[f64; 3]> = Vec::new();
    let mut is_ended = false;
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("vertex") => {
                let values: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
                let corner = values.and_then(|values| <[f64; 3]>::try_from(values).ok());
                let wrong = || format!("line {} has no three coordinates", number + 1);
                corners.push(corner.ok_or_else(wrong)?);
            }
            Some("endfacet") if !corners.len().is_multiple_of(3) => {
                return Err(format!("the facet before line {} has not three corners", number + 1));
            }
            Some("endsolid") => is_ended = true,
            _ => {}
        }
    }
    if !is_ended || !corners.len().is_multiple_of(3) {
        return Err("it is cut off: `endsolid` is missing".into());
    }
    Ok(corners.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect())
}

/// The material of a height field as binary STL, mm: each cell a column, columns of one height in
/// a row as one.
pub(crate) fn write(field: &HeightField) -> Vec<u8> {
    let mut out = Facets::new();
    let grid = field.grid();
    let x = |column: usize| grid.corner(0, column);
    let y = |row: usize| grid.corner(1, row);
    let level = |column: Option<usize>, row: Option<usize>| match (column, row) {
        (Some(column), Some(row)) if column < grid.columns && row < grid.rows => {
            let cell = row * grid.columns + column;
            (field.top(cell) > field.floor(cell)).then(|| (field.floor(cell), field.top(cell)))
        }
        _ => None,
    };
    for row in 0..grid.rows {
        let mut column = 0;
        while column < grid.columns {
            let Some((floor, top)) = level(Some(column), Some(row)) else {
                column += 1;
                continue;
            };
            let begin = column;
            while level(Some(column), Some(row)) == Some((floor, top)) {
                column += 1;
            }
            let ([west, east], [south, north]) = ([x(begin), x(column)], [y(row), y(row + 1)]);
            out.quad([
                [west, south, top],
                [east, south, top],
                [east, north, top],
                [west, north, top],
            ]);
            out.quad([
                [west, south, floor],
                [west, north, floor],
                [east, north, floor],
                [east, south, floor],
            ]);
            for (at, beside, is_west) in
                [(west, begin.checked_sub(1), true), (east, Some(column), false)]
            {
                let open = open_wall((floor, top), level(beside, Some(row)));
                for [low, high] in open {
                    let wall =
                        [[at, south, low], [at, south, high], [at, north, high], [at, north, low]];
                    out.wall(wall, is_west);
                }
            }
            for (at, beside, is_south) in
                [(south, row.checked_sub(1), true), (north, Some(row + 1), false)]
            {
                for step in begin..column {
                    for [low, high] in open_wall((floor, top), level(Some(step), beside)) {
                        let (from, to) = (x(step), x(step + 1));
                        let wall =
                            [[from, at, low], [to, at, low], [to, at, high], [from, at, high]];
                        out.wall(wall, is_south);
                    }
                }
            }
        }
    }
    out.finish()
}

/// The parts of a column's side, from one Z to another, that its neighbor leaves open.
fn open_wall((floor, top): (f64, f64), beside: Option<(f64, f64)>) -> Vec<[f64; 2]> {
    let Some((low, high)) = beside.filter(|(low, high)| *low < top && *high > floor) else {
        return vec![[floor, top]];
    };
    let parts = [[floor, low.min(top)], [high.max(floor), top]];
    parts.into_iter().filter(|[from, to]| from < to).collect()
}

/// Triangles of a binary file.
pub(crate) struct Facets(Vec<u8>);

impl Facets {
    pub fn new() -> Facets {
        let mut head = vec![0; HEAD];
        head[..7].copy_from_slice(b"filpost");
        Facets(head)
    }

    /// The file.
    pub fn finish(mut self) -> Vec<u8> {
        let count = ((self.0.len() - HEAD) / BINARY) as u32;
        self.0[HEAD - 4..HEAD].copy_from_slice(&count.to_le_bytes());
        self.0
    }

    /// A rectangle, its corners counterclockwise seen from outside.
    pub fn quad(&mut self, [a, b, c, d]: [[f64; 3]; 4]) {
        for corners in [[a, b, c], [a, c, d]] {
            // Programs take the normal from the corners.
            self.0.extend([0; 12]);
            for value in corners.iter().flatten() {
                self.0.extend((*value as f32).to_le_bytes());
            }
            self.0.extend([0; 2]);
        }
    }

    /// A wall whose corners are counterclockwise seen from one side, or from the other.
    fn wall(&mut self, [a, b, c, d]: [[f64; 3]; 4], as_given: bool) {
        self.quad(if as_given { [a, b, c, d] } else { [d, c, b, a] });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock::Stock;

    const FACET: &str = "facet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 10 0 1\nvertex 0 10 3\nendloop\nendfacet\n";

    #[test]
    fn ascii_files_are_read() {
        let mesh = Mesh::read("a.stl", format!("solid a\n{FACET}endsolid a\n").as_bytes())
            .expect("a mesh");
        assert_eq!(mesh.size(), Size { least: [0.0, 0.0, 1.0], most: [10.0, 10.0, 3.0] });
        assert_eq!(height(&mesh.triangles[0], [0.0, 5.0]), Some(2.0));
        assert_eq!(height(&mesh.triangles[0], [6.0, 6.0]), None);
    }

    #[test]
    fn wrong_files_are_refused() {
        let broken = [
            "",
            "solid a\nendsolid a\n",
            &format!("solid a\n{FACET}"),
            "<svg>",
            "solid\nvertex 1 2\nendsolid\n",
            "solid\nvertex 1 2 nan\nvertex 1 2 3\nvertex 1 2 4\nendsolid\n",
        ];
        for text in broken {
            let error = Mesh::read("a.stl", text.as_bytes()).expect_err(text);
            assert_eq!(error.code.name(), "E0964", "{text}");
        }
    }

    /// The volume inside of a closed surface of binary STL, mm³.
    fn volume(bytes: &[u8]) -> f64 {
        let six: f64 = binary(bytes)
            .expect("binary STL")
            .iter()
            .map(|[a, b, c]| {
                a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                    + a[2] * (b[0] * c[1] - b[1] * c[0])
            })
            .sum();
        six / 6.0
    }

    #[test]
    fn a_field_is_written_as_the_surface_around_it() {
        let stock =
            Stock::Cylinder { at: [3.0, 4.0, -5.0], diameter: 20.0, bore: 6.0, height: 8.0 };
        let mut field = HeightField::new(&stock, &stock.size(None).expect("a size"), Some(0.7))
            .expect("a field");
        for (cell, top) in field.tops.iter_mut().enumerate() {
            *top = top.min((cell % 7) as f32 - 3.0).max(-5.0);
        }
        let written = field.stl();
        assert!(
            (volume(&written) - field.volume()).abs() < 0.01,
            "{} {}",
            volume(&written),
            field.volume()
        );
        let mesh = Mesh::read("out.stl", &written).expect("an STL file");
        let stock = Stock::Mesh(mesh);
        let again = HeightField::new(&stock, &stock.size(None).expect("a size"), Some(0.7))
            .expect("a field");
        assert!((again.volume() - field.volume()).abs() / field.volume() < 0.1);
    }
}
