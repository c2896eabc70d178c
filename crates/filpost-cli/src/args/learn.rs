//! The arguments of `filpost learn`.

use std::path::PathBuf;

use clap::Args as ClapArgs;

use super::{Chosen, Reading, Units, names};

/// `filpost learn`
#[derive(Debug, ClapArgs)]
pub struct LearnArgs {
    /// Pairs of files: a CL file and its proven NC program, then the next two
    #[arg(required = true, num_args = 2.., value_name = "CL NC")]
    pub pairs: Vec<PathBuf>,
    /// The folder to make: an own post with its cases and the report; only the report is printed
    /// when left out
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Begin from this ready post (may be given again); from all of them when left out
    #[arg(long, value_name = "POST", value_parser = names::post(), hide_possible_values = true, conflicts_with_all = ["post", "machine"])]
    pub base: Vec<String>,
    /// Explain an edit: find the settings of the post of -p or -m with which the program comes out
    /// as it is in NC
    #[arg(long, conflicts_with = "check")]
    pub edit: bool,
    /// Check a learned post with further pairs, and list the undecided settings that they decide
    #[arg(long, value_name = "DIR", conflicts_with_all = ["output", "base", "keep", "post", "machine"])]
    pub check: Option<String>,
    #[command(flatten)]
    pub chosen: Chosen,
    /// A FIL file that belongs to the post (may be given again)
    #[arg(short, long, value_name = "FILE")]
    pub fil: Vec<PathBuf>,
    /// Keep a setting, or a group of settings such as `cycle.`, as the base has it (may be given again)
    #[arg(long, value_name = "KEY")]
    pub keep: Vec<String>,
    #[command(flatten)]
    pub reading: Reading,
    #[command(flatten)]
    pub units: Units,
    /// Number of threads; all cores when left out
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Write the report as JSON to standard output
    #[arg(long)]
    pub json: bool,
}
