//! The way from text to tree.

use fil_diag::{Diag, TextSpan};

use crate::adapter::{Adapter, Shared};
use crate::errors::SyntaxCode;
use crate::grammar::FileParser;
use crate::reader::Reader;
use crate::structure;
use crate::tree::Program;

/// The largest file, in bytes.
pub(crate) const MAX_FILE: usize = 64 << 20;
/// The longest line, in bytes.
const MAX_LINE: usize = 16_384;
/// How much of a line that is too long is shown, in characters.
const MAX_EXCERPT: usize = 80;

/// What came of a FIL text.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The tree of all that could be read. When there are errors it is good for
    /// looking at, not for running.
    pub program: Program,
    /// Errors and warnings in source order, a hundred at most and one more that
    /// says so.
    pub diags: Vec<Diag>,
}

/// Reads a FIL text. Any text is read in time proportional to its length;
/// `file` is the name that diagnostics carry.
pub fn parse(file: &str, source: &str) -> Parsed {
    let source = source.strip_prefix('\u{feff}').unwrap_or(source);
    if let Some(diag) = beyond_limits(file, source) {
        return Parsed { program: Program::default(), diags: vec![diag] };
    }
    let shared = Shared::default();
    let mut reader = Reader::new(file, source, &shared);
    let tokens = Adapter::new(source, &shared);
    // Every error is recovered from at the end of its statement and has been
    // reported then; what is left to fail here is a stop at too many of them.
    let _ = FileParser::new().parse(&mut reader, tokens);
    let statements = std::mem::take(&mut reader.flats);
    let program = structure::nest(&mut reader, statements);
    report_rest(&mut reader, &shared);
    let mut diags = reader.diags;
    let closing = diags.split_off(diags.len().min(crate::reader::MAX_DIAGS));
    diags.sort_by_key(|diag| diag.spans.first().map(|place| (place.line, place.span.start)));
    diags.extend(closing);
    Parsed { program, diags }
}

fn report_rest(reader: &mut Reader<'_>, shared: &Shared) {
    // A FINI in a statement that could not be read is perhaps no end.
    if reader.unreadable {
        return;
    }
    if let Some(span) = shared.section_after_fini.get() {
        reader.report(SyntaxCode::SectionAfterFini, "this section after FINI is not read", span);
    } else if let Some(span) = shared.after_fini.get() {
        reader.report(SyntaxCode::AfterFini, "what follows FINI is not read", span);
    }
}

/// Refuses what cannot be a FIL file by its mere size.
fn beyond_limits(file: &str, source: &str) -> Option<Diag> {
    if source.len() > MAX_FILE {
        let message = format!("the file has {} bytes", source.len());
        return Some(Diag::new(SyntaxCode::FileTooLarge, message).at(TextSpan::line(
            file,
            1,
            String::new(),
        )));
    }
    let (index, line) = source.split('\n').enumerate().find(|(_, line)| line.len() > MAX_LINE)?;
    let head: String = line.chars().take(MAX_EXCERPT).collect();
    let message = format!("the line has {} bytes", line.len());
    let place = TextSpan::line(file, index as u32 + 1, head);
    Some(Diag::new(SyntaxCode::TooLong, message).at(place))
}
