//! PROGF, TLISTF, OPERF and the texts beside them.

use fil_diag::Diag;

use super::report::fault;
use super::{Registers, Vm};
use crate::errors::RunCode;
use crate::host::Host;
use crate::ops::Reg;
use crate::totals::{TotalsList, TotalsOf, TotalsText, meant_by};
use crate::value::Shown;
use crate::value::Value::{self, Number};

impl<H: Host + ?Sized> Vm<'_, H> {
    /// A number of the whole program, of a tool or of an operation.
    pub(super) fn totals(
        &mut self,
        registers: &Registers,
        what: u16,
        index: Reg,
    ) -> Result<Value, Box<Diag>> {
        let (list, word) = meant_by(what);
        let of = match list {
            TotalsList::Program => TotalsOf::Program,
            TotalsList::Tools => TotalsOf::Tool(self.entry(registers, index)?),
            TotalsList::Operations => TotalsOf::Operation(self.entry(registers, index)?),
        };
        Ok(self.host.totals(of, word)?.map_or(Value::Empty, Number))
    }

    /// TEXT/PROG, TEXT/TLIST and TEXT/OPER.
    pub(super) fn totals_text(
        &mut self,
        registers: &mut Registers,
        list: TotalsList,
        base: Reg,
    ) -> Result<Value, Box<Diag>> {
        let of = match list {
            TotalsList::Program => TotalsText::Part,
            TotalsList::Tools => TotalsText::Tool(self.entry(registers, base)?),
            TotalsList::Operations => TotalsText::Operation(self.entry(registers, base)?),
        };
        let text = self.host.totals_text(of)?;
        self.made(registers, &text)
    }

    /// Number of an entry, from 0.
    fn entry(&mut self, registers: &Registers, reg: Reg) -> Result<usize, Box<Diag>> {
        let number = self.number(registers, reg)?;
        let whole = number as usize;
        if whole as f64 == number && whole > 0 {
            return Ok(whole - 1);
        }
        let message = format!("there is no number {}; entries count from 1", Shown(number));
        Err(fault(RunCode::Missing, message))
    }
}
