//! Work offsets of a program by their numbers and names.

/// What the number of a work offset that a word chooses is counted from.
pub const WORD_OFFSETS: u32 = 1_000_000;

/// The number of a work offset that a code of tenths chooses with a word beside it: 541003 for
/// G54.1 P3.
pub const fn numbered_offset(tenths: u32, number: u32) -> u32 {
    tenths * 1000 + number
}

/// The number of a work offset that a code of tenths chooses by itself: 54 for G54, 591000 for
/// G59.1.
pub const fn offset_in_tenths(tenths: u32) -> u32 {
    match tenths.is_multiple_of(10) {
        true => tenths / 10,
        false => numbered_offset(tenths, 0),
    }
}

/// The name of a work offset in a program, from its number.
pub fn name_of_offset(offset: u32) -> String {
    if offset >= WORD_OFFSETS {
        return format!("number {}", offset - WORD_OFFSETS);
    }
    if offset < 1000 {
        return format!("G{offset}");
    }
    let code = f64::from(offset / 1000) / 10.0;
    match offset % 1000 {
        0 => format!("G{code}"),
        number => format!("G{code} P{number}"),
    }
}

/// The number of a work offset by its name in a program: 54 for `G54`, 541003 for `G54.1P3`,
/// 591000 for `G59.1`,
/// 1000000 and the number for one that a word with another letter chooses; `None` for another text.
pub fn work_offset(name: &str) -> Option<u32> {
    let name = name.to_ascii_uppercase();
    let (letter, rest) = name.split_at_checked(1)?;
    let number = |text: &str| text.parse::<u32>().ok().filter(|number| *number < 1000);
    let tenths = |text: &str| {
        let (whole, tenth) = text.split_once('.').unwrap_or((text, "0"));
        Some(number(whole)? * 10 + number(tenth).filter(|tenth| *tenth < 10)?)
    };
    match (letter, rest.split_once('P')) {
        ("G", None) if rest.contains('.') => Some(offset_in_tenths(tenths(rest)?)),
        ("G", None) => number(rest),
        ("G", Some((function, extended))) => {
            Some(numbered_offset(tenths(function)?, number(extended)?))
        }
        (letter, _) if letter.as_bytes()[0].is_ascii_uppercase() => {
            Some(WORD_OFFSETS + number(rest)?)
        }
        _ => None,
    }
}
