//! The library as its hosts use it: one file a concern.

mod embed;
mod granted;
mod refusals;
mod totals;
