//! The generalized post.
//!
//! **Goal.** The generalized post: CL records to NC blocks.
//!
//! **Model.** [`Post`] takes records one after the other. The [`dispatch`]er hands the items of a
//! record to its post word ([`words`], one file a word), which makes [`operation`]s; the passes in
//! [`path`] bring motions to the machine's axes; the [`control`] writes blocks to its [`tape`],
//! and its [`control_state`] learns from each block what the control knows. All settings live in
//! the commons of [`fil_machine`].
//!
//! **Quick start.**
//!
//! ```
//! use fil_machine::locations::default_commons;
//!
//! let post = fil_post::Post::new(default_commons());
//! assert!(post.is_ok());
//! ```
//!
//! **Limits.** It knows no FIL and reads no file. What a word or a control can't do is an error
//! that names the CL line; after an error the post is not to be used.
//!
//! Inner crate of [filpost](https://crates.io/crates/filpost), without an API of its own: it may
//! change in any version, and all versions change together.

pub mod block;
pub mod cause;
pub mod control;
pub mod control_state;
pub mod dispatch;
mod drive;
pub mod editing;
pub mod errors;
pub mod euler;
pub mod items;
mod lane;
pub mod levels;
pub mod no_effect;
pub mod noted;
pub mod operation;
pub mod path;
pub mod post;
pub mod replaced;
pub mod site_word;
pub mod tape;
pub mod warnings;
pub mod words;

pub use cause::{Cause, FilLine, Origin, Stack, Stacks};
pub use drive::stands_before_change;
pub use noted::{BlockInfo, DueTo, Noted, WordInfo};
pub use post::{Post, WaitsForMotion};

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
