//! Support for the test runners of this member.

pub mod audit;
pub mod back_check;
pub mod browser;
pub mod cases;
pub mod cl_file;
pub mod cl_path;
pub mod compare;
pub mod counts;
pub mod duel;
pub mod event_path;
pub mod examples;
pub mod feed;
pub mod five_axes;
pub mod klartext;
pub mod language;
pub mod lints;
pub mod motions;
pub mod mutants;
pub mod nc_cases;
pub mod nc_path;
pub mod oracle;
pub mod path;
pub mod picture;
pub mod plausible;
pub mod posting;
pub mod programs;
pub mod random;
pub mod rs274;
pub mod same_events;
pub mod sample;
pub mod sinumerik;
pub mod stock;
pub mod tip_program;
pub mod turning;
pub mod word_pages;
pub mod words;

/// The folder of the workspace.
pub fn root() -> &'static std::path::Path {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the workspace")
}
