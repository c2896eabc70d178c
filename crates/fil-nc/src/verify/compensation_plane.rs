//! The plane in which the cutter is compensated, where only one is meant: that of its record for a
//! live tool, X and Z on a lathe without Y.

use super::modes::Expected;
use super::say::PLANES;
use super::settings::Settings;
use crate::motion::Modes;

/// The plane of X and Z, by the index of its normal.
const ZX: usize = 1;

/// Which plane a machine means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MeantPlane {
    /// Any: a mill says its own, and a lathe with Y may.
    Open,
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
            () => MeantPlane::Open,
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
        let of_turning = Some(ZX).filter(|_| self.meant_plane != MeantPlane::Open && !self.mills());
        let must = self.plane_of_live_tool().or(of_turning)?;
        let found = modes.compensation_plane.filter(|found| *found != must)?;
        let [found, must] = [found, must].map(|normal| PLANES[normal]);
        Some(format!("cutter compensation acts in the plane {found}, it should be {must}"))
    }
}
