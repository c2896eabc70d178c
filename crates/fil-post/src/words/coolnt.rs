//! COOLNT/ON|FLOOD|MIST|THRU|TAP|AIR|OFF\[,LOW|MEDIUM|HIGH].

use fil_cl::WordId;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;

use crate::items::Items;
use crate::operation::{Coolant, CoolantKind, Operation, Pressure};
use crate::path::carry_out;
use crate::post::Post;

/// The minor word of each kind.
const KINDS: [(WordId, CoolantKind); 6] = [
    (w::ON, CoolantKind::Default),
    (w::FLOOD, CoolantKind::Flood),
    (w::MIST, CoolantKind::Mist),
    (w::THRU, CoolantKind::Through),
    (w::TAP, CoolantKind::Tap),
    (w::AIR, CoolantKind::Air),
];

/// The minor word of each pressure.
const PRESSURES: [(WordId, Pressure); 3] =
    [(w::LOW, Pressure::Low), (w::MEDIUM, Pressure::Medium), (w::HIGH, Pressure::High)];

/// Switches the coolant.
///
/// # Errors
/// A kind of coolant that is not known.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let pressure = PRESSURES.iter().find(|(word, _)| items.flag(*word)).map(|(_, found)| *found);
    let off = items.flag(w::OFF);
    let kind = KINDS.iter().find(|(word, _)| !off && items.flag(*word)).map(|(_, kind)| *kind);
    post.due_to(items);
    let coolant = match (kind, pressure) {
        (None, None) if off => Coolant::Off,
        (Some(kind), None) => Coolant::On(kind, Pressure::Usual),
        (Some(kind), Some(pressure)) => Coolant::On(kind, pressure),
        _ => {
            let forms =
                "ON, OFF, MIST, FLOOD, THRU, TAP or AIR, with LOW, MEDIUM or HIGH, is needed";
            return Err(items.error(forms));
        }
    };
    items.deny_rest()?;
    carry_out(post, Operation::Coolant(coolant))
}
