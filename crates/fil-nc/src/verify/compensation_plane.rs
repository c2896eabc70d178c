//! The plane in which the cutter is compensated, where only one is meant: that of its record for a
//! live tool, and on a mill where the record names one; X and Z on a lathe without Y.

use nalgebra::Vector3;

use super::ahead::Steps;
use super::modes::Expected;
use super::report::FindingKind;
use super::say::PLANES;
use super::settings::Settings;
use super::verifier::Verifier;
use crate::motion::{DRILLED, Modes, Move};

/// The least cosine between directions that are one.
const SAME_WAY: f64 = 1.0 - 1e-6;

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
            () if settings.dialect.is_lathe() || settings.arcs_change_plane() => MeantPlane::Open,
            () => MeantPlane::OfRecord,
        }
    }
}

impl Expected {
    /// The plane in which a live tool is compensated, by the index of its normal.
    pub(super) fn plane_of_live_tool(&self) -> Option<usize> {
        (self.plane.meant == MeantPlane::OfMillTurn && self.mills()).then_some(self.plane.named)
    }

    /// The cutter is compensated in another plane than is meant.
    pub(super) fn wrong_plane(&self, modes: &Modes) -> Option<String> {
        let must = match self.plane.meant {
            MeantPlane::Open => None,
            MeantPlane::OfRecord => Some(self.plane.named).filter(|plane| *plane != DRILLED),
            MeantPlane::OfTurning | MeantPlane::OfMillTurn if !self.mills() => Some(ZX),
            MeantPlane::OfTurning | MeantPlane::OfMillTurn => self.plane_of_live_tool(),
        }?;
        let found = modes.compensation.plane.filter(|found| *found != must)?;
        let [found, must] = [found, must].map(|normal| PLANES[normal]);
        Some(format!("cutter compensation acts in the plane {found}, it should be {must}"))
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// The cutter is compensated in a plane that its axis is square to, as the control sees it; under
    /// a tool along Z also in the one that the record names, where the part stands as the machine.
    pub(super) fn check_square_to_compensation(&mut self, cl_line: u32, found: &Move) {
        let Some(normal) = found.modes.compensation.plane else { return };
        let forward = &self.settings.forward;
        let is_known = (0..2).all(|n| forward.rotaries()[n].is_none() || found.known[n + 3]);
        if !forward.has_rotary() || self.settings.is_mill_turn() || !is_known {
            return;
        }
        let unit = Vector3::ith(normal, 1.0);
        let of_part = forward.pose(&found.to).axis;
        let (tool, seen) = match () {
            () if found.to.tilt.is_some() => {
                (Vector3::z(), if of_part.z > SAME_WAY { unit } else { Vector3::zeros() })
            }
            () if found.to.names_tip() => (of_part, unit),
            () => {
                let turn = forward.frame(found.to.rotary).turn.transpose();
                (self.tool_on_axes(found.to.rotary), turn * unit)
            }
        };
        let is_named = normal != DRILLED && self.expected.named_plane() == normal;
        let cuts = tool.dot(&unit) > SAME_WAY || is_named && tool.z > SAME_WAY;
        if cuts && (!is_named || seen.dot(&unit) > SAME_WAY) {
            return;
        }
        let plane = PLANES[normal];
        let message = format!("the tool is not square to {plane}, in which it is compensated");
        self.find(FindingKind::Compensation, Some(cl_line), Some(found.line), message);
    }
}
