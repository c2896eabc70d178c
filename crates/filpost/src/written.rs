//! Records that are given to sections as they are written, and what they mean to the post.

use std::collections::BTreeMap;

use fil_cl::{Meaning, Record};
use fil_diag::Result;

use crate::error::RunCode;

/// How far back a record is kept: a section may save one and make it the current one again
/// when it has read on.
const KEPT: u32 = 4096;

/// Records whose form is not that of Creo, by their number.
#[derive(Default)]
pub(crate) struct Written {
    records: BTreeMap<u32, (Record, Meaning)>,
    /// Records before this one are forgotten.
    first: u32,
}

impl Written {
    /// Keeps a record that has a meaning.
    #[inline]
    pub fn keep(&mut self, record: &Record, meaning: Option<&Meaning>) {
        if let Some(meaning) = meaning {
            self.add(record, meaning);
        }
    }

    #[cold]
    fn add(&mut self, record: &Record, meaning: &Meaning) {
        self.records.insert(record.number, (record.clone(), meaning.clone()));
        let first = record.number.saturating_sub(KEPT);
        if self.first < first {
            self.first = first;
            self.records = self.records.split_off(&first);
        }
    }

    /// The records that the record of a number means where it is not in Creo's form; none for
    /// another one.
    pub fn meaning_of(&self, number: u32) -> &[Record] {
        if self.records.is_empty() {
            return &[];
        }
        match self.records.get(&number) {
            Some((_, Meaning::Records(records))) => records,
            _ => &[],
        }
    }

    /// What the post carries out for a record of the CL file; `None` where that is the record
    /// itself.
    ///
    /// # Errors
    /// A record that can't be brought to Creo's form, that FIL has changed, or that was read
    /// too long ago.
    pub fn meant_by(&self, record: &Record) -> Result<Option<Vec<Record>>> {
        if record.number < self.first {
            return RunCode::WrittenForm.err("the record was read too long ago");
        }
        match self.records.get(&record.number) {
            None => Ok(None),
            Some((written, _)) if !says_the_same(written, record) => {
                RunCode::WrittenForm.err("FIL has changed a record that is not in Creo's form")
            }
            Some((_, Meaning::Refused(diag))) => Err(diag.clone()),
            Some((_, Meaning::Records(records))) => {
                let number = record.number;
                let meant = records.iter().map(|record| Record { number, ..record.clone() });
                Ok(Some(meant.collect()))
            }
        }
    }
}

fn says_the_same(one: &Record, other: &Record) -> bool {
    one.major == other.major && one.data == other.data && one.text == other.text
}
