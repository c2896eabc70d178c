//! The unit of a run: what the CL file says, else what the user or the machine does.

use fil_cl::{WordId, words};
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
    /// The CL file with the unit of its feeds, where its system writes MMPM for mm only.
    Feeds,
}

impl std::fmt::Display for UnitSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            UnitSource::Statement => "UNITS",
            UnitSource::Given => "--units",
            UnitSource::Machine => "units.mode",
            UnitSource::Feeds => "as its feeds say",
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

/// The unit that a word of CL files names.
pub(crate) fn of_word(word: WordId) -> Unit {
    if word == words::INCHES { Unit::Inch } else { Unit::Mm }
}

/// The unit that is known before the CL file is read; `told`: by the unit of its feeds.
///
/// # Errors
/// E0715 for a unit that the machine does not take.
pub(crate) fn known_before(
    given: Option<Unit>,
    told: Option<Unit>,
    commons: &Commons,
) -> Result<Option<(Unit, UnitSource)>> {
    match (given, told, Unit::of_machine(commons)) {
        (Some(given), _, Some(machine)) if given != machine => PostCode::Units
            .err(format!("{given} is given, and the machine takes {machine} only (units.mode)")),
        (None, Some(told), Some(machine)) if told != machine => PostCode::Units.err(format!(
            "the feeds of the file are those of {told}, and the machine takes {machine} only \
             (units.mode)"
        )),
        (_, _, Some(machine)) => Ok(Some((machine, UnitSource::Machine))),
        (Some(given), _, None) => Ok(Some((given, UnitSource::Given))),
        (None, Some(told), None) => Ok(Some((told, UnitSource::Feeds))),
        (None, None, None) => Ok(None),
    }
}
