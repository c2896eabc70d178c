//! The hashes in the repository: one for each suite and post.

use std::collections::BTreeMap;

use super::outcome::hash;
use super::record::{Key, Record, Status};

/// Suite and post.
pub type Place = (String, String);

/// What all programs of a suite come to with a post.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sum {
    /// How many there are.
    pub count: usize,
    /// How many of them are posted.
    pub posted: usize,
    /// The hash of their records, findings left out.
    pub posting: String,
    /// The hash of what verify finds.
    pub findings: String,
}

const HEAD: &str = "\
# What `cargo xtask shadow` finds, one line for each suite and post: programs, how many of them
# are posted, a hash of what the post does with them, a hash of what verify finds. A line that
# changes is read with `cargo xtask shadow --base REV`, then `--update` writes this file.
";

/// The sums of a run.
pub fn of(records: &BTreeMap<Key, Record>) -> BTreeMap<Place, Sum> {
    let mut places: BTreeMap<Place, Vec<(&Key, &Record)>> = BTreeMap::new();
    for (key, record) in records {
        places.entry((key.suite.clone(), key.post.clone())).or_default().push((key, record));
    }
    places.into_iter().map(|(place, records)| (place, sum(&records))).collect()
}

fn sum(records: &[(&Key, &Record)]) -> Sum {
    let (mut posting, mut findings) = (String::new(), String::new());
    for (key, record) in records {
        let plain = Record { findings: Vec::new(), ..(*record).clone() };
        posting += &format!("{key} {plain}\n");
        findings += &format!("{key} {}\n", record.findings.join(" "));
    }
    let posted = records.iter().filter(|(_, record)| record.status == Status::Posted).count();
    Sum {
        count: records.len(),
        posted,
        posting: hash(posting.as_bytes()),
        findings: hash(findings.as_bytes()),
    }
}

/// The file of hashes.
pub fn write(sums: &BTreeMap<Place, Sum>) -> String {
    let lines = sums.iter().map(|((suite, post), sum)| {
        let Sum { count, posted, posting, findings } = sum;
        format!("{suite} {post} {count} {posted} {posting} {findings}\n")
    });
    std::iter::once(HEAD.to_string()).chain(lines).collect()
}

/// Reads the file of hashes.
///
/// # Errors
/// A line that is none of it, as what a merge leaves.
pub fn read(text: &str) -> Result<BTreeMap<Place, Sum>, String> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines
        .map(|line| line_of(line).ok_or_else(|| format!("tests/shadow.txt: no hash: {line}")))
        .collect()
}

fn line_of(line: &str) -> Option<(Place, Sum)> {
    let words: Vec<&str> = line.split(' ').collect();
    let [suite, post, count, posted, posting, findings] = words[..] else { return None };
    let sum = Sum {
        count: count.parse().ok()?,
        posted: posted.parse().ok()?,
        posting: posting.to_string(),
        findings: findings.to_string(),
    };
    Some(((suite.to_string(), post.to_string()), sum))
}

/// One line for each suite and post that differs.
pub fn differences(known: &BTreeMap<Place, Sum>, found: &BTreeMap<Place, Sum>) -> Vec<String> {
    let mut places: Vec<&Place> = known.keys().chain(found.keys()).collect();
    places.sort();
    places.dedup();
    let told = places.into_iter().filter_map(|place| {
        let what = match (known.get(place), found.get(place)) {
            (Some(known), Some(found)) => change(known, found)?,
            (Some(_), None) => "is no longer there".to_string(),
            (None, _) => "is new".to_string(),
        };
        Some(format!("{} with {}: {what}", place.0, place.1))
    });
    told.collect()
}

fn change(known: &Sum, found: &Sum) -> Option<String> {
    let mut told = Vec::new();
    let counts = |sum: &Sum| format!("{} of {} posted", sum.posted, sum.count);
    if counts(known) != counts(found) {
        told.push(format!("{} -> {}", counts(known), counts(found)));
    } else if known.posting != found.posting {
        told.push("programs, codes or lines differ".to_string());
    }
    if known.findings != found.findings {
        told.push("findings of verify differ".to_string());
    }
    (!told.is_empty()).then(|| told.join("; "))
}

#[cfg(test)]
mod tests {
    use super::super::record;
    use super::*;

    fn sums(lines: &str) -> BTreeMap<Place, Sum> {
        of(&record::read(lines).unwrap())
    }

    const LINES: &str = "corpus a own posted 01 W0533:4\ncorpus b own refused - E0519:2\n\
                         words a fanuc-mill posted 02 | rapid:7:4\n";

    #[test]
    fn the_file_is_read_as_it_was_written() {
        let known = sums(LINES);
        let text = write(&known);
        assert_eq!(read(&text).unwrap(), known);
        assert!(text.contains("\ncorpus own 2 1 "), "{text}");
        assert!(differences(&known, &known).is_empty());
        assert!(read("<<<<<<< main\n").is_err());
    }

    #[test]
    fn each_change_of_a_record_names_its_suite_and_post() {
        let known = sums(LINES);
        let said = |from: &str, to: &str| {
            assert!(LINES.contains(from));
            differences(&known, &sums(&LINES.replace(from, to)))
        };
        let differ = "corpus with own: programs, codes or lines differ";
        assert_eq!(said("posted 01", "posted 03"), [differ]);
        assert_eq!(said("W0533:4", "W0533:5"), [differ]);
        assert_eq!(said("E0519:2", "E0521:2"), [differ]);
        assert_eq!(
            said("refused -", "posted 01"),
            ["corpus with own: 1 of 2 posted -> 2 of 2 posted"]
        );
        assert_eq!(
            said("rapid:7:4", "rapid:7:5"),
            ["words with fanuc-mill: findings of verify differ"]
        );
        assert_eq!(
            said("words a fanuc-mill", "words a fanuc-lathe"),
            ["words with fanuc-lathe: is new", "words with fanuc-mill: is no longer there"]
        );
    }
}
