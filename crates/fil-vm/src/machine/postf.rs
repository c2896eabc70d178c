//! The POSTF operations and the record functions of our own.

use fil_cl::record::FIRST_DATA;
use fil_cl::{Record, Word};
use fil_diag::Diag;

use super::report::fault;
use super::{Registers, Vm};
use crate::errors::RunCode;
use crate::host::{CommonKind, Host};
use crate::ops::Reg;
use crate::postf::PostfOp;
use crate::value::Value::{self, Empty, Number, Text, Unset};
use crate::value::{EMPTY, Shown};

/// Value of POSTF calls that only do something.
const DONE: Value = Number(0.0);
/// Status of a read at the end of the CL file.
const AT_END: Value = Number(1.0);

impl<H: Host + ?Sized> Vm<'_, H> {
    /// POSTF with a number known only now.
    pub(super) fn postf_dynamic(
        &mut self,
        registers: &mut Registers,
        base: Reg,
        count: u16,
    ) -> Result<Value, Box<Diag>> {
        let number = self.number(registers, base)?;
        let Some(op) = self.module.compat.operation(number) else {
            let message = format!("POSTF({}) has no known meaning", Shown(number));
            return Err(fault(RunCode::BadPostf, message));
        };
        let wanted = op.info().arguments.len();
        if wanted != usize::from(count) - 1 {
            let message = format!(
                "POSTF({}) takes {wanted} arguments after the number, {} are given",
                Shown(number),
                count - 1
            );
            return Err(fault(RunCode::BadPostf, message));
        }
        self.postf(registers, op as u16, base.wrapping_add(1))
    }

    /// A POSTF operation with its arguments in consecutive registers.
    pub(super) fn postf(
        &mut self,
        registers: &mut Registers,
        op: u16,
        base: Reg,
    ) -> Result<Value, Box<Diag>> {
        let Some(op) = PostfOp::from_index(op) else {
            unreachable!("the compiler writes indices of the table")
        };
        let second = base.wrapping_add(1);
        match op {
            PostfOp::GetCommon => {
                let (kind, location) = self.common_address(registers, base)?;
                self.host.common(kind, location).map(Value::of)
            }
            PostfOp::SetCommon => {
                let (kind, location) = self.common_address(registers, base)?;
                let value = self.plain(registers, base.wrapping_add(2))?;
                let warning = if value == EMPTY {
                    self.host.clear_common(kind, location)?
                } else {
                    self.host.set_common(kind, location, value)?
                };
                self.warn_of(warning);
                Ok(DONE)
            }
            PostfOp::ClearCommon => {
                let (kind, location) = self.common_address(registers, base)?;
                let warning = self.host.clear_common(kind, location)?;
                self.warn_of(warning);
                Ok(DONE)
            }
            PostfOp::Empty => Ok(Empty),
            PostfOp::Length => Ok(Number(self.current()?.len() as f64)),
            PostfOp::Class => {
                let n = self.whole(registers, base)?;
                Ok(Number(f64::from(self.current()?.class(n))))
            }
            PostfOp::Word => {
                let n = self.number(registers, base)?;
                self.record_word(registers, n)
            }
            PostfOp::Find => {
                let from = self.whole(registers, base)?;
                let code = self.plain(registers, second)?;
                self.find_code(from, code)
            }
            PostfOp::SetWord | PostfOp::Insert => {
                let n = self.whole(registers, base)?;
                let value = self.read(registers, second)?;
                self.change_word(op, n, value)
            }
            PostfOp::Delete => {
                let n = self.whole(registers, base)?;
                let done = self.current_mut()?.delete(n);
                self.changed(done, n)
            }
            PostfOp::Resize => {
                let n = self.whole(registers, base)?;
                let done = self.current_mut()?.resize(n);
                self.changed(done, n)
            }
            PostfOp::Process => self.process(registers),
            PostfOp::Next => self.next(),
            PostfOp::Back => match self.current()?.number {
                0 | 1 => Ok(AT_END),
                number => self.seek(number - 1),
            },
            PostfOp::Seek => {
                let number = self.whole(registers, base)?;
                u32::try_from(number).map_or(Ok(AT_END), |number| self.seek(number))
            }
            PostfOp::Number => Ok(Number(f64::from(self.current()?.number))),
            PostfOp::Save => {
                let copy = self.current()?.clone();
                self.state.saved = Some(copy);
                Ok(DONE)
            }
            PostfOp::Restore => self.restore(),
            PostfOp::Trace => {
                let on = self.truth(registers, base)?;
                self.host.trace(on);
                Ok(DONE)
            }
        }
    }

    /// POSTF(7,n)
    pub(super) fn record_word(
        &mut self,
        registers: &mut Registers,
        n: f64,
    ) -> Result<Value, Box<Diag>> {
        let at = n as usize;
        let record = self.current()?;
        if at as f64 != n || at == 0 {
            let message = format!("words count from 1; there is no word {}", Shown(n));
            return Err(fault(RunCode::BadWordNumber, message));
        }
        if let Some(word) = record.vocabulary_word(at) {
            return Ok(Value::Word(word));
        }
        if let Some(value) = record.value(at, self.vocab) {
            return Ok(Value::of(value));
        }
        match record.data_word(at) {
            Some(word @ Word::Text { .. }) => {
                let text = record.text_of(word).to_string();
                self.new_text(registers, &text)
            }
            Some(_) => Ok(Empty),
            None => {
                let last = record.len();
                self.warn_once(RunCode::PastEnd, || {
                    format!("the record ends with word {last}; word {at} is read as EMPTY")
                });
                Ok(Empty)
            }
        }
    }

    /// The number after a minor word, from word 4 on.
    pub(super) fn couplet(&mut self, word: u16) -> Result<Option<f64>, Box<Diag>> {
        let id = self.module.words[usize::from(word)];
        Ok(self.current()?.number_after(id))
    }

    #[cold]
    pub(super) fn no_couplet(&self, word: u16) -> Box<Diag> {
        let name = self.vocab.name(self.module.words[usize::from(word)]);
        fault(RunCode::Missing, format!("no number follows {name} in this record"))
    }

    pub(super) fn has_word(&mut self, word: u16) -> Result<bool, Box<Diag>> {
        let id = self.module.words[usize::from(word)];
        Ok(self.current()?.has(id))
    }

    pub(super) fn current(&self) -> Result<&Record, Box<Diag>> {
        self.record.as_deref().ok_or_else(no_record)
    }

    fn current_mut(&mut self) -> Result<&mut Record, Box<Diag>> {
        self.record.as_deref_mut().ok_or_else(no_record)
    }

    fn common_address(
        &mut self,
        registers: &Registers,
        base: Reg,
    ) -> Result<(CommonKind, u32), Box<Diag>> {
        let kind = self.number(registers, base)?;
        let location = self.number(registers, base.wrapping_add(1))?;
        let Some(kind) = CommonKind::from_type(kind) else {
            let message = format!("type {} is none of 1 INTCOM, 2 RELCOM, 3 DBLCOM", Shown(kind));
            return Err(fault(RunCode::BadPostf, message));
        };
        let whole = location as u32;
        if whole == 0 || f64::from(whole) != location {
            let message = format!("{} is no location of a common", Shown(location));
            return Err(fault(RunCode::BadPostf, message));
        }
        Ok((kind, whole))
    }

    /// A word or record number.
    fn whole(&mut self, registers: &Registers, reg: Reg) -> Result<usize, Box<Diag>> {
        let number = self.number(registers, reg)?;
        let whole = number as usize;
        if whole >= 1 && whole as f64 == number {
            return Ok(whole);
        }
        let message = format!("{} is not a number of a word or record", Shown(number));
        Err(fault(RunCode::BadWordNumber, message))
    }

    fn find_code(&self, from: usize, code: f64) -> Result<Value, Box<Diag>> {
        let record = self.current()?;
        let is_it = |n: &usize| matches!(record.data_word(*n), Some(Word::Minor(id)) if self.vocab.code(id) == code);
        let found = (from.max(4)..=record.len()).find(is_it);
        Ok(Number(found.unwrap_or(0) as f64))
    }

    fn change_word(&mut self, op: PostfOp, n: usize, value: Value) -> Result<Value, Box<Diag>> {
        if op == PostfOp::SetWord {
            self.refuse_slot(n)?;
        }
        let was_minor = matches!(self.current()?.data_word(n), Some(Word::Minor(_)));
        let keep_minor = was_minor && op == PostfOp::SetWord;
        let word = match value {
            Empty | Unset => Word::Empty,
            Value::Word(id) => Word::Minor(id),
            Number(number) => match self.vocab.minor_with_code(number) {
                Some(id) if keep_minor => Word::Minor(id),
                _ => Word::Number(number),
            },
            Text(id) => {
                let limit = self.limits.text_bytes;
                let Some(record) = self.record.as_deref_mut() else { return Err(no_record()) };
                let text = self.state.texts.get(id);
                if record.text.len() + text.len() > limit {
                    let message = format!("texts of the record would take more than {limit} bytes");
                    return Err(fault(RunCode::TextLimit, message));
                }
                record.store_text(text)
            }
        };
        let record = self.current_mut()?;
        let done =
            if op == PostfOp::SetWord { record.set(n, word) } else { record.insert(n, word) };
        self.changed(done, n)
    }

    /// Words of a motion before its coordinates name it, and what they hold acts on nothing.
    fn refuse_slot(&self, n: usize) -> Result<(), Box<Diag>> {
        let record = self.current()?;
        let first = record.first_value();
        if !(FIRST_DATA..first).contains(&n) {
            return Ok(());
        }
        let name = self.vocab.name(record.major);
        let message =
            format!("word {n} of {name} names it, and its coordinates begin at word {first}");
        let mut diag = fault(RunCode::BadWordNumber, message);
        diag.hint = Some(format!("X, Y, Z are words {first}, {}, {}.", first + 1, first + 2));
        Err(diag)
    }

    fn changed(&mut self, done: bool, n: usize) -> Result<Value, Box<Diag>> {
        if done {
            self.outcome.edited = true;
            return Ok(DONE);
        }
        let last = self.current()?.len();
        let message = format!("word {n} can't be changed; the record's words are 4 to {last}");
        Err(fault(RunCode::BadWordNumber, message))
    }

    fn process(&mut self, registers: &mut Registers) -> Result<Value, Box<Diag>> {
        self.update_site();
        let Some(record) = self.record.as_deref() else { return Err(no_record()) };
        self.outcome.commands += 1;
        self.outcome.processed = true;
        if self.module.output.is_empty() {
            self.host.command(record, self.vocab, &self.state.site)?;
        } else {
            let record = record.clone();
            self.command_with_values(registers, &record)?;
        }
        Ok(DONE)
    }

    fn next(&mut self) -> Result<Value, Box<Diag>> {
        self.burn()?;
        let Some(record) = self.record.as_deref_mut() else { return Err(no_record()) };
        if self.at_end {
            let title = &self.module.chunks[usize::from(self.spot.chunk)].title;
            let message = format!("{title} reads on after the last record");
            return Err(fault(RunCode::PastLastRecord, message));
        }
        if self.host.next_record(record, self.vocab)? {
            return Ok(self.moved());
        }
        self.at_end = true;
        Ok(AT_END)
    }

    fn seek(&mut self, number: u32) -> Result<Value, Box<Diag>> {
        self.burn()?;
        let Some(record) = self.record.as_deref_mut() else { return Err(no_record()) };
        if self.host.seek_record(number, record, self.vocab)? {
            self.at_end = false;
            return Ok(self.moved());
        }
        Ok(AT_END)
    }

    fn restore(&mut self) -> Result<Value, Box<Diag>> {
        let Some(record) = self.record.as_deref_mut() else { return Err(no_record()) };
        let Some(saved) = &self.state.saved else {
            return Err(fault(RunCode::NothingSaved, "there is no saved record"));
        };
        record.clone_from(saved);
        Ok(self.moved())
    }

    /// Another record is current now.
    fn moved(&mut self) -> Value {
        self.outcome.replaced = true;
        self.outcome.processed = false;
        DONE
    }
}

fn no_record() -> Box<Diag> {
    fault(RunCode::NoRecord, "there is no current record here")
}
