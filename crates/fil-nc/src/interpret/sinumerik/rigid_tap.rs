//! G331 and G332: a tap in step with the spindle, which SPOS has brought under position control.
//!
//! By the manual of the language: the depth is a word of X, Y or Z, the lead I, J or K, whose sign is
//! the way the spindle turns (positive as M3); G332 has the same lead and turns the spindle back;
//! S is its speed, without M3 or M4.

use super::super::cycle::reversed;
use super::super::{Fault, refuse};
use super::Sinumerik;
use super::block::Said;
use crate::dialect::FeedMode;
use crate::motion::{Course, Rate, Spindle};

impl Sinumerik<'_> {
    /// The way into a hole along Z or X, or back out of it.
    pub(super) fn rigid_tap(&mut self, said: &Said, back: bool) -> Result<(), Fault> {
        let state = &self.state;
        if state.modes.spindle.turn != Spindle::Off || state.modes.spindle.orientation.is_none() {
            return refuse("G331 and G332 while the spindle is not under position control (SPOS)");
        }
        if state.feed.mode != FeedMode::PerMinute {
            return refuse("G331 and G332 under a feed that counts the turns of the spindle");
        }
        if state.modes.spindle.speed.is_none() || state.surface {
            return refuse("G331 and G332 without the turns of the spindle (S)");
        }
        if self.called.is_some() || said.radius.is_some() || state.head.tilt.is_some() {
            return refuse("G331 and G332 in a cycle, with a radius or in a tilted plane");
        }
        let (along, lead) = match said.center {
            [None, None, Some((lead, _))] => (2, lead),
            [Some((lead, _)), None, None] => (0, lead),
            _ => return refuse("G331 and G332 need the lead K along Z or I along X, and no other"),
        };
        let alone = (0..5).all(|axis| (axis == along) == said.axes[axis].is_some());
        if !alone || lead == 0.0 || !state.known[along] {
            return refuse("G331 and G332 need Z and its lead K, or X and its lead I, alone");
        }
        if along == 0 && self.is_by_diameter() {
            return refuse(
                "G331 and G332 along X while it is a diameter: whether its lead I is one, too, is \
                 not plain (DIAMOF)",
            );
        }
        let into = if lead > 0.0 { Spindle::Clockwise } else { Spindle::Counterclockwise };
        let rate = Rate::PerTurn(lead.abs() * state.unit());
        let before = self.rigid_tap_lead.take();
        if back && before != Some(lead) {
            return refuse("G332 without G331 of the same lead before it");
        }
        self.rigid_tap_lead = Some(lead).filter(|_| !back);
        let target = self.target(said);
        let spindle = std::mem::replace(
            &mut self.state.modes.spindle.turn,
            if back { reversed(into) } else { into },
        );
        self.state.go(target, Course::Thread, Some(rate));
        self.state.modes.spindle.turn = spindle;
        Ok(())
    }
}
