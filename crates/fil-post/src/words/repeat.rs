//! REPEAT/letter,value,… and REPEAT/OFF: words added to each motion block;
//! REPEAT/letter,…,NEXT: words that the next motion says again.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::Letter;

use super::postn::letters_and_values;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Sets or clears the words; a motion block that has a word of that letter is
/// left as it is.
///
/// # Errors
/// Any other form, or a letter the machine does not write.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.flag(w::NEXT) {
        return say_again(post, items);
    }
    let off = items.flag(w::OFF);
    let words = letters_and_values(post, items)?;
    items.deny_rest()?;
    if off != words.is_empty() {
        return Err(items.error("pairs of a letter and a value, or OFF, are needed"));
    }
    carry_out(post, Operation::Repeat(words))
}

/// The next motion says these letters again, whatever the control has; ALL are
/// those of the axes, F and the motion function.
fn say_again(post: &mut Post, items: &mut Items) -> Result<()> {
    let all = items.flag(w::ALL);
    let numbers = items.numbers();
    items.deny_rest()?;
    if all != numbers.is_empty() {
        return Err(items.error("letters, or ALL, are needed before NEXT"));
    }
    let letters: Result<Vec<Letter>> = numbers
        .into_iter()
        .map(|number| {
            Letter::of_value(number)
                .ok_or_else(|| items.error(format!("{number} is not a letter: A is 1 and Z is 26")))
        })
        .collect();
    post.control.say_again(&letters?)
}
