//! What must be switched on again: where a tool is changed, and at a stop, many machines stop the
//! spindle and the coolant, so what the CL file asks for behind it must stand behind it.

use super::modes::Expected;
use super::report::FindingKind;
use super::wanted::{CoolantKind, Wanted};
use crate::dialect::Auxiliary;
use crate::motion::{Modes, Spindle};

/// What records have asked for since the last tool change or stop.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Again {
    spindle: bool,
    coolant: bool,
}

impl Again {
    /// Takes up a step.
    pub(super) fn take(&mut self, wanted: &Wanted) {
        match wanted {
            Wanted::Spindle(turn) => self.spindle = *turn != Some(Spindle::Off),
            Wanted::SpindleAgain => self.spindle = true,
            Wanted::Coolant(kind) => self.coolant = *kind != CoolantKind::Off,
            // Words of the user's own may be a stop.
            Wanted::Tool { .. }
            | Wanted::Stop { .. }
            | Wanted::Insert { .. }
            | Wanted::Words(_)
            | Wanted::Repeated(_)
            | Wanted::Auxiliary(_)
            | Wanted::Unknown { .. } => *self = Again::default(),
            _ => {}
        }
    }

    /// Takes up an auxiliary function of the user's own.
    pub(super) fn insert(&mut self, auxiliary: Auxiliary) {
        match auxiliary {
            Auxiliary::Clockwise | Auxiliary::Counterclockwise => self.spindle = true,
            Auxiliary::Coolant(code) => self.coolant = code.is_some(),
            _ => {}
        }
    }

    /// What the program has not switched on again; what still waits for a motion need not be on.
    pub(super) fn wrong(
        &self,
        expected: &Expected,
        modes: &Modes,
        wrong: &mut Vec<(FindingKind, String)>,
    ) {
        let behind = "is not switched on again behind the tool change or stop";
        let turns = modes.spindle.turn != Spindle::Off && expected.spindle.next.is_none();
        if self.spindle && modes.unsaid.spindle && turns {
            wrong.push((FindingKind::Spindle, format!("the spindle {behind}")));
        }
        let flows = modes.coolant.is_some() && expected.coolant.next.is_none();
        if self.coolant && modes.unsaid.coolant && flows {
            wrong.push((FindingKind::Coolant, format!("the coolant {behind}")));
        }
    }
}
