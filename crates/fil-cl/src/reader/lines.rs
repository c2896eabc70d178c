//! Lines out of a chunk buffer, without a copy for each line.

use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;

/// Bytes asked for at once.
const CHUNK: usize = 256 * 1024;

/// Bytes asked for first: a short text needs no large buffer.
const FIRST_CHUNK: usize = 8 * 1024;

/// The byte order mark of UTF-8.
const MARK: &[u8] = b"\xEF\xBB\xBF";

/// What DOS writes at the end of a text.
const END_SIGN: u8 = 0x1A;

/// What can go back, too.
pub(super) trait ReadSeek: Read + Seek {}

impl<R: Read + Seek> ReadSeek for R {}

/// Where the bytes come from. They are asked for a chunk at a time, so that one reader
/// for all inputs costs nothing.
pub(super) enum Input<'r> {
    /// A stream, which cannot go back.
    Stream(Box<dyn Read + Send + 'r>),
    /// A file, which can.
    File(Box<dyn ReadSeek + Send + 'r>),
}

impl Input<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Input::Stream(input) => input.read(buffer),
            Input::File(input) => input.read(buffer),
        }
    }
}

/// Why there is no next line.
pub(super) enum LineError {
    /// The input failed.
    Io(io::Error),
    /// The statement is longer than the limit.
    TooLong,
}

/// The lines of an input. The bytes from the last [`Lines::begin`] on stay in
/// the buffer, so that a statement can be shown whole when it is wrong.
pub(super) struct Lines<'r> {
    input: Input<'r>,
    buffer: Vec<u8>,
    /// End of what is read into the buffer.
    end: usize,
    /// Start of the statement under way.
    mark: usize,
    /// Start of the next line.
    next: usize,
    /// Offset in the input of the first byte of the buffer.
    base: u64,
    /// Number of the next line, 1-based.
    line: u32,
    at_end: bool,
    limit: usize,
    /// The line given last is the last one and has neither line end nor end sign.
    is_open: bool,
}

impl<'r> Lines<'r> {
    pub(super) fn new(input: Input<'r>, limit: usize) -> Self {
        Lines {
            input,
            buffer: Vec::new(),
            end: 0,
            mark: 0,
            next: 0,
            base: 0,
            line: 1,
            at_end: false,
            limit,
            is_open: false,
        }
    }

    /// Passes over the byte order mark of UTF-8; to be called before any line.
    pub(super) fn skip_mark(&mut self) -> io::Result<()> {
        while self.end < MARK.len() && !self.at_end {
            self.fill()?;
        }
        if self.base == 0 && self.next == 0 && self.unread().starts_with(MARK) {
            self.next = MARK.len();
        }
        Ok(())
    }

    /// Reads on until so many bytes lie in the buffer, or all there are.
    pub(super) fn fill_to(&mut self, bytes: usize) -> io::Result<()> {
        while self.end - self.next < bytes && !self.at_end {
            self.fill()?;
        }
        Ok(())
    }

    /// Gives the next line this number.
    pub(super) fn count_from(&mut self, line: u32) {
        self.line = line;
    }

    /// What is in the buffer and not yet given out.
    #[inline]
    pub(super) fn unread(&self) -> &[u8] {
        &self.buffer[self.next..self.end]
    }

    /// Takes whole lines of `length` bytes, line ends included, out of [`Self::unread`].
    #[inline]
    pub(super) fn take_lines(&mut self, length: usize, lines: u32) {
        self.next += length;
        self.line = self.line.saturating_add(lines);
    }

    /// Starts a statement at the next line.
    pub(super) fn begin(&mut self) {
        self.mark = self.next;
    }

