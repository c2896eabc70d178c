//! `filpost trace`

use std::collections::BTreeSet;
use std::fmt::Write as _;

use filpost::trace::{self, Answer, Asked, FilePosition, Line, LineWord, Made, Options};
use filpost::{Diag, Error};

use crate::args::{AnswerFormat, TraceArgs};
use crate::errors::CommandCode;
use crate::{Status, output, render, setup, summary};

/// Answers who made a block, or what a record or a line of FIL made.
///
/// # Errors
/// A question or a map that can't be used.
pub fn run(args: &TraceArgs) -> Result<Status, Error> {
    let Some(place) = FilePosition::parse(&args.place) else {
        let message = format!("{} names no line", args.place);
        render::to_stderr(&Diag::new(CommandCode::NoLine, message));
        return Ok(Status::Usage);
    };
    let map = match &args.map {
        Some(map) => map.clone(),
        None => trace::map_of(&place.file)?,
    };
    let options = Options {
        most: args.most,
        cl: setup::cl_options(args.encoding.as_deref(), &args.cl_reading, args.raw)?,
        encoding: args.encoding.clone(),
        cl_file: args.cl.clone(),
        fil_files: args.fil.clone(),
    };
    let answer = trace::trace(&place, &map, &options)?;
    match args.format {
        AnswerFormat::Text => output::print(render::clean(&text(&answer)).as_bytes())?,
        AnswerFormat::Json => output::print_with(|output| {
            serde_json::to_writer_pretty(&mut *output, &answer)?;
            writeln!(output)
        })?,
    }
    Ok(Status::Done)
}

/// An answer for people.
fn text(answer: &Answer) -> String {
    let mut text = String::new();
    if answer.asked != Asked::Nc {
        head(&mut text, answer);
    }
    for line in &answer.lines {
        block(&mut text, answer, line);
    }
    let left = answer.in_all - answer.lines.len() as u64;
    if left > 0 {
        let _ = writeln!(text, "and {} more; --most shows more", summary::counted(left, "line"));
    }
    for missing in &answer.missing {
        let _ = writeln!(text, "{missing} is not there, so nothing of it is shown");
    }
    text
}

/// What was asked about, and how much it made.
fn head(text: &mut String, answer: &Answer) {
    let (file, line) = (&answer.file, answer.line);
    if let Some(excerpt) = &answer.excerpt {
        let _ = writeln!(text, "{file}:{line}: {}", excerpt.trim());
    } else if let Some(record) = &answer.record {
        let _ = writeln!(text, "{file}:{}: {}", record.line, record.statement);
        let _ = writeln!(text, "  record {}", record.number);
    } else {
        let _ = writeln!(text, "{file}:{line} is before the first record");
    }
    for taken in &answer.taken {
        let section = &taken.section;
        let _ = writeln!(text, "  taken by the section {section} without any effect on the post");
    }
    let made = match answer.in_all {
        0 => "no line of the program is caused by it".to_string(),
        1 => "1 line of the program is caused by it".to_string(),
        count => format!("{count} lines of the program are caused by it"),
    };
    let _ = writeln!(text, "  {made}");
}

fn block(text: &mut String, answer: &Answer, line: &Line) {
    let head = match answer.asked {
        Asked::Nc => format!("{}:{}", answer.file, line.number),
        _ => format!("line {}", line.number),
    };
    let _ = writeln!(text, "{head}: {}", line.text.as_deref().unwrap_or("(not at hand)"));
    let of_record = answer.record.as_ref().is_some_and(|asked| asked.number == line.made.record);
    if !of_record || !line.made.fil.is_empty() {
        for origin in origin(&line.made) {
            let _ = writeln!(text, "  {origin}");
        }
    }
    let width = line.words.iter().filter_map(|word| word.text.as_deref());
    let width = width.map(|word| word.chars().count().min(WIDEST)).max().unwrap_or(0);
    let mut told: BTreeSet<u32> = answer.record.iter().map(|asked| asked.number).collect();
    for word in &line.words {
        let shown = word.text.clone().unwrap_or_else(|| word.letter.to_string());
        let _ = writeln!(text, "    {shown:width$}  {}", due(word, &line.made, &mut told));
    }
}

/// Widest column of words.
const WIDEST: usize = 16;

/// Where something comes from: its record and its FIL lines, a line each.
fn origin(made: &Made) -> Vec<String> {
    let mut lines = Vec::new();
    if made.record > 0 {
        lines.push(format!("by {}", record(made)));
    }
    for (index, step) in made.fil.iter().enumerate() {
        let head = match (index, &made.section) {
            (0, Some(section)) => format!("in the section {section}, "),
            (0, None) => "outside of sections, ".to_string(),
            _ => "  called from ".to_string(),
        };
        let text = step.text.as_deref().map_or(String::new(), |text| format!(": {}", text.trim()));
        lines.push(format!("{head}{}:{}{text}", step.file, step.line));
    }
    if lines.is_empty() {
        lines.push("by the machine's settings".to_string());
    }
    lines
}

fn record(made: &Made) -> String {
    let statement = made.statement.as_deref().map_or(String::new(), |text| format!(": {text}"));
    format!("record {}, {}:{}{statement}", made.record, made.cl, made.line)
}

/// The cause of a word, as seen from its block; the statement of a record is
/// told once.
fn due(word: &LineWord, block: &Made, told: &mut BTreeSet<u32>) -> String {
    if word.made.by_machine() {
        return match word.letter {
            '#' => "counted by the post".to_string(),
            _ => "the machine's settings".to_string(),
        };
    }
    let value = word.value.as_deref().map_or(String::new(), |value| format!(" ({value})"));
    let part = match (word.word, word.made_by_fil) {
        (0, _) => String::new(),
        (number, true) => format!("word {number} of what FIL made"),
        (number, false) => format!("word {number}{value}"),
    };
    if word.made == *block {
        return if part.is_empty() { "the record as a whole".to_string() } else { part };
    }
    let place = match word.made.fil.first() {
        Some(step) if word.made_by_fil || word.made.record == 0 => {
            format!("{}:{}", step.file, step.line)
        }
        _ if told.insert(word.made.record) => record(&word.made),
        _ => format!("record {}", word.made.record),
    };
    if part.is_empty() { place } else { format!("{part}, {place}") }
}
