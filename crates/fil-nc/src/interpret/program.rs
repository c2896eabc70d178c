//! The lines of a program in the order the control runs them: tape marks,
//! subprograms, the end.

use std::collections::{HashMap, VecDeque};

use fil_diag::Diag;

use super::block::Outcome;
use super::order::{Order, Refused};
use super::state::State;
use super::{Fault, cant_read};
use crate::dialect::Dialect;
use crate::errors::NcCode;
use crate::motion::Event;
use crate::source::{Lines, Source};
use crate::text::{Block, read_block_into};

/// The code that returns from a subprogram.
const RETURN: u32 = 99;

/// Most calls within calls.
const MAX_DEPTH: usize = 16;

/// Most motions that calls may make in all, blocks without one counted too.
const MAX_CALLED: usize = 5_000_000;

/// The mark of blocks that may be skipped, as [`Marks`](crate::dialect) give it.
const SKIP: u8 = b'/';

/// A place of the text that begins a line.
#[derive(Clone, Copy)]
struct Place {
    offset: u64,
    /// Lines before it.
    line: u32,
}

/// A call that is being run.
struct Call<'a> {
    /// The subprogram's first block.
    start: Place,
    /// Runs still to come after this one.
    repeats: u32,
    /// Where to go on, and the line of the call.
    caller: Lines<'a>,
    line: u32,
}

/// A program of words, and what decides which line comes next.
pub(super) struct Program<'a> {
    source: &'a Source<'a>,
    state: State<'a>,
    lines: Lines<'a>,
    /// The line that was read last, 1-based, and where it begins.
    number: u32,
    offset: u64,
    /// The block of that line; its memory is used again.
    block: Block,
    calls: Vec<Call<'a>>,
    called: usize,
    /// Subprograms by their number, from the first call on.
    subprograms: Option<HashMap<i64, Place>>,
    order: Order,
}

impl<'a> Program<'a> {
    pub(super) fn new(source: &'a Source<'a>, dialect: &'a Dialect) -> Self {
        Program {
            source,
            state: State::new(dialect),
            lines: Lines::from(source, 0),
            number: 0,
            offset: 0,
            block: Block::default(),
            calls: Vec::new(),
            called: 0,
            subprograms: None,
            order: Order::new(dialect),
        }
    }

    /// Goes on after a refused line.
    pub(super) fn forget(&mut self) {
        if self.order.take_refused_label() {
            // What was refused is a line before this one, which is read again.
            self.lines.go_to(self.offset);
            self.number = self.number.saturating_sub(1);
        } else {
            self.state.keep_meanings(&self.block);
        }
        self.state.forget();
    }

    /// Goes on after a refused line as if it were not there; false for a line before this one.
    pub(super) fn pass_over(&mut self) -> bool {
        self.state.events.clear();
        !self.order.take_refused_label()
    }

    /// Runs the next line; false behind the last.
    pub(super) fn run_line(
        &mut self,
        name: &str,
        into: &mut VecDeque<Event>,
    ) -> Result<bool, Box<Diag>> {
        let offset = self.lines.at();
        let line = self.lines.next_full_line().map_err(|error| cant_read(name, &error))?;
        let Some(line) = line else {
            let ended = self.order.check_end(self.calls.is_empty());
            return match ended {
                Ok(()) => Ok(false),
                Err(refused) => Err(self.at_last_line(refused, name)?),
            };
        };
        (self.offset, self.number) = (offset, self.number + 1);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let line = &*self.state.dialect.text.marks.read(line);
        if self.state.dialect.leaves_blocks_out() && may_be_skipped(line) {
            return Ok(true);
        }
        let placed = |refused: Refused| refused.place(name, self.number, line);
        let read = read_block_into(&mut self.block, line, name, self.number);
        if !self.order.is_run(read, &self.block).map_err(placed)? {
            return Ok(true);
        }
        let mut outcome = self.state.run(&self.block).map_err(|fault| placed(fault.into()))?;
        if outcome == Outcome::Back && self.calls.is_empty() {
            // A main program ends there and begins again.
            self.state.end(RETURN);
            outcome = Outcome::End(RETURN);
        }
        if !self.calls.is_empty() {
            self.called += 1 + self.state.events.len();
            if self.called > MAX_CALLED {
                let many = Fault::new(NcCode::BadCall, "the calls make too many motions");
                return Err(placed(many.into()));
            }
        }
        into.extend(self.state.events.drain(..));
        if outcome != Outcome::Next {
            let line = line.to_vec();
            let number = self.number;
            self.follow(outcome, name).map_err(|refused| refused.place(name, number, &line))?;
        }
        Ok(true)
    }

