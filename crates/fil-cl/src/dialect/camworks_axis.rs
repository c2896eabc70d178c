//! CAMWorks CLT (`.clt`) whose circles turn as their axis says.
//!
//! No file is known that needs it: the words of CAMWorks are proved. It is for one whose words
//! were lost or changed on the way.

use super::{ArcSense, CircleForm, DialectRules, camworks};

pub(super) const RULES: DialectRules = DialectRules {
    name: "camworks-axis",
    title: "CAMWorks CLT (.clt) with arcs in the direction of their axis",
    signs: &[],
    circle: Some(CircleForm::new(&[7], ArcSense::ByAxis)),
    ..camworks::RULES
};
