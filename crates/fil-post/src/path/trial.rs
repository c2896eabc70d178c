//! Posts for the unit tests of this folder.

use fil_machine::locations::{self as loc, TABLE};
use fil_machine::modes::Unit;
use proptest::prelude::*;

use crate::post::Post;

/// A table about Z on a table about X.
pub const TABLES: [(&str, f64); 4] = [
    ("rotary.primary_kind", 1.0),
    ("rotary.primary_axis", 3.0),
    ("rotary.secondary_kind", 1.0),
    ("rotary.secondary_axis", 1.0),
];

/// A head about Y over a table about Z.
pub const HEAD_AND_TABLE: [(&str, f64); 5] = [
    ("rotary.primary_kind", 1.0),
    ("rotary.primary_axis", 3.0),
    ("rotary.secondary_kind", 2.0),
    ("rotary.secondary_axis", 2.0),
    ("rotary.pivot_distance", 150.0),
];

/// Two heads, about Z and about X.
pub const HEADS: [(&str, f64); 5] = [
    ("rotary.primary_kind", 2.0),
    ("rotary.primary_axis", 3.0),
    ("rotary.secondary_kind", 2.0),
    ("rotary.secondary_axis", 1.0),
    ("rotary.pivot_distance", 212.5),
];

/// A post for a mill in mm with these settings on top.
pub fn post(settings: &[(&str, f64)]) -> Post {
    let mut commons = loc::default_commons();
    for (name, value) in settings {
        let row = TABLE.iter().find(|row| row.name == *name);
        let row = row.unwrap_or_else(|| panic!("no setting {name}"));
        commons.set(row.kind, u32::from(row.number), *value).expect("a value that fits");
    }
    let mut post = Post::new(commons).expect("settings that make a machine");
    post.control.unit = Some(Unit::Mm);
    post
}

/// Coordinates of points, mm.
pub fn coordinates() -> impl Strategy<Value = [f64; 3]> {
    [-400.0..400.0, -400.0..400.0, -300.0..300.0]
}
