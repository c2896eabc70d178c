//! The listing: each CL record, what its section did, the blocks it made, where the tool
//! is afterwards with its feed and time, messages that stay off the tape and warnings;
//! at the end totals and the tools.

use std::io::{self, Write};

use fil_nc::decimals;

use crate::event::{Event, LineEditor, RunEnd};
use crate::report::Extents;
use crate::statement::statement_text;
use crate::tally::{Motion, Totals};

/// Characters of a paper tape on an inch of it.
const CHARACTERS_AN_INCH: f64 = 10.0;
const METERS_IN_AN_INCH: f64 = 0.0254;

/// Writes a listing while a run goes; give [`Listing::observer`] to the run.
///
/// ```
/// use filpost::{Program, listing::Listing};
///
/// let program = Program::builder().ready("fanuc-mill").build()?;
/// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
/// let mut listing = Listing::new(Vec::new());
/// program.start().observe(listing.observer()).run(cl.as_bytes(), std::io::sink())?;
/// let text = String::from_utf8(listing.finish()?)?;
/// assert!(text.contains("GOTO") && text.contains("X1. Y2. Z3."), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Listing<W> {
    writer: W,
    /// Lines of the record that is being carried out.
    pending: Vec<String>,
    /// The first error of the writer; after it nothing more is written.
    failure: Option<io::Error>,
}

impl<W: Write + Send> Listing<W> {
    /// A listing to a writer.
    pub fn new(writer: W) -> Self {
        Listing { writer, pending: Vec::new(), failure: None }
    }

    /// The observer that writes it.
    pub fn observer(&mut self) -> impl FnMut(Event<'_>) + Send + '_ {
        |event| {
            if self.failure.is_none() {
                self.failure = self.take(&event).err();
            }
        }
    }

    /// Ends the listing and gives the writer back.
    ///
    /// # Errors
    /// The first error of the writer.
    pub fn finish(mut self) -> io::Result<W> {
        if self.failure.is_none() {
            self.failure = self.write(None).err();
        }
        match self.failure {
            Some(error) => Err(error),
            None => self.writer.flush().map(|()| self.writer),
        }
    }

    fn take(&mut self, event: &Event<'_>) -> io::Result<()> {
        match event {
            Event::Record { record, vocabulary, .. } => {
                let statement = statement_text(record, vocabulary);
                self.pending.push(format!("{:>7} {:>7}  {statement}", record.line, record.number));
            }
            Event::Section { key, swallowed, traced, .. } if *traced || *swallowed => {
                let end = if *swallowed { ": record swallowed" } else { "" };
                self.pending.push(format!("{:>17}FIL section {key}{end}", ""));
            }
            Event::Block { text, origin, .. } => {
                let fil: Vec<String> =
                    origin.fil.iter().map(|at| format!(" <{}:{}>", at.file, at.line)).collect();
                self.pending.push(format!("{:>20}{text}{}", "", fil.concat()));
            }
            Event::Motion(motion) => self.pending.push(position(motion)),
            Event::Message(text) => self.pending.push(format!("{:>17}{text}", "")),
            Event::Warning(diag) => self.pending.push(format!("{:>17}{diag}", "")),
            Event::RecordDone { lines, .. } => self.write(Some(lines))?,
            Event::End(end) => self.pending.extend(totals(end)),
            Event::Section { .. } => {}
        }
        Ok(())
    }

    fn write(&mut self, editor: Option<&LineEditor<'_>>) -> io::Result<()> {
        for mut line in self.pending.drain(..) {
            if let Some(editor) = editor {
                editor.edit(&mut line);
                if line.is_empty() {
                    continue;
                }
            }
            writeln!(self.writer, "{line}")?;
        }
        Ok(())
    }
}

/// Where a motion ends, its feed and its time.
fn position(motion: &Motion) -> String {
    let [x, y, z] = motion.point.map(length);
    let feed = match (motion.rapid, motion.feed) {
        (true, _) => "rapid".to_string(),
        (false, Some(feed)) => format!("feed {}", length(feed)),
        (false, None) => "no feed".to_string(),
    };
    let time = motion.seconds.map_or_else(|| "time unknown".to_string(), seconds);
    format!("{:>22}X {x}  Y {y}  Z {z}  {feed}  way {}  {time}", "at ", length(motion.length))
}

/// In the place of the extents.
const BESIDE: &str = "Extents left out, and times and lengths are those of the CL points alone: \
                      POSTN or REPEAT wrote words of their own";

fn totals(end: &RunEnd<'_>) -> Vec<String> {
    let total = &end.tally.total;
    let beside = end.report.words_beside;
    let unit = end.report.unit.map_or_else(String::new, |(unit, _)| format!(" {unit}"));
    let meters = end.bytes as f64 / CHARACTERS_AN_INCH * METERS_IN_AN_INCH;
    let mut lines = vec![
        String::new(),
        format!(
            "Program: {} blocks, {} characters, tape length {} m",
            end.blocks,
            end.bytes,
            decimals::short(meters, 2)
        ),
        format!("Time:    {} in all", clock(total.seconds())),
    ];
    lines.extend(times(total, &unit, "         "));
    match &total.extents {
        Some(_) if beside => lines.push(BESIDE.to_string()),
        Some(extents) => lines.push(format!("CL points: {}{unit}", span(extents))),
        None => {}
    }
    for tool in &end.tally.tools {
        let name = tool.tool.map_or_else(|| "no tool".to_string(), |tool| format!("T{tool}"));
        let diameter =
            tool.diameter.map_or_else(String::new, |d| format!(", diameter {}{unit}", length(d)));
        lines.push(format!("Tool:    {name}{diameter}, {}", clock(tool.totals.seconds())));
        lines.extend(times(&tool.totals, &unit, "         "));
        if let Some(extents) = tool.totals.extents.as_ref().filter(|_| !beside) {
            lines.push(format!("         {}{unit}", span(extents)));
        }
    }
    lines.push(format!("Warnings: {}", end.report.warnings.len()));
    lines
}

fn times(totals: &Totals, unit: &str, before: &str) -> Vec<String> {
    let mut lines = vec![format!(
        "{before}feed {} over {}{unit}, rapid {} over {}{unit}, tool changes and dwells {}",
        clock(totals.cutting_seconds),
        length(totals.cutting_length),
        clock(totals.rapid_seconds),
        length(totals.rapid_length),
        clock(totals.other_seconds),
    )];
    if totals.untimed > 0 {
        lines.push(format!("{before}the time of {} motions is not known", totals.untimed));
    }
    lines
}

fn span(extents: &Extents) -> String {
    let axes = ["X", "Y", "Z"].iter().enumerate().map(|(axis, name)| {
        format!("{name} {} to {}", length(extents.min[axis]), length(extents.max[axis]))
    });
    axes.collect::<Vec<_>>().join(", ")
}

fn length(value: f64) -> String {
    decimals::short(value, 3)
}

fn seconds(value: f64) -> String {
    format!("{} s", decimals::short(value, 2))
}

/// Hours, minutes and seconds.
fn clock(seconds: f64) -> String {
    let whole = seconds.round().min(1e9) as u64;
    format!("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
}

#[cfg(test)]
mod tests {
    use super::clock;

    #[test]
    fn times_are_hours_minutes_and_seconds() {
        let shown: Vec<String> = [0.0, 59.6, 3661.0].map(clock).to_vec();
        assert_eq!(shown, ["0:00:00", "0:01:00", "1:01:01"]);
    }
}
