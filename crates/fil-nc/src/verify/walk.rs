//! Walks along the steps of a CL file and the events of a program at once.

use std::collections::VecDeque;

use fil_diag::Diag;

use super::blocks::OwnBlocks;
use super::gap::Gap;
use super::modes::{Expected, Moved};
use super::report::{Finding, Kind, Report, Unverified};
use super::settings::{Settings, Slack};
use super::wanted::{Step, Wanted};
use crate::forward::Pose;
use crate::motion::{Course, Event, Move, Position, Rate};

/// How far to look for the place where path and program agree again.
const LOOK_AHEAD: usize = 8;

/// Most blocks of one rapid.
const RAPID_PARTS: usize = 4;

/// Ways shorter than this are none, mm or degrees.
const STILL: f64 = 1e-9;

/// The steps to come.
pub(super) struct Ahead<C> {
    steps: C,
    seen: VecDeque<Step>,
    /// The CL file can't be read on.
    pub(super) failed: Option<Box<Diag>>,
}

impl<C: Iterator<Item = Result<Step, Box<Diag>>>> Ahead<C> {
    fn new(steps: C) -> Self {
        Ahead { steps, seen: VecDeque::new(), failed: None }
    }

    fn read(&mut self) -> Option<Step> {
        match self.steps.next()? {
            Ok(step) => Some(step),
            Err(diag) => {
                self.failed = Some(diag);
                None
            }
        }
    }

    fn next(&mut self) -> Option<Step> {
        self.seen.pop_front().or_else(|| self.read())
    }

    /// The `n`th step to come, from 0.
    fn peek(&mut self, n: usize) -> Option<&Step> {
        while self.seen.len() <= n {
            let step = self.read()?;
            self.seen.push_back(step);
        }
        self.seen.get(n)
    }
}

/// How path and program come together again.
enum Detour {
    /// The program lacks the step.
    Missing,
    /// The program has so many events too many.
    Extra(usize),
    /// The next motion stands for the step, but differs.
    Other,
}

pub(super) struct Walk<'a, C> {
    pub(super) cl: Ahead<C>,
    pub(super) nc: &'a [Event],
    /// Index of the next event.
    pub(super) next: usize,
    pub(super) own: OwnBlocks<'a>,
    pub(super) settings: &'a Settings<'a>,
    pub(super) slack: Slack,
    pub(super) metric: bool,
    /// Travel of the linear axes, mm.
    travel: [(f64, f64); 3],
    written: [bool; 3],
    splits_rapids: bool,
    /// Where the program stands.
    pub(super) at: Position,
    pub(super) known: [bool; 5],
    pub(super) modes: Expected,
    /// Level the control's cycle began from.
    pub(super) initial: Option<f64>,
    /// How far single moves stay above the last peck.
    pub(super) peck_gap: Option<f64>,
    /// What was said of the last position, so that one fault is said once.
    said: Option<([f64; 3], Option<f64>)>,
    pub(super) report: Report,
    over: bool,
}

impl<'a, C: Iterator<Item = Result<Step, Box<Diag>>>> Walk<'a, C> {
    pub(super) fn new(
        cl: C,
        nc: &'a [Event],
        own: OwnBlocks<'a>,
        settings: &'a Settings<'a>,
    ) -> Self {
        Walk {
            cl: Ahead::new(cl),
            nc,
            next: 0,
            own,
            settings,
            slack: settings.slack(true),
            metric: true,
            travel: settings.travel(true),
            written: settings.written(),
            splits_rapids: settings.splits_rapids(),
            at: Position::default(),
            known: [false; 5],
            modes: Expected::new(settings),
            initial: None,
            peck_gap: None,
            said: None,
            report: Report::default(),
            over: false,
        }
    }

    /// Goes through all steps.
    pub(super) fn all(mut self) -> Result<Report, Box<Diag>> {
        let mut ended = false;
        while !self.over
            && let Some(step) = self.cl.next()
        {
            ended = matches!(step.what, Wanted::End);
            self.step(&step);
        }
        if let Some(diag) = self.cl.failed {
            return Err(diag);
        }
        if !self.over && ended {
            self.own.missing().into_iter().for_each(|text| {
                self.report.find(Finding {
                    kind: Kind::Block,
                    cl_line: None,
                    nc_line: None,
                    message: format!("the block `{text}` of the settings is not there"),
                });
            });
        }
        Ok(self.report)
    }

