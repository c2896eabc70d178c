//! The value that a setting has while the machine acts. Settings of a rotary axis that nobody gave
//! follow from others: with `chain = "table-a"` the axis is A about X, whatever `rotary.primary_i`
//! holds.

use fil_diag::Result;

use crate::axis_chain::{AxisChain, Rotary};
use crate::commons::{Commons, EMPTY, Kind};
use crate::locations::Location;

/// The value in force of the setting with this name, in any case of letters; `None` where no
/// setting has that name. [`EMPTY`] is a setting that is absent and follows from no other.
///
/// # Errors
/// A rotary axis whose direction has length zero.
pub fn in_force(commons: &Commons, name: &str) -> Option<Result<f64>> {
    let row = Location::named(&name.to_ascii_lowercase())?;
    Some(value(commons, row))
}

/// The value in force of a location: [`Commons::get`], but for a setting that was not given and
/// follows from others.
///
/// # Errors
/// A location out of range; a rotary axis whose direction has length zero.
pub fn in_force_at(commons: &Commons, kind: Kind, location: u32) -> Result<f64> {
    let stored = commons.get(kind, location)?;
    match Location::numbered(kind, location).filter(|_| stored == EMPTY) {
        Some(row) => value(commons, row),
        None => Ok(stored),
    }
}

fn value(commons: &Commons, row: &Location) -> Result<f64> {
    let stored = commons.get(row.kind, row.number.into())?;
    let rotary = ["rotary.primary_", "rotary.secondary_"];
    let of_rotary = rotary.iter().position(|prefix| row.name.starts_with(prefix));
    let Some(which) = of_rotary.filter(|_| stored == EMPTY) else {
        return Ok(stored);
    };
    let chain = AxisChain::from_commons(commons)?;
    let part = &row.name[rotary[which].len()..];
    Ok(chain.rotaries[which].as_ref().and_then(|axis| follows(axis, part)).unwrap_or(stored))
}

/// What a setting of a rotary axis is where it was not given.
fn follows(axis: &Rotary, part: &str) -> Option<f64> {
    match part {
        "i" => Some(axis.direction.x),
        "j" => Some(axis.direction.y),
        "k" => Some(axis.direction.z),
        "letter" => Some(axis.letter.number().into()),
        "axis" => Some(axis.axis as f64 + 1.0),
        "min" => axis.min,
        "max" => axis.max,
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::lay_over;
    use crate::locations::default_commons;

    fn get(settings: &str, name: &str) -> f64 {
        let mut commons = default_commons();
        lay_over(&mut commons, "machine.toml", settings).expect("a machine");
        in_force(&commons, name).expect("a setting").expect("a value")
    }

    #[test]
    fn an_axis_of_a_chain_has_its_letter_and_direction() {
        let chain = "chain = \"tables-ca\"\n";
        for (name, value) in [
            ("rotary.primary_k", 1.0),
            ("rotary.primary_i", 0.0),
            ("rotary.primary_letter", 3.0),
            ("ROTARY.SECONDARY_I", 1.0),
            ("rotary.secondary_letter", 1.0),
            ("rotary.secondary_axis", 1.0),
            ("rotary.secondary_min", -120.0),
            ("rotary.primary_min", EMPTY),
        ] {
            assert_eq!(get(chain, name), value, "{name}");
        }
    }

    #[test]
    fn a_location_has_what_its_name_has() {
        let mut commons = default_commons();
        lay_over(&mut commons, "machine.toml", "chain = \"table-a\"\n").expect("a machine");
        let row = Location::named("rotary.primary_i").expect("a setting");
        let at = |commons: &Commons| in_force_at(commons, row.kind, row.number.into());
        assert_eq!(at(&commons).expect("a value"), 1.0);
        commons.set(row.kind, row.number.into(), 0.5).expect("a value");
        assert_eq!(at(&commons).expect("a value"), 0.5);
        assert!(in_force_at(&commons, Kind::Dbl, 99_999).is_err());
    }

    #[test]
    fn what_was_given_is_in_force() {
        let given = "[rotary]\nprimary_kind = 1\nprimary_letter = \"C\"\nprimary_j = 2.0\n";
        assert_eq!(get(given, "rotary.primary_letter"), 3.0);
        assert_eq!(get(given, "rotary.primary_j"), 2.0);
        assert_eq!(get(given, "rotary.primary_i"), 0.0);
        assert_eq!(get(given, "rotary.primary_axis"), 1.0);
    }

    #[test]
    fn limits_of_the_letter_are_in_force_where_they_are_checked() {
        let machine = |check: bool| {
            format!("chain = \"table-a\"\n[limits]\ncheck = {check}\na_min = -90.0\na_max = 90.0\n")
        };
        assert_eq!(get(&machine(true), "rotary.primary_max"), 90.0);
        assert_eq!(get(&machine(false), "rotary.primary_max"), EMPTY);
    }

    #[test]
    fn an_axis_that_is_not_there_has_no_direction() {
        assert_eq!(get("", "rotary.primary_i"), EMPTY);
        assert!(in_force(&Commons::absent(), "nothing").is_none());
    }
}
