//! Drilling cycles of lathes for live tools: G83 and G84 along Z, G87 and G88 along X.
//!
//! Fanuc's manual of lathes: R is the way from the level before the cycle to the R level, the
//! depth is a position, and the tool returns to the level before. Whether R counts as a
//! radius on X, and how far a peck comes out, are matters of parameters.

use super::Fault;
use super::cycle::{Cycle, R};
use super::state::State;
use super::words::{AxisWord, Words};
use crate::dialect::CycleKind;
use crate::errors::NcCode;

fn refuse<T>(why: &str) -> Result<T, Fault> {
    Err(Fault::new(NcCode::NoMeaning, why))
}

impl State<'_> {
    /// A block with the code of a cycle of live tools: the cycle and its first hole.
    pub(super) fn begin_live_cycle(
        &mut self,
        side: bool,
        kind: CycleKind,
        words: &mut Words,
    ) -> Result<(), Fault> {
        if !self.live {
            return refuse("a cycle of live tools while the main spindle is no axis");
        }
        if self.polar || self.cylinder.is_some() {
            return refuse("a cycle of live tools within polar or cylindrical interpolation");
        }
        let along = if side { 0 } else { 2 };
        let fresh = Cycle::of_hole(kind, self.at[along], self.known[along]);
        self.cycle = Some(Cycle { live: Some(along), ..fresh });
        self.hole(words)
    }

    /// Takes up the words of a cycle of live tools.
    pub(super) fn live_levels(
        &self,
        cycle: &mut Cycle,
        along: usize,
        words: &mut Words,
        axes: &[AxisWord],
    ) -> Result<(), Fault> {
        if !cycle.initial_known {
            return refuse("a cycle of live tools, and where its axis stands is not known");
        }
        match words.take(R)? {
            None | Some(0.0) => cycle.clear = Some(cycle.initial),
            Some(_) => {
                return refuse(
                    "R of a cycle of live tools is a radius or a diameter, by a parameter",
                );
            }
        }
        if words.has(self.dialect.step) {
            return refuse("how far a peck of a live tool comes out is said by a parameter");
        }
        if let Some(word) = axes.iter().find(|word| word.axis == along) {
            if word.increment || !self.absolute {
                return refuse("an increment in a cycle of live tools");
            }
            cycle.bottom = Some(self.position(along, word.value));
        }
        if let Some(dwell) = words.take(self.dialect.cycle_dwell)? {
            cycle.dwell = Some(dwell / self.dialect.dwell_factor);
        }
        if cycle.bottom.is_some_and(|bottom| bottom >= cycle.initial) {
            return refuse("the bottom of a hole lies above the level before the cycle");
        }
        Ok(())
    }
}
