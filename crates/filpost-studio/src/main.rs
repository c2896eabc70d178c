//! The program `filpost-studio`, which `filpost studio` starts.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use filpost_studio::{Studio, browser};

/// Makes, runs and judges a post in one page of the browser.
///
/// The page works on this computer only and opens only the files in the folder. It ends with Ctrl-C,
/// or when you close its page.
#[derive(Debug, Parser)]
#[command(name = "filpost studio", bin_name = "filpost studio", version, max_term_width = 100)]
struct Args {
    /// Folder of the post: machine.toml, post.fil, cases; it is made if it is not there
    #[arg(default_value = ".")]
    folder: PathBuf,
    /// Port to listen on; 0 takes any that is free
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// Print the address and open no browser
    #[arg(long)]
    no_open: bool,
}

fn main() -> ExitCode {
    let args = Args::parse();
    let studio = match Studio::open(&args.folder, args.port) {
        Ok(studio) => studio,
        Err(error) => {
            for diag in error.diags() {
                eprintln!("{}: {}", diag.code.name(), diag.message);
            }
            return ExitCode::FAILURE;
        }
    };
    println!("{}", studio.address());
    if !args.no_open && !browser::open(&studio.address()) {
        eprintln!("No browser could be started: open the address above.");
    }
    eprintln!("It ends with Ctrl-C, or when its page is closed.");
    studio.serve();
    ExitCode::SUCCESS
}
