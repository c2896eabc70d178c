//! Numbers and texts in a page: variable-length whole numbers in base 64, JSON.

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Whole numbers, seven bits a byte, the lowest first.
#[derive(Default)]
pub(super) struct Numbers(Vec<u8>);

impl Numbers {
    /// Appends a number.
    pub(super) fn push(&mut self, mut value: u64) {
        while value > 127 {
            self.0.push(value as u8 | 128);
            value >>= 7;
        }
        self.0.push(value as u8);
    }

    /// Appends a number with a sign: 0, -1, 1, -2 become 0, 1, 2, 3.
    pub(super) fn push_signed(&mut self, value: i64) {
        self.push((value << 1 ^ value >> 63) as u64);
    }

    /// All of them in base 64.
    pub(super) fn base64(&self) -> String {
        let mut out = String::with_capacity(self.0.len() / 3 * 4 + 4);
        for chunk in self.0.chunks(3) {
            let bits = chunk.iter().fold(0u32, |bits, byte| bits << 8 | u32::from(*byte))
                << (8 * (3 - chunk.len()));
            for place in 0..4 {
                if place <= chunk.len() {
                    let digit = bits >> (18 - 6 * place) & 63;
                    out.push(char::from(DIGITS[digit as usize]));
                } else {
                    out.push('=');
                }
            }
        }
        out
    }
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
