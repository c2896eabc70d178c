//! Numbers and texts in a page: columns of whole numbers, deflated, in base 64; JSON.

use data_encoding::BASE64;

/// How hard the packer tries, of 10.
const EFFORT: u8 = 6;

/// Numbers beyond it are told as it, either way: a script counts exactly to 2^53.
const MOST: i64 = 1 << 50;

/// Rows of whole numbers as what the page reads: how many there are, and their columns one
/// after the other. Like stands beside like so, and packs well.
pub(super) fn columns<const N: usize>(rows: impl Iterator<Item = [i64; N]>) -> String {
    let mut columns: [Vec<u8>; N] = std::array::from_fn(|_| Vec::new());
    let (mut above, mut count) = ([0; N], 0u64);
    for row in rows {
        count += 1;
        for ((column, above), value) in columns.iter_mut().zip(&mut above).zip(row) {
            let value = value.clamp(-MOST, MOST);
            push(column, value - *above);
            *above = value;
        }
    }
    format!("{{\"rows\":{count},\"packed\":\"{}\"}}", packed(&columns.concat()))
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

/// Bytes deflated, in base 64.
pub(super) fn packed(bytes: &[u8]) -> String {
    base64(&miniz_oxide::deflate::compress_to_vec(bytes, EFFORT))
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

    #[test]
    fn columns_are_packed_as_the_page_reads_them() {
        // 300 is 2 * 128 + 44 of 600 = 4 * 128 + 88; then -302; 5 and -7.
        let bytes = [0b1101_1000, 4, 0b1101_1011, 4, 10, 13];
        let said = columns([[300, 5], [-2, -2]].into_iter());
        assert_eq!(said, format!("{{\"rows\":2,\"packed\":\"{}\"}}", packed(&bytes)));
        let inflated = miniz_oxide::inflate::decompress_to_vec(
            &miniz_oxide::deflate::compress_to_vec(&bytes, EFFORT),
        );
        assert!(inflated.is_ok_and(|inflated| inflated == bytes));
        assert_eq!(BASE64.encode(&[0b1010_1100, 2, 3]), "rAID");
    }

    #[test]
    fn numbers_beyond_what_a_script_counts_are_told_as_the_greatest() {
        let all = |value: i64| columns([[value], [-value]].into_iter());
        assert_eq!(all(i64::MAX), all(MOST));
    }

    #[test]
    fn a_text_may_stand_in_a_script() {
        assert_eq!(json("a<\"\\\n\u{1}"), "\"a\\u003c\\\"\\\\\\n\\u0001\"");
    }
}
