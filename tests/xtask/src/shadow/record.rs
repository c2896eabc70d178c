//! What came of each program, as lines of text, and how two such texts differ.

use std::collections::BTreeMap;
use std::fmt;

/// Which program it is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Key {
    /// A folder of files, or a generator.
    pub suite: String,
    /// The file, the case or the seed.
    pub file: String,
    /// A ready post; `own` for the machine that comes with the program.
    pub post: String,
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.suite, self.file, self.post)
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// There is an NC program.
    Posted,
    /// The CL file is refused, or the run was given up.
    Refused,
    /// The machine or its FIL is refused.
    NoPost,
    /// The post panicked.
    Panicked,
}

/// The words of record files.
const STATUSES: [(Status, &str); 4] = [
    (Status::Posted, "posted"),
    (Status::Refused, "refused"),
    (Status::NoPost, "no-post"),
    (Status::Panicked, "panicked"),
];

impl Status {
    fn word(self) -> &'static str {
        STATUSES.iter().find(|row| row.0 == self).map_or("", |row| row.1)
    }

    fn of_word(word: &str) -> Option<Status> {
        STATUSES.iter().find(|row| row.1 == word).map(|row| row.0)
    }
}

/// What came of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    /// How the run ended.
    pub status: Status,
    /// The hash of the NC program; `-` without one.
    pub nc: String,
    /// Codes of errors and warnings with their places, sorted: `E0503:12`.
    pub codes: Vec<String>,
    /// What verify finds, with lines of the program and of the CL file.
    pub findings: Vec<String>,
}

impl Record {
    /// The post or verify panicked.
    pub fn has_panicked(&self) -> bool {
        self.status == Status::Panicked || self.findings == [PANICKED]
    }
}

/// Stands for the findings of a verify that panicked.
pub const PANICKED: &str = "panicked";

/// Stands between codes and findings.
const FINDINGS: &str = "|";

impl fmt::Display for Record {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.status.word(), self.nc)?;
        self.codes.iter().try_for_each(|code| write!(f, " {code}"))?;
        if !self.findings.is_empty() {
            write!(f, " {FINDINGS} {}", self.findings.join(" "))?;
        }
        Ok(())
    }
}

/// A record file.
pub fn write(records: &BTreeMap<Key, Record>) -> String {
    records.iter().map(|(key, record)| format!("{key} {record}\n")).collect()
}

/// Reads a record file.
///
/// # Errors
/// A line that is none of a record file.
pub fn read(text: &str) -> Result<BTreeMap<Key, Record>, String> {
    text.lines().map(|line| line_of(line).ok_or_else(|| format!("no record: {line}"))).collect()
}

fn line_of(line: &str) -> Option<(Key, Record)> {
    let mut words = line.split(' ').map(str::to_string);
    let mut next = || words.next();
    let key = Key { suite: next()?, file: next()?, post: next()? };
    let (status, nc) = (Status::of_word(&next()?)?, next()?);
    let mut codes: Vec<String> = words.collect();
    let at = codes.iter().position(|word| word == FINDINGS).unwrap_or(codes.len());
    let findings = codes.split_off(at).into_iter().skip(1).collect();
    Some((key, Record { status, nc, codes, findings }))
}

/// One line for each program that differs.
pub fn differences(before: &BTreeMap<Key, Record>, after: &BTreeMap<Key, Record>) -> Vec<String> {
    let mut keys: Vec<&Key> = before.keys().chain(after.keys()).collect();
    keys.sort();
    keys.dedup();
    let told = keys.into_iter().filter_map(|key| {
        let what = match (before.get(key), after.get(key)) {
            (Some(before), Some(after)) => change(before, after)?,
            (Some(before), None) => format!("only before: {before}"),
            (None, after) => format!("only after: {}", after?),
        };
        Some(format!("{key}: {what}"))
    });
    told.collect()
}

/// What became another; `None` when nothing did.
fn change(before: &Record, after: &Record) -> Option<String> {
    let mut told = Vec::new();
    if before.status != after.status {
        told.push(format!("{} -> {}", before.status.word(), after.status.word()));
    } else if before.nc != after.nc {
        told.push(format!("NC {} -> {}", before.nc, after.nc));
    }
    told.extend(came_and_went(&before.codes, &after.codes));
    let findings = came_and_went(&before.findings, &after.findings);
    told.extend(findings.map(|changes| format!("findings {changes}")));
    (!told.is_empty()).then(|| told.join("; "))
}

/// The words that went, with `-`, and those that came, with `+`; `None` for the same words.
fn came_and_went(before: &[String], after: &[String]) -> Option<String> {
    let mut counts: BTreeMap<&String, i32> = BTreeMap::new();
    before.iter().for_each(|word| *counts.entry(word).or_default() -= 1);
    after.iter().for_each(|word| *counts.entry(word).or_default() += 1);
    let told = counts.into_iter().flat_map(|(word, count)| {
        let sign = if count < 0 { '-' } else { '+' };
        vec![format!("{sign}{word}"); count.unsigned_abs() as usize]
    });
    let told = told.collect::<Vec<_>>();
    (!told.is_empty()).then(|| told.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "corpus errors/E0101 own no-post - E0101:part.fil:3\n\
                        words goto.ncl fanuc-mill posted 00ff W0533:4 W0533:4 | rapid:7:4\n\
                        words goto.ncl own posted 01\n\
                        words stop.ncl own panicked -\n";

    #[test]
    fn a_record_file_is_read_as_it_was_written() {
        let records = read(TEXT).unwrap();
        assert_eq!(write(&records), TEXT);
        let findings: Vec<_> = records.values().map(|record| record.findings.join(" ")).collect();
        assert_eq!(findings, ["", "rapid:7:4", "", ""]);
        assert!(differences(&records, &records).is_empty());
        assert_eq!(records.values().filter(|record| record.has_panicked()).count(), 1);
    }

    #[test]
    fn what_is_no_record_is_refused() {
        for line in ["", "words goto.ncl own", "words goto.ncl own written 01"] {
            assert!(read(&format!("{line}\n")).is_err(), "{line}");
        }
    }

    /// The differences of a line from another.
    fn told(before: &str, after: &str) -> Vec<String> {
        differences(&read(before).unwrap(), &read(after).unwrap())
    }

    #[test]
    fn each_part_of_a_record_can_differ() {
        let before = "words a own posted 01 W0533:4 | rapid:7:4";
        let cases = [
            (
                "words a own refused - E0519:9",
                "posted -> refused; +E0519:9 -W0533:4; findings -rapid:7:4",
            ),
            ("words a own posted 02 W0533:4 | rapid:7:4", "NC 01 -> 02"),
            ("words a own posted 01 W0533:4 W0533:4 | rapid:7:4", "+W0533:4"),
            ("words a own posted 01 | rapid:7:4", "-W0533:4"),
            ("words a own posted 01 W0533:4 | rapid:7:5", "findings -rapid:7:4 +rapid:7:5"),
        ];
        for (after, said) in cases {
            assert_eq!(told(before, after), [format!("words a own: {said}")]);
        }
    }

    #[test]
    fn programs_come_and_go() {
        let said = told("words a own posted 01", "words b own posted 02 W0533:1");
        let wanted =
            ["words a own: only before: posted 01", "words b own: only after: posted 02 W0533:1"];
        assert_eq!(said, wanted);
    }
}
