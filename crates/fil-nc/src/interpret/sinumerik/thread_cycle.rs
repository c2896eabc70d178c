//! CYCLE97, a thread of all passes, as single motions.
//!
//! By the manual of the cycles: the tool goes above the start, goes in, cuts to the end, goes out
//! above the diameter by VRT and back. With VARI 3 outside and 4 inside all chips have the same
//! area, so that pass i of NRC lies at the root of i/NRC of the depth; NID passes follow at full
//! depth.

use super::super::Fault;
use super::super::state::Axes;
use super::Sinumerik;
use super::cycle::Call;
use crate::errors::NcCode;
use crate::motion::{Course, Rate};

/// Most passes of a thread.
const MAX_PASSES: f64 = 10_000.0;

fn refuse<T>(why: &str) -> Result<T, Fault> {
    Err(Fault::new(NcCode::ForeignCode, why))
}

impl Sinumerik<'_> {
    /// Runs the cycle.
    pub(super) fn thread_passes(&mut self, call: &Call) -> Result<(), Fault> {
        call.refuse(&["MPIT", "APP", "ROP", "FAL", "IANG", "NSP"])?;
        if self.state.live.is_on || self.state.plane != 1 || self.state.surface {
            return refuse("CYCLE97 of a live tool, outside of G18 or at surface speed");
        }
        if call.get("NUMTH").is_some_and(|starts| starts > 1.0) {
            return refuse("NUMTH of CYCLE97 above 1 is not followed");
        }
        let diameter = call.need("DM1")?;
        if call.need("DM2")? != diameter {
            return refuse("CYCLE97 of a taper is not followed");
        }
        let inside = match call.need("VARI")? {
            3.0 => false,
            4.0 => true,
            _ => return refuse("VARI of CYCLE97 other than 3 and 4 is not followed"),
        };
        let unit = self.state.unit();
        let lead = call.need("PIT")? * unit;
        let depth = call.need("TDEP")? * unit;
        let (cuts, springs) = (call.need("NRC")?, call.get("NID").unwrap_or(0.0));
        let back = call.need("VRT")? * unit;
        let counts = |number: f64| number.fract() == 0.0 && (0.0..MAX_PASSES).contains(&number);
        let makes_sense = lead > 0.0 && depth > 0.0 && back > 0.0 && cuts >= 1.0;
        if !(makes_sense && counts(cuts) && counts(springs)) {
            let message = "PIT, TDEP, NRC and VRT of CYCLE97 must lie above zero";
            return Err(Fault::new(NcCode::BadNumber, message));
        }
        let crest = self.state.position(0, diameter);
        let [start, end] = [call.need("SPL")?, call.need("FPL")?];
        let [start, end] = [start, end].map(|level| self.state.position(2, level));
        let out = if inside { -1.0 } else { 1.0 };
        let above = crest + out * back;
        let shares = (1..=cuts as u32).map(|pass| (f64::from(pass) / cuts).sqrt());
        self.rapid_to(above, start);
        for share in shares.chain(std::iter::repeat_n(1.0, springs as usize)) {
            let at = crest - out * depth * share;
            self.rapid_to(at, start);
            let target = (self.point(at, end), self.with_both());
            self.state.go(target, Course::Thread, Some(Rate::PerTurn(lead)));
            self.rapid_to(above, end);
            self.rapid_to(above, start);
        }
        Ok(())
    }

    fn point(&self, x: f64, z: f64) -> Axes {
        let mut to = self.state.at;
        (to[0], to[2]) = (x, z);
        to
    }

    fn with_both(&self) -> [bool; 5] {
        let mut known = self.state.known;
        (known[0], known[2]) = (true, true);
        known
    }

    fn rapid_to(&mut self, x: f64, z: f64) {
        let target = (self.point(x, z), self.with_both());
        self.state.go(target, Course::Rapid, None);
    }
}
