//! The back-check of programs that a test holds in memory.

use fil_cl::{Options, Reader};
use fil_nc::dialect::Dialect;
use fil_nc::interpret;
use fil_nc::motion::Event;
use fil_nc::verify::{Allowed, Check, Report, verify};
use filpost::{Commons, Diag, Unit};

/// What a program does on a machine.
///
/// # Errors
/// A program that can't be followed.
pub fn events(commons: &Commons, nc: &str) -> Result<Vec<Event>, Box<Diag>> {
    interpret::events(nc.as_bytes(), "out.nc", &Dialect::new(commons)?)
}

/// Compares a program that does this with a CL file; one without UNITS is in the unit
/// of the machine.
///
/// # Errors
/// As [`verify`].
pub fn compare(
    commons: &Commons,
    cl: &[u8],
    (nc, events): (&[u8], &[Event]),
    allowed: Allowed,
) -> Result<Report, Box<Diag>> {
    let cl_name = "part.ncl";
    let cl = Reader::new(cl, cl_name, Options::default());
    let unit = Unit::of_machine(commons);
    verify(Check { cl, cl_name, unit, nc, events, commons, allowed })
}

/// Follows a program and compares it with a CL file.
///
/// # Errors
/// As [`events`] and [`compare`].
pub fn check(commons: &Commons, cl: &str, nc: &str, allowed: Allowed) -> Result<Report, Box<Diag>> {
    compare(commons, cl.as_bytes(), (nc.as_bytes(), &events(commons, nc)?), allowed)
}
