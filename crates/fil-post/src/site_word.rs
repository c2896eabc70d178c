//! Words that only a shop or a CAM system knows: which of them may well inform and do
//! nothing, so that a user can be offered to list them as without effect.

use fil_cl::{Record, Vocabulary, Word, WordId};
use fil_diag::suggest::nearest;

use crate::{dispatch, no_effect};

/// A shorter name is too near to many words of motion (GO, GOT, ARC).
const SHORTEST: usize = 4;

/// So many numbers in a row may be a point, a direction or a list of angles.
const COORDINATES: usize = 3;

/// How parts of names begin that speak of moving or placing the tool or the part, or of
/// what the machine does.
const DOING: [&str; 58] = [
    "ABS", "APPR", "ARC", "AXIS", "BACK", "BORE", "CALL", "CHUCK", "CIR", "CLAMP", "COMP", "COOL",
    "CURV", "CUT", "CYC", "DELAY", "DRILL", "DWELL", "FED", "FEED", "FIXT", "FRAM", "GO", "HEAD",
    "HELI", "HOME", "INCR", "INDEX", "JUMP", "LEAD", "LINE", "LOAD", "LOOP", "MATR", "MIRR", "MOV",
    "NURB", "OFFS", "OFS", "ORIG", "PALL", "PECK", "PLUNG", "POINT", "POS", "PROBE", "RAP", "RETR",
    "ROT", "SHIFT", "SPIN", "SPLIN", "STOP", "SWIV", "TABL", "TILT", "TRANS", "TURR",
];

/// Words of Creo for machines that no post here is for, with what they do there (PTC's help on the
/// statements of NC sequences).
const OF_OTHER_MACHINES: [(&str, &str); 3] = [
    ("DMIS", "begins or ends what a coordinate measuring machine does"),
    ("FLUSH", "sets the flushing of a wire EDM machine"),
    ("GENRTR", "names the generator register of a wire EDM machine"),
];

/// Statements of FIL that no CL file has: a text with them is a macro file.
const OF_FIL: [&str; 11] = [
    "CASE", "CIMFIL", "ELSE", "ELSEIF", "ENDCAS", "ENDIF", "JUMPTO", "MACRO", "REDEF", "TERMAC",
    "WHEN",
];

/// True for a statement of FIL.
pub fn is_of_fil(name: &str) -> bool {
    OF_FIL.contains(&name)
}

/// What a word does on a machine that no post here is for.
pub fn on_other_machines(name: &str) -> Option<&'static str> {
    OF_OTHER_MACHINES.iter().find(|(word, _)| *word == name).map(|(_, does)| *does)
}

/// The word that an unknown major word was perhaps meant to be: one that the post carries
/// out, else one that it lists as without effect, else one of the vocabulary.
pub fn perhaps_meant(word: WordId, vocabulary: &Vocabulary) -> Option<&str> {
    if vocabulary.is_known(word) {
        return None;
    }
    let name = vocabulary.name(word);
    let listed = no_effect::rows().filter(|row| row.item == "*").map(|row| row.major);
    near_a_handled_word(name, vocabulary)
        .or_else(|| nearest(name, listed))
        .or_else(|| vocabulary.nearest_major(word))
}

fn near_a_handled_word<'v>(name: &str, vocabulary: &'v Vocabulary) -> Option<&'v str> {
    nearest(name, dispatch::HANDLERS.iter().map(|(word, _)| vocabulary.name(*word)))
}

/// True for a record whose major word may well be without effect: no vocabulary knows it or
/// one like it that acts, its name does not speak of moving or placing, and it holds no
/// coordinates.
pub fn may_be_without_effect(record: &Record, vocabulary: &Vocabulary) -> bool {
    let name = vocabulary.name(record.major);
    let meant = perhaps_meant(record.major, vocabulary);
    name.len() >= SHORTEST
        && name.is_ascii()
        && !vocabulary.is_known(record.major)
        && near_a_handled_word(name, vocabulary).is_none()
        && meant.is_none_or(no_effect::is_whole_record)
        && !speaks_of_doing(name)
        && !is_of_fil(name)
        && !holds_coordinates(record)
}

fn speaks_of_doing(name: &str) -> bool {
    let mut parts = name.split(|character: char| !character.is_alphabetic());
    parts.any(|part| DOING.iter().any(|begin| part.starts_with(begin)))
}

fn holds_coordinates(record: &Record) -> bool {
    let is_number = |word: &Word| matches!(word, Word::Number(_));
    record.data.windows(COORDINATES).any(|words| words.iter().all(is_number))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_offered(name: &str, data: &[Word]) -> bool {
        let mut vocabulary = Vocabulary::new();
        let mut record = Record::command(vocabulary.intern(name));
        record.data.extend_from_slice(data);
        may_be_without_effect(&record, &vocabulary)
    }

    #[test]
    fn words_that_may_move_are_not_offered() {
        for name in ["SHOPINFO", "OPDATA2X", "CATPART_X", "QMSTEXT"] {
            assert!(is_offered(name, &[]), "{name}");
        }
        for name in [
            "GO",
            "GOT",
            "GT",
            "GOTOO",
            "GOT0",
            "GTOO",
            "CIRC",
            "CIRCEL",
            "RAPD",
            "MOVE_TO",
            "TABLE_ROT",
            "B_AXIS",
            "GOTOXYZ",
            "FEED",
            "FEEDRATE",
            "LODTL",
            "COLNT",
            "CYCEL",
            "TILTPLANE",
            "CLEARP",
            "PIVOTZ",
            "ROTABL",
            "HOMEPOS",
            "OFFSET_WORK",
        ] {
            assert!(!is_offered(name, &[]), "{name}");
        }
    }

    #[test]
    fn words_with_coordinates_are_not_offered() {
        let number = Word::Number(1.0);
        assert!(is_offered("SHOPINFO", &[number, number, Word::Empty, number]));
        assert!(!is_offered("SHOPINFO", &[Word::Empty, number, number, number]));
    }

    #[test]
    fn words_that_the_post_carries_out_are_meant_first() {
        let mut vocabulary = Vocabulary::new();
        let mut meant = |name: &str| {
            let word = vocabulary.intern(name);
            perhaps_meant(word, &vocabulary).map(str::to_string)
        };
        assert_eq!(meant("COLNT").as_deref(), Some("COOLNT"));
        assert_eq!(meant("GOTOO").as_deref(), Some("GOTO"));
        assert_eq!(meant("PAIT").as_deref(), Some("PAINT"));
        assert_eq!(meant("SHOPINFO"), None);
        assert_eq!(meant("GOTO"), None);
    }
}
