//! Holes of the path against canned cycles, or single moves, of the program.

use fil_machine::cycle_kind::CycleKind;

use super::ahead::Steps;
use super::expected_step::Hole;
use super::hole_tip::FromHole;
use super::report::FindingKind;
use super::say::short;
use super::settings::Quantity;
use super::verifier::{STILL, Verifier};
use crate::forward::Pose;
use crate::motion::{Course, Event, Move, Spindle};

/// Most motions over a hole before it is drilled.
const APPROACH: usize = 7;

/// Most motions from the end of a peck to that of the next one: out, back, and deeper.
const PECK_PARTS: usize = 3;

/// Most pecks of one hole.
const MOST_PECKS: usize = 10_000;

/// Levels of a hole in the machine's Z, and its place.
#[derive(Clone, Copy)]
pub(super) struct Levels {
    pub(super) at: [f64; 3],
    clear: f64,
    bottom: f64,
    /// Single moves under tool-tip control come back to the level that RETURN names, though the
    /// tool was higher before the cycle, and keep the level before it for all holes.
    single: bool,
}

impl<C: Steps> Verifier<'_, C> {
    /// Takes the events that make a hole; false when the next ones make none here.
    pub(super) fn hole(&mut self, cl_line: u32, hole: &Hole) -> bool {
        if !self.is_over_hole(self.next, hole) {
            return false;
        }
        self.goes_up_before_turning(cl_line, hole);
        self.changes_frame(cl_line);
        let Some(plunge) = self.plunge(self.next) else { return false };
        self.check_direction(cl_line, &plunge, hole);
        let drills = self.in_axes(&plunge, hole);
        let exact = self.rotary_over(&plunge, hole);
        let single = plunge.to.tip_control;
        let levels = Levels { single, ..self.levels(hole, &drills) };
        let kept = self.say_in_axes(hole, levels);
        let rest = self.drill_at(cl_line, hole, levels, &drills);
        self.say_again(kept);
        // An axis that the next hole leaves alone stays where it exactly stands over this one.
        if rest.is_some() && !self.settings.is_mill_turn() {
            self.exact = exact;
        }
        // The next hole may round the level over this one to its other last digit.
        self.memory.rapid_end = rest.map(|rest| {
            let tip = hole.start.tip + hole.start.axis * (rest - levels.at[2]);
            Pose { tip, ..hole.start }
        });
        true
    }

    /// The tool must lie along the hole, also where tool-tip control keeps the tip over it.
    fn check_direction(&mut self, cl_line: u32, plunge: &Move, hole: &Hole) {
        if !plunge.to.tip_control {
            return;
        }
        if let Some(angle) = self.gap(&plunge.to, &hole.start).turned {
            let message = format!("the tool is tilted {} degrees away from the hole", short(angle));
            self.find(FindingKind::Axis, Some(cl_line), Some(plunge.line), message);
        }
    }

    /// The next plunge is one of a cycle of the control.
    pub(super) fn plunges_in_cycle(&self) -> bool {
        self.plunge(self.next).is_some_and(|plunge| plunge.in_cycle)
    }

    /// Takes the events of a hole that is not where it should be; false when the next
    /// ones make no hole.
    pub(super) fn hole_elsewhere(&mut self, cl_line: u32, hole: &Hole) -> bool {
        let Some(plunge) = self.plunge(self.next).filter(|plunge| plunge.arc.is_none()) else {
            return false;
        };
        let single = plunge.to.tip_control;
        let plunge = self.in_axes(&plunge, hole);
        let mut levels = Levels { single, ..self.levels(hole, &plunge) };
        let over = Pose { tip: hole.start.tip, ..hole.start };
        let mut stands = plunge;
        stands.to.linear[2] = levels.at[2];
        self.say_gap(cl_line, &stands, &over);
        self.measure(&stands, &over);
        levels.at = [plunge.to.linear[0], plunge.to.linear[1], levels.at[2]];
        let kept = self.say_in_axes(hole, levels);
        self.drill_at(cl_line, hole, levels, &plunge);
        self.say_again(kept);
        true
    }

    /// Goes through a hole, and gives the level over it where the tool rests; `None` for a hole
    /// that went wrong.
    fn drill_at(
        &mut self,
        cl_line: u32,
        hole: &Hole,
        levels: Levels,
        plunge: &Move,
    ) -> Option<f64> {
        let first = self.next;
        if hole.rigid {
            self.ask_rigid(cl_line, plunge);
        }
        match self.drill(cl_line, hole, levels, plunge.modes.spindle.turn) {
            Ok(rest) => Some(rest),
            Err((line, message)) => {
                self.find(FindingKind::Cycle, Some(cl_line), Some(line), message);
                self.leave_hole(first, plunge);
                None
            }
        }
    }

    /// The first motion at feed from `index` on, after motions over the hole.
    pub(super) fn plunge(&self, index: usize) -> Option<Move> {
        self.over_hole(index).find(|found| found.course != Course::Rapid)
    }

    /// The motions over a hole from `index` on, before its plunge.
    pub(super) fn ways_over_hole(&self, index: usize) -> impl Iterator<Item = Move> + '_ {
        self.over_hole(index).take_while(|found| found.course == Course::Rapid)
    }

    fn over_hole(&self, index: usize) -> impl Iterator<Item = Move> + '_ {
        self.nc.from(index).take(APPROACH).map_while(|event| match event {
            Event::Move(found) if found.course != Course::Machine => Some(found),
            _ => None,
        })
    }

    /// The events from `index` on drill at the place of a hole.
    pub(super) fn is_over_hole(&self, index: usize, hole: &Hole) -> bool {
        let Some(plunge) = self.plunge(index) else { return false };
        if plunge.arc.is_some() {
            return false;
        }
        let levels = self.levels(hole, &self.in_axes(&plunge, hole));
        self.ends_over(&plunge, hole, levels.at)
    }

    fn levels(&self, hole: &Hole, plunge: &Move) -> Levels {
        let frame = match plunge.to.tilt {
            Some(_) => self.settings.forward.frame_of(&plunge.to),
            None => self.hole_frame(self.rotary_over(plunge, hole), hole),
        };
        let above = |by: f64| frame.linear(hole.start.tip + hole.start.axis * by);
        let clear = hole.clear.unwrap_or_else(|| self.settings.cycle_clearance(self.limits.metric));
        let level = |by: f64| self.slack.before_scale(2, above(by)[2]);
        let [clear, bottom] = [level(clear), level(-hole.depth)];
        Levels { at: above(0.0), clear, bottom, single: false }
    }

    /// The exact rotary positions of a plunge: those at which X, Y and Z are right over the hole,
    /// as at its bottom they are right nowhere.
    pub(super) fn rotary_over(&self, plunge: &Move, hole: &Hole) -> [f64; 2] {
        let first = self.gap(&plunge.to, &hole.start).rotary;
        let mut over = plunge.to;
        over.linear[2] = self.hole_frame(first, hole).linear(hole.start.tip)[2];
        let gap = self.gap(&over, &hole.start);
        if gap.closed() { gap.rotary } else { first }
    }

    /// Goes through the hole; gives the level where the tool rests behind it.
    fn drill(
        &mut self,
        cl_line: u32,
        hole: &Hole,
        levels: Levels,
        turning: Spindle,
    ) -> Result<f64, (u32, String)> {
        if hole.depth > 0.0 && levels.at[2] - levels.bottom <= self.slack.linear[2] {
            let message = "the depth of the hole is less than the last digit".to_string();
            return Err((self.next_line(), message));
        }
        let rest = self.approach(cl_line, hole, levels)?;
        // The last peck, as the tape has it, and its number.
        let mut reached: Option<f64> = None;
        let (mut line, mut peck) = (0, 0);
        let in_cycle = self.next_move().is_some_and(|found| found.in_cycle);
        for depth in self.depths(hole, levels, in_cycle) {
            if let Some(reached) = reached {
                if in_cycle && (reached - levels.bottom).abs() <= self.slack.of(Quantity::Cycle) {
                    // The last peck of the tape is the bottom, to the last digit.
                    break;
                }
                self.between_pecks(cl_line, hole, levels, (peck, reached))?;
            }
            peck += 1;
            let before = self.at;
            let found = self.level(cl_line, depth, "the hole")?;
            let course = if hole.kind == CycleKind::Tap { Course::Thread } else { Course::Feed };
            if found.course != course && !(course == Course::Thread && found.course == Course::Feed)
            {
                return Err((found.line, format!("{} in a hole", self.spell_move(&found))));
            }
            self.check_rate_of_hole(cl_line, before, &found, hole);
            (reached, line) = (Some(found.to.linear[2]), found.line);
        }
        if let Some(reached) = reached.filter(|reached| in_cycle && self.pecks_on(*reached, line)) {
            // The rounding of the words leaves a last digit for one peck more.
            self.between_pecks(cl_line, hole, levels, (peck, reached))?;
            self.level(cl_line, levels.bottom, "the hole")?;
        }
        self.bottom_dwell(cl_line, hole)?;
        self.leave(cl_line, hole, levels.clear, (rest, turning))?;
        Ok(rest)
    }

    /// The cycle of a line goes on below a level in the same hole.
    fn pecks_on(&self, reached: f64, line: u32) -> bool {
        let mut ahead = self.nc.from(self.next).take(PECK_PARTS);
        ahead.any(|event| match event {
            Event::Move(found) => {
                let over = (0..2).all(|n| found.to.linear[n] == self.at.linear[n]);
                found.line == line
                    && found.in_cycle
                    && found.course == Course::Feed
                    && over
                    && found.to.linear[2] < reached
            }
            _ => false,
        })
    }

    /// The levels of the pecks and the bottom, as a cycle of the control or single moves make
    /// them.
    fn depths(&self, hole: &Hole, levels: Levels, in_cycle: bool) -> Vec<f64> {
        let from_surface = in_cycle && self.settings.pecks_from_surface();
        let first = if from_surface { levels.at[2] } else { levels.clear };
        let step = hole.step.filter(|_| in_cycle);
        let side = hole.start.axis.z.abs() < 0.5 && self.settings.is_mill_turn();
        let of_diameter = side && self.settings.side_pecks_are_diameters();
        let step =
            step.map(|step| self.settings.peck_on_tape(step, self.limits.metric, of_diameter));
        let pecks = Hole { step: step.or(hole.step), ..*hole };
        depths(&pecks, first, levels.bottom)
    }

    /// Heights above its start at which the tool turns round in a hole.
    pub(super) fn heights(&self, hole: &Hole, levels: Levels, in_cycle: bool) -> Vec<f64> {
        let gap = self.settings.peck_gap();
        let raised = hole.retract.filter(|above| *above > 0.0);
        let mut heights: Vec<f64> = raised.into_iter().collect();
        heights.push(levels.clear - levels.at[2]);
        for depth in self.depths(hole, levels, in_cycle) {
            heights.extend([depth - levels.at[2], depth + gap - levels.at[2]]);
        }
        heights
    }

    /// The motions over the hole, down to the R level. Gives the level to return to.
    fn approach(
        &mut self,
        cl_line: u32,
        hole: &Hole,
        levels: Levels,
    ) -> Result<f64, (u32, String)> {
        let slack = self.slack.linear;
        let near = |a: f64, b: f64, n: usize| (a - b).abs() <= slack[n];
        let raised = match hole.retract {
            Some(above) if above > 0.0 => {
                levels.clear.max(self.slack.before_scale(2, levels.at[2] + above))
            }
            // Back to where the first of several cycles began.
            Some(_) => {
                self.memory.initial.map_or(levels.clear, |initial| initial.max(levels.clear))
            }
            None => levels.clear,
        };
        let known = self.known[2];
        if known && self.memory.initial.is_none() {
            self.memory.initial = Some(self.at.linear[2]);
        }
        let mut raise = known && self.at.linear[2] < raised - slack[2];
        // A cycle of the control returns to where it began, which another cycle has left low.
        let of_control = if raise { raised } else { self.at.linear[2] };
        let mut of_control = if known { of_control } else { f64::INFINITY };
        if raise && !levels.single {
            self.memory.initial =
                Some(self.memory.initial.map_or(raised, |initial| initial.max(raised)));
        }
        while let Some(found) = self.next_move().filter(|found| found.course == Course::Rapid) {
            let to = found.to.linear;
            // Where X stands behind polar interpolation is not known.
            let at = self.at_as(&found).linear;
            let way = |n: usize| (to[n] - at[n]).abs();
            let moves = |n: usize| self.limits.written[n] && found.known[n] && way(n) > STILL;
            // Y of a lathe without one stands at 0; said of a tool along X it is the turn of C.
            let is_place_known = (0..2).all(|n| self.known[n] || !self.limits.written[n]);
            let turns =
                self.memory.from_hole.is_some() && !self.limits.written[1] && way(1) > STILL;
            let across = (moves(0) || moves(1) || turns) && is_place_known;
            let z_moves = way(2) > STILL;
            let there = |n: usize| near(to[n], levels.at[n], n);
            let arrives = there(0) && there(1);
            // Across a tool along X one axis may go there before the other.
            let by_axes = |hole: FromHole| {
                let digits = hole.digits();
                let is_there = |n: usize| (to[n] - levels.at[n]).abs() <= digits[n];
                (0..2).all(|n| is_there(n) || !moves(n))
            };
            let goes_there = arrives || self.memory.from_hole.is_some_and(by_axes);
            if across && !goes_there {
                return Err((
                    found.line,
                    format!("{}, which is not over the hole", self.spell_move(&found)),
                ));
            }
            let lower = self.known[2] && to[2] < at[2] - slack[2];
            if lower && !arrives && is_place_known {
                let message = "rapid goes down before X and Y are over the hole".to_string();
                return Err((found.line, message));
            }
            let low = at[2].min(to[2]) < levels.clear - slack[2];
            let comes = self.settings.is_mill_turn() && found.known[0] && !self.known[0];
            if (across || comes) && self.known[2] && low {
                return Err((found.line, "rapid in XY below the R plane".to_string()));
            }
            let level = near(to[2], levels.clear, 2) || near(to[2], raised, 2);
            if z_moves && !level {
                return Err((found.line, self.spell_level("the R plane", to[2], levels.clear)));
            }
            raise &= !near(to[2], raised, 2);
            // The cycle begins on the level to return to.
            if lower && hole.retract.is_some_and(|above| above > 0.0) && near(to[2], raised, 2) {
                of_control = raised;
            }
            // Z counts from another zero than before the cycle.
            if !self.known[2] && near(to[2], raised, 2) {
                self.memory.initial = Some(raised);
            }
            self.take(cl_line, &found);
            self.next += 1;
            // The level to return to is then said over the hole.
            raise |= across && !self.known[2] && hole.retract.is_some_and(|above| above > 0.0);
        }
        if raise {
            let message = format!("the tool does not go up to Z{} before the hole", short(raised));
            return Err((self.next_line(), message));
        }
        if !near(self.at.linear[2], levels.clear, 2) {
            let line = self.next_move().map_or(0, |found| found.line);
            return Err((line, self.spell_level("the R plane", self.at.linear[2], levels.clear)));
        }
        let initial = self.memory.initial.unwrap_or(levels.clear);
        Ok(match hole.retract {
            None => levels.clear,
            Some(above) if levels.single && above > 0.0 => raised,
            Some(_) if levels.single => initial.max(levels.clear),
            Some(above) if above > 0.0 => {
                let returns = initial >= raised - slack[2] && raised > levels.clear + slack[2];
                if returns { of_control.clamp(raised, initial.max(raised)) } else { levels.clear }
            }
            Some(_) => initial,
        })
    }

    /// Out of the hole and back to just above the last peck.
    fn between_pecks(
        &mut self,
        cl_line: u32,
        hole: &Hole,
        levels: Levels,
        (peck, reached): (u32, f64),
    ) -> Result<(), (u32, String)> {
        let in_cycle = self.next_move().is_some_and(|next| next.in_cycle);
        let counts = !in_cycle || self.settings.cycles_count_breaks();
        let leaves = hole.out_each.is_some_and(|each| counts && peck.is_multiple_of(each));
        let kind = match hole.kind {
            _ if leaves => CycleKind::Deep,
            kind if in_cycle => self.settings.kind_in_cycle(kind),
            kind => kind,
        };
        if kind == CycleKind::Deep {
            let up = self.level(cl_line, levels.clear, "the retract between pecks")?;
            if up.course != Course::Rapid {
                return Err((up.line, format!("{} between pecks", self.spell_move(&up))));
            }
        }
        let Some(back) = self.next_move() else { return Ok(()) };
        self.vertical(&back)?;
        // In a cycle the last peck and the way back to it are rounded each by itself.
        let of_cycle = if back.in_cycle { self.slack.of(Quantity::Cycle) } else { 0.0 };
        let slack = self.slack.linear[2].max(of_cycle);
        let gap = back.to.linear[2] - reached;
        // How far a control comes back by itself is a parameter of it, or a word of its cycle.
        let said = match back.in_cycle {
            true => {
                let out = kind == CycleKind::Deep;
                self.settings.cycle_peck_gap(hole.kind, out, levels.clear - levels.at[2])
            }
            false => Some(self.settings.peck_gap()),
        };
        let peck_gap = said.unwrap_or(self.settings.peck_gap());
        let right = said.map_or(gap > 0.0, |said| (gap - said).abs() <= 2.0 * slack);
        let above = (back.to.linear[2] - levels.clear).abs() <= slack && gap <= peck_gap + slack;
        let lifts = back.in_cycle && self.settings.lifts_at_feed() && kind != CycleKind::Deep;
        let course = back.course == Course::Rapid || (lifts && back.course == Course::Feed);
        if course && (right || above) {
            self.take(cl_line, &back);
            self.next += 1;
            return Ok(());
        }
        if kind == CycleKind::Deep && levels.clear - reached <= peck_gap + slack {
            return Ok(());
        }
        let message =
            format!("{} in place of a rapid to just above the last peck", self.spell_move(&back));
        Err((back.line, message))
    }

    /// The next motion, which must go straight to a level.
    fn level(&mut self, cl_line: u32, z: f64, what: &str) -> Result<Move, (u32, String)> {
        self.level_turning(cl_line, z, what, None)
    }

    /// The same; on the way out the spindle may stand or turn back, and `turning` is
    /// how it goes on.
    pub(super) fn level_turning(
        &mut self,
        cl_line: u32,
        z: f64,
        what: &str,
        turning: Option<Spindle>,
    ) -> Result<Move, (u32, String)> {
        let Some(mut found) = self.next_move() else {
            return Err((self.next_line(), "the hole is not finished".to_string()));
        };
        self.vertical(&found)?;
        if !found.known[2] {
            return Err((found.line, format!("{what} is a plane that no block has programmed")));
        }
        let off = found.to.linear[2] - z;
        self.report.position.add(off.abs(), found.line);
        if off.abs() > self.slack.linear[2] {
            return Err((found.line, self.spell_level(what, found.to.linear[2], z)));
        }
        found.modes.spindle.turn = turning.unwrap_or(found.modes.spindle.turn);
        self.take(cl_line, &found);
        self.next += 1;
        Ok(found)
    }

    fn vertical(&self, found: &Move) -> Result<(), (u32, String)> {
        let straight = found.arc.is_none()
            && (0..2).all(|n| found.to.linear[n] == self.at.linear[n])
            && (0..2).all(|n| (found.to.rotary[n] - self.at.rotary[n]).abs() <= STILL);
        if straight {
            return Ok(());
        }
        Err((found.line, format!("{} in a hole", self.spell_move(found))))
    }

    fn bottom_dwell(&mut self, cl_line: u32, hole: &Hole) -> Result<(), (u32, String)> {
        let wanted = hole.dwell.unwrap_or_else(|| self.settings.cycle_dwell(hole.kind));
        let found = match self.nc.get(self.next) {
            Some(Event::Dwell { line, seconds, .. }) => Some((line, seconds)),
            _ => None,
        };
        match found {
            Some((line, seconds)) => {
                self.next += 1;
                let wanted = if wanted > 0.0 { self.settings.dwell_within(wanted) } else { 0.0 };
                self.check_dwell(cl_line, line, seconds, Some(wanted));
                Ok(())
            }
            None if wanted > 0.0 => {
                Err((self.next_line(), "no dwell at the bottom of the hole".to_string()))
            }
            None => Ok(()),
        }
    }

    /// Passes over what is left of a hole that went wrong.
    fn leave_hole(&mut self, first: usize, plunge: &Move) {
        while let Some(found) = self.next_move() {
            let of_cycle = found.in_cycle && found.line == plunge.line;
            let upright = found.arc.is_none()
                && found.to.linear[..2] == plunge.to.linear[..2]
                && found.to.linear[2] != self.at.linear[2];
            if !of_cycle && (plunge.in_cycle || !upright) && self.next > first {
                return;
            }
            self.at = found.to;
            self.known = found.known;
            self.next += 1;
        }
    }

    pub(super) fn next_line(&self) -> u32 {
        self.nc.get(self.next).map_or(0, |event| event.line())
    }

    pub(super) fn spell_level(&self, what: &str, is: f64, should: f64) -> String {
        let (way, by) = if is < should { ("deeper", should - is) } else { ("higher", is - should) };
        let by = short(by);
        format!("{what} is {way} by {by} (Z{} in place of Z{})", short(is), short(should))
    }
}

/// The levels of the pecks, counted from a level, and the bottom.
fn depths(hole: &Hole, from: f64, bottom: f64) -> Vec<f64> {
    let mut depths = Vec::new();
    if let Some(step) = hole.step.filter(|step| *step > 1e-6) {
        let mut reached = from - step;
        while reached > bottom + 1e-9 && depths.len() < MOST_PECKS {
            depths.push(reached);
            reached -= step;
        }
    }
    depths.push(bottom);
    depths
}
