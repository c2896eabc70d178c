//! The debugger as the run calls it: decides where to stand still, and serves the requests
//! that look at the run while it does.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

use filpost::Diag;
use filpost::debug::{DebugEvent, DebugState, Debugger, stopped};
use serde_json::{Value, json};

use crate::breakpoints::{What, is_part};
use crate::edits::Tick;
use crate::inspect;
use crate::shared::Shared;

/// How far the run goes before it stands still again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// To a breakpoint.
    Run,
    /// To the next statement or record.
    In,
    /// To the next statement of this level or above, or record.
    Over,
    /// To the next statement above this level, or record.
    Out,
    /// To the next record.
    Record,
    /// To the next block.
    Block,
    /// To a place that an earlier run has been at; nothing else stops it.
    Until(Tick),
}

/// What the session asks of a run that stands still.
pub enum Ask {
    /// Go on.
    Go(Goal),
    /// Answer a request that looks at the run or sets something in it.
    Answer(Value),
    /// Tell all that there is to see, with the values of these expressions.
    Show(Vec<String>),
}

/// Where what is asked of a run comes from.
pub enum Asks {
    /// From a client, in another thread, for as long as it wants the run.
    Client(Receiver<Ask>),
    /// It was all known before: the run ends behind the last.
    Known(VecDeque<Ask>),
}

impl Asks {
    /// What is asked of a run that stands still.
    ///
    /// # Errors
    /// The run is not wanted any more.
    fn next(&mut self) -> Result<Ask, Box<Diag>> {
        match self {
            Asks::Client(asks) => asks.recv().map_err(|_| stopped()),
            Asks::Known(asks) => asks.pop_front().ok_or_else(stopped),
        }
    }
}

/// The debugger of one run.
pub struct Hook {
    shared: Arc<Shared>,
    asks: Asks,
    /// Number of the run.
    run: u64,
    goal: Goal,
    /// Sections and macros that are open.
    level: usize,
    /// The level at which the run went on.
    from: usize,
    tick: Tick,
    /// Blocks that were there when the run was looked at last.
    blocks: u64,
    /// Where blocks were written.
    written: Vec<Tick>,
    /// The CL line of the record before.
    last_line: u32,
    has_told_failure: bool,
    files: Files,
}

/// The files of a run.
#[derive(Clone)]
pub struct Files {
    /// The CL file.
    pub cl: PathBuf,
    /// The FIL files, by their numbers.
    pub fil: Vec<PathBuf>,
    /// Their names in messages.
    pub names: Vec<String>,
}

impl Files {
    /// The path of a FIL file by its name in messages.
    pub fn path_of(&self, name: &str) -> PathBuf {
        let number = self.names.iter().position(|known| known == name);
        number.map_or_else(|| PathBuf::from(name), |number| self.fil[number].clone())
    }
}

/// Why a run stands still.
struct Stop {
    reason: &'static str,
    text: Option<String>,
    ids: Vec<u64>,
}

impl Stop {
    fn new(reason: &'static str) -> Stop {
        Stop { reason, text: None, ids: Vec::new() }
    }
}

impl Hook {
    /// A debugger for the run of that number.
    pub fn new(shared: Arc<Shared>, asks: Asks, run: u64, goal: Goal, files: Files) -> Self {
        shared.breakpoints().begin_again();
        Hook {
            shared,
            asks,
            run,
            goal,
            level: 0,
            from: 0,
            tick: Tick::default(),
            blocks: 0,
            written: Vec::new(),
            last_line: 0,
            has_told_failure: false,
            files,
        }
    }

    /// Where the run is and what it has written, for requests.
    pub fn files(&self) -> &Files {
        &self.files
    }

    /// The place of this moment.
    pub fn tick(&self) -> Tick {
        self.tick
    }

    /// The place a step back leads to: before the last statement or record.
    pub fn before(&self) -> Option<Tick> {
        let Tick { number, is_over } = self.tick;
        let number = if is_over { number } else { number.saturating_sub(1) };
        (number > 0).then_some(Tick { number, is_over: false })
    }

    /// The place where the block before was written: behind what wrote it.
    pub fn before_block(&self) -> Option<Tick> {
        self.written.iter().rev().find(|tick| **tick < self.tick).copied()
    }

