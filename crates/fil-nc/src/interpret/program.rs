//! The lines of a program in the order the control runs them: tape marks,
//! subprograms, the end.

use std::collections::HashMap;

use fil_diag::{Diag, TextSpan};

use super::Fault;
use super::block::Outcome;
use super::state::State;
use crate::dialect::Dialect;
use crate::errors::NcCode;
use crate::motion::Event;
use crate::text::{Block, read_block};

/// Most calls within calls.
const MAX_DEPTH: usize = 16;

/// Most motions that calls may make in all, blocks without one counted too.
const MAX_CALLED: usize = 5_000_000;

/// The mark of blocks that may be skipped, as [`Marks`](crate::dialect) give it.
const SKIP: u8 = b'/';

/// Where the reading stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// No block has been run; text before the first tape mark is a label.
    Head,
    /// The program itself.
    Body,
    /// After the end code: subprograms may follow.
    Ended,
    /// In a subprogram after the end.
    Subprogram,
    /// After the last tape mark.
    Closed,
}

/// A call that is being run.
struct Call {
    /// Line index of the subprogram's first block.
    start: usize,
    /// Runs still to come after this one.
    repeats: u32,
    /// Line index to go on at.
    back: usize,
}

pub(super) struct Program<'a> {
    text: &'a [u8],
    name: &'a str,
    dialect: &'a Dialect,
    /// Where each line begins.
    lines: Vec<usize>,
    /// Subprograms: number to the index of the line after theirs.
    subprograms: HashMap<i64, usize>,
    part: Part,
    /// The tape began with its mark, so the next one ends it.
    marked: bool,
    /// Why a line of the head is no block; it may be a label.
    label: Option<Box<Diag>>,
    calls: Vec<Call>,
    called: usize,
}

impl<'a> Program<'a> {
    pub(super) fn new(text: &'a [u8], name: &'a str, dialect: &'a Dialect) -> Self {
        let ends = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
        let mut lines: Vec<usize> = [0].into_iter().chain(ends.map(|(at, _)| at + 1)).collect();
        if lines.last() == Some(&text.len()) {
            lines.pop();
        }
        let mut program = Program {
            text,
            name,
            dialect,
            lines,
            subprograms: HashMap::new(),
            part: Part::Head,
            marked: false,
            label: None,
            calls: Vec::new(),
            called: 0,
        };
        program.find_subprograms();
        program
    }

    fn find_subprograms(&mut self) {
        for index in 0..self.lines.len() {
            let line = self.line(index).trim_ascii_start();
            let Some(rest) = line.strip_prefix(b"O").or(line.strip_prefix(b"o")) else { continue };
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            let number = std::str::from_utf8(&rest[..digits]).ok().and_then(|n| n.parse().ok());
            if let Some(number) = number {
                self.subprograms.entry(number).or_insert(index + 1);
            }
        }
    }

