//! The audit of a program: what scripts and INSERT changed in it, and whether the rest does
//! what the CL file asks for.
//!
//! The same machine posts the same CL file once more, without any script and without texts of
//! INSERT. Blocks of both programs are compared record by record, and the line map says who
//! made those that differ: an author, whose change is listed, or the post, which followed an
//! author. Blocks that are the same in both are the post's own, so they are judged: the program
//! without scripts against the CL file, by the back-check that shares nothing with the post,
//! and in the audited program each such block must do what it does there. Rules that no program
//! may break are judged for all blocks, whoever made them.

mod align;
mod changes;
mod json;
mod judge;
mod lines;
mod made;
mod posted;
mod reference;
mod stated;
mod text;

use std::io::{Read, Seek};

use fil_nc::dialect::Dialect;
use fil_nc::source::Source;
use fil_nc::verify::{Allowed, Finding, Report};

use crate::error::Error;
use crate::files;
use crate::map::{Digest, Entry, MapReader};
use crate::run::Run;
use align::Pair;
use changes::Changes;
use lines::SameLines;
use made::Blocks;
use reference::Reference;
use stated::Stated;

pub use json::as_json;

/// The section that takes the texts of INSERT out of a reference.
const INSERT: &str = "INSERT";

/// The name of the line map in messages.
const MAP: &str = "the line map";

/// Who made a block.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Author {
    /// FIL.
    Script {
        /// FIL file and line; `None` where a section took the record and wrote nothing.
        place: Option<(String, u32)>,
        /// The key of the section (`CYCLE,DEEP`); `None` for statements outside of sections.
        section: Option<String>,
    },
    /// INSERT of the CL file.
    Insert,
    /// The post itself, which would have written something else without an author.
    Post {
        /// The last author who changed something before it; `None` where nobody has: a script
        /// has set something without changing a block.
        after: Option<Box<Author>>,
    },
}

/// What was changed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum What {
    /// A word has another number.
    Number {
        /// Its letter.
        letter: char,
        /// The number of the post alone, where it came first.
        from: String,
        /// The number in the program there.
        to: String,
        /// The difference where it is the same each time, in the unit of the program.
        by: Option<f64>,
    },
    /// A rotary axis was turned by a block of its own.
    Turned {
        /// Its letter.
        letter: char,
        /// Where it stood; `None` where no block has said it.
        from: Option<String>,
        /// Where it was turned to.
        to: String,
        /// Nothing turns it afterwards.
        stays: bool,
        /// Motions until something turns it.
        blocks: u64,
    },
    /// Blocks, or words of one, were put in, left out, replaced, or moved where both are the same.
    Blocks {
        /// What the post alone writes; none for what was put in.
        from: Vec<String>,
        /// What the program has; none for what was left out.
        to: Vec<String>,
    },
}

/// A change: the same thing by the same author, wherever it happens.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Change {
    /// Who made it.
    pub author: Author,
    /// Lines of the CL file, the first ones.
    pub cl_lines: Vec<u32>,
    /// Lines of the program, the first ones.
    pub nc_lines: Vec<u32>,
    /// How often it happens.
    pub count: u64,
    /// What was changed.
    pub what: What,
}

/// How an audit ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No author changed anything, and nothing is wrong.
    Unchanged,
    /// Authors changed something, and nothing is wrong.
    Changed,
    /// The post made a fault, or a block breaks a rule.
    Faulty,
}

impl Verdict {
    /// Its word in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Unchanged => "unchanged",
            Verdict::Changed => "changed",
            Verdict::Faulty => "faulty",
        }
    }
}

/// What an audit found.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Audit {
    /// What authors changed, and what the post wrote otherwise because of it.
    pub changes: Vec<Change>,
    /// Further changes that are not listed.
    pub more_changes: u64,
    /// Faults of the post, and rules that a block breaks.
    pub findings: Vec<Finding>,
    /// Further findings that are not listed.
    pub more: u64,
    /// What could not be judged.
    pub not_compared: Vec<String>,
    /// Motions that the CL file asks for, and those of them that the post makes as it asks;
    /// `None` where that could not be judged.
    pub motions: Option<(u64, u64)>,
    /// Blocks of the program.
    pub blocks: u64,
    /// Those of them that the post writes without any script too.
    pub kept: u64,
}

impl Audit {
    /// How it ends.
    pub fn verdict(&self) -> Verdict {
        match () {
            () if !self.findings.is_empty() => Verdict::Faulty,
            () if !self.changes.is_empty() => Verdict::Changed,
            () => Verdict::Unchanged,
        }
    }

    /// How many changes authors made, by blocks or by what they set; what the post wrote because of
    /// the blocks is not counted.
    pub fn by_authors(&self) -> u64 {
        let own = |change: &&Change| !matches!(change.author, Author::Post { after: Some(_) });
        self.changes.iter().filter(own).count() as u64
    }
}

