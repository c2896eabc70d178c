//! A text without a sign of a CAM system whose circles turn the other way.
//!
//! No system is known that writes so. The dialect is for files whose arcs prove it: the post
//! refuses them by the right-hand rule and names this dialect.

use super::{ArcSense, CircleForm, DialectRules, generic};

pub(super) const RULES: DialectRules = DialectRules {
    name: "generic-left",
    title: "APT and ISO 4343 with circles opposite to the right-hand rule; only by choice",
    circle: Some(CircleForm::new(&[6, 7], ArcSense::LeftHand)),
    ..generic::RULES
};
