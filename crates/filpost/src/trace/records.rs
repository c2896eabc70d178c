//! Records of a CL file by number and by line.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use fil_cl::record::WordView;
use fil_cl::{Vocabulary, reader};

use super::answer::Record;
use super::{FilePosition, no_line};
use crate::error::Error;
use crate::files;
use crate::statement::statement_text;

/// Records by number.
pub(super) type Records = BTreeMap<u32, Record>;

/// Reads the wanted records.
///
/// # Errors
/// E0701
pub(super) fn read(
    path: &Path,
    wanted: &BTreeSet<u32>,
    options: &reader::Options,
) -> Result<Records, Error> {
    let mut records = Records::new();
    let Some(last) = wanted.last() else { return Ok(records) };
    each(path, options, |record, vocabulary| {
        if wanted.contains(&record.number) {
            records.insert(record.number, shown(record, vocabulary));
        }
        record.number < *last
    })?;
    Ok(records)
}

/// The record whose statement stands on a line, or the last one before it;
/// `None` before the first.
///
/// # Errors
/// E0709 for a line that is not there, E0701.
pub(super) fn at_line(
    path: &Path,
    place: &FilePosition,
    options: &reader::Options,
) -> Result<Option<Record>, Error> {
    let lines = count_lines(path)?;
    if place.line == 0 || place.line > lines {
        return Err(no_line(place, lines));
    }
    let mut found = None;
    each(path, options, |record, vocabulary| {
        let reached = u64::from(record.line) <= place.line;
        if reached {
            found = Some(shown(record, vocabulary));
        }
        reached
    })?;
    Ok(found)
}

/// Hands out record by record while `more` says so; what comes after the last
/// readable one the run has not read either.
fn each(
    path: &Path,
    options: &reader::Options,
    mut more: impl FnMut(&fil_cl::Record, &Vocabulary) -> bool,
) -> Result<(), Error> {
    let file = File::open(path).map_err(|error| files::cant_read(path, &error))?;
    let mut reader = reader::Reader::new(file, &path.display().to_string(), *options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), fil_cl::Record::default());
    while let Ok(true) = reader.read(&mut vocabulary, &mut record) {
        if !more(&record, &vocabulary) {
            break;
        }
    }
    Ok(())
}

fn shown(record: &fil_cl::Record, vocabulary: &Vocabulary) -> Record {
    let words = (1..=record.len()).map(|number| match record.word(number, vocabulary) {
        Some(WordView::Number(value)) => value.to_string(),
        Some(WordView::Word { name, .. }) => name.to_string(),
        Some(WordView::Text(text)) => format!("'{text}'"),
        Some(WordView::Empty) | None => String::new(),
    });
    Record {
        number: record.number,
        line: record.line,
        statement: statement_text(record, vocabulary),
        words: words.collect(),
    }
}

fn count_lines(path: &Path) -> Result<u64, Error> {
    let cant = |error| files::cant_read(path, &error);
    let mut input = BufReader::with_capacity(1 << 18, File::open(path).map_err(cant)?);
    let (mut lines, mut open) = (0, false);
    loop {
        let bytes = input.fill_buf().map_err(cant)?;
        let Some(last) = bytes.last() else { return Ok(lines + u64::from(open)) };
        open = *last != b'\n';
        lines += bytes.iter().filter(|byte| **byte == b'\n').count() as u64;
        let count = bytes.len();
        input.consume(count);
    }
}
