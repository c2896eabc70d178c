//! What those who work on filpost run: `cargo xtask COMMAND`.

#[cfg(test)]
mod architecture;
mod code;
mod learn_judge;
mod metrics;
mod shadow;

use std::process::ExitCode;

use clap::Parser;

/// The commands.
#[derive(Parser)]
#[command(name = "cargo xtask", about = "Tools for work on filpost")]
enum Command {
    LearnJudge(learn_judge::Args),
    Metrics(metrics::Args),
    Shadow(shadow::Args),
}

fn main() -> ExitCode {
    let done = match Command::parse() {
        Command::LearnJudge(args) => learn_judge::command(&args),
        Command::Metrics(args) => metrics::command(&args),
        Command::Shadow(args) => shadow::command(&args),
    };
    done.unwrap_or_else(|said| {
        eprintln!("error: {said}");
        ExitCode::from(2)
    })
}
