//! NC programs read back: text to words, words to motions.
//!
//! [`text`] cuts a program into blocks of words, whatever control it is for;
//! [`diff`] compares two programs;
//! [`plot`] draws a path;
//! [`motion`] is what a program does, as plain data. Nothing here shares a line
//! with the post's output side: a fault of the writer must not hide itself in
//! the reader.

pub mod bend;
pub mod decimals;
pub mod dialect;
pub mod diff;
pub mod errors;
pub mod events;
pub mod forward;
pub mod interpret;
pub mod motion;
pub mod plot;
pub mod source;
pub mod text;
pub mod verify;

/// The examples of the README, run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
