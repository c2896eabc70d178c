//! SET/OFSETL\[,n|OFF]: a work offset by its number. Other forms of SET change what the
//! post does not know.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::Operation;
use crate::path::carry_out;
use crate::post::Post;

/// Most an offset number may be.
const MOST: f64 = 999.0;

/// Takes a work offset. A machine may list SET as without effect: then nothing is done.
///
/// # Errors
/// Another form than OFSETL; a number that can't be read; a CIRCLE that waits for its end; an
/// offset in cutter compensation, or that the machine lacks.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if post.control.commons.words_without_effect().iter().any(|word| word == "SET") {
        items.skip(items.len());
        return Ok(());
    }
    if !items.flag(w::OFSETL) {
        let mut diag = items.error(
            "only OFSETL is known; other forms change the path or the frame, and a FIL section \
             must take them",
        );
        diag.hint = Some(
            "Take it with a FIL section, or list SET under words.without_effect in machine.toml if it changes nothing on the machine."
                .into(),
        );
        return Err(diag);
    }
    let number = items.number();
    post.due_to(items);
    if number.is_none() {
        items.any_of(&[w::OFF, w::NOMORE]);
    }
    items.deny_rest()?;
    let number = match number {
        Some(number) if number.fract() == 0.0 && (1.0..=MOST).contains(&number) => {
            Some(number as i64)
        }
        Some(number) => {
            return Err(items.error(format!("{number} is not the number of a work offset")));
        }
        None => None,
    };
    if post.path.arc.is_some() {
        return PostCode::ArcEnd.err("SET/OFSETL came between a CIRCLE and its GOTO");
    }
    post.path.interrupt();
    carry_out(post, Operation::WorkOffset(number))
}
