//! What those who work on filpost run: `cargo xtask COMMAND`.

#[cfg(test)]
mod architecture;
mod code;
mod learn_judge;
mod metrics;
mod new;
#[cfg(test)]
mod pages;
mod plausible;
#[cfg(test)]
mod public;
mod shadow;

use std::process::ExitCode;

use clap::Parser;

/// The commands.
#[derive(Parser)]
#[command(name = "cargo xtask", about = "Tools for work on filpost")]
enum Command {
    LearnJudge(learn_judge::Args),
    Metrics(metrics::Args),
    NewCode(new::CodeArgs),
    NewPost(new::PostArgs),
    NewWord(new::WordArgs),
    Plausible(plausible::Args),
    Shadow(shadow::Args),
}

fn main() -> ExitCode {
    let done = match Command::parse() {
        Command::LearnJudge(args) => learn_judge::command(&args),
        Command::Metrics(args) => metrics::command(&args),
        Command::NewCode(args) => new::code(&args),
        Command::NewPost(args) => new::post(&args),
        Command::NewWord(args) => new::word(&args),
        Command::Plausible(args) => plausible::command(&args),
        Command::Shadow(args) => shadow::command(&args),
    };
    done.unwrap_or_else(|said| {
        eprintln!("error: {said}");
        ExitCode::from(2)
    })
}
