//! What the settings say about sequence numbers.

use crate::address::{Addresses, Slot};
use crate::commons::Commons;
use crate::letter::letters::N;
use crate::locations::{self as loc, SeqnoAlign};

/// The rules of sequence numbers.
#[derive(Clone, Debug, Default)]
pub struct Numbering {
    /// How N is written; `None` where the machine writes none.
    pub slot: Option<Slot>,
    /// Blocks are numbered until SEQNO says otherwise.
    pub on: bool,
    /// Every which block has a number, 1 or more.
    pub every: i32,
    /// From one number to the next.
    pub increment: Option<f64>,
    /// What is added to the first number.
    pub start_offset: f64,
    /// Stands in place of N where the program can be begun anew; `None` for no such marks.
    pub align: Option<u8>,
    /// The largest number; after it they begin again.
    pub max: f64,
}

impl Numbering {
    pub(crate) fn from_commons(addresses: &Addresses, commons: &Commons) -> Self {
        Numbering {
            slot: addresses.position(N).map(|position| *addresses.slot(position)),
            on: commons.read(loc::SEQNO_OFF_AT_START),
            every: commons.int(loc::SEQNO_EVERY).max(1),
            increment: commons.dbl_opt(loc::SEQNO_INCREMENT),
            start_offset: commons.dbl_opt(loc::SEQNO_START_OFFSET).unwrap_or(0.0),
            align: commons
                .read(loc::TAPE_ALIGN_CHAR)
                .filter(|_| commons.read(loc::SEQNO_ALIGN) == SeqnoAlign::ToolChanges)
                .map(|mark| mark as u8),
            max: commons.dbl_opt(loc::SEQNO_MAX).unwrap_or(f64::INFINITY),
        }
    }
}
