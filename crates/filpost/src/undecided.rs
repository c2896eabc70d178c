//! Settings of a learned post that no proven program decides: a warning where one acts.
//!
//! A learned machine lists other values with which every proven program comes out the same. Here
//! the CL file is posted once more with all of them. If that is another program, the list is
//! halved until the settings that make the difference are found.

use std::collections::BTreeMap;
use std::io::Cursor;

use fil_diag::{Diag, TextSpan};
use fil_machine::{Commons, files as settings};

use crate::error::RunCode;
use crate::program::Program;
use crate::run::Run;

/// Most settings that are named.
const MOST_NAMED: usize = 5;

/// Finds what acts of the undecided settings of a machine.
pub(crate) struct Search<'s> {
    program: &'s Program,
    /// Makes a run with the options of the run that was asked for.
    start: &'s dyn Fn(Program) -> Run<'static>,
    cl: &'s [u8],
    nc: Vec<u8>,
    found: Vec<(String, u32)>,
}

/// The warnings of a CL file that was posted.
pub(crate) fn warnings(
    program: &Program,
    start: &dyn Fn(Program) -> Run<'static>,
    cl: &[u8],
    name: &str,
) -> Vec<Diag> {
    let mut search = Search { program, start, cl, nc: Vec::new(), found: Vec::new() };
    let Some(nc) = search.post(program.clone()) else { return Vec::new() };
    search.nc = nc;
    for layer in layers(program.commons().undecided()) {
        search.look(&layer);
    }
    let text = String::from_utf8_lossy(cl);
    let warning = |message: String, line: u32| {
        let statement = text.lines().nth(line.saturating_sub(1) as usize).unwrap_or_default();
        RunCode::Undecided.diag(message).at(TextSpan::line(name, line, statement))
    };
    let unequal = program.commons().unequal();
    let unequal = (!unequal.is_empty()).then(|| {
        warning(format!("proven programs come out differently: {}", unequal.join(", ")), 1)
    });
    let mut by_line: BTreeMap<u32, Vec<String>> = BTreeMap::new();
    for (setting, line) in search.found {
        by_line.entry(line).or_default().push(setting.replace('\n', " and "));
    }
    let found = by_line.into_iter().map(|(line, settings)| {
        let settings = settings.join(" or ");
        warning(format!("with {settings} this would be another program"), line)
    });
    unequal.into_iter().chain(found).collect()
}

/// The settings in lists that have each key once.
fn layers(undecided: &[String]) -> Vec<Vec<&str>> {
    let mut layers: Vec<Vec<&str>> = Vec::new();
    for setting in undecided {
        let own: Vec<&str> = keys(setting).collect();
        let is_free = |other: &&str| keys(other).all(|key| !own.contains(&key));
        let free = layers.iter_mut().find(|layer| layer.iter().all(is_free));
        match free {
            Some(layer) => layer.push(setting),
            None => layers.push(vec![setting]),
        }
    }
    layers
}

/// The keys of a setting, or of several on lines of their own.
fn keys(setting: &str) -> impl Iterator<Item = &str> {
    setting.lines().map(|line| line.split('=').next().unwrap_or_default().trim())
}

impl Search<'_> {
    /// Looks for those of some settings that change the program.
    fn look(&mut self, undecided: &[&str]) {
        if undecided.is_empty() || self.found.len() >= MOST_NAMED {
            return;
        }
        let other =
            self.machine(undecided).and_then(|machine| self.program.with_machine(machine).ok());
        let nc = other.clone().and_then(|other| self.post(other));
        match (undecided, other, nc) {
            (_, _, Some(nc)) if nc == self.nc => {}
            ([one], Some(other), Some(_)) => {
                let line = self.first_line(other);
                self.found.push((one.to_string(), line));
            }
            // Alone it contradicts the machine, or no such program can be made.
            ([_], _, _) => {}
            (many, _, _) => {
                let (first, second) = many.split_at(many.len() / 2);
                self.look(first);
                self.look(second);
            }
        }
    }

    /// The machine with other settings; `None` for one that it can't take.
    fn machine(&self, undecided: &[&str]) -> Option<Commons> {
        let mut commons = self.program.commons().clone();
        for setting in undecided {
            settings::apply_setting(&mut commons, setting).ok()?;
        }
        Some(commons)
    }

    fn post(&self, program: Program) -> Option<Vec<u8>> {
        let mut nc = Vec::new();
        (self.start)(program).run_unwatched(Cursor::new(self.cl), &mut nc).ok().map(|_| nc)
    }

    /// The CL line of the first block that differs.
    fn first_line(&self, other: Program) -> u32 {
        let cl = || Cursor::new(self.cl.to_vec());
        let mut others = (self.start)(other).blocks(cl());
        let mut line = 0;
        for block in (self.start)(self.program.clone()).blocks(cl()) {
            let Ok(block) = block else { return line };
            line = block.origin.line;
            match others.next() {
                Some(Ok(other)) if other.text == block.text => {}
                _ => return line,
            }
        }
        line
    }
}
