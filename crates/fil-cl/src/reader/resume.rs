//! Reading on after an error, to find the further errors of a text.

use super::Reader;
use super::spline::Gathered;
use crate::errors::ClCode;
use crate::vocabulary::WordId;

impl Reader<'_> {
    /// Makes the reader go on behind the statement that was refused; false when the error
    /// does not lie in one statement, so that there is nothing to go on with.
    ///
    /// The records that follow are for finding errors only: what the refused statement left
    /// for them is not known.
    ///
    /// ```
    /// use fil_cl::{Options, Reader, Record, Vocabulary};
    ///
    /// let text = "GOTO / 1, 2, 3.4.5\nFEDRAT / 1..5\nFINI\n";
    /// let mut reader = Reader::new(text.as_bytes(), "part.ncl", Options::default());
    /// let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    /// let mut lines = Vec::new();
    /// loop {
    ///     match reader.read(&mut vocabulary, &mut record) {
    ///         Ok(true) => {}
    ///         Ok(false) => break,
    ///         Err(diag) => {
    ///             lines.push(diag.spans[0].line);
    ///             assert!(reader.resume());
    ///         }
    ///     }
    /// }
    /// assert_eq!(lines, [1, 2]);
    /// ```
    pub fn resume(&mut self) -> bool {
        let Some(diag) = &self.failed else { return true };
        let codes = BEYOND_A_STATEMENT.map(<&fil_diag::Code>::from);
        if codes.contains(&diag.code) {
            return false;
        }
        self.failed = None;
        self.pending.clear();
        self.made.clear();
        self.spline = Gathered::default();
        self.seeking.target = 0;
        self.modal.point = None;
        self.modal.in_arc = false;
        let forms = &mut self.modal.forms;
        (forms.expects, forms.direction, forms.normal) = (None, None, None);
        (forms.sweep, forms.told_sweep) = (None, None);
        true
    }

    /// True when the last statement was refused and the reader has not gone on.
    pub fn has_failed(&self) -> bool {
        self.failed.is_some()
    }

    /// True when the last error says that something did not come before the statement: it may
    /// only follow from a statement that was refused there.
    pub fn leans_on_earlier(&self) -> bool {
        self.leans
    }

    /// The major word of the statement that was read last, as far as it was understood.
    pub fn last_word(&self) -> Option<WordId> {
        self.major
    }
}

/// Errors of the input, of the text as a whole, and of going back in it.
const BEYOND_A_STATEMENT: [ClCode; 7] = [
    ClCode::ReadFailed,
    ClCode::BinaryData,
    ClCode::StatementTooLong,
    ClCode::NotSeekable,
    ClCode::NoSuchRecord,
    ClCode::TooManyWords,
    ClCode::TwoDialects,
];
