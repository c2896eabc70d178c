//! Travel of rotary axes in forms that nothing checks.

use fil_diag::Diag;

use super::contradiction;
use crate::axis_chain::AxisChain;
use crate::commons::Commons;
use crate::locations::{self as loc, Location};

/// Settings of a rotary axis by the end of their names, and what they ask for.
const FORMS: [(&str, &str); 2] =
    [("kind", "rotary ranges in place of one straight one"), ("zones", "travel zones")];

/// Refuses a machine that checks travel and gives that of a rotary axis in ranges or zones:
/// positions outside of them would pass.
pub(super) fn forms(commons: &Commons, found: &mut Vec<Diag>) {
    let Ok(chain) = AxisChain::from_commons(commons) else { return };
    if !commons.read(loc::LIMITS_CHECK) {
        return;
    }
    for rotary in chain.rotaries.iter().flatten() {
        for (form, what) in FORMS {
            let name = format!("limits.{}_{form}", ['a', 'b', 'c'][rotary.axis]);
            let row = Location::named(&name);
            let value = row.and_then(|row| commons.get(row.kind, u32::from(row.number)).ok());
            if value == Some(1.0) {
                found.push(contradiction(format!(
                    "limits.check asks for the travel of {}, and {name} gives it as {what}, which \
                     the post does not check: give limits.{1}_min and limits.{1}_max",
                    rotary.letter,
                    ['a', 'b', 'c'][rotary.axis]
                )));
            }
        }
    }
}
