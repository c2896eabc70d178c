//! `filpost machine show`

use std::io::{self, Write};
use std::path::Path;

use filpost::effects::Rule;
use filpost::locations::{LIMITS_CHECK, Location, TABLE, default_commons};
use filpost::simulate_settings::SimulateSetting;
use filpost::{Commons, Diag, Error, Kind, Levels, Program, explain, ready, stored, user_blocks};

use super::{LETTERS, address, diff, json};
use crate::args::Chosen;
use crate::errors::CommandCode;
use crate::{output, setup, summary};

/// Shows every setting whose name starts with `prefix`; without one, what the machine
/// sets otherwise than the default machine. As text, or as JSON.
///
/// # Errors
/// Files that can't be read; wrong settings; a prefix that no setting has.
pub fn run(chosen: &Chosen, prefix: Option<&str>, all: bool, as_json: bool) -> Result<(), Error> {
    let is_chosen = chosen.post.is_some() || chosen.machine.is_some();
    let machine = prefix.filter(|name| !is_chosen && is_machine(name));
    if let Some(name) = machine {
        let (set, option) = (chosen.set.clone(), chosen.option.clone());
        return run(&Chosen { set, option, ..diff::chosen(Path::new(name)) }, None, all, as_json);
    }
    let program = program(chosen)?;
    if let Some(prefix) = prefix.filter(|prefix| !begins_a_setting(prefix)) {
        let message = format!("no setting begins with `{prefix}`");
        return Err(Error::Setup(vec![Diag::new(CommandCode::NoSetting, message)]));
    }
    let is_every = all || prefix.is_some();
    if as_json {
        let (commons, default) = (program.commons(), default_commons());
        let only = |row: &Location| is_every || json::differs(row, commons, &default);
        let settings = json::settings(commons, prefix.unwrap_or(""), only);
        return output::print(format!("{settings:#}\n").as_bytes());
    }
    match prefix {
        None if !all => output::print_with(|out| differences(out, program.commons())),
        _ => output::print_with(|out| every(out, program.commons(), prefix.unwrap_or(""))),
    }
}

/// A file, a folder or a ready post, and no setting.
fn is_machine(name: &str) -> bool {
    !begins_a_setting(name) && (Path::new(name).exists() || ready::find(name).is_some())
}

fn begins_a_setting(prefix: &str) -> bool {
    "address".starts_with(prefix) || TABLE.iter().any(|row| row.name.starts_with(prefix))
}

/// Draws the chain of axes.
///
/// # Errors
/// As [`run`].
pub fn chain(
    chosen: &Chosen,
    draw: fn(&Commons) -> Result<String, Box<Diag>>,
) -> Result<(), Error> {
    let program = program(chosen)?;
    let drawing = draw(program.commons()).map_err(|diag| Error::Setup(vec![*diag]))?;
    output::print(drawing.as_bytes())
}

/// The machine that is chosen; the generic mill where none is.
fn program(chosen: &Chosen) -> Result<Program, Error> {
    let builder = match setup::named(chosen, None)? {
        Some(named) => named.builder,
        None => {
            let generic = Program::builder().generic(ready::GENERIC_MILL);
            let set = chosen.set.iter().fold(generic, |builder, setting| builder.set(setting));
            let given = chosen.option.iter();
            given.fold(set, |builder, (name, value)| builder.option(name, value))
        }
    };
    let program = builder.build()?;
    summary::warnings(program.warnings());
    Ok(program)
}

fn every(out: &mut dyn Write, commons: &Commons, prefix: &str) -> io::Result<()> {
    for row in TABLE.iter().filter(|row| row.name.starts_with(prefix)) {
        let value = explain::shown_value(row, commons);
        let used = if row.used { "used" } else { "not used" };
        writeln!(
            out,
            "{:<28} {value}\n{:>28} {} {}, {}, {}, {used}: {}",
            row.name,
            "",
            row.kind.name(),
            row.number,
            row.unit,
            row.evidence,
            row.meaning
        )?;
    }
    if prefix.is_empty() || "address".starts_with(prefix) {
        for letter in LETTERS {
            writeln!(out, "{}", address(commons, letter))?;
        }
    }
    Ok(())
}

