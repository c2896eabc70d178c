//! Support for the test runners of this member.

pub mod cl_file;
pub mod cl_path;
pub mod compare;
pub mod duel;
pub mod examples;
pub mod feed;
pub mod language;
pub mod lints;
pub mod nc;
pub mod nc_path;
pub mod oracle;
pub mod path;
pub mod picture;
pub mod programs;
pub mod rs274;
pub mod runout;
pub mod sinumerik;
pub mod thread;

/// The folder of the workspace.
pub fn root() -> &'static std::path::Path {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the workspace")
}
