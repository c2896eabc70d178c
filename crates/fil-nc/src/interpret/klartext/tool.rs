//! TOOL CALL: a tool, a speed, a feed.

use super::super::Fault;
use super::Klartext;
use super::line::Word;
use crate::errors::NcCode;
use crate::motion::{Event, Speed};

impl Klartext<'_> {
    /// `TOOL DEF 5` makes a tool ready; with a length or a radius it gives the tool others than
    /// those of its table.
    pub(super) fn define_tool(&mut self, texts: &[&str]) {
        if texts.iter().any(|text| text.starts_with(['L', 'R'])) {
            self.state.events.push(Event::ToolMeasured { line: self.state.line });
        }
    }

    /// `TOOL CALL 5 Z S2000`; the tool in the spindle with a speed is no change.
    pub(super) fn tool_call(&mut self, words: &[Word]) -> Result<(), Fault> {
        let mut number = None;
        let (mut speed, mut feed, mut axis) = (None, None, false);
        for (at, word) in words.iter().enumerate() {
            let plain = word.text.parse::<u32>().ok().filter(|_| at == 0);
            match word.text.as_str() {
                _ if plain.is_some() => number = plain,
                "Z" => axis = true,
                "X" | "Y" | "U" | "V" | "W" => {
                    let message = "a tool axis other than Z";
                    return Err(Fault::new(NcCode::ForeignCode, message).at(&word.range));
                }
                _ => match (word.value("S"), word.value("F")) {
                    (Some(value), _) => speed = Some(value?),
                    (_, Some(value)) => feed = Some(value?),
                    _ => return Err(word.no_meaning()),
                },
            }
        }
        if number.is_none() && speed.is_none() && feed.is_none() {
            return Err(Fault::new(NcCode::MissingWord, "a tool, a speed or a feed is needed"));
        }
        if number.is_some() && !axis {
            return Err(Fault::new(NcCode::MissingWord, "the tool axis is needed"));
        }
        let changes = |number: &u32| *number != self.state.modes.tool || speed.is_none();
        if let Some(number) = number.filter(changes) {
            self.state.change(number);
        }
        if speed.is_some() {
            self.state.modes.spindle.speed = speed.map(Speed::Turns);
        }
        self.state.feed.word = feed.or(self.state.feed.word);
        Ok(())
    }
}
