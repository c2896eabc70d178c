//! The language server as an editor talks to it: one file a concern.

mod half_typed;
mod preview;
mod protocol;
mod typed;
