//! The command as its users meet it: outputs, exit statuses, files left behind.

mod allow;
mod batch;
mod cases;
mod check;
mod cl;
mod codes;
mod coverage;
mod dap;
mod diff;
mod each_tool;
mod editors;
mod encodings;
mod explain;
mod fmt;
mod hosts;
#[cfg(unix)]
mod install;
mod learn;
mod listing;
mod machine;
mod making_cases;
mod messages;
#[cfg(target_os = "linux")]
mod mishaps;
mod new;
mod output;
mod post;
mod shards;
mod simulate;
mod studio;
mod support;
mod test;
mod trace;
mod verify;
mod watch;
