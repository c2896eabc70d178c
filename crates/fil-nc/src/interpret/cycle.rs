//! Drilling cycles as single motions.

use super::state::State;
use super::words::{AxisWord, Words, letter};
use super::{Fault, refuse};
use crate::dialect::{Amount, Auxiliary, CycleKind, DepthForm, Habit, Role};
use crate::errors::NcCode;
use crate::motion::{Course, Event, Spindle};

pub(super) const R: u8 = letter(b'R');

/// Distance above the last depth at which a peck begins to feed, and by which a
/// chip-breaking peck lifts, mm: a parameter of the control; this is LinuxCNC's.
const PECK_GAP: f64 = 0.254;

/// Most pecks of a hole.
const MAX_PECKS: f64 = 10_000.0;

/// Levels nearer than this are one level, mm or inch.
const SAME_LEVEL: f64 = 1e-9;

/// A cycle in force.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cycle {
    pub(super) kind: CycleKind,
    /// The axis that its holes run along, of a live tool on a lathe; the normal of the plane
    /// else.
    pub(super) live: Option<usize>,
    /// Level before the cycle, along the plane's normal.
    pub(super) initial: f64,
    pub(super) initial_known: bool,
    pub(super) bottom: Option<f64>,
    pub(super) clear: Option<f64>,
    pub(super) step: Option<f64>,
    pub(super) dwell: Option<f64>,
    /// Its code takes a dwell; others pass over it.
    pub(super) dwells: bool,
}

/// A cycle whose levels are all there.
#[derive(Clone, Copy)]
struct Hole {
    axis: usize,
    clear: f64,
    bottom: f64,
}

impl Cycle {
    /// A cycle of another family, whose levels its own file follows.
    pub(super) fn of_hole(kind: CycleKind, initial: f64, initial_known: bool) -> Self {
        let (bottom, clear, step, dwell) = (None, None, None, None);
        let dwells = true;
        Cycle { kind, live: None, initial, initial_known, bottom, clear, step, dwell, dwells }
    }

    /// Its holes are made in pecks.
    fn pecks(&self) -> bool {
        matches!(self.kind, CycleKind::Peck | CycleKind::BreakChips)
    }

    /// The level before the cycle is the R level: the tool returns there by any code.
    pub(super) fn keeps_its_level(&self) -> bool {
        let is_it = |clear: f64| (clear - self.initial).abs() < SAME_LEVEL;
        self.initial_known && self.clear.is_some_and(is_it)
    }
}

