//! The tape: finished blocks as text, with sequence numbers and provenance.

use fil_diag::Result;
use fil_machine::address::no_address;
use fil_machine::letters::{G, M, N};
use fil_machine::number::NumberFormat;
use fil_machine::rounding::Rounding;
use fil_machine::tables::MachineTables;
use fil_machine::tape_style::TapeStyle;
use fil_machine::{Commons, Letter};

use crate::block::{Block, function, named};
use crate::cause::{Cause, Stacks};
use crate::editing::EditorSlot;
use crate::errors::PostCode;
use crate::noted::{Noted, SEQUENCE, SKIP, TEXT};
use crate::replaced::Replaced;

/// Sequence numbers: what is due for the next block.
#[derive(Clone, Debug, Default)]
struct Sequence {
    next: Option<f64>,
    increment: Option<f64>,
    switched: Option<bool>,
    since_last: i32,
    cause: Cause,
    /// The next number is one at which the program can be begun anew.
    aligns: bool,
}

/// The output side of the post.
#[derive(Clone, Default)]
pub struct Tape {
    /// Text of the blocks not yet taken away.
    pub text: Vec<u8>,
    /// The finished blocks within `text` and their words, when observed; see
    /// [`Post::observe`](crate::Post::observe).
    pub noted: Option<Noted>,
    /// The cause of the blocks written next.
    pub cause: Cause,
    /// The FIL call stacks that causes name.
    pub stacks: Stacks,
    /// Number of blocks written so far.
    pub count: u64,
    /// The next blocks carry the block-delete character, for this cause.
    pub skip: Option<Cause>,
    /// Who edits blocks and lines.
    pub editor: EditorSlot,
    /// Texts that are written otherwise.
    pub replaced: Replaced,
    sequence: Sequence,
}

/// How POSTN rounds: P in whole numbers names an offset or a program.
fn as_given(letter: Letter, format: &NumberFormat) -> Rounding {
    let names = letter.byte() == b'P' && format.decimals == 0;
    if names { Rounding::Exact } else { Rounding::of(letter) }
}

impl Tape {
    /// Writes a block with its sequence number; a block of which the machine
    /// writes no word is left out.
    ///
    /// # Errors
    /// A sequence number that does not fit its address.
    pub fn block(
        &mut self,
        block: &Block,
        tables: &MachineTables,
        commons: &mut Commons,
    ) -> Result<()> {
        let addresses = &tables.addresses;
        if !block.prints(addresses) {
            return Ok(());
        }
        block.check_functions(addresses)?;
        let start = self.begin(true, tables, commons)?;
        match &mut self.noted {
            Some(noted) => {
                let cause = self.cause;
                block.write(addresses, commons, &mut self.text, |letter, at, word| {
                    noted.word(letter, at - start, word, cause);
                });
            }
            None => block.write(addresses, commons, &mut self.text, |_, _, _| {}),
        }
        self.end(start, tables)
    }

    /// Writes words in the order given, whatever the tape order; all of them,
    /// whether or not their values have changed. Each comes with its cause.
    ///
    /// # Errors
    /// The machine has no such address, or a value does not fit it.
    pub fn words(
        &mut self,
        words: &[(Letter, f64, Cause)],
        tables: &MachineTables,
        commons: &mut Commons,
    ) -> Result<()> {
        let addresses = &tables.addresses;
        // The usual word has no more bytes.
        let mut line = Vec::with_capacity(words.len() * 12);
        let mut written = Vec::with_capacity(words.len());
        for &(letter, value, cause) in words {
            let position = addresses.position(letter).ok_or_else(|| no_address(letter))?;
            let slot = addresses.slot(position);
            if addresses.blank && !line.is_empty() {
                line.push(b' ');
            }
            let at = line.len();
            line.push(slot.character);
            let last = if matches!(letter, G | M) {
                let code = function(letter, value)?;
                code.check(letter, &slot.format)?;
                code.write(&slot.format, &mut line);
                code.value()
            } else {
                let scaled = as_given(letter, &slot.format).scale(value, &slot.format);
                let scaled = scaled.map_err(|diag| named(diag, letter))?;
                slot.format.write(scaled, &mut line);
                slot.format.unscale(scaled)
            };
            written.push((letter, last, at, cause));
        }
        written.iter().for_each(|&(letter, last, ..)| commons.set_last_output(letter, last));
        let start = self.begin(true, tables, commons)?;
        let base = self.text.len() - start;
        if let Some(all) = &mut self.noted {
            for &(letter, _, at, cause) in &written {
                all.word(letter.byte(), base + at, cause, self.cause);
            }
        }
        self.text.extend_from_slice(&line);
        self.end(start, tables)
    }

