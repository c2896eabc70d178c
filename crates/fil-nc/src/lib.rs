//! NC programs read back: text to words, words to motions.
//!
//! [`text`] cuts a program into blocks of words, whatever control it is for;
//! [`diff`] compares two programs;
//! [`motion`] is what a program does, as plain data. Nothing here shares a line
//! with the post's output side: a fault of the writer must not hide itself in
//! the reader.

pub mod diff;
pub mod errors;
pub mod motion;
pub mod text;
