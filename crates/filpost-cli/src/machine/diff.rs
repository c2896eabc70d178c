//! `filpost machine diff`

use std::path::Path;

use filpost::commons::EMPTY;
use filpost::locations::TABLE;
use filpost::{Commons, Error, Kind, explain, ready, user_blocks};

use super::{FORMAT, LETTERS, SPECIFICATION, address};
use crate::args::Chosen;
use crate::{Status, output, setup, summary};

/// Two blanks, as packed texts of option files have them.
const BLANKS: f64 = 8224.0;

/// Tape positions, whose formats and specifications the letters show.
const POSITIONS: std::ops::RangeInclusive<u32> = 1..=53;

/// Says in which settings two machines differ.
///
/// # Errors
/// Files that can't be read; wrong settings.
pub fn run(first: &Path, second: &Path) -> Result<Status, Error> {
    let (first, second) = (commons(first)?, commons(second)?);
    let mut lines = named(&first, &second);
    lines.extend(texts(&first, &second));
    lines.extend(letters(&first, &second));
    lines.extend(numbered(&first, &second));
    let equal = lines.is_empty();
    if equal {
        lines.push("the machines have the same settings".to_string());
    }
    output::print((lines.join("\n") + "\n").as_bytes())?;
    Ok(if equal { Status::Done } else { Status::Failed })
}

/// A ready post, a folder or a file, as it is chosen by its option.
pub fn chosen(machine: &Path) -> Chosen {
    let name = machine.to_string_lossy().into_owned();
    if machine.is_dir() || ready::find(&name).is_some() || !machine.exists() {
        Chosen { post: Some(name), ..Chosen::default() }
    } else {
        Chosen { machine: Some(machine.to_path_buf()), ..Chosen::default() }
    }
}

/// The settings of a ready post, a folder or a file.
fn commons(machine: &Path) -> Result<Commons, Error> {
    let chosen = chosen(machine);
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
        .filter(|row| !is_text(row.kind, row.number))
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

/// The user's blocks, as texts.
fn texts(first: &Commons, second: &Commons) -> Vec<String> {
    let lists = user_blocks::LISTS.into_iter();
    let lists = lists.map(|(name, list)| (name, [first, second].map(|at| list.read(at))));
    lists
        .filter(|(_, [one, two])| one != two)
        .map(|(name, [one, two])| format!("{name:<28} {one:?} | {two:?}"))
        .collect()
}

/// Locations without a name: neighbours in one line where they hold packed text, each in
/// its own else.
fn numbered(first: &Commons, second: &Commons) -> Vec<String> {
    let mut lines = Vec::new();
    for kind in [Kind::Int, Kind::Rel, Kind::Dbl] {
        let mut run: Vec<Pair> = Vec::new();
        for number in 1..=kind.size() as u32 {
            let [one, two] = [first, second].map(|at| at.get(kind, number).unwrap_or(EMPTY));
            let pair = Pair { number, one, two };
            if shown(kind, number) || !pair.differs() {
                continue;
            }
            if run.last().is_some_and(|last| last.number + 1 != number) {
                write_run(kind, &mut run, &mut lines);
            }
            run.push(pair);
        }
        write_run(kind, &mut run, &mut lines);
    }
    lines
}

/// What two machines have at a location.
struct Pair {
    number: u32,
    one: f64,
    two: f64,
}

impl Pair {
    /// Two blanks of a packed text say as little as an absent integer.
    fn differs(&self) -> bool {
        let said = |value: f64| if value == BLANKS { EMPTY } else { value };
        said(self.one) != said(self.two)
    }
}

/// Writes neighbouring locations and empties them.
fn write_run(kind: Kind, run: &mut Vec<Pair>, lines: &mut Vec<String>) {
    let sides: [Option<String>; 2] =
        [text_of(run.iter().map(|pair| pair.one)), text_of(run.iter().map(|pair| pair.two))];
    match (kind, sides, run.as_slice()) {
        (Kind::Int, [Some(one), Some(two)], [first, .., last]) => {
            let numbers = format!("{} to {}", first.number, last.number);
            lines.push(format!("{} {numbers:<21} {one:?} | {two:?}", kind.name()));
        }
        _ => lines.extend(run.iter().map(|Pair { number, one, two }| {
            let [one, two] = [*one, *two].map(explain::value);
            format!("{} {number:<21} {one} | {two}", kind.name())
        })),
    }
    run.clear();
}

/// The text that integers hold, two characters each; `None` for numbers that are no text.
fn text_of(values: impl Iterator<Item = f64>) -> Option<String> {
    let mut text = String::new();
    for value in values {
        let pair = if value == EMPTY { BLANKS } else { value };
        for character in user_blocks::characters(pair as i32) {
            text.push(character?);
        }
    }
    Some(text.trim().to_string())
}

/// The location is a named setting or belongs to the address table.
fn shown(kind: Kind, number: u32) -> bool {
    let in_table = TABLE.iter().any(|row| row.kind == kind && u32::from(row.number) == number);
    let of_letter = |letter| u32::from(filpost::Letter::of(letter).number()) == number;
    let of_position = |offset: u32| POSITIONS.contains(&number.saturating_sub(offset));
    in_table
        || u16::try_from(number).is_ok_and(|number| is_text(kind, number))
        || (kind == Kind::Int
            && (LETTERS.into_iter().any(of_letter)
                || of_position(FORMAT)
                || of_position(SPECIFICATION)))
}

/// The location belongs to a list of the user's blocks.
fn is_text(kind: Kind, number: u16) -> bool {
    kind == Kind::Int && user_blocks::list_of(number).is_some()
}
