//! The work offset in force: its code, with the number that some codes have beside them.

use std::fmt;

use fil_machine::FunctionCode;

/// A work offset of the control: G54, G54.1 P3, G15 H2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkOffset {
    /// The code that chooses it.
    pub code: FunctionCode,
    /// The word beside the code, as its value; `None` for a code that has none.
    pub number: Option<i32>,
}

impl WorkOffset {
    /// The offset of a code of its own.
    pub const fn plain(code: FunctionCode) -> Self {
        WorkOffset { code, number: None }
    }

    /// One number for both, from which they are made again: whether there is a word in bit 32, its
    /// value below, the code above.
    pub(super) fn as_number(self) -> u64 {
        let word = self.number.map_or(0, |number| 1 << 32 | u64::from(number as u32));
        u64::from(self.code.in_tenths()) << 33 | word
    }

    pub(super) fn of_number(number: u64) -> Self {
        let word = (number >> 32 & 1 == 1).then_some(number as u32 as i32);
        WorkOffset { code: FunctionCode::tenths((number >> 33) as u32), number: word }
    }
}

impl fmt::Display for WorkOffset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.number {
            Some(number) => write!(f, "G{} with number {number}", self.code),
            None => write!(f, "G{}", self.code),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_offset_is_made_again_of_its_number() {
        let code = FunctionCode::tenths(541);
        for number in [None, Some(0), Some(3), Some(-1), Some(i32::MAX), Some(i32::MIN)] {
            let offset = WorkOffset { code, number };
            assert_eq!(WorkOffset::of_number(offset.as_number()), offset);
        }
    }
}
