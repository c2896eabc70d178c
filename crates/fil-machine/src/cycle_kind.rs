//! The kinds of CYCLE, and the settings of each: post and back-check ask for the same.

use crate::commons::Dbl;
use crate::locations as loc;
use crate::setting::CodeAt;

/// A kind of CYCLE.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleKind {
    /// Down at feed, up at rapid.
    Drill,
    /// Countersink.
    Csink,
    /// In pecks, out of the hole after each.
    Deep,
    /// In pecks, lifted a little after each.
    Brkchp,
    /// Tap.
    Tap,
    /// Bore: up at feed.
    Bore,
    /// Ream: up at feed.
    Ream,
    /// Face.
    Face,
    /// Through.
    Thru,
    /// What the control's own cycle does.
    Mill,
}

impl CycleKind {
    /// Location of its code.
    pub fn code(self) -> CodeAt {
        self.locations().map_or(loc::CYCLE_MILL_CODE, |(code, _)| code)
    }

    /// Location of its usual dwell; MILL has none.
    pub fn dwell(self) -> Option<Dbl> {
        self.locations().map(|(_, dwell)| dwell)
    }

    fn locations(self) -> Option<(CodeAt, Dbl)> {
        Some(match self {
            CycleKind::Drill => (loc::CYCLE_DRILL_CODE, loc::DWELL_CYCLE_DRILL),
            CycleKind::Csink => (loc::CYCLE_CSINK_CODE, loc::DWELL_CYCLE_CSINK),
            CycleKind::Deep => (loc::CYCLE_DEEP_CODE, loc::DWELL_CYCLE_DEEP),
            CycleKind::Brkchp => (loc::CYCLE_BRKCHP_CODE, loc::DWELL_CYCLE_BRKCHP),
            CycleKind::Tap => (loc::CYCLE_TAP_CODE, loc::DWELL_CYCLE_TAP),
            CycleKind::Bore => (loc::CYCLE_BORE_CODE, loc::DWELL_CYCLE_BORE),
            CycleKind::Ream => (loc::CYCLE_REAM_CODE, loc::DWELL_CYCLE_REAM),
            CycleKind::Face => (loc::CYCLE_FACE_CODE, loc::DWELL_CYCLE_FACE),
            CycleKind::Thru => (loc::CYCLE_THRU_CODE, loc::DWELL_CYCLE_THRU),
            CycleKind::Mill => return None,
        })
    }

    /// True for the cycles that go down in pecks.
    pub fn pecks(self) -> bool {
        matches!(self, CycleKind::Deep | CycleKind::Brkchp)
    }
}
