//! What parameters of a lathe's control make of its cycles, as the settings tell them.

use super::Settings;
use super::codes::CycleKind;

/// Spindles and cycles of a lathe.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning {
    /// The main spindle can become the axis C: whether it is one when the program begins.
    pub(crate) live_at_start: Option<bool>,
    /// The codes that make the main spindle an axis and a spindle again.
    pub(crate) mode_codes: [Option<i32>; 2],
    /// One code turns the main spindle and the live tool, whichever is in use: by clockwise,
    /// counterclockwise and stop. Not where P selects the spindle.
    pub(crate) one_code: [bool; 3],
    /// P of the blocks that turn or stop the main spindle and the live tool, where P selects the
    /// spindle.
    pub(crate) selects: Option<[Option<i32>; 2]>,
    /// What the cycles of live tools do with pecks.
    pub(crate) live_pecks: LivePecks,
    /// M codes by which threading cycles leave a thread; `None` for a machine without.
    pub(crate) way_out: Option<WayOut>,
    /// How the control is told which spindle of a lathe it counts.
    pub(crate) counted: Counted,
}

impl Turning {
    pub(super) fn new(settings: &Settings) -> Self {
        let main = settings.code("spindle.select_number");
        Turning {
            live_at_start: settings
                .code("mill_turn.milling_code")
                .map(|_| settings.code("mill_turn.mode").is_some_and(|mode| mode != 0)),
            mode_codes: ["milling", "turning"]
                .map(|mode| settings.code(&format!("mill_turn.{mode}_code"))),
            one_code: ["cw", "ccw", "stop"].map(|turn| {
                let code = |of: &str| settings.code(&format!("{of}{turn}_code"));
                code("mill_turn.live_") == code("spindle.") && main.is_none()
            }),
            selects: main.map(|main| [Some(main), settings.code("mill_turn.live_select_number")]),
            live_pecks: LivePecks::new(settings),
            way_out: WayOut::new(settings),
            counted: Counted::new(settings),
        }
    }
}

/// What the drilling cycles of live tools do with the depth of a peck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LivePecks {
    /// Out of the hole after each, or a little up; `None` where nobody says.
    pub(crate) kind: Option<CycleKind>,
    /// Along X it counts as a diameter, or a radius; `None` where nobody says.
    pub(crate) side_is_diameter: Option<bool>,
}

impl LivePecks {
    fn new(settings: &Settings) -> Self {
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
    fn new(settings: &Settings) -> Option<Self> {
        let code = |key| settings.code(key).and_then(|code| u32::try_from(code).ok());
        let codes = [code("thread.chamfer_on_code")?, code("thread.chamfer_off_code")?];
        let leads = settings.number("thread.chamfer_tenths").map(|tenths| tenths / 10.0);
        Some(WayOut { codes, leads })
    }
}

/// How the control is told which spindle of a lathe it counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Counted {
    /// The number of the second spindle, which SETMS names.
    pub(crate) number: Option<i32>,
    /// M codes choose it.
    by_code: bool,
    /// The second spindle has codes of its own, and those of the main one never turn it.
    pub(crate) has_own_codes: bool,
    /// A highest speed is that of the spindle that is counted.
    pub(crate) has_own_limits: bool,
}

impl Counted {
    fn new(settings: &Settings) -> Self {
        let number = settings.code("spindle.side_number");
        Counted {
            number,
            by_code: settings.code("spindle.side_master_code").is_some(),
            has_own_codes: settings.code("spindle.side_cw_code").is_some(),
            has_own_limits: number.is_some(),
        }
    }

    /// The machine says which spindle its control counts.
    pub(crate) fn is_chosen(&self) -> bool {
        self.number.is_some() || self.by_code
    }
}
