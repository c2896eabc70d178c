//! What the words of a record are, by their numbers, as POSTF(7,n) counts them. Only words
//! whose number is fixed are named: those of couplets in any order are not.

/// Words that follow each other in records of a major word.
struct Words {
    major: &'static str,
    /// A minor word at [`FIRST`] that the record must have.
    minor: Option<&'static str>,
    /// Number of the first of them.
    first: usize,
    names: &'static [&'static str],
}

/// Number of the first word behind the major word.
const FIRST: usize = 4;
/// That of the first coordinate of a motion.
const MOTION: usize = 6;
/// That of the center of a circle, behind the counts of its canonical form.
const CENTER: usize = 9;

const fn words(
    major: &'static str,
    minor: Option<&'static str>,
    first: usize,
    names: &'static [&'static str],
) -> Words {
    Words { major, minor, first, names }
}

const TABLE: [Words; 32] = [
    words("GOTO", None, MOTION, &["x", "y", "z", "i", "j", "k"]),
    words("FROM", None, MOTION, &["x", "y", "z", "i", "j", "k"]),
    words("GODLTA", None, MOTION, &["dx, or way along the axis", "dy", "dz"]),
    words("CIRCLE", None, CENTER, &["x", "y", "z", "i", "j", "k", "radius"]),
    words("TLAXIS", None, FIRST, &["i", "j", "k"]),
    words("GOHOME", None, FIRST, &["x", "y", "z"]),
    words("ORIGIN", None, FIRST, &["x", "y", "z"]),
    words("LOADTL", None, FIRST, &["tool"]),
    words("TURRET", None, FIRST, &["tool"]),
    words("SELCTL", None, FIRST, &["tool"]),
    words("LOAD", Some("TOOL"), FIRST + 1, &["tool"]),
    words("SELECT", Some("TOOL"), FIRST + 1, &["tool"]),
    words("PREFUN", None, FIRST, &["G code"]),
    words("AUXFUN", None, FIRST, &["M code"]),
    words("CUTTER", None, FIRST, &["diameter"]),
    words("LINTOL", None, FIRST, &["tolerance, ON or OFF"]),
    words("SEQNO", None, FIRST, &["number, ON or OFF"]),
    words("SEQNO", Some("INCR"), FIRST + 1, &["step"]),
    words("DELAY", None, FIRST, &["seconds, or REV"]),
    words("DELAY", Some("REV"), FIRST + 1, &["revolutions"]),
    words("CALSUB", None, FIRST, &["subprogram"]),
    words("CYCLE", None, FIRST, &["type, or OFF"]),
    words("OP", None, FIRST, &["operation"]),
    words("THREAD", None, FIRST, &["form, or OFF"]),
    words("THREAD", Some("AUTO"), FIRST + 1, &["x", "y", "z", "TO", "x", "y", "z"]),
    words("MODE", None, FIRST, &["mode"]),
    words("UNITS", None, FIRST, &["unit"]),
    words("MULTAX", None, FIRST, &["ON or OFF"]),
    words("CUTCOM", None, FIRST, &["side, or OFF"]),
    words("PARTNO", None, FIRST, &["text"]),
    words("PPRINT", None, FIRST, &["text"]),
    words("INSERT", None, FIRST, &["text"]),
];

/// Major words whose records have a subtype at word 3 and not the code of the word.
const SUBTYPES: [&str; 7] = ["GOTO", "FROM", "GODLTA", "CIRCLE", "TLAXIS", "MULTAX", "CUTTER"];

