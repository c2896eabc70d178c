//! One operation in full, with all that can be in its registers and go wrong.

use fil_diag::Diag;

use super::{Registers, Vm};
use crate::builtins::{BUILTINS, FunctionKind};
use crate::debug::Probe;
use crate::host::Host;
use crate::ops::{Op, Reg, Target};
use crate::value::Slot;
use crate::value::Value::{self, Number};

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Carries out an operation; where it jumps, gives the target.
    #[inline(never)]
    pub(super) fn careful(
        &mut self,
        registers: &mut Registers,
        op: Op,
    ) -> Result<Option<Target>, Box<Diag>> {
        let (dst, value) = match op {
            Op::RecordWord { dst, n } => (dst, self.record_word(registers, f64::from(n))?),
            Op::Postf { dst, op, base } => (dst, self.postf(registers, op, base)?),
            Op::Move { dst, src } => (dst, self.read(registers, src)?),
            Op::Neg { dst, src } => (dst, Number(-self.number(registers, src)?)),
            Op::Add { dst, a, b } => (dst, self.arithmetic(registers, a, b, "+", |x, y| x + y)?),
            Op::Sub { dst, a, b } => (dst, self.arithmetic(registers, a, b, "-", |x, y| x - y)?),
            Op::Mul { dst, a, b } => (dst, self.arithmetic(registers, a, b, "*", |x, y| x * y)?),
            Op::AddProduct { dst, a, b } => (dst, self.add_product(registers, dst, a, b)?),
            Op::Div { dst, a, b } => (dst, self.arithmetic(registers, a, b, "/", |x, y| x / y)?),
            Op::Pow { dst, a, b } => (dst, self.arithmetic(registers, a, b, "**", libm::pow)?),
            Op::Load { dst, array, index } => (dst, self.load(registers, array, index)?),
            Op::Function { dst, function, base } => (dst, self.builtin(registers, function, base)?),
            Op::HostFunction { dst, function, base } => {
                (dst, self.host_function(registers, function, base)?)
            }
            Op::Library { dst, call } => (dst, self.library(registers, call)?),
            Op::TextJoin { dst, base, count } => (dst, self.join(registers, base, count)?),
            Op::PostfDynamic { dst, base, count } => {
                (dst, self.postf_dynamic(registers, base, count)?)
            }
            Op::Couplet { dst, word, default } => match self.couplet(word)? {
                Some(value) => (dst, Number(value)),
                None => (dst, self.read(registers, default)?),
            },
            Op::CoupletOrFail { dst, word } => match self.couplet(word)? {
                Some(value) => (dst, Number(value)),
                None => return Err(self.no_couplet(word)),
            },
            Op::HasWord { dst, word } => (dst, Number(f64::from(u8::from(self.has_word(word)?)))),
            Op::LastWritten { dst, letter } => (dst, self.last_written(registers, letter)?),
            Op::NamedCommon { dst, name } => (dst, self.named_common(registers, name)?),
            Op::PostOption { dst, name } => (dst, self.post_option(registers, name)?),
            Op::NextMotion { dst, word } => (dst, self.neighbour(true, word)?),
            Op::ToolDiameter { dst } => {
                (dst, self.host.tool_diameter(self.vocab)?.map_or(Value::Empty, Number))
            }
            Op::NextTool { dst } => (dst, self.host.next_tool()?.map_or(Value::Empty, Number)),
            Op::Totals { dst, what, index } => (dst, self.totals(registers, what, index)?),
            Op::PreviousMotion { dst, word } => (dst, self.neighbour(false, word)?),
            _ => return self.act(registers, op),
        };
        registers[usize::from(dst)] = Slot::from(value);
        Ok(None)
    }

    /// The operations that do not end with a value in a register.
    fn act(&mut self, registers: &mut Registers, op: Op) -> Result<Option<Target>, Box<Diag>> {
        let (jumps, to) = match op {
            Op::JumpBack { to } => {
                self.burn()?;
                (true, to)
            }
            Op::JumpEq { a, b, to } => (self.equal(registers, a, b)?, to),
            Op::JumpNe { a, b, to } => (!self.equal(registers, a, b)?, to),
            Op::JumpLt { a, b, to } => (self.order(registers, a, b)?.is_lt(), to),
            Op::JumpLe { a, b, to } => (self.order(registers, a, b)?.is_le(), to),
            Op::JumpTrue { a, to } => (self.truth(registers, a)?, to),
            Op::JumpFalse { a, to } => (!self.truth(registers, a)?, to),
            Op::DoEnter { var, base, exit } => (!self.enter_loop(registers, var, base)?, exit),
            Op::DoNext { var, base, body } => (self.next_pass(registers, var, base)?, body),
            Op::Store { array, index, src } => {
                let element = self.element(registers, array, index)?;
                self.state.arrays[element] = Slot::from(self.read(registers, src)?);
                return Ok(None);
            }
            Op::Post { template } => {
                self.post(registers, template)?;
                return Ok(None);
            }
            Op::Statement => return self.probe(registers, Probe::Statement),
            Op::Enter => return self.probe(registers, Probe::Enter),
            Op::Leave => return self.probe(registers, Probe::Leave),
            Op::Branch { number } => return self.probe(registers, Probe::Branch(number)),
            _ => unreachable!("the loop carries out {op:?} itself"),
        };
        Ok(jumps.then_some(to))
    }

    fn load(&mut self, registers: &Registers, array: u16, index: Reg) -> Result<Value, Box<Diag>> {
        let element = self.element(registers, array, index)?;
        match self.state.arrays[element].value() {
            Value::Unset => self.unset_element(array),
            value => Ok(value),
        }
    }

    /// A built-in function of numbers.
    fn builtin(
        &mut self,
        registers: &Registers,
        function: u16,
        base: Reg,
    ) -> Result<Value, Box<Diag>> {
        let (arity, body) = match BUILTINS[usize::from(function)].kind {
            FunctionKind::Numbers(arity, body) => (arity, body),
            FunctionKind::Fold(body) => (2, body),
            _ => unreachable!("the compiler writes functions of numbers here"),
        };
        self.function(registers, function, base, arity, body)
    }
}
