//! What is behind each word of a block.

use std::io::Cursor;

use filpost::map::{Entry, MapReader, Names, Word};
use serde_json::{Value, json};

use crate::fields::Fields;
use crate::job::Job;
use crate::{Fault, Misuse, refused};

/// Answers with the `words` of a line of the program, `nc_line`, or with `errors`. It has the keys of a request to post.
///
/// Each word has its `text`, `from` and `to` (letters of the block), the CL `line` and the `record` that ask for it, 0 where the
/// settings do, `word`, that of the record as POSTF(7,n) counts (0 for the record as a whole), `by_fil`, whether a
/// script made that record, and `fil`, file and line of each statement of a script, innermost first.
pub(crate) fn behind(mut fields: Fields) -> Result<Value, Misuse> {
    let line = fields.number("nc_line")?.ok_or_else(|| Misuse("`nc_line` is missing".into()))?;
    let job = Job::read(fields)?;
    Ok(words(&job, line).unwrap_or_else(|fault| refused(&fault, &[])))
}

fn words(job: &Job, line: u64) -> Result<Value, Fault> {
    let program = job.program()?;
    let names =
        Names { cl: job.cl_name.clone(), nc: "program.nc".into(), fil: program.fil_files() };
    let (mut nc, mut map) = (Vec::new(), Vec::new());
    let cl = Cursor::new(job.cl.as_bytes());
    job.start(&program)?.run_mapped(cl, &mut nc, &names, &mut map)?;
    let nc = program.nc_page().decode_all(&nc);
    let block = usize::try_from(line).ok().and_then(|line| nc.lines().nth(line.checked_sub(1)?));
    let (Some(block), mut map) = (block, MapReader::new("the line map", Cursor::new(map))?) else {
        return Ok(json!({ "words": [] }));
    };
    let mut found = Vec::new();
    for entry in &mut map {
        match entry? {
            Entry::Line(of) if of.number == line => {
                found = of.words;
                break;
            }
            _ => {}
        }
    }
    let letters = |end: usize| block.get(..end).map_or(end, |head| head.encode_utf16().count());
    let said = |word: &Word| {
        let lines = map.stack(word.cause).map_or(&[][..], |stack| stack.lines.as_slice());
        let fil = lines.iter().map(|at| json!([names.fil.get(usize::from(at.file)), at.line]));
        json!({
            "text": word.text(block), "from": letters(word.range.start), "to": letters(word.range.end),
            "line": word.cause.line, "record": word.cause.record, "word": word.cause.word,
            "by_fil": word.cause.made_by_fil, "fil": fil.collect::<Vec<_>>(),
        })
    };
    Ok(json!({ "words": found.iter().map(said).collect::<Vec<_>>() }))
}
