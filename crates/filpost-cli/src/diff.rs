//! `filpost diff`

use std::collections::VecDeque;
use std::io::{self, Write};
use std::iter::Peekable;

use filpost::nc::diff::{
    self, Comparison, Difference, Ignore, Options, Program, What, compare, sentence,
};
use filpost::{Error, shown};
use serde_json::{Value, json};

use crate::args::{DiffArgs, Report};
use crate::{Status, output, render};

/// Width of one program's column, characters.
const COLUMN: usize = 46;

const RED: &str = "\u{1b}[31m";
const GREEN: &str = "\u{1b}[32m";
const YELLOW: &str = "\u{1b}[33m";
const PLAIN: &str = "\u{1b}[0m";

/// Compares two NC programs.
///
/// # Errors
/// A program that can't be read.
pub fn run(args: &DiffArgs) -> Result<Status, Error> {
    let mut ignore = Ignore::default();
    for entry in &args.ignore {
        // The command line has been checked.
        let _ = ignore.add(entry);
    }
    let options = Options {
        tolerance: args.tol,
        ignore,
        modal: args.modal,
        diameter: args.diameter,
        page: args.nc_encoding,
    };
    let names = [&args.first, &args.second].map(|path| output::input_name(path));
    let files = [
        (output::open(&args.first)?, names[0].as_str()),
        (output::open(&args.second)?, names[1].as_str()),
    ];
    let [first, second] = diff::open(files, &options).map_err(Error::Run)?;
    let found = compare(&first, &second, &options).map_err(Error::Run)?;
    match args.format {
        Report::Json => {
            output::print_with(|out| writeln!(out, "{:#}", as_json(&found, &first, &second)))?
        }
        Report::Text => {
            let show =
                Show { programs: [&first, &second], colours: render::colours(&io::stdout()) };
            output::print_with(|out| show.all(out, &found, args.context))?;
        }
    }
    Ok(if found.differences.is_empty() { Status::Done } else { Status::Failed })
}

/// An object with the differences in order.
fn as_json(found: &Comparison, first: &Program, second: &Program) -> Value {
    let differences: Value = found
        .differences
        .iter()
        .map(|difference| {
            let mut object = json!({
                "lines": difference.lines,
                "message": sentence(difference, first, second),
            });
            describe(&difference.what, &mut object);
            object
        })
        .collect();
    json!({ "equal": found.differences.is_empty(), "differences": differences })
}

fn describe(what: &What, object: &mut Value) {
    object["kind"] = match what {
        What::Only => "block",
        What::Word(..) => "word",
        What::Function(..) => "function",
        What::Arc(_) => "arc",
        What::Comment(_) => "comment",
        What::Statement(_) => "statement",
        What::Mark(_) => "mark",
        What::Numbering(..) => "numbering",
        What::Points(..) => "points",
    }
    .into();
    match what {
        What::Word(letter, values) | What::Function(letter, values) => {
            object["letter"] = char::from(*letter).to_string().into();
            object["values"] = json!(values);
        }
        What::Arc(deviation) => object["deviation"] = json!(deviation),
        What::Numbering(count, _) => object["blocks"] = json!(count),
        What::Points(letter, count) => {
            object["letter"] = char::from(*letter).to_string().into();
            object["blocks"] = json!(count);
        }
        What::Only | What::Comment(_) | What::Statement(_) | What::Mark(_) => {}
    }
}

/// The programs side by side.
struct Show<'p> {
    programs: [&'p Program; 2],
    colours: bool,
}

impl Show<'_> {
    fn all(&self, out: &mut dyn Write, found: &Comparison, context: usize) -> io::Result<()> {
        let mut differences = found.differences.iter().peekable();
        let mut before = VecDeque::new();
        let (mut cut, mut after) = (false, 0);
        for pair in found.pairs() {
            if differences.peek().is_some_and(|difference| difference.lines == pair) {
                if cut {
                    writeln!(out, "  …")?;
                }
                for pair in before.drain(..) {
                    self.row(out, pair, &mut differences)?;
                }
                self.row(out, pair, &mut differences)?;
                (cut, after) = (false, context);
            } else if after > 0 {
                self.row(out, pair, &mut differences)?;
                after -= 1;
            } else {
                before.push_back(pair);
                if before.len() > context {
                    before.pop_front();
                    cut = true;
                }
            }
        }
        let count = found.differences.len();
        let s = if count == 1 { "" } else { "s" };
        if count == 0 {
            writeln!(out, "the programs are equivalent")
        } else {
            writeln!(out, "{count} difference{s}")
        }
    }

    /// Two lines beside each other, and below them what differs.
    fn row<'d>(
        &self,
        out: &mut dyn Write,
        pair: [Option<u32>; 2],
        differences: &mut Peekable<impl Iterator<Item = &'d Difference>>,
    ) -> io::Result<()> {
        let mut here = Vec::new();
        while let Some(difference) = differences.next_if(|difference| difference.lines == pair) {
            here.push(difference);
        }
        let sign = match pair {
            _ if here.is_empty() => ' ',
            [Some(_), Some(_)] => '*',
            [Some(_), None] => '-',
            _ => '+',
        };
        let left = self.cell(0, pair[0], &here);
        let right = self.cell(1, pair[1], &here);
        let line = format!("{sign} {left} | {right}");
        writeln!(out, "{}", shown(line.trim_end()))?;
        for difference in here {
            let sentence = sentence(difference, self.programs[0], self.programs[1]);
            writeln!(out, "      {}", self.paint(YELLOW, &shown(&sentence)))?;
        }
        Ok(())
    }

    /// A line of one program, with the words that differ in colour, as wide as
    /// its column.
    fn cell(&self, side: usize, line: Option<u32>, here: &[&Difference]) -> String {
        let Some(line) = line else { return " ".repeat(COLUMN + 6) };
        let text = self.programs[side].text(line);
        let colour = if side == 0 { RED } else { GREEN };
        let width = text.chars().count();
        let cut: String = text.chars().take(COLUMN).collect();
        let mut ranges: Vec<_> =
            here.iter().filter_map(|difference| difference.words[side].clone()).collect();
        if here.iter().any(|difference| difference.what == What::Only) {
            ranges.push(0..cut.len());
        }
        ranges.sort_by_key(|range| range.start);
        let mut painted = String::new();
        let mut done = 0;
        for range in ranges {
            if let (Some(before), Some(word)) = (cut.get(done..range.start), cut.get(range.clone()))
            {
                painted.push_str(before);
                painted.push_str(&self.paint(colour, word));
                done = range.end;
            }
        }
        painted.push_str(cut.get(done..).unwrap_or_default());
        let fill = " ".repeat(COLUMN.saturating_sub(width));
        format!("{line:>5} {painted}{fill}")
    }

    fn paint(&self, colour: &str, text: &str) -> String {
        if self.colours { format!("{colour}{text}{PLAIN}") } else { text.to_string() }
    }
}
