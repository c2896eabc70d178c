//! Travel that nothing checks; travel of rotary axes in ranges and zones.

use fil_diag::Diag;

use super::contradiction;
use crate::axis_chain::AxisChain;
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::locations::{self as loc, TravelKind};
use crate::mill_turn;
use crate::zones::Zones;

/// The warning of travel of X, Y or Z that is given and that nothing checks.
pub fn unchecked(commons: &Commons) -> Option<Diag> {
    let is_given = |at| commons.dbl_opt(at).is_some();
    let axis =
        loc::LINEAR_LIMITS.iter().position(|(low, high)| is_given(*low) || is_given(*high))?;
    let name = ["X", "Y", "Z"][axis];
    let message = format!("the travel of {name} is given, and limits.check = 0 checks none");
    let diag = Diag::new(MachineCode::UnusedSetting, message).hint("Set limits.check = 1.");
    (!commons.read(loc::LIMITS_CHECK)).then_some(diag)
}

/// Refuses ranges or zones of a rotary axis whose ends are not given or the wrong way round, and
/// those of a mill-turn machine, on which nothing checks them.
pub(super) fn forms(commons: &Commons, found: &mut Vec<Diag>) {
    let Ok(chain) = AxisChain::from_commons(commons) else { return };
    if !commons.read(loc::LIMITS_CHECK) {
        return;
    }
    for rotary in chain.rotaries.iter().flatten() {
        let (axis, letter) = (rotary.axis, ['a', 'b', 'c'][rotary.axis]);
        let in_ranges = commons.read(loc::TRAVEL_KINDS[axis]) == TravelKind::RotaryRanges;
        let in_zones = commons.read(loc::IN_ZONES[axis]);
        let Zones { ranges, zone } = rotary.zones;
        let ends = [
            (in_ranges, ranges.iter().any(Option::is_some), "kind", "range1"),
            (in_zones, zone.is_some(), "zones", "zone"),
        ];
        for (asked, given, name, end) in ends {
            if asked && !given {
                found.push(contradiction(format!(
                    "limits.{letter}_{name} = 1 asks for limits.{letter}_{end}_min and \
                     limits.{letter}_{end}_max, and they are not given"
                )));
            }
            if asked && mill_turn::mode(commons).is_some() {
                found.push(contradiction(format!(
                    "limits.{letter}_{name} = 1 gives the travel in ranges or zones, which on a \
                     mill-turn machine nothing checks: give limits.{letter}_min and \
                     limits.{letter}_max"
                )));
            }
        }
        for [low, high] in ranges.into_iter().chain([zone]).flatten() {
            if low >= high {
                found.push(contradiction(format!(
                    "a range or zone of {} ends at {high} and begins at {low}",
                    rotary.letter
                )));
            }
        }
    }
}
