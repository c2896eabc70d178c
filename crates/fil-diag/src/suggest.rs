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

/// Most names of a group that are shown.
const MOST_OF_GROUP: usize = 3;

/// What was perhaps meant by a name of parts, `group.first_second`: the nearest known name, else
/// names of the same group with a part that begins alike, else the group itself.
pub fn meant_in_group<'k>(
    name: &str,
    known: impl Iterator<Item = &'k str> + Clone,
) -> Option<String> {
    if let Some(near) = did_you_mean(name, known.clone()) {
        return Some(near);
    }
    let (group, key) = name.split_once('.')?;
    let of_group = known.filter_map(|other| {
        let (other_group, other_key) = other.split_once('.')?;
        (other_group == group).then_some((other, other_key))
    });
    let alike = |(_, other): &(&str, &str)| {
        let mut parts = key.split('_').filter(|part| *part != "code");
        parts.any(|part| other.split('_').any(|known| begin_alike(part, known)))
    };
    let near: Vec<&str> =
        of_group.clone().filter(alike).map(|(name, _)| name).take(MOST_OF_GROUP).collect();
    if !near.is_empty() {
        return Some(format!("did you mean {}?", near.join(" or ")));
    }
    let names_group = of_group.clone().next().is_some();
    names_group.then(|| format!("`filpost explain {group}` lists the settings of {group}"))
}

/// Both begin with the same three letters, as `thru` and `through`.
fn begin_alike(a: &str, b: &str) -> bool {
    a.get(..3).is_some_and(|start| b.starts_with(start))
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
    fn a_name_of_a_group_suggests_its_like() {
        let known = ["coolant.flood_code", "coolant.thru_high_code", "coolant.thru_low_code"];
        let meant = |name: &str| meant_in_group(name, known.iter().copied());
        let thru = "did you mean coolant.thru_high_code or coolant.thru_low_code?";
        assert_eq!(meant("coolant.through").as_deref(), Some(thru));
        assert_eq!(meant("coolant.flod_code").as_deref(), Some("did you mean coolant.flood_code?"));
        let group = "`filpost explain coolant` lists the settings of coolant";
        assert_eq!(meant("coolant.wet").as_deref(), Some(group));
        assert_eq!(meant("water.wet"), None);
    }

    #[test]
    fn the_order_of_the_known_names_does_not_matter() {
        assert_eq!(nearest("NAMEX", ["NAMEB", "NAMEA"]), nearest("NAMEX", ["NAMEA", "NAMEB"]));
    }
}
