//! Going back in a file: sparse checkpoints from its start on, and close ones around the place
//! where a script looks back.

use std::collections::VecDeque;
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

/// Records between two close checkpoints.
const CLOSE: u32 = 8;

/// No more close checkpoints than this are kept: the oldest ones go.
const MAX_CLOSE: usize = 512;

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
    spacing: u32,
    /// Checkpoints around the place that was gone back to last; `None` as long as nobody
    /// has gone back.
    close: Option<VecDeque<Checkpoint>>,
    /// Number of the first record that is due a checkpoint; none of a stream is.
    due: u32,
    /// Number of the record to read on to; 0 when it is the next one.
    pub(super) target: u32,
}

impl Seeking {
    pub(super) fn new(can_go_back: bool) -> Self {
        let due = if can_go_back { 0 } else { u32::MAX };
        Seeking { checkpoints: Vec::new(), spacing: SPACING, close: None, due, target: 0 }
    }

    /// True when the state after record `number` is worth a checkpoint.
    #[inline]
    pub(super) fn is_due(&self, number: u32) -> bool {
        number >= self.due
    }

    /// Keeps a checkpoint.
    pub(super) fn keep(&mut self, number: u32, offset: u64, line: u32, modal: Modal) {
        let point = Checkpoint { number, offset, line, modal };
        if number >= self.sparse_due() {
            self.keep_sparse(point);
        }
        if number >= self.close_due().unwrap_or(u32::MAX)
            && let Some(close) = &mut self.close
        {
            if close.len() == MAX_CLOSE {
                close.pop_front();
            }
            close.push_back(point);
        }
        self.find_due();
    }

    fn keep_sparse(&mut self, point: Checkpoint) {
        if self.checkpoints.len() == MAX_CHECKPOINTS {
            let mut kept = false;
            self.checkpoints.retain(|_| {
                kept = !kept;
                kept
            });
            self.spacing = self.spacing.saturating_mul(2);
        }
        self.checkpoints.push(point);
    }

    fn sparse_due(&self) -> u32 {
        let last = self.checkpoints.last();
        last.map_or(0, |point| point.number.saturating_add(self.spacing))
    }

    /// `None` where no close ones are kept.
    fn close_due(&self) -> Option<u32> {
        let close = self.close.as_ref()?;
        Some(close.back().map_or(0, |point| point.number.saturating_add(CLOSE)))
    }

    fn find_due(&mut self) {
        let sparse = self.sparse_due();
        self.due = self.close_due().map_or(sparse, |close| close.min(sparse));
    }

    /// The last checkpoint before record `n`.
    fn before(&self, n: u32) -> Option<Checkpoint> {
        let sparse = self.checkpoints.partition_point(|point| point.number < n);
        let sparse = sparse.checked_sub(1).map(|at| self.checkpoints[at]);
        let close = self.close.as_ref().and_then(|close| {
            close.partition_point(|point| point.number < n).checked_sub(1).map(|at| close[at])
        });
        if close.map(|point| point.number) > sparse.map(|point| point.number) {
            close
        } else {
            sparse
        }
    }

    /// Keeps close checkpoints from now on, without those that lie elsewhere.
    fn goes_back_to(&mut self, point: &Checkpoint) {
        let close = self.close.get_or_insert_default();
        let first = close.front().map_or(u32::MAX, |first| first.number);
        let last = close.back().map_or(0, |last| last.number.saturating_add(CLOSE));
        if !(first..=last).contains(&point.number) {
            close.clear();
        }
        self.find_due();
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
        let Some(point) = self.seeking.before(n) else { return Ok(()) };
        if self.failed.is_none() && (point.number..n).contains(&self.number) {
            return Ok(());
        }
        self.seeking.goes_back_to(&point);
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
        assert!(seeking.close.is_none());
        let numbers: Vec<u32> = seeking.checkpoints.iter().map(|point| point.number).collect();
        assert_eq!(numbers[0], 0);
        assert!(numbers.len() >= MAX_CHECKPOINTS / 2);
        assert!(numbers.windows(2).all(|pair| pair[1] - pair[0] <= seeking.spacing));
    }

    /// Reads on from one record to another, as a reader does.
    fn read_on(seeking: &mut Seeking, from: u32, to: u32) {
        for number in from..to {
            if seeking.is_due(number) {
                seeking.keep(number, u64::from(number), number, Modal::default());
            }
        }
    }

    #[test]
    fn close_checkpoints_follow_the_place_that_was_gone_back_to() {
        let mut seeking = Seeking::new(true);
        read_on(&mut seeking, 0, 100_000);
        let before = |seeking: &Seeking, n| seeking.before(n).expect("a checkpoint").number;
        assert!(50_000 - before(&seeking, 50_000) > CLOSE);
        for place in [50_000, 49_999, 49_000, 90_000] {
            let point = seeking.before(place).expect("a checkpoint");
            seeking.goes_back_to(&point);
            read_on(&mut seeking, point.number, place);
            assert!(place - before(&seeking, place) <= CLOSE, "{place}");
        }
        let close = seeking.close.as_ref().expect("close ones");
        assert!(close.len() <= MAX_CLOSE);
        let numbers: Vec<u32> = close.iter().map(|point| point.number).collect();
        assert!(numbers.is_sorted());
    }
}
