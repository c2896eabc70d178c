//! Calls of the library: functions and TEXT/ forms on texts, clock and commands.

use std::cmp::Ordering;

use fil_cl::Word;
use fil_cl::layout::takes_text;
use fil_diag::{Diag, letter_case};

use super::report::fault;
use super::{Registers, Vm};
use crate::errors::RunCode;
use crate::host::Host;
use crate::library::{Library, LibraryCall};
use crate::ops::Reg;
use crate::texts;
use crate::value::Shown;
use crate::value::Value::{self, Number};

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Carries out a call.
    #[inline(never)]
    pub(super) fn library(
        &mut self,
        registers: &mut Registers,
        call: u16,
    ) -> Result<Value, Box<Diag>> {
        let call = &self.module.calls[usize::from(call)];
        let base = call.base;
        match call.library {
            Library::Length => {
                let text = self.text(registers, base)?;
                Ok(Number(texts::length(self.state.texts.get(text)) as f64))
            }
            Library::Position => self.position(registers, call),
            Library::Compare => {
                let (one, other) = (self.text(registers, base)?, self.text(registers, base + 1)?);
                let texts = &self.state.texts;
                Ok(Number(match texts.get(one).cmp(texts.get(other)) {
                    Ordering::Less => -1.0,
                    Ordering::Equal => 0.0,
                    Ordering::Greater => 1.0,
                }))
            }
            Library::CharacterCode => self.character_code(registers, call),
            Library::ToNumber => {
                let text = self.text(registers, base)?;
                let text = self.state.texts.get(text);
                texts::number(text)
                    .map(Number)
                    .ok_or_else(|| fault(RunCode::NotANumber, format!("'{text}' is no number")))
            }
            Library::WholeToText | Library::ToText => self.number_to_text(registers, call),
            Library::RecordText => self.record_text(registers),
            Library::Part => self.part(registers, call),
            Library::Last => {
                let text = self.text(registers, base)?;
                let count = self.size(registers, base + 1)?;
                let text = self.state.texts.get(text);
                let last = texts::last(text, count).map(str::to_string);
                let last =
                    last.ok_or_else(|| outside(format!("'{text}' has fewer than {count}")))?;
                self.made(registers, &last)
            }
            Library::Repeat => self.repeat(registers, base),
            Library::Omit | Library::Modify => self.modify(registers, call),
            Library::Upper | Library::Lower => {
                let text = self.text(registers, base)?;
                let text = self.state.texts.get(text);
                let changed = match call.library {
                    Library::Upper => letter_case::upper(text),
                    _ => letter_case::lower(text),
                };
                self.made(registers, &changed)
            }
            Library::ReadLine => self.read_line(registers, base),
            Library::WriteLine => self.write_line(registers, base, call.count),
            Library::Refuse => {
                let message = self.message(registers, base, call.count)?;
                Err(fault(RunCode::Refused, message))
            }
            Library::Warn => self.warn(registers, base, call.count),
            Library::File(op) => self.file(registers, op, base),
            Library::Date | Library::Time => self.clock(registers, call),
            Library::Spawn => self.spawn(registers, base),
            Library::TotalsText(list) => self.totals_text(registers, list, base),
        }
    }

    fn position(&mut self, registers: &Registers, call: &LibraryCall) -> Result<Value, Box<Diag>> {
        let (text, wanted) =
            (self.text(registers, call.base)?, self.text(registers, call.base + 1)?);
        let from = if call.count > 2 { self.count_from_one(registers, call.base + 2)? } else { 1 };
        let (text, wanted) = (self.state.texts.get(text), self.state.texts.get(wanted));
        if wanted.is_empty() {
            return Err(outside("an empty text is nowhere"));
        }
        Ok(Number(texts::position(text, wanted, from).unwrap_or(0) as f64))
    }

    fn character_code(
        &mut self,
        registers: &Registers,
        call: &LibraryCall,
    ) -> Result<Value, Box<Diag>> {
        let text = self.text(registers, call.base)?;
        let n = if call.count > 1 { self.count_from_one(registers, call.base + 1)? } else { 1 };
        let text = self.state.texts.get(text);
        match text.chars().nth(n - 1) {
            Some(character) => Ok(Number(f64::from(u32::from(character)))),
            None => Err(outside(format!("'{text}' has no character {n}"))),
        }
    }

    /// TEXT/CONVI, TEXT/CONVF and the functions of the second.
    fn number_to_text(
        &mut self,
        registers: &mut Registers,
        call: &LibraryCall,
    ) -> Result<Value, Box<Diag>> {
        let refused = |message: String| fault(RunCode::Conversion, message);
        let number = self.number(registers, call.base)?;
        let width = if call.count > 1 { self.size(registers, call.base + 1)? } else { 0 };
        if width > self.limits.text_bytes {
            return Err(self.too_much_text());
        }
        let decimals = match call.library {
            Library::WholeToText if number.fract() == 0.0 => Some(0),
            Library::WholeToText => {
                return Err(refused(format!("{} is not whole", Shown(number))));
            }
            _ if call.count > 2 => Some(self.size(registers, call.base + 2)?),
            _ => None,
        };
        if let Some(decimals) = decimals.filter(|decimals| *decimals > texts::MOST_DECIMALS) {
            let most = texts::MOST_DECIMALS;
            return Err(refused(format!("{decimals} decimals; {most} are the most")));
        }
        let Some(text) = texts::digits(number, decimals, call.rules) else {
            return Err(refused(format!("{} has too many digits", Shown(number))));
        };
        let Some(written) = texts::in_width(text, width, call.rules) else {
            return Err(refused(format!("{} is wider than {width}", Shown(number))));
        };
        self.made(registers, &written)
    }

    fn record_text(&mut self, registers: &mut Registers) -> Result<Value, Box<Diag>> {
        let record = self.current()?;
        let is_one_text = matches!(record.data[..], [Word::Text { .. }]);
        if !takes_text(record.major) && !is_one_text {
            let name = self.vocab.name(record.major);
            return Err(fault(RunCode::Missing, format!("a {name} record holds no text")));
        }
        let words = record.data.iter().filter(|word| matches!(word, Word::Text { .. }));
        let text: String = words.map(|word| record.text_of(*word)).collect();
        self.made(registers, &text)
    }

    fn part(&mut self, registers: &mut Registers, call: &LibraryCall) -> Result<Value, Box<Diag>> {
        let text = self.text(registers, call.base)?;
        let from = self.count_from_one(registers, call.base + 1)?;
        let given = match call.count {
            2 => None,
            _ => Some(self.size(registers, call.base + 2)?),
        };
        let text = self.state.texts.get(text);
        let to = given.unwrap_or_else(|| texts::length(text));
        let Some(part) = texts::part(text, from, to).map(str::to_string) else {
            return Err(outside(format!("'{text}' has no characters {from} to {to}")));
        };
        self.made(registers, &part)
    }

    fn repeat(&mut self, registers: &mut Registers, base: Reg) -> Result<Value, Box<Diag>> {
        let text = self.text(registers, base)?;
        let times = self.size(registers, base + 1)?;
        let text = self.state.texts.get(text);
        if text.len().checked_mul(times).is_none_or(|size| size > self.limits.text_bytes) {
            return Err(self.too_much_text());
        }
        let repeated = text.repeat(times);
        self.made(registers, &repeated)
    }

    /// TEXT/OMIT and TEXT/MODIFY.
    fn modify(
        &mut self,
        registers: &mut Registers,
        call: &LibraryCall,
    ) -> Result<Value, Box<Diag>> {
        let text = self.text(registers, call.base)?;
        let old = self.text(registers, call.base + 1)?;
        let new = match call.count {
            2 => None,
            _ => Some(self.text(registers, call.base + 2)?),
        };
        let texts = &self.state.texts;
        let (text, old) = (texts.get(text), texts.get(old));
        let new = new.map_or("", |new| texts.get(new));
        if old.is_empty() {
            return Err(outside("an empty text can't be looked for"));
        }
        let found = text.matches(old).count();
        let size = text.len() - found * old.len();
        if new.len().checked_mul(found).is_none_or(|grown| size + grown > self.limits.text_bytes) {
            return Err(self.too_much_text());
        }
        let changed = text.replace(old, new);
        self.made(registers, &changed)
    }

    /// DATEF and TIMEF.
    fn clock(&mut self, registers: &mut Registers, call: &LibraryCall) -> Result<Value, Box<Diag>> {
        let Some(now) = self.host.now() else {
            let message = "the script asks for date or time";
            return Err(fault(RunCode::ClockNotGranted, message));
        };
        let is_date = call.library == Library::Date;
        if call.count == 0 {
            let both = now.to_string();
            let (date, time) = both.split_once('T').unwrap_or_default();
            return self.made(registers, if is_date { date } else { time });
        }
        let parts = if is_date { now.date() } else { now.time() };
        let n = self.number(registers, call.base)?;
        match [1.0, 2.0, 3.0].iter().position(|part| *part == n) {
            Some(part) => Ok(Number(parts[part])),
            None => Err(outside(format!("{} is none of the parts 1, 2 and 3", Shown(n)))),
        }
    }

    fn spawn(&mut self, registers: &Registers, base: Reg) -> Result<Value, Box<Diag>> {
        self.burn()?;
        self.host.check_cancelled()?;
        let command = self.text(registers, base)?;
        let command = self.state.texts.get(command);
        match self.host.spawn(command) {
            None => {
                let message = format!("'{command}' is not run");
                Err(fault(RunCode::SpawnNotGranted, message))
            }
            Some(Ok(status)) if status.is_finite() => Ok(Number(status)),
            Some(Ok(status)) => Err(fault(RunCode::HostFunction, format!("SPAWNF gives {status}"))),
            Some(Err(sentence)) => {
                Err(fault(RunCode::HostFunction, format!("SPAWNF('{command}'): {sentence}")))
            }
        }
    }

    /// WARN/ with its values in `base` and after it.
    fn warn(&mut self, registers: &Registers, base: Reg, count: u16) -> Result<Value, Box<Diag>> {
        // A warning is kept until the end of the run: a loop of them must end early.
        for _ in 0..1000 {
            self.burn()?;
        }
        let message = self.message(registers, base, count)?;
        self.warning(RunCode::Warned, message);
        Ok(Number(0.0))
    }

    /// A number of characters: whole and not negative.
    fn size(&mut self, registers: &Registers, reg: Reg) -> Result<usize, Box<Diag>> {
        let number = self.number(registers, reg)?;
        let whole = number as usize;
        if whole as f64 == number {
            return Ok(whole);
        }
        Err(outside(format!("{} is no number of characters", Shown(number))))
    }

    /// A position: whole and at least 1.
    fn count_from_one(&mut self, registers: &Registers, reg: Reg) -> Result<usize, Box<Diag>> {
        match self.size(registers, reg)? {
            0 => Err(outside("characters count from 1")),
            position => Ok(position),
        }
    }
}

fn outside(message: impl Into<String>) -> Box<Diag> {
    fault(RunCode::TextPosition, message)
}
