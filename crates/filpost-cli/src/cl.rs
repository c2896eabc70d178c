//! `filpost cl`

use std::collections::BTreeMap;
use std::io::{self, Write};

use filpost::cl::record::{kind, motion};
use filpost::cl::{
    Evidence, Recognized, Record, SplineCounts, Vocabulary, WordId, WordView, reader::Reader, words,
};
use filpost::{Error, Extents, Refusals, Unit, UnitSource, statement_text};
use serde_json::{Value, json};

use crate::args::ClArgs;
use crate::{Status, convert, dialects, output, setup, summary};

/// Shows the records of a CL file, up to the first error; then the file is read on to find
/// all that is wrong with it.
///
/// # Errors
/// A CL file that can't be read; all statements that are refused.
pub fn run(args: &ClArgs) -> Result<Status, Error> {
    let Some(cl) = &args.cl else {
        return dialects::list(args.json);
    };
    if args.to.is_some() {
        return convert::run(args, cl);
    }
    let input = output::open(cl)?;
    let options = setup::cl_options(args.encoding.as_deref(), &args.cl_reading, args.raw)?;
    let mut reader = Reader::new(input, &output::input_name(cl), options);
    let told = reader.told_unit();
    let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
    let mut show = Show {
        output: output::View::new(),
        words: args.words,
        json: args.json,
        totals: Totals { given: args.units.units, told: told.map(unit_of), ..Totals::default() },
    };
    show.head().map_err(|error| output::stdout_error(&error))?;
    let mut refusals = Refusals::new();
    loop {
        match reader.read(&mut vocabulary, &mut record) {
            Ok(true) if refusals.is_empty() => {
                show.record(&record, &vocabulary).map_err(|error| output::stdout_error(&error))?;
            }
            Ok(true) => {}
            Ok(false) => break,
            Err(diag) => {
                if refusals.is_empty() || !reader.leans_on_earlier() {
                    refusals.add(*diag);
                }
                if !reader.resume() {
                    break;
                }
            }
        }
    }
    if !refusals.is_empty() {
        show.output.flush().map_err(|error| output::stdout_error(&error))?;
        return Err(Error::Refused(Box::new(refusals)));
    }
    show.foot(reader.recognized(), reader.splines())
        .map_err(|error| output::stdout_error(&error))?;
    Ok(Status::Done)
}

/// The unit that INCHES and MM name.
fn unit_of(word: WordId) -> Unit {
    if word == words::INCHES { Unit::Inch } else { Unit::Mm }
}

/// What is counted over all records.
#[derive(Default)]
struct Totals {
    records: u64,
    words: BTreeMap<String, u64>,
    /// The unit of `--units`.
    given: Option<Unit>,
    /// The unit that the feeds tell.
    told: Option<Unit>,
    /// The units that UNITS has said.
    said: Vec<Unit>,
    point: Option<[f64; 3]>,
    extents: Option<Extents>,
}

impl Totals {
    fn add(&mut self, record: &Record, vocabulary: &Vocabulary) {
        self.records += 1;
        let name = vocabulary.name(record.major);
        match self.words.get_mut(name) {
            Some(count) => *count += 1,
            None => drop(self.words.insert(name.to_string(), 1)),
        }
        if record.major == words::UNITS {
            let word = if record.has(words::INCHES) { words::INCHES } else { words::MM };
            let unit = unit_of(word);
            if !self.said.contains(&unit) {
                self.said.push(unit);
            }
        }
        let Some(mut point) = record.point() else { return };
        if record.kind == kind::MOTION && record.sub == motion::GODLTA {
            let Some(last) = self.point else { return };
            point = [0, 1, 2].map(|axis| last[axis] + point[axis]);
        }
        self.point = Some(point);
        let found = self.extents.get_or_insert(Extents { min: point, max: point });
        for (axis, value) in point.into_iter().enumerate() {
            found.min[axis] = found.min[axis].min(value);
            found.max[axis] = found.max[axis].max(value);
        }
    }

    /// The unit, and who says it: no file is taken to be in mm.
    fn unit(&self) -> String {
        match (&self.said[..], self.given) {
            ([], None) => match self.told {
                Some(told) => format!("{told} ({})", UnitSource::Feeds),
                None => "not said".into(),
            },
            ([], Some(given)) => format!("{given} (--units)"),
            ([said], None) => format!("{said} (UNITS)"),
            ([said], Some(given)) if *said == given => format!("{said} (UNITS)"),
            ([said], Some(given)) => format!("{said} (UNITS), not {given} as given"),
            _ => "changes within the file".into(),
        }
    }

    /// The unit where it is one; null where it is not said, or changes.
    fn unit_json(&self) -> Value {
        match (&self.said[..], self.given) {
            ([], Some(unit)) => json!(unit.to_string()),
            ([], None) => self.told.map_or(Value::Null, |unit| json!(unit.to_string())),
            ([unit], None) => json!(unit.to_string()),
            ([said], Some(given)) if *said == given => json!(said.to_string()),
            _ => Value::Null,
        }
    }

