//! CL files in an editor: numbered words of a statement, tools and operations.

use std::io::Read;

use filpost::cl::reader::{self, Reader};
use filpost::cl::record::WordView;
use filpost::cl::{Record, Vocabulary};

use crate::context::parts;
use crate::positions::meaning;
use crate::symbols::{Outline, OutlineKind};
use crate::tables;
use crate::text::{Position, Range, Text};

/// A statement with its lines, continuations joined.
struct Statement {
    first: usize,
    last: usize,
    text: String,
}

fn continues(line: &str) -> bool {
    let line = line.trim_end();
    line.ends_with('$') && !line.trim_start().starts_with("$$")
}

fn statement_at(text: &Text, line: usize) -> Statement {
    let mut first = line;
    while first > 0 && continues(text.line(first - 1)) {
        first -= 1;
    }
    let mut last = first;
    let mut joined = String::new();
    loop {
        let own = text.line(last).trim_end();
        if continues(own) && last + 1 < text.line_count() {
            joined.push_str(own.trim_end_matches('$'));
            last += 1;
        } else {
            joined.push_str(own);
            return Statement { first, last, text: joined };
        }
    }
}

/// The words of the statement at a place by number, as POSTF(7,n) counts them, and what
/// its major word means.
pub fn hover(text: &Text, position: Position) -> Option<(String, Range)> {
    let statement = statement_at(text, position.line as usize);
    let major = major_word(&statement.text)?;
    let range = Range {
        start: text.range(text.line_bytes(statement.first)).start,
        end: text.range(text.line_bytes(statement.last)).end,
    };
    let shown: String = records(text, &statement)
        .iter()
        .map(|(vocabulary, record)| format!("```text\n{}```\n\n", words(record, vocabulary)))
        .collect();
    Some((format!("{shown}{}", tables::word(&major)), range))
}

/// Records of one statement that are shown: some dialects make several of one.
const MOST_RECORDS: usize = 3;

/// The records of a statement as the reader of CL files gives them, in the dialect of the
/// file; none of a statement that it can't read.
fn records(text: &Text, statement: &Statement) -> Vec<(Vocabulary, Record)> {
    let end = text.line_bytes(statement.last).end;
    let above = &text.as_str()[..end];
    let lines = statement.first as u32 + 1..=statement.last as u32 + 1;
    // A statement at the end of the text is whole here: more may be typed below it.
    let ended = above.as_bytes().chain(&b"\n"[..]);
    let mut reader = Reader::new(ended, "", reader::Options::default());
    let mut vocabulary = Vocabulary::new();
    let mut record = Record::default();
    let mut found = Vec::new();
    while found.len() < MOST_RECORDS {
        match reader.read(&mut vocabulary, &mut record) {
            Ok(true) if lines.contains(&record.line) => {
                found.push((vocabulary.clone(), record.clone()));
            }
            Ok(true) => {}
            Ok(false) => break,
            Err(_) if reader.resume() => {}
            Err(_) => break,
        }
    }
    found
}

/// `   4  DRILL        type, or OFF`, a line for each word.
fn words(record: &Record, vocabulary: &Vocabulary) -> String {
    let named = |n: usize| match record.word(n, vocabulary) {
        Some(WordView::Word { name, .. }) => Some(name.to_string()),
        _ => None,
    };
    let (major, minor) = (vocabulary.name(record.major), named(4));
    let mut shown = String::new();
    for n in 1..=record.len() {
        let word = match record.word(n, vocabulary) {
            Some(WordView::Number(number)) => number.to_string(),
            Some(WordView::Word { name, .. }) => name.to_string(),
            Some(WordView::Text(text)) => format!("'{text}'"),
            Some(WordView::Empty) => "EMPTY".to_string(),
            None => continue,
        };
        let meaning = meaning(major, minor.as_deref(), n).unwrap_or_default();
        let line = format!("{n:>4}  {word:<12} {meaning}");
        shown.push_str(line.trim_end());
        shown.push('\n');
    }
    shown
}

/// The major word of a statement, behind which a text may stand without a slash (PPRINT);
/// `None` for comments and empty lines.
fn major_word(statement: &str) -> Option<String> {
    let own = statement.trim_start();
    let end = own.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(own.len());
    (end > 0).then(|| own[..end].to_ascii_uppercase())
}

/// Major word and items of a statement; `None` for comments and empty lines.
fn split(statement: &str) -> Option<(String, Vec<String>)> {
    let plain = statement.split("$$").next().unwrap_or_default();
    let (major, rest) = plain.split_once('/').unwrap_or((plain, ""));
    let major = major.trim().to_ascii_uppercase();
    let is_word = !major.is_empty() && major.bytes().all(|byte| byte.is_ascii_alphanumeric());
    if !is_word {
        return None;
    }
    let items = parts(rest).into_iter().map(|item| item.trim().to_string());
    Some((major, items.filter(|item| !item.is_empty()).collect()))
}

/// Tools with the operations that they do: comments of the CAM system that name a feature,
/// cycles, and rapid motions after feed.
pub fn outline(text: &Text) -> Vec<Outline> {
    let vocabulary = Vocabulary::new();
    let mut found: Vec<Outline> = Vec::new();
    for line in 0..text.line_count() {
        let own = text.line(line).trim();
        let range = text.range(text.line_bytes(line));
        let entry = |name: String, kind: OutlineKind| Outline {
            name,
            kind,
            whole: range,
            range,
            children: Vec::new(),
        };
        let feature = own.strip_prefix("$$->").map(str::trim).filter(|rest| {
            rest.starts_with("FEATNO") || rest.starts_with("MFGNO") || rest.starts_with("OPERATION")
        });
        let statement = split(own);
        let major = statement.as_ref().map_or("", |(major, _)| major.as_str());
        let (entry, is_tool) = match (feature, major) {
            (Some(name), _) => (entry(name.to_string(), OutlineKind::Section), false),
            (None, "LOADTL" | "TURRET" | "TOOLNO") => {
                (entry(own.to_string(), OutlineKind::Group), true)
            }
            (None, "CYCLE" | "THREAD" | "PARTNO" | "PPRINT") => {
                (entry(own.to_string(), OutlineKind::Section), false)
            }
            (None, _) => {
                let known = vocabulary.find(major).is_some_and(|id| vocabulary.is_known(id));
                if let Some(last) = found.last_mut().filter(|_| known) {
                    last.whole.end = range.end;
                }
                continue;
            }
        };
        match found.last_mut().filter(|last| !is_tool && last.kind == OutlineKind::Group) {
            Some(tool) => {
                tool.whole.end = range.end;
                tool.children.push(entry);
            }
            None => found.push(entry),
        }
    }
    found
}
