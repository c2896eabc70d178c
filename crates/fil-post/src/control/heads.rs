//! Where the heads of a machine hold the tool in a motion.

use fil_machine::axes::AxisSet;
use fil_machine::axis_chain::Carries;

use super::Control;
use crate::control_state::Place;
use crate::operation::motion::Motion;

/// Where the rotary axes stand before and behind a motion, degrees; `None` where a head may stand
/// anywhere. A table does not turn the tool.
pub fn angles(control: &Control, motion: &Motion) -> Option<[[f64; 2]; 2]> {
    let tables = &control.tables;
    let mut angles = [[0.0; 2]; 2];
    for number in AxisSet::ROTARY.and(tables.present()).numbers() {
        let axis = tables.chain().rotaries[number - 3].as_ref();
        let is_table = axis.is_none_or(|axis| axis.carries == Carries::Table);
        let at = control.stands(number).or_else(|| behind_a_zero(control, number));
        let at = at.or(is_table.then_some(0.0))?;
        angles[0][number - 3] = at;
        angles[1][number - 3] = if motion.axes.has(number) { motion.position[number] } else { at };
    }
    Some(angles)
}

/// Where an axis stands that counts from another zero since it was moved, by its number before:
/// a head leans on as it did.
pub fn behind_a_zero(control: &Control, number: usize) -> Option<f64> {
    match control.place(number) {
        Place::Shifted(at) => Some(at),
        _ => None,
    }
}
