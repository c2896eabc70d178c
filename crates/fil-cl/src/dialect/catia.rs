//! Dassault CATIA V5 APT (`.aptsource`).
//!
//! CATIA cuts every line at column 72 with `$` as its last character, within numbers, texts
//! and comments too. Arcs are given by geometry (INDIRV, TLON) and not by CIRCLE. Statements
//! beside those of APT come from the word table of a shop.

use super::{AxisRule, DialectRules, Sign};

pub(super) const RULES: DialectRules = DialectRules {
    name: "catia",
    title: "Dassault CATIA V5 APT (.aptsource)",
    signs: &[
        Sign::Comment("CATIAAPTVERSION"),
        Sign::Comment("*CATIA"),
        Sign::Name("CATMAT"),
        Sign::Name("CATPROCESS"),
        Sign::Name("CATPRODUCT"),
    ],
    circle: None,
    axis: AxisRule::AsWritten,
    packed_points: false,
    break_column: Some(72),
    trailing_comma: true,
    comma_words: &["CHANNEL"],
    writes_units: false,
    writes_fini: false,
    without_effect: &[
        ("CATPROCESS", "name of the CATIA process"),
        ("CATPRODUCT", "name of the CATIA product"),
    ],
};
