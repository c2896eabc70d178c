//! `filpost machine diff`

use std::path::Path;

use filpost::locations::TABLE;
use filpost::{Commons, Error, Kind, ready};

use super::{FORMAT, LETTERS, SPECIFICATION, address};
use crate::args::Chosen;
use crate::{Status, explain, output, setup, summary};

/// Tape positions, whose formats and specifications the letters show.
const POSITIONS: std::ops::RangeInclusive<u32> = 1..=53;

/// Says in which settings two machines differ.
///
/// # Errors
/// Files that can't be read; wrong settings.
pub fn run(first: &Path, second: &Path) -> Result<Status, Error> {
    let (first, second) = (commons(first)?, commons(second)?);
    let mut lines = named(&first, &second);
    lines.extend(letters(&first, &second));
    lines.extend(numbered(&first, &second));
    let equal = lines.is_empty();
    if equal {
        lines.push("the machines have the same settings".to_string());
    }
    output::print((lines.join("\n") + "\n").as_bytes())?;
    Ok(if equal { Status::Done } else { Status::Failed })
}

/// The settings of a ready post, a folder or a file.
fn commons(machine: &Path) -> Result<Commons, Error> {
    let name = machine.to_string_lossy().into_owned();
    let chosen = if machine.is_dir() || ready::find(&name).is_some() || !machine.exists() {
        Chosen { post: Some(name), ..Chosen::default() }
    } else {
        Chosen { machine: Some(machine.to_path_buf()), ..Chosen::default() }
    };
    let named = setup::named(&chosen, None)?;
    let builder = named.map_or_else(filpost::Program::builder, |named| named.builder);
    let program = builder.build()?;
    summary::warnings(program.warnings());
    Ok(program.commons().clone())
}

/// Settings of the table of locations.
fn named(first: &Commons, second: &Commons) -> Vec<String> {
    let value = |commons: &Commons, kind, number| commons.get(kind, number).ok();
    TABLE
        .iter()
        .filter(|row| {
            let number = u32::from(row.number);
            value(first, row.kind, number) != value(second, row.kind, number)
        })
        .map(|row| {
            let [one, two] = [first, second].map(|commons| explain::shown_value(row, commons));
            format!("{:<28} {one} | {two}", row.name)
        })
        .collect()
}

fn letters(first: &Commons, second: &Commons) -> Vec<String> {
    LETTERS
        .filter_map(|letter| {
            let [one, two] = [first, second].map(|commons| address(commons, letter));
            let name = format!("address.{}", char::from(letter));
            let value = |line: &str| line.strip_prefix(&name).unwrap_or(line).trim().to_string();
            (one != two).then(|| format!("{name:<28} {} | {}", value(&one), value(&two)))
        })
        .collect()
}

/// Commons without a name.
fn numbered(first: &Commons, second: &Commons) -> Vec<String> {
    let mut lines = Vec::new();
    for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
        for number in 1..=kind.size() as u32 {
            let [one, two] = [first, second].map(|commons| commons.get(kind, number).ok());
            if one != two && !shown(kind, number) {
                let [one, two] =
                    [one, two].map(|value| value.map_or("none".into(), explain::value));
                lines.push(format!("{} {number:<21} {one} | {two}", kind.name()));
            }
        }
    }
    lines
}

/// The common is a named setting or belongs to the address table.
fn shown(kind: Kind, number: u32) -> bool {
    let in_table = TABLE.iter().any(|row| row.kind == kind && u32::from(row.number) == number);
    let of_letter = |letter| u32::from(filpost::Letter::of(letter).number()) == number;
    let of_position = |offset: u32| POSITIONS.contains(&number.saturating_sub(offset));
    in_table
        || (kind == Kind::Int
            && (LETTERS.into_iter().any(of_letter)
                || of_position(FORMAT)
                || of_position(SPECIFICATION)))
}
