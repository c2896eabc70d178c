//! What the loop does not do itself: names never set, texts, limits, functions.

use fil_diag::Diag;

use super::report::fault;
use super::{FUEL_BETWEEN_CHECKS, Registers, Vm};
use crate::builtins::BUILTINS;
use crate::errors::RunCode;
use crate::functions::{Argument, Returned};
use crate::host::{CommonKind, Host};
use crate::ops::Reg;
use crate::value::Value::{self, Empty, Number, Text, Unset, Word};
use crate::value::{EMPTY, Shown};

/// Bytes of text that cost as much as one pass of a loop.
const BYTES_A_UNIT: usize = 64;

/// Most arguments a built-in function of numbers takes.
const MOST_ARGUMENTS: usize = 6;

impl<H: Host + ?Sized> Vm<'_, H> {
    /// A register's value; EMPTY with a warning where it was never set.
    pub(super) fn read(&mut self, registers: &Registers, reg: Reg) -> Result<Value, Box<Diag>> {
        match registers[usize::from(reg)].value() {
            Unset => {
                let module = self.module;
                self.warn_once(RunCode::NeverSet, || {
                    let name = module.names.get(&reg).map_or("a value", String::as_str);
                    format!("{name} was never set; read as EMPTY")
                });
                Ok(Empty)
            }
            value => Ok(value),
        }
    }

    /// A register's number.
    pub(super) fn number(&mut self, registers: &Registers, reg: Reg) -> Result<f64, Box<Diag>> {
        match self.read(registers, reg)? {
            Number(number) => Ok(number),
            _ => Err(self.not_a_number(registers, reg)),
        }
    }

    #[cold]
    pub(super) fn not_a_number(&self, registers: &Registers, reg: Reg) -> Box<Diag> {
        let name = self.module.names.get(&reg);
        match registers[usize::from(reg)].value() {
            Word(id) => {
                let word = self.vocab.name(id);
                let what = name.map_or(String::new(), |name| format!("{name} is "));
                let message = format!("{what}the word {word}; a number is needed here");
                let mut diag = fault(RunCode::WrongType, message);
                diag.hint = Some(
                    "Check which word of the record it is: POSTF(6,n) is 2 for a word, and \
                     COUPLF(word) gives the number after a word."
                        .to_string(),
                );
                diag
            }
            Text(id) => {
                let text = self.state.texts.get(id);
                fault(RunCode::WrongType, format!("'{text}' is a text; a number is needed here"))
            }
            _ => {
                let name = name.map_or("the value", String::as_str);
                let message = format!("{name} is EMPTY; a number is needed here");
                let mut diag = fault(RunCode::WrongType, message);
                diag.hint = Some("Test it first, as in IF(X.NE.POSTF(4))THEN.".to_string());
                diag
            }
        }
    }

    /// The number that a value compares as; `None` for a text.
    pub(super) fn compared(&self, value: Value) -> Option<f64> {
        match value {
            Number(number) => Some(number),
            Word(id) => Some(self.vocab.code(id)),
            Empty | Unset => Some(EMPTY),
            Text(_) => None,
        }
    }

    /// The number that a register compares as, or that a common keeps.
    ///
    /// # Errors
    /// A text.
    pub(super) fn plain(&mut self, registers: &Registers, reg: Reg) -> Result<f64, Box<Diag>> {
        let value = self.read(registers, reg)?;
        self.compared(value).ok_or_else(|| self.not_a_number(registers, reg))
    }

    pub(super) fn arithmetic(
        &mut self,
        registers: &Registers,
        a: Reg,
        b: Reg,
        sign: &str,
        operation: fn(f64, f64) -> f64,
    ) -> Result<Value, Box<Diag>> {
        let both = self.number(registers, a).and_then(|x| Ok((x, self.number(registers, b)?)));
        let (x, y) = both.map_err(|diag| join_hint(diag, sign))?;
        let result = operation(x, y);
        if result.is_finite() {
            return Ok(Number(result));
        }
        let message = format!("{} {sign} {} has no finite result", Shown(x), Shown(y));
        Err(fault(RunCode::Domain, message))
    }

    /// The product first, then the sum, each with its own message.
    pub(super) fn add_product(
        &mut self,
        registers: &Registers,
        dst: Reg,
        a: Reg,
        b: Reg,
    ) -> Result<Value, Box<Diag>> {
        let Number(product) = self.arithmetic(registers, a, b, "*", |x, y| x * y)? else {
            unreachable!("arithmetic gives a number")
        };
        let start = self.number(registers, dst)?;
        let sum = start + product;
        if sum.is_finite() {
            return Ok(Number(sum));
        }
        let message = format!("{} + {} has no finite result", Shown(start), Shown(product));
        Err(fault(RunCode::Domain, message))
    }

    pub(super) fn equal(
        &mut self,
        registers: &Registers,
        a: Reg,
        b: Reg,
    ) -> Result<bool, Box<Diag>> {
        match (self.read(registers, a)?, self.read(registers, b)?) {
            (Text(x), Text(y)) => Ok(self.state.texts.get(x) == self.state.texts.get(y)),
            // EMPTY means "nothing here", which a text never is.
            (Empty, Text(_)) | (Text(_), Empty) => Ok(false),
            _ => Ok(self.plain(registers, a)? == self.plain(registers, b)?),
        }
    }

    pub(super) fn order(
        &mut self,
        registers: &Registers,
        a: Reg,
        b: Reg,
    ) -> Result<std::cmp::Ordering, Box<Diag>> {
        match (self.read(registers, a)?, self.read(registers, b)?) {
            (Text(x), Text(y)) => Ok(self.state.texts.get(x).cmp(self.state.texts.get(y))),
            _ => {
                let (x, y) = (self.plain(registers, a)?, self.plain(registers, b)?);
                // Numbers in registers are finite; adding 0 makes -0 equal to 0.
                Ok((x + 0.0).total_cmp(&(y + 0.0)))
            }
        }
    }

    /// A value used as a condition.
    pub(super) fn truth(&mut self, registers: &Registers, reg: Reg) -> Result<bool, Box<Diag>> {
        let number = self.number(registers, reg)?;
        if number == 1.0 || number == 0.0 {
            return Ok(number == 1.0);
        }
        Err(fault(RunCode::NotLogical, format!("the condition is {}", Shown(number))))
    }

    /// Takes one unit of fuel.
    #[inline]
    pub(super) fn burn(&mut self) -> Result<(), Box<Diag>> {
        if self.fuel == 0 {
            self.refuel()?;
        }
        self.fuel -= 1;
        Ok(())
    }

    /// Takes fuel for work on a text: a script that copies long texts pays for it.
    pub(super) fn burn_for(&mut self, bytes: usize) -> Result<(), Box<Diag>> {
        let mut cost = (bytes / BYTES_A_UNIT) as u64;
        while self.fuel < cost {
            cost -= std::mem::take(&mut self.fuel);
            self.refuel()?;
        }
        self.fuel -= cost;
        Ok(())
    }

    /// Asks whether the run is cancelled, and gives fuel until the next time.
    #[cold]
    fn refuel(&mut self) -> Result<(), Box<Diag>> {
        self.host.check_cancelled()?;
        self.fuel = self.reserve.min(FUEL_BETWEEN_CHECKS);
        self.reserve -= self.fuel;
        if self.fuel == 0 { Err(self.out_of_fuel()) } else { Ok(()) }
    }

    #[cold]
    fn out_of_fuel(&self) -> Box<Diag> {
        let limit = self.limits.fuel;
        fault(
            RunCode::OutOfFuel,
            format!("the limit of {limit} passes, calls and reads is used up"),
        )
    }

    pub(super) fn enter_macro(&mut self) -> Result<(), Box<Diag>> {
        self.burn()?;
        if self.state.frames.len() >= self.limits.call_depth {
            let limit = self.limits.call_depth;
            return Err(fault(RunCode::CallDepth, format!("more than {limit} calls are open")));
        }
        self.state.frames.push(self.spot);
        Ok(())
    }

    /// Settles last value and step of a DO; true when there is a first pass.
    pub(super) fn enter_loop(
        &mut self,
        registers: &mut Registers,
        var: Reg,
        base: Reg,
    ) -> Result<bool, Box<Diag>> {
        let step_at = base.wrapping_add(1);
        let (last, step) = (self.number(registers, base)?, self.number(registers, step_at)?);
        let first = self.number(registers, var)?;
        if step == 0.0 {
            return Err(fault(RunCode::ZeroStep, "the step of the loop is 0"));
        }
        registers[usize::from(base)] = last.into();
        registers[usize::from(step_at)] = step.into();
        Ok(if step > 0.0 { first <= last } else { first >= last })
    }

    /// Steps the variable of a DO; true when there is another pass.
    pub(super) fn next_pass(
        &mut self,
        registers: &mut Registers,
        var: Reg,
        base: Reg,
    ) -> Result<bool, Box<Diag>> {
        self.burn()?;
        let step = registers[usize::from(base.wrapping_add(1))].number();
        let value = self.number(registers, var)? + step;
        if !value.is_finite() {
            return Err(fault(RunCode::Domain, "the loop variable passes all numbers"));
        }
        registers[usize::from(var)] = value.into();
        let last = registers[usize::from(base)].number();
        Ok(if step > 0.0 { value <= last } else { value >= last })
    }

    /// Position of an array element in the array store.
    #[inline]
    pub(super) fn element(
        &mut self,
        registers: &Registers,
        array: u16,
        index: Reg,
    ) -> Result<usize, Box<Diag>> {
        let module = self.module;
        let shape = &module.arrays[usize::from(array)];
        let mut number = registers[usize::from(index)].number();
        if number.is_nan() {
            number = self.number(registers, index)?;
        }
        let whole = number as usize;
        if whole >= 1 && whole <= shape.len && whole as f64 == number {
            return Ok(shape.start + whole - 1);
        }
        let message = format!("{}({}) is outside of 1 to {}", shape.name, Shown(number), shape.len);
        Err(fault(RunCode::Subscript, message))
    }

    pub(super) fn unset_element(&mut self, array: u16) -> Result<Value, Box<Diag>> {
        let name = &self.module.arrays[usize::from(array)].name;
        self.warn_once(RunCode::NeverSet, || {
            format!("an element of {name} was never set; read as EMPTY")
        });
        Ok(Empty)
    }

    pub(super) fn function(
        &mut self,
        registers: &Registers,
        function: u16,
        base: Reg,
        arity: u16,
        body: fn(&[f64]) -> Option<f64>,
    ) -> Result<Value, Box<Diag>> {
        let mut arguments = [0.0; MOST_ARGUMENTS];
        let arguments = &mut arguments[..usize::from(arity)];
        for (offset, argument) in arguments.iter_mut().enumerate() {
            *argument = self.number(registers, base.wrapping_add(offset as u16))?;
        }
        match body(arguments) {
            Some(result) if result.is_finite() => Ok(Number(result)),
            _ => {
                let shown: Vec<String> = arguments.iter().map(|x| Shown(*x).to_string()).collect();
                let name = BUILTINS[usize::from(function)].name;
                let message = format!("{name}({}) has no finite result", shown.join(","));
                Err(fault(RunCode::Domain, message))
            }
        }
    }

    pub(super) fn host_function(
        &mut self,
        registers: &mut Registers,
        function: u16,
        base: Reg,
    ) -> Result<Value, Box<Diag>> {
        self.host.check_cancelled()?;
        let index = usize::from(function);
        let count = self.module.host_arity.get(index).copied().unwrap_or(0);
        let mut values = Vec::with_capacity(usize::from(count));
        for offset in 0..count {
            values.push(self.read(registers, base.wrapping_add(offset))?);
        }
        let texts = &self.state.texts;
        let arguments: Vec<Argument<'_>> = values
            .iter()
            .map(|value| match value {
                Text(id) => Argument::Text(texts.get(*id)),
                other => Argument::Number(self.compared(*other).unwrap_or(EMPTY)),
            })
            .collect();
        let functions = self.functions;
        let name = functions.name(index);
        match functions.call(index, &arguments) {
            Ok(Returned::Number(number)) if number.is_finite() => Ok(Value::of(number)),
            Ok(Returned::Number(number)) => {
                RunCode::HostFunction.err(format!("{name} gives {number}"))
            }
            Ok(Returned::Text(text)) => self.made(registers, &text),
            Err(sentence) => RunCode::HostFunction.err(format!("{name}: {sentence}")),
        }
    }

    /// Last value written for a letter: DBLCOM 355+n.
    pub(super) fn last_written(
        &mut self,
        registers: &Registers,
        letter: Reg,
    ) -> Result<Value, Box<Diag>> {
        let number = self.number(registers, letter)?;
        let whole = number as u32;
        if !(1..=26).contains(&whole) || f64::from(whole) != number {
            let message = format!("{} is no letter; letters are 1 to 26", Shown(number));
            return Err(fault(RunCode::Missing, message));
        }
        self.host.common(CommonKind::Dbl, 355 + whole).map(Value::of)
    }

    pub(super) fn named_common(
        &mut self,
        registers: &Registers,
        name: Reg,
    ) -> Result<Value, Box<Diag>> {
        let Text(id) = self.read(registers, name)? else {
            return Err(fault(RunCode::WrongType, "COMF needs the name as a text"));
        };
        let name = self.state.texts.get(id);
        match self.host.named_common(name) {
            Some(value) => value.map(Value::of),
            None => Err(fault(RunCode::Missing, format!("no common is named '{name}'"))),
        }
    }

    pub(super) fn post_option(
        &mut self,
        registers: &mut Registers,
        name: Reg,
    ) -> Result<Value, Box<Diag>> {
        let Text(id) = self.read(registers, name)? else {
            return Err(fault(RunCode::WrongType, "OPTIONF needs the name as a text"));
        };
        let name = self.state.texts.get(id);
        match self.host.post_option(name) {
            Some(value) => match value? {
                Returned::Number(number) => Ok(Value::of(number)),
                Returned::Text(text) => self.made(registers, &text),
            },
            None => Err(fault(RunCode::Missing, format!("the post has no option '{name}'"))),
        }
    }

    pub(super) fn neighbour(&mut self, next: bool, word: u16) -> Result<Value, Box<Diag>> {
        let side = if next { "next" } else { "previous" };
        match self.host.neighbour(next, usize::from(word), self.vocab)? {
            Some(value) => Ok(Value::of(value)),
            None => Err(no_motion(side)),
        }
    }
}

/// NEXTF before no motion, or PREVF behind none.
#[cold]
fn no_motion(side: &str) -> Box<Diag> {
    let mut diag = fault(RunCode::Missing, format!("there is no {side} motion"));
    diag.hint = Some(
        match side {
            "previous" => {
                "Ask PREVF behind a first motion: keep a name that CIMFIL/ON,GOTO sets to 1."
            }
            _ => "Ask NEXTF before the last motion alone.",
        }
        .to_string(),
    );
    diag
}

/// Other languages join texts with a plus sign.
#[cold]
fn join_hint(mut diag: Box<Diag>, sign: &str) -> Box<Diag> {
    let mixed: &fil_diag::Code = RunCode::WrongType.into();
    if sign == "+" && diag.code == mixed && diag.hint.is_none() {
        diag.hint = Some("texts are joined by a list: TT=TEXT/AA,BB".to_string());
    }
    diag
}
