//! The generalized post: CL records to NC blocks.
//!
//! [`Post`] takes records one after the other and writes finished blocks to its
//! [`tape::Tape`]. All its settings live in the [`commons::Commons`]; the table
//! of [`locations`] names them. What each post word does is in [`words`], one
//! file a word.

pub mod address;
pub mod axes;
pub mod block;
pub mod cause;
pub mod commons;
pub mod errors;
pub mod kinematics;
pub mod letters;
pub mod locations;
pub mod motion;
pub mod noted;
pub mod number;
pub mod post;
pub mod program;
pub mod runout;
pub mod settings;
pub mod state;
pub mod tape;
mod word_text;
pub mod words;

pub use cause::{Cause, FilLine, Origin, Stack, Stacks};
pub use commons::{Commons, Kind};
pub use noted::{BlockInfo, DueTo, Noted, WordInfo};
pub use post::Post;
