//! Texts in the machine: joining them, and room for new ones.

use fil_diag::Diag;

use super::report::fault;
use super::{Registers, Vm};
use crate::errors::RunCode;
use crate::host::Host;
use crate::ops::Reg;
use crate::value::Value::{self, Empty, Number, Text, Unset, Word};
use crate::value::{EMPTY, Shown, TextId};

impl<H: Host + ?Sized> Vm<'_, H> {
    /// A register's text.
    pub(super) fn text(&mut self, registers: &Registers, reg: Reg) -> Result<TextId, Box<Diag>> {
        match self.read(registers, reg)? {
            Text(id) => {
                self.burn_for(self.state.texts.get(id).len())?;
                Ok(id)
            }
            Number(number) => {
                let message = format!("{} is a number; a text is needed here", Shown(number));
                Err(fault(RunCode::WrongType, message))
            }
            Word(_) | Empty | Unset => Err(fault(RunCode::WrongType, "a text is needed here")),
        }
    }

    /// `TEXT/…`: texts and numbers of consecutive registers, one after the other.
    #[inline(never)]
    pub(super) fn join(
        &mut self,
        registers: &mut Registers,
        base: Reg,
        count: u16,
    ) -> Result<Value, Box<Diag>> {
        let joined = self.joined(registers, base, count)?;
        self.new_text(registers, &joined)
    }

    /// The same as a string.
    pub(super) fn joined(
        &mut self,
        registers: &Registers,
        base: Reg,
        count: u16,
    ) -> Result<String, Box<Diag>> {
        for offset in 0..count {
            // Neither EMPTY nor the code of a word may end up as a number in a block.
            let reg = base.wrapping_add(offset);
            match self.read(registers, reg)? {
                Empty => return Err(fault(RunCode::WrongType, "EMPTY can't be part of a text")),
                Word(_) => return Err(self.not_a_number(registers, reg)),
                Number(_) | Text(_) | Unset => {}
            }
        }
        self.message(registers, base, count)
    }

    /// The same for people, who may read EMPTY.
    pub(super) fn message(
        &mut self,
        registers: &Registers,
        base: Reg,
        count: u16,
    ) -> Result<String, Box<Diag>> {
        let mut joined = String::new();
        for offset in 0..count {
            match self.read(registers, base.wrapping_add(offset))? {
                Text(id) => joined.push_str(self.state.texts.get(id)),
                Number(number) => joined.push_str(&Shown(number).to_string()),
                Word(id) => joined.push_str(self.vocab.name(id)),
                Empty | Unset => joined.push_str(&Shown(EMPTY).to_string()),
            }
            if joined.len() > self.limits.text_bytes {
                return Err(self.too_much_text());
            }
        }
        self.burn_for(joined.len())?;
        Ok(joined)
    }

    /// A text just made, as a value.
    pub(super) fn made(
        &mut self,
        registers: &mut Registers,
        text: &str,
    ) -> Result<Value, Box<Diag>> {
        self.burn_for(text.len())?;
        self.new_text(registers, text)
    }

    /// Adds a text to the arena, cleaning it up first where it is full.
    pub(super) fn new_text(
        &mut self,
        registers: &mut Registers,
        text: &str,
    ) -> Result<Value, Box<Diag>> {
        let limit = self.limits.text_bytes;
        if let Ok(id) = self.state.texts.add(text, limit) {
            return Ok(Text(id));
        }
        if self.state.lent {
            return Err(self.too_much_text());
        }
        // Cleaning up looks at every register; the fuel keeps a script that
        // sits at the limit from making each text cost that much.
        for _ in 0..1000 {
            self.burn()?;
        }
        let state = &mut *self.state;
        state.texts.keep(registers.iter_mut().chain(&mut state.arrays));
        match state.texts.add(text, limit) {
            Ok(id) => Ok(Text(id)),
            Err(_) => Err(self.too_much_text()),
        }
    }

    pub(super) fn too_much_text(&self) -> Box<Diag> {
        let limit = self.limits.text_bytes;
        fault(RunCode::TextLimit, format!("texts would take more than {limit} bytes"))
    }
}
