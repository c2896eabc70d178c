//! Coolant.

use fil_diag::Result;
use fil_machine::locations as loc;

use crate::control::{Control, Function};
use crate::operation::Coolant;

/// Writes the coolant code, in a block of its own or with a motion; OFF at once.
///
/// # Errors
/// As [`Control::write_block`].
pub fn write(control: &mut Control, coolant: Coolant) -> Result<()> {
    let at = match coolant {
        Coolant::On => loc::COOLANT_DEFAULT_CODE,
        Coolant::Off => loc::COOLANT_OFF_CODE,
        Coolant::Mist => loc::COOLANT_MIST_CODE,
        Coolant::Flood => loc::COOLANT_FLOOD_CODE,
        Coolant::FloodHigh => loc::COOLANT_FLOOD_HIGH_CODE,
        Coolant::FloodLow => loc::COOLANT_FLOOD_LOW_CODE,
        Coolant::Through => loc::COOLANT_THRU_HIGH_CODE,
        Coolant::ThroughLow => loc::COOLANT_THRU_LOW_CODE,
    };
    match control.code_if_any(at) {
        Some(code) => control.m(code),
        None => control.warn_no_code("this coolant"),
    }
    if coolant == Coolant::Off {
        let words = control.block.take();
        control.flush_waiting()?;
        control.block = words;
        return control.write_block();
    }
    let placement = control.commons.read(loc::COOLANT_PLACEMENT);
    control.place_block(Function::Coolant, placement)
}
