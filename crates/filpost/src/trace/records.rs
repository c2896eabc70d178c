//! Records of a CL file by number and by line.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Seek, SeekFrom};
use std::path::Path;

use fil_cl::record::{WordView, kind};
use fil_cl::{ClDialect, Vocabulary, reader};
use fil_post::Cause;

use super::answer::Record;
use super::line_search;
use super::{FilePosition, no_line};
use crate::error::Error;
use crate::files;
use crate::statement::statement_text;

/// Records by number.
pub(super) type Records = BTreeMap<u32, Record>;

/// Words of a GOTO of three coordinates.
const PLAIN: usize = 8;

/// Records from which the dialect of a file is told.
const HEAD: u32 = 1000;

/// Reads the wanted records, given by their numbers and lines; `near` is a record
/// not far before them.
///
/// # Errors
/// E0701
pub(super) fn read(
    path: &Path,
    wanted: &BTreeMap<u32, u32>,
    near: Option<Cause>,
    options: &reader::Options,
) -> Result<Records, Error> {
    let mut records = Records::new();
    let Some((last, _)) = wanted.last_key_value() else { return Ok(records) };
    if let Some(near) = near
        && let Some(records) = read_near(path, wanted, near, options)?
    {
        return Ok(records);
    }
    each(path, options, |record, vocabulary| {
        if wanted.contains_key(&record.number) {
            records.insert(record.number, shown(record, vocabulary));
        }
        record.number < *last
    })?;
    Ok(records)
}

/// Reads the wanted records from a record before them on, where what stands before
/// that can't matter: all that is wanted are GOTO of three coordinates of Creo, and
/// numbers and lines come out as the run has counted them. `None` otherwise.
fn read_near(
    path: &Path,
    wanted: &BTreeMap<u32, u32>,
    near: Cause,
    options: &reader::Options,
) -> Result<Option<Records>, Error> {
    if wanted.first_key_value().is_none_or(|(first, _)| *first < near.record) || options.raw {
        return Ok(None);
    }
    let cant = |error| files::cant_read(path, &error);
    let mut file = File::open(path).map_err(cant)?;
    if !is_creo(&file, options) {
        return Ok(None);
    }
    file.rewind().map_err(cant)?;
    let Some(offset) = line_search::offset(&mut file, near.line.into()).map_err(cant)? else {
        return Ok(None);
    };
    file.seek(SeekFrom::Start(offset)).map_err(cant)?;
    let options = reader::Options { dialect: Some(ClDialect::Creo), ..*options };
    let mut reader = reader::Reader::new(file, "", options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), fil_cl::Record::default());
    let mut records = Records::new();
    while records.len() < wanted.len() {
        let Ok(true) = reader.read(&mut vocabulary, &mut record) else { return Ok(None) };
        if record.number == 1 && record.line != 1 {
            return Ok(None);
        }
        record.number += near.record - 1;
        record.line += near.line - 1;
        let Some(line) = wanted.get(&record.number) else {
            if wanted.last_key_value().is_none_or(|(last, _)| record.number > *last) {
                return Ok(None);
            }
            continue;
        };
        if record.kind != kind::MOTION || record.len() != PLAIN || record.line != *line {
            return Ok(None);
        }
        records.insert(record.number, shown(&record, &vocabulary));
    }
    Ok(Some(records))
}

/// A record by its number and line, where nothing that stands before it can matter; `None`
/// otherwise.
///
/// # Errors
/// E0701
pub(super) fn plain(
    path: &Path,
    cause: Cause,
    options: &reader::Options,
) -> Result<Option<Record>, Error> {
    let wanted = BTreeMap::from([(cause.record, cause.line)]);
    let records = read_near(path, &wanted, cause, options)?;
    Ok(records.and_then(|mut records| records.remove(&cause.record)))
}

/// The head of a file says that it is one of Creo.
fn is_creo(file: &File, options: &reader::Options) -> bool {
    let mut reader = reader::Reader::new(file, "", *options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), fil_cl::Record::default());
    while record.number < HEAD && matches!(reader.read(&mut vocabulary, &mut record), Ok(true)) {}
    reader.recognized().dialect == ClDialect::Creo
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
    let mut found = fil_cl::Record::default();
    let mut words = Vocabulary::new();
    each(path, options, |record, vocabulary| {
        let reached = u64::from(record.line) <= place.line;
        if reached {
            std::mem::swap(record, &mut found);
        } else {
            words = vocabulary.clone();
        }
        reached
    })?;
    Ok((found.number > 0).then(|| shown(&found, &words)))
}

/// Hands out record by record while `more` says so; what comes after the last
/// readable one the run has not read either.
fn each(
    path: &Path,
    options: &reader::Options,
    mut more: impl FnMut(&mut fil_cl::Record, &Vocabulary) -> bool,
) -> Result<(), Error> {
    let file = File::open(path).map_err(|error| files::cant_read(path, &error))?;
    let mut reader = reader::Reader::new(file, &path.display().to_string(), *options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), fil_cl::Record::default());
    while let Ok(true) = reader.read(&mut vocabulary, &mut record) {
        if !more(&mut record, &vocabulary) {
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
    line_search::count(&mut File::open(path).map_err(cant)?).map_err(cant)
}