    fn step(&mut self, step: &Step) {
        self.modes.take(&step.what, self.settings);
        match &step.what {
            Wanted::Metric(metric) => {
                self.metric = *metric;
                self.slack = self.settings.slack(*metric);
                self.travel = self.settings.travel(*metric);
            }
            Wanted::CycleEnd => self.initial = None,
            Wanted::Tool { number, offset } => self.tool(step.line, *number, *offset),
            Wanted::Dwell(seconds) => self.dwell(step.line, *seconds),
            Wanted::Insert(text) => self.insert(step.line, text),
            Wanted::Unknown { what, ends } => self.unknown(step.line, what, *ends),
            Wanted::End => self.end(step.line),
            _ if step.what.end().is_some() => self.motion(step),
            _ => {}
        }
    }

    fn motion(&mut self, step: &Step) {
        self.report.compared += 1;
        if !matches!(step.what, Wanted::Hole(_)) {
            self.initial = None;
        }
        loop {
            self.pass(step.line);
            if self.makes(step) {
                self.report.matched += 1;
                return;
            }
            if self.at_end() {
                return self.ends_early(step);
            }
            match self.detour(step) {
                Detour::Missing => {
                    let what = self.spell_step(&step.what);
                    return self.find(Kind::Missing, Some(step.line), None, format!("no {what}"));
                }
                Detour::Extra(count) => self.extra(count, step.line),
                Detour::Other => return self.other(step),
            }
        }
    }

    /// Takes the events that make a step; false when the next ones don't.
    fn makes(&mut self, step: &Step) -> bool {
        match &step.what {
            Wanted::Rapid(pose) => self.rapid(step.line, pose),
            Wanted::Feed(pose, rate) => self.line(step.line, pose, Course::Feed, *rate),
            Wanted::Thread(pose, pitch) => {
                self.line(step.line, pose, Course::Thread, Some(Rate::PerTurn(*pitch)))
            }
            Wanted::Arc(arc, rate) => self.arc(step.line, arc, *rate),
            Wanted::Hole(hole) => self.hole(step.line, hole),
            _ => true,
        }
    }

    /// A rapid in one block or in parts.
    fn rapid(&mut self, cl_line: u32, pose: &Pose) -> bool {
        if self.stands_at(pose) {
            return true;
        }
        let Some(count) = self.rapid_parts(self.next, pose) else { return false };
        let last = self.next + count - 1;
        let Event::Move(end) = self.nc[last] else { return false };
        for index in self.next..=last {
            if let Event::Move(part) = self.nc[index] {
                self.check_part(cl_line, &part, &end.to);
                self.take(cl_line, &part);
            }
        }
        self.measure(&end, pose);
        self.next = last + 1;
        true
    }

    /// How many rapids from `index` on reach a pose.
    fn rapid_parts(&self, index: usize, pose: &Pose) -> Option<usize> {
        let rapids =
            self.nc.get(index..)?.iter().take(RAPID_PARTS).map_while(|event| match event {
                Event::Move(part) if part.course == Course::Rapid && !part.in_cycle => Some(part),
                _ => None,
            });
        rapids.into_iter().position(|part| self.reaches(part, pose)).map(|at| at + 1)
    }

