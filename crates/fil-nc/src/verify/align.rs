//! Where path and program part, and how they come together again.

use super::ahead::Steps;
use super::expected_step::{ExpectedStep, Step};
use super::lines::{RAPID_PARTS, is_line};
use super::report::FindingKind;
use super::say::shape;
use super::verifier::{LOOK_AHEAD, Verifier};
use crate::forward::Pose;
use crate::motion::{Course, Event, INCH, Move};

/// How path and program come together again.
pub(super) enum Detour {
    /// The program lacks the step.
    Missing,
    /// The program has so many events too many.
    Extra(usize),
    /// The next motion stands for the step, but differs.
    Other,
}

impl<C: Steps> Verifier<'_, C> {
    /// Tells whether path and program agree again after leaving out parts of one.
    pub(super) fn detour(&mut self, step: &Step) -> Detour {
        let next = self.nc.get(self.next);
        if !matches!(next, Some(Event::Move(_))) {
            let comes = match next {
                Some(Event::ToolChange { tool, .. }) => self.tool_comes(tool),
                _ => false,
            };
            return if comes { Detour::Missing } else { Detour::Extra(1) };
        }
        if self.goes_on_beside(step) {
            return Detour::Other;
        }
        let missing = self.steps_left_out();
        let extra = self.units_left_out(&step.what);
        match (missing, extra) {
            (Some(missing), Some(extra)) if extra < missing => Detour::Extra(extra),
            (Some(_), _) => Detour::Missing,
            (None, Some(_)) if self.next_pair_fits() => Detour::Other,
            (None, Some(extra)) => Detour::Extra(extra),
            (None, None) => Detour::Other,
        }
    }

    /// The next motion is off by what has been said of the one before.
    pub(super) fn goes_on_beside(&self, step: &Step) -> bool {
        let (Some(pose), Some(found)) = (step.what.end(), self.next_move()) else { return false };
        let gap = self.gap(&found.to, &pose);
        self.said == Some(shape(&gap))
    }

    /// After how many motions or holes of the program a step is made, if at all.
    pub(super) fn units_left_out(&self, wanted: &ExpectedStep) -> Option<usize> {
        let mut index = self.next;
        for units in 1..=LOOK_AHEAD {
            index = self.unit_end(index);
            if !matches!(self.nc.get(index), Some(Event::Move(_) | Event::Dwell { .. })) {
                return None;
            }
            if self.fits(index, wanted) {
                return Some(units);
            }
        }
        None
    }

    /// After how many motions of the path the next event fits, if after any.
    pub(super) fn steps_left_out(&mut self) -> Option<usize> {
        let mut motions = 0;
        for ahead in 0..4 * LOOK_AHEAD {
            let what = self.cl.peek(ahead)?.what.clone();
            if matches!(what, ExpectedStep::Tool { .. }) || motions == LOOK_AHEAD {
                return None;
            }
            if what.end().is_some() {
                motions += 1;
                if self.fits(self.next, &what) {
                    return Some(motions);
                }
            }
        }
        None
    }

    /// The event after the next fits the step after this one.
    pub(super) fn next_pair_fits(&mut self) -> bool {
        let mut ahead = 0;
        loop {
            let Some(what) = self.cl.peek(ahead).map(|step| step.what.clone()) else {
                return false;
            };
            if what.end().is_some() {
                return self.fits(self.unit_end(self.next), &what);
            }
            ahead += 1;
            if ahead > LOOK_AHEAD {
                return false;
            }
        }
    }

    /// A change to that tool comes within the next steps.
    pub(super) fn tool_comes(&mut self, tool: u32) -> bool {
        let mut ahead = 0;
        while ahead < 4 * LOOK_AHEAD
            && let Some(step) = self.cl.peek(ahead)
        {
            if matches!(step.what, ExpectedStep::Tool { number, .. } if number == tool) {
                return true;
            }
            ahead += 1;
        }
        false
    }

    /// The events from `index` on begin to do what a step asks for.
    pub(super) fn fits(&self, index: usize, wanted: &ExpectedStep) -> bool {
        let Some(Event::Move(found)) = self.nc.get(index) else { return false };
        match wanted {
            ExpectedStep::Rapid(pose) => self.rapid_parts(index, pose).is_some(),
            ExpectedStep::Feed(pose, _) => {
                is_line(&found, Course::Feed) && self.reaches(&found, pose)
            }
            ExpectedStep::Thread(pose, _) => {
                is_line(&found, Course::Thread) && self.reaches(&found, pose)
            }
            ExpectedStep::Arc(arc, _) => found.arc.is_some() && self.reaches(&found, &arc.end),
            ExpectedStep::Hole(hole) => self.is_over_hole(index, hole),
            _ => false,
        }
    }

    /// The next motion stands for a step, but is another one.
    pub(super) fn other(&mut self, step: &Step) {
        let (Some(pose), Some(first)) = (step.what.end(), self.next_move()) else { return };
        if self.units_differ(step.line, &first, &pose) {
            return;
        }
        if let ExpectedStep::Hole(hole) = &step.what
            && self.hole_elsewhere(step.line, hole)
        {
            return;
        }
        let rapid = matches!(step.what, ExpectedStep::Rapid(_));
        let parts = if rapid { self.rapids_ahead().max(1) } else { 1 };
        let nearest = |index: &usize| match self.nc.get(*index) {
            Some(Event::Move(found)) => self.gap(&found.to, &pose).tip,
            _ => f64::MAX,
        };
        let chosen = (self.next..self.next + parts)
            .min_by(|a, b| nearest(a).total_cmp(&nearest(b)))
            .unwrap_or(self.next);
        let Some(Event::Move(found)) = self.nc.get(chosen) else { return };
        self.say_way(step, &found);
        self.say_gap(step.line, &found, &pose);
        if found.in_cycle && self.gap(&found.to, &pose).closed() {
            let what = self.spell_move(&found);
            let message = format!("{what} by a cycle that the CL file does not ask for here");
            self.find(FindingKind::Extra, Some(step.line), Some(found.line), message);
        }
        for index in self.next..=chosen {
            if let Some(Event::Move(part)) = self.nc.get(index) {
                self.take(step.line, &part);
            }
        }
        self.measure(&found, &pose);
        self.next = chosen + 1;
    }

    pub(super) fn rapids_ahead(&self) -> usize {
        let rapids = self.nc.from(self.next).take(RAPID_PARTS);
        rapids
            .take_while(
                |event| matches!(event, Event::Move(m) if m.course == Course::Rapid && !m.in_cycle),
            )
            .count()
    }

    /// Says it when the whole program is in the other unit.
    pub(super) fn units_differ(&mut self, cl_line: u32, found: &Move, pose: &Pose) -> bool {
        let wanted = self.settings.forward.frame_of(&found.to).linear(pose.tip);
        let times = |factor: f64| {
            let mut large = false;
            let same = (0..3).filter(|n| found.known[*n]).all(|n| {
                large |= wanted[n].abs() > 1.0;
                (found.to.linear[n] * factor - wanted[n]).abs() < 0.02
            });
            same && large
        };
        let said = match () {
            () if times(1.0 / INCH) => "is in inch, the CL file is in mm",
            () if times(INCH) => "is in mm, the CL file is in inch",
            () => return false,
        };
        let message = format!("the program {said}; nothing more was compared");
        self.find(FindingKind::Units, Some(cl_line), Some(found.line), message);
        self.over = true;
        true
    }

    /// Says that events of the program are too many, and passes over them.
    pub(super) fn extra(&mut self, count: usize, cl_line: u32) {
        for _ in 0..count {
            self.pass(cl_line);
            let Some(event) = self.nc.get(self.next) else { return };
            match event {
                Event::Move(found) => {
                    let what = self.spell_move(&found);
                    let what = if found.in_cycle { "cycle".to_string() } else { what };
                    let message = format!("the CL file asks for no {what} here");
                    self.find(FindingKind::Extra, Some(cl_line), Some(found.line), message);
                    self.stand_through(self.unit_end(self.next));
                }
                Event::ToolChange { line, tool, .. } => {
                    let message = format!("the CL file asks for no change to tool {tool} here");
                    self.find(FindingKind::Tool, Some(cl_line), Some(line), message);
                    self.next += 1;
                }
                Event::Dwell { line, .. } => {
                    let message = "the CL file asks for no dwell here".to_string();
                    self.find(FindingKind::Extra, Some(cl_line), Some(line), message);
                    self.next += 1;
                }
                Event::Auxiliary { .. }
                | Event::LeftToControl { .. }
                | Event::ToolMeasured { .. } => self.next += 1,
                Event::End { .. } => return,
            }
        }
    }

    /// The index after an event, or after all motions of the cycle block it belongs to.
    pub(super) fn unit_end(&self, index: usize) -> usize {
        let Some(Event::Move(first)) = self.nc.get(index) else { return index + 1 };
        if !first.in_cycle {
            return index + 1;
        }
        let same = |event: &Event| match event {
            Event::Move(found) => found.in_cycle && found.line == first.line,
            Event::Dwell { line, .. } => *line == first.line,
            _ => false,
        };
        index + self.nc.from(index).take_while(same).count().max(1)
    }

    /// Goes to where the events before `end` lead.
    pub(super) fn stand_through(&mut self, end: usize) {
        while self.next < end {
            match self.nc.get(self.next) {
                Some(Event::Move(found)) => self.stand(&found),
                _ => self.next += 1,
            }
        }
    }
}
