//! What must be switched on again. Where a tool is changed, and at a stop, many machines stop the
//! spindle and the coolant: what the CL file asks for after it must stand after it. And what blocks
//! of the settings switch off may stay off until the tool cuts; then a record after the change has
//! asked for it again, or it is missing.

use super::expected_step::{CoolantKind, ExpectedStep};
use crate::dialect::Auxiliary;
use crate::motion::Spindle;

/// One of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Restart<T> {
    /// A record has asked for it since the last tool change or stop.
    pub(super) is_asked: bool,
    /// What records have switched on and blocks of the settings off.
    pub(super) was_on: Option<T>,
}

impl<T> Default for Restart<T> {
    fn default() -> Self {
        Restart { is_asked: false, was_on: None }
    }
}

/// Spindle and coolant.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Restarts {
    pub(super) spindle: Restart<Spindle>,
    pub(super) coolant: Restart<u32>,
}

impl Restarts {
    /// Takes up a step.
    pub(super) fn take(&mut self, wanted: &ExpectedStep) {
        match wanted {
            ExpectedStep::Spindle(turn) => self.spindle = by_record(*turn != Some(Spindle::Off)),
            ExpectedStep::SpindleAgain => self.spindle = by_record(true),
            ExpectedStep::Orient(_) => self.spindle.was_on = None,
            ExpectedStep::Coolant(kind) => self.coolant = by_record(*kind != CoolantKind::Off),
            // Words of the user's own may be a stop.
            ExpectedStep::Tool { .. }
            | ExpectedStep::Stop { .. }
            | ExpectedStep::Words(_)
            | ExpectedStep::Repeated(_)
            | ExpectedStep::Auxiliary(_)
            | ExpectedStep::Unknown { .. } => self.stop(),
            _ => {}
        }
    }

    /// A tool change or a stop: nothing is asked for since.
    pub(super) fn stop(&mut self) {
        self.spindle.is_asked = false;
        self.coolant.is_asked = false;
    }

    /// Takes up an auxiliary function of the user's own.
    pub(super) fn insert(&mut self, auxiliary: Auxiliary) {
        match auxiliary {
            Auxiliary::Clockwise | Auxiliary::Counterclockwise => self.spindle = by_record(true),
            Auxiliary::SpindleOff | Auxiliary::Live(_) | Auxiliary::Orient => {
                self.spindle.was_on = None;
            }
            Auxiliary::Coolant { .. } => self.coolant = by_record(true),
            Auxiliary::CoolantOff(_) => self.coolant = by_record(false),
            Auxiliary::CAxis(..)
            | Auxiliary::Counts(_)
            | Auxiliary::Side(_)
            | Auxiliary::SpindleRange(_) => {}
            // A tool change, a stop, or what may be one.
            _ => self.stop(),
        }
    }
}

/// What a record asks for anew is not that of before.
fn by_record<T>(is_asked: bool) -> Restart<T> {
    Restart { is_asked, was_on: None }
}
