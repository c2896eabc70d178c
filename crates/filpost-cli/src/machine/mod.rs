//! `filpost machine`

mod diff;
mod json;
mod schema;
mod show;

use std::path::Path;

use filpost::{Commons, Error, Kind, Program, chain_drawing, explain, files, settings};
use serde_json::Value;

use crate::args::{MachineArgs, MachineCommand};
use crate::output::{self, Target};
use crate::{Status, summary};

/// Letters of the address table.
const LETTERS: std::ops::RangeInclusive<u8> = b'A'..=b'Z';

/// INTCOM offsets of the format and the specification of a tape position.
const FORMAT: u32 = 105;
const SPECIFICATION: u32 = 158;

/// Tape position of a letter the machine lacks.
const NOT_USED: f64 = 53.0;

/// Imports or shows machine settings.
///
/// # Errors
/// Files that can't be read or written; wrong settings.
pub fn run(args: &MachineArgs) -> Result<Status, Error> {
    match &args.command {
        MachineCommand::Import { file, post, output, encoding } => {
            import(file, post.as_deref(), output.as_deref(), encoding.as_deref())?;
        }
        MachineCommand::Show { chosen, chain: true, .. } => {
            show::chain(chosen, chain_drawing::text)?;
        }
        MachineCommand::Show { chosen, chain_svg: true, .. } => {
            show::chain(chosen, chain_drawing::svg)?;
        }
        MachineCommand::Show { chosen, all, json, prefix, .. } => {
            show::run(chosen, prefix.as_deref(), *all, *json)?;
        }
        MachineCommand::Diff { first, second } => return diff::run(first, second),
        MachineCommand::Schema => output::print(format!("{:#}\n", schema::schema()).as_bytes())?,
    }
    Ok(Status::Done)
}

fn import(
    file: &Path,
    post: Option<&str>,
    output: Option<&Path>,
    encoding: Option<&str>,
) -> Result<(), Error> {
    output::refuse_over([output::named(output)], [file])?;
    let name = file.display().to_string();
    let text = files::read_text(file, encoding)?;
    let (commons, warnings) = match post {
        None => {
            let imported = settings::read_option_file(&name, &text).map_err(Error::Setup)?;
            (imported.commons, imported.warnings)
        }
        Some(post) => {
            let program = Program::builder().ready(post).build()?;
            let mut commons = program.commons().clone();
            let warnings = settings::lay_over(&mut commons, &name, &text).map_err(Error::Setup)?;
            (commons, warnings)
        }
    };
    let title = Value::String(text.lines().nth(1).unwrap_or_default().trim().into()).to_string();
    let toml = format!("name = {title}\n\n{}", settings::write_toml(&commons));
    Target::new(output).write(|writer| {
        writer.write_all(toml.as_bytes()).map_err(|error| output::stdout_error(&error))
    })?;
    summary::warnings(&warnings);
    Ok(())
}

/// Tape position, format and specification of a letter; `None` for one that is not written.
fn slot(commons: &Commons, letter: u8) -> Option<[f64; 3]> {
    let int = |location: u32| commons.get(Kind::Int, location).unwrap_or(NOT_USED);
    let slot = int(u32::from(filpost::Letter::of(letter).number()));
    let is_written = (1.0..NOT_USED).contains(&slot);
    is_written.then(|| [slot, int(FORMAT + slot as u32), int(SPECIFICATION + slot as u32)])
}

/// A letter with its slot, as a line.
fn address(commons: &Commons, letter: u8) -> String {
    let name = char::from(letter);
    match slot(commons, letter) {
        None => format!("address.{name:<20} none"),
        Some([slot, format, specification]) => {
            let format = explain::value(format);
            format!("address.{name:<20} slot {slot}, format {format}, spec {specification}")
        }
    }
}
