//! Capital and small letters of the Latin, Greek and Cyrillic alphabets, which are those of the
//! code pages that FIL and CL files come in; any other letter stays as it is.
//!
//! The tables of all of Unicode would be a fiftieth of what a page loads in WebAssembly.

/// A text in capitals; `ß` becomes `SS`.
pub fn upper(text: &str) -> String {
    let mut changed = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            'ß' => changed.push_str("SS"),
            _ => changed.push(capital(letter)),
        }
    }
    changed
}

/// A text in small letters; each `Σ` becomes `σ`, at the end of a word too.
pub fn lower(text: &str) -> String {
    text.chars().map(small).collect()
}

/// The capital of a letter.
fn capital(letter: char) -> char {
    let code = u32::from(letter);
    let is_odd = code % 2 == 1;
    let capital = match code {
        0x61..=0x7A | 0xE0..=0xF6 | 0xF8..=0xFE => code - 0x20,
        0xB5 => 0x39C,
        0xFF => 0x178,
        0x131 => 0x49,
        0x17F => 0x53,
        0x101..=0x12F | 0x133..=0x137 | 0x14B..=0x177 if is_odd => code - 1,
        0x13A..=0x148 | 0x17A..=0x17E if !is_odd => code - 1,
        0x3AC => 0x386,
        0x3AD..=0x3AF => code - 0x25,
        0x3C2 => 0x3A3,
        0x3B1..=0x3CB => code - 0x20,
        0x3CC => 0x38C,
        0x3CD..=0x3CE => code - 0x3F,
        0x430..=0x44F => code - 0x20,
        0x450..=0x45F => code - 0x50,
        0x461..=0x481 | 0x48B..=0x4BF | 0x4D1..=0x52F if is_odd => code - 1,
        0x4C2..=0x4CE if !is_odd => code - 1,
        0x4CF => 0x4C0,
        _ => code,
    };
    char::from_u32(capital).unwrap_or(letter)
}

/// The small letter of a capital.
fn small(letter: char) -> char {
    let code = u32::from(letter);
    let is_odd = code % 2 == 1;
    let small = match code {
        0x41..=0x5A | 0xC0..=0xD6 | 0xD8..=0xDE => code + 0x20,
        0x178 => 0xFF,
        0x100..=0x12E | 0x132..=0x136 | 0x14A..=0x176 if !is_odd => code + 1,
        0x139..=0x147 | 0x179..=0x17D if is_odd => code + 1,
        0x386 => 0x3AC,
        0x388..=0x38A => code + 0x25,
        0x38C => 0x3CC,
        0x38E..=0x38F => code + 0x3F,
        0x391..=0x3A1 | 0x3A3..=0x3AB => code + 0x20,
        0x400..=0x40F => code + 0x50,
        0x410..=0x42F => code + 0x20,
        0x460..=0x480 | 0x48A..=0x4BE | 0x4D0..=0x52E if !is_odd => code + 1,
        0x4C1..=0x4CD if is_odd => code + 1,
        0x4C0 => 0x4CF,
        _ => code,
    };
    char::from_u32(small).unwrap_or(letter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_those_of_unicode() {
        for code in (0..=0x17F).chain(0x386..=0x3CE).chain(0x400..=0x52F) {
            let letter = char::from_u32(code).expect("a letter");
            let text = letter.to_string();
            // Letters that become two, or one with a mark.
            if !['ŉ', 'İ', 'ΐ', 'ΰ'].contains(&letter) {
                assert_eq!(upper(&text), text.to_uppercase(), "U+{code:04X}");
                assert_eq!(lower(&text), text.to_lowercase(), "U+{code:04X}");
            }
        }
        assert_eq!(upper("Фреза 5 straße µ"), "ФРЕЗА 5 STRASSE Μ");
        assert_eq!(lower("ФРЕЗА É №5 ΟΔΟΣ"), "фреза é №5 οδοσ");
    }
}
