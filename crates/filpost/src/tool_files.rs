//! A CL file for each tool change, for controls without a tool changer: the CL text with the
//! lines of the other tools empty. Each line keeps its number, so messages name those of the whole
//! file.

use std::io::{self, BufRead, BufReader, Read, Seek, Write};

use fil_cl::reader::Options;
use fil_cl::record::kind;
use fil_cl::{ClDialect, Reader, Record, Vocabulary, WordId, words as w};
use fil_diag::{Diag, Result, TextSpan};

use crate::error::RunCode;

/// What holds on over tool changes, and what only says something: these stay in every program.
const HOLDS: &[WordId] = &[
    w::PARTNO,
    w::MACHIN,
    w::UNITS,
    w::UNIT,
    w::MULTAX,
    w::TLAXIS,
    w::TRANS,
    w::ORIGIN,
    w::TRACUT,
    w::LINTOL,
    w::ARCSLP,
    w::SET,
    w::MODE,
    w::FEDRAT,
    w::SEQNO,
    w::TPRINT,
    w::TOOL_PATH,
    w::REMARK,
    w::TITLES,
    w::END,
    w::REWIND,
    w::FINI,
];

/// What may stand between the last motion of a tool and the next change, and belongs to that one.
const BEFORE_A_CHANGE: &[WordId] = &[w::PPRINT, w::TPRINT, w::TOOL_PATH, w::CUTTER, w::FEATNO];

/// Statements that no tool can do without those before it.
const JOINS: &[WordId] =
    &[w::CALSUB, w::DEFSUB, w::COPY, w::INDEX, w::ROTABL, w::ROTATE, w::ROTHED, w::HEAD];

/// A tool change of a CL file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Number of the tool.
    pub tool: f64,
    /// Line of its record.
    pub line: u32,
    /// First line that belongs to it: a message before the change may be its own.
    first: u32,
}

/// The tool changes of a CL file, and how it is read.
#[derive(Clone, Debug)]
pub struct ToolChanges {
    /// All of them, in their order.
    pub all: Vec<Change>,
    dialect: ClDialect,
}

/// Finds the tool changes of a CL text; a tool that is called again right behind itself has one.
///
/// # Errors
/// A text that can't be read; a statement that joins tools, such as CALSUB.
pub fn changes(cl: impl Read + Send, name: &str, options: Options) -> Result<ToolChanges> {
    let mut reader = reader(cl, name, options);
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    let mut all: Vec<Change> = Vec::new();
    let mut first = None;
    while reader.read(&mut vocabulary, &mut record)? {
        if JOINS.contains(&record.major) && !record.inert {
            let word = vocabulary.name(record.major);
            return refuse(name, record.line, &format!("{word} joins what several tools do"));
        }
        match changed_tool(&record) {
            Some(tool) => {
                let line = first.take().unwrap_or(record.line);
                if all.last().is_none_or(|last| last.tool != tool) {
                    all.push(Change { tool, line: record.line, first: line });
                }
            }
            None if BEFORE_A_CHANGE.contains(&record.major) => {
                first.get_or_insert(record.line);
            }
            None => first = None,
        }
    }
    Ok(ToolChanges { all, dialect: reader.recognized().dialect })
}

impl ToolChanges {
    /// Writes the CL text of one change, counted from 0: lines of the others are empty.
    ///
    /// # Errors
    /// A text that can't be read or written; a change that depends on what is left out.
    pub fn write_one(
        &self,
        number: usize,
        mut cl: impl Read + Send + Seek,
        name: &str,
        options: Options,
        mut out: impl Read + Write + Seek + Send,
    ) -> Result<()> {
        let left_out = self.lines_left_out(number, &mut cl, name, options)?;
        let cant = |error: io::Error| RunCode::CantRead.diag(format!("{name}: {error}"));
        cl.rewind().map_err(cant)?;
        let mut left_out = left_out.into_iter().peekable();
        let (mut lines, mut line) = (BufReader::new(cl), Vec::new());
        for at in 1.. {
            line.clear();
            if lines.read_until(b'\n', &mut line).map_err(cant)? == 0 {
                break;
            }
            while left_out.next_if(|(_, end)| *end <= at).is_some() {}
            let is_out = left_out.peek().is_some_and(|(begin, _)| *begin <= at);
            // Comments say which system wrote the file.
            let is_comment = line.trim_ascii_start().starts_with(b"$$");
            let text = if is_out && !is_comment { b"\n" } else { &line[..] };
            out.write_all(text).map_err(cant_write)?;
        }
        out.rewind().map_err(cant_write)?;
        self.refuse_another_dialect(&mut out, name, options)?;
        out.rewind().map_err(cant_write)
    }

