//! Names that were perhaps meant: the nearest of the known ones.

/// Edits that a name may be away from the one that was meant.
const MOST_EDITS: usize = 2;

/// Longest name that is looked at, in bytes; no known name is longer.
const LONGEST: usize = 80;

/// The known name that differs least from `name`, letters in any case: by two
/// edits at most, and by less than half of its length. Of several that differ
/// alike the first in the alphabet is taken, so that the order of `known` does
/// not matter. A known name that is equal is no suggestion.
pub fn nearest<'k>(name: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    if name.len() > LONGEST {
        return None;
    }
    known
        .into_iter()
        .filter(|other| other.len().abs_diff(name.len()) <= MOST_EDITS)
        .map(|other| (edits(name, other), other))
        .filter(|(edits, _)| (1..=MOST_EDITS).contains(edits) && edits * 2 < name.len())
        .min()
        .map(|(_, other)| other)
}

/// The hint `did you mean X?` for the nearest known name.
pub fn did_you_mean<'k>(name: &str, known: impl IntoIterator<Item = &'k str>) -> Option<String> {
    nearest(name, known).map(|near| format!("did you mean {near}?"))
}

/// Number of single-character edits between two texts, letters in any case: a character put in,
/// left out or replaced, or two neighbours swapped.
fn edits(a: &str, b: &str) -> usize {
    strsim::osa_distance(&a.to_ascii_uppercase(), &b.to_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_counted_one_by_one() {
        for (a, b, count) in [
            ("", "", 0),
            ("CYCLE", "cycle", 0),
            ("CYCEL", "CYCLE", 1),
            ("CYLE", "CYCLE", 1),
            ("SQTRF", "SQRTF", 1),
            ("SPINDEL", "SPINDL", 1),
            ("", "ABC", 3),
            ("KITTEN", "SITTING", 3),
        ] {
            assert_eq!((edits(a, b), edits(b, a)), (count, count), "{a} {b}");
        }
    }

    #[test]
    fn only_near_names_are_suggested() {
        let known = ["CYCLE", "THREAD", "ON", "SPINDL"];
        assert_eq!(nearest("CYLCE", known), Some("CYCLE"));
        assert_eq!(nearest("threat", known), Some("THREAD"));
        assert_eq!(nearest("CYCLE", known), None, "it is known");
        assert_eq!(nearest("OF", known), None, "half of it differs");
        assert_eq!(nearest("COOLNT", known), None);
        assert_eq!(did_you_mean("SPINDEL", known).as_deref(), Some("did you mean SPINDL?"));
    }

    #[test]
    fn the_order_of_the_known_names_does_not_matter() {
        assert_eq!(nearest("NAMEX", ["NAMEB", "NAMEA"]), nearest("NAMEX", ["NAMEA", "NAMEB"]));
    }
}
