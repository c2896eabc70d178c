//! The functions in what others write: texts, POSTN, REPEAT, PREFUN and AUXFUN.

use fil_machine::{FunctionCode, Letter};

use crate::operation::Operation;

/// True where an operation writes a function that is meant, or a text one that can be read.
pub(super) fn has(operation: &Operation, is_meant: impl Fn(Letter, FunctionCode) -> bool) -> bool {
    let by_value = |(letter, value): (Letter, f64)| {
        FunctionCode::of_value(value).is_some_and(|code| is_meant(letter, code))
    };
    match operation {
        Operation::Function(letter, code) | Operation::WithMotion(letter, code) => {
            is_meant(*letter, *code)
        }
        Operation::Words(words) | Operation::Repeat(words) => {
            words.iter().any(|(letter, value, _)| by_value((*letter, *value)))
        }
        Operation::Text(blocks) => blocks.iter().any(|block| block.has_function(&is_meant)),
        _ => false,
    }
}
