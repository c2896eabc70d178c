//! The command line of `filpost test`.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use filpost::cl::ClDialect;
use filpost::{Moment, Unit};

use super::{Chosen, Grant, ignored, moment, tolerance, unit};

/// `filpost test`
#[derive(Debug, ClapArgs)]
pub struct TestArgs {
    /// Folder to look for cases in; `corpus` where there is one, else this folder
    pub dir: Option<PathBuf>,
    /// Show each difference and write the expected files anew
    #[arg(long)]
    pub update: bool,
    /// Write a report for people: one HTML file
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write a report for continuous integration: JUnit XML
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Report the lines, outcomes of conditions, sections and settings that no case exercises
    #[arg(long)]
    pub coverage: bool,
    /// Write the coverage as a page for people
    #[arg(long, value_name = "FILE", requires = "coverage")]
    pub coverage_html: Option<PathBuf>,
    /// Write the coverage for editors and code hosts: a tracefile of lcov
    #[arg(long, value_name = "FILE", requires = "coverage")]
    pub lcov: Option<PathBuf>,
    /// Change the FIL and the settings of the posts, one small change at a time, and report the
    /// changes that no case notices
    #[arg(long, conflicts_with = "update")]
    pub mutate: bool,
    /// List what scripts and INSERT changed in each case, and judge the rest
    #[arg(long, conflicts_with = "mutate")]
    pub audit: bool,
    /// Run only every Nth case, starting with the Ith (1/4), to share them among computers
    #[arg(long, value_name = "I/N", value_parser = shard, conflicts_with_all = ["coverage", "mutate"])]
    pub shard: Option<Shard>,
    /// Make a case in this folder from --cl, --nc and a post, and run it
    #[arg(long, value_name = "FOLDER", requires = "cl", requires = "nc", conflicts_with_all = ["dir", "update", "html", "junit", "coverage", "mutate", "shard"])]
    pub init: Option<PathBuf>,
    /// The CL file of the case
    #[arg(long, value_name = "PART", requires = "init")]
    pub cl: Option<PathBuf>,
    /// The dialect of that CL file, where it is not recognized
    #[arg(long, value_name = "NAME", requires = "init")]
    pub dialect: Option<ClDialect>,
    /// The proven NC program of the case
    #[arg(long, value_name = "NC", requires = "init")]
    pub nc: Option<PathBuf>,
    /// The post of the case
    #[command(flatten)]
    pub chosen: Chosen,
    /// The unit of the case's CL file, where it has no UNITS statement: mm or inch
    #[arg(long, value_name = "UNIT", value_parser = unit, requires = "init")]
    pub units: Option<Unit>,
    /// A FIL file of the case (may be given again)
    #[arg(short, long, value_name = "FILE", requires = "init")]
    pub fil: Vec<PathBuf>,
    /// Largest difference of lengths and angles that the case ignores
    #[arg(long, value_name = "STEP", requires = "init", value_parser = tolerance)]
    pub tol: Option<f64>,
    /// What the case ignores: n, comments, dates, points, spaces or letters
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = ignored, requires = "init")]
    pub ignore: Vec<String>,
    /// A folder that FIL of the case reads (FILEF), which is copied into the case
    #[arg(long, value_name = "read=DIR", value_parser = grant, requires = "init")]
    pub grant: Option<PathBuf>,
    /// The moment that DATEF and TIMEF give in the case, as 2026-01-31T12:00:00
    #[arg(long, value_name = "MOMENT", value_parser = moment, requires = "init")]
    pub set_clock: Option<Moment>,
}

/// One of several parts of the cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    pub number: usize,
    /// Of how many.
    pub of: usize,
}

impl Shard {
    /// True when the case at this index, from 0, is in this part.
    pub fn has(self, index: usize) -> bool {
        index % self.of == self.number - 1
    }

    /// Leaves the items of this part.
    pub fn keep<T>(self, items: &mut Vec<T>) {
        let mut index = 0..;
        items.retain(|_| index.next().is_some_and(|index| self.has(index)));
    }
}

pub(super) fn shard(text: &str) -> Result<Shard, String> {
    let number = |text: &str| text.parse().ok().filter(|number| *number > 0);
    let parts = text.split_once('/').and_then(|(one, all)| Some((number(one)?, number(all)?)));
    match parts {
        Some((number, of)) if number <= of => Ok(Shard { number, of }),
        _ => Err("write I/N, such as 2/4: the second of four parts".to_string()),
    }
}

/// A case reads a folder of its own and writes none: a test leaves nothing behind.
fn grant(text: &str) -> Result<PathBuf, String> {
    match super::grant(text)? {
        Grant::Read(folder) => Ok(folder),
        Grant::Write(_) => Err("a case has no folder to write to; write read=DIR".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_case_is_in_one_part() {
        let parts: Vec<Shard> = (1..=3).map(|number| Shard { number, of: 3 }).collect();
        for index in 0..10 {
            assert_eq!(parts.iter().filter(|part| part.has(index)).count(), 1);
        }
    }

    #[test]
    fn parts_that_are_none_are_refused() {
        assert_eq!(shard("2/4"), Ok(Shard { number: 2, of: 4 }));
        for wrong in ["0/0", "0/4", "5/3", "1", "/", "1/", "a/b", "-1/2", "1/2/3", "1.0/2", ""] {
            assert!(shard(wrong).is_err(), "{wrong}");
        }
    }
}
