//! A text without a sign of a CAM system: the words of APT and ISO 4343.
//!
//! A circle turns by the right-hand rule, as PTC documents it for its own files; the form of
//! NX, whose rule is the opposite one, is told by its eleven numbers and refused here.

use super::{ArcSense, AxisRule, CircleForm, DialectRules};

pub(super) const RULES: DialectRules = DialectRules {
    name: "generic",
    title: "APT and ISO 4343, no CAM system recognized",
    signs: &[],
    circle: Some(CircleForm { counts: &[4, 6, 7], sense: ArcSense::RightHand }),
    geometry: true,
    splines: false,
    axis: AxisRule::ModalInMultax,
    packed_points: false,
    break_column: None,
    trailing_comma: false,
    comma_words: &[],
    writes_units: false,
    writes_fini: true,
    rewrite: None,
    rewrite_text: None,
    without_effect: &[],
};
