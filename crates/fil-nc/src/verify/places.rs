//! The user's blocks around operations, cycles, work offsets and turns of the rotary axes: each
//! stands where these begin and end. Where operations and cycles do the CL file says; where axes turn
//! is seen in the program.

use fil_cl::operation_sign::Operations;
use fil_machine::locations as loc;
use fil_machine::user_blocks::{self, Around, Numbers, UserBlocks};

use super::ahead::Steps;
use super::blocks::OwnBlocks;
use super::expected_step::{ExpectedStep, Step};
use super::report::{Finding, FindingKind, Report};
use super::settings::Settings;
use super::verifier::{STILL, Verifier};
use crate::motion::{Course, Event, Move};

/// What has begun that such blocks stand around.
#[derive(Debug, Default)]
pub(super) struct Places {
    /// The settings have such blocks.
    pub(super) are_on: bool,
    operations: Operations,
    /// Holes of a cycle were drilled.
    in_cycle: bool,
    /// The work offset whose blocks were asked for last, by its function and by its number.
    offset: Option<Option<u32>>,
    number: Option<i64>,
    /// Line of the last motion that makes a step.
    from: u32,
}

impl Places {
    pub(super) fn of(settings: &Settings) -> Self {
        let first = settings.commons.int_opt(loc::FIXTURE_FIRST).map(i64::from);
        let are_on = settings.has_texts_at_places();
        Places { are_on, number: first, ..Places::default() }
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// Asks for the blocks before a step.
    #[cold]
    pub(super) fn ask_texts_before(&mut self, step: &Step) {
        let what = &step.what;
        match what {
            ExpectedStep::Sign(sign) => {
                let begins = self.places.operations.sign(*sign);
                if begins {
                    self.end_texts_of_cycle(step.line);
                    self.ask_texts(step.line, user_blocks::OPERATION.after);
                }
            }
            ExpectedStep::Tool { .. } => self.end_texts_of_cycle(step.line),
            ExpectedStep::End(_) => {
                self.end_texts_of_cycle(step.line);
                if self.places.operations.end() {
                    self.ask_texts(step.line, user_blocks::OPERATION.after);
                }
            }
            _ if what.end().is_some() || matches!(what, ExpectedStep::WholeThread(_)) => {
                if self.places.operations.moves() {
                    self.ask_texts(step.line, user_blocks::OPERATION.before);
                }
                let is_hole = matches!(what, ExpectedStep::Hole(_));
                if is_hole && !std::mem::replace(&mut self.places.in_cycle, true) {
                    self.ask_texts(step.line, user_blocks::CYCLE.before);
                }
            }
            _ => {}
        }
    }

    /// Asks for the blocks behind a step.
    #[cold]
    pub(super) fn ask_texts_after(&mut self, step: &Step) {
        match &step.what {
            ExpectedStep::CycleEnd => self.end_texts_of_cycle(step.line),
            ExpectedStep::WorkOffset(number) => {
                self.places.number = number.map(|number| number as i64);
                self.ask_texts_of_offset(step.line);
            }
            ExpectedStep::Tool { .. } => self.ask_texts_of_offset(step.line),
            what if what.end().is_some() && !self.own.has(self.moved.line) => {
                self.places.from = self.moved.line;
            }
            _ => {}
        }
    }

    fn ask_texts_of_offset(&mut self, cl_line: u32) {
        let must = self.expected.fixture.must;
        if must.is_none() || must == Some(None) || self.places.offset == must {
            return;
        }
        self.places.offset = must;
        let Around { before, after } = user_blocks::OFFSET;
        self.ask_texts(cl_line, before);
        self.ask_texts(cl_line, after);
    }

    fn end_texts_of_cycle(&mut self, cl_line: u32) {
        if std::mem::take(&mut self.places.in_cycle) {
            self.ask_texts(cl_line, user_blocks::CYCLE.after);
        }
    }

    /// Takes up the blocks of a list, which stand behind the last motion and before what comes next.
    fn ask_texts(&mut self, cl_line: u32, list: UserBlocks) {
        let numbers =
            Numbers { tool: self.expected.tool().map(i64::from), offset: self.places.number };
        let next = self.nc.from(self.next).find(|event| !self.own.has(event.line()));
        let lines = [self.places.from, next.map_or(u32::MAX, |event: Event| event.line())];
        let blocks = self.settings.blocks_of_list(list);
        let blocks: Vec<String> = blocks
            .iter()
            .map(|block| numbers.fill(block).map_or(block.clone(), |text| text.into_owned()))
            .collect();
        for block in &blocks {
            if !self.own.stands_between(block, lines) {
                let message = format!("the block `{block}` of the settings is not there");
                self.find(FindingKind::Block, Some(cl_line), None, message);
            }
        }
        self.take_blocks(&blocks);
    }
}

/// The turns of a program, for its blocks around them.
#[derive(Debug, Default)]
pub(super) struct Turns {
    /// Position of the rotary axes, where it is known.
    stands: [Option<f64>; 2],
    /// Line of the last motion.
    last: u32,
    turns: bool,
    /// A rapid motion has ended a turn, and what comes behind it is not known yet.
    ended: Option<u32>,
    /// Between which lines the blocks of which list stand.
    asked: Vec<(UserBlocks, [u32; 2])>,
}

impl Turns {
    /// `None` where the settings have no such blocks.
    pub(super) fn new(settings: &Settings) -> Option<Self> {
        let Around { before, after } = user_blocks::TURN;
        let is_on = before.is_on(settings.commons) || after.is_on(settings.commons);
        // A program begins with the axes at 0, as far as it does not say otherwise.
        is_on.then(|| Turns { stands: [Some(0.0); 2], ..Turns::default() })
    }

    /// Looks at a motion.
    pub(super) fn look(&mut self, found: &Move) {
        if let Some(ended) = self.ended.take() {
            self.asked.push((user_blocks::TURN.after, [ended, found.line]));
        }
        for n in 0..2 {
            let to = found.to.rotary[n];
            let is_said = found.known[n + 3] || found.to_machine[n + 3];
            let stays = self.stands[n].is_some_and(|at| (at - to).abs() <= STILL);
            if !is_said || stays {
                continue;
            }
            self.stands[n] = Some(to).filter(|_| found.known[n + 3]);
            // The control itself turns to a tilted plane.
            if found.to.tilt.is_none() && !std::mem::replace(&mut self.turns, true) {
                self.asked.push((user_blocks::TURN.before, [self.last, found.line]));
            }
        }
        if found.course == Course::Rapid && std::mem::take(&mut self.turns) {
            self.ended = Some(found.line);
        }
        self.last = found.line;
    }

    /// Asks for the blocks around the turns.
    pub(super) fn compare(mut self, own: &OwnBlocks<'_>, settings: &Settings) -> Report {
        let ended = self.ended.map(|line| (user_blocks::TURN.after, [line, u32::MAX]));
        self.asked.extend(ended);
        let mut report = Report::default();
        for (list, lines) in self.asked.into_iter().filter(|(_, lines)| !own.has(lines[1])) {
            let blocks = settings.blocks_of_list(list);
            for block in blocks.iter().filter(|block| !own.stands_between(block, lines)) {
                report.find(Finding {
                    kind: FindingKind::Block,
                    cl_line: None,
                    nc_line: Some(lines[1]).filter(|line| *line != u32::MAX),
                    message: format!("the block `{block}` of the settings is not at this turn"),
                });
            }
        }
        report
    }
}
