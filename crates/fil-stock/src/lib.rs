//! Material removal by an NC program.
//!
//! **Goal.** What an NC program cuts out of a piece of stock: rapid traverse through stock, a
//! holder in stock, cutting with a stopped spindle, cuts below a part.
//!
//! **Model.** [`simulate`] moves the tools of a [`Program`] through a [`HeightField`], on a lathe
//! through a [`Profile`], and gives a [`Report`] of findings and volumes. It reads programs with `fil-nc` and knows nothing of CL
//! files or of the post.
//!
//! **Quick start.**
//!
//! ```
//! use std::collections::BTreeMap;
//!
//! use fil_nc::{dialect::Dialect, forward::Forward};
//! use fil_stock::{Job, Offsets, Program, Stock, Tool, simulate};
//!
//! let text = b"G21 G90 G94 G17\nT1 M6\nG0 X-10. Y10.\nG43 Z20. H1\nS900 M3\nG0 Z-2.\nG1 X60. F200.\nG0 Z20.\nM30\n";
//! let commons = fil_machine::locations::default_commons();
//! let (dialect, forward) = (Dialect::new(&commons)?, Forward::from_commons(&commons)?);
//! let program = Program { text, name: "slot.nc", dialect: &dialect, forward: &forward };
//! let tools = BTreeMap::from([(1, Tool::read("D10")?)]);
//! let stock = Stock::read("box 50x20x10")?.expect("a box");
//! let (levels, offsets) = (fil_diag::Levels::default(), Offsets::new());
//! let job = Job { stock: &stock, tools: &tools, part: None, part_tolerance: 0.05, grid: Some(0.5), offsets: &offsets, levels: &levels };
//! let done = simulate(&program, &job)?;
//! assert!((done.report.total() - 50.0 * 10.0 * 2.0).abs() < 1e-3);
//! assert!(done.report.findings.is_empty());
//! # Ok::<(), Box<fil_diag::Diag>>(())
//! ```
//!
//! **Limits.** Lengths are mm in the coordinate system of the part, volumes mm³, whatever the unit
//! of the program. Three axes: a program with a tilted tool is refused, and undercuts have no
//! place in a height field. On a lathe inserts and drills on the spindle axis cut, live tools do
//! not. At most [`MAX_CELLS`] cells.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.
#![deny(missing_docs)]

pub mod errors;
mod field;
mod finding;
mod mesh;
mod removal;
mod simulation;
mod stock;
mod survey;
mod tool;
mod turning;
mod units;
mod way;

pub use field::{Grid, HeightField, MAX_CELLS};
pub use finding::{Finding, Report, Source};
pub use mesh::{Mesh, Triangle};
pub use simulation::{Job, Left, Offsets, Program, Simulated, simulate};
pub use stock::{Size, Stock};
pub use tool::{Body, Cylinder, Shape, Tool, Tools, from_cutter, from_tool_data};
pub use turning::{Insert, Profile};
pub use units::{length, place};
pub use way::Way;

/// The example of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