/// What acts and differs from the default machine, in words; then what is set and does
/// not act.
fn differences(out: &mut dyn Write, commons: &Commons) -> io::Result<()> {
    let default = default_commons();
    let value = |at: &Commons, kind: Kind, number: u32| at.get(kind, number).ok();
    let differs = |kind, number| value(commons, kind, number) != value(&default, kind, number);
    let mut lines = Vec::new();
    let mut idle = Vec::new();
    for row in TABLE.iter().filter(|row| differs(row.kind, row.number.into())) {
        if row.kind == Kind::Int && user_blocks::list_of(row.number).is_some() {
            continue;
        }
        if !row.used || (is_travel(row) && !commons.read(LIMITS_CHECK)) {
            idle.push((row.kind, u32::from(row.number)));
            continue;
        }
        let [value, before] = [commons, &default].map(|at| explain::shown_value(row, at));
        lines.push(format!(
            "{:<28} {value} (default {before})\n{:>28} {}",
            row.name, "", row.meaning
        ));
    }
    for letter in LETTERS {
        let [value, before] = [commons, &default].map(|at| address(at, letter));
        if value != before {
            lines.push(value);
        }
    }
    lines.extend(texts(commons));
    lines.extend(levels(commons.levels()));
    lines.extend(options(commons));
    lines.extend(commons.effects().rules().iter().map(effect));
    lines.extend(commons.simulate().all().iter().map(simulate));
    if lines.is_empty() {
        lines.push("every setting that has an effect is that of the default machine".into());
    }
    lines.iter().try_for_each(|line| writeln!(out, "{line}"))?;
    if !idle.is_empty() {
        let names: Vec<String> = idle.iter().map(|at| stored::title(at.0, at.1)).collect();
        writeln!(out, "\nset, and without effect: {}", names.join(", "))?;
    }
    Ok(())
}

/// A limit of travel, which acts where `limits.check` is on.
fn is_travel(row: &Location) -> bool {
    row.name.starts_with("limits.") && (row.name.ends_with("_min") || row.name.ends_with("_max"))
}

/// Values of the options of the post.
fn options(commons: &Commons) -> impl Iterator<Item = String> {
    commons.options().all().iter().map(|option| {
        let given = if option.is_given { " (given)" } else { "" };
        format!("{:<28} {}{given}", format!("options.{}", option.name), option.value)
    })
}

/// Levels of findings.
fn levels(levels: &Levels) -> Vec<String> {
    let line = |name: &str, value: &str| format!("{:<28} {value}", format!("levels.{name}"));
    let profile = levels.chosen_profile().map(|profile| line("profile", profile.name()));
    let all = levels.all().map(|level| line("all", level.name()));
    let codes = filpost::all_codes();
    let of_codes = levels.of_codes().filter_map(|(number, level)| {
        let code = codes.iter().find(|code| code.number == number)?;
        Some(line(&code.name(), level.name()))
    });
    profile.into_iter().chain(all).chain(of_codes).collect()
}

/// What a block of the shop does.
fn effect(rule: &Rule) -> String {
    format!("{:<28} {}", format!("effects.{:?}", rule.said), rule.effect.name())
}

/// What `filpost simulate` cuts.
fn simulate(setting: &SimulateSetting) -> String {
    format!("{:<28} {}", format!("simulate.{}", setting.key), setting.value)
}

/// The user's blocks.
fn texts(commons: &Commons) -> Vec<String> {
    let lists = user_blocks::LISTS.into_iter().map(|(name, list)| (name, list.read(commons)));
    let said = lists.filter(|(_, blocks)| !blocks.is_empty());
    said.map(|(name, blocks)| format!("{name:<28} {blocks:?}")).collect()
}
