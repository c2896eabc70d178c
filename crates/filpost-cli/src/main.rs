//! The filpost command.
fn main() {}