    /// Writes a text as a block, with or without a sequence number, and with
    /// its cause.
    ///
    /// # Errors
    /// As [`Tape::block`].
    pub fn line(
        &mut self,
        text: &str,
        cause: Cause,
        numbered: bool,
        tables: &MachineTables,
        commons: &mut Commons,
    ) -> Result<()> {
        self.items(text, &[(TEXT, 0, cause)], numbered, tables, commons)
    }

    /// Writes a text as a block: its items, each with its letter, its first byte in the
    /// text and its cause.
    ///
    /// # Errors
    /// As [`Tape::block`].
    pub(crate) fn items(
        &mut self,
        text: &str,
        items: &[(u8, usize, Cause)],
        numbered: bool,
        tables: &MachineTables,
        commons: &mut Commons,
    ) -> Result<()> {
        let start = self.begin(numbered, tables, commons)?;
        self.complete(start, text, items, tables)
    }

    /// Writes a line of a control whose blocks are no words: its number where it has one,
    /// and its items, each with its letter, its first byte in the text and its cause.
    ///
    /// # Errors
    /// A line longer than the control reads.
    pub(crate) fn phrase(
        &mut self,
        number: Option<u64>,
        text: &str,
        items: &[(u8, usize, Cause)],
        tables: &MachineTables,
    ) -> Result<()> {
        let start = self.text.len();
        if let Some(cause) = self.skip {
            self.note(SKIP, cause, start);
            self.skip_mark(tables)?;
        }
        if let Some(number) = number {
            self.note(SEQUENCE, self.sequence.cause, start);
            self.text.extend_from_slice(format!("{number} ").as_bytes());
        }
        self.complete(start, text, items, tables)
    }

    /// Puts a line on the tape that goes on with the block before it, so it has neither a
    /// number nor a skip mark of its own.
    ///
    /// # Errors
    /// As [`Tape::phrase`].
    pub(crate) fn phrase_more(
        &mut self,
        text: &str,
        items: &[(u8, usize, Cause)],
        tables: &MachineTables,
    ) -> Result<()> {
        self.complete(self.text.len(), text, items, tables)
    }

    /// Writes the text of a block that begins at `start`, and its end; notes its words.
    fn complete(
        &mut self,
        start: usize,
        text: &str,
        items: &[(u8, usize, Cause)],
        tables: &MachineTables,
    ) -> Result<()> {
        let base = self.text.len() - start;
        if let Some(noted) = &mut self.noted {
            items.iter().for_each(|&(letter, at, cause)| {
                noted.word(letter, base + at, cause, self.cause);
            });
        }
        self.text.extend_from_slice(text.as_bytes());
        self.end(start, tables)
    }

    /// Blocks are numbered: SEQNO/ON or SEQNO/OFF said so, else the machine.
    pub(crate) fn numbers(&self, tables: &MachineTables) -> bool {
        self.sequence.switched.unwrap_or(tables.numbering.on)
    }

    /// Sets the number of the next block and, where given, the increment.
    pub fn renumber(&mut self, next: f64, increment: Option<f64>) {
        self.sequence.next = Some(next);
        self.sequence.increment = increment.or(self.sequence.increment);
        self.sequence.since_last = 0;
        self.sequence.cause = self.cause;
    }

    /// The program can be begun anew at the next block that has a number.
    pub fn align(&mut self) {
        self.sequence.aligns = true;
    }

    /// Switches sequence numbers on or off.
    pub fn switch_numbers(&mut self, on: bool) {
        self.sequence.switched = Some(on);
        self.sequence.cause = self.cause;
    }

    /// The last line, which starts at byte `start`, without what ends it.
    pub(crate) fn last_line(&self, start: usize, tables: &MachineTables) -> String {
        let end = self.text.len() - tables.style.line_end().len();
        String::from_utf8_lossy(&self.text[start..end]).into_owned()
    }

