//! Support for the test runners of this member.

pub mod cl_path;
pub mod compare;
pub mod nc_path;
pub mod path;
pub mod rs274;
