//! PTC Creo and Pro/ENGINEER (`.ncl`).
//!
//! PTC documents CIRCLE with the right-hand rule and its radius, and a GOTO with many points
//! for an arc that is written as points.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::forms::{FormError, Outcome, Written, cycle};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "creo",
    title: "PTC Creo, Pro/ENGINEER (.ncl)",
    signs: &[Sign::Comment("*PRO/CLFILE"), Sign::Pseudo],
    circle: Some(CircleForm { counts: &[4, 7], sense: ArcSense::RightHand }),
    geometry: true,
    splines: false,
    axis: AxisRule::AsWritten,
    packed_points: true,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: false,
    comma_words: false,
    writes_units: true,
    writes_fini: true,
    rewrite: Some(rewrite),
    rewrite_text: None,
    without_effect: &[],
};

/// The configuration option cycle_format writes cycles by position.
fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    if written.record.major == w::CYCLE {
        cycle::positional(written)?;
    }
    Ok(Outcome::Free)
}
