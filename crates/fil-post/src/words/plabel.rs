//! PLABEL/n,value: a setting of the machine by the number that it has as a label.

use fil_diag::Result;
use fil_machine::{Kind, stored};

use crate::items::Items;
use crate::post::Post;

/// The label n is the location INTCOM 1830+n.
const BEFORE_FIRST: u32 = 1830;

/// The highest label.
const LAST: f64 = 99.0;

/// Stores the value; it acts at once, as one that POSTF(2) stores.
///
/// # Errors
/// Other than a label and an integer, and a value that the location can't hold.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<bool> {
    let [label, value] = items.numbers()[..] else {
        return Err(items.error("a label, 1 to 99, and its value are needed"));
    };
    if label.fract() != 0.0 || !(1.0..=LAST).contains(&label) {
        return Err(items.error(format!("{label} is not a label: they go from 1 to 99")));
    }
    items.deny_rest()?;
    let location = BEFORE_FIRST + label as u32;
    post.control.check_setting(Kind::Int, location, value)?;
    post.control.commons.set(Kind::Int, location, value)?;
    if !stored::acts(Kind::Int, location) {
        post.control.warnings.add_made(stored::without_effect(&[(Kind::Int, location)]));
    }
    Ok(true)
}
