//! POSTN/OUT,letter,value,…: one block of exactly these words; POSTN/NORMAL,…: of
//! those among them that the control does not have.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::letters::{G, M};

use crate::cause::Cause;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Writes the block: every word in the order given and in any case, its value
/// as given, in the address's format; the last output values follow.
///
/// # Errors
/// A form other than OUT, a number that is not a letter's, a value that does not fit.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let modal = items.is_word(0, w::NORMAL);
    if !(modal || items.is_word(0, w::OUT)) {
        return Err(items.error("only POSTN/OUT and POSTN/NORMAL are known"));
    }
    items.any_of(&[w::OUT, w::NORMAL]);
    let words = letters_and_values(post, items)?;
    items.deny_rest()?;
    if words.is_empty() {
        return Err(items.error("pairs of a letter and a value are needed"));
    }
    for (at, (letter, ..)) in words.iter().enumerate() {
        let twice = words[..at].iter().any(|(other, ..)| other == letter);
        if twice && *letter != G && *letter != M {
            return Err(items.error(format!("address {letter} stands twice")));
        }
    }
    if modal {
        let words = post.control.without_known(words)?;
        return if words.is_empty() { Ok(()) } else { carry_out(post, Operation::Words(words)) };
    }
    carry_out(post, Operation::Words(words))
}

/// Pairs of a letter (1 to 26) and a value, each with its cause.
///
/// # Errors
/// A letter without a value, or a number that is not a letter's.
pub fn letters_and_values(post: &Post, items: &mut Items) -> Result<Vec<(Letter, f64, Cause)>> {
    let numbers = items.numbered();
    items.deny_words()?;
    if !numbers.len().is_multiple_of(2) {
        return Err(items.error("pairs of a letter and a value are needed"));
    }
    let pair = |pair: &[(f64, u16)]| {
        let [(letter, _), (value, word)] = [pair[0], pair[1]];
        let letter = Letter::of_value(letter)
            .ok_or_else(|| items.error(format!("{letter} is not a letter: A is 1 and Z is 26")))?;
        Ok((letter, value, Cause { word, ..post.control.block.cause }))
    };
    numbers.chunks(2).map(pair).collect()
}
