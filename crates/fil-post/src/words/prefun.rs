//! PREFUN/n and AUXFUN/n: a preparatory or auxiliary function by its number.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use super::form::Form;
use crate::letters::{G, M};
use crate::post::Post;

/// Writes G n in a block of its own.
///
/// # Errors
/// No number, or one that does not fit.
pub fn prefun(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let code = write(post, record, vocabulary, G)?;
    post.note_g(code as i32);
    Ok(())
}

/// Writes M n in a block of its own.
///
/// # Errors
/// No number, or one that does not fit.
pub fn auxfun(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    write(post, record, vocabulary, M).map(|_| ())
}

fn write(
    post: &mut Post,
    record: &Record,
    vocabulary: &Vocabulary,
    letter: u8,
) -> Result<f64, Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let code = form.required("the number of the function")?;
    post.due_to(&form);
    form.end()?;
    post.word(letter, code)?;
    post.write_block()?;
    Ok(code)
}
