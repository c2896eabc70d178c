//! Random programs of lathes and mill-turn machines.

pub mod machines;
pub mod mixed;
pub mod part;
