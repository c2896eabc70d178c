//! Names that are not what they look like.

use fil_diag::letter_case;

use crate::vocabulary::Vocabulary;

/// Capital letters of other alphabets, each with the Latin one that looks like it.
const ALIKE: [(&str, &str); 2] =
    [("АВСЕНІЈКМОРЅТУХ", "ABCEHIJKMOPSTYX"), ("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "ABEZHIKMNOPTYX")];

/// What is wrong with a name that is not ASCII: a character that nobody sees, or a letter of
/// another alphabet in a word that looks like a known one.
pub(super) fn disguise(vocab: &Vocabulary, name: &str) -> Option<String> {
    if let Some(letter) = name.chars().find(|letter| is_hidden(*letter)) {
        return Some(format!("a hidden character, U+{:04X}, in a name", u32::from(letter)));
    }
    let shown = letter_case::upper(name);
    let latin: String = shown.chars().map(|letter| self::latin(letter).unwrap_or(letter)).collect();
    let known = latin.is_ascii() && vocab.find(&latin).is_some_and(|id| vocab.is_known(id));
    let letter = shown.chars().find(|letter| self::latin(*letter).is_some()).filter(|_| known)?;
    Some(format!("U+{:04X} only looks like a letter of {latin}", u32::from(letter)))
}

/// True for a character that leaves no mark, or only a gap.
fn is_hidden(letter: char) -> bool {
    let is_format = matches!(
        letter,
        '\u{AD}' | '\u{FEFF}' | '\u{200B}'..='\u{200F}' | '\u{2060}'..='\u{2064}'
    );
    is_format || letter.is_whitespace() || letter.is_control()
}

/// The Latin letter that one of another alphabet looks like.
fn latin(letter: char) -> Option<char> {
    ALIKE.iter().find_map(|(other, latin)| {
        let at = other.chars().position(|one| one == letter)?;
        latin.chars().nth(at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_letter_has_its_likeness() {
        for (other, latin) in ALIKE {
            assert_eq!(other.chars().count(), latin.len());
            assert!(latin.is_ascii() && other.chars().all(|letter| !letter.is_ascii()));
        }
    }

    #[test]
    fn known_words_in_other_letters() {
        let vocab = Vocabulary::new();
        for word in ["СYCLE", "cусle", "ТАР", "GΟTO", "RAPID\u{A0}"] {
            assert!(disguise(&vocab, word).is_some(), "{word}");
        }
        for word in ["СТАНОК", "фреза", "ÄNDERN", "МАК1"] {
            assert_eq!(disguise(&vocab, word), None, "{word}");
        }
    }
}
