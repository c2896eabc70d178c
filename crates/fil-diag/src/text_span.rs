//! Places in a text: file, line, column, and the line itself as an excerpt.

use std::fmt;
use std::ops::Range;

/// A place in a file. It carries the text of its line, so that whoever renders
/// it need not read the file again (CL files are streamed and may be huge).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextSpan {
    /// Name of the file as the user gave it.
    pub file: String,
    /// Line number, 1-based.
    pub line: u32,
    /// Byte range within `excerpt`.
    pub span: Range<usize>,
    /// The text of the line (or the first lines), without line end.
    pub excerpt: String,
    /// What is to be seen here; may be empty.
    pub label: String,
}

impl TextSpan {
    /// A place that covers a whole line of text.
    pub fn line(file: impl Into<String>, line: u32, excerpt: impl Into<String>) -> Self {
        let excerpt = excerpt.into();
        TextSpan { file: file.into(), line, span: 0..excerpt.len(), excerpt, label: String::new() }
    }

    /// Sets the label.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Column of the start, 1-based, counted in characters.
    pub fn column(&self) -> usize {
        self.excerpt.get(..self.span.start).map_or(0, |head| head.chars().count()) + 1
    }
}

impl fmt::Display for TextSpan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column())
    }
}

/// Start offsets of the lines of a text, to turn byte ranges into [`TextSpan`]s.
#[derive(Clone, Debug)]
pub struct LineIndex {
    starts: Vec<usize>,
}

impl LineIndex {
    /// Indexes a text.
    pub fn new(text: &str) -> Self {
        let starts = std::iter::once(0)
            .chain(text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1))
            .collect();
        LineIndex { starts }
    }

    /// Line number, 1-based, of a byte offset.
    pub fn line(&self, offset: usize) -> u32 {
        self.starts.partition_point(|start| *start <= offset) as u32
    }

    /// The place of a byte range; a range over several lines is cut to its first line.
    pub fn place(&self, file: &str, text: &str, range: Range<usize>) -> TextSpan {
        let line = self.line(range.start);
        let start = self.starts[line as usize - 1];
        let end = self.starts.get(line as usize).map_or(text.len(), |next| next - 1);
        let excerpt = text[start..end].trim_end_matches('\r');
        let from = (range.start - start).min(excerpt.len());
        let to = range.end.saturating_sub(start).clamp(from, excerpt.len());
        TextSpan {
            file: file.to_string(),
            line,
            span: from..to,
            excerpt: excerpt.to_string(),
            label: String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_cut_to_its_first_line() {
        let text = "AA = 1\r\nBB = 2 +\nCC";
        let place = LineIndex::new(text).place("f.fil", text, 13..19);
        assert_eq!((place.line, place.column(), place.excerpt.as_str()), (2, 6, "BB = 2 +"));
        assert_eq!(&place.excerpt[place.span.clone()], "2 +");
    }
}
