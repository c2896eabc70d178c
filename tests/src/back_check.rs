//! The back-check of programs that a test holds in memory.

use std::collections::VecDeque;

use fil_cl::{Options, Reader};
use fil_nc::dialect::Dialect;
use fil_nc::events::Events;
use fil_nc::interpret::{self, PassedOver, Running};
use fil_nc::motion::Event;
use fil_nc::source::Source;
use fil_nc::verify::{Allowed, Check, Report, verify};
use filpost::{Commons, Diag, Program, Unit};

/// What a program does on a machine, with its refused lines passed over.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Its events.
    pub events: Vec<Event>,
    /// Why lines were refused.
    pub refused: Vec<Diag>,
}

/// What a program does on a machine, and what it does with the blocks left out that may be
/// skipped, where it has some.
#[derive(Clone, Debug)]
pub struct Both {
    /// All blocks are run.
    pub all: Followed,
    /// Blocks that may be skipped are left out.
    pub left_out: Option<Followed>,
}

/// What a program does on a machine.
///
/// # Errors
/// A program that can't be followed.
pub fn events(commons: &Commons, nc: &str) -> Result<Vec<Event>, Box<Diag>> {
    interpret::events(nc.as_bytes(), "out.nc", &Dialect::new(commons)?)
}

/// What a program does, whichever way the switch is.
///
/// # Errors
/// A program that can't be followed, one way or the other.
pub fn both(commons: &Commons, nc: &str) -> Result<Both, Box<Diag>> {
    let dialect = Dialect::new(commons)?;
    let nc = &Source::memory(nc.as_bytes());
    let all = follow(nc, &dialect)?;
    let skips = interpret::has_skipped_blocks(nc, "out.nc", &dialect)?;
    let left_out = skips.then(|| follow(nc, &dialect.skipping_blocks())).transpose()?;
    Ok(Both { all, left_out })
}

fn follow(nc: &Source<'_>, dialect: &Dialect) -> Result<Followed, Box<Diag>> {
    let passed = PassedOver::default();
    let mut running = Running::new(nc, "out.nc", dialect).passing_over(&passed);
    let mut events = VecDeque::new();
    loop {
        match running.more(&mut events) {
            Ok(true) => {}
            Ok(false) => return Ok(Followed { events: events.into(), refused: passed.take() }),
            Err(last) => return Err(passed.take().into_iter().next().map_or(last, Box::new)),
        }
    }
}

/// Compares a program that does this with a CL file; one without UNITS is in the unit
/// of the machine.
///
/// # Errors
/// As [`verify`].
pub fn compare(
    commons: &Commons,
    cl: &[u8],
    (nc, both): (&[u8], &Both),
    allowed: Allowed,
) -> Result<Report, Box<Diag>> {
    let nc = &Source::memory(nc);
    let one_way = |followed: &Followed, skips_blocks: bool| {
        let cl_name = "part.ncl";
        let cl = Reader::new(cl, cl_name, Options::default());
        let unit = Unit::of_machine(commons);
        let allowed = allowed.clone();
        verify(Check {
            cl,
            cl_name,
            unit,
            nc,
            nc_name: "out.nc",
            events: &mut &followed.events[..],
            passed: &PassedOver::from(followed.refused.clone()),
            commons,
            allowed,
            skips_blocks,
        })
    };
    let report = one_way(&both.all, false)?;
    match &both.left_out {
        Some(left_out) => Ok(report.with_blocks_left_out(one_way(left_out, true)?)),
        None => Ok(report),
    }
}

/// Follows a program and compares it with a CL file.
///
/// # Errors
/// As [`both`] and [`compare`].
pub fn check(commons: &Commons, cl: &str, nc: &str, allowed: Allowed) -> Result<Report, Box<Diag>> {
    compare(commons, cl.as_bytes(), (nc.as_bytes(), &both(commons, nc)?), allowed)
}

/// What is found in a program of a ready post with settings, one line each, or why it can't be
/// followed. The lines of both files are divided by `; `.
///
/// # Panics
/// Settings that are no machine.
pub fn found(ready: &str, settings: &[&str], cl: &str, nc: &str) -> String {
    let start = Program::builder().generic(ready);
    let post = settings.iter().fold(start, |builder, setting| builder.set(setting));
    let post = post.build().expect("a machine");
    let cl = format!("UNITS / MM\n{}\nFINI\n", cl.replace("; ", "\n"));
    match check(post.commons(), &cl, &nc.replace("; ", "\n"), Allowed::default()) {
        Ok(report) => listed(&report),
        Err(refused) => refused.to_string(),
    }
}

/// The findings of a report, one line each.
pub fn listed(report: &Report) -> String {
    report.findings.iter().map(|finding| format!("\n  {finding}")).collect()
}

/// Asks that nothing is found in a program, and something that says this with each of the changes.
///
/// # Panics
/// It is not so.
pub fn each_is_found(check: &dyn Fn(&str) -> String, nc: &str, changes: &[(&str, &str, &str)]) {
    assert_eq!(check(nc), "");
    for (old, new, said) in changes {
        assert!(nc.contains(old), "no {old} in {nc}");
        let wrong = check(&nc.replacen(old, new, 1));
        assert!(wrong.contains(said), "{old} to {new}: {wrong}");
    }
}
