//! One canonical layout of FIL. The rules are shown in `docs/fmt.md`.
//!
//! The tree has no comments, so this works on the tokens of the grammar and on
//! what stands between them. Tokens are never changed but for the case of words
//! and names; layout decides about blanks, line breaks and indentation only.

mod blocks;
#[cfg(feature = "code-pages")]
mod bytes;
mod collect;
mod gap;
mod pieces;
mod wrap;

use fil_diag::{CodeKind, Diag};

use crate::parse::{MAX_FILE, parse};
use crate::print::print;
use crate::tree::Program;
use blocks::{Blocks, Depth};
#[cfg(feature = "code-pages")]
pub use bytes::format_bytes;
use collect::{Above, Layout, Line, Rest, Statement};

/// Blanks for each block a line stands in.
const STEP: usize = 2;

/// A FIL text in its canonical layout. Formatting the result again gives the
/// same text, and reading it gives the same tree but for its spans.
///
/// The text is returned as it is when another layout would say something else
/// than it does, as when indentation makes a line longer than a line may be.
/// A byte order mark is dropped. `file` is the name that diagnostics carry.
///
/// # Errors
/// The diagnostics of a text that can't be read; warnings and what a user can allow
/// don't matter here.
pub fn format(file: &str, source: &str) -> Result<String, Vec<Diag>> {
    let source = source.strip_prefix('\u{feff}').unwrap_or(source);
    let program = read(file, source)?;
    let text = written(&collect::layout(source), line_end(source));
    let same = read(file, &text).is_ok_and(|again| print(&again) == print(&program));
    Ok(if same { text } else { source.to_string() })
}

fn read(file: &str, source: &str) -> Result<Program, Vec<Diag>> {
    let parsed = parse(file, source);
    let refused = |diag: &Diag| diag.is_error() && diag.code.kind != CodeKind::Doubt;
    if parsed.diags.iter().any(refused) { Err(parsed.diags) } else { Ok(parsed.program) }
}

/// How the lines of a text end: as its first one does.
fn line_end(source: &str) -> &'static str {
    match source.find(['\r', '\n']).map(|at| &source[at..]) {
        Some(rest) if rest.starts_with("\r\n") => "\r\n",
        Some(rest) if rest.starts_with('\r') => "\r",
        _ => "\n",
    }
}

fn written(layout: &Layout<'_>, line_end: &'static str) -> String {
    let mut writer = Writer { text: String::new(), line_end, blocks: Blocks::default() };
    for line in &layout.lines {
        writer.line(line);
    }
    writer.above(&layout.below, 0);
    writer.rest(&layout.rest);
    writer.text
}

/// Writes lines one after the other.
struct Writer {
    text: String,
    line_end: &'static str,
    blocks: Blocks,
}

impl Writer {
    /// Statements that share a line, with what stands above and behind them.
    fn line(&mut self, line: &Line<'_>) {
        let depths: Vec<Depth> =
            line.statements.iter().map(|statement| self.blocks.place(statement)).collect();
        let first = depths.first().copied().unwrap_or_default();
        self.above(&line.above, first.comment * STEP);
        let indent = first.statement * STEP;
        match together(&line.statements, indent) {
            Some(text) => self.lines(indent, vec![text]),
            None => {
                for (statement, depth) in line.statements.iter().zip(&depths) {
                    let indent = depth.statement * STEP;
                    self.lines(indent, wrap::lines(&pieces::pieces(statement), indent));
                }
            }
        }
        if let Some(comment) = line.trailing {
            let end = self.text.len() - self.line_end.len();
            self.text.insert_str(end, &format!("  {comment}"));
        }
    }

    /// The lines of a statement: the first one indented, the others as they are.
    fn lines(&mut self, indent: usize, lines: Vec<String>) {
        // Indentation can make a text many times longer: one that is longer than
        // a file may be is given up anyway.
        if self.text.len() > MAX_FILE {
            return;
        }
        for (index, line) in lines.iter().enumerate() {
            if index == 0 {
                self.text.extend(std::iter::repeat_n(' ', indent));
            }
            self.text.push_str(line);
            self.text.push_str(self.line_end);
        }
    }

    /// Comments and blank lines above a line.
    fn above(&mut self, above: &[Above<'_>], indent: usize) {
        for block in above.chunk_by(|a, b| kind(a) == kind(b)) {
            let banner = is_banner(block);
            for line in block {
                if let Above::Comment { text, .. } = line {
                    self.lines(if banner { 0 } else { indent }, vec![(*text).to_string()]);
                }
            }
            if matches!(block, [Above::Blank, ..]) && !self.text.is_empty() {
                self.text.push_str(self.line_end);
            }
        }
    }

    /// The end of the text: what follows FINI, which nobody reads, with the line ends of
    /// the file, or else no blank lines.
    fn rest(&mut self, rest: &Rest<'_>) {
        let unread = |text: &str| {
            text.replace("\r\n", "\n").replace('\r', "\n").replace('\n', self.line_end)
        };
        match rest {
            Rest::None => {
                let end = self.text.trim_end_matches(['\r', '\n']).len();
                self.text.truncate(end);
                if end == 0 {
                    return;
                }
            }
            Rest::Below(text) => self.text.push_str(&unread(text)),
            Rest::SameLine(text) => {
                self.text.truncate(self.text.len() - self.line_end.len());
                self.text.push_str("; ");
                self.text.push_str(&unread(text));
            }
        }
        self.text.push_str(self.line_end);
    }
}

/// Statements of one line as its text; `None` when each needs lines of its own.
fn together(statements: &[Statement<'_>], indent: usize) -> Option<String> {
    let each: Vec<Vec<String>> = statements
        .iter()
        .map(|statement| wrap::lines(&pieces::pieces(statement), indent))
        .collect();
    if each.iter().any(|lines| lines.len() > 1) {
        return None;
    }
    let text = each.concat().join("; ");
    (statements.len() == 1 || indent + text.chars().count() <= wrap::WIDTH).then_some(text)
}

/// Lines of one kind make a block: blank ones, comments in the first column,
/// other comments.
fn kind(line: &Above<'_>) -> Option<bool> {
    match line {
        Above::Blank => None,
        Above::Comment { first_column, .. } => Some(*first_column),
    }
}

/// True for a banner: comments in the first column with a ruler of signs among
/// them.
fn is_banner(block: &[Above<'_>]) -> bool {
    block
        .iter()
        .any(|line| matches!(line, Above::Comment { text, first_column: true } if has_ruler(text)))
}

/// True for a comment with three or more of the same sign in a row.
fn has_ruler(comment: &str) -> bool {
    let inner = comment.strip_prefix("$$").unwrap_or(comment).as_bytes();
    inner.windows(3).any(|three| {
        three[0].is_ascii_punctuation() && three[0] != b'.' && three.iter().all(|c| *c == three[0])
    })
}
