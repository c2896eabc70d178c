//! Walks along the steps of a CL file and the events of a program at once.

mod reach;
mod state;

use fil_diag::Diag;

use super::ahead::{Ahead, Steps};
use super::align::Detour;
use super::auxiliaries::Auxiliaries;
use super::between::Watch;
use super::blocks::OwnBlocks;
use super::delayed::Moved;
use super::event_filter::{EventFilter, NonMotionEvents};
use super::expected_step::{ExpectedStep, Step};
use super::machine_blocks::MachineBlockEffects;
use super::modes::Expected;
use super::places::Places;
use super::report::{Finding, FindingKind, Report};
use super::say::Shape;
use super::settings::{Settings, Tolerances};
use super::window::Window;
use crate::events::Events;
use crate::interpret::PassedOver;
use crate::motion::{Course, DRILLED, Event, Modes, Move, Position};
pub(super) use state::Fact;
use state::{AxisLimits, ENDED_BY_MOTION, Facts, LastMotion, StepMemory, UserWords};

/// What X is multiplied by when it is a diameter.
const DIAMETER: f64 = 2.0;

/// How far to look for the place where path and program agree again.
pub(super) const LOOK_AHEAD: usize = 8;

/// Ways shorter than this are none, mm or degrees.
pub(super) const STILL: f64 = 1e-9;

/// Goes along both.
pub(super) struct Verifier<'a, C> {
    pub(super) cl: Ahead<C>,
    pub(super) nc: Window<EventFilter<'a, NonMotionEvents>>,
    /// Index of the next event.
    pub(super) next: usize,
    pub(super) own: OwnBlocks<'a>,
    /// What the machine's own blocks are to switch.
    pub(super) blocks: MachineBlockEffects,
    /// What has begun that the user's blocks stand around.
    pub(super) places: Places,
    pub(super) auxiliaries: Auxiliaries,
    pub(super) settings: &'a Settings<'a>,
    pub(super) slack: Tolerances,
    pub(super) limits: AxisLimits,
    /// Diameter of the cutter, mm.
    pub(super) cutter: Option<f64>,
    pub(super) facts: Facts,
    pub(super) memory: StepMemory,
    /// Where the program is.
    pub(super) at: Position,
    pub(super) known: [bool; 5],
    /// Exact rotary positions that the tape shows rounded.
    pub(super) exact: [f64; 2],
    /// Z of the machine, as far as motions have said it, mm.
    pub(super) height: Option<f64>,
    pub(super) moved: LastMotion,
    pub(super) expected: Expected,
    pub(super) watch: Watch,
    pub(super) user: UserWords,
    /// What was reported of the last position, so that one fault is reported once.
    pub(super) said: Option<Shape>,
    pub(super) report: Report,
    /// The program can't be read on.
    pub(super) failed: Option<Box<Diag>>,
    pub(super) over: bool,
}

impl<'a, C: Steps> Verifier<'a, C> {
    pub(super) fn new(
        cl: C,
        nc: &'a mut dyn Events,
        own: OwnBlocks<'a>,
        settings: &'a Settings<'a>,
        watch: Watch,
    ) -> Self {
        Verifier {
            cl: Ahead::new(cl),
            nc: Window::new(EventFilter::new(nc, NonMotionEvents::new(settings))),
            next: 0,
            own,
            blocks: MachineBlockEffects::default(),
            places: Places::of(settings),
            auxiliaries: Auxiliaries::new(settings),
            settings,
            slack: settings.slack(true),
            limits: AxisLimits {
                metric: true,
                travel: settings.travel(true),
                written: settings.written(),
                splits_rapids: settings.splits_rapids(),
                x_scale: settings.x_scale(),
            },
            cutter: None,
            facts: Facts::at_start(),
            memory: StepMemory::default(),
            at: Position::default(),
            known: [false; 5],
            exact: [0.0; 2],
            height: None,
            moved: LastMotion::default(),
            expected: Expected::new(settings),
            watch,
            user: UserWords { lines: [u32::MAX, 0], repeated_feed: None, unasked: [None; 2] },
            said: None,
            report: Report::default(),
            failed: None,
            over: false,
        }
    }

