//! FILEF, TEXT/READ and WRITE/: what a unit may be asked, and the host's files.

use fil_diag::Diag;

use super::report::fault;
use super::{Registers, Vm};
use crate::errors::RunCode;
use crate::host::{FileMode, Files, Host};
use crate::library::FileOp;
use crate::ops::Reg;
use crate::value::Shown;
use crate::value::Value::{self, Number};

impl<H: Host + ?Sized> Vm<'_, H> {
    /// FILEF with its unit in `base` and the name after it.
    pub(super) fn file(
        &mut self,
        registers: &Registers,
        op: FileOp,
        base: Reg,
    ) -> Result<Value, Box<Diag>> {
        self.burn()?;
        let unit = self.unit(registers, base)?;
        let no = |is: bool| Number(f64::from(u8::from(!is)));
        let mode = match op {
            FileOp::Read => FileMode::Read,
            FileOp::Write => FileMode::Write,
            FileOp::Append => FileMode::Append,
            FileOp::Close => {
                self.open_unit(unit, |_| true)?;
                granted(self.host.files())?.close(unit)?;
                self.state.units[unit] = None;
                return Ok(Number(0.0));
            }
            FileOp::Rewind => {
                self.open_unit(unit, |mode| mode == FileMode::Read)?;
                granted(self.host.files())?.rewind(unit)?;
                return Ok(Number(0.0));
            }
            FileOp::End => {
                self.open_unit(unit, |mode| mode == FileMode::Read)?;
                let at_end = granted(self.host.files())?.at_end(unit)?;
                return Ok(no(!at_end));
            }
            FileOp::Delete => {
                self.closed_unit(unit)?;
                let name = self.text(registers, base + 1)?;
                let name = self.state.texts.get(name);
                return Ok(no(granted(self.host.files())?.delete(name)?));
            }
        };
        self.closed_unit(unit)?;
        let name = self.text(registers, base + 1)?;
        let name = self.state.texts.get(name);
        let there = granted(self.host.files())?.open(unit, mode, name)?;
        if there {
            self.state.units[unit] = Some(mode);
        }
        Ok(no(there))
    }

    /// TEXT/READ
    pub(super) fn read_line(
        &mut self,
        registers: &mut Registers,
        base: Reg,
    ) -> Result<Value, Box<Diag>> {
        self.burn()?;
        let unit = self.unit(registers, base)?;
        self.open_unit(unit, |mode| mode == FileMode::Read)?;
        match granted(self.host.files())?.read_line(unit)? {
            Some(line) => self.made(registers, &line),
            None => Err(misuse(format!("no line is left on unit {}", unit + 1))),
        }
    }

    /// WRITE/ with its unit in `base` and the values after it.
    pub(super) fn write_line(
        &mut self,
        registers: &Registers,
        base: Reg,
        count: u16,
    ) -> Result<Value, Box<Diag>> {
        self.burn()?;
        let unit = self.unit(registers, base)?;
        self.open_unit(unit, |mode| mode != FileMode::Read)?;
        let line = self.joined(registers, base + 1, count - 1)?;
        if line.contains(['\n', '\r']) {
            return Err(misuse("a line can't hold the end of a line"));
        }
        granted(self.host.files())?.write_line(unit, &line)?;
        Ok(Number(0.0))
    }

    /// A unit number of FIL as an index.
    fn unit(&mut self, registers: &Registers, reg: Reg) -> Result<usize, Box<Diag>> {
        match self.number(registers, reg)? {
            1.0 => Ok(0),
            2.0 => Ok(1),
            other => Err(misuse(format!("there is no unit {}; units are 1 and 2", Shown(other)))),
        }
    }

    fn open_unit(&self, unit: usize, fits: fn(FileMode) -> bool) -> Result<(), Box<Diag>> {
        match self.state.units[unit] {
            Some(mode) if fits(mode) => Ok(()),
            Some(mode) => {
                let open = if mode == FileMode::Read { "read" } else { "write" };
                Err(misuse(format!("unit {} is open to {open}", unit + 1)))
            }
            None => Err(misuse(format!("unit {} is not open", unit + 1))),
        }
    }

    fn closed_unit(&self, unit: usize) -> Result<(), Box<Diag>> {
        match self.state.units[unit] {
            None => Ok(()),
            Some(_) => Err(misuse(format!("unit {} is open already", unit + 1))),
        }
    }
}

fn granted(files: Option<&mut dyn Files>) -> Result<&mut dyn Files, Box<Diag>> {
    files.ok_or_else(|| fault(RunCode::FilesNotGranted, "no folder is granted to scripts"))
}

fn misuse(message: impl Into<String>) -> Box<Diag> {
    fault(RunCode::FileUse, message)
}
