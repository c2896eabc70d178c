//! Machine tools as settings, and the files that describe them.
//!
//! **Goal.** What a machine tool and its control are, as settings.
//!
//! **Model.** All settings live in the [`commons::Commons`] (INTCOM, RELCOM, DBLCOM); the table of
//! [`locations`] names and types them, each with its unit. [`address`] and [`axes`] are what they
//! say about the letters and axis words of a block, [`axis_chain`] is the chain of rotary axes.
//! [`files`] reads and writes `machine.toml` and option files.
//!
//! **Quick start.**
//!
//! ```
//! use fil_machine::{files::lay_over, locations::default_commons};
//!
//! let mut machine = default_commons();
//! let warnings = lay_over(&mut machine, "machine.toml", "[program]\nend_code = 2\n").unwrap();
//! assert!(warnings.is_empty());
//! ```
//!
//! **Limits.** The table says the unit of each setting: mm, degrees, mm/min, rpm, seconds. Nothing
//! here knows CL records, FIL or NC programs; settings that contradict each other are an error when
//! a file is read.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.

pub mod address;
pub mod axes;
pub mod axis_chain;
pub mod chain_drawing;
pub mod chains;
pub mod commons;
pub mod contradictions;
pub mod cycle_kind;
pub mod digits;
pub mod effects;
pub mod errors;
pub mod files;
mod frame_rules;
mod full_turn;
pub mod function_code;
pub mod functions;
mod in_force;
pub mod input_matrix;
pub mod letter;
pub mod locations;
pub mod mill_turn;
pub mod modes;
pub mod motion_rules;
pub mod number;
pub mod numbering;
pub mod osp_lengths;
pub mod post_options;
pub mod reads;
pub mod renamed;
pub mod rotary_feed_rules;
mod rotation;
pub mod rounding;
pub mod setting;
pub mod simulate_settings;
pub mod stored;
pub mod tables;
pub mod tape_style;
pub mod travel_rules;
pub mod user_blocks;
mod value_unit;
pub mod zones;

pub use commons::{Commons, Kind};
pub use function_code::FunctionCode;
pub use in_force::{in_force, in_force_at};
pub use letter::{Letter, letters};
pub use modes::{FeedMode, Plane, Unit};

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
