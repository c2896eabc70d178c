//! What of a program no step of a CL file asks for is taken out and looked at by itself.

use std::collections::VecDeque;

use fil_diag::Diag;

use super::clamps::Clamps;
use super::places::Turns;
use super::report::Report;
use super::rules::Rules;
use super::settings::Settings;
use crate::events::Events;
use crate::motion::Event;

/// The events of a program without those of modes that it leaves to the control.
pub(super) struct EventFilter<'a, W> {
    events: &'a mut dyn Events,
    watch: W,
}

/// Sees each event of a program before it is compared.
pub(super) trait Watcher {
    /// True for an event that stays among those that are compared.
    fn sees(&mut self, event: &Event) -> bool;
}

impl<'a, W: Watcher> EventFilter<'a, W> {
    pub(super) fn new(events: &'a mut dyn Events, watch: W) -> Self {
        EventFilter { events, watch }
    }

    pub(super) fn into_watcher(self) -> W {
        self.watch
    }
}

impl<W: Watcher> Events for EventFilter<'_, W> {
    fn more(&mut self, into: &mut VecDeque<Event>) -> Result<bool, Box<Diag>> {
        let mut at = into.len();
        let more = self.events.more(into);
        while let Some(event) = into.get(at) {
            if self.watch.sees(event) {
                at += 1;
            } else {
                into.remove(at);
            }
        }
        more
    }
}

/// What a program that is compared with a CL file has besides its motions.
pub(super) struct NonMotionEvents {
    rules: Rules,
    clamps: Option<Clamps>,
    /// Turns that the user's blocks stand around.
    pub(super) turns: Option<Turns>,
    /// Line and number of each auxiliary function.
    pub(super) auxiliaries: Vec<(u32, u32)>,
}

impl NonMotionEvents {
    pub(super) fn new(settings: &Settings<'_>) -> Self {
        NonMotionEvents {
            rules: Rules::new(settings),
            clamps: Clamps::new(settings),
            turns: Turns::new(settings),
            auxiliaries: Vec::new(),
        }
    }

    /// What was found wrong by the rules that hold for any program, and by those of clamped
    /// axes.
    pub(super) fn broken_rules(self) -> Report {
        let mut report = self.rules.findings;
        if let Some(clamps) = self.clamps {
            report.append(clamps.findings);
        }
        report
    }
}

impl Watcher for NonMotionEvents {
    fn sees(&mut self, event: &Event) -> bool {
        if self.clamps.as_mut().is_some_and(|clamps| clamps.takes(event)) {
            return false;
        }
        if let (Some(turns), Event::Move(found)) = (&mut self.turns, event) {
            turns.look(found);
        }
        match event {
            Event::Auxiliary { line, code } => {
                self.auxiliaries.push((*line, *code));
                false
            }
            _ => {
                self.rules.look(event);
                !event.stands_alone()
            }
        }
    }
}
