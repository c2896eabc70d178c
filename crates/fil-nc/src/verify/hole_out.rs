//! The way out of a hole, and back to the level before its cycle.

use fil_machine::cycle_kind::CycleKind;
use fil_machine::locations::CycleBoreOut;

use super::ahead::Steps;
use super::expected_step::Hole;
use super::report::FindingKind;
use super::say::short;
use super::verifier::Verifier;
use crate::motion::{Course, Spindle};

/// How the tool comes out of a hole.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Out {
    Rapid,
    Feed,
    Thread,
    /// The control's way is not laid down.
    Any,
}

impl<C: Steps> Verifier<'_, C> {
    /// The tool comes out of a hole, to the level where it rests before the next.
    pub(super) fn leave(
        &mut self,
        cl_line: u32,
        hole: &Hole,
        clear: f64,
        (rest, turning): (f64, Spindle),
    ) -> Result<(), (u32, String)> {
        let kind = hole.kind;
        let Some(first) = self.next_move() else {
            return Err((self.next_line(), "the tool stays in the hole".to_string()));
        };
        let (out, stands) = self.way_out(kind, first.in_cycle);
        let course = match out {
            Out::Rapid => first.course == Course::Rapid,
            Out::Feed => first.course == Course::Feed,
            Out::Thread => first.course != Course::Rapid,
            Out::Any => true,
        };
        if !course {
            return Err((first.line, format!("{} out of the hole", self.spell_move(&first))));
        }
        if matches!(first.course, Course::Feed | Course::Thread) {
            self.check_rate_of_hole(cl_line, self.at, &first, hole);
        }
        let spindle = match out {
            _ if stands => Spindle::Off,
            Out::Thread => reversed(turning),
            _ => turning,
        };
        // What a code of a machine's own does with the spindle is not known.
        let is_open = out == Out::Any && kind == CycleKind::Bore;
        if first.modes.spindle.turn != spindle && !is_open {
            let message = "the spindle state is wrong during the retract".to_string();
            return Err((first.line, message));
        }
        if (first.to.linear[2] - rest).abs() > self.slack.linear[2] {
            self.level_turning(cl_line, clear, "the retract", Some(turning))?;
            if let Some(up) = self.next_move().filter(|up| up.course != Course::Rapid) {
                return Err((up.line, format!("{} out of the hole", self.spell_move(&up))));
            }
        }
        self.level_turning(cl_line, rest, "the return level", Some(turning)).map(|_| ())
    }

    /// The cycle has ended: where the machine asks for it, the tool goes back to the level
    /// before it.
    pub(super) fn end_cycle(&mut self, cl_line: u32) {
        let Some(level) =
            self.memory.initial.take().filter(|_| self.settings.retracts_after_cycles())
        else {
            return;
        };
        // A hole of a live tool may lie along X.
        let along = if self.settings.is_mill_turn() { &[0, 2][..] } else { &[2] };
        let here = along.iter().map(|n| self.at.linear[*n]).fold(f64::NEG_INFINITY, f64::max);
        let slack = self.slack.linear[2];
        let returns = match self.at.tip_control || self.leans_from_z() {
            true => self.returns_along_tool(cl_line, level),
            false => {
                !self.known[2] || here >= level - slack || self.takes_to_level(cl_line, level, true)
            }
        };
        if !returns {
            let message = format!("the tool does not return to Z{} after the cycle", short(level));
            self.find(FindingKind::Missing, Some(cl_line), None, message);
        }
    }

    /// How the tool leaves the hole, and whether the spindle stands: by the settings of a
    /// bored hole of single moves, else by the code of the cycle.
    fn way_out(&self, kind: CycleKind, in_cycle: bool) -> (Out, bool) {
        if kind == CycleKind::Bore && !in_cycle {
            match self.settings.bore_out() {
                CycleBoreOut::AtFeedSpindleRunning => return (Out::Feed, false),
                CycleBoreOut::AtRapidSpindleStopped => return (Out::Rapid, true),
                CycleBoreOut::AsTheCycleCode => {}
            }
        }
        let code = self.settings.cycle_code(kind);
        let out = match (code, kind) {
            (Some(84 | 74 | 206 | 207), _) => Out::Thread,
            (Some(85 | 89 | 201), _) => Out::Feed,
            (Some(73 | 81 | 82 | 83 | 86 | 200 | 203 | 205), _) => Out::Rapid,
            (Some(_), _) => Out::Any,
            (None, CycleKind::Bore | CycleKind::Ream) => Out::Feed,
            (None, CycleKind::Tap) => Out::Thread,
            (None, _) => Out::Rapid,
        };
        (out, code == Some(86))
    }
}

fn reversed(spindle: Spindle) -> Spindle {
    match spindle {
        Spindle::Off => Spindle::Off,
        Spindle::Clockwise => Spindle::Counterclockwise,
        Spindle::Counterclockwise => Spindle::Clockwise,
    }
}
