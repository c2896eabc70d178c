//! Messages of the machine: place, calls, record and values.

use fil_cl::Vocabulary;
use fil_cl::{Record, Word};
use fil_diag::Diag;

use super::{Registers, Spot, Vm};
use crate::errors::RunCode;
use crate::host::{Host, Site};
use crate::value::{EMPTY, Shown, Value};

/// Words of a record shown in a note; a message is no listing.
const MOST_WORDS_SHOWN: usize = 40;

/// An error without a place; the machine adds it.
pub(super) fn fault(code: RunCode, message: impl Into<String>) -> Box<Diag> {
    Box::new(Diag::new(code, message))
}

impl<H: Host + ?Sized> Vm<'_, H> {
    /// The statement that acts, for the host.
    pub(super) fn update_site(&mut self) {
        let module = self.module;
        let statement = module.statement(self.spot.chunk, self.spot.pc);
        let site = &mut self.state.site;
        (site.file, site.line) = (statement.file, statement.line);
        site.callers.clear();
        site.callers.extend(self.state.frames.iter().rev().map(|frame| {
            let statement = module.statement(frame.chunk, frame.pc);
            (statement.file, statement.line)
        }));
    }

    /// Warns of something once for each place.
    #[cold]
    pub(super) fn warn_once(&mut self, code: RunCode, message: impl FnOnce() -> String) {
        let number = <&fil_diag::Code>::from(code).number;
        if self.state.warned.insert((self.spot, number)) {
            self.warning(code, message());
        }
    }

    /// Warns of something at the place the machine is at.
    #[cold]
    pub(super) fn warning(&mut self, code: RunCode, message: String) {
        self.warn_here(Diag::new(code, message));
    }

    /// Gives a warning of the host the place the machine is at.
    #[inline]
    pub(super) fn warn_of(&mut self, warning: Option<Box<Diag>>) {
        if let Some(diag) = warning {
            self.warn_here(*diag);
        }
    }

    #[cold]
    fn warn_here(&mut self, diag: Diag) {
        let mut diag = diag.at(self.place(self.spot));
        self.add_calls(&mut diag);
        self.add_record(&mut diag);
        self.host.warn(diag);
    }

    fn place(&self, spot: Spot) -> fil_diag::TextSpan {
        self.module.place(self.module.statement(spot.chunk, spot.pc))
    }

    /// Completes an error with the FIL place, the calls, the record and the values.
    #[cold]
    pub(super) fn locate(&self, registers: &Registers, mut diag: Box<Diag>) -> Box<Diag> {
        diag.spans.push(self.place(self.spot));
        self.add_calls(&mut diag);
        self.add_record(&mut diag);
        let statement = self.module.statement(self.spot.chunk, self.spot.pc);
        let values: Vec<String> = statement
            .names
            .iter()
            .filter_map(|reg| {
                let name = self.module.names.get(reg)?;
                Some(format!("{name} = {}", self.shown(registers[usize::from(*reg)].value())))
            })
            .collect();
        if !values.is_empty() {
            diag.notes.push(values.join(", "));
        }
        diag
    }

    fn shown(&self, value: Value) -> String {
        match value {
            Value::Number(number) => Shown(number).to_string(),
            Value::Text(id) => format!("'{}'", self.state.texts.get(id)),
            Value::Word(id) => self.vocab.name(id).to_string(),
            Value::Empty => Shown(EMPTY).to_string(),
            Value::Unset => "never set".to_string(),
        }
    }

    fn add_calls(&self, diag: &mut Diag) {
        let mut title = &self.module.chunks[usize::from(self.spot.chunk)].title;
        for frame in self.state.frames.iter().rev() {
            let place = self.place(*frame);
            diag.notes.push(format!("in {title}, called from {}:{}", place.file, place.line));
            title = &self.module.chunks[usize::from(frame.chunk)].title;
        }
        diag.notes.push(format!("in {title}"));
    }

    fn add_record(&self, diag: &mut Diag) {
        if let Some(record) = &self.record {
            diag.notes.push(describe(record, self.vocab));
        }
    }
}

/// A record with its numbered words: `record 12, CL line 40: 3 CYCLE  4 DRILL  5 …`.
fn describe(record: &Record, vocab: &Vocabulary) -> String {
    let mut line = format!("record {}", record.number);
    if record.line != 0 {
        line += &format!(", CL line {}", record.line);
    }
    line += &format!(": 2={} 3={}", record.kind, vocab.name(record.major));
    for (index, word) in record.data.iter().take(MOST_WORDS_SHOWN).enumerate() {
        let shown = match word {
            Word::Number(number) => Shown(*number).to_string(),
            Word::Minor(id) => vocab.name(*id).to_string(),
            Word::Text { start, len } => {
                let (start, len) = (*start as usize, *len as usize);
                format!("'{}'", record.text.get(start..start + len).unwrap_or(""))
            }
            Word::Empty => "-".to_string(),
        };
        line += &format!(" {}={shown}", index + 4);
    }
    if record.data.len() > MOST_WORDS_SHOWN {
        line += " …";
    }
    line
}

impl Site {
    /// The stack as lines, innermost first: `post.fil:12`.
    pub fn lines(&self, module: &crate::Module) -> Vec<String> {
        self.stack()
            .map(|(file, line)| format!("{}:{line}", module.files[usize::from(file)].name))
            .collect()
    }
}
