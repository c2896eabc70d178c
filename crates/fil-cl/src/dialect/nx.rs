//! Siemens NX cutter location source files (`.cls`, `.clsf`).
//!
//! The axis of a circle is opposite to the right-hand rule: read so, all arcs of the files
//! seen but one are the shorter way round, and read the other way none. The tool axis is
//! written when it changes.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "nx",
    title: "Siemens NX CLSF (.cls, .clsf)",
    signs: &[
        Sign::Word(w::TOOL_PATH),
        Sign::Word(w::TLDATA),
        Sign::Word(w::MSYS),
        Sign::Word(w::PAINT),
        Sign::Word(w::END_OF_PATH),
    ],
    circle: Some(CircleForm { counts: &[11], sense: ArcSense::LeftHand }),
    axis: AxisRule::Modal,
    packed_points: false,
    break_column: None,
    trailing_comma: false,
    comma_words: &[],
    writes_units: false,
    writes_fini: false,
    without_effect: &[
        ("PAINT", "colors and speed of the display"),
        ("TLDATA", "measures of the tool, for information"),
        ("TOOL PATH", "name of the operation and of its tool"),
        ("END-OF-PATH", "end of the operation"),
    ],
};
