//! Makino FFCAM (`.cldata`).
//!
//! PPRINT statements give the structure of the file. Circles have the eleven numbers of NX,
//! and their axis is opposite to the right-hand rule as there.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "ffcam",
    title: "Makino FFCAM (.cldata)",
    signs: &[Sign::Text(w::PPRINT, "APTCL-SPEC")],
    circle: Some(CircleForm { counts: &[11], sense: ArcSense::LeftHand }),
    axis: AxisRule::Modal,
    packed_points: false,
    break_column: None,
    trailing_comma: false,
    comma_words: &[],
    writes_units: true,
    writes_fini: false,
    without_effect: &[],
};