/// What word `n` of a record of a major word is, where that is known; `minor` is its word 4,
/// where that is a minor word.
pub(crate) fn meaning(major: &str, minor: Option<&str>, n: usize) -> Option<&'static str> {
    match n {
        1 => return Some("number of the record"),
        2 => return Some("type"),
        3 if SUBTYPES.contains(&major) => return Some("subtype"),
        3 => return Some("major word"),
        _ => {}
    }
    let of_word = TABLE.iter().filter(|row| row.major == major);
    let fits = of_word.filter(|row| row.minor.is_none() || row.minor == minor);
    let mut names = fits.filter_map(|row| row.names.get(n.checked_sub(row.first)?).copied());
    names.next()
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use filpost::cl::reader::{Options, Reader};
    use filpost::cl::record::WordView;
    use filpost::cl::{Record, Vocabulary};

    use super::meaning;

    /// The words of the last record of a text that have a meaning in the table.
    fn named(text: &str, minor: Option<&str>) -> Vec<(&'static str, String)> {
        // An arc needs a point before it, a motion after it.
        let text = match text.starts_with("CIRCLE") {
            true => format!("GOTO / 1, 2, 3\n{text}\n"),
            false => format!("{text}\n"),
        };
        let mut vocabulary = Vocabulary::new();
        let mut reader = Reader::new(Cursor::new(text), "part.ncl", Options::default());
        let mut record = Record::default();
        while reader.read(&mut vocabulary, &mut record).expect("read") {}
        let major = vocabulary.name(record.major).to_string();
        let shown = |n: usize| match record.word(n, &vocabulary)? {
            WordView::Number(number) => Some(number.to_string()),
            WordView::Word { name, .. } => Some(name.to_string()),
            WordView::Text(text) => Some(text.to_string()),
            WordView::Empty => Some("EMPTY".into()),
        };
        let words =
            (4..=record.len()).filter_map(|n| Some((meaning(&major, minor, n)?, shown(n)?)));
        words.collect()
    }

    /// The table against the reader of CL files: each name says what the word there is.
    #[test]
    fn words_stand_where_the_reader_puts_them() {
        let six = ["x=1", "y=2", "z=3", "i=0", "j=0.6", "k=0.8"];
        let mut wrong = Vec::new();
        for (text, minor, wanted) in [
            ("GOTO / 1, 2, 3, 0, 0.6, 0.8", None, &six[..]),
            ("FROM / 1, 2, 3, 0, 0.6, 0.8", None, &six),
            ("GODLTA / 1, 2, 3", None, &["dx, or way along the axis=1", "dy=2", "dz=3"]),
            (
                "CIRCLE / 1, 2, 3, 0, 0.6, 0.8, 7",
                None,
                &["x=1", "y=2", "z=3", "i=0", "j=0.6", "k=0.8", "radius=7"],
            ),
            ("TLAXIS / 0, 0.6, 0.8", None, &["i=0", "j=0.6", "k=0.8"]),
            ("GOHOME / 1, 2, 3", None, &["x=1", "y=2", "z=3"]),
            ("ORIGIN / 1, 2, 3", None, &["x=1", "y=2", "z=3"]),
            ("LOADTL / 5, LENGTH, 9", None, &["tool=5"]),
            ("TURRET / 5", None, &["tool=5"]),
            ("SELCTL / 5", None, &["tool=5"]),
            ("LOAD / TOOL, 5", Some("TOOL"), &["tool=5"]),
            ("SELECT / TOOL, 5", Some("TOOL"), &["tool=5"]),
            ("PREFUN / 5", None, &["G code=5"]),
            ("AUXFUN / 5", None, &["M code=5"]),
            ("CUTTER / 5", None, &["diameter=5"]),
            ("LINTOL / 5", None, &["tolerance, ON or OFF=5"]),
            ("SEQNO / 5", None, &["number, ON or OFF=5"]),
            ("SEQNO / INCR, 5", Some("INCR"), &["number, ON or OFF=INCR", "step=5"]),
            ("DELAY / 5", None, &["seconds, or REV=5"]),
            ("DELAY / REV, 5", Some("REV"), &["seconds, or REV=REV", "revolutions=5"]),
            ("CALSUB / 5", None, &["subprogram=5"]),
            ("CYCLE / DRILL, DEPTH, 5", None, &["type, or OFF=DRILL"]),
            ("OP / THREAD, TURN", None, &["operation=THREAD"]),
            ("THREAD / TPI, 5", None, &["form, or OFF=TPI"]),
            (
                "THREAD / AUTO, 1, 2, 3, TO, 4, 5, 6",
                Some("AUTO"),
                &["form, or OFF=AUTO", "x=1", "y=2", "z=3", "TO=TO", "x=4", "y=5", "z=6"],
            ),
            ("MODE / MILL", None, &["mode=MILL"]),
            ("UNITS / MM", None, &["unit=MM"]),
            ("MULTAX / ON", None, &["ON or OFF=ON"]),
            ("CUTCOM / LEFT", None, &["side, or OFF=LEFT"]),
            ("PARTNO BRACKET 7", None, &["text=BRACKET 7"]),
            ("PPRINT BRACKET, 7", None, &["text=BRACKET, 7"]),
            ("INSERT M8", None, &["text=M8"]),
        ] {
            let found: Vec<String> =
                named(text, minor).iter().map(|(name, word)| format!("{name}={word}")).collect();
            if found != wanted {
                wrong.push(format!("{text}: {found:?}, expected {wanted:?}"));
            }
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}
