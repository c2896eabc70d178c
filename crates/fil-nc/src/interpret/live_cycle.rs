//! Drilling cycles of lathes for live tools: G83 and G84 along Z, G87 and G88 along X.
//!
//! Fanuc's manual of lathes: R is the way from the level before the cycle to the R level, the
//! depth is a position, and the tool returns to the level before. Whether R counts as a
//! radius on X is a matter of a parameter; so is what Q means, which the machine's settings say.

use super::cycle::{Cycle, R};
use super::state::State;
use super::words::{AxisWord, Words};
use super::{Fault, refuse};
use crate::dialect::{Amount, CycleKind, Role};

impl State<'_> {
    /// A block with the code of a cycle of live tools: the cycle and its first hole.
    pub(super) fn begin_live_cycle(
        &mut self,
        side: bool,
        kind: CycleKind,
        words: &mut Words,
    ) -> Result<(), Fault> {
        if !self.live.is_on {
            return refuse("a cycle of live tools while the main spindle is no axis");
        }
        if self.live.polar || self.live.cylinder.is_some() {
            return refuse("a cycle of live tools within polar or cylindrical interpolation");
        }
        let along = if side { 0 } else { 2 };
        let fresh = Cycle::of_hole(kind, self.at[along], self.known[along]);
        self.cycle.active = Some(Cycle { live: Some(along), ..fresh });
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
            return refuse("a cycle of live tools while the position of its axis is not known");
        }
        match words.take(R)? {
            None | Some(0.0) => cycle.clear = Some(cycle.initial),
            Some(_) => {
                return refuse(
                    "R of a cycle of live tools is a radius or a diameter, by a parameter",
                );
            }
        }
        if let Some(step) = words.take(self.dialect.letter(Role::Step))? {
            self.live_peck(cycle, along, step)?;
        }
        if let Some(word) = axes.iter().find(|word| word.axis == along) {
            if word.increment || !self.absolute {
                return refuse("an increment in a cycle of live tools");
            }
            cycle.bottom = Some(self.position(along, word.value));
        }
        if let Some(dwell) = words.take(self.dialect.letter(Role::CycleDwell))? {
            cycle.dwell = Some(dwell / self.dialect.factor(Amount::Dwell));
        }
        if cycle.bottom.is_some_and(|bottom| bottom >= cycle.initial) {
            return refuse("the bottom of a hole is above the initial plane");
        }
        Ok(())
    }

    /// A hole in pecks, as the machine's parameters make them.
    fn live_peck(&self, cycle: &mut Cycle, along: usize, step: f64) -> Result<(), Fault> {
        if cycle.kind != CycleKind::Drill {
            return refuse("a depth of pecks in a tap of a live tool");
        }
        let pecks = self.dialect.turning.live_pecks;
        let Some(kind) = pecks.kind else {
            return refuse(
                "the retract of a live tool's peck depends on a parameter (mill_turn.peck_form)",
            );
        };
        let is_diameter = if along == 0 { pecks.side_is_diameter } else { Some(false) };
        let Some(is_diameter) = is_diameter else {
            return refuse(
                "a peck along X may be a radius or a diameter, by a parameter (mill_turn.side_peck)",
            );
        };
        let step = self.length(along, step) / if is_diameter { 2.0 } else { 1.0 };
        if step <= 0.0 {
            return refuse("a peck of a live tool is not above zero");
        }
        (cycle.kind, cycle.step) = (kind, Some(step));
        Ok(())
    }
}
