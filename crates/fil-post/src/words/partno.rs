//! PARTNO text: name of the part; its digits are the program number unless
//! the machine has a fixed one.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::post::Post;

/// Remembers name and number for the start of the program.
///
/// # Errors
/// None.
pub fn handle(post: &mut Post, record: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    let name = record.text.trim();
    let digits: String = name.chars().filter(char::is_ascii_digit).collect();
    post.state.part_number = digits.parse().ok();
    post.state.part_name = name.to_string();
    post.state.part_cause = post.block.cause;
    Ok(())
}
