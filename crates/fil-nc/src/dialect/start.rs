//! The modes a control is in when a program begins, as far as the machine states them.
//!
//! What a control wakes up in is a parameter of the control, and what it is in when a program
//! begins may be what the last one left. So a mode is certain only where the machine
//! states it (`feed.mode_in_force` and its like), or where it has no other.

use super::Settings;
use super::codes::{CycleKind, FeedMode, Function};
use super::g_codes::Functions;
use crate::motion::StartMode;

/// Which modes are certain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Certain([bool; StartMode::ALL.len()]);

impl Certain {
    /// Those of a machine when a program begins.
    pub(super) fn new(settings: &Settings<'_>, functions: &Functions) -> Self {
        let is_klartext = settings.code("control.family") == Some(1);
        Certain(StartMode::ALL.map(|mode| {
            if mode == StartMode::Diameter {
                return !says_diameters(settings);
            }
            let stated = key(mode).is_some_and(|key| settings.code(key).is_some());
            is_klartext || stated || !functions.has_several(mode)
        }))
    }

    /// Those behind a block of others that may change modes: the ones that the control has no other
    /// of, or that its programs never say.
    pub(super) fn behind_others(settings: &Settings<'_>, functions: &Functions) -> Self {
        let is_klartext = settings.code("control.family") == Some(1);
        let says = |mode: StartMode| {
            let said = key(mode).and_then(|key| key.strip_suffix("_in_force"));
            said.is_none_or(|key| settings.code(key).is_some())
        };
        let stays = |mode: StartMode| is_klartext || !functions.has_several(mode) || !says(mode);
        Certain(StartMode::ALL.map(stays))
    }

    /// A block says a mode.
    pub(crate) fn say(&mut self, mode: StartMode) {
        self.0[mode as usize] = true;
    }

    /// True for a mode that is certain.
    pub(crate) fn has(self, mode: StartMode) -> bool {
        self.0[mode as usize]
    }

    /// All of them are.
    pub(crate) fn all(self) -> bool {
        self.0 == [true; StartMode::ALL.len()]
    }
}

/// X is a diameter, and programs say so: by a function, or on a SINUMERIK by `DIAMON`.
fn says_diameters(settings: &Settings<'_>) -> bool {
    let is_sinumerik = settings.code("control.family") == Some(2);
    let has_code = settings.code("lathe.diameter_code").is_some();
    settings.flag("lathe.diameter") && (is_sinumerik || has_code)
}

/// The setting that states a mode; `None` where there is none.
fn key(mode: StartMode) -> Option<&'static str> {
    match mode {
        StartMode::Unit => Some("units.in_force"),
        StartMode::Positions => Some("mode.position_in_force"),
        StartMode::Feed => Some("feed.mode_in_force"),
        StartMode::Plane => Some("circle.plane_in_force"),
        StartMode::ReturnLevel | StartMode::Surface | StartMode::Diameter => None,
    }
}

/// The code of a mode in force when a program begins; where the machine does not state it,
/// the one that its programs say.
pub(super) fn in_force(settings: &Settings<'_>, key: &str) -> Option<i32> {
    settings.code(&format!("{key}_in_force")).or_else(|| settings.code(key))
}

/// Programs begin in mm.
pub(super) fn metric(settings: &Settings<'_>) -> bool {
    match settings.code("units.in_force") {
        Some(code) => settings.code("units.inch_code") != Some(code),
        None => settings.code("units.mode") != Some(1),
    }
}

/// Programs begin with axis words that are positions.
pub(super) fn absolute(settings: &Settings<'_>) -> bool {
    let stated = settings.code("mode.position_in_force");
    stated.is_none() || stated != settings.code("mode.incremental_code")
}

impl Functions {
    /// The control can be in more than one of a mode.
    fn has_several(&self, mode: StartMode) -> bool {
        let has = |function: Function| self.holds(function);
        match mode {
            StartMode::Unit => {
                [true, false].iter().all(|metric| has(Function::Units { metric: *metric }))
            }
            StartMode::Positions => has(Function::Positions { absolute: false }),
            StartMode::Feed => {
                let modes = [FeedMode::PerMinute, FeedMode::PerTurn, FeedMode::Inverse];
                modes.iter().filter(|mode| has(Function::Feed(**mode))).count() > 1
            }
            StartMode::Plane => (0..3).filter(|normal| has(Function::Plane(*normal))).count() > 1,
            StartMode::ReturnLevel => {
                let returns = [true, false].map(|initial| has(Function::Return { initial }));
                let drills =
                    [true, false].map(|dwells| has(Function::Cycle(CycleKind::Drill, dwells)));
                returns == [true; 2] && drills.contains(&true)
            }
            StartMode::Surface => has(Function::Surface(true)),
            StartMode::Diameter => false,
        }
    }
}
