//! The plane in which the cutter is compensated, where only one is meant: that of its record for a
//! live tool, and on a mill where the record names one; X and Z on a lathe without Y.

use super::modes::Expected;
use super::say::PLANES;
use super::settings::Settings;
use crate::motion::{DRILLED, Modes};

/// The plane of X and Z, by the index of its normal.
const ZX: usize = 1;

/// Which plane a machine means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MeantPlane {
    /// Any: a lathe with Y may say its own, and an arc of some mills changes it.
    Open,
    /// That which the record of a mill names, any where it names none.
    OfRecord,
    /// That of X and Z.
    OfTurning,
    /// The same, and that of the record where live tools mill.
    OfMillTurn,
}

impl MeantPlane {
    pub(super) fn of(settings: &Settings) -> Self {
        match () {
            () if settings.is_mill_turn() => MeantPlane::OfMillTurn,
            () if settings.dialect.counts_diameters() && !settings.written()[1] => {
                MeantPlane::OfTurning
            }
            () if settings.dialect.lathe || settings.arcs_change_plane() => MeantPlane::Open,
            () => MeantPlane::OfRecord,
        }
    }
}

impl Expected {
    /// The plane in which a live tool is compensated, by the index of its normal.
    pub(super) fn plane_of_live_tool(&self) -> Option<usize> {
        (self.meant_plane == MeantPlane::OfMillTurn && self.mills()).then_some(self.plane)
    }

    /// The cutter is compensated in another plane than is meant.
    pub(super) fn wrong_plane(&self, modes: &Modes) -> Option<String> {
        let must = match self.meant_plane {
            MeantPlane::Open => None,
            MeantPlane::OfRecord => Some(self.plane).filter(|plane| *plane != DRILLED),
            MeantPlane::OfTurning | MeantPlane::OfMillTurn if !self.mills() => Some(ZX),
            MeantPlane::OfTurning | MeantPlane::OfMillTurn => self.plane_of_live_tool(),
        }?;
        let found = modes.compensation_plane.filter(|found| *found != must)?;
        let [found, must] = [found, must].map(|normal| PLANES[normal]);
        Some(format!("cutter compensation acts in the plane {found}, it should be {must}"))
    }
}
