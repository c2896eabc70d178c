//! POSTN and REPEAT: words of the user's own.

use fil_cl::{Record, Vocabulary, Word};

use crate::verify::expected_step::{Effect, ExpectedStep};
use crate::verify::statements::{numbers, whole};

/// Preparatory functions of work offsets on every control.
pub(super) const WORK_OFFSETS: [f64; 6] = [54.0, 55.0, 56.0, 57.0, 58.0, 59.0];

/// What POSTN leaves open, and its words as they stand on a tape.
pub(super) fn once(
    record: &Record,
    vocabulary: &Vocabulary,
) -> (Option<Effect>, Option<ExpectedStep>) {
    let words = letters_and_values(record, vocabulary);
    (Some(effect(record)), Some(ExpectedStep::Words(spelt(&words))))
}

/// The same for REPEAT, whose words stand in each motion that follows.
pub(super) fn repeated(
    record: &Record,
    vocabulary: &Vocabulary,
) -> (Option<Effect>, Option<ExpectedStep>) {
    let words = letters_and_values(record, vocabulary);
    let any = words.iter().any(|(letter, _)| [b'M', b'S'].contains(letter));
    let effect = if any { Effect::AnyWords } else { effect(record) };
    (Some(effect), Some(ExpectedStep::Repeated(spelt(&words))))
}

fn spelt(words: &[(u8, f64)]) -> String {
    words.iter().map(|(letter, value)| format!("{}{value} ", char::from(*letter))).collect()
}

/// What words of the user's own, neither M nor S, can do: only the number of a work offset's
/// function can choose one.
pub(super) fn effect(record: &Record) -> Effect {
    let may_choose = |number: &f64| (WORK_OFFSETS[0]..60.0).contains(number);
    match numbers(record).iter().any(may_choose) {
        true => Effect::WordsOrOffset,
        false => Effect::Words,
    }
}

/// Letters and values of words of the user's own, a letter by its name or by its number in the
/// alphabet.
fn letters_and_values(record: &Record, vocabulary: &Vocabulary) -> Vec<(u8, f64)> {
    let letter = |word: &Word| match word {
        Word::Minor(id) => match vocabulary.name(*id).as_bytes() {
            [letter @ b'A'..=b'Z'] => Some(*letter),
            _ => None,
        },
        Word::Number(number) => {
            whole(*number).filter(|n| (1..=26).contains(n)).map(|n| b'A' + n as u8 - 1)
        }
        _ => None,
    };
    let is_item = |word: &&Word| match word {
        Word::Minor(_) => letter(word).is_some(),
        Word::Number(_) => true,
        _ => false,
    };
    let items: Vec<&Word> = record.data.iter().filter(is_item).collect();
    let pair = |pair: &[&Word]| match pair {
        [name, Word::Number(value)] => Some((letter(name)?, *value)),
        _ => None,
    };
    items.chunks(2).filter_map(pair).collect()
}
