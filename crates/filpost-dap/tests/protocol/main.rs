//! The debugger asked as a client asks it: each kind of breakpoint, each kind of step, what is
//! shown and what is set.

mod client;
mod stopping;
mod values;
