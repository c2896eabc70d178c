//! Settings that a script, a debugger or PLABEL may not change while a program is written.

use fil_diag::Result;
use fil_machine::errors::MachineCode;
use fil_machine::locations as loc;
use fil_machine::{Kind, stored};

use super::Control;
use crate::control::needs::Act;

/// INTCOM: the machine that a program is for, from its first block to its last.
const MACHINE: [u16; 15] = [
    loc::CONTROL_FAMILY.number,
    loc::CONTROL_TRANSLATION.number,
    loc::CONTROL_SPINDLE_INDEX.0,
    loc::CONTROL_AXIS_INDEX.0,
    loc::CONTROL_ROTARY_INDEX.0,
    loc::LATHE_DIAMETER.number,
    loc::LATHE_DIAMETER_CODE.0,
    loc::MILL_TURN_MILLING_CODE.0,
    loc::ROTARY_PRIMARY_KIND.number,
    loc::ROTARY_PRIMARY_LETTER.0,
    loc::ROTARY_PRIMARY_AXIS.number,
    loc::ROTARY_SECONDARY_KIND.number,
    loc::ROTARY_SECONDARY_LETTER.0,
    loc::ROTARY_SECONDARY_AXIS.number,
    loc::TOOL_FORMAT.number,
];

/// DBLCOM: the directions of its axes and of its tool.
const DIRECTIONS: [u16; 9] = [
    loc::ROTARY_PRIMARY_I.0,
    loc::ROTARY_PRIMARY_J.0,
    loc::ROTARY_PRIMARY_K.0,
    loc::ROTARY_SECONDARY_I.0,
    loc::ROTARY_SECONDARY_J.0,
    loc::ROTARY_SECONDARY_K.0,
    loc::TOOL_AXIS_I.0,
    loc::TOOL_AXIS_J.0,
    loc::TOOL_AXIS_K.0,
];

/// DBLCOM: what a mirror and a stretched path come from.
const SCALES: [u16; 3] = [loc::SCALE_X.0, loc::SCALE_Y.0, loc::SCALE_Z.0];

impl Control {
    /// Refuses a value that can't be stored at this point of the program.
    ///
    /// # Errors
    /// As [`stored::check_in_run`]; another machine once the program has begun; another scale of a
    /// path that the control compensates.
    pub fn check_setting(&self, kind: Kind, location: u32, value: f64) -> Result<()> {
        stored::check_in_run(kind, location, value)?;
        let Ok(number) = u16::try_from(location) else { return Ok(()) };
        // A location that there is not is refused where it is stored.
        if self.commons.get(kind, location).is_ok_and(|held| held == value) {
            return Ok(());
        }
        let is_of_machine = match kind {
            Kind::Int => MACHINE.contains(&number),
            Kind::Dbl => DIRECTIONS.contains(&number),
            Kind::Rel => false,
        };
        if is_of_machine && self.tape.count > 0 {
            let message = format!(
                "{}: the program has begun, and is for one machine from its first block to its last",
                stored::title(kind, location)
            );
            let diag = MachineCode::SettingValue.diag(message);
            return Err(Box::new(diag.hint("set it in machine.toml or with --set")));
        }
        match kind == Kind::Dbl && SCALES.contains(&number) {
            true => self.require(Act::Scale),
            false => Ok(()),
        }
    }
}
