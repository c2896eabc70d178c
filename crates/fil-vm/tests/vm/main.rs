//! FIL programs run on a host that writes down what it is asked.

mod bench;
mod bytecode;
mod codes;
mod control;
mod macros;
mod names;
mod noise;
mod papers;
mod postf;
mod posts;
mod sections;
mod values;
