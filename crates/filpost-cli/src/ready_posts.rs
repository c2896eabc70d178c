//! `filpost posts`

use filpost::Error;
use filpost::ready::{READY, ReadyPost};

use crate::{Status, output};

/// Lists the ready posts, each with the name of its machine.
///
/// # Errors
/// Standard output that can't be written.
pub fn run() -> Result<Status, Error> {
    output::print_with(|out| {
        READY.iter().try_for_each(|post| writeln!(out, "{:<20} {}", post.name, machine_name(post)))
    })?;
    output::say("`filpost explain NAME` describes a post; `-p NAME` uses it.");
    Ok(Status::Done)
}

/// The name in its machine.toml, which is the first line of each.
fn machine_name(post: &ReadyPost) -> &str {
    let name = post.machine.lines().find_map(|line| line.strip_prefix("name = "));
    name.unwrap_or(post.name).trim_matches('"')
}
