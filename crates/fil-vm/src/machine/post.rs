//! Post words in FIL: from a template to a CL record.

use fil_cl::{Record, Word};
use fil_diag::Diag;

use super::report::fault;
use super::{Registers, Vm};
use crate::errors::RunCode;
use crate::host::Host;
use crate::module::{Item, Template};
use crate::value::Shown;
use crate::value::Value::{self, Empty, Number, Text, Unset};

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Builds the record of a template and hands it to the post.
    pub(super) fn post(
        &mut self,
        registers: &mut Registers,
        template: u16,
    ) -> Result<(), Box<Diag>> {
        let module = self.module;
        let template = &module.templates[usize::from(template)];
        let (data, text) = if template.is_text {
            self.text_item(registers, template)?
        } else {
            self.items(registers, template)?
        };
        let mut record = Record::statement(template.major, data, text)
            .map_err(|error| Box::new(Diag::new(error.code, error.message)))?;
        record.number = self.record.as_deref().map_or(0, |record| record.number);
        self.update_site();
        self.outcome.commands += 1;
        let result = if module.output.is_empty() {
            self.host.command(&record, self.vocab, &self.state.site)
        } else {
            self.command_with_values(registers, &record)
        };
        // The next post word uses the same memory.
        self.state.scratch = (record.data, record.text);
        result
    }

    fn items(
        &mut self,
        registers: &Registers,
        template: &Template,
    ) -> Result<(Vec<Word>, String), Box<Diag>> {
        let (mut data, mut text) = std::mem::take(&mut self.state.scratch);
        data.clear();
        text.clear();
        for item in &template.items {
            let word = match item {
                Item::Minor(id) => Word::Minor(*id),
                Item::Value(reg) => match self.read(registers, *reg)? {
                    Empty | Unset => Word::Empty,
                    Value::Word(id) => Word::Minor(id),
                    Number(number) => Word::Number(number),
                    Text(id) => push_text(&mut text, self.state.texts.get(id)),
                },
            };
            data.push(word);
        }
        Ok((data, text))
    }

    /// The items of a text word, one after the other in one text.
    fn text_item(
        &mut self,
        registers: &Registers,
        template: &Template,
    ) -> Result<(Vec<Word>, String), Box<Diag>> {
        let mut text = String::new();
        for item in &template.items {
            match item {
                Item::Minor(id) => text.push_str(self.vocab.name(*id)),
                Item::Value(reg) => match self.read(registers, *reg)? {
                    Text(id) => text.push_str(self.state.texts.get(id)),
                    Empty | Unset => {
                        let message = format!("EMPTY is in the text of {}", template.name);
                        return Err(fault(RunCode::WrongType, message));
                    }
                    Value::Word(_) => return Err(self.not_a_number(registers, *reg)),
                    Number(number) => text.push_str(&Shown(number).to_string()),
                },
            }
            if text.len() > self.limits.text_bytes {
                let message = format!("the text of {} passes the limit", template.name);
                return Err(fault(RunCode::TextLimit, message));
            }
        }
        let word = Word::Text { start: 0, len: text.len() as u32 };
        Ok((vec![word], text))
    }
}

fn push_text(texts: &mut String, text: &str) -> Word {
    let start = texts.len() as u32;
    texts.push_str(text);
    Word::Text { start, len: text.len() as u32 }
}
