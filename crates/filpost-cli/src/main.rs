//! The filpost command: CL file and FIL macros in, NC program out.
//!
//! **Goal.** NC programs for a shop, made, checked and kept by commands.
//!
//! **Model.** A command reads files, calls the crate [filpost](https://docs.rs/filpost) and prints what
//! it gives back; a program of your own takes that crate and not this one.
//!
//! **Quick start.** `filpost post part.ncl -p haas-mill -o part.nc`, then
//! `filpost verify part.ncl part.nc -p haas-mill`; `filpost help` names the others.
//!
//! **Limits.** On any error there is no NC file. Exit status: 0 done, 1 errors in the input or the post,
//! 2 wrong usage, 3 internal fault.

mod args;
mod audit;
mod batch;
mod check;
mod cl;
mod convert;
mod dialects;
mod diff;
mod each_tool;
mod errors;
mod explain;
mod fmt;
mod job;
mod learn;
mod machine;
mod manual;
mod new;
mod output;
mod plot;
mod post;
mod posts;
mod profile;
mod ready_posts;
mod refused;
mod render;
mod sarif;
mod setup;
mod simulate;
mod studio;
mod summary;
mod test;
mod trace;
mod verify;
mod version;
mod watch;

use std::io::{ErrorKind, Write};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use filpost::{Error, files};

use args::{Args, Command};

/// How a command ended that was not stopped by an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Status {
    /// Done.
    Done = 0,
    /// What was looked at is wrong; it has been reported.
    Failed = 1,
    /// The command was not used as it is meant; it has been reported.
    Usage = 2,
    /// An internal fault; it has been reported.
    Fault = 3,
}

/// Exit status of a command that was told to stop.
const STOPPED: i32 = 130;

fn main() -> ExitCode {
    std::panic::set_hook(Box::new(report_fault));
    // Without a handler a stopped command would leave files in the making behind.
    let _ = ctrlc::set_handler(|| {
        if learn::end_search() {
            return;
        }
        files::give_up();
        std::process::exit(STOPPED);
    });
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(asked) => return told(&asked),
    };
    let status = match catch_unwind(AssertUnwindSafe(|| run(&args.command))) {
        Ok(Ok(status)) => status as u8,
        Ok(Err(error)) => {
            refused::tell(&error);
            Status::Failed as u8
        }
        Err(_) => Status::Fault as u8,
    };
    ExitCode::from(status)
}

/// Tells what a command line without a command to run asks for, or what is wrong with it.
fn told(asked: &clap::Error) -> ExitCode {
    let said = asked.print().and_then(|()| std::io::stdout().flush());
    let status = match said.map_err(|error| error.kind()) {
        Ok(()) | Err(ErrorKind::BrokenPipe) => asked.exit_code() as u8,
        Err(_) => Status::Failed as u8,
    };
    ExitCode::from(status)
}

fn run(command: &Command) -> Result<Status, Error> {
    match command {
        Command::Post(args) => post::run(args),
        Command::Check(args) => check::run(args),
        Command::Fmt(args) => fmt::run(args),
        Command::Cl(args) => cl::run(args),
        Command::Diff(args) => diff::run(args),
        Command::Verify(args) => verify::run(args),
        Command::Plot(args) => plot::run(args),
        Command::Simulate(args) => simulate::run(args),
        Command::Test(args) => test::run(args),
        Command::Trace(args) => trace::run(args),
        Command::Explain(args) => explain::run(&args.subject),
        Command::Posts(args) => ready_posts::run(args),
        Command::Machine(args) => machine::run(args),
        Command::Learn(args) => learn::run(args),
        Command::Watch(args) => watch::run(args),
        Command::Lsp => Ok(served(filpost_lsp::serve_stdio())),
        Command::Dap => Ok(served(filpost_dap::serve_stdio())),
        Command::New(args) => new::run(args),
        Command::Studio(args) => studio::run(args),
        Command::Man { command } => manual::run(command.as_deref()),
        Command::Completions { shell } => {
            let mut text = Vec::new();
            clap_complete::generate(*shell, &mut Args::command(), "filpost", &mut text);
            output::print(&text)?;
            Ok(Status::Done)
        }
    }
}

/// How a server ended.
fn served(ended: Result<(), String>) -> Status {
    match ended {
        Ok(()) => Status::Done,
        Err(message) => {
            output::say(&message);
            Status::Failed
        }
    }
}

/// One line about a fault of filpost itself.
fn report_fault(fault: &PanicHookInfo<'_>) {
    let payload = fault.payload();
    let message = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no message");
    let place = fault.location().map(ToString::to_string).unwrap_or_default();
    output::say(&format!(
        "internal fault of filpost at {place}: {message}\n\
         No NC program was written. Please report this with the files that lead to it."
    ));
}
