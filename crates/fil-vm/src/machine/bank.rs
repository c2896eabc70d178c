//! The register file of a machine, made when it is first used.

use std::ops::{Index, IndexMut};

use super::Registers;
use crate::value::Slot;

/// The registers of a machine. A program without scripts sets none, and half a megabyte of them
/// would cost more than the run of a short CL file.
#[derive(Debug, Default)]
pub(super) struct Bank(Option<Box<Registers>>);

impl Bank {
    /// The registers, to be worked on.
    #[inline]
    pub fn get(&mut self) -> &mut Registers {
        self.0.get_or_insert_with(unset)
    }
}

#[cold]
fn unset() -> Box<Registers> {
    let slots = vec![Slot::UNSET; 1 << 16].into_boxed_slice();
    match slots.try_into() {
        Ok(registers) => registers,
        Err(_) => unreachable!("the slice has the length of the array"),
    }
}

impl Index<usize> for Bank {
    type Output = Slot;

    fn index(&self, at: usize) -> &Slot {
        self.0.as_ref().map_or(&Slot::UNSET, |registers| &registers[at])
    }
}

impl IndexMut<usize> for Bank {
    fn index_mut(&mut self, at: usize) -> &mut Slot {
        &mut self.get()[at]
    }
}
