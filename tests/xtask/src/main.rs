//! What those who work on filpost run: `cargo xtask COMMAND`.

mod shadow;

use std::process::ExitCode;

use clap::Parser;

/// The commands.
#[derive(Parser)]
#[command(name = "cargo xtask", about = "Tools for work on filpost")]
enum Command {
    Shadow(shadow::Args),
}

fn main() -> ExitCode {
    let done = match Command::parse() {
        Command::Shadow(args) => shadow::command(&args),
    };
    done.unwrap_or_else(|said| {
        eprintln!("error: {said}");
        ExitCode::from(2)
    })
}
