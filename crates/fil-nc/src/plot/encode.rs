//! Numbers and texts in a page: columns of whole numbers, deflated, in base 64; JSON.

use std::io::{self, Write};

use data_encoding::BASE64;
use miniz_oxide::deflate::core::{
    CompressorOxide, TDEFLFlush, TDEFLStatus, compress_to_output, create_comp_flags_from_zip_params,
};

/// How hard the packer tries, of 10.
const EFFORT: i32 = 6;

/// Numbers beyond it are told as it, either way: a script counts exactly to 2^53.
const MOST: i64 = 1 << 50;

/// Bytes that are packed at once.
const CHUNK: usize = 1 << 16;

/// Rows of whole numbers as what the page reads: how many there are, and their columns one
/// after the other. Like stands beside like so, and packs well.
pub(super) fn columns<const N: usize>(
    out: &mut dyn Write,
    rows: impl Iterator<Item = [i64; N]> + Clone,
) -> io::Result<()> {
    write!(out, "{{\"rows\":{},\"packed\":", rows.clone().count())?;
    let mut packer = Packer::new(out)?;
    for column in 0..N {
        let mut above = 0;
        for row in rows.clone() {
            let value = row[column].clamp(-MOST, MOST);
            push(&mut packer.bytes, value - above);
            above = value;
            packer.pack_chunk()?;
        }
    }
    packer.finish()?;
    out.write_all(b"}")
}

/// Appends a number, seven bits a byte, the lowest first; 0, -1, 1, -2 become 0, 1, 2, 3.
fn push(bytes: &mut Vec<u8>, value: i64) {
    let mut rest = (value << 1 ^ value >> 63) as u64;
    while rest > 127 {
        bytes.push(rest as u8 | 128);
        rest >>= 7;
    }
    bytes.push(rest as u8);
}

/// Writes bytes deflated, in base 64, between quotation marks.
pub(super) struct Packer<'w> {
    out: &'w mut dyn Write,
    deflate: CompressorOxide,
    /// What is not deflated yet.
    bytes: Vec<u8>,
    /// What is not written yet.
    deflated: Vec<u8>,
}

impl<'w> Packer<'w> {
    /// # Errors
    /// Those of the writer.
    pub fn new(out: &'w mut dyn Write) -> io::Result<Self> {
        out.write_all(b"\"")?;
        let flags = create_comp_flags_from_zip_params(EFFORT, 0, 0);
        let deflate = CompressorOxide::new(flags);
        Ok(Packer { out, deflate, bytes: Vec::new(), deflated: Vec::new() })
    }

    /// Adds bytes.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn add(&mut self, bytes: &[u8]) -> io::Result<()> {
        bytes.chunks(CHUNK).try_for_each(|bytes| {
            self.bytes.extend_from_slice(bytes);
            self.pack_chunk()
        })
    }

    /// Packs what was added once it is enough.
    fn pack_chunk(&mut self) -> io::Result<()> {
        if self.bytes.len() < CHUNK {
            return Ok(());
        }
        self.pack(TDEFLFlush::None)?;
        let whole = self.deflated.len() / 3 * 3;
        self.out.write_all(BASE64.encode(&self.deflated[..whole]).as_bytes())?;
        self.deflated.drain(..whole);
        Ok(())
    }

    fn pack(&mut self, flush: TDEFLFlush) -> io::Result<()> {
        let deflated = &mut self.deflated;
        let (status, _) = compress_to_output(&mut self.deflate, &self.bytes, flush, |bytes| {
            deflated.extend_from_slice(bytes);
            true
        });
        self.bytes.clear();
        match status {
            TDEFLStatus::Okay | TDEFLStatus::Done => Ok(()),
            _ => Err(io::Error::other("what is written can't be packed")),
        }
    }

    /// Writes the rest.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn finish(mut self) -> io::Result<()> {
        self.pack(TDEFLFlush::Finish)?;
        write!(self.out, "{}\"", BASE64.encode(&self.deflated))
    }
}

/// Bytes in base 64, with the signs that fill up the last four digits.
pub fn base64(bytes: &[u8]) -> String {
    BASE64.encode(bytes)
}

/// A JSON text that may stand in a script element.
pub(super) fn json(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for character in text.chars() {
        match character {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => escape(&mut out, character),
            control if control.is_control() => escape(&mut out, control),
            other => out.push(other),
        }
    }
    out.push('"');
    out
}

fn escape(out: &mut String, character: char) {
    out.push_str(&format!("\\u{:04x}", u32::from(character)));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told<const N: usize>(rows: &[[i64; N]]) -> String {
        let mut out = Vec::new();
        columns(&mut out, rows.iter().copied()).expect("a vector takes all");
        String::from_utf8(out).expect("a text")
    }

    fn inflated(said: &str) -> Vec<u8> {
        let (_, packed) = said.split_once("\"packed\":\"").expect("what is packed");
        let bytes = BASE64.decode(packed.strip_suffix("\"}").expect("its end").as_bytes());
        miniz_oxide::inflate::decompress_to_vec(&bytes.expect("base 64")).expect("deflated bytes")
    }

    #[test]
    fn columns_are_packed_as_the_page_reads_them() {
        // 300 is 2 * 128 + 44 of 600 = 4 * 128 + 88; then -302; 5 and -7.
        let said = told(&[[300, 5], [-2, -2]]);
        assert!(said.starts_with("{\"rows\":2,"), "{said}");
        assert_eq!(inflated(&said), [0b1101_1000, 4, 0b1101_1011, 4, 10, 13]);
        assert_eq!(BASE64.encode(&[0b1010_1100, 2, 3]), "rAID");
    }

    #[test]
    fn what_is_packed_in_parts_is_whole() {
        let rows: Vec<[i64; 1]> =
            (0..3 * CHUNK as i64).map(|row| [row * row * 7919 % 100_003]).collect();
        let mut bytes = Vec::new();
        rows.iter().fold(0, |above, [value]| {
            push(&mut bytes, value - above);
            *value
        });
        assert_eq!(inflated(&told(&rows)), bytes);
    }

    #[test]
    fn numbers_beyond_what_a_script_counts_are_told_as_the_greatest() {
        let all = |value: i64| told(&[[value], [-value]]);
        assert_eq!(all(i64::MAX), all(MOST));
    }

    #[test]
    fn a_text_may_stand_in_a_script() {
        assert_eq!(json("a<\"\\\n\u{1}"), "\"a\\u003c\\\"\\\\\\n\\u0001\"");
    }
}