    /// Refuses a text that is taken for one of another CAM system than the whole file.
    fn refuse_another_dialect(
        &self,
        cl: impl Read + Send,
        name: &str,
        options: Options,
    ) -> Result<()> {
        let found = changes(cl, name, options)?.dialect;
        match found == self.dialect {
            true => Ok(()),
            false => refuse(name, 1, &format!("alone it is read as {found}: give --dialect")),
        }
    }

    /// The lines that are left out for a change, from one up to before another.
    fn lines_left_out(
        &self,
        number: usize,
        cl: impl Read + Send,
        name: &str,
        options: Options,
    ) -> Result<Vec<(u32, u32)>> {
        let mut reader = reader(cl, name, options);
        let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
        let mut left_out: Vec<(u32, u32)> = Vec::new();
        let (mut begins, mut carried) = (false, Carried::default());
        // Line and fate of the last statement.
        let mut last: Option<(u32, bool)> = None;
        while reader.read(&mut vocabulary, &mut record)? {
            let line = record.line;
            let of = self.all.partition_point(|change| change.first <= line);
            let is_out = of != number + 1 && !stays(&record, of);
            if of == number + 1 {
                if !std::mem::replace(&mut begins, true) {
                    carried.refuse_at_change(name, line)?;
                }
                carried.refuse_in_change(name, &record)?;
            } else if of <= number {
                carried.note(&record);
            }
            match last {
                Some((before, was_out)) if before == line && was_out != is_out => {
                    return refuse(name, line, "a line holds statements of two tools");
                }
                Some((before, true)) if before != line => close(&mut left_out, before, line),
                _ => {}
            }
            last = Some((line, is_out));
        }
        if let Some((before, true)) = last {
            close(&mut left_out, before, u32::MAX);
        }
        Ok(left_out)
    }
}

fn cant_write(error: io::Error) -> Box<Diag> {
    RunCode::CantWrite.diag(error.to_string())
}

/// Adds lines that are left out.
fn close(left_out: &mut Vec<(u32, u32)>, begin: u32, end: u32) {
    match left_out.last_mut() {
        Some(last) if last.1 == begin => last.1 = end,
        _ => left_out.push((begin, end)),
    }
}

fn reader<'r>(cl: impl Read + Send + 'r, name: &str, options: Options) -> Reader<'r> {
    Reader::new(cl, name, Options { expand_subroutines: false, ..options })
}

/// The number of the tool that a record changes to.
fn changed_tool(record: &Record) -> Option<f64> {
    record.first_number().filter(|_| record.takes_tool() && !record.inert)
}

/// A record stays in the programs of other tools; `of` is 0 before the first change.
fn stays(record: &Record, of: usize) -> bool {
    let is_said = record.inert || (record.kind == kind::PSEUDO && record.major != w::CUTTER);
    let moves = matches!(record.kind, kind::MOTION | kind::SURFACE)
        || matches!(record.major, w::RAPID | w::CYCLE | w::GOHOME | w::RETRCT);
    HOLDS.contains(&record.major) || record.kind == kind::FINI || is_said || (of == 0 && !moves)
}

/// What tools before a change leave for those behind it.
#[derive(Debug, Default)]
struct Carried {
    cycle: bool,
    compensation: bool,
    /// The last record is RAPID or CIRCLE, which a motion is to follow.
    awaits_motion: bool,
    leans: bool,
    spindle: bool,
    coolant: bool,
}

impl Carried {
    fn note(&mut self, record: &Record) {
        if record.inert {
            return;
        }
        let is_off = record.has(w::OFF) || record.has(w::NOMORE);
        match record.major {
            w::CYCLE => self.cycle = !is_off,
            w::CUTCOM => self.compensation = !is_off,
            w::SPINDL => self.spindle = !is_off,
            w::COOLNT => self.coolant = !is_off,
            _ => {}
        }
        self.leans = record.axis().map_or(self.leans, |axis| axis != [0.0, 0.0, 1.0]);
        match record.kind {
            kind::MOTION => self.awaits_motion = false,
            _ if record.major == w::RAPID => self.awaits_motion = true,
            _ => {}
        }
    }

