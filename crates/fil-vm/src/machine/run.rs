//! The loop over the operations: each in its usual case, on numbers. Whatever
//! is not that (a text, a name never set, a result out of range, no fuel) falls
//! out of the match, and `careful.rs` carries out the operation in full.

use fil_diag::Diag;

use super::{Registers, Spot, Vm};
use crate::host::Host;
use crate::module::ChunkId;
use crate::ops::Op;
use crate::value::Slot;

/// The number in a register; a NaN where it holds none.
macro_rules! number {
    ($registers:ident[$register:expr]) => {
        $registers[usize::from($register)].number()
    };
}

/// Puts a result into a register and goes on, when it is finite: one look says
/// that the operands were numbers and that the result is one.
macro_rules! done_if_finite {
    ($registers:ident[$dst:ident] = $result:expr) => {
        let result = $result;
        if result.is_finite() {
            $registers[usize::from($dst)] = Slot::from(result);
            continue;
        }
    };
}

/// Goes to `to` or on here, when one of two conditions is true; neither is
/// where an operand is no number.
macro_rules! jump_if {
    ($pc:ident = $to:ident, $jump:expr, $stay:expr) => {
        if $jump {
            $pc = usize::from($to);
            continue;
        }
        if $stay {
            continue;
        }
    };
}

fn are_numbers(x: f64, y: f64) -> bool {
    !x.is_nan() && !y.is_nan()
}

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Runs a chunk and the macros it calls to the end.
    #[inline(never)]
    pub(super) fn execute(
        &mut self,
        registers: &mut Registers,
        mut chunk: ChunkId,
    ) -> Result<(), Box<Diag>> {
        let module = self.module;
        let mut code: &[Op] = &module.chunks[usize::from(chunk)].code;
        let mut pc = 0;
        loop {
            let op = code[pc];
            pc += 1;
            match op {
                Op::Move { dst, src } => {
                    let slot = registers[usize::from(src)];
                    if slot != Slot::UNSET {
                        registers[usize::from(dst)] = slot;
                        continue;
                    }
                }
                Op::Neg { dst, src } => {
                    done_if_finite!(registers[dst] = -number!(registers[src]));
                }
                Op::Add { dst, a, b } => {
                    done_if_finite!(registers[dst] = number!(registers[a]) + number!(registers[b]));
                }
                Op::Sub { dst, a, b } => {
                    done_if_finite!(registers[dst] = number!(registers[a]) - number!(registers[b]));
                }
                Op::Mul { dst, a, b } => {
                    done_if_finite!(registers[dst] = number!(registers[a]) * number!(registers[b]));
                }
                Op::AddProduct { dst, a, b } => {
                    let product = number!(registers[a]) * number!(registers[b]);
                    done_if_finite!(registers[dst] = number!(registers[dst]) + product);
                }
                Op::Div { dst, a, b } => {
                    done_if_finite!(registers[dst] = number!(registers[a]) / number!(registers[b]));
                }
                Op::Jump { to } => {
                    pc = usize::from(to);
                    continue;
                }
                Op::JumpBack { to } if self.fuel > 0 => {
                    self.fuel -= 1;
                    pc = usize::from(to);
                    continue;
                }
                Op::JumpEq { a, b, to } => {
                    let (x, y) = (number!(registers[a]), number!(registers[b]));
                    jump_if!(pc = to, x == y, are_numbers(x, y));
                }
                Op::JumpNe { a, b, to } => {
                    let (x, y) = (number!(registers[a]), number!(registers[b]));
                    jump_if!(pc = to, x != y && are_numbers(x, y), x == y);
                }
                Op::JumpLt { a, b, to } => {
                    let (x, y) = (number!(registers[a]), number!(registers[b]));
                    jump_if!(pc = to, x < y, x >= y);
                }
                Op::JumpLe { a, b, to } => {
                    let (x, y) = (number!(registers[a]), number!(registers[b]));
                    jump_if!(pc = to, x <= y, x > y);
                }
                Op::JumpTrue { a, to } => {
                    let x = number!(registers[a]);
                    jump_if!(pc = to, x == 1.0, x == 0.0);
                }
                Op::JumpFalse { a, to } => {
                    let x = number!(registers[a]);
                    jump_if!(pc = to, x == 0.0, x == 1.0);
                }
                Op::DoNext { var, base, body } => {
                    let step = number!(registers[base.wrapping_add(1)]);
                    let value = number!(registers[var]) + step;
                    // Upwards and once more: all else is rare.
                    if step > 0.0 && value <= number!(registers[base]) && self.fuel > 0 {
                        self.fuel -= 1;
                        registers[usize::from(var)] = Slot::from(value);
                        pc = usize::from(body);
                        continue;
                    }
                }
                Op::Call { macro_id } => {
                    self.spot = Spot { chunk, pc: pc - 1 };
                    self.enter_macro()?;
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
                    continue;
                }
                _ => {}
            }
            self.spot = Spot { chunk, pc: pc - 1 };
            if let Some(to) = self.careful(registers, op)? {
                pc = usize::from(to);
            }
        }
    }
}