    /// What a block asks of the order of lines.
    fn follow(&mut self, outcome: Outcome, name: &str) -> Result<(), Refused> {
        match outcome {
            Outcome::Next => {}
            Outcome::End(_) => {
                self.order.end();
                let outermost = self.calls.drain(..).next();
                if let Some(call) = outermost {
                    (self.lines, self.number) = (call.caller, call.line);
                }
            }
            Outcome::Call { number, times } => self.call(number, times, name)?,
            Outcome::Back => {
                let Some(mut call) = self.calls.pop() else { return Ok(()) };
                if call.repeats == 0 {
                    (self.lines, self.number) = (call.caller, call.line);
                } else {
                    call.repeats -= 1;
                    self.lines.go_to(call.start.offset);
                    self.number = call.start.line;
                    self.calls.push(call);
                }
            }
        }
        Ok(())
    }

    fn call(&mut self, number: i64, times: u32, name: &str) -> Result<(), Refused> {
        if self.subprograms.is_none() {
            self.subprograms = Some(self.find_subprograms(name)?);
        }
        let found = self.subprograms.iter().find_map(|all| all.get(&number)).copied();
        let Some(start) = found else {
            let message = format!("there is no O{number} in this file");
            return Err(Fault::new(NcCode::BadCall, message).into());
        };
        if self.calls.len() == MAX_DEPTH {
            return Err(Fault::new(NcCode::BadCall, "the calls are too deep").into());
        }
        if times > 0 {
            let caller = std::mem::replace(&mut self.lines, Lines::from(self.source, start.offset));
            let line = std::mem::replace(&mut self.number, start.line);
            self.calls.push(Call { start, repeats: times - 1, caller, line });
        }
        Ok(())
    }

    /// Where the subprograms begin, behind the lines of their numbers.
    fn find_subprograms(&self, name: &str) -> Result<HashMap<i64, Place>, Box<Diag>> {
        let mut subprograms = HashMap::new();
        let mut lines = Lines::from(self.source, 0);
        for line in 1.. {
            let Some(text) = lines.next_line().map_err(|error| cant_read(name, &error))? else {
                break;
            };
            if let Some(number) = program_number(text) {
                let place = Place { offset: lines.at(), line };
                subprograms.entry(number).or_insert(place);
            }
        }
        Ok(subprograms)
    }

    /// A refusal of the text as a whole, at its last line.
    fn at_last_line(&self, refused: Refused, name: &str) -> Result<Box<Diag>, Box<Diag>> {
        let mut lines = Lines::from(self.source, self.offset);
        let line = lines.next_line().map_err(|error| cant_read(name, &error))?.unwrap_or_default();
        Ok(refused.place(name, self.number.max(1), line))
    }
}

/// The number of a line that begins with it: `O100`.
fn program_number(line: &[u8]) -> Option<i64> {
    let line = line.trim_ascii_start();
    let rest = line.strip_prefix(b"O").or(line.strip_prefix(b"o"))?;
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    std::str::from_utf8(&rest[..digits]).ok()?.parse().ok()
}

/// A line that begins with the skip mark.
pub(super) fn may_be_skipped(line: &[u8]) -> bool {
    line.trim_ascii_start().first() == Some(&SKIP)
}