    /// The next line, as a range for [`Self::bytes`], without its line end.
    pub(super) fn next_line(&mut self) -> Result<Option<Range<usize>>, LineError> {
        let mut searched = self.next - self.mark;
        loop {
            let from = self.mark + searched;
            if let Some(at) = memchr::memchr(b'\n', &self.buffer[from..self.end]) {
                return Ok(Some(self.give(from + at, from + at + 1)));
            }
            searched = self.end - self.mark;
            if searched > self.limit {
                return Err(LineError::TooLong);
            }
            if self.at_end {
                return Ok(self.give_last());
            }
            self.fill().map_err(LineError::Io)?;
        }
    }

    /// Goes back to the line that the statement under way began with.
    pub(super) fn go_back(&mut self, line: u32) {
        (self.next, self.line, self.is_open) = (self.mark, line, false);
    }

    fn give(&mut self, end: usize, next: usize) -> Range<usize> {
        let line = self.next - self.mark..end - self.mark;
        self.next = next;
        self.line = self.line.saturating_add(1);
        line
    }

    /// A last line that has no line end.
    fn give_last(&mut self) -> Option<Range<usize>> {
        let line = &self.buffer[self.next..self.end];
        let signs = line.iter().rev().take_while(|byte| **byte == END_SIGN).count();
        self.is_open = signs == 0 && !line.is_empty();
        (!line.is_empty()).then(|| self.give(self.end - signs, self.end))
    }

    /// True when the line given last may have been cut off.
    pub(super) fn is_open(&self) -> bool {
        self.is_open
    }

    /// The bytes of a line of the statement under way.
    pub(super) fn bytes(&self, line: Range<usize>) -> &[u8] {
        &self.buffer[self.mark + line.start..self.mark + line.end]
    }

    /// Everything of the statement under way that is in the buffer.
    pub(super) fn statement(&self) -> &[u8] {
        &self.buffer[self.mark..self.end]
    }

    /// The lines of the statement under way, with their line ends.
    pub(super) fn taken(&self) -> &[u8] {
        &self.buffer[self.mark..self.next]
    }

    /// Number of the next line.
    pub(super) fn line(&self) -> u32 {
        self.line
    }

    /// Offset of the next line in the input.
    pub(super) fn offset(&self) -> u64 {
        self.base + self.next as u64
    }

    /// True when the input can go back.
    pub(super) fn can_go_back(&self) -> bool {
        matches!(self.input, Input::File(_))
    }

    /// Goes to an offset in the input, where line `line` begins.
    pub(super) fn go_to(&mut self, offset: u64, line: u32) -> io::Result<()> {
        (self.line, self.is_open) = (line, false);
        if !(self.base..=self.base + self.end as u64).contains(&offset) {
            self.forget(offset)?;
        }
        let at = (offset - self.base) as usize;
        (self.mark, self.next) = (0, 0);
        self.fill_to(at)?;
        self.next = at.min(self.end);
        self.mark = self.next;
        Ok(())
    }

    /// Forgets the buffer. What comes before the offset is read again with it, since who goes
    /// back once goes further.
    fn forget(&mut self, offset: u64) -> io::Result<()> {
        self.base = offset.saturating_sub(CHUNK as u64 / 2);
        (self.end, self.mark, self.next, self.at_end) = (0, 0, 0, false);
        match &mut self.input {
            Input::File(input) => input.seek(SeekFrom::Start(self.base)).map(|_| ()),
            Input::Stream(_) => Ok(()),
        }
    }

    /// Reads on, moving what is still needed to the front or growing the buffer.
    fn fill(&mut self) -> io::Result<()> {
        if self.end == self.buffer.len() {
            let start = self.mark.min(self.next);
            self.buffer.copy_within(start..self.end, 0);
            self.base += start as u64;
            self.mark -= start;
            self.next -= start;
            self.end -= start;
            if self.buffer.len() - self.end < CHUNK / 2 {
                let more = self.buffer.len().clamp(FIRST_CHUNK, CHUNK);
                self.buffer.resize(self.buffer.len() + more, 0);
            }
        }
        loop {
            match self.input.read(&mut self.buffer[self.end..]) {
                Ok(count) => {
                    self.end += count;
                    self.at_end = count == 0;
                    return Ok(());
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}
