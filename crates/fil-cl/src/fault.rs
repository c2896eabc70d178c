//! What is wrong with a record that no reader has made.

use crate::record::{FIRST_DATA, MAX_WORDS, Record, Word, kind, mode, motion};
use crate::vocabulary::{Vocabulary, WordId};
use crate::words;

impl Record {
    /// Why no statement can make this record with these words; `None` for one that
    /// a reader could have made. So a record from memory is as safe as one of a file.
    pub fn fault(&self, vocabulary: &Vocabulary) -> Option<String> {
        if self.data.len() > MAX_WORDS + 1 - FIRST_DATA {
            return Some(format!("it has more than {MAX_WORDS} words"));
        }
        if !vocabulary.holds(self.major) {
            return Some("its major word is not in its vocabulary".into());
        }
        for (index, word) in self.data.iter().enumerate() {
            if let Some(fault) = self.fault_of_word(*word, vocabulary) {
                return Some(format!("word {} {fault}", index + FIRST_DATA));
            }
        }
        if self.text.contains(|character: char| character.is_control() && character != '\t') {
            return Some("its text holds a control character".into());
        }
        (!self.has_shape()).then(|| {
            let name = vocabulary.name(self.major);
            format!(
                "type {}, subtype {} and its words are not those of {name}",
                self.kind, self.sub
            )
        })
    }

    fn fault_of_word(&self, word: Word, vocabulary: &Vocabulary) -> Option<&'static str> {
        match word {
            Word::Number(number) if !number.is_finite() => Some("is not finite"),
            Word::Minor(word) if !vocabulary.holds(word) => Some("is not in its vocabulary"),
            Word::Text { start, len } => {
                let end = (start as usize).checked_add(len as usize);
                let text = end.and_then(|end| self.text.get(start as usize..end));
                text.is_none().then_some("points beyond its text")
            }
            _ => None,
        }
    }

    /// True when type, subtype and layout are those of the major word.
    fn has_shape(&self) -> bool {
        let form = (self.kind, self.sub);
        match self.major {
            words::GOTO => form == (kind::MOTION, motion::GOTO) && self.is_motion(&[3, 6]),
            words::FROM => form == (kind::MOTION, motion::FROM) && self.is_motion(&[3, 6]),
            words::GODLTA => form == (kind::MOTION, motion::GODLTA) && self.is_motion(&[1, 3]),
            words::CIRCLE => self.circle().is_some(),
            words::CUTTER => self.kind == kind::CUTTER,
            words::TLAXIS => form == (kind::MODE, mode::TLAXIS),
            words::MULTAX => form == (kind::MODE, mode::MULTAX),
            words::FINI => self.kind == kind::FINI,
            major if crate::layout::is_uncomputed(major) => false,
            _ => matches!(self.kind, kind::POST | kind::PSEUDO),
        }
    }

    /// Two empty slots, then so many numbers.
    fn is_motion(&self, counts: &[usize]) -> bool {
        let [Word::Empty, Word::Empty, values @ ..] = self.data.as_slice() else { return false };
        counts.contains(&values.len()) && values.iter().all(|word| matches!(word, Word::Number(_)))
    }
}

impl Vocabulary {
    /// True for a word of this vocabulary.
    fn holds(&self, word: WordId) -> bool {
        word.index() < self.len()
    }

    /// True when this vocabulary holds all words of `base` under the same ids, and
    /// perhaps more: a clone that has grown.
    pub fn extends(&self, base: &Vocabulary) -> bool {
        base.len() <= self.len()
            && (0..base.len()).all(|index| {
                let word = WordId(index as u32);
                self.name(word) == base.name(word)
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Circle;
    use crate::{Options, Reader};

    #[test]
    fn what_a_reader_makes_has_no_fault() {
        let cl = "PARTNO / 7\nUNITS / MM\nMULTAX / ON\nFROM / 0, 0, 9\nGOTO / 1, 2, 3, 0, 0, 1\n\
                  GODLTA / 1\nCUTTER / 10\nTLAXIS / 0, 0, 1\nCIRCLE / 0, 0, 0, 0, 0, 1, 5\n\
                  $$-> CUTCOM_GEOMETRY_TYPE / OUTPUT_ON_CENTER\nPPRINT / A B\nNEWWORD / 1, OWN, , 2\nFINI\n";
        let mut reader = Reader::new(cl.as_bytes(), "a.ncl", Options::default());
        let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
        let mut count = 0;
        while reader.read(&mut vocabulary, &mut record).unwrap() {
            assert_eq!(record.fault(&vocabulary), None, "{record:?}");
            count += 1;
        }
        assert!(count >= 12, "{count}");
    }

    #[test]
    fn what_no_statement_makes_is_found() {
        let vocabulary = Vocabulary::new();
        let mut other = Vocabulary::new();
        let unknown = other.intern("OWNWORD");
        let found = |record: &Record| record.fault(&vocabulary).unwrap();
        assert_eq!(found(&Record::goto([1.0, f64::NAN, 0.0], None)), "word 7 is not finite");
        assert_eq!(found(&Record::command(unknown)), "its major word is not in its vocabulary");
        let mut minor = Record::command(words::SPINDL);
        minor.data.push(Word::Minor(unknown));
        assert_eq!(found(&minor), "word 4 is not in its vocabulary");
        assert_eq!(minor.fault(&other), None);
        let mut text = Record::text_command(words::PPRINT, "AB");
        text.data[0] = Word::Text { start: 1, len: 2 };
        assert_eq!(found(&text), "word 4 points beyond its text");
        text.data[0] = Word::Text { start: u32::MAX, len: u32::MAX };
        assert_eq!(found(&text), "word 4 points beyond its text");
        assert_eq!(
            found(&Record::text_command(words::PPRINT, "A\nG0 Z-99")),
            "its text holds a control character"
        );
        let shapeless = "type 2000, subtype 0 and its words are not those of GOTO";
        assert_eq!(found(&Record::command(words::GOTO)), shapeless);
        let mut short = Record::goto([0.0; 3], None);
        short.data.pop();
        assert!(short.fault(&vocabulary).is_some());
        let mut circle =
            Record::arc(Circle { center: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: None });
        assert_eq!(circle.fault(&vocabulary), None);
        circle.data.truncate(8);
        assert!(circle.fault(&vocabulary).is_some());
        assert!(Record::command(words::TLON).fault(&vocabulary).is_some());
    }

    #[test]
    fn a_grown_clone_extends_its_base() {
        let mut base = Vocabulary::new();
        base.intern("FIRST");
        let mut grown = base.clone();
        grown.intern("SECOND");
        assert!(grown.extends(&base) && base.extends(&base) && !base.extends(&grown));
        let mut other = Vocabulary::new();
        other.intern("OTHER");
        assert!(!other.extends(&base));
    }
}
