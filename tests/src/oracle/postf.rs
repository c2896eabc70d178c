//! POSTF over a list of records and three commons.

use fil_syntax::tree::{Expr, Span};

use super::Oracle;
use super::value::{Class, EMPTY, Fault, PAST_END, Rec, Value, Word, exact};

impl Oracle<'_> {
    /// POSTF(n,…). What only acts gives 0.
    pub(super) fn postf(&mut self, args: &[Expr], span: Span) -> Result<Value, Fault> {
        let mut values = Vec::new();
        for arg in args {
            values.push(self.eval(arg)?);
        }
        let mut numbers = Vec::new();
        for (index, value) in values.iter().enumerate() {
            // What a common keeps and what is looked for may be EMPTY or a word.
            let may_be_word = matches!((numbers.first(), index), (Some(2.0), 3) | (Some(9.0), 2));
            match (value, self.plain(value)) {
                (Value::Number(number), _) => numbers.push(*number),
                // The new word of POSTF(8) is the only argument that may be a text.
                _ if index == 2 && numbers[0] == 8.0 => numbers.push(EMPTY),
                (_, Some(number)) if may_be_word => numbers.push(number),
                _ => return self.fault(Class::WrongType, span),
            }
        }
        let result = match numbers.as_slice() {
            [1.0, kind, location] => self.get_common(*kind, *location),
            [2.0, kind, location, value] => self.set_common(*kind, *location, *value),
            [3.0, kind, location] => self.set_common(*kind, *location, EMPTY),
            [4.0] => Ok(EMPTY),
            [5.0] => self.record().map(|record| record.len() as f64),
            [6.0, n] => self.class_of(*n),
            [7.0, n] => return self.word(*n, span).or_else(|class| self.fault(class, span)),
            [8.0, n, _] => self.set_word(*n, &values[2]),
            [9.0, from, code] => self.find(*from, *code),
            [13.0] => self.process(span),
            [14.0] => self.read_on(),
            [20.0] => self.record().cloned().map(|record| {
                self.saved = Some(record);
                0.0
            }),
            [21.0] => self.restore(),
            [24.0, on] => self.trace(*on),
            _ => Err(Class::BadPostf),
        };
        result.map(Value::of).or_else(|class| self.fault(class, span))
    }

    fn record(&self) -> Result<&Rec, Class> {
        self.current.as_ref().ok_or(Class::NoRecord)
    }

    fn get_common(&self, kind: f64, location: f64) -> Result<f64, Class> {
        let (kind, location) = place(kind, location)?;
        let at_start = f64::from(location % 7);
        Ok(self.commons.get(&(kind, location)).copied().unwrap_or(at_start))
    }

    fn set_common(&mut self, kind: f64, location: f64, value: f64) -> Result<f64, Class> {
        let place = place(kind, location)?;
        if value == EMPTY {
            self.commons.insert(place, EMPTY);
            self.events.push(format!("clear {place:?}"));
        } else {
            self.commons.insert(place, value);
            self.events.push(format!("set {place:?} {}", exact(value)));
        }
        Ok(0.0)
    }

    fn class_of(&self, n: f64) -> Result<f64, Class> {
        let record = self.record()?;
        let n = word_number(n)?;
        Ok(match n {
            1..=3 => 1.0,
            _ => match record.data.get(n - 4) {
                None | Some(Word::Empty) => 0.0,
                Some(Word::Number(_)) => 1.0,
                Some(Word::Minor(_)) => 2.0,
                Some(Word::Text(_)) => 3.0,
            },
        })
    }

    fn word(&mut self, n: f64, span: Span) -> Result<Value, Class> {
        let record = self.record()?.clone();
        let n = word_number(n)?;
        let number = match n {
            1 => f64::from(record.number),
            2 => f64::from(record.kind),
            3 if record.opens_with_word() => return Ok(Value::Minor(record.major)),
            3 => self.third_word(&record),
            _ => match record.data.get(n - 4) {
                None => {
                    self.warn(PAST_END, span);
                    EMPTY
                }
                Some(Word::Empty) => EMPTY,
                Some(Word::Number(number)) => *number,
                Some(Word::Minor(name)) => return Ok(Value::Minor(name.clone())),
                Some(Word::Text(text)) => return Ok(Value::Text(text.clone())),
            },
        };
        Ok(Value::of(number))
    }

    /// A minor word stays one when the value is the code of a minor word.
    fn set_word(&mut self, n: f64, value: &Value) -> Result<f64, Class> {
        let record = self.record()?;
        let n = word_number(n)?;
        // Two words of a motion and five of a circle only name it.
        let first = match (record.kind, record.sub) {
            (5000, _) => 6,
            (3000, 4) => 9,
            _ => 4,
        };
        if n < first || n > record.len() {
            return Err(Class::BadWordNumber);
        }
        let was_minor = matches!(record.data[n - 4], Word::Minor(_));
        let word = match value {
            Value::Text(text) => Word::Text(text.clone()),
            Value::Minor(name) => Word::Minor(name.clone()),
            Value::Empty => Word::Empty,
            Value::Number(number) => match self.vocab.minor_with_code(*number) {
                Some(id) if was_minor => Word::Minor(self.vocab.name(id).to_string()),
                _ => Word::Number(*number),
            },
        };
        if let Some(record) = &mut self.current {
            record.data[n - 4] = word;
        }
        self.done.edited = true;
        Ok(0.0)
    }

    fn find(&self, from: f64, code: f64) -> Result<f64, Class> {
        let record = self.record()?;
        let from = word_number(from)?.max(4);
        let mut words = record.data.iter().enumerate().skip(from - 4);
        let found = words.find(|(_, word)| match word {
            Word::Minor(name) => self.code(name) == code,
            _ => false,
        });
        Ok(found.map_or(0.0, |(index, _)| index as f64 + 4.0))
    }

    fn process(&mut self, span: Span) -> Result<f64, Class> {
        let record = self.record()?.clone();
        self.command(&record, span);
        self.done.processed = true;
        Ok(0.0)
    }

    /// The next record; once the end was told, asking again is an error.
    fn read_on(&mut self) -> Result<f64, Class> {
        self.record()?;
        if self.at_end {
            return Err(Class::PastLastRecord);
        }
        if self.fuel == 0 {
            return Err(Class::OutOfFuel);
        }
        self.fuel -= 1;
        let Some(record) = self.records.get(self.next).cloned() else {
            self.at_end = true;
            return Ok(1.0);
        };
        self.next += 1;
        self.current = Some(record);
        self.done.replaced = true;
        self.done.processed = false;
        Ok(0.0)
    }

    fn restore(&mut self) -> Result<f64, Class> {
        self.record()?;
        let saved = self.saved.clone().ok_or(Class::NothingSaved)?;
        self.current = Some(saved);
        self.done.replaced = true;
        self.done.processed = false;
        Ok(0.0)
    }

    fn trace(&mut self, on: f64) -> Result<f64, Class> {
        match on {
            0.0 | 1.0 => {
                self.events.push(format!("trace {}", on == 1.0));
                Ok(0.0)
            }
            _ => Err(Class::BadPostf),
        }
    }

    /// Writes down a record that goes to the post, with the lines that made it.
    pub(super) fn command(&mut self, record: &Rec, span: Span) {
        let mut lines = vec![self.line(span)];
        lines.extend(self.callers.iter().rev());
        self.done.commands += 1;
        self.events.push(format!("> {record} from {lines:?}"));
    }
}

/// A common and a location in it.
fn place(kind: f64, location: f64) -> Result<(u8, u32), Class> {
    let known = [1.0, 2.0, 3.0].contains(&kind);
    if !known || location.fract() != 0.0 || location < 1.0 || location > f64::from(u32::MAX) {
        return Err(Class::BadPostf);
    }
    Ok((kind as u8, location as u32))
}

/// Words count from 1. A number that no counter holds is no word's number.
fn word_number(n: f64) -> Result<usize, Class> {
    let countable = (1.0..u64::MAX as f64).contains(&n);
    if n.fract() != 0.0 || !countable { Err(Class::BadWordNumber) } else { Ok(n as usize) }
}