    /// Goes through all steps; what was passed over must be an author's.
    ///
    /// # Errors
    /// What can't be read of the program or the CL file.
    pub(super) fn all(mut self, passed: &PassedOver) -> Result<Report, Box<Diag>> {
        let mut ended = false;
        while !self.over
            && let Some(step) = self.cl.next()
        {
            ended = matches!(step.what, ExpectedStep::End(_));
            self.step(&step);
        }
        let finished = self.nc.finish();
        let refused = passed.take();
        self.own.leave_open(&refused, &mut self.report)?;
        let mut beside = finished?.into_watcher();
        beside.auxiliaries.extend(self.own.functions_of(&refused));
        beside.auxiliaries.sort_by_key(|(line, _)| *line);
        if let Some(diag) = self.failed.or(self.cl.failed) {
            return Err(diag);
        }
        if !self.over && ended {
            let around = self.settings.blocks_of_changes(self.blocks.changes);
            let missing = self.own.missing().into_iter().chain(self.own.missing_around(&around));
            missing.for_each(|text| {
                self.report.find(Finding {
                    kind: FindingKind::Block,
                    cl_line: None,
                    nc_line: None,
                    message: format!("the block `{text}` of the settings is not there"),
                });
            });
        }
        self.report.append(self.auxiliaries.compare(&beside.auxiliaries, &self.own));
        if let Some(turns) = beside.turns.take().filter(|_| !self.over) {
            self.report.append(turns.compare(&self.own, self.settings));
        }
        self.report.append(beside.broken_rules());
        // Whatever was not made has been said; this holds if something was forgotten.
        let report = &mut self.report;
        if report.findings.is_empty() && report.matched < report.compared {
            let missing = report.compared - report.matched;
            report.find(Finding {
                kind: FindingKind::Missing,
                cl_line: None,
                nc_line: None,
                message: format!("{missing} motions are not made as the CL file asks"),
            });
        }
        Ok(self.report)
    }

    pub(super) fn step(&mut self, step: &Step) {
        if !self.places.are_on {
            return self.carry_out(step);
        }
        self.ask_texts_before(step);
        self.carry_out(step);
        self.ask_texts_after(step);
    }

    fn carry_out(&mut self, step: &Step) {
        // A text may ask which event came before.
        self.nc.forget(self.next.saturating_sub(1));
        self.settle_held_stops(&step.what);
        let offset = self.expected.fixture.must;
        self.expected.take(&step.what, self.settings);
        match &step.what {
            ExpectedStep::WorkOffset(_) if offset != self.expected.fixture.must => {
                self.go_up_for_offset(step.line);
            }
            ExpectedStep::Metric(metric) => {
                self.limits.metric = *metric;
                self.slack = self.settings.slack(*metric);
                self.limits.travel = self.settings.travel(*metric);
            }
            ExpectedStep::Home => {
                self.go_to_machine(step.line, self.settings.home(self.limits.metric))
            }
            ExpectedStep::Retract => self.retract(step.line),
            ExpectedStep::Turn { index, angle, way } => self.turn(step.line, *index, *angle, *way),
            ExpectedStep::Cutter(diameter) => {
                self.cutter = Some(*diameter);
                self.facts.set(Fact::FreshCutter, true);
            }
            ExpectedStep::Mills(mills) if self.settings.is_mill_turn() => {
                self.ask_spindle_mode(step.line, *mills);
            }
            ExpectedStep::Mills(mills) => self.scale_x(if *mills { 1.0 } else { DIAMETER }),
            ExpectedStep::CycleEnd => {
                self.end_cycle(step.line);
                self.moved.in_cycle = false;
            }
            ExpectedStep::ThreadBegins => self.memory.thread_turns = None,
            ExpectedStep::Straight(within) => self.watch.ask(*within),
            ExpectedStep::LeftOut => self.watch.begin_elsewhere(self.settings.divides_within()),
            ExpectedStep::Tool { number, offset, by_hand } => {
                self.facts.set(Fact::FreshHeight, self.settings.restates_after_change());
                let offset = self.settings.tool_offset(*number, *offset);
                let changes = self.tool(step.line, *number, offset, *by_hand);
                self.cutter = self.cutter.filter(|_| self.facts.has(Fact::FreshCutter));
                if changes {
                    self.facts.set(Fact::FreshTool, true);
                    self.memory.machine_at = [None; 5];
                }
            }
            ExpectedStep::ToolLeftOut { number, offset } => {
                let offset = self.settings.tool_offset(*number, *offset);
                self.expected.leave_tool_out(*number, offset, self.settings);
            }
            ExpectedStep::Dwell(seconds) => self.dwell(step.line, *seconds, None),
            ExpectedStep::DwellTurns(turns) => {
                let speed =
                    self.expected.turns_a_minute().or_else(|| self.turns_at_surface_speed());
                let speed = speed.filter(|_| self.settings.waits_seconds());
                let seconds = speed.map(|speed| turns * 60.0 / speed);
                self.dwell(step.line, seconds, Some(*turns));
            }
            ExpectedStep::Insert { text, may_be_skipped } => {
                for text in self.settings.blocks_of_text(text) {
                    self.insert(step.line, text, *may_be_skipped);
                }
            }
            ExpectedStep::Words(text) => self.ask_words(step.line, text),
            ExpectedStep::WholeThread(thread) => self.whole_thread(step.line, thread),
            // Which spindle is counted, and how it turns, the modes of the motions say.
            ExpectedStep::SideSpindle(_) if self.settings.dialect.turning.counted.is_chosen() => {}
            ExpectedStep::SideSpindle(turn) => {
                self.ask_auxiliary(step.line, self.settings.side_spindle_code(*turn));
            }
            ExpectedStep::Unknown { what, effect } => self.unknown(step.line, what, *effect),
            ExpectedStep::Repeated(text) => {
                let of_feed = text.split(' ').find_map(|word| word.strip_prefix('F'));
                self.user.repeated_feed = of_feed.and_then(|value| value.parse().ok());
                if !text.is_empty() {
                    self.user.lines[1] = u32::MAX;
                }
            }
            ExpectedStep::Stop { optional } => {
                let code = self.settings.stop_code(*optional);
                self.memory.held_stops.extend(code.map(|code| (step.line, code)));
            }
            ExpectedStep::OverrideLock(on) => {
                self.ask_auxiliary(step.line, self.settings.override_lock(*on))
            }
            ExpectedStep::Clamp(on) => self.ask_auxiliary(step.line, self.settings.clamp_code(*on)),
            ExpectedStep::Auxiliary(code) => self.auxiliary(step.line, *code),
            ExpectedStep::Unfollowed => self.expected.unfollowed = true,
            ExpectedStep::End(end) => self.end(step.line, *end),
            _ if step.what.end().is_some() => self.motion(step),
            _ => {}
        }
    }

