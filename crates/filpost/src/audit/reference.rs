//! The run that an audited program is compared with: the same machine without scripts.

use std::io::{Read, Seek};

use fil_nc::source::Source;

use super::{INSERT, MAP, taken};
use crate::error::Error;
use crate::files;
use crate::map::{Entry, MapReader, Names};
use crate::run::Run;
use crate::spool::{Spool, into_source, spool};

/// The name of its program in messages.
pub(super) const NAME: &str = "the program without scripts";

/// Bytes of a program or a map that are kept in memory.
const IN_MEMORY: usize = 1 << 20;

/// A program without scripts and its map.
pub(super) struct Reference {
    pub nc: Source<'static>,
    pub map: Spool,
    /// The CL file has INSERT, and its texts were left out.
    pub has_inserts: bool,
    /// Lines of the CL file, in order, whose records only a script can carry out.
    pub without: Vec<u32>,
}

impl Reference {
    /// Posts the CL file again; records of these sections have no effect, and neither have those
    /// that only a script of the audited run could carry out. The text is why there is no such
    /// program.
    ///
    /// # Errors
    /// A CL file or a map that can't be read.
    pub fn new<R: Read + Seek>(
        run: &Run<'_>,
        cl: &mut Spool,
        map: &mut R,
        sections: &[&str],
    ) -> Result<Result<Reference, String>, Error> {
        let mut sections: Vec<String> = sections.iter().map(|key| key.to_string()).collect();
        loop {
            cl.rewind().map_err(|error| files::cant_read(run.name().as_ref(), &error))?;
            let program = run.program.without_scripts(&sections)?;
            let names = Names { fil: program.fil_files(), ..Names::default() };
            let (mut nc, mut lines) = (spool(IN_MEMORY), spool(IN_MEMORY));
            let posted =
                run.of_program(program.clone()).run_mapped(&mut *cl, &mut nc, &names, &mut lines);
            let refused = match posted {
                Ok(_) => {
                    let nc = into_source(nc).into_page(program.nc_page());
                    let mut made =
                        Reference { nc, map: lines, has_inserts: false, without: Vec::new() };
                    made.has_inserts = !made.records_of(INSERT)?.is_empty();
                    made.without = without(&mut made.map)?;
                    return Ok(Ok(made));
                }
                Err(refused) if refused.is_cancelled() => return Err(refused),
                Err(refused) => refused,
            };
            let more = sections_at(map, &refused, &sections)?;
            if more.is_empty() {
                return Ok(Err(format!("without scripts the CL file is refused: {refused}")));
            }
            sections.extend(more);
        }
    }

    /// The records that a section took, in order.
    ///
    /// # Errors
    /// Its map can't be read.
    pub fn records_of(&mut self, key: &str) -> Result<Vec<u32>, Error> {
        let reader = MapReader::new(MAP, &mut self.map)?;
        let at = reader.sections().iter().position(|section| section == key);
        let all = taken(reader)?.into_iter();
        Ok(all.filter(|(_, section)| Some(usize::from(*section)) == at).map(|(at, _)| at).collect())
    }
}

/// Lines of the records that sections took, INSERT apart.
fn without(map: &mut Spool) -> Result<Vec<u32>, Error> {
    let mut reader = MapReader::new(MAP, map)?;
    let insert = reader.sections().iter().position(|section| section == INSERT);
    let mut lines = Vec::new();
    while let Some(entry) = reader.next_where(&|_, _, _| false) {
        if let Entry::Taken(taken) = entry? {
            lines.extend((Some(usize::from(taken.section)) != insert).then_some(taken.line));
        }
    }
    lines.sort_unstable();
    Ok(lines)
}

/// The sections of the audited run for the records that were refused, without those known: those
/// that ran for their lines, else those of their words.
fn sections_at<R: Read + Seek>(
    map: &mut R,
    refused: &Error,
    known: &[String],
) -> Result<Vec<String>, Error> {
    let places = refused.diags().iter().filter_map(|diag| diag.spans.first());
    let lines: Vec<u32> = places.map(|place| place.line).collect();
    let mut reader = MapReader::new(MAP, map)?;
    let mut found: Vec<String> = Vec::new();
    while let Some(entry) = reader.next() {
        let section = match entry? {
            Entry::Line(line) if lines.contains(&line.cause.line) => {
                reader.stack(line.cause).and_then(|stack| reader.section(stack))
            }
            Entry::Taken(taken) if lines.contains(&taken.line) => {
                reader.sections().get(usize::from(taken.section)).map(String::as_str)
            }
            _ => None,
        };
        let is_new = |key: &&str| known.iter().chain(&found).all(|known| known != key);
        let new = section.filter(is_new).map(str::to_string);
        found.extend(new);
    }
    if found.is_empty() {
        let statements = refused.diags().iter().filter_map(|diag| diag.spans.first());
        let words = statements
            .filter_map(|place| place.excerpt.split(['/', ' ']).find(|word| !word.is_empty()));
        let words: Vec<&str> = words.collect();
        let is_of_word = |key: &&String| words.contains(&key.split(',').next().unwrap_or_default());
        let new = reader.sections().iter().filter(is_of_word).filter(|key| !known.contains(key));
        found.extend(new.cloned());
    }
    Ok(found)
}