    /// Each axis stays or ends in a part of a rapid, and the height is the safe one.
    fn check_part(&mut self, cl_line: u32, part: &Move, end: &Position) {
        let splits = self.splits_rapids;
        let at = self.at.linear;
        let known = self.known;
        let same = |a: f64, b: f64| (a - b).abs() <= STILL;
        let moved = |n: usize| !same(part.to.linear[n], at[n]);
        let arrived = |n: usize| same(part.to.linear[n], end.linear[n]);
        let mut say = |message: String| {
            self.find(Kind::Order, Some(cl_line), Some(part.line), message);
        };
        if (0..3).any(|n| moved(n) && !arrived(n) && known[n]) {
            let [x, y, z] = part.to.linear.map(short);
            say(format!("rapid by way of X{x} Y{y} Z{z}, which is on no way to its end"));
        }
        if !splits || !known[2] {
            return;
        }
        let lower = moved(2) && part.to.linear[2] < at[2];
        if lower && !(arrived(0) && arrived(1)) {
            say("rapid plunges before X and Y have arrived".to_string());
        }
        let across = (moved(0) || moved(1)) && !moved(2);
        if across && end.linear[2] > at[2] + STILL {
            say("rapid goes across before Z has gone up".to_string());
        }
    }

    /// A straight line at feed, or a thread pass.
    fn line(&mut self, cl_line: u32, pose: &Pose, course: Course, rate: Option<Rate>) -> bool {
        match self.next_move() {
            Some(found) if is_line(&found, course) && self.reaches(&found, pose) => {
                self.check_rate(cl_line, &found, rate);
                self.take(cl_line, &found);
                self.measure(&found, pose);
                self.next += 1;
                true
            }
            _ => self.stands_at(pose),
        }
    }

    /// Passes over events that no step asks for: motions to points of the machine,
    /// blocks of the settings, ways of no length.
    pub(super) fn pass(&mut self, cl_line: u32) {
        loop {
            match self.nc.get(self.next).copied() {
                Some(Event::Move(found)) if self.own.has(found.line) => self.stand(&found),
                Some(Event::Move(found)) if found.course == Course::Machine => {
                    self.stand(&found);
                    let message = "goes to a point of the machine that neither the CL file nor the settings ask for";
                    self.find(Kind::Extra, Some(cl_line), Some(found.line), message.to_string());
                }
                Some(Event::Move(found)) if self.is_still(&found) => self.stand(&found),
                Some(Event::Dwell { line, .. }) if self.own.has(line) => self.next += 1,
                _ => return,
            }
        }
    }

    /// Goes where a motion goes without a look at it.
    fn stand(&mut self, found: &Move) {
        self.at = found.to;
        self.known = found.known;
        self.next += 1;
    }

