//! CAMWorks CLT (`.clt`).
//!
//! The axis of a circle is the same for both senses; CLOCKWISE or COUNTERCLOCKWISE after the
//! radius decides.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};

pub(super) const RULES: DialectRules = DialectRules {
    name: "camworks",
    title: "CAMWorks CLT (.clt)",
    signs: &[Sign::Name("BOX"), Sign::Name("OPFEATSTART"), Sign::Name("OPFEATEND")],
    circle: Some(CircleForm { counts: &[7], sense: ArcSense::ByWord }),
    axis: AxisRule::AsWritten,
    packed_points: false,
    break_column: None,
    trailing_comma: true,
    comma_words: &[],
    writes_units: true,
    writes_fini: true,
    without_effect: &[
        ("BOX", "size of the stock, for information"),
        ("OPFEATSTART", "name of the operation"),
        ("OPFEATEND", "end of the operation"),
    ],
};
