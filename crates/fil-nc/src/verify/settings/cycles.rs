//! Cycles of holes and dwells, as `verify` expects them.

use fil_machine::cycle_kind::CycleKind;
use fil_machine::locations::{self as loc, ControlFamily, CycleBoreOut, MillTurnSidePeck};

use super::Settings;
use crate::motion::unit;

impl Settings<'_> {
    /// R level above a hole's start when the record gives none, mm.
    pub fn cycle_clearance(&self, metric: bool) -> f64 {
        let unit = unit(metric);
        self.commons.dbl_opt(loc::CYCLE_AUTO_CLEARANCE).unwrap_or(0.0) * unit
    }

    /// Dwell of a cycle when the record gives none, seconds.
    pub fn cycle_dwell(&self, kind: CycleKind) -> f64 {
        kind.dwell().and_then(|at| self.commons.dbl_opt(at)).unwrap_or(0.0)
    }

    /// A cycle is followed by a way back to the level before it.
    pub fn retracts_after_cycles(&self) -> bool {
        self.commons.read(loc::CYCLE_RETRACT_BLOCK)
    }

    /// Pecks of a cycle count from the surface of the hole and not from the R level.
    pub fn pecks_from_surface(&self) -> bool {
        self.commons.read(loc::CONTROL_FAMILY) != ControlFamily::WordAddress
    }

    /// A peck of a live tool's cycle square to Z counts as a diameter.
    pub fn side_pecks_are_diameters(&self) -> bool {
        self.commons.read(loc::MILL_TURN_SIDE_PECK) == MillTurnSidePeck::Diameter
    }

    /// The control's own cycle lifts at feed to break chips.
    pub fn lifts_at_feed(&self) -> bool {
        self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik
    }

    /// The cycle that breaks chips says after how many pecks the tool leaves the hole.
    pub fn cycles_count_breaks(&self) -> bool {
        self.is_klartext()
    }

    /// How far above the last peck a cycle of the control goes on, mm, where a word of the
    /// cycle says it: `out` where it has left the hole; `clear` is its set-up clearance.
    pub fn cycle_peck_gap(&self, kind: CycleKind, out: bool, clear: f64) -> Option<f64> {
        let gap = Some(self.peck_gap());
        match self.commons.read(loc::CONTROL_FAMILY) {
            ControlFamily::WordAddress => None,
            // Cycle 203 goes on at its set-up clearance above the last peck.
            ControlFamily::Klartext if out && self.cycle_code(kind) == Some(203) => {
                Some(clear).filter(|clear| *clear > 0.0)
            }
            ControlFamily::Klartext => gap,
            ControlFamily::Sinumerik => gap.filter(|gap| *gap > 0.0),
        }
    }

    /// G code of a cycle; `None` when holes are single moves.
    pub fn cycle_code(&self, kind: CycleKind) -> Option<i32> {
        self.commons.read(kind.code())
    }

    /// How the tool leaves a bored hole of single moves.
    pub fn bore_out(&self) -> CycleBoreOut {
        self.commons.read(loc::CYCLE_BORE_OUT)
    }

    /// A dwell within the machine's range, turns of the spindle.
    pub fn turns_within(&self, turns: f64) -> f64 {
        let low = self.commons.dbl_opt(loc::DWELL_UPR_MIN).unwrap_or(0.0);
        let high = self.commons.dbl_opt(loc::DWELL_UPR_MAX).filter(|max| *max > 0.0);
        turns.max(low).min(high.unwrap_or(f64::MAX))
    }

    /// A dwell within the machine's range, seconds.
    pub fn dwell_within(&self, seconds: f64) -> f64 {
        let low = self.commons.dbl_opt(loc::DWELL_SECONDS_MIN).unwrap_or(0.0);
        let high = self.commons.dbl_opt(loc::DWELL_SECONDS_MAX).filter(|max| *max > 0.0);
        seconds.max(low).min(high.unwrap_or(f64::MAX))
    }
}
