//! What random programs may have.

/// Something that programs may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Arcs of every size and plane.
    Arcs,
    /// Arcs and moves of a few digits.
    Tiny,
    /// Drilling cycles.
    Cycles,
    /// Rapids, arcs and changes of tool inside cycles.
    CycleCrossings,
    /// Cutter compensation.
    Cutcom,
    /// Compensation that begins on an arc, or that other things cross.
    CutcomCrossings,
    /// Blocks with a skip mark.
    Skips,
    /// INSERT, PREFUN, AUXFUN and POSTN that change modes.
    Texts,
    /// Texts with a motion.
    TextMotions,
    /// REPEAT.
    Repeats,
    /// TRANS.
    Frames,
    /// GODLTA.
    Deltas,
    /// UNITS on the way.
    UnitChanges,
    /// More than one tool.
    Tools,
    /// Arcs that rounding turns into others: nearly nothing, nearly half a turn,
    /// nearly a whole one.
    FineArcs,
    /// A dwell in any kind of cycle.
    CycleDwells,
    /// Other than a rapid after TRANS and CYCLE/OFF.
    CutsAfterFrames,
}

/// Each feature with how often programs have it: once in so many.
pub(super) const FEATURES: &[(Feature, usize)] = &[
    (Feature::Arcs, 2),
    (Feature::Tiny, 3),
    (Feature::Cycles, 2),
    (Feature::CycleCrossings, 4),
    (Feature::Cutcom, 3),
    (Feature::CutcomCrossings, 8),
    (Feature::Skips, 4),
    (Feature::Texts, 3),
    (Feature::TextMotions, 8),
    (Feature::Repeats, 6),
    (Feature::Frames, 4),
    (Feature::Deltas, 3),
    (Feature::UnitChanges, 12),
    (Feature::Tools, 2),
    (Feature::FineArcs, 2),
    (Feature::CycleDwells, 2),
    (Feature::CutsAfterFrames, 3),
];
