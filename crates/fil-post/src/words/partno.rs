//! PARTNO text: name of the part; its first whole number is the program number
//! unless the machine has a fixed one.

use fil_diag::Result;

use crate::errors::PostCode;
use crate::items::Items;
use crate::post::Post;

/// Program numbers are below this.
const NUMBERS: i64 = 10_000;

/// Remembers name and number for the start of the program.
///
/// # Errors
/// A number of more than four digits, where it would be the program's.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let name = items.text().to_string();
    items.deny_rest()?;
    if post.control.head.started {
        let message = "PARTNO: the program has begun before it".to_string();
        post.warn(PostCode::IgnoredPart, message);
        return Ok(());
    }
    let number = whole_number(&name);
    let head = &mut post.control.head;
    let taken = post.control.commons.read(fil_machine::locations::PROGRAM_NUMBER).is_some()
        || post.control.commons.read(fil_machine::locations::PROGRAM_NUMBER_ADDRESS).is_none();
    if !taken && number.is_some_and(|number| number >= NUMBERS) {
        return PostCode::ProgramNumber
            .err(format!("PARTNO `{name}` gives a program number of more than four digits"));
    }
    head.number = number;
    head.name = name;
    head.cause = post.control.block.cause;
    Ok(())
}

/// The first whole number of a text: digits that no point and no comma joins to
/// others.
fn whole_number(text: &str) -> Option<i64> {
    let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '.' && c != ',');
    let digits = numbers.map(|part| part.trim_end_matches(['.', ',']));
    digits
        .filter(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()))
        .map(|part| part.parse().unwrap_or(i64::MAX))
        .next()
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
            ("99999999999999999999", Some(i64::MAX)),
        ] {
            assert_eq!(whole_number(text), number, "{text}");
        }
    }
}