    /// The connection.
    pub fn shared(&self) -> &Arc<Shared> {
        &self.shared
    }

    fn replays(&self) -> bool {
        matches!(self.goal, Goal::Until(_))
    }

    /// New blocks, with the number of the first of them.
    fn new_blocks(&mut self, state: &DebugState<'_, '_>) -> (u64, Vec<String>) {
        let count = state.blocks();
        if count <= self.blocks {
            return (self.blocks + 1, Vec::new());
        }
        let texts = state.last_blocks(count - self.blocks);
        let first = count - texts.len() as u64 + 1;
        self.blocks = count;
        (first, texts)
    }

    /// Looks at what the last statement or record has done: blocks and values.
    fn look_back(&mut self, state: &DebugState<'_, '_>) -> Option<Stop> {
        let (first, texts) = self.new_blocks(state);
        if !texts.is_empty() {
            self.written.push(self.tick);
        }
        let mut stop = None;
        for (number, text) in (first..).zip(&texts) {
            if !self.replays() {
                self.shared.output("stdout", text);
            }
            let is_here = |what: &What| match what {
                What::Nc(line) => *line == number,
                What::Block(part) => text.contains(part.as_str()),
                _ => false,
            };
            let (ids, said) = self.shared.breakpoints().hit(is_here, state);
            self.say(&said);
            if !ids.is_empty() {
                stop = Some(Stop { reason: "breakpoint", text: Some(text.clone()), ids });
            }
        }
        let (ids, said, changes) = self.shared.breakpoints().changed(state);
        self.say(&said);
        if !ids.is_empty() {
            stop = Some(Stop { reason: "data breakpoint", text: Some(changes.join("; ")), ids });
        }
        if self.goal == Goal::Block && !texts.is_empty() {
            stop = stop.or(Some(Stop::new("step")));
        }
        stop
    }

    fn say(&self, said: &[String]) {
        if !self.replays() {
            said.iter().for_each(|text| self.shared.output("console", text));
        }
    }

    /// A statement or record begins: breakpoints at its place, and the goal.
    fn look_ahead(&mut self, is_record: bool, state: &DebugState<'_, '_>) -> Option<Stop> {
        let place = state.fil.line();
        let record = state.fil.record.as_deref();
        let (line, last) = (record.map_or(0, |record| record.line), self.last_line);
        let major = record.map(|record| state.fil.vocabulary.name(record.major));
        let files = &self.files;
        let is_here = |what: &What| match what {
            What::Fil(path, wanted) => place.is_some_and(|(file, line)| {
                line == *wanted && files.fil[usize::from(file)] == *path
            }),
            What::Cl(wanted) => is_record && line >= *wanted && last < *wanted,
            What::Record(word) => is_record && major == Some(word.as_str()),
            _ => false,
        };
        let (ids, said) = self.shared.breakpoints().hit(is_here, state);
        if is_record {
            self.last_line = line;
        }
        self.say(&said);
        if !ids.is_empty() {
            return Some(Stop { reason: "breakpoint", text: None, ids });
        }
        if self.shared.pause.swap(false, Ordering::SeqCst) {
            return Some(Stop::new("pause"));
        }
        let arrived = match self.goal {
            Goal::Run | Goal::Block | Goal::Until(_) => false,
            Goal::In => true,
            Goal::Over => is_record || self.level <= self.from,
            Goal::Out => is_record || self.level < self.from,
            Goal::Record => is_record,
        };
        arrived.then(|| Stop::new("step"))
    }

    /// A section or macro begins.
    fn look_in(&self, state: &DebugState<'_, '_>) -> Option<Stop> {
        let stack = state.fil.stack();
        let title = &stack.first()?.title;
        let is_here = |what: &What| matches!(what, What::Part(wanted) if is_part(wanted, title));
        let (ids, said) = self.shared.breakpoints().hit(is_here, state);
        self.say(&said);
        let text = Some(title.clone());
        (!ids.is_empty()).then_some(Stop { reason: "function breakpoint", text, ids })
    }

