//! PARTNO text: name of the part; its first whole number is the program number
//! unless the machine has a fixed one.

use fil_diag::Result;

use crate::errors::PostCode;
use crate::items::Items;
use crate::post::Post;

/// Digits of a program number; a longer number of the text is a name.
const DIGITS: usize = 4;

/// Program numbers from here on are those of the machine builder's own macros.
const RESERVED: i64 = 8000;

/// Remembers name and number for the start of the program.
///
/// # Errors
/// Items behind the text.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let name = items.text().to_string();
    items.deny_rest()?;
    if post.control.head.started {
        let message = "PARTNO: the program has begun before it".to_string();
        post.warn(PostCode::IgnoredPart, message);
        return Ok(());
    }
    let number = whole_number(&name);
    let taken = post.control.commons.read(fil_machine::locations::PROGRAM_NUMBER).is_some()
        || post.control.commons.read(fil_machine::locations::PROGRAM_NUMBER_ADDRESS).is_none();
    if let Some(number) = number.filter(|number| !taken && is_reserved(*number)) {
        let message = format!("PARTNO `{name}` gives O{number:04}");
        post.warn(PostCode::ReservedNumber, message);
    }
    let head = &mut post.control.head;
    head.number = number;
    head.name = name;
    head.cause = post.control.block.cause;
    Ok(())
}

/// O0000 is no number of a program, and the macros of machines have those from O8000 on.
fn is_reserved(number: i64) -> bool {
    number == 0 || number >= RESERVED
}

/// The first whole number of a text that a program can have: digits that no point and no comma
/// joins to others, not more than a program number has.
fn whole_number(text: &str) -> Option<i64> {
    let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '.' && c != ',');
    let digits = numbers.map(|part| part.trim_end_matches(['.', ',']));
    digits
        .filter(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()))
        .filter(|part| part.len() <= DIGITS)
        .find_map(|part| part.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::whole_number;

    #[test]
    fn the_first_whole_number_counts() {
        for (text, number) in [
            ("7", Some(7)),
            ("GROOVES O100", Some(100)),
            ("PART 12-B 34", Some(12)),
            ("REV 1.5 NO 8", Some(8)),
            ("PLATE", None),
            ("", None),
            ("99999999999999999999", None),
            ("BRACKET-100200 REV 7", Some(7)),
            ("123456789", None),
        ] {
            assert_eq!(whole_number(text), number, "{text}");
        }
    }
}
