//! The command line of `filpost machine`.

use std::path::PathBuf;

use clap::{Args as ClapArgs, Subcommand};

use super::Chosen;

/// `filpost machine`
#[derive(Debug, ClapArgs)]
pub struct MachineArgs {
    /// What to do.
    #[command(subcommand)]
    pub command: MachineCommand,
}

/// The commands for machine settings.
#[derive(Debug, Subcommand)]
pub enum MachineCommand {
    /// Turn an option file into a machine.toml
    Import {
        /// The option file (uncx01.pNN)
        file: PathBuf,
        /// The ready post that the file is laid over; a lathe's option file needs one
        #[arg(short, long, value_name = "POST")]
        post: Option<String>,
        /// The machine.toml; standard output when left out or -
        #[arg(short, long, value_name = "OUT")]
        output: Option<PathBuf>,
        /// Encoding of the option file; guessed when left out
        #[arg(long, value_name = "LABEL")]
        encoding: Option<String>,
    },
    /// Show the settings that differ from the default machine; with a prefix or --all every
    /// setting with value, unit, meaning and evidence
    Show {
        #[command(flatten)]
        chosen: Chosen,
        /// Every setting, with value, unit, meaning and evidence
        #[arg(long)]
        all: bool,
        /// The settings as JSON, by their names: value, default, unit, choices, what the ready posts have
        #[arg(long)]
        json: bool,
        /// The chain of axes, from the part to the tool
        #[arg(long, conflicts_with_all = ["all", "prefix", "json"])]
        chain: bool,
        /// The chain of axes as an SVG picture
        #[arg(long, conflicts_with_all = ["all", "prefix", "json", "chain"])]
        chain_svg: bool,
        /// Only settings whose name starts with this; where neither -p nor -m is given it may be
        /// a machine, as diff takes it
        #[arg(value_name = "PREFIX|MACHINE")]
        prefix: Option<String>,
    },
    /// Show the settings in which two machines differ
    Diff {
        /// A ready post, a folder with machine.toml, a machine.toml or an option file
        first: PathBuf,
        /// What it is compared with
        second: PathBuf,
    },
    /// Print the JSON schema of machine.toml
    Schema,
}
