//! Numbers of the letters post words write (A = 1 … Z = 26).

use crate::address::letter;

/// Cutter radius or diameter offset.
pub const D: u8 = letter(b'D');
/// Feed.
pub const F: u8 = letter(b'F');
/// Preparatory function.
pub const G: u8 = letter(b'G');
/// Tool length offset.
pub const H: u8 = letter(b'H');
/// Arc center in X.
pub const I: u8 = letter(b'I');
/// Arc center in Y.
pub const J: u8 = letter(b'J');
/// Arc center in Z.
pub const K: u8 = letter(b'K');
/// Auxiliary function.
pub const M: u8 = letter(b'M');
/// Radius, and the R level of a canned cycle.
pub const R: u8 = letter(b'R');
/// Spindle speed.
pub const S: u8 = letter(b'S');
/// Tool.
pub const T: u8 = letter(b'T');
