//! What parameters of a lathe's control make of its cycles, as the settings tell them.

use super::Settings;
use super::codes::CycleKind;

/// What the drilling cycles of live tools do with the depth of a peck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LivePecks {
    /// Out of the hole after each, or a little up; `None` where nobody says.
    pub(crate) kind: Option<CycleKind>,
    /// Along X it counts as a diameter, or a radius; `None` where nobody says.
    pub(crate) side_is_diameter: Option<bool>,
}

impl LivePecks {
    pub(super) fn new(settings: &Settings) -> Self {
        LivePecks {
            kind: match settings.code("mill_turn.peck_form") {
                Some(1) => Some(CycleKind::Peck),
                Some(2) => Some(CycleKind::BreakChips),
                _ => None,
            },
            side_is_diameter: match settings.code("mill_turn.side_peck") {
                Some(1) => Some(false),
                Some(2) => Some(true),
                _ => None,
            },
        }
    }
}

/// How threading cycles leave a thread before its end, by M codes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WayOut {
    /// The codes that switch it on and off.
    pub(crate) codes: [u32; 2],
    /// Its length in leads, which a parameter of the control says.
    pub(crate) leads: Option<f64>,
}

impl WayOut {
    pub(super) fn new(settings: &Settings) -> Option<Self> {
        let code = |key| settings.code(key).and_then(|code| u32::try_from(code).ok());
        let codes = [code("thread.chamfer_on_code")?, code("thread.chamfer_off_code")?];
        let leads = settings.number("thread.chamfer_tenths").map(|tenths| tenths / 10.0);
        Some(WayOut { codes, leads })
    }
}
