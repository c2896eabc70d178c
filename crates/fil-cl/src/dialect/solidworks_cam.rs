//! SolidWorks CAM APT (`.apt`).
//!
//! A circle has no radius and turns by the right-hand rule: four files agree with the
//! programs that came with them. A GOTO writes its tool axis whenever it is not Z.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "solidworks-cam",
    title: "SolidWorks CAM APT (.apt)",
    signs: &[Sign::Word(w::TRNTYP), Sign::Prefix("CSI_SET_")],
    circle: Some(CircleForm { counts: &[6, 7], sense: ArcSense::RightHand }),
    axis: AxisRule::Upright,
    packed_points: false,
    break_column: None,
    trailing_comma: false,
    comma_words: &[],
    writes_units: true,
    writes_fini: true,
    without_effect: &[
        ("CSI_SET_FLUTE_LENGTH", "length of the tool's flutes, for information"),
        ("CSI_SET_EXTENSION_LENGTH", "length of the tool out of its holder, for information"),
    ],
};
