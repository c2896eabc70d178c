//! Running the macros that the post calls, between sections and within them.

use fil_cl::{Record, Vocabulary};
use fil_diag::Diag;

use super::report::fault;
use super::{Interpreter, Registers, State, Vm};
use crate::errors::RunCode;
use crate::host::Host;
use crate::module::ChunkId;
use crate::output::{OutputMacro, REPOSITION, REPOSITION_GIVEN};
use crate::value::{EMPTY, Slot, Value};

/// The values of a machine while it is in the middle of a section: a second machine that
/// runs macros in between works on them.
#[derive(Debug)]
pub struct Values {
    registers: Vec<Slot>,
    state: State,
}

impl Interpreter {
    /// Exchanges the values of two machines of one module.
    pub fn exchange(&mut self, other: &mut Interpreter) {
        std::mem::swap(&mut self.registers, &mut other.registers);
        std::mem::swap(&mut self.state, &mut other.state);
    }

    /// Exchanges its values with those of a machine that is in the middle of a section.
    pub fn exchange_values(&mut self, values: &mut Values) {
        let count = values.registers.len();
        self.registers.get()[..count].swap_with_slice(&mut values.registers);
        std::mem::swap(&mut self.state, &mut values.state);
    }

    /// True when the module has this macro.
    pub fn edits(&self, what: OutputMacro) -> bool {
        let output = &self.module.output;
        match what {
            OutputMacro::Words => output.words.is_some(),
            OutputMacro::Tape => output.tape.is_some(),
            OutputMacro::Listing => output.listing.is_some(),
            OutputMacro::Reposition => output.reposition.is_some(),
        }
    }

    /// Runs the macro that edits a line of the tape or the listing, where there is one.
    ///
    /// # Errors
    /// As a section; a line that is no longer a text.
    pub fn edit_line<H: Host + ?Sized>(
        &mut self,
        what: OutputMacro,
        line: &mut String,
        vocab: &mut Vocabulary,
        host: &mut H,
    ) -> Result<(), Box<Diag>> {
        let found = match what {
            OutputMacro::Words | OutputMacro::Reposition => None,
            OutputMacro::Tape => self.module.output.tape,
            OutputMacro::Listing => self.module.output.listing,
        };
        let Some((chunk, register)) = found else { return Ok(()) };
        let text = self.state.texts.add(line, self.limits.text_bytes);
        let text = text.map_err(|_| {
            fault(RunCode::TextLimit, "no room is left for the line that is edited")
        })?;
        self.registers[usize::from(register)] = Value::Text(text).into();
        self.run_macro(chunk, vocab, host)?;
        match self.registers[usize::from(register)].value() {
            Value::Text(id) => {
                line.clear();
                line.push_str(self.state.texts.get(id));
                Ok(())
            }
            _ => Err(self.at_macro(chunk, "the parameter holds a number and no line")),
        }
    }

    /// Runs the macro that edits the words of a block, each a letter and its value in
    /// their order, where there is one.
    ///
    /// # Errors
    /// As a section; a word that is no longer a number.
    pub fn edit_words<H: Host + ?Sized>(
        &mut self,
        words: &mut Vec<(u8, f64)>,
        vocab: &mut Vocabulary,
        host: &mut H,
    ) -> Result<(), Box<Diag>> {
        let Some((chunk, parameters)) = self.module.output.words.clone() else { return Ok(()) };
        let found: Vec<Option<usize>> = parameters
            .iter()
            .map(|word| {
                let same =
                    words.iter().enumerate().filter(|(_, (letter, _))| *letter == word.letter);
                same.map(|(index, _)| index).nth(word.before)
            })
            .collect();
        for (word, index) in parameters.iter().zip(&found) {
            let value = index.map_or(Value::Empty, |index| Value::Number(words[index].1));
            self.registers[usize::from(word.register)] = value.into();
        }
        self.run_macro(chunk, vocab, host)?;
        let mut gone = Vec::new();
        for (word, index) in parameters.iter().zip(found) {
            let value = match self.registers[usize::from(word.register)].value() {
                Value::Number(value) => Some(value),
                Value::Empty | Value::Unset => None,
                Value::Text(_) | Value::Word(_) => {
                    let letter = char::from(word.letter);
                    return Err(self.at_macro(chunk, &format!("{letter} holds a text")));
                }
            };
            match (index, value) {
                (Some(index), None) => gone.push(index),
                (Some(index), Some(value)) => words[index].1 = value,
                (None, None) => {}
                (None, Some(value)) => words.push((word.letter, value)),
            }
        }
        gone.sort_unstable();
        for index in gone.into_iter().rev() {
            words.remove(index);
        }
        Ok(())
    }

    /// Runs the macro that says how rotary axes are repositioned, with a value for each of
    /// [`REPOSITION`]; what it decides is left in them.
    ///
    /// # Errors
    /// As a section; what is given is changed; a text.
    pub fn reposition<H: Host + ?Sized>(
        &mut self,
        values: &mut [f64; REPOSITION.len()],
        vocab: &mut Vocabulary,
        host: &mut H,
    ) -> Result<(), Box<Diag>> {
        let Some((chunk, parameters)) = self.module.output.reposition.clone() else {
            return Ok(());
        };
        for (at, register) in &parameters {
            self.registers[usize::from(*register)] = Value::of(values[*at]).into();
        }
        self.run_macro(chunk, vocab, host)?;
        for (at, register) in parameters {
            let name = REPOSITION[at];
            let value = match self.registers[usize::from(register)].value() {
                Value::Number(value) => value,
                Value::Empty | Value::Unset => EMPTY,
                Value::Text(_) | Value::Word(_) => {
                    return Err(self.at_macro(chunk, &format!("{name} holds a text")));
                }
            };
            if at < REPOSITION_GIVEN && value.to_bits() != values[at].to_bits() {
                let message = format!("{name} is given to _REPOS, which can't change it");
                return Err(self.at_macro(chunk, &message));
            }
            values[at] = value;
        }
        Ok(())
    }

    /// Runs a macro beside a section that may be in the middle of its statements.
    fn run_macro<H: Host + ?Sized>(
        &mut self,
        chunk: ChunkId,
        vocab: &mut Vocabulary,
        host: &mut H,
    ) -> Result<(), Box<Diag>> {
        let frames = std::mem::take(&mut self.state.frames);
        let site = self.state.site.clone();
        let done = self.run(chunk, None, vocab, host);
        self.state.frames = frames;
        self.state.site = site;
        done.map(|_| ())
    }

    fn at_macro(&self, chunk: ChunkId, message: &str) -> Box<Diag> {
        let first = self.module.statement(chunk, 0);
        Box::new(fault(RunCode::WrongType, message).at(self.module.place(first)))
    }
}

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Hands a record to the post with the values of the machine, so that macros can edit
    /// what it writes.
    #[cold]
    #[inline(never)]
    pub(super) fn command_with_values(
        &mut self,
        registers: &mut Registers,
        record: &Record,
    ) -> Result<(), Box<Diag>> {
        let site = self.state.site.clone();
        let count = self.module.registers as usize;
        let mut values =
            Values { registers: registers[..count].to_vec(), state: std::mem::take(self.state) };
        values.state.lent = true;
        self.host.exchange_values(&mut values);
        let result = self.host.command(record, self.vocab, &site);
        self.host.exchange_values(&mut values);
        values.state.lent = false;
        registers[..count].copy_from_slice(&values.registers);
        *self.state = values.state;
        result
    }
}
