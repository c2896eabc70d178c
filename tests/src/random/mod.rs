//! Random CL programs for mills and a lathe, judged from outside.
//!
//! [`make`] draws statements from a seed. [`model`] turns them into CL text and
//! into what they ask of the machine, from its own idea of what CL means; it
//! knows nothing of the post. The post makes a program of the text, LinuxCNC's
//! interpreter runs it ([`machine`]), and [`compare`] puts its steps and the
//! modes in force beside the expected ones. A program whose blocks may be
//! skipped is run twice, with those blocks and without them. Programs for a lathe come
//! from [`lathe_make`] and are run by [`lathe`], as LinuxCNC speaks another lathe.

pub mod compare;
mod compare_arc;
pub mod expected;
pub mod features;
mod geometry;
pub mod lathe;
pub mod lathe_make;
pub mod machine;
pub mod make;
mod make_sections;
pub mod model;
mod model_cycle;
mod model_modes;
mod model_motion;
mod senses;
pub mod setup;
pub mod shrink;
pub mod statement;
pub mod verdict;