    /// Words and their counts, the most frequent first.
    fn by_count(&self) -> Vec<(&str, u64)> {
        let mut list: Vec<(&str, u64)> =
            self.words.iter().map(|(name, count)| (name.as_str(), *count)).collect();
        list.sort_by_key(|(name, count)| (std::cmp::Reverse(*count), *name));
        list
    }
}

/// Writes records as they come.
struct Show<W: Write> {
    output: W,
    words: bool,
    json: bool,
    totals: Totals,
}

impl<W: Write> Show<W> {
    fn head(&mut self) -> io::Result<()> {
        if self.json {
            write!(self.output, "{{\"records\":[")
        } else {
            writeln!(self.output, "   line  record  statement")
        }
    }

    fn record(&mut self, record: &Record, vocabulary: &Vocabulary) -> io::Result<()> {
        let first = self.totals.records == 0;
        self.totals.add(record, vocabulary);
        let statement = statement_text(record, vocabulary);
        if self.json {
            let mut object = json!({
                "record": record.number,
                "line": record.line,
                "statement": statement,
            });
            if self.words {
                object["words"] = words_of(record, vocabulary).map(json_word).collect();
            }
            let comma = if first { "" } else { "," };
            return write!(self.output, "{comma}\n{object}");
        }
        writeln!(self.output, "{:>7} {:>7}  {statement}", record.line, record.number)?;
        if self.words {
            for (index, word) in words_of(record, vocabulary).enumerate() {
                writeln!(self.output, "{:>20}  {}", index + 1, word_text(word))?;
            }
        }
        Ok(())
    }

    fn foot(&mut self, dialect: Recognized, splines: SplineCounts) -> io::Result<()> {
        let counts = self.totals.by_count();
        if self.json {
            let counts: Value = counts.iter().map(|(name, count)| json!([name, count])).collect();
            let extents = self.totals.extents.map(|box_| json!({"min": box_.min, "max": box_.max}));
            writeln!(
                self.output,
                "\n],\n\"dialect\":{},\n\"counts\":{counts},\n\"splines\":{},\n\"unit\":{},\n\"extents\":{}}}",
                json_dialect(dialect),
                json_splines(&splines),
                self.totals.unit_json(),
                extents.unwrap_or(Value::Null)
            )?;
            return self.output.flush();
        }
        let records = summary::counted(self.totals.records, "record");
        writeln!(self.output, "\n{records}, dialect {dialect}")?;
        if splines.splines > 0 {
            writeln!(self.output, "{}", summary::splines(&splines))?;
        }
        for (name, count) in counts {
            writeln!(self.output, "{count:>9}  {name}")?;
        }
        writeln!(self.output, "{:>9}  {}", "unit", self.totals.unit())?;
        if let Some(extents) = &self.totals.extents {
            for (axis, name) in ["X", "Y", "Z"].iter().enumerate() {
                let (min, max) = (extents.min[axis], extents.max[axis]);
                let (min, max) = (summary::length(min), summary::length(max));
                writeln!(self.output, "{name:>9}  {min} to {max}")?;
            }
        }
        self.output.flush()
    }
}

/// Name of the dialect, and the line that told it.
fn json_dialect(found: Recognized) -> Value {
    let name = found.dialect.name();
    match found.evidence {
        Evidence::Chosen => json!({"name": name, "chosen": true}),
        Evidence::Sign { line } => json!({"name": name, "line": line}),
        _ => json!({"name": name}),
    }
}

/// Splines, the lines that they were read as, and the tolerance; null where there are none.
fn json_splines(counts: &SplineCounts) -> Value {
    if counts.splines == 0 {
        return Value::Null;
    }
    json!({"splines": counts.splines, "lines": counts.lines, "tolerance": counts.tolerance})
}

/// The words of a record, word 1 first.
fn words_of<'a>(
    record: &'a Record,
    vocabulary: &'a Vocabulary,
) -> impl Iterator<Item = (WordView<'a>, bool)> {
    let public = |name: &str| vocabulary.find(name).is_some_and(|id| vocabulary.is_public(id));
    (1..=record.len()).filter_map(move |n| {
        let word = record.word(n, vocabulary)?;
        let known = matches!(word, WordView::Word { name, .. } if public(name));
        Some((word, known))
    })
}

/// A word for people; a code that is ours is not shown as a fact.
fn word_text((word, public): (WordView<'_>, bool)) -> String {
    match word {
        WordView::Number(number) => number.to_string(),
        WordView::Word { name, code } if public => format!("{name}  (code {code})"),
        WordView::Word { name, .. } => format!("{name}  (no published code)"),
        WordView::Text(text) => format!("'{text}'"),
        WordView::Empty => "EMPTY".into(),
    }
}

fn json_word((word, public): (WordView<'_>, bool)) -> Value {
    match word {
        WordView::Number(number) => json!(number),
        WordView::Word { name, code } if public => json!({"word": name, "code": code}),
        WordView::Word { name, .. } => json!({"word": name}),
        WordView::Text(text) => json!({"text": text}),
        WordView::Empty => Value::Null,
    }
}