    pub(super) fn motion(&mut self, step: &Step) {
        let corrected = self.corrected(step);
        let step = corrected.as_ref().unwrap_or(step);
        let made = self.is_made(step);
        // Said again at the same number, Z has come down too.
        self.facts.set(Fact::FreshHeight, false);
        self.watch
            .stand(step.what.end().filter(|_| made && !matches!(step.what, ExpectedStep::Hole(_))));
    }

    /// Goes through what the program does for a motion; false when that is another.
    fn is_made(&mut self, step: &Step) -> bool {
        self.report.compared += 1;
        if !matches!(step.what, ExpectedStep::Hole(_)) {
            self.memory.initial = None;
        }
        match &step.what {
            ExpectedStep::Rapid(pose) => self.go_up_for_turns(step.line, pose),
            ExpectedStep::Hole(hole) => self.go_up_for_turns(step.line, &hole.start),
            _ => {}
        }
        let rests = self.at.tip_control && self.rests_before_tip_end(step);
        if rests || self.rests_before_machine(step) {
            self.report.matched += 1;
            return true;
        }
        loop {
            if !self.goes_on()
                && let Some(next) = self.pass(step.line)
            {
                self.forget_tip(&next);
                self.at = self.at_as(&next);
            }
            if let ExpectedStep::Feed(pose, rate) = &step.what
                && self.repositions(step.line, pose, *rate)
            {
                continue;
            }
            if let ExpectedStep::Rapid(pose) = &step.what
                && self.repositions_at_rapid(step.line, pose)
            {
                continue;
            }
            if self.makes(step) {
                self.report.matched += 1;
                self.settle(step.line);
                return true;
            }
            if self.at_end() {
                self.ends_early(step);
                return false;
            }
            if let ExpectedStep::Feed(pose, rate) = &step.what
                && self.parts_beside(step.line, pose, *rate)
            {
                return false;
            }
            match self.detour(step) {
                Detour::Missing => {
                    let what = self.spell_step(&step.what);
                    self.find(FindingKind::Missing, Some(step.line), None, format!("no {what}"));
                    return false;
                }
                Detour::Extra(count) => self.extra(count, step.line),
                Detour::Other => {
                    self.other(step);
                    return false;
                }
            }
        }
    }

    /// Takes the events that make a step; false when the next ones don't.
    pub(super) fn makes(&mut self, step: &Step) -> bool {
        match &step.what {
            ExpectedStep::Rapid(pose) => self.rapid(step.line, pose),
            ExpectedStep::Feed(pose, rate) => self.line(step.line, pose, Course::Feed, *rate),
            ExpectedStep::Thread(pose, lead) => {
                if let Some(pass) = self.next_move().filter(|pass| pass.course == Course::Thread) {
                    self.check_turns_of_pass(step.line, &pass);
                    self.check_joins(step.line, &pass);
                }
                self.line(step.line, pose, Course::Thread, Some(*lead))
            }
            ExpectedStep::Arc(arc, rate) => self.arc(step.line, arc, *rate),
            ExpectedStep::Hole(hole) => self.hole(step.line, hole),
            _ => true,
        }
    }

