//! The statements of a file, each with the text around it: what the tests of items and of
//! characters have in common.

use std::collections::HashMap;

use super::corpus::Part;
use super::excuse::Setting;
use super::statement::{Statement, statements};
use super::trial::Window;
use crate::posting::Prepared;

/// Statements that can't be tried.
#[derive(Default)]
pub struct Left {
    /// They run a FIL section.
    pub of_sections: usize,
    /// The text around them is refused as it is.
    pub refused: usize,
}

/// Hands out the statements of a file. `seen` counts those of one form; `chosen` says
/// whether one is tried, by its number among them, from 1.
pub fn each(
    part: &Part,
    seen: &mut HashMap<String, usize>,
    chosen: impl Fn(&Statement, usize) -> bool,
    mut take: impl FnMut(&Window<'_>, &Prepared, Setting<'_>),
) -> Left {
    let statements = statements(&part.cl);
    let inert = part.inert_lines();
    let machine = part.machine(None).expect("the post of a part");
    let mut left = Left::default();
    for (at, statement) in statements.iter().enumerate() {
        let count = seen.entry(statement.shape()).or_default();
        *count += 1;
        if !chosen(statement, *count) {
            continue;
        }
        let Some(window) = Window::new(&machine, &statements, at) else {
            left.refused += 1;
            continue;
        };
        if window.is_of_a_section() {
            left.of_sections += 1;
            continue;
        }
        let inert = inert.contains(&statement.line);
        let setting = Setting { all: &statements, at, commons: machine.commons(), inert };
        take(&window, &machine, setting);
    }
    left
}
