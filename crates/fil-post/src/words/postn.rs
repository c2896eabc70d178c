//! POSTN/OUT,letter,value,…: one block of exactly these words.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use fil_cl::Word;

use super::form::Form;
use crate::cause::Cause;
use crate::letters::{G, M};
use crate::post::Post;
use crate::program;

/// Writes the block: every word in the order given and in any case, its value
/// as given, in the address's format; the last output values follow.
///
/// # Errors
/// A form other than OUT, a letter that is none, a value that does not fit.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if !form.flag(w::OUT) || record.data.first() != Some(&Word::Minor(w::OUT)) {
        return Err(form.error("only POSTN/OUT is known"));
    }
    let numbers = form.numbered();
    form.end()?;
    let form = Form::new(record, vocabulary);
    if numbers.is_empty()
        || !numbers.len().is_multiple_of(2)
        || numbers.len() + 1 != record.data.len()
    {
        return Err(form.error("pairs of a letter and a value are needed"));
    }
    let mut words: Vec<(u8, f64, Cause)> = Vec::new();
    for pair in numbers.chunks(2) {
        let [(letter, _), (value, word)] = [pair[0], pair[1]];
        let letter = letter_number(letter)
            .ok_or_else(|| form.error(format!("{letter} is no letter, A is 1 and Z is 26")))?;
        if letter != G && letter != M && words.iter().any(|(known, ..)| *known == letter) {
            let name = char::from(b'A' + letter - 1);
            return Err(form.error(format!("address {name} stands twice")));
        }
        words.push((letter, value, Cause { word, ..post.block.cause }));
    }
    program::start(post)?;
    post.tape.words(&words, &post.machine.addresses, &mut post.commons)?;
    if let Some((_, code, _)) = words.iter().rfind(|(letter, ..)| *letter == G) {
        post.note_g(*code as i32);
    }
    Ok(())
}

/// A letter number, 1 to 26.
pub fn letter_number(value: f64) -> Option<u8> {
    (value.fract() == 0.0 && (1.0..=26.0).contains(&value)).then_some(value as u8)
}
