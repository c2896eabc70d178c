//! Material removal: what an NC program cuts out of a piece of stock.
//!
//! [`simulate`] moves the tools of a program through a [`HeightField`] and reports rapid traverse
//! through stock, a holder in stock, cutting with a stopped spindle and cuts below a part. It reads
//! programs with `fil-nc` and knows nothing of CL files or of the post. Lengths are mm, in the
//! coordinate system of the part.
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
mod units;
mod way;

pub use field::{Grid, HeightField, MAX_CELLS};
pub use finding::{Finding, Report, Source};
pub use mesh::{Mesh, Triangle};
pub use simulation::{Job, Offsets, Program, Simulated, simulate};
pub use stock::{Size, Stock};
pub use tool::{Cylinder, Shape, Tool, Tools, from_cutter, from_tool_data};
pub use units::{length, place};
pub use way::Way;

/// The example of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