impl State<'_> {
    /// A block with a cycle's code: the cycle and its first hole.
    pub(super) fn begin_cycle(
        &mut self,
        kind: CycleKind,
        dwells: bool,
        words: &mut Words,
    ) -> Result<(), Fault> {
        let axis = self.plane;
        let fresh = Cycle {
            kind,
            live: None,
            initial: self.at[axis],
            initial_known: self.known[axis],
            bottom: None,
            clear: None,
            step: None,
            dwell: None,
            dwells,
        };
        self.cycle.active = Some(match self.cycle.active {
            Some(before) => Cycle { kind, dwells, ..before },
            None => fresh,
        });
        if self.dialect.has(Habit::ReturnsByLevel) {
            self.return_by(words)?;
        }
        self.hole(words)
    }

    /// G71 of an OSP: the level that holes return to by M53. Nothing moves.
    pub(super) fn return_level(&mut self, words: &mut Words) -> Result<(), Fault> {
        let axes = words.take_axes(self.dialect)?;
        let mut said = axes.iter();
        let (Some(&AxisWord { axis, value, increment: false }), None) = (said.next(), said.next())
        else {
            return refuse("G71 needs one position along the tool");
        };
        if axis != self.plane || !self.absolute {
            return refuse("G71 needs a position along the tool, in G90");
        }
        self.cycle.level = Some(self.position(axis, value));
        Ok(())
    }

    /// M53 or M54 in the block of an OSP's cycle: it returns to the level of G71, or to R. Without
    /// them it returns to the end of the travel, which is not followed.
    fn return_by(&mut self, words: &Words) -> Result<(), Fault> {
        let Some(cycle) = &mut self.cycle.active else { return Ok(()) };
        let returns = words.auxiliaries.iter().filter_map(|(auxiliary, _)| match auxiliary {
            Auxiliary::Returns { to_level } => Some(*to_level),
            _ => None,
        });
        let [to_level] = returns.collect::<Vec<_>>()[..] else {
            return refuse("a cycle needs M53 or M54 in its block");
        };
        if to_level {
            let Some(level) = self.cycle.level else {
                return refuse("M53 needs a G71 before it");
            };
            (cycle.initial, cycle.initial_known) = (level, true);
        }
        self.cycle.returns_initial = to_level;
        if self.absolute { Ok(()) } else { refuse("a cycle in G91 is not followed here") }
    }

    /// A hole of the cycle in force.
    pub(super) fn hole(&mut self, words: &mut Words) -> Result<(), Fault> {
        let Some(mut cycle) = self.cycle.active else { return Ok(()) };
        self.feed_word(words)?;
        let axes = words.take_axes(self.dialect)?;
        match cycle.live {
            Some(along) => self.live_levels(&mut cycle, along, words, &axes)?,
            None => self.levels(&mut cycle, words, &axes)?,
        }
        self.cycle.active = Some(cycle);
        let missing =
            |what: &str| Fault::new(NcCode::MissingWord, format!("the cycle needs {what}"));
        let hole = Hole {
            axis: cycle.live.unwrap_or(self.plane),
            clear: cycle.clear.ok_or_else(|| missing("its R plane"))?,
            bottom: cycle.bottom.ok_or_else(|| missing("its depth"))?,
        };
        let pecks = cycle.pecks();
        let step = match cycle.step.filter(|_| pecks) {
            None if pecks => return Err(missing("its peck")),
            Some(step) if (hole.clear - hole.bottom) / step > MAX_PECKS => {
                return Err(Fault::new(NcCode::BadNumber, "the pecks are too small to count"));
            }
            step => step,
        };
        let across: Vec<AxisWord> =
            axes.iter().filter(|word| word.axis != hole.axis).copied().collect();
        let (to, known) = self.target(&across);
        if to != self.at || known != self.known {
            self.go((to, known), Course::Rapid, None);
        }
        self.known[hole.axis] = true;
        self.step(&[(hole.axis, hole.clear)], Course::Rapid, None);
        self.drill(hole, step)?;
        self.leave(&cycle, hole)
    }

    /// Takes up the cycle's words.
    fn levels(&self, cycle: &mut Cycle, words: &mut Words, axes: &[AxisWord]) -> Result<(), Fault> {
        let axis = self.plane;
        let depth = axes.iter().find(|word| word.axis == axis);
        let increments = !self.absolute || depth.is_some_and(|word| word.increment);
        let form = if increments { DepthForm::Increments } else { self.dialect.forms.depth };
        if let Some(r) = words.take(R)? {
            cycle.clear = Some(match form {
                DepthForm::Absolute => self.position(axis, r),
                DepthForm::Increments => cycle.initial + self.way(axis, r),
                DepthForm::Unsigned => cycle.initial - self.way(axis, r).abs(),
            });
        }
        if let Some(word) = depth {
            let clear = cycle.clear.unwrap_or(cycle.initial);
            cycle.bottom = Some(match form {
                DepthForm::Absolute => self.position(axis, word.value),
                DepthForm::Increments => clear + self.way(axis, word.value),
                DepthForm::Unsigned => clear - self.way(axis, word.value).abs(),
            });
        }
        if !cycle.pecks() && words.has(self.dialect.letter(Role::Step)) {
            // A tap would peck with it; of other cycles it holds for the next one that pecks.
            let message = "a depth of pecks in a cycle that does not peck";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        if let Some(step) = words.take(self.dialect.letter(Role::Step))? {
            cycle.step = Some(self.length(axis, step).abs()).filter(|step| *step > 0.0);
        }
        if let Some(dwell) = words.take(self.dialect.letter(Role::CycleDwell))? {
            cycle.dwell = Some(dwell / self.dialect.factor(Amount::Dwell));
        }
        Ok(())
    }

    /// From the R level to the bottom.
    fn drill(&mut self, hole: Hole, step: Option<f64>) -> Result<(), Fault> {
        let rate = Some(self.rate()?);
        let mut reached = hole.clear;
        let whole = |cycle: &Option<Cycle>| cycle.is_some_and(|c| c.kind == CycleKind::Peck);
        while let Some(step) = step.filter(|step| reached - step > hole.bottom + 1e-9) {
            reached -= step;
            self.step(&[(hole.axis, reached)], Course::Feed, rate);
            if whole(&self.cycle.active) {
                self.step(&[(hole.axis, hole.clear)], Course::Rapid, None);
            }
            let again = (reached + PECK_GAP).min(hole.clear);
            self.step(&[(hole.axis, again)], Course::Rapid, None);
        }
        self.step(&[(hole.axis, hole.bottom)], Course::Feed, rate);
        Ok(())
    }

    /// What happens at the bottom, and the way out.
    fn leave(&mut self, cycle: &Cycle, hole: Hole) -> Result<(), Fault> {
        if let Some(seconds) = cycle.dwell.filter(|seconds| cycle.dwells && *seconds > 0.0) {
            self.events.push(Event::Dwell { line: self.line, seconds: Some(seconds), turns: None });
        }
        let turning = self.modes.spindle.turn;
        let rate = Some(self.rate()?);
        match cycle.kind {
            CycleKind::Tap | CycleKind::TapLeft => {
                self.modes.spindle.turn = out_of_a_tap(cycle.kind, turning);
                self.step(&[(hole.axis, hole.clear)], Course::Feed, rate);
            }
            CycleKind::FeedOut => {
                self.step(&[(hole.axis, hole.clear)], Course::Feed, rate);
            }
            CycleKind::StopOut => self.modes.spindle.turn = Spindle::Off,
            CycleKind::Drill | CycleKind::Peck | CycleKind::BreakChips => {}
        }
        let rest = if self.cycle.returns_initial { cycle.initial } else { hole.clear };
        // Where the tool rests behind another zero is known as little as where it came from.
        self.known[hole.axis] = !self.cycle.returns_initial || cycle.initial_known;
        self.step(&[(hole.axis, rest)], Course::Rapid, None);
        self.modes.spindle.turn = turning;
        Ok(())
    }
}

/// How the spindle turns on the way out of a tap, which the cycle says and not the way it
/// turned before: a wrong one tears the thread.
fn out_of_a_tap(kind: CycleKind, turning: Spindle) -> Spindle {
    match (turning, kind) {
        (Spindle::Off, _) => Spindle::Off,
        (_, CycleKind::TapLeft) => Spindle::Clockwise,
        _ => Spindle::Counterclockwise,
    }
}

pub(super) fn reversed(spindle: Spindle) -> Spindle {
    match spindle {
        Spindle::Off => Spindle::Off,
        Spindle::Clockwise => Spindle::Counterclockwise,
        Spindle::Counterclockwise => Spindle::Clockwise,
    }
}
