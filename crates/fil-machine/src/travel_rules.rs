//! What a machine with rotary axes does where a straight motion would leave the travel of X, Y
//! or Z.

use crate::axes::AxisSet;
use crate::commons::Commons;
use crate::locations::{self as loc, Exceeded, ReposRapidMethod, ReposRapidRetract};

/// Axes by what is done where they would leave their travel; a motion of the others is refused.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TravelRules {
    /// The rotary axes take other positions for the same tool axis.
    pub reposition: AxisSet,
    /// The motion is made, with a warning.
    pub warn: AxisSet,
}

impl TravelRules {
    /// What the commons say for a machine with rotary axes.
    pub fn from_commons(commons: &Commons) -> Self {
        if !commons.read(loc::LIMITS_CHECK) || !commons.read(loc::REPOS_CHECK_LINEAR) {
            return TravelRules::default();
        }
        let of = |what: Exceeded| {
            let says = |number: &usize| commons.read(loc::LINEAR_EXCEEDED[*number]) == what;
            (0..3).filter(says).fold(AxisSet::NONE, |set, number| set.or(AxisSet::of(number)))
        };
        TravelRules { reposition: of(Exceeded::Reposition), warn: of(Exceeded::Warn) }
    }

    /// True when no motion is looked at.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.reposition.is_empty() && self.warn.is_empty()
    }
}

/// The machine says where a rapid motion takes other positions of the rotary axes than the
/// nearest, or brings the tool out there.
pub(crate) fn watches_rapids(commons: &Commons) -> bool {
    let retracts = commons.read(loc::REPOS_RAPID_RETRACT) == ReposRapidRetract::AsInFeedMoves
        && commons.read(loc::REPOS_RAPID_METHOD) != ReposRapidMethod::Nothing;
    retracts || commons.read(loc::REPOS_RAPID_WARNING)
}
