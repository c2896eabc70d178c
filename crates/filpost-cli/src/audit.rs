//! The audit of `filpost post`, `filpost test` and `filpost verify`: copies of what a run
//! writes, and what was found in print.

use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};

use filpost::audit::{Audit, Verdict};
use filpost::cl::reader::Options;
use filpost::nc::source::Source;
use filpost::{Diag, Error, Program, Run, files};

use crate::errors::CommandCode;
use crate::output;
use crate::summary::counted;

/// Program and line map of a run once more, in nameless files.
pub struct Copies {
    nc: BufWriter<File>,
    map: BufWriter<File>,
}

/// Writes to two places.
pub struct Both<'w>(pub &'w mut (dyn Write + Send), pub &'w mut (dyn Write + Send));

impl Write for Both<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.0.write(bytes)?;
        self.1.write_all(&bytes[..count])?;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().and_then(|()| self.1.flush())
    }
}

impl Copies {
    /// Empty ones.
    ///
    /// # Errors
    /// E0702: the system has no room for temporary files.
    pub fn new() -> Result<Self, Error> {
        let file = || output::temporary_file().map(BufWriter::new).map_err(|error| cant(&error));
        Ok(Copies { nc: file()?, map: file()? })
    }

    /// Where program and map go.
    pub fn writers(&mut self) -> (&mut BufWriter<File>, &mut BufWriter<File>) {
        (&mut self.nc, &mut self.map)
    }

    /// Audits the run that wrote them; gives the lines to print too.
    ///
    /// # Errors
    /// As [`Run::audit`].
    pub fn audit(
        self,
        run: Run<'_>,
        mut cl: File,
        (cl_name, nc_name): (&str, &str),
        program: &Program,
    ) -> Result<(Audit, Vec<String>), Error> {
        let whole = |writer: BufWriter<File>| {
            writer.into_inner().map_err(|error| cant(&error.into_error()))
        };
        let (nc, mut map) = (Source::file(whole(self.nc)?), whole(self.map)?);
        cl.rewind().map_err(|error| files::cant_read(cl_name.as_ref(), &error))?;
        let audit = run.audit(cl, (&nc, nc_name), &mut map)?;
        let lines = lines(&audit, (cl_name, nc_name), &nc.in_page(program.nc_page()))?;
        Ok((audit, lines))
    }
}

fn cant(error: &io::Error) -> Error {
    files::cant_write("a temporary file".as_ref(), error)
}

/// A run of a program that reads a CL file in this way.
pub fn run_of<'o>(
    program: &Program,
    cl_name: &str,
    reading: Options,
    unit: Option<filpost::Unit>,
) -> Run<'o> {
    let run = program.start().cl_name(cl_name).cl_options(reading);
    match unit {
        Some(unit) => run.units(unit),
        None => run,
    }
}

/// What was found, for people.
///
/// # Errors
/// E0915: the program can't be read again.
pub fn lines(
    audit: &Audit,
    (cl, nc): (&str, &str),
    text: &Source<'_>,
) -> Result<Vec<String>, Error> {
    let mut lines = vec![conclusion(audit, cl, nc)];
    let mut wanted: Vec<u32> = audit.findings.iter().filter_map(|found| found.nc_line).collect();
    wanted.sort_unstable();
    let blocks = text.lines(nc, &wanted).map_err(Error::Run)?;
    for finding in &audit.findings {
        lines.push(format!("  {finding}"));
        let block = blocks.iter().find(|(line, _)| Some(*line) == finding.nc_line);
        lines.extend(block.map(|(_, block)| format!("      {block}")));
    }
    if audit.more > 0 {
        lines.push(format!("  and {} more", counted(audit.more, "finding")));
    }
    lines.extend(audit.changes.iter().map(|change| format!("  {change}")));
    if audit.more_changes > 0 {
        lines.push(format!("  and {} more", counted(audit.more_changes, "change")));
    }
    lines.extend(audit.not_compared.iter().map(|what| format!("  not compared: {what}")));
    Ok(lines)
}

fn conclusion(audit: &Audit, cl: &str, nc: &str) -> String {
    let changes = match audit.by_authors() + audit.more_changes {
        0 => "no change by an author".to_string(),
        count => format!("{} by authors", counted(count, "change")),
    };
    let motions = match audit.motions {
        Some((asked, made)) if asked > 0 => format!("{made} of {}", counted(asked, "motion")),
        _ => format!(
            "{} of {} as the post alone writes them",
            audit.kept,
            counted(audit.blocks, "block")
        ),
    };
    match audit.verdict() {
        Verdict::Faulty => {
            let findings = counted(audit.findings.len() as u64 + audit.more, "finding");
            format!("{nc}: {findings}, {changes} ({motions})")
        }
        _ if audit.motions.is_none() => format!("{nc}: {changes} ({motions})"),
        Verdict::Unchanged => format!("{nc}: {changes}, it agrees with {cl} ({motions})"),
        Verdict::Changed => format!("{nc}: {changes}, the rest agrees with {cl} ({motions})"),
    }
}

/// Refuses a program with a fault, and with `--deny audit` one that an author changed.
///
/// # Errors
/// E0813
pub fn deny(audit: &Audit, denies_changes: bool) -> Result<(), Error> {
    let message = match audit.verdict() {
        Verdict::Faulty => counted(audit.findings.len() as u64 + audit.more, "finding"),
        Verdict::Changed if denies_changes => {
            counted(audit.changes.len() as u64 + audit.more_changes, "change")
        }
        _ => return Ok(()),
    };
    Err(Error::Run(Box::new(Diag::new(CommandCode::Audit, message))))
}