impl Run<'_> {
    /// Audits a program of this post with the line map of its run, see [`Run::run_mapped`].
    ///
    /// # Errors
    /// A CL file, program or map that can't be read; E0707, E0708 for a map of another run.
    #[doc(hidden)]
    pub fn audit<R: Read + Seek>(
        self,
        mut cl: impl Read + Send,
        nc: (&Source<'_>, &str),
        map: &mut R,
    ) -> Result<Audit, Error> {
        let mut cl = self.spool(&mut cl)?;
        let nc = (&nc.0.in_page(self.program.nc_page()), nc.1);
        let cant = |error| files::cant_read(self.name().as_ref(), &error);
        let digest = Digest::of_reader(&mut cl).map_err(cant)?;
        let reader = MapReader::new(MAP, &mut *map)?;
        reader.cl().check(&self.name(), &digest)?;
        let has_scripts = !reader.fil().is_empty();
        let taken = taken(reader)?;
        let mut audit = Audit::default();
        let mut plain = match Reference::new(&self, &mut cl, map, &[INSERT])? {
            Ok(plain) => plain,
            Err(refused) => {
                audit.not_compared.push(refused);
                audit.find(judge::rules(&self.program, nc));
                let program = Blocks::new(&mut *map, MAP, nc)?;
                audit.blocks = program.map.nc_lines();
                (audit.changes, audit.more_changes) = written_by_scripts(program, taken)?;
                return Ok(audit);
            }
        };
        let dialect = Dialect::new(self.program.commons())?;
        let mut stated = Stated::new(&dialect);
        let same = {
            let inserts = plain.records_of(INSERT)?;
            let mut changes = Changes::new(taken, inserts);
            let mut same = SameLines::default();
            let reference = (&plain.nc, reference::NAME);
            let mut left = Blocks::new(&mut plain.map, MAP, reference)?;
            let mut right = Blocks::new(&mut *map, MAP, nc)?;
            audit.blocks = right.map.nc_lines();
            align::records(&mut left, &mut right, |program, pairs| {
                same.record(pairs);
                stated.record(pairs);
                changes.record(program, pairs);
                audit.kept +=
                    pairs.iter().filter(|pair| matches!(pair, Pair::Same(..))).count() as u64;
            })?;
            (audit.changes, audit.more_changes) = changes.finish();
            same
        };
        audit.find(judge::rules(&self.program, nc));
        audit.find(judge::effects(&dialect, (&plain.nc, reference::NAME), nc, (&same, &stated)));
        self.judge_by_cl(&mut audit, &mut cl, nc, (map, has_scripts), (plain, same))?;
        Ok(audit)
    }

    /// Judges the program without scripts, INSERT included, against the CL file.
    fn judge_by_cl<R: Read + Seek>(
        &self,
        audit: &mut Audit,
        cl: &mut crate::spool::Spool,
        nc: (&Source<'_>, &str),
        (map, has_scripts): (&mut R, bool),
        (plain, same): (Reference, SameLines),
    ) -> Result<(), Error> {
        let cant = |error| files::cant_read(self.name().as_ref(), &error);
        cl.rewind().map_err(cant)?;
        let machine = self.of_program(self.program.without_scripts(&[])?);
        let (judged, same) = match (has_scripts, plain.has_inserts) {
            (false, _) => (None, SameLines::all()),
            (true, false) => (Some(plain), same),
            (true, true) => match Reference::new(self, cl, map, &[])? {
                Ok(mut with_inserts) => {
                    let mut same = SameLines::default();
                    let reference = (&with_inserts.nc, reference::NAME);
                    let mut left = Blocks::new(&mut with_inserts.map, MAP, reference)?;
                    let mut right = Blocks::new(&mut *map, MAP, nc)?;
                    align::records(&mut left, &mut right, |_, pairs| same.record(pairs))?;
                    (Some(with_inserts), same)
                }
                Err(refused) => {
                    audit.not_compared.push(refused);
                    return Ok(());
                }
            },
        };
        cl.rewind().map_err(cant)?;
        let without = judged.as_ref().map_or(Vec::new(), |judged| judged.without.clone());
        let allowed = Allowed { without, ..Allowed::default() };
        let judged = judged.as_ref().map_or(nc, |judged| (&judged.nc, reference::NAME));
        match machine.verify_source(cl, judged, allowed) {
            Ok((report, _)) => {
                audit.motions = Some((report.compared, report.matched));
                audit.not_compared.extend(report.unverified.iter().map(|open| {
                    let line =
                        open.cl_line.map_or(String::new(), |line| format!("CL line {line}: "));
                    format!("{line}{}", open.what)
                }));
                audit.find(Ok(same.of_the_post(report)));
            }
            Err(refused) => audit.not_compared.push(format!("with the CL file: {refused}")),
        }
        Ok(())
    }
}

impl Audit {
    /// Takes up findings, or why there are none; a finding counts once.
    fn find(&mut self, found: Result<Report, String>) {
        match found {
            Ok(report) => {
                self.more += report.more;
                for finding in report.findings {
                    if !self.findings.contains(&finding) {
                        self.findings.push(finding);
                    }
                }
            }
            Err(why) => self.not_compared.push(why),
        }
    }
}

/// What scripts wrote, where no program without them can be compared.
fn written_by_scripts<R: Read + Seek>(
    mut program: Blocks<'_, R>,
    taken: changes::Taken,
) -> Result<(Vec<Change>, u64), Error> {
    let mut changes = Changes::new(taken, Vec::new());
    while program.record().is_some() {
        let made = program.of_record()?;
        let written = made.iter().filter(|made| made.cause.stack != 0);
        changes.record(&program, &written.map(Pair::Added).collect::<Vec<_>>());
    }
    Ok(changes.finish())
}

/// The records that sections took without effect, in order.
fn taken<R: Read + Seek>(mut map: MapReader<R>) -> Result<changes::Taken, Error> {
    let mut found = Vec::new();
    while let Some(entry) = map.next_where(&|_, _, _| false) {
        if let Entry::Taken(taken) = entry? {
            found.push((taken.record, taken.section));
        }
    }
    found.sort_unstable();
    Ok(found)
}
