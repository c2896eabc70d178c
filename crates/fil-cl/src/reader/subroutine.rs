//! DEFSUB, ENDSUB and CALSUB of Creo: what a subroutine holds is done where it is called, and
//! nowhere else.
//!
//! A subroutine is defined before the tool and the spindle that it needs, so its statements
//! must not be carried out where they stand. Each call gives its records again, with the lines
//! of the definition.

use fil_diag::{Diag, Result};

use super::Reader;
use crate::errors::ClCode;
use crate::forms::Outcome;
use crate::record::{Record, Word, kind};
use crate::words;

/// Most records that subroutines of a file may hold together.
const MOST_RECORDS: usize = 1_000_000;

/// The subroutines of a file.
#[derive(Debug, Default)]
pub(super) struct Subroutines {
    /// Those that are whole, with their numbers.
    whole: Vec<(f64, Vec<Record>)>,
    under_way: Option<UnderWay>,
}

/// A subroutine from DEFSUB to its ENDSUB.
#[derive(Debug)]
struct UnderWay {
    number: f64,
    line: u32,
    /// Records of the file before it.
    records: u32,
    body: Vec<Record>,
    /// Records that those before it leave room for.
    room: usize,
}

impl Subroutines {
    /// True from DEFSUB to ENDSUB.
    #[inline]
    pub(super) fn is_under_way(&self) -> bool {
        self.under_way.is_some()
    }

    fn body(&self, number: f64) -> Option<&Vec<Record>> {
        self.whole.iter().find(|(known, _)| *known == number).map(|(_, body)| body)
    }
}

impl Reader<'_> {
    /// Takes DEFSUB/n, ENDSUB and CALSUB/n; a call gives the records of the subroutine.
    ///
    /// # Errors
    /// A subroutine within another one; one that is defined twice, or not before its call, or
    /// that counts from where the tool stands.
    pub(super) fn take_subroutine(&mut self, record: &Record) -> Result<Outcome> {
        self.refuse_expected()?;
        if self.modal.in_arc {
            return Err(self.sub_error("the CIRCLE before it has no end"));
        }
        if record.major == words::ENDSUB {
            return self.end_subroutine(record);
        }
        let [Word::Number(number)] = record.data[..] else {
            return Err(self.sub_error("the number of the subroutine is needed, and nothing more"));
        };
        if record.major == words::CALSUB {
            return self.call_subroutine(number);
        }
        if let Some(outer) = &self.subroutines.under_way {
            let message = format!("the subroutine of line {} has no ENDSUB", outer.line);
            return Err(self.sub_error(&message));
        }
        let (line, records) = (record.line, self.number);
        let kept: usize = self.subroutines.whole.iter().map(|(_, body)| body.len()).sum();
        let room = MOST_RECORDS.saturating_sub(kept);
        let sub = UnderWay { number, line, records, body: Vec::new(), room };
        self.subroutines.under_way = Some(sub);
        self.modal.point = None;
        Ok(Outcome::Nothing)
    }

    fn end_subroutine(&mut self, record: &Record) -> Result<Outcome> {
        let Some(ended) = self.subroutines.under_way.take() else {
            return Err(self.sub_error("no DEFSUB came before it"));
        };
        if !record.data.is_empty() {
            return Err(self.sub_error("ENDSUB takes nothing"));
        }
        let is_incremental =
            |record: &Record| record.major == words::MODE && record.has(words::INCR);
        let counts_on = ended.body.iter().any(is_incremental);
        // Kept empty, so that its calls are no further errors.
        let body = if counts_on { Vec::new() } else { ended.body };
        match self.subroutines.body(ended.number) {
            // The file is read again from before the definition.
            Some(known) if *known == body => {}
            Some(_) => return Err(self.sub_error("the subroutine is defined twice")),
            None => self.subroutines.whole.push((ended.number, body)),
        }
        self.modal.point = None;
        if counts_on {
            let message =
                "a subroutine with MODE/INCR: from where its points count is not in the file";
            return Err(self.sub_error(message));
        }
        Ok(Outcome::Nothing)
    }

    fn call_subroutine(&mut self, number: f64) -> Result<Outcome> {
        let Some(body) = self.subroutines.body(number) else {
            let message = format!("no subroutine {number} is defined before it");
            return Err(self.sub_error(&message));
        };
        self.modal.point = body.iter().rev().find_map(Record::point);
        self.made.extend(body.iter().rev().cloned());
        Ok(Outcome::Nothing)
    }

    /// Keeps a record for the subroutine under way.
    ///
    /// # Errors
    /// The program ends within it; too many records.
    pub(super) fn keep_for_subroutine(&mut self, record: &Record) -> Result<()> {
        let Some(sub) = &mut self.subroutines.under_way else { return Ok(()) };
        let (line, is_full) = (sub.line, sub.body.len() >= sub.room);
        sub.body.push(Record { number: 0, ..record.clone() });
        self.number = sub.records;
        if is_full {
            return Err(self.sub_error(&format!("more than {MOST_RECORDS} records")));
        }
        if record.kind == kind::FINI { Err(self.unended_subroutine(line)) } else { Ok(()) }
    }

    /// Refuses a file that ends within a subroutine.
    ///
    /// # Errors
    /// It does.
    pub(super) fn check_subroutines_end(&self) -> Result<()> {
        let under_way = self.subroutines.under_way.as_ref();
        under_way.map_or(Ok(()), |sub| Err(self.unended_subroutine(sub.line)))
    }

    fn unended_subroutine(&self, line: u32) -> Box<Diag> {
        self.sub_error(&format!("the program ends within the subroutine of line {line}"))
    }

    fn sub_error(&self, message: &str) -> Box<Diag> {
        let whole = 0..self.statement.joined.len();
        let mut diag = self.diag(ClCode::UncomputedMotion, message, whole);
        diag.hint = Some(
            "write the CL file without subroutines, or define each by DEFSUB/n … ENDSUB, with \
             absolute points, before its first CALSUB/n; a FIL section for CALSUB takes all three"
                .to_string(),
        );
        diag
    }
}
