//! Simulation of screw machining, to prove programs of
//! `fil-scripts/papers/screw.fil` without the post: a job as data, its section, the
//! passes an NC program makes, and what they leave and cut.

pub mod drawing;
pub mod helix;
pub mod job;
pub mod mutate;
pub mod passes;
pub mod random;
pub mod section;
pub mod sweep;

pub use job::{Cutter, Job};
pub use section::{Section, Step};