    pub(super) fn next_move(&self) -> Option<Move> {
        self.nc.motion(self.next)
    }

    /// Takes the next motion if it goes along Z alone, to a level, and says whether it did.
    pub(super) fn takes_to_level(&mut self, cl_line: u32, level: f64, rapid: bool) -> bool {
        let slack = self.slack.linear[2];
        let to_level = self.next_move().filter(|found| {
            (found.course == Course::Rapid || !rapid)
                && (found.to.linear[2] - level).abs() <= slack
                && found.to.linear[..2] == self.at.linear[..2]
        });
        if let Some(found) = &to_level {
            self.take(cl_line, found);
            self.next += 1;
        }
        to_level.is_some()
    }

    pub(super) fn at_end(&self) -> bool {
        self.nc.look(self.next, |event| matches!(event, Event::End { .. })).unwrap_or(true)
    }

    /// Takes a motion: its modes, its limits, where it goes.
    pub(super) fn take(&mut self, cl_line: u32, found: &Move) {
        let at = self.at_as(found);
        let ends_tip = self.moved.tip && !found.to.tip_control;
        let differs = |n: usize| {
            let way = (found.to.linear[n] - at.linear[n]).abs();
            let turns = found.arc.is_some_and(|arc| arc.normal != n);
            turns || way > STILL || (found.known[n] && !self.known[n])
        };
        let normal = match self.expected.plane_of_live_tool() {
            Some(normal) => normal,
            None => found.modes.planes.unusual.map_or(DRILLED, |(normal, _)| normal),
        };
        let moved = Moved {
            xy: differs(0) || differs(1),
            z: differs(2) && !(ends_tip && found.course == Course::Machine),
            in_plane: (0..3).any(|n| n != normal && differs(n)),
        };
        if moved.xy || moved.z {
            ENDED_BY_MOTION.iter().for_each(|fact| self.facts.set(*fact, false));
        }
        self.facts.end_unless(Fact::FreshHeight, !moved.z);
        let cuts = matches!(found.course, Course::Feed | Course::Thread);
        if ends_tip && found.modes.length.offset.is_none() {
            self.expected.length_is_taken_off();
        }
        let wrong = match moved.xy || moved.z || !self.is_still(found) {
            true => self.expected.check(&found.modes, moved, cuts, &self.slack),
            false => self.expected.check_resting(&found.modes, &self.slack),
        };
        for (kind, message) in wrong {
            self.find(kind, Some(cl_line), Some(found.line), message);
        }
        self.check_unasked(cl_line, found.line, &found.modes);
        self.check_plane(cl_line, found);
        self.check_limits(cl_line, found);
        self.check_bend(cl_line, found);
        self.leaves_or_comes(found);
        self.follow_groove(found);
        self.follow_height(found, cuts);
        self.facts.set(Fact::Up, false);
        self.memory.rapid_end = None;
        self.at = found.to;
        let plane = self.moved.plane;
        let tip = found.to.tip_control;
        self.moved = LastMotion {
            line: found.line,
            in_cycle: found.in_cycle,
            modes: found.modes,
            tip,
            plane,
        };
        self.known = found.known;
        self.facts.add_if(Fact::HadHeight, found.known[2]);
    }

    /// What must be in force while the axes stand.
    pub(super) fn check_standing(
        &mut self,
        cl_line: u32,
        nc_line: u32,
        modes: &Modes,
        changes: bool,
    ) {
        self.check_unasked(cl_line, nc_line, modes);
        for (kind, message) in self.expected.check_standing(modes, changes, &self.slack) {
            self.find(kind, Some(cl_line), Some(nc_line), message);
        }
    }

    /// After the first motion with a new tool its length offset is on.
    pub(super) fn settle(&mut self, cl_line: u32) {
        if !self.expected.offset_waits() {
            return;
        }
        self.pass(cl_line);
        if let Some((kind, message)) = self.expected.settle() {
            self.find(kind, Some(cl_line), Some(self.moved.line), message);
        }
    }

    pub(super) fn find(
        &mut self,
        kind: FindingKind,
        cl_line: Option<u32>,
        nc_line: Option<u32>,
        message: String,
    ) {
        self.report.find(Finding { kind, cl_line, nc_line, message });
    }
}
