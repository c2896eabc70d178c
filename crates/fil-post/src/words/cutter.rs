//! CUTTER/d,…: the cutter; its diameter is kept, nothing is written.

use fil_diag::Result;

use crate::items::Items;
use crate::path::Cutter;
use crate::post::Post;

/// Measures of an APT cutter behind the diameter: corner radius, center of the corner,
/// two angles, height.
const MEASURES: usize = 6;

/// Remembers the diameter; the other measures of an APT cutter do not change the
/// program.
///
/// # Errors
/// No number, or what is no measure of a cutter.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let diameter = items.required("the diameter")?;
    post.path.cutter = Some(Cutter { diameter, named_at: post.path.point });
    let _measures: Vec<f64> = std::iter::from_fn(|| items.number()).take(MEASURES).collect();
    items.deny_rest()
}

/// A tool change forgets the diameter of the tool before it. CUTTER may stand before the
/// change of the tool that it describes, as long as no motion comes between them.
pub(super) fn forget(post: &mut Post) {
    let point = post.path.point;
    post.path.cutter = post.path.cutter.filter(|cutter| cutter.named_at == point);
}
