//! The command as its users meet it: outputs, exit statuses, files left behind.

mod batch;
mod check;
mod cl;
mod explain;
mod fmt;
mod machine;
mod messages;
mod output;
mod post;
mod support;
mod test;
mod trace;