    fn is_still(&self, found: &Move) -> bool {
        let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= STILL);
        found.arc.is_none()
            && same(&found.to.linear, &self.at.linear)
            && same(&found.to.rotary, &self.at.rotary)
    }

    pub(super) fn next_move(&self) -> Option<Move> {
        match self.nc.get(self.next)? {
            Event::Move(found) => Some(*found),
            _ => None,
        }
    }

    pub(super) fn at_end(&self) -> bool {
        matches!(self.nc.get(self.next), None | Some(Event::End { .. }))
    }

    /// True when the tool already is where a pose asks it to be.
    pub(super) fn stands_at(&self, pose: &Pose) -> bool {
        self.is_known(&self.known) && Gap::of(self.settings, &self.slack, &self.at, pose).closed()
    }

    pub(super) fn reaches(&self, found: &Move, pose: &Pose) -> bool {
        self.is_known(&found.known) && Gap::of(self.settings, &self.slack, &found.to, pose).closed()
    }

    /// All axes that the program writes are known.
    fn is_known(&self, known: &[bool; 5]) -> bool {
        let linear = (0..3).all(|n| known[n] || !self.written[n]);
        let rotary = |n: usize| known[n + 3] || self.settings.forward.rotaries()[n].is_none();
        linear && rotary(0) && rotary(1)
    }

    /// Takes a motion: its modes, its limits, where it goes.
    pub(super) fn take(&mut self, cl_line: u32, found: &Move) {
        let differs = |n: usize| (found.to.linear[n] - self.at.linear[n]).abs() > STILL;
        let moved = Moved { xy: differs(0) || differs(1), z: differs(2) };
        let cuts = matches!(found.course, Course::Feed | Course::Thread);
        for (kind, message) in self.modes.check(&found.modes, moved, cuts, self.slack.speed) {
            self.find(kind, Some(cl_line), Some(found.line), message);
        }
        self.check_limits(cl_line, found);
        self.at = found.to;
        self.known = found.known;
    }

    fn check_limits(&mut self, cl_line: u32, found: &Move) {
        for (n, (min, max)) in self.travel.into_iter().enumerate() {
            let value = found.to.linear[n];
            if !(min..=max).contains(&value) {
                let axis = ["X", "Y", "Z"][n];
                let message =
                    format!("{axis}{} lies outside the travel {min} to {max}", short(value));
                self.find(Kind::Limit, Some(cl_line), Some(found.line), message);
            }
        }
        for n in 0..2 {
            let Some(axis) = &self.settings.forward.rotaries()[n] else { continue };
            let value = found.to.rotary[n];
            let low = axis.min.is_some_and(|min| value < min - self.slack.rotary[n]);
            let high = axis.max.is_some_and(|max| value > max + self.slack.rotary[n]);
            if low || high {
                let letter = char::from(b'A' + axis.letter.clamp(1, 26) - 1);
                let message =
                    format!("{letter}{} lies outside the travel of the axis", short(value));
                self.find(Kind::Limit, Some(cl_line), Some(found.line), message);
            }
        }
    }

    /// Adds a motion to the deviations.
    pub(super) fn measure(&mut self, found: &Move, pose: &Pose) {
        let gap = Gap::of(self.settings, &self.slack, &found.to, pose);
        self.report.position.add(gap.tip, found.line);
        self.report.axis.add(gap.axis, found.line);
        if gap.closed() {
            self.said = None;
        }
    }

    pub(super) fn check_rate(&mut self, cl_line: u32, found: &Move, wanted: Option<Rate>) {
        let wanted = match wanted {
            Some(Rate::PerMinute(rate)) => {
                Rate::PerMinute(self.settings.feed_within(rate, self.metric))
            }
            Some(rate) => rate,
            None => return,
        };
        let agrees = match (wanted, found.rate) {
            (Rate::PerMinute(a), Some(Rate::PerMinute(b)))
            | (Rate::PerTurn(a), Some(Rate::PerTurn(b)))
            | (Rate::Inverse(a), Some(Rate::Inverse(b))) => (a - b).abs() <= self.slack.feed,
            _ => false,
        };
        if !agrees {
            let found_rate = found.rate.map_or("none".to_string(), spell_rate);
            let message = format!("feed {found_rate}, it should be {}", spell_rate(wanted));
            self.find(Kind::Feed, Some(cl_line), Some(found.line), message);
        }
    }

    pub(super) fn find(
        &mut self,
        kind: Kind,
        cl_line: Option<u32>,
        nc_line: Option<u32>,
        message: String,
    ) {
        self.report.find(Finding { kind, cl_line, nc_line, message });
    }

    fn tool(&mut self, cl_line: u32, number: u32, offset: u32) {
        self.initial = None;
        let same = self.modes.tool() == Some(number) && self.settings.tool_is_modal();
        let changes = !same && self.settings.calls_tools();
        if changes {
            self.to_change_position(cl_line);
        }
        self.modes.change_tool(number, offset, self.settings);
        if !changes {
            return;
        }
        let changes = self.nc[self.next..]
            .iter()
            .take(LOOK_AHEAD)
            .position(|event| matches!(event, Event::ToolChange { .. }));
        let Some(changes) = changes else {
            return self.find(
                Kind::Tool,
                Some(cl_line),
                None,
                format!("no change to tool {number}"),
            );
        };
        self.extra(changes, cl_line);
        if let Some(Event::ToolChange { line, tool }) = self.nc.get(self.next).copied() {
            self.next += 1;
            if tool != number {
                let message = format!("changes to tool {tool}, it should be tool {number}");
                self.find(Kind::Tool, Some(cl_line), Some(line), message);
            }
        }
        self.to_offset_level(cl_line);
    }

    /// The rapids to the position where the machine changes tools.
    fn to_change_position(&mut self, cl_line: u32) {
        self.pass(cl_line);
        let wanted = self.settings.change_position(self.metric);
        let value = |at: &Position, n: usize| {
            if n < 3 { at.linear[n] } else { at.rotary[n - 3] }
        };
        let near = |at: &Position, n: usize| match wanted[n] {
            Some(wanted) => {
                let slack = if n < 3 { self.slack.linear[n] } else { self.slack.rotary[n - 3] };
                (value(at, n) - wanted).abs() <= slack
            }
            None => true,
        };
        if (0..5).all(|n| near(&self.at, n)) {
            return;
        }
        let reached = self.nc[self.next..].iter().take(RAPID_PARTS).position(|event| match event {
            Event::Move(found) => {
                found.course == Course::Rapid && (0..5).all(|n| near(&found.to, n))
            }
            _ => false,
        });
        match reached {
            Some(reached) => {
                for _ in 0..=reached {
                    if let Some(found) = self.next_move() {
                        self.take(cl_line, &found);
                        self.next += 1;
                    }
                }
            }
            None => {
                let message = "no motion to the tool change position".to_string();
                self.find(Kind::Missing, Some(cl_line), None, message);
            }
        }
    }

    /// The Z motion that calls the length offset, where the settings have one.
    fn to_offset_level(&mut self, cl_line: u32) {
        let Some(level) = self.settings.offset_level(self.metric) else { return };
        let found = self.next_move().filter(|found| {
            (found.to.linear[2] - level).abs() <= self.slack.linear[2]
                && found.to.linear[..2] == self.at.linear[..2]
        });
        match found {
            Some(found) => {
                self.take(cl_line, &found);
                self.next += 1;
            }
            None => {
                let message = format!("the length offset is not called at Z{}", short(level));
                self.find(Kind::Tool, Some(cl_line), None, message);
            }
        }
    }

    fn dwell(&mut self, cl_line: u32, wanted: Option<f64>) {
        self.pass(cl_line);
        let Some(Event::Dwell { line, seconds }) = self.nc.get(self.next).copied() else {
            return self.find(Kind::Missing, Some(cl_line), None, "no dwell".to_string());
        };
        self.next += 1;
        let wanted = wanted.map(|wanted| self.settings.dwell_within(wanted));
        self.check_dwell(cl_line, line, seconds, wanted);
    }

    pub(super) fn check_dwell(
        &mut self,
        cl_line: u32,
        nc_line: u32,
        found: Option<f64>,
        wanted: Option<f64>,
    ) {
        let agrees = match (found, wanted) {
            (Some(found), Some(wanted)) => (found - wanted).abs() <= self.slack.dwell,
            (found, wanted) => found.is_none() && wanted.is_none(),
        };
        if !agrees {
            let spell = |seconds: Option<f64>| match seconds {
                Some(seconds) => format!("{} s", short(seconds)),
                None => "turns of the spindle".to_string(),
            };
            let message = format!("dwell of {}, it should be {}", spell(found), spell(wanted));
            self.find(Kind::Dwell, Some(cl_line), Some(nc_line), message);
        }
    }

    fn insert(&mut self, cl_line: u32, text: &str) {
        if !self.own.insert(text) {
            let message = format!("the block `{text}` of INSERT is not there");
            self.find(Kind::Block, Some(cl_line), None, message);
        }
    }

    fn unknown(&mut self, cl_line: u32, what: &str, ends: bool) {
        let what = if ends {
            format!(
                "{what}: the CL file does not say what path it makes; nothing after it was compared"
            )
        } else {
            format!("{what}: what it writes was not compared")
        };
        self.report.unverified.push(Unverified { cl_line, what });
        self.over |= ends;
    }

    fn end(&mut self, cl_line: u32) {
        self.pass(cl_line);
        let rest = self.nc[self.next..]
            .iter()
            .position(|event| matches!(event, Event::End { .. }))
            .unwrap_or(self.nc.len() - self.next);
        self.extra(rest, cl_line);
        match self.nc.get(self.next) {
            Some(_) => self.next += 1,
            None if self.settings.has_end_code() => {
                let message = "the program has no end".to_string();
                self.find(Kind::End, Some(cl_line), None, message);
            }
            None => {}
        }
        let after = self.nc.len() - self.next;
        self.extra(after, cl_line);
    }

    fn ends_early(&mut self, step: &Step) {
        let mut missing = 1;
        while let Some(step) = self.cl.next() {
            missing += u64::from(step.what.end().is_some());
        }
        self.report.compared += missing - 1;
        let nc_line = match self.nc.get(self.next) {
            Some(Event::End { line }) => Some(*line),
            _ => None,
        };
        let motions = if missing == 1 { "motion is" } else { "motions are" };
        let message = format!("the program ends here; {missing} {motions} missing");
        self.find(Kind::Missing, Some(step.line), nc_line, message);
        self.over = true;
    }

    /// Says that events of the program are too many, and passes over them.
    fn extra(&mut self, count: usize, cl_line: u32) {
        for _ in 0..count {
            self.pass(cl_line);
            let Some(event) = self.nc.get(self.next).copied() else { return };
            match event {
                Event::Move(found) => {
                    let what = self.spell_move(&found);
                    let message = format!("the CL file asks for no {what} here");
                    self.find(Kind::Extra, Some(cl_line), Some(found.line), message);
                    self.stand(&found);
                }
                Event::ToolChange { line, tool } => {
                    let message = format!("the CL file asks for no change to tool {tool} here");
                    self.find(Kind::Tool, Some(cl_line), Some(line), message);
                    self.next += 1;
                }
                Event::Dwell { line, .. } => {
                    let message = "the CL file asks for no dwell here".to_string();
                    self.find(Kind::Extra, Some(cl_line), Some(line), message);
                    self.next += 1;
                }
                Event::End { .. } => return,
            }
        }
    }

    /// Tells whether path and program agree again after leaving out parts of one.
    fn detour(&mut self, step: &Step) -> Detour {
        if !matches!(self.nc[self.next], Event::Move(_)) {
            let comes = match self.nc[self.next] {
                Event::ToolChange { tool, .. } => self.tool_comes(tool),
                _ => false,
            };
            return if comes { Detour::Missing } else { Detour::Extra(1) };
        }
        let missing = self.steps_left_out();
        let extra = self.nc[self.next..]
            .iter()
            .skip(1)
            .take(LOOK_AHEAD)
            .take_while(|event| !matches!(event, Event::ToolChange { .. }))
            .enumerate()
            .position(|(ahead, _)| self.fits(self.next + 1 + ahead, &step.what))
            .map(|at| at + 1);
        match (missing, extra) {
            (Some(missing), Some(extra)) if extra < missing => Detour::Extra(extra),
            (Some(_), _) => Detour::Missing,
            (None, Some(_)) if self.next_pair_fits() => Detour::Other,
            (None, Some(extra)) => Detour::Extra(extra),
            (None, None) => Detour::Other,
        }
    }

    /// After how many motions of the path the next event fits, if after any.
    fn steps_left_out(&mut self) -> Option<usize> {
        let mut motions = 0;
        for ahead in 0..4 * LOOK_AHEAD {
            let what = self.cl.peek(ahead)?.what.clone();
            if matches!(what, Wanted::Tool { .. }) || motions == LOOK_AHEAD {
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
    fn next_pair_fits(&mut self) -> bool {
        let mut ahead = 0;
        loop {
            let Some(what) = self.cl.peek(ahead).map(|step| step.what.clone()) else {
                return false;
            };
            if what.end().is_some() {
                return self.fits(self.next + 1, &what);
            }
            ahead += 1;
            if ahead > LOOK_AHEAD {
                return false;
            }
        }
    }

    /// A change to that tool comes within the next steps.
    fn tool_comes(&mut self, tool: u32) -> bool {
        let mut ahead = 0;
        while ahead < 4 * LOOK_AHEAD
            && let Some(step) = self.cl.peek(ahead)
        {
            if matches!(step.what, Wanted::Tool { number, .. } if number == tool) {
                return true;
            }
            ahead += 1;
        }
        false
    }

    /// The events from `index` on begin to do what a step asks for.
    fn fits(&self, index: usize, wanted: &Wanted) -> bool {
        let Some(Event::Move(found)) = self.nc.get(index) else { return false };
        match wanted {
            Wanted::Rapid(pose) => self.rapid_parts(index, pose).is_some(),
            Wanted::Feed(pose, _) => is_line(found, Course::Feed) && self.reaches(found, pose),
            Wanted::Thread(pose, _) => is_line(found, Course::Thread) && self.reaches(found, pose),
            Wanted::Arc(arc, _) => found.arc.is_some() && self.reaches(found, &arc.end),
            Wanted::Hole(hole) => self.is_over_hole(index, hole),
            _ => false,
        }
    }

    /// The next motion stands for a step, but is another one.
    fn other(&mut self, step: &Step) {
        let (Some(pose), Some(first)) = (step.what.end(), self.next_move()) else { return };
        if self.units_differ(step.line, &first, &pose) {
            return;
        }
        let rapid = matches!(step.what, Wanted::Rapid(_));
        let parts = if rapid { self.rapids_ahead().max(1) } else { 1 };
        let nearest = |index: &usize| match self.nc[*index] {
            Event::Move(found) => Gap::of(self.settings, &self.slack, &found.to, &pose).tip,
            _ => f64::MAX,
        };
        let chosen = (self.next..self.next + parts)
            .min_by(|a, b| nearest(a).total_cmp(&nearest(b)))
            .unwrap_or(self.next);
        let Event::Move(found) = self.nc[chosen] else { return };
        self.say_way(step, &found);
        self.say_gap(step.line, &found, &pose);
        for index in self.next..=chosen {
            if let Event::Move(part) = self.nc[index] {
                self.take(step.line, &part);
            }
        }
        self.measure(&found, &pose);
        self.next = chosen + 1;
    }

    fn rapids_ahead(&self) -> usize {
        let rapids = self.nc[self.next..].iter().take(RAPID_PARTS);
        rapids
            .take_while(
                |event| matches!(event, Event::Move(m) if m.course == Course::Rapid && !m.in_cycle),
            )
            .count()
    }

    /// Says that a motion is of another kind than the step.
    fn say_way(&mut self, step: &Step, found: &Move) {
        let way = (found.course, found.arc.is_some());
        let what = self.spell_move(found);
        let (kind, should) = match (&step.what, way) {
            (Wanted::Rapid(_), (Course::Rapid, _)) => return,
            (Wanted::Rapid(_), (Course::Feed, _)) => (Kind::FeedForRapid, "a rapid"),
            (Wanted::Feed(..), (Course::Feed, false)) => return,
            (Wanted::Feed(..), (Course::Rapid, _)) => (Kind::RapidForFeed, "a line at feed"),
            (Wanted::Feed(..), (Course::Feed, true)) => (Kind::Arc, "a straight line"),
            (Wanted::Thread(..), (Course::Thread, _)) => return,
            (Wanted::Thread(..), (Course::Rapid, _)) => (Kind::RapidForFeed, "a thread pass"),
            (Wanted::Thread(..), _) => (Kind::Thread, "a thread pass"),
            (Wanted::Arc(..), (Course::Rapid, _)) => (Kind::RapidForFeed, "an arc at feed"),
            (Wanted::Arc(..), (_, false)) => (Kind::Arc, "an arc"),
            (Wanted::Arc(..), _) => return self.say_arc(step, found),
            (_, (Course::Thread, _)) => (Kind::Thread, "a motion without lead"),
            _ => return,
        };
        let message = format!("{what}, it should be {should}");
        self.find(kind, Some(step.line), Some(found.line), message);
    }

    /// Says where a motion ends, when that is not where it should, and has not
    /// been said of the motion before.
    pub(super) fn say_gap(&mut self, cl_line: u32, found: &Move, pose: &Pose) {
        let gap = Gap::of(self.settings, &self.slack, &found.to, pose);
        if gap.closed() && self.is_known(&found.known) {
            return;
        }
        let shape = (
            std::array::from_fn(
                |n| if gap.excess[n] { (gap.linear[n] * 1e6).round() } else { 0.0 },
            ),
            gap.turned.map(|angle| (angle * 1e6).round()),
        );
        if self.said == Some(shape) {
            return;
        }
        self.said = Some(shape);
        let unknown = !self.is_known(&found.known);
        if let Some(angle) = gap.turned {
            let message = format!("the tool is tilted {} degrees away from its axis", short(angle));
            return self.find(Kind::Axis, Some(cl_line), Some(found.line), message);
        }
        let parts: Vec<String> = (0..3)
            .filter(|n| gap.excess[*n])
            .map(|n| spell_gap(n, found.to.linear[n], gap.linear[n]))
            .collect();
        let message = match (parts.is_empty(), unknown) {
            (true, _) => "moves before all axes have been given a position".to_string(),
            (false, _) => parts.join(", "),
        };
        self.find(Kind::Position, Some(cl_line), Some(found.line), message);
    }

    /// Says it when the whole program is in the other unit.
    fn units_differ(&mut self, cl_line: u32, found: &Move, pose: &Pose) -> bool {
        let wanted = self.settings.forward.frame(found.to.rotary).linear(pose.tip);
        let times = |factor: f64| {
            let mut large = false;
            let same = (0..3).filter(|n| found.known[*n]).all(|n| {
                large |= wanted[n].abs() > 1.0;
                (found.to.linear[n] * factor - wanted[n]).abs() < 0.02
            });
            same && large
        };
        let said = match () {
            () if times(1.0 / 25.4) => "is in inch, the CL file is in mm",
            () if times(25.4) => "is in mm, the CL file is in inch",
            () => return false,
        };
        let message = format!("the program {said}; nothing more was compared");
        self.find(Kind::Units, Some(cl_line), Some(found.line), message);
        self.over = true;
        true
    }

    fn spell_step(&self, wanted: &Wanted) -> String {
        let Some(pose) = wanted.end() else { return String::new() };
        let point = self.settings.forward.frame(self.at.rotary).linear(pose.tip);
        let [x, y, z] = point.map(short);
        match wanted {
            Wanted::Rapid(_) => format!("rapid to X{x} Y{y} Z{z}"),
            Wanted::Arc(..) => format!("arc to X{x} Y{y} Z{z}"),
            Wanted::Hole(_) => format!("hole at X{x} Y{y}"),
            Wanted::Thread(..) => format!("thread pass to X{x} Y{y} Z{z}"),
            _ => format!("line at feed to X{x} Y{y} Z{z}"),
        }
    }

    pub(super) fn spell_move(&self, found: &Move) -> String {
        let [x, y, z] = found.to.linear.map(short);
        let way = match (found.course, &found.arc) {
            (Course::Rapid, _) => "rapid",
            (Course::Machine, _) => "motion to a point of the machine",
            (Course::Thread, _) => "thread pass",
            (Course::Feed, None) => "line at feed",
            (Course::Feed, Some(arc)) if arc.ccw => "arc counterclockwise (G3)",
            (Course::Feed, Some(_)) => "arc clockwise (G2)",
        };
        format!("{way} to X{x} Y{y} Z{z}")
    }
}

/// A straight line of this course that no cycle makes.
fn is_line(found: &Move, course: Course) -> bool {
    found.course == course && found.arc.is_none() && !found.in_cycle
}

/// `Z deeper by 0.3`, `X 0.1 too far in plus`.
fn spell_gap(axis: usize, stands: f64, gap: f64) -> String {
    let by = short(gap.abs());
    let wanted = short(stands - gap);
    match (axis, gap < 0.0) {
        (2, true) => format!("Z deeper by {by} (Z{} in place of Z{wanted})", short(stands)),
        (2, false) => format!("Z higher by {by} (Z{} in place of Z{wanted})", short(stands)),
        _ => {
            let name = ["X", "Y", "Z"][axis];
            format!("{name} off by {by} ({name}{} in place of {name}{wanted})", short(stands))
        }
    }
}

fn spell_rate(rate: Rate) -> String {
    match rate {
        Rate::PerMinute(rate) => format!("{} mm/min", short(rate)),
        Rate::PerTurn(rate) => format!("{} mm a turn", short(rate)),
        Rate::Inverse(rate) => format!("{} blocks a minute", short(rate)),
    }
}

/// At most four decimals, no zeros at the end.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_string() } else { text.to_string() }
}
