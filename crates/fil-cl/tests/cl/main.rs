//! CL files as they are read, written and refused: one file a concern, one program, so that
//! the crate is linked once.

mod adversary;
mod arcs;
mod convert;
mod dialects;
mod forms;
mod properties;
mod reading;
mod real_files;
mod refusing;
mod splines;
mod turned_tables;
