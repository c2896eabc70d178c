//! Going back in a file, with sparse checkpoints.

use std::io::{Read, Seek};

use fil_diag::{Diag, TextSpan};

use super::lines::Input;
use super::{Gathered, Modal, Options, Reader, Repeated};
use crate::errors::ClCode;

/// Records between two checkpoints at first.
const SPACING: u32 = 4096;

/// No more checkpoints than this are kept: then every second one goes and the
/// spacing doubles, so that memory does not grow with the file.
const MAX_CHECKPOINTS: usize = 1024;

/// The state of the reader between two statements.
#[derive(Clone, Copy, Debug)]
struct Checkpoint {
    /// Number of the last record before it.
    number: u32,
    offset: u64,
    line: u32,
    modal: Modal,
}

/// What a reader needs to go back.
pub(super) struct Seeking {
    checkpoints: Vec<Checkpoint>,
    /// Number of the first record that is due a checkpoint; none of a stream is.
    due: u32,
    spacing: u32,
    /// Number of the record to read on to; 0 when it is the next one.
    pub(super) target: u32,
}

impl Seeking {
    pub(super) fn new(can_go_back: bool) -> Self {
        let due = if can_go_back { 0 } else { u32::MAX };
        Seeking { checkpoints: Vec::new(), due, spacing: SPACING, target: 0 }
    }

    /// True when the state after record `number` is worth a checkpoint.
    #[inline]
    pub(super) fn is_due(&self, number: u32) -> bool {
        number >= self.due
    }

    /// Keeps a checkpoint.
    pub(super) fn keep(&mut self, number: u32, offset: u64, line: u32, modal: Modal) {
        if self.checkpoints.len() == MAX_CHECKPOINTS {
            let mut kept = false;
            self.checkpoints.retain(|_| {
                kept = !kept;
                kept
            });
            self.spacing = self.spacing.saturating_mul(2);
        }
        self.checkpoints.push(Checkpoint { number, offset, line, modal });
        self.due = number.saturating_add(self.spacing);
    }
}

impl<'r> Reader<'r> {
    /// A reader of a file, which can go back. The input must stand at its start.
    pub fn seekable(
        input: impl Read + Seek + Send + 'r,
        file_name: &str,
        options: Options,
    ) -> Self {
        Reader::of(Input::File(Box::new(input)), file_name, options)
    }
}

impl Reader<'_> {
    /// True for a file, which can go back.
    pub fn can_go_back(&self) -> bool {
        self.lines.can_go_back()
    }

    /// Makes record `n` (from 1) the next one to be read. A record past the end
    /// shows as an error of the next [`Reader::read`].
    ///
    /// # Errors
    /// The input is a stream, `n` is 0, or the input cannot be moved.
    pub fn seek_record(&mut self, n: u32) -> Result<(), Box<Diag>> {
        let here = TextSpan::line(&self.file, self.statement.line.max(1), "");
        if !self.lines.can_go_back() {
            let message = format!("record {n} is asked for after record {}", self.number);
            return Err(Box::new(Diag::new(ClCode::NotSeekable, message).at(here)));
        }
        if n == 0 {
            return Err(Box::new(Diag::new(ClCode::NoSuchRecord, "record 0").at(here)));
        }
        self.seeking.target = n;
        self.at_line = false;
        let before = self.seeking.checkpoints.partition_point(|point| point.number < n);
        let Some(point) = before.checked_sub(1).map(|at| self.seeking.checkpoints[at]) else {
            return Ok(());
        };
        if self.failed.is_none() && (point.number..n).contains(&self.number) {
            return Ok(());
        }
        if let Err(error) = self.lines.go_to(point.offset, point.line) {
            return Err(self.read_failed(&error));
        }
        // A statement may have told something only where it came first.
        self.repeated = Repeated::default();
        self.pending.clear();
        self.spline = Gathered::default();
        self.made.clear();
        self.modal = point.modal;
        self.number = point.number;
        self.failed = None;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checkpoints_stay_few_however_long_the_file() {
        let mut seeking = Seeking::new(true);
        while seeking.due < u32::MAX {
            let number = seeking.due;
            assert!(seeking.is_due(number));
            seeking.keep(number, u64::from(number), number, Modal::default());
            assert!(seeking.checkpoints.len() <= MAX_CHECKPOINTS);
        }
        let numbers: Vec<u32> = seeking.checkpoints.iter().map(|point| point.number).collect();
        assert_eq!(numbers[0], 0);
        assert!(numbers.len() >= MAX_CHECKPOINTS / 2);
        assert!(numbers.windows(2).all(|pair| pair[1] - pair[0] <= seeking.spacing));
    }
}
