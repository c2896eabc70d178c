//! What somebody writes who needs one translator for one control: straight
//! moves of a CL file to blocks, and nothing else. The measure for the post.
//!
//! It knows five statements, checks nothing, and can say of no block where it
//! comes from; but it does the same work on each GOTO: read three numbers,
//! round them, drop what has not changed, write the rest, number the block.
//! `translate.lua` and `translate.py` beside it write the same bytes.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::Path;

const BUFFER: usize = 256 * 1024;

/// Decimals of the control.
const DECIMALS: u32 = 4;

/// Counts of the last decimal in a millimetre.
const SCALE: u64 = 10u64.pow(DECIMALS);

/// The control counts blocks up to this number.
const LAST_NUMBER: u32 = 99_999;

/// The state of the translation.
#[derive(Default)]
struct Translator {
    last: [Option<i64>; 3],
    feed: Option<i64>,
    last_feed: Option<i64>,
    rapid: bool,
    last_rapid: Option<bool>,
    number: u32,
}

/// Translates a file.
pub fn translate(cl: &Path, nc: &Path) -> io::Result<()> {
    let mut input = BufReader::with_capacity(BUFFER, File::open(cl)?);
    let mut output = BufWriter::with_capacity(BUFFER, File::create(nc)?);
    let mut translator = Translator::default();
    let mut line = Vec::with_capacity(256);
    let mut block = Vec::with_capacity(256);
    loop {
        line.clear();
        if input.read_until(b'\n', &mut line)? == 0 {
            break;
        }
        block.clear();
        translator.statement(&line, &mut block)?;
        output.write_all(&block)?;
    }
    output.flush()
}

impl Translator {
    fn statement(&mut self, line: &[u8], block: &mut Vec<u8>) -> io::Result<()> {
        let text = std::str::from_utf8(line).map_err(io::Error::other)?;
        if let Some(items) = text.strip_prefix("GOTO /") {
            self.goto(items, block)
        } else if let Some(items) = text.strip_prefix("FEDRAT /") {
            self.feed = Some(scaled(items.split(',').next().unwrap_or_default())?);
            Ok(())
        } else if text.starts_with("RAPID") {
            self.rapid = true;
            Ok(())
        } else if text.starts_with("FINI") {
            self.number(block);
            block.extend_from_slice(b"M30\n");
            Ok(())
        } else {
            Ok(())
        }
    }

    fn goto(&mut self, items: &str, block: &mut Vec<u8>) -> io::Result<()> {
        let mut point = [0; 3];
        let mut items = items.split(',');
        for value in &mut point {
            *value = scaled(items.next().unwrap_or_default())?;
        }
        let rapid = std::mem::take(&mut self.rapid);
        if self.last == point.map(Some) {
            return Ok(());
        }
        self.number(block);
        if self.last_rapid.replace(rapid) != Some(rapid) {
            block.extend_from_slice(if rapid { b"G0 " } else { b"G1 " });
        }
        for ((letter, value), last) in b"XYZ".iter().zip(point).zip(&mut self.last) {
            if *last != Some(value) {
                word(*letter, value, block);
                *last = Some(value);
            }
        }
        if !rapid && self.feed != self.last_feed {
            word(b'F', self.feed.unwrap_or_default(), block);
            self.last_feed = self.feed;
        }
        block.pop();
        block.push(b'\n');
        Ok(())
    }

    fn number(&mut self, block: &mut Vec<u8>) {
        self.number += 10;
        if self.number > LAST_NUMBER {
            self.number = 10;
        }
        block.push(b'N');
        digits(u64::from(self.number), block);
        block.push(b' ');
    }
}

/// The number as a count of the last decimal, from its digits: faster than
/// by way of a float.
fn scaled(item: &str) -> io::Result<i64> {
    let item = item.trim();
    let (negative, size) = match item.strip_prefix('-') {
        Some(size) => (true, size),
        None => (false, item),
    };
    let (whole, decimals) = size.split_once('.').unwrap_or((size, ""));
    let mut value = 0;
    for byte in whole.bytes() {
        value = value * 10 + digit(byte)?;
    }
    let mut decimals = decimals.bytes();
    for _ in 0..DECIMALS {
        value = value * 10 + decimals.next().map_or(Ok(0), digit)?;
    }
    if decimals.next().is_some_and(|byte| byte >= b'5') {
        value += 1;
    }
    Ok(if negative { -value } else { value })
}

fn digit(byte: u8) -> io::Result<i64> {
    let digit = i64::from(byte) - i64::from(b'0');
    if (0..=9).contains(&digit) { Ok(digit) } else { Err(io::Error::other("no number")) }
}

/// Appends a word and a blank: up to four decimals, zeros at the end dropped.
fn word(letter: u8, value: i64, block: &mut Vec<u8>) {
    block.push(letter);
    if value < 0 {
        block.push(b'-');
    }
    let size = value.unsigned_abs();
    digits(size / SCALE, block);
    block.push(b'.');
    let mut rest = size % SCALE;
    let mut place = SCALE / 10;
    while rest != 0 {
        block.push(b'0' + (rest / place) as u8);
        rest %= place;
        place /= 10;
    }
    block.push(b' ');
}

/// Appends a whole number.
fn digits(mut value: u64, block: &mut Vec<u8>) {
    let mut buffer = [0; 20];
    let mut at = buffer.len();
    loop {
        at -= 1;
        buffer[at] = b'0' + (value % 10) as u8;
        value /= 10;
        if value == 0 {
            break;
        }
    }
    block.extend_from_slice(&buffer[at..]);
}