    /// What no change may begin with.
    fn refuse_at_change(&self, name: &str, line: u32) -> Result<()> {
        let open = [
            (self.cycle, "a CYCLE goes on from the tool before"),
            (self.compensation, "CUTCOM goes on from the tool before"),
            (self.awaits_motion, "RAPID before the tool change is for a motion behind it"),
        ];
        match open.iter().find(|(is_open, _)| *is_open) {
            Some((_, what)) => refuse(name, line, what),
            None => Ok(()),
        }
    }

    /// What goes on from the tool before until a record says it anew.
    fn refuse_in_change(&mut self, name: &str, record: &Record) -> Result<()> {
        match record.major {
            w::SPINDL => self.spindle = false,
            w::COOLNT => self.coolant = false,
            _ => {}
        }
        if record.kind != kind::MOTION || record.inert {
            return Ok(());
        }
        let line = record.line;
        if self.leans && record.axis().is_none() {
            return refuse(name, line, "its tool axis is that of a point of the tool before");
        }
        self.leans = false;
        match (self.spindle, self.coolant) {
            (true, _) => refuse(name, line, "the spindle turns on from the tool before"),
            (_, true) => refuse(name, line, "the coolant flows on from the tool before"),
            _ => Ok(()),
        }
    }
}

fn refuse<T>(name: &str, line: u32, what: &str) -> Result<T> {
    let diag = Diag::new(RunCode::ToolFile, what.to_string());
    Err(Box::new(diag.at(TextSpan::line(name, line, ""))))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO: &str = "PARTNO / A\nUNITS / MM\nPPRINT / ONE\nLOADTL / 1\nSPINDL / 900, RPM, CLW\n\
        FEDRAT / 100, MMPM\nRAPID\nGOTO / 1, 2, $\n3\nGOTO / 4, 2, 3\nSPINDL / OFF\nPPRINT / TWO\n\
        LOADTL / 2\nSPINDL / 800, RPM, CLW\nRAPID\nGOTO / 5, 2, 3\nFINI\n";

    fn one(text: &str, number: usize) -> std::result::Result<Vec<String>, String> {
        let found = changes(text.as_bytes(), "cl", Options::default()).unwrap();
        let (mut out, cl) = (io::Cursor::new(Vec::new()), io::Cursor::new(text.as_bytes()));
        found
            .write_one(number, cl, "cl", Options::default(), &mut out)
            .map_err(|diag| diag.message.to_string())?;
        let out = String::from_utf8(out.into_inner()).unwrap();
        assert_eq!(out.lines().count(), text.lines().count());
        Ok(out.lines().filter(|line| !line.is_empty()).map(str::to_string).collect())
    }

    #[test]
    fn each_change_has_its_lines_and_what_holds_on() {
        let tools: Vec<f64> = changes(TWO.as_bytes(), "cl", Options::default())
            .unwrap()
            .all
            .iter()
            .map(|change| change.tool)
            .collect();
        assert_eq!(tools, [1.0, 2.0]);
        let first = one(TWO, 0).unwrap();
        assert!(first.contains(&"3".to_string()) && first.contains(&"SPINDL / OFF".to_string()));
        assert!(!first.iter().any(|line| line.contains("TWO") || line.contains("LOADTL / 2")));
        let second = one(TWO, 1).unwrap();
        assert_eq!(
            second,
            [
                "PARTNO / A",
                "UNITS / MM",
                "FEDRAT / 100, MMPM",
                "PPRINT / TWO",
                "LOADTL / 2",
                "SPINDL / 800, RPM, CLW",
                "RAPID",
                "GOTO / 5, 2, 3",
                "FINI"
            ]
        );
    }

    #[test]
    fn what_goes_on_over_a_change_is_refused() {
        let without_own_speed =
            TWO.replace("SPINDL / OFF\n", "").replace("SPINDL / 800, RPM, CLW\n", "");
        assert!(one(&without_own_speed, 1).unwrap_err().contains("spindle"));
        let open_cycle = TWO.replace("SPINDL / OFF", "CYCLE / DRILL, DEPTH, 3, MMPM, 90, CLEAR, 2");
        assert!(one(&open_cycle, 1).unwrap_err().contains("CYCLE"));
        let rapid = TWO.replace("SPINDL / OFF", "RAPID");
        assert!(one(&rapid, 1).unwrap_err().contains("RAPID"));
    }
}
