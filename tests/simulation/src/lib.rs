//! Simulations that judge NC programs by what they cut, and nothing of the post but
//! what it printed. A member of its own, so that these loops are optimized in test
//! builds and the test runners are not.

pub mod embos;
pub mod runout;
pub mod screw;
pub mod thread;
