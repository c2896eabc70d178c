//! Numbers and tool axes that come again with the same text: from one point to the next most
//! files write one or two coordinates anew, and some systems write the same axis in each
//! line. What a text means never changes, so a text that is known needs no reading.

/// Longest text of a tool axis that is kept.
const LONGEST_AXIS: usize = 64;

/// Longest text of a number that is kept, with the character behind it.
const LONGEST_NUMBER: usize = 16;

/// The end of the last GOTO with a tool axis, from its fourth value to the line end.
pub(super) struct KnownAxis {
    text: [u8; LONGEST_AXIS],
    length: usize,
    values: [f64; 3],
}

impl Default for KnownAxis {
    fn default() -> Self {
        KnownAxis { text: [0; LONGEST_AXIS], length: 0, values: [0.0; 3] }
    }
}

impl KnownAxis {
    /// The axis that `text` begins with and the length of its text, when it is known.
    #[inline]
    pub(super) fn read(&self, text: &[u8]) -> Option<([f64; 3], usize)> {
        let known = &self.text[..self.length];
        (!known.is_empty() && text.starts_with(known)).then_some((self.values, self.length))
    }

    /// Keeps the axis of so many bytes that `text` begins with. A copy of always as many bytes
    /// takes a moment, and one of any length a call.
    #[inline]
    pub(super) fn keep(&mut self, text: &[u8], length: usize, values: [f64; 3]) {
        let Some(bytes) = text.first_chunk() else { return };
        if length <= LONGEST_AXIS {
            (self.text, self.length, self.values) = (*bytes, length, values);
        }
    }
}

/// The text of a number, and the number.
#[derive(Clone, Copy, Default)]
struct KnownNumber {
    /// The text and the character behind it, the first byte in the lowest place.
    text: u128,
    /// Ones where `text` has bytes; zero while no text is known, so that none is alike.
    mask: u128,
    /// Bytes of the number.
    length: usize,
    value: f64,
    /// The last number that was read at its place.
    last: f64,
}

/// Numbers at the second to the sixth place of a statement that came twice one after the
/// other: to keep a number that does not come again costs a little. The first is the one that
/// changes in most files.
#[derive(Default)]
pub(super) struct KnownNumbers([KnownNumber; 5]);

impl KnownNumbers {
    /// The number that `text` begins with, and the text behind it, when it is the known one
    /// of this place, from 0.
    #[inline]
    pub(super) fn read<'t>(&self, place: usize, text: &'t [u8]) -> Option<(f64, &'t [u8])> {
        let known = self.0.get(place.wrapping_sub(1))?;
        let bytes = u128::from_le_bytes(*text.first_chunk()?);
        let is_alike = bytes & known.mask == known.text && known.mask != 0;
        is_alike.then(|| (known.value, &text[known.length..]))
    }

    /// Keeps the number of so many bytes that `text` begins with, if the one before was the
    /// same, and a comma or a line end stands right behind it: a longer number begins alike.
    #[inline]
    pub(super) fn keep(&mut self, place: usize, text: &[u8], length: usize, value: f64) {
        let Some(known) = self.0.get_mut(place.wrapping_sub(1)) else { return };
        if value != known.last {
            known.last = value;
            return;
        }
        let Some(bytes) = text.first_chunk() else { return };
        if length < LONGEST_NUMBER && matches!(text[length], b',' | b'\n' | b'\r') {
            let mask = u128::MAX >> (8 * (LONGEST_NUMBER - 1 - length));
            (known.text, known.mask) = (u128::from_le_bytes(*bytes) & mask, mask);
            (known.length, known.value) = (length, value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_known_by_its_whole_text_alone() {
        let mut known = KnownNumbers::default();
        assert_eq!(known.read(1, b"1.25, 2, 3, 4, 5, 6"), None);
        known.keep(1, b"1.25, 2, 3, 4, 5, 6", 4, 1.25);
        assert_eq!(known.read(1, b"1.25, 7, 8, 9, 10, 11"), None, "it came once");
        known.keep(1, b"1.25, 2, 3, 4, 5, 6", 4, 1.25);
        assert_eq!(
            known.read(1, b"1.25, 7, 8, 9, 10, 11"),
            Some((1.25, &b", 7, 8, 9, 10, 11"[..]))
        );
        assert_eq!(known.read(2, b"1.25, 7, 8, 9, 10, 11"), None, "another place");
        assert_eq!(known.read(1, b"1.255, 7, 8, 9, 10, 11"), None, "a longer number");
        assert_eq!(known.read(1, b"1.2, 7, 8, 9, 10, 11, 12"), None, "a shorter number");
        assert_eq!(known.read(1, b"1.25, 7"), None, "too near to the end");
    }

    #[test]
    fn an_axis_is_known_by_its_text_up_to_the_line_end() {
        let mut known = KnownAxis::default();
        assert_eq!(known.read(b"0,0,1\n"), None, "nothing is known");
        let line = |axis: &str| format!("{axis}\nGOTO/1,2,3{}", " ".repeat(LONGEST_AXIS));
        known.keep(line("0,0,1").as_bytes(), 6, [0.0, 0.0, 1.0]);
        assert_eq!(known.read(b"0,0,1\n"), Some(([0.0, 0.0, 1.0], 6)));
        assert_eq!(known.read(b"0,0,1.5\n"), None, "a longer number");
        let long = format!("0,0,0.{}1", "0".repeat(LONGEST_AXIS));
        known.keep(line(&long).as_bytes(), long.len() + 1, [0.0; 3]);
        assert_eq!(known.read(line(&long).as_bytes()), None, "too long");
        known.keep(b"1,0,0\n", 6, [1.0, 0.0, 0.0]);
        assert_eq!(known.read(b"1,0,0\n"), None, "too near to the end");
    }

    #[test]
    fn a_number_is_kept_up_to_fifteen_bytes() {
        let mut known = KnownNumbers::default();
        for (length, kept) in [(1, true), (15, true), (16, false), (20, false)] {
            let text = format!("{},{}", "1".repeat(length), " ".repeat(16));
            for _ in 0..2 {
                known.keep(2, text.as_bytes(), length, length as f64);
            }
            let found = known.read(2, text.as_bytes()).map(|(value, _)| value);
            assert_eq!(found, kept.then_some(length as f64), "{text}");
        }
        for _ in 0..2 {
            known.keep(2, b"1 , 2, 3, 4, 5, 6", 1, 1.0);
        }
        assert_eq!(known.read(2, b"1 , 2, 3, 4, 5, 6"), None, "a blank behind the number");
    }
}