    /// Stands still where there is a reason, or where a replay ends.
    fn arrive(
        &mut self,
        stop: Option<Stop>,
        state: &mut DebugState<'_, '_>,
    ) -> Result<(), Box<Diag>> {
        let stop = match (self.goal, stop) {
            (Goal::Until(tick), _) if tick == self.tick => Some(Stop::new("step")),
            (Goal::Until(_), _) => None,
            (_, stop) => stop,
        };
        // What was set by hand at this place of an earlier run is set again.
        if self.replays() {
            let edits = self.shared.edits().at(self.tick);
            for edit in edits {
                if let Err(message) = edit.apply(state) {
                    self.shared.output("stderr", &message);
                }
            }
        }
        match stop {
            Some(stop) => self.stand_still(&stop, state),
            None => Ok(()),
        }
    }

    fn stand_still(
        &mut self,
        stop: &Stop,
        state: &mut DebugState<'_, '_>,
    ) -> Result<(), Box<Diag>> {
        self.shared.set_ways_back([self.before(), self.before_block()]);
        self.shared.is_stopped.store(true, Ordering::SeqCst);
        let mut body = json!({ "reason": stop.reason, "threadId": 1, "allThreadsStopped": true });
        if let Some(text) = &stop.text {
            body["text"] = text.clone().into();
            body["description"] = text.clone().into();
        }
        if !stop.ids.is_empty() {
            body["hitBreakpointIds"] = stop.ids.clone().into();
        }
        self.shared.event("stopped", body);
        loop {
            let ask = self.asks.next().inspect_err(|_| {
                if let Asks::Known(_) = self.asks {
                    // The end that this brings is no error to stop at.
                    self.shared.run.store(u64::MAX, Ordering::SeqCst);
                }
            });
            match ask? {
                Ask::Answer(request) => inspect::answer(&request, self, state),
                Ask::Show(watched) => {
                    self.shared.event("shown", inspect::show(&watched, self, state));
                }
                Ask::Go(goal) => {
                    self.goal = goal;
                    self.from = self.level;
                    return Ok(());
                }
            }
        }
    }

    /// A request that came as the run went on is not left without an answer.
    fn answer_late(&self) -> Result<(), Box<Diag>> {
        let Asks::Client(asks) = &self.asks else { return Ok(()) };
        loop {
            match asks.recv_timeout(Duration::ZERO) {
                Ok(Ask::Answer(request)) => {
                    self.shared.respond(&request, Err("the run goes on".to_string()));
                }
                Ok(Ask::Go(_) | Ask::Show(_)) => {}
                Err(RecvTimeoutError::Timeout) => return Ok(()),
                Err(RecvTimeoutError::Disconnected) => return Err(stopped()),
            }
        }
    }
}

impl Debugger for Hook {
    fn at(
        &mut self,
        event: DebugEvent<'_>,
        state: &mut DebugState<'_, '_>,
    ) -> Result<(), Box<Diag>> {
        if !self.shared.counts(self.run) {
            return Err(stopped());
        }
        match event {
            DebugEvent::Enter => {
                self.level += 1;
                self.begin();
                let stop = self.look_in(state);
                self.arrive(stop, state)?;
            }
            DebugEvent::Leave => self.level = self.level.saturating_sub(1),
            DebugEvent::Record | DebugEvent::Statement => {
                let is_record = matches!(event, DebugEvent::Record);
                if is_record {
                    self.level = 0;
                }
                self.answer_late()?;
                if !self.tick.is_over {
                    self.over(state)?;
                }
                self.begin();
                let stop = self.look_ahead(is_record, state);
                self.arrive(stop, state)?;
            }
            DebugEvent::RecordDone => self.over(state)?,
            DebugEvent::Failed(diag) if !self.has_told_failure => {
                self.has_told_failure = true;
                if self.shared.breakpoints().on_errors && !self.replays() {
                    let text = Some(format!("{} {}", diag.code.name(), diag.message));
                    return self
                        .stand_still(&Stop { reason: "exception", text, ids: Vec::new() }, state);
                }
            }
            _ => {}
        }
        Ok(())
    }
}

impl Hook {
    /// Something else begins.
    fn begin(&mut self) {
        self.tick = Tick { number: self.tick.number + 1, is_over: false };
    }

    /// What ran last is over.
    fn over(&mut self, state: &mut DebugState<'_, '_>) -> Result<(), Box<Diag>> {
        self.tick.is_over = true;
        let stop = self.look_back(state);
        self.arrive(stop, state)
    }
}
