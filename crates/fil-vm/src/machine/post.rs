//! Post words in FIL: from a template to a CL record.

use fil_cl::{Record, Word};
use fil_diag::Diag;

use super::report::fault;
use super::{Registers, Vm};
use crate::errors::RunCode;
use crate::host::Host;
use crate::module::{Item, Template};
use crate::value::Value::{Number, Text, Unset};
use crate::value::{EMPTY, Shown};

impl<H: Host + ?Sized> Vm<'_, H> {
    /// Builds the record of a template and hands it to the post.
    pub(super) fn post(&mut self, registers: &Registers, template: u16) -> Result<(), Box<Diag>> {
        let module = self.module;
        let template = &module.templates[usize::from(template)];
        let (mut data, mut text) = std::mem::take(&mut self.state.scratch);
        data.clear();
        text.clear();
        let mut record = Record {
            number: self.record.as_deref().map_or(0, |record| record.number),
            kind: template.kind,
            sub: template.sub,
            major: template.major,
            data,
            text,
            line: 0,
        };
        let filled = if template.is_text {
            self.fill_text(registers, template, &mut record)
        } else {
            self.fill_words(registers, template, &mut record)
        };
        let result = filled.and_then(|()| {
            self.update_site();
            self.outcome.commands += 1;
            self.host.command(&record, self.vocab, &self.state.site)
        });
        // The next post word uses the same memory.
        self.state.scratch = (record.data, record.text);
        result
    }

    fn fill_words(
        &mut self,
        registers: &Registers,
        template: &Template,
        record: &mut Record,
    ) -> Result<(), Box<Diag>> {
        for item in &template.items {
            let word = match item {
                Item::Minor(id) => Word::Minor(*id),
                Item::Empty => Word::Empty,
                Item::Value(reg) => match self.read(registers, *reg)? {
                    Number(EMPTY) | Unset => Word::Empty,
                    Number(number) => Word::Number(number),
                    Text(id) => record.store_text(self.state.texts.get(id)),
                },
            };
            record.data.push(word);
        }
        Ok(())
    }

    fn fill_text(
        &mut self,
        registers: &Registers,
        template: &Template,
        record: &mut Record,
    ) -> Result<(), Box<Diag>> {
        for item in &template.items {
            match item {
                Item::Minor(id) => record.text.push_str(self.vocab.name(*id)),
                Item::Empty => {}
                Item::Value(reg) => match self.read(registers, *reg)? {
                    Text(id) => record.text.push_str(self.state.texts.get(id)),
                    Number(EMPTY) | Unset => {
                        let message = format!("EMPTY can't be written in the text of {}", template.name);
                        return Err(fault(RunCode::WrongType, message));
                    }
                    Number(number) => record.text.push_str(&Shown(number).to_string()),
                },
            }
            if record.text.len() > self.limits.text_bytes {
                let message = format!("the text of {} passes the limit", template.name);
                return Err(fault(RunCode::TextLimit, message));
            }
        }
        Ok(())
    }
}
