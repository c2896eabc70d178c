//! The unit of a run: what the CL file says, else what the user or the machine does.

use fil_diag::Result;
use fil_machine::{Commons, Unit};
use fil_post::errors::PostCode;

/// Who has said the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum UnitSource {
    /// A UNITS statement.
    Statement,
    /// Whoever started the run: [`Run::units`](crate::Run::units).
    Given,
    /// The machine, which takes one unit only (`units.mode`).
    Machine,
}

impl std::fmt::Display for UnitSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            UnitSource::Statement => "UNITS",
            UnitSource::Given => "--units",
            UnitSource::Machine => "units.mode",
        })
    }
}

/// The unit of a name: `mm` or `inch`.
pub fn unit_named(name: &str) -> Option<Unit> {
    match name {
        "mm" => Some(Unit::Mm),
        "inch" => Some(Unit::Inch),
        _ => None,
    }
}

/// The unit that is known before the CL file is read.
///
/// # Errors
/// E0715 for a unit that the machine does not take.
pub(crate) fn known_before(
    given: Option<Unit>,
    commons: &Commons,
) -> Result<Option<(Unit, UnitSource)>> {
    match (given, Unit::of_machine(commons)) {
        (Some(given), Some(machine)) if given != machine => PostCode::Units
            .err(format!("{given} is given, and the machine takes {machine} only (units.mode)")),
        (_, Some(machine)) => Ok(Some((machine, UnitSource::Machine))),
        (Some(given), None) => Ok(Some((given, UnitSource::Given))),
        (None, None) => Ok(None),
    }
}