    /// Puts a line in the place of the last one; an empty one takes it off the tape.
    ///
    /// # Errors
    /// A line that is too long.
    pub(crate) fn replace_last_line(
        &mut self,
        start: usize,
        line: &str,
        tables: &MachineTables,
    ) -> Result<()> {
        self.text.truncate(start);
        self.count -= 1;
        if let Some(noted) = &mut self.noted {
            noted.drop_last();
        }
        if line.is_empty() {
            return Ok(());
        }
        self.note(TEXT, self.cause, start);
        self.text.extend_from_slice(line.as_bytes());
        check(&self.text[start..], &tables.style)?;
        self.count += 1;
        if let Some(noted) = &mut self.noted {
            noted.block(start..self.text.len(), self.cause);
        }
        self.text.extend_from_slice(tables.style.line_end());
        Ok(())
    }

    /// Begins a block; gives the byte of [`Tape::text`] where it starts.
    #[inline(always)]
    fn begin(
        &mut self,
        numbered: bool,
        tables: &MachineTables,
        commons: &mut Commons,
    ) -> Result<usize> {
        let start = self.text.len();
        if let Some(cause) = self.skip {
            self.note(SKIP, cause, start);
            self.skip_mark(tables)?;
        }
        if numbered {
            self.number(start, tables, commons)?;
        }
        Ok(start)
    }

    /// Writes the sequence number of a block that starts at byte `block`.
    fn number(
        &mut self,
        block: usize,
        tables: &MachineTables,
        commons: &mut Commons,
    ) -> Result<()> {
        let rules = &tables.numbering;
        let on = self.sequence.switched.unwrap_or(rules.on);
        let align = rules.align.filter(|_| std::mem::take(&mut self.sequence.aligns));
        let Some(slot) = rules.slot.as_ref().filter(|_| on || align.is_some()) else {
            return Ok(());
        };
        self.sequence.since_last += 1;
        let is_due = self.sequence.since_last >= rules.every || self.sequence.next.is_none();
        if !is_due && align.is_none() {
            return Ok(());
        }
        self.sequence.since_last = 0;
        let increment = self.sequence.increment.or(rules.increment).unwrap_or(1.0);
        let first = increment + rules.start_offset;
        let mut number = self.sequence.next.unwrap_or(first);
        if number > rules.max {
            number = first;
        }
        self.sequence.next = Some(number + increment);
        let scaled = slot.format.exact(number).map_err(|diag| named(diag, N))?;
        self.note(SEQUENCE, self.sequence.cause, block);
        slot.format.write_word(align.unwrap_or(slot.character), scaled, &mut self.text);
        if tables.addresses.blank {
            self.text.push(b' ');
        }
        commons.set_last_output(N, number);
        Ok(())
    }

    /// Notes the word that is written next, of a block that starts at byte `block`.
    #[inline]
    fn note(&mut self, letter: u8, cause: Cause, block: usize) {
        if let Some(noted) = &mut self.noted {
            noted.word(letter, self.text.len() - block, cause, self.cause);
        }
    }

    #[cold]
    fn skip_mark(&mut self, tables: &MachineTables) -> Result<()> {
        match tables.style.skip {
            Some(mark) => self.text.push(mark as u8),
            None => {
                return PostCode::NoCode.err("the machine has no mark for OPSKIP (INTCOM 1842)");
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn end(&mut self, start: usize, tables: &MachineTables) -> Result<()> {
        if !tables.style.is_plain {
            self.finish(start, &tables.style)?;
        }
        self.count += 1;
        if let Some(noted) = &mut self.noted {
            noted.block(start..self.text.len(), self.cause);
        }
        if tables.style.is_plain {
            self.text.push(b'\n');
        } else {
            self.text.extend_from_slice(tables.style.line_end());
        }
        Ok(())
    }

    #[cold]
    fn finish(&mut self, start: usize, style: &TapeStyle) -> Result<()> {
        style.finish(&mut self.text, start);
        check(&self.text[start..], style)
    }
}

/// Refuses a block that the control can't read.
///
/// # Errors
/// It is too long, or has a letter that the encoding of the tape lacks.
fn check(block: &[u8], style: &TapeStyle) -> Result<()> {
    if style.longest.is_none() && block.is_ascii() {
        return Ok(());
    }
    let block = String::from_utf8_lossy(block);
    let page = style.page;
    let length = match page.encode(&block) {
        Ok(_) if page.is_utf8() => block.chars().count(),
        Ok(bytes) => bytes.len(),
        Err(letter) => {
            let message = format!("`{letter}` of `{block}` is no letter of {page}");
            return PostCode::TapeLetter.err(message);
        }
    };
    match style.longest {
        Some(longest) if length > longest => PostCode::BlockLength
            .err(format!("`{block}` has {length} characters, {longest} are allowed")),
        _ => Ok(()),
    }
}
