//! What stands between the motions: dwells, texts, functions, the end.

use super::ahead::Steps;
use super::expected_step::{CoolantKind, Effect, End, ExpectedStep, Step};
use super::report::{FindingKind, Unverified};
use super::say::short;
use super::settings::Quantity;
use super::verifier::Verifier;
use crate::dialect::Auxiliary;
use crate::motion::{Event, Move, Spindle};

/// Seconds that are no difference.
const DUST: f64 = 1e-6;

impl<C: Steps> Verifier<'_, C> {
    /// A dwell in seconds, or in turns of the spindle.
    pub(super) fn dwell(&mut self, cl_line: u32, wanted: Option<f64>, turning: Option<f64>) {
        self.pass(cl_line);
        let Some(Event::Dwell { line, seconds, turns }) = self.nc.get(self.next) else {
            return self.find(FindingKind::Missing, Some(cl_line), None, "no dwell".to_string());
        };
        self.next += 1;
        let wanted = wanted.map(|wanted| self.settings.dwell_within(wanted));
        // How many seconds turns take at a speed that nobody knows is left open.
        let is_open = turning.is_some() && wanted.is_none() && self.settings.waits_seconds();
        let is_longer = |(found, wanted): (f64, f64)| {
            (0.0..=self.slack.of(Quantity::SecondsOfTurns)).contains(&(found - wanted + DUST))
        };
        let waits_turns = turning.is_some() && seconds.zip(wanted).is_some_and(is_longer);
        if !is_open && !waits_turns {
            self.check_dwell(cl_line, line, seconds, wanted);
        }
        if let (Some(found), Some(wanted)) = (turns, turning) {
            let wanted = self.settings.turns_within(wanted);
            if (found - wanted).abs() > self.slack.of(Quantity::DwellTurns) {
                let message =
                    format!("dwell of {} turns, it should be {}", short(found), short(wanted));
                self.find(FindingKind::Dwell, Some(cl_line), Some(line), message);
            }
        }
    }

    /// The turns a minute at surface speed where the tool of a lathe stands.
    pub(super) fn turns_at_surface_speed(&self) -> Option<f64> {
        let is_known = self.known[0] && !self.expected.mills();
        let diameter = 2.0 * self.at.linear[0].abs();
        is_known.then(|| self.expected.turns_of_surface(diameter, self.settings)).flatten()
    }

    pub(super) fn check_dwell(
        &mut self,
        cl_line: u32,
        nc_line: u32,
        found: Option<f64>,
        wanted: Option<f64>,
    ) {
        let agrees = match (found, wanted) {
            (Some(found), Some(wanted)) => (found - wanted).abs() <= self.slack.of(Quantity::Dwell),
            (found, wanted) => found.is_none() && wanted.is_none(),
        };
        if !agrees {
            let spell = |seconds: Option<f64>| match seconds {
                Some(seconds) => format!("{} s", short(seconds)),
                None => "turns of the spindle".to_string(),
            };
            let message = format!("dwell of {}, it should be {}", spell(found), spell(wanted));
            self.find(FindingKind::Dwell, Some(cl_line), Some(nc_line), message);
        }
    }

    pub(super) fn insert(&mut self, cl_line: u32, text: &str, may_be_skipped: bool) {
        self.pass_own();
        let last = self.next.checked_sub(1).and_then(|at| self.nc.line(at)).unwrap_or(0);
        let next = self.nc.line(self.next).unwrap_or(u32::MAX);
        // Behind a subprogram the lines go back.
        let behind = if last <= next { last } else { 0 };
        let line = match self.own.insert(text, may_be_skipped, behind) {
            Ok(line) => line,
            Err(failed) => {
                self.failed = Some(failed);
                self.over = true;
                return;
            }
        };
        let Some(line) = line else {
            let message = format!("the block `{text}` of INSERT is not there");
            return self.find(FindingKind::Block, Some(cl_line), None, message);
        };
        // A subprogram may have been called on the way.
        let last = self.last_line();
        if last <= next && line > next {
            let message = format!(
                "the block `{text}` of INSERT is elsewhere, it should be between lines {last} and {next}"
            );
            self.find(FindingKind::Block, Some(cl_line), Some(line), message);
        }
    }

    /// An auxiliary function must stand between the last motion and the next.
    pub(super) fn ask_auxiliary(&mut self, cl_line: u32, code: Option<u32>) {
        // Codes of clamps have rules of their own where the post clamps.
        let of_clamps =
            |code: &u32| self.settings.clamps_of_post().is_some_and(|codes| codes.contains(code));
        let Some(code) = code.filter(|code| !of_clamps(code)) else { return };
        // The machine's own blocks may stand before it or after it.
        let last = self.last_line();
        self.pass_own();
        let [_, next] = self.lines_here();
        self.auxiliaries.ask(code, cl_line, [last, next]);
    }

    /// The lines of the events that have come and come next; motions that stand still may belong to
    /// either side.
    pub(super) fn lines_here(&self) -> [u32; 2] {
        let is_still = |event: &Event| matches!(event, Event::Move(found) if self.is_still(found));
        let next = self.nc.from(self.next).find(|event| !is_still(event));
        [self.last_line(), next.map_or(u32::MAX, |event| event.line())]
    }

    /// A stop right before a tool change that stops there anyway is that one, and one before a change by
    /// hand is that of the operator; before anything else it stands by itself.
    pub(super) fn settle_held_stops(&mut self, next: &ExpectedStep) {
        if self.memory.held_stops.is_empty() {
            return;
        }
        let waits = matches!(
            next,
            ExpectedStep::Cutter(_)
                | ExpectedStep::Counts(_)
                | ExpectedStep::Stop { .. }
                | ExpectedStep::Spindle(Some(Spindle::Off))
                | ExpectedStep::Coolant(CoolantKind::Off)
        );
        if waits {
            return;
        }
        let has_changed = self.blocks.changes > 0;
        let changes = match next {
            ExpectedStep::Tool { number, offset, .. } => {
                !self.keeps_tool(*number, self.settings.tool_offset(*number, *offset))
            }
            _ => false,
        };
        let taken = |code: u32| match next {
            ExpectedStep::Tool { by_hand: true, .. } => changes,
            ExpectedStep::Tool { .. } => {
                changes && has_changed && self.settings.stop_at_change() == Some(code)
            }
            _ => false,
        };
        let mut stops = std::mem::take(&mut self.memory.held_stops);
        stops.retain(|(_, code)| !taken(*code));
        for (cl_line, code) in stops {
            self.ask_auxiliary(cl_line, Some(code));
        }
    }

    /// An auxiliary function may stand between the last motion and the next.
    pub(super) fn allow_auxiliary(&mut self, code: u32) {
        let next = self.nc.get(self.next).map_or(u32::MAX, |event| event.line());
        self.auxiliaries.allow(code, [self.last_line(), next]);
    }

    /// The mode of rigid taps comes before each cycle that the control begins, maybe behind the ways
    /// over its hole. The end of a cycle ends the mode too, as each tap of a live tool does.
    pub(super) fn ask_rigid(&mut self, cl_line: u32, tap: &Move) {
        let is_live = self.settings.is_mill_turn() && self.expected.mills();
        let goes_on = self.moved.in_cycle && self.ways_over_hole(self.next).all(|way| way.in_cycle);
        if let Some(code) = self.settings.rigid_tap_mode().filter(|_| is_live || !goes_on) {
            self.auxiliaries.ask(code, cl_line, [self.last_line(), tap.line]);
        }
    }

    /// A function that the CL file asks for by its number. What spindle and coolant do is
    /// compared with the modes of the motions.
    pub(super) fn auxiliary(&mut self, cl_line: u32, code: u32) {
        if matches!(self.settings.dialect.auxiliary(i64::from(code)), Auxiliary::Other(_)) {
            if !self.auxiliaries.is_free(code) {
                self.unknown(cl_line, "AUXFUN", Effect::Auxiliary);
            }
            self.may_have(&format!("M{code}"));
            self.ask_auxiliary(cl_line, Some(code));
        }
    }

    pub(super) fn unknown(&mut self, cl_line: u32, what: &str, effect: Effect) {
        let open = match effect {
            Effect::Auxiliary => "what its M function does was not compared",
            Effect::Words | Effect::WordsOrOffset | Effect::AnyWords => {
                "what it writes was not compared"
            }
            Effect::Path | Effect::Doubtful(_) => {
                "the CL file does not give its path; nothing after it was compared"
            }
        };
        self.report
            .leave_open(Unverified { cl_line: Some(cl_line), what: format!("{what}: {open}") });
        if self.user.lines[1] != u32::MAX {
            self.pass_own();
            let next = self.nc.line(self.next).unwrap_or(u32::MAX - 1);
            self.user.lines = [self.last_line(), next];
        }
        let is_over = matches!(effect, Effect::Path | Effect::Doubtful(_));
        if is_over || effect == Effect::AnyWords {
            self.auxiliaries.open(self.last_line());
        }
        self.over |= is_over;
        if let Effect::Doubtful(kind) = effect {
            let line = self.next_line();
            self.find(kind, Some(cl_line), Some(line).filter(|line| *line > 0), what.to_string());
        }
    }

    /// Line of the last event that was passed.
    pub(super) fn last_line(&self) -> u32 {
        let last = self.next.checked_sub(1).and_then(|at| self.nc.get(at));
        last.map_or(1, |event| event.line())
    }

    pub(super) fn end(&mut self, cl_line: u32, end: End) {
        if self.expected.ends_milling(self.settings) {
            self.ask_auxiliary(cl_line, self.settings.spindle_mode_code(false));
        }
        self.go_home_at_end(cl_line);
        self.pass(cl_line);
        while !self.at_end() {
            self.extra(1, cl_line);
            self.pass(cl_line);
        }
        self.expected.ends_counting_side(self.settings);
        self.take_blocks(&self.settings.end_blocks());
        match self.nc.get(self.next) {
            Some(Event::End { line, code, modes }) => {
                self.next += 1;
                self.check_standing(cl_line, line, &modes, false);
                let must = self.settings.end_code(end);
                if code != must && !self.own.has(line) {
                    let found = code.map_or("without a code".to_string(), |m| format!("with M{m}"));
                    let wanted = match must {
                        Some(must) => format!("it should be M{must}"),
                        None => "the settings have no code for it".to_string(),
                    };
                    let message = format!("the program ends {found}, {wanted}");
                    self.find(FindingKind::End, Some(cl_line), Some(line), message);
                }
            }
            None if self.settings.has_end_code() => {
                let message = "the program has no end".to_string();
                self.find(FindingKind::End, Some(cl_line), None, message);
            }
            _ => {}
        }
        self.extra(usize::MAX, cl_line);
    }

    /// Coolant and spindle off and the way home, where the settings end programs so.
    fn go_home_at_end(&mut self, cl_line: u32) {
        if self.settings.switches_off_at_change() {
            self.take_blocks(&self.settings.blocks_of_switching_off());
        }
        let to = self.settings.home_at_end(self.limits.metric);
        if to != [None; 3] {
            self.is_at_machine(cl_line, to);
        }
        if self.settings.turns_home_at_end() {
            self.turn_home(cl_line);
        }
    }

    pub(super) fn ends_early(&mut self, step: &Step) {
        let mut missing = 1;
        while let Some(step) = self.cl.next() {
            missing += u64::from(step.what.end().is_some());
        }
        self.report.compared += missing - 1;
        let nc_line = match self.nc.get(self.next) {
            Some(Event::End { line, .. }) => Some(line),
            _ => None,
        };
        let motions = if missing == 1 { "motion is" } else { "motions are" };
        let message = format!("the program ends here; {missing} {motions} missing");
        self.find(FindingKind::Missing, Some(step.line), nc_line, message);
        self.over = true;
    }
}