    fn line(&self, index: usize) -> &'a [u8] {
        let end = self.lines.get(index + 1).map_or(self.text.len(), |next| next - 1);
        let line = &self.text[self.lines[index]..end];
        line.strip_suffix(b"\r").unwrap_or(line)
    }

    pub(super) fn run(mut self, take: &mut dyn FnMut(Event)) -> Result<(), Box<Diag>> {
        let mut state = State::new(self.dialect);
        let mut index = 0;
        while index < self.lines.len() {
            let number = index as u32 + 1;
            let line = self.line(index);
            index = match self.block(&mut state, line, number, index, take)? {
                Some(next) => next,
                None => index + 1,
            };
        }
        self.check_end()
    }

    /// Runs a line; says which line comes next when it is not the following one.
    fn block(
        &mut self,
        state: &mut State,
        line: &[u8],
        number: u32,
        index: usize,
        take: &mut dyn FnMut(Event),
    ) -> Result<Option<usize>, Box<Diag>> {
        let line = &*self.dialect.marks.read(line);
        if self.dialect.skips_blocks && may_be_skipped(line) {
            return Ok(None);
        }
        let block = match read_block(line, self.name, number) {
            Ok(block) => block,
            Err(diag) if self.part == Part::Head && !self.marked => {
                self.label.get_or_insert(diag);
                return Ok(None);
            }
            Err(diag) => return Err(diag),
        };
        if block.tape_mark {
            return self.tape_mark().map(|()| None);
        }
        let placed = |fault: Fault| fault.place(self.name, number, line);
        if block.words.is_empty() {
            return Ok(None);
        }
        if let Some(label) = self.label.take() {
            return Err(label);
        }
        match self.part {
            Part::Ended | Part::Subprogram => {
                self.after_end(&block).map_err(placed)?;
                return Ok(None);
            }
            Part::Closed => return Err(placed(after_end())),
            Part::Head if is_program_number(&block) => return Ok(None),
            Part::Head | Part::Body => self.part = Part::Body,
        }
        let outcome = state.run(&block).map_err(placed)?;
        self.count_called(state.events.len()).map_err(placed)?;
        state.events.drain(..).for_each(take);
        self.follow(outcome, index).map_err(|fault| fault.place(self.name, number, line))
    }

    fn tape_mark(&mut self) -> Result<(), Box<Diag>> {
        match self.part {
            Part::Head if !self.marked => {
                self.label = None;
                self.marked = true;
            }
            Part::Subprogram => return Err(self.cut_off("the last subprogram does not end")),
            Part::Head | Part::Body if self.dialect.has_end => {
                return Err(self.cut_off("the tape ends before an end code"));
            }
            _ => self.part = Part::Closed,
        }
        Ok(())
    }

    fn after_end(&mut self, block: &Block) -> Result<(), Fault> {
        let returns = || block.words.iter().any(|w| w.letter == b'M' && w.number.digits == 99);
        match self.part {
            Part::Ended if is_program_number(block) => self.part = Part::Subprogram,
            Part::Ended => return Err(after_end()),
            _ if returns() => self.part = Part::Ended,
            _ => {}
        }
        Ok(())
    }

    /// Stops calls that would run for ever.
    fn count_called(&mut self, motions: usize) -> Result<(), Fault> {
        if !self.calls.is_empty() {
            self.called += 1 + motions;
        }
        if self.called > MAX_CALLED {
            return Err(Fault::new(NcCode::BadCall, "the calls make too many motions"));
        }
        Ok(())
    }

    /// What a block asks of the order of lines.
    fn follow(&mut self, outcome: Outcome, index: usize) -> Result<Option<usize>, Fault> {
        match outcome {
            Outcome::Next => Ok(None),
            Outcome::End(_) => {
                self.part = Part::Ended;
                let outer = self.calls.first().map(|call| call.back);
                self.calls.clear();
                Ok(outer)
            }
            Outcome::Call { number, times } => self.call(number, times, index),
            Outcome::Back => {
                let Some(call) = self.calls.last_mut() else {
                    return Err(Fault::new(NcCode::BadCall, "no subprogram is being run"));
                };
                let next = if call.repeats > 0 { call.start } else { call.back };
                if call.repeats > 0 {
                    call.repeats -= 1;
                } else {
                    self.calls.pop();
                }
                Ok(Some(next))
            }
        }
    }

    fn call(&mut self, number: i64, times: u32, index: usize) -> Result<Option<usize>, Fault> {
        let Some(start) = self.subprograms.get(&number).copied() else {
            let message = format!("there is no O{number} in this file");
            return Err(Fault::new(NcCode::BadCall, message));
        };
        if self.calls.len() == MAX_DEPTH {
            return Err(Fault::new(NcCode::BadCall, "the calls are too deep"));
        }
        if times == 0 {
            return Ok(None);
        }
        self.calls.push(Call { start, repeats: times - 1, back: index + 1 });
        Ok(Some(start))
    }

    fn check_end(&mut self) -> Result<(), Box<Diag>> {
        if let Some(label) = self.label.take() {
            return Err(label);
        }
        match self.part {
            Part::Ended | Part::Closed => Ok(()),
            Part::Head | Part::Body if !self.dialect.has_end && self.calls.is_empty() => Ok(()),
            Part::Subprogram => Err(self.cut_off("the last subprogram does not end")),
            _ => Err(self.cut_off("no end code was found")),
        }
    }

    fn cut_off(&self, message: &str) -> Box<Diag> {
        let last = self.lines.len().saturating_sub(1);
        let text = if self.lines.is_empty() { &[][..] } else { self.line(last) };
        let text = String::from_utf8_lossy(text).into_owned();
        Box::new(Diag::new(NcCode::CutOff, message).at(TextSpan::line(
            self.name,
            last as u32 + 1,
            text,
        )))
    }
}

/// A line that begins with the skip mark.
pub(super) fn may_be_skipped(line: &[u8]) -> bool {
    line.trim_ascii_start().first() == Some(&SKIP)
}

/// True when the program does something else with blocks left out that may be skipped.
pub(super) fn has_skipped_blocks(text: &[u8], dialect: &Dialect) -> bool {
    text.split(|byte| *byte == b'\n').any(|line| may_be_skipped(&dialect.marks.read(line)))
}

fn after_end() -> Fault {
    Fault::new(NcCode::AfterEnd, "the program has ended before this block")
}

/// `O100` in a block of its own.
fn is_program_number(block: &Block) -> bool {
    let mut words = block.words.iter().filter(|word| word.letter != b'N');
    words.next().is_some_and(|word| word.letter == b'O') && words.next().is_none()
}
