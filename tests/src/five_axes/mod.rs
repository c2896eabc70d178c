//! Random programs of four and five axes, and what comes of them.

pub mod judge;
pub mod machines;
pub mod maker;
pub mod mixed;
pub mod numbers;
