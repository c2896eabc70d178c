//! `filpost posts`: the ready posts, and the options of one.

use std::io::{self, Write};

use filpost::ready::{READY, ReadyPost};
use filpost::{Error, PostOption, Program};
use serde_json::{Value, json};

use crate::args::{Chosen, PostsArgs};
use crate::{Status, output, setup};

/// Lists the ready posts, or the options of the post that is named.
///
/// # Errors
/// A post that is not there or can't be built; standard output that can't be written.
pub fn run(args: &PostsArgs) -> Result<Status, Error> {
    match &args.post {
        None if args.json => output::print(format!("{}\n", posts_json()?).as_bytes())?,
        None => {
            output::print_with(posts)?;
            output::say(
                "`filpost explain NAME` describes a post, `filpost posts NAME` lists its options; \
                 `-p NAME` uses it.",
            );
        }
        Some(name) => {
            let program = program(name)?;
            if args.json {
                let listed: Vec<Value> = program.options().iter().map(option_json).collect();
                output::print(format!("{}\n", Value::from(listed)).as_bytes())?;
            } else {
                output::print_with(|out| options(out, name, program.options()))?;
            }
        }
    }
    Ok(Status::Done)
}

/// The post of a name, with the FIL files that belong to it.
fn program(name: &str) -> Result<Program, Error> {
    let chosen = Chosen { post: Some(name.to_string()), ..Chosen::default() };
    match setup::named(&chosen, None)? {
        Some(named) => named.with_fil(None)?.builder.build(),
        None => Program::builder().ready(name).build(),
    }
}

/// The name in its machine.toml, which is the first line of each.
fn machine_name(post: &ReadyPost) -> &str {
    let name = post.machine.lines().find_map(|line| line.strip_prefix("name = "));
    name.unwrap_or(post.name).trim_matches('"')
}

fn posts(out: &mut dyn Write) -> io::Result<()> {
    READY.iter().try_for_each(|post| writeln!(out, "{:<20} {}", post.name, machine_name(post)))
}

fn posts_json() -> Result<Value, Error> {
    let listed = READY.iter().map(|post| {
        let program = Program::builder().ready(post.name).build()?;
        let options: Vec<Value> = program.options().iter().map(option_json).collect();
        Ok(json!({"name": post.name, "title": machine_name(post), "options": options}))
    });
    listed.collect()
}

fn options(out: &mut dyn Write, name: &str, all: &[PostOption]) -> io::Result<()> {
    if all.is_empty() {
        return writeln!(out, "{name} has no options");
    }
    let mut groups: Vec<&str> = Vec::new();
    for option in all {
        if !groups.contains(&option.group.as_str()) {
            groups.push(&option.group);
        }
    }
    for group in groups {
        writeln!(out, "{group}")?;
        for option in all.iter().filter(|option| option.group == group) {
            let value = option.value.to_string();
            writeln!(out, "  {:<22} {value:<12} {}", option.name, option.help)?;
            writeln!(out, "  {:<22} {:<12} {}", "", "", option.kind.values())?;
        }
    }
    Ok(())
}

fn option_json(option: &PostOption) -> Value {
    json!({
        "name": option.name,
        "type": option.kind.name(),
        "values": option.kind.values(),
        "default": option.default.to_string(),
        "value": option.value.to_string(),
        "group": option.group,
        "help": option.help,
    })
}
