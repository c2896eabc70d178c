//! Stock as a height field: a column of material over each cell of a grid.

use fil_diag::Diag;

use crate::errors::StockCode;
use crate::mesh::{self, Mesh};
use crate::stock::{Size, Stock};

/// Most cells of a grid.
pub const MAX_CELLS: usize = 40_000_000;

/// Cells along the longer side of stock where no size of a cell is given.
const CELLS_ALONG: f64 = 400.0;

/// Least size of a cell where none is given, mm.
const LEAST_STEP: f64 = 0.05;

/// A grid of equal cells in X and Y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The corner with the least X and Y, mm.
    pub origin: [f64; 2],
    /// Size of a cell in X and Y, mm.
    pub step: [f64; 2],
    /// Cells along X.
    pub columns: usize,
    /// Cells along Y.
    pub rows: usize,
}

impl Grid {
    /// A grid that covers a box, with cells of about a size or less, mm.
    ///
    /// # Errors
    /// E0963
    pub(crate) fn over(size: &Size, step: Option<f64>) -> Result<Grid, Box<Diag>> {
        let sides = [0, 1].map(|axis| size.most[axis] - size.least[axis]);
        let step = step.unwrap_or((sides[0].max(sides[1]) / CELLS_ALONG).max(LEAST_STEP));
        let counts = sides.map(|side| (side / step - 1e-9).ceil().max(1.0));
        if counts[0] * counts[1] > MAX_CELLS as f64 {
            let [x, y] = counts;
            return StockCode::TooFine.err(format!("cells of {step} mm are {x} x {y}"));
        }
        let [columns, rows] = counts.map(|count| count as usize);
        let step = [sides[0] / counts[0], sides[1] / counts[1]];
        Ok(Grid { origin: [size.least[0], size.least[1]], step, columns, rows })
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// Area of a cell, mm².
    pub fn area(&self) -> f64 {
        self.step[0] * self.step[1]
    }

    /// Where a line of the grid lies, mm.
    pub(crate) fn corner(&self, axis: usize, index: usize) -> f64 {
        self.origin[axis] + self.step[axis] * index as f64
    }

    /// Center of a cell, mm.
    pub fn center(&self, column: usize, row: usize) -> [f64; 2] {
        let at =
            |axis: usize, index: usize| self.origin[axis] + self.step[axis] * (index as f64 + 0.5);
        [at(0, column), at(1, row)]
    }

    /// Columns (axis 0) or rows (axis 1) whose centers lie between two values.
    pub(crate) fn range(&self, axis: usize, [low, high]: [f64; 2]) -> std::ops::Range<usize> {
        let count = if axis == 0 { self.columns } else { self.rows };
        let index = |value: f64| (value - self.origin[axis]) / self.step[axis] - 0.5;
        // Casts of floats end at the bounds of the type. One more at each side covers rounding.
        let first = (index(low).ceil() - 1.0).max(0.0) as usize;
        let end = ((index(high).floor() + 2.0).max(0.0) as usize).min(count);
        first.min(end)..end
    }
}

/// Material by its height: from a floor up to a top over each cell. There is none where both are
/// equal. The surface is exact over the center of each cell.
#[derive(Clone, Debug)]
pub struct HeightField {
    grid: Grid,
    pub(crate) tops: Vec<f32>,
    floor: Floor,
}

/// The lower side of stock.
#[derive(Clone, Debug)]
enum Floor {
    /// One Z.
    Flat(f32),
    /// A Z for each cell.
    Cells(Vec<f32>),
}

impl HeightField {
    /// Stock before the first cut; `size` is the box around it.
    ///
    /// # Errors
    /// E0963
    pub(crate) fn new(stock: &Stock, size: &Size, step: Option<f64>) -> Result<Self, Box<Diag>> {
        let grid = Grid::over(size, step)?;
        let [least, most] = [size.least[2] as f32, size.most[2] as f32];
        let (tops, floor) = match stock {
            Stock::Box(_) | Stock::Auto => (vec![most; grid.cells()], Floor::Flat(least)),
            Stock::Cylinder { at, diameter, bore, .. } => {
                let top = |[x, y]: [f64; 2]| {
                    let radius = libm::hypot(x - at[0], y - at[1]);
                    let is_in = radius <= diameter / 2.0 && radius >= bore / 2.0;
                    if is_in { most } else { least }
                };
                (cells(&grid).map(top).collect(), Floor::Flat(least))
            }
            Stock::Mesh(mesh) => {
                let (tops, floors) = mesh.heights(&grid);
                let has = |top: &f32| top.is_finite();
                let tops_or = tops.iter().map(|top| if has(top) { *top } else { least }).collect();
                let floors = floors.iter().map(|floor| if has(floor) { *floor } else { least });
                (tops_or, Floor::Cells(floors.collect()))
            }
        };
        Ok(HeightField { grid, tops, floor })
    }

    /// Its grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Tops of all columns, mm: rows along X, the row with the least Y first.
    pub fn tops(&self) -> &[f32] {
        &self.tops
    }

    /// Top of a column, mm.
    pub(crate) fn top(&self, cell: usize) -> f64 {
        f64::from(self.tops[cell])
    }

    /// Lower side of a column, mm.
    pub(crate) fn floor(&self, cell: usize) -> f64 {
        f64::from(match &self.floor {
            Floor::Flat(floor) => *floor,
            Floor::Cells(floors) => floors[cell],
        })
    }

    /// The lowest Z of the material, mm.
    pub fn lowest(&self) -> f64 {
        (0..self.grid.cells()).map(|cell| self.floor(cell)).fold(f64::INFINITY, f64::min)
    }

    /// Volume of the material, mm³.
    pub fn volume(&self) -> f64 {
        let heights = (0..self.grid.cells()).map(|cell| self.top(cell) - self.floor(cell));
        heights.sum::<f64>() * self.grid.area()
    }

    /// The greatest Z of a part over each cell; minus infinity where it has none.
    pub(crate) fn part(&self, part: &Mesh) -> Vec<f32> {
        part.heights(&self.grid).0
    }

    /// The material as binary STL, mm.
    pub fn stl(&self) -> Vec<u8> {
        mesh::write(self)
    }
}

/// Centers of all cells, in their order.
fn cells(grid: &Grid) -> impl Iterator<Item = [f64; 2]> + '_ {
    (0..grid.rows)
        .flat_map(move |row| (0..grid.columns).map(move |column| grid.center(column, row)))
}
