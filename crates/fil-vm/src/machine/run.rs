//! The loop over the operations. Only the usual case of each operation stands
//! here; what is rare (EMPTY, texts, errors) is in `slow.rs`.

use fil_diag::Diag;

use super::report::fault;
use super::{Registers, Spot, Vm};
use crate::builtins::{BUILTINS, Kind};
use crate::errors::RunCode;
use crate::host::Host;
use crate::module::ChunkId;
use crate::ops::Op;
use crate::value::Value::{self, Number};

/// Index of a register.
macro_rules! at {
    ($registers:ident[$register:expr]) => {
        $registers[usize::from($register)]
    };
}

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Runs a chunk and the macros it calls to the end.
    pub(super) fn execute(
        &mut self,
        registers: &mut Registers,
        chunk: ChunkId,
    ) -> Result<(), Box<Diag>> {
        let module = self.module;
        let mut chunk = chunk;
        let mut code: &[Op] = &module.chunks[usize::from(chunk)].code;
        let mut pc = 0;

        /// Notes the place, then evaluates.
        macro_rules! slow {
            ($e:expr) => {{
                self.spot = Spot { chunk, pc: pc - 1 };
                $e?
            }};
        }
        macro_rules! arithmetic {
            ($dst:ident, $a:ident, $b:ident, $op:tt) => {{
                let result = match (at!(registers[$a]), at!(registers[$b])) {
                    (Number(x), Number(y)) => x $op y,
                    _ => f64::NAN,
                };
                at!(registers[$dst]) = if result.is_finite() {
                    Number(result)
                } else {
                    let sign = stringify!($op);
                    slow!(self.arithmetic(registers, $a, $b, sign, |x, y| x $op y))
                };
            }};
        }
        macro_rules! compare {
            ($a:ident, $op:tt, $b:ident, $slow:ident) => {
                match (at!(registers[$a]), at!(registers[$b])) {
                    (Number(x), Number(y)) => x $op y,
                    _ => slow!(self.$slow(registers, $a, $b)),
                }
            };
        }
        macro_rules! jump_if {
            ($condition:expr, $to:ident) => {
                if $condition {
                    pc = usize::from($to);
                    continue;
                }
            };
        }

        macro_rules! burn {
            () => {
                if self.fuel == 0 {
                    slow!(self.burn());
                }
                self.fuel -= 1;
            };
        }

        loop {
            let op = code[pc];
            pc += 1;
            match op {
                Op::Move { dst, src } => {
                    at!(registers[dst]) = match at!(registers[src]) {
                        Value::Unset => slow!(self.read(registers, src)),
                        value => value,
                    };
                }
                Op::Neg { dst, src } => {
                    at!(registers[dst]) = match at!(registers[src]) {
                        Number(x) => Number(-x),
                        _ => Number(-slow!(self.number(registers, src))),
                    };
                }
                Op::Add { dst, a, b } => arithmetic!(dst, a, b, +),
                Op::Sub { dst, a, b } => arithmetic!(dst, a, b, -),
                Op::Mul { dst, a, b } => arithmetic!(dst, a, b, *),
                Op::AddProduct { dst, a, b } => {
                    let sum = match (at!(registers[dst]), at!(registers[a]), at!(registers[b])) {
                        (Number(sum), Number(x), Number(y)) => sum + x * y,
                        _ => f64::NAN,
                    };
                    at!(registers[dst]) = if sum.is_finite() {
                        Number(sum)
                    } else {
                        slow!(self.add_product(registers, dst, a, b))
                    };
                }
                Op::Div { dst, a, b } => arithmetic!(dst, a, b, /),
                Op::Pow { dst, a, b } => {
                    let power = slow!(self.arithmetic(registers, a, b, "**", f64::powf));
                    at!(registers[dst]) = power;
                }
                Op::Jump { to } => {
                    pc = usize::from(to);
                    continue;
                }
                Op::JumpBack { to } => {
                    burn!();
                    pc = usize::from(to);
                    continue;
                }
                Op::JumpEq { a, b, to } => jump_if!(compare!(a, ==, b, equal), to),
                Op::JumpNe { a, b, to } => jump_if!(compare!(a, !=, b, differ), to),
                Op::JumpLt { a, b, to } => jump_if!(compare!(a, <, b, less), to),
                Op::JumpLe { a, b, to } => jump_if!(compare!(a, <=, b, less_or_equal), to),
                Op::JumpTrue { a, to } => jump_if!(slow!(self.truth(registers, a)), to),
                Op::JumpFalse { a, to } => jump_if!(!slow!(self.truth(registers, a)), to),
                Op::DoEnter { var, base, exit } => {
                    jump_if!(!slow!(self.enter_loop(registers, var, base)), exit);
                }
                Op::DoNext { var, base, body } => {
                    burn!();
                    let step = at!(registers[base.wrapping_add(1)]);
                    let (Number(last), Number(step)) = (at!(registers[base]), step) else {
                        unreachable!("DoEnter has set both to numbers")
                    };
                    let value = match at!(registers[var]) {
                        Number(value) => value + step,
                        _ => slow!(self.number(registers, var)) + step,
                    };
                    at!(registers[var]) = Number(value);
                    jump_if!(if step > 0.0 { value <= last } else { value >= last }, body);
                    if !value.is_finite() {
                        slow!(Err(fault(RunCode::Domain, "the loop variable passes all numbers")));
                    }
                }
                Op::Load { dst, array, index } => {
                    let element = slow!(self.element(registers, array, index));
                    let value = match self.state.arrays[element] {
                        Value::Unset => slow!(self.unset_element(array)),
                        value => value,
                    };
                    at!(registers[dst]) = value;
                }
                Op::Store { array, index, src } => {
                    let element = slow!(self.element(registers, array, index));
                    self.state.arrays[element] = slow!(self.read(registers, src));
                }
                Op::Function { dst, function, base } => {
                    let Kind::Numbers(arity, body) = BUILTINS[usize::from(function)].kind else {
                        let Kind::Fold(body) = BUILTINS[usize::from(function)].kind else {
                            unreachable!("the compiler writes functions of numbers here")
                        };
                        let value = slow!(self.function(registers, function, base, 2, body));
                        at!(registers[dst]) = value;
                        continue;
                    };
                    let value = slow!(self.function(registers, function, base, arity, body));
                    at!(registers[dst]) = value;
                }
                Op::HostFunction { dst, function, base } => {
                    at!(registers[dst]) = slow!(self.host_function(registers, function, base));
                }
                Op::Library { dst, call } => {
                    at!(registers[dst]) = slow!(self.library(registers, call));
                }
                Op::TextJoin { dst, base, count } => {
                    at!(registers[dst]) = slow!(self.join(registers, base, count));
                }
                Op::RecordWord { dst, n } => {
                    at!(registers[dst]) = slow!(self.record_word(registers, f64::from(n)));
                }
                Op::Postf { dst, op, base } => {
                    at!(registers[dst]) = slow!(self.postf(registers, op, base));
                }
                Op::PostfDynamic { dst, base, count } => {
                    at!(registers[dst]) = slow!(self.postf_dynamic(registers, base, count));
                }
                Op::Couplet { dst, word, default } => {
                    at!(registers[dst]) = match slow!(self.couplet(word)) {
                        Some(value) => Number(value),
                        None => slow!(self.read(registers, default)),
                    };
                }
                Op::CoupletOrFail { dst, word } => {
                    at!(registers[dst]) = match slow!(self.couplet(word)) {
                        Some(value) => Number(value),
                        None => slow!(Err(self.no_couplet(word))),
                    };
                }
                Op::HasWord { dst, word } => {
                    let found = slow!(self.has_word(word));
                    at!(registers[dst]) = Number(f64::from(u8::from(found)));
                }
                Op::LastWritten { dst, letter } => {
                    at!(registers[dst]) = slow!(self.last_written(registers, letter));
                }
                Op::NamedCommon { dst, name } => {
                    at!(registers[dst]) = slow!(self.named_common(registers, name));
                }
                Op::NextMotion { dst, word } => {
                    at!(registers[dst]) = slow!(self.neighbour(true, word));
                }
                Op::PreviousMotion { dst, word } => {
                    at!(registers[dst]) = slow!(self.neighbour(false, word));
                }
                Op::Post { template } => slow!(self.post(registers, template)),
                Op::Call { macro_id } => {
                    slow!(self.enter_macro());
                    chunk = module.macros[usize::from(macro_id)];
                    code = &module.chunks[usize::from(chunk)].code;
                    pc = 0;
                    continue;
                }
                Op::Return => {
                    let Some(caller) = self.state.frames.pop() else { return Ok(()) };
                    chunk = caller.chunk;
                    code = &module.chunks[usize::from(chunk)].code;
                    pc = caller.pc + 1;
                }
            }
        }
    }
}
