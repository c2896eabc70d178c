//! CAMWorks CLT (`.clt`) whose circles turn as their axis says.
//!
//! In a real file each circle that says CLOCKWISE runs on from its neighbors when it turns
//! counterclockwise, as its axis says, and runs back when it turns as the word says. The word
//! tells nothing there.

use super::{ArcSense, CircleForm, DialectRules, camworks};

pub(super) const RULES: DialectRules = DialectRules {
    name: "camworks-axis",
    title: "CAMWorks CLT (.clt) whose circles turn as their axis says",
    signs: &[],
    circle: Some(CircleForm { counts: &[7], sense: ArcSense::ByAxis }),
    ..camworks::RULES
};
