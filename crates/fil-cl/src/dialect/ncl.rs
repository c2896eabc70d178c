//! NCCS NCL (`.as`).
//!
//! The tool axis is modal while MULTAX is on. Arcs are written as points; what a CIRCLE
//! would mean is not documented.

use super::{AxisRule, DialectRules, Sign};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "ncl",
    title: "NCCS NCL (.as)",
    signs: &[Sign::Text(w::REMARK, "NCLCAM")],
    circle: None,
    geometry: false,
    splines: false,
    axis: AxisRule::ModalInMultax,
    packed_points: false,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: false,
    blanks_in_cycles: false,
    comma_words: false,
    writes_units: false,
    feeds_tell_unit: false,
    writes_fini: true,
    rewrite: None,
    rewrite_text: None,
    without_effect: &[("REMARK", "a remark for people, with the version of the system")],
};
