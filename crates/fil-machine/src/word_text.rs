//! The text of a word, made from its end: the last digit is known first.

/// Longest text: a blank, a letter, a sign, 18 digits, a point, and zeros around it.
const END: usize = 32;

/// Bytes that are copied at once.
const CHUNK: usize = 16;

/// The numbers below 100 in two digits.
const PAIRS: [[u8; 2]; 100] = {
    let mut pairs = [[0; 2]; 100];
    let mut number = 0;
    while number < 100 {
        pairs[number] = [b'0' + (number / 10) as u8, b'0' + (number % 10) as u8];
        number += 1;
    }
    pairs
};

/// The text of a word so far.
pub struct WordText {
    bytes: [u8; END + CHUNK],
    start: usize,
}

impl Default for WordText {
    #[inline]
    fn default() -> Self {
        WordText::new()
    }
}

impl WordText {
    /// Nothing yet.
    #[inline]
    pub fn new() -> Self {
        WordText { bytes: [0; END + CHUNK], start: END }
    }

    /// Number of characters.
    #[inline]
    pub fn width(&self) -> usize {
        END - self.start
    }

    /// Puts a byte in front.
    #[inline]
    pub fn put(&mut self, byte: u8) {
        self.start -= 1;
        self.bytes[self.start] = byte;
    }

    /// Puts a number in front, without zeros before it.
    #[inline]
    pub fn put_number(&mut self, mut number: u64) {
        while number > 99 {
            self.put_pair((number % 100) as u32);
            number /= 100;
        }
        if number > 9 { self.put_pair(number as u32) } else { self.put(b'0' + number as u8) }
    }

    /// Puts the last digits of a number in front, as many as said.
    #[inline]
    pub fn put_digits(&mut self, mut number: u32, digits: u8) {
        for _ in 0..digits / 2 {
            self.put_pair(number % 100);
            number /= 100;
        }
        if digits % 2 == 1 {
            self.put(b'0' + (number % 10) as u8);
        }
    }

    fn put_pair(&mut self, pair: u32) {
        self.start -= 2;
        self.bytes[self.start..self.start + 2].copy_from_slice(&PAIRS[pair as usize]);
    }

    /// Appends the text to a block.
    #[inline]
    pub fn append_to(&self, out: &mut Vec<u8>) {
        let text = &self.bytes[self.start..END];
        // A copy of fixed length takes a moment, one of any length a call.
        match self.bytes[self.start..].first_chunk::<CHUNK>() {
            Some(chunk) if text.len() <= CHUNK => {
                let end = out.len() + text.len();
                out.extend_from_slice(chunk);
                out.truncate(end);
            }
            _ => out.extend_from_slice(text),
        }
    }
}
