//! What may come next on a tape: its marks, the end of the program, subprograms behind it.

use fil_diag::Diag;

use super::Fault;
use crate::dialect::{Dialect, Habit};
use crate::errors::NcCode;
use crate::text::Block;

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

/// Why a line, or the end of the text, is refused.
pub(super) enum Refused {
    /// With its place.
    Diag(Box<Diag>),
    /// Without its place.
    Fault(Fault),
}

impl From<Fault> for Refused {
    fn from(fault: Fault) -> Self {
        Refused::Fault(fault)
    }
}

impl From<Box<Diag>> for Refused {
    fn from(diag: Box<Diag>) -> Self {
        Refused::Diag(diag)
    }
}

impl Refused {
    /// The refusal with its place.
    pub(super) fn place(self, name: &str, line: u32, text: &[u8]) -> Box<Diag> {
        match self {
            Refused::Diag(diag) => diag,
            Refused::Fault(fault) => fault.place(name, line, text),
        }
    }
}

/// Where the reading of a program stands.
pub(super) struct Order {
    part: Part,
    /// The tape began with its mark, so the next one ends it.
    marked: bool,
    /// The program has its number; another one would begin another program.
    numbered: bool,
    /// Why a line of the head is no block; it may be a label.
    label: Option<Box<Diag>>,
    /// It was refused at the block after it.
    refused_label: bool,
    /// The tape needs an end code before its last mark.
    has_end: bool,
}

impl Order {
    pub(super) fn new(dialect: &Dialect) -> Self {
        Order {
            part: Part::Head,
            marked: false,
            numbered: false,
            label: None,
            refused_label: false,
            has_end: dialect.has(Habit::HasEnd),
        }
    }

    /// Takes the next line; true for a block that is to be run.
    pub(super) fn is_run(
        &mut self,
        read: Result<(), Box<Diag>>,
        block: &Block,
    ) -> Result<bool, Refused> {
        if let Err(diag) = read {
            if self.part == Part::Head && !self.marked {
                self.label.get_or_insert(diag);
                return Ok(false);
            }
            return Err(diag.into());
        }
        if block.tape_mark {
            return self.tape_mark().map(|()| false);
        }
        if block.words.is_empty() {
            return Ok(false);
        }
        if let Some(label) = self.label.take() {
            self.refused_label = true;
            return Err(label.into());
        }
        match self.part {
            Part::Body => return Ok(true),
            Part::Ended | Part::Subprogram => {
                self.after_end(block)?;
                return Ok(false);
            }
            Part::Closed => return Err(after_end().into()),
            Part::Head if is_program_number(block) && !self.numbered => {
                self.numbered = true;
                return Ok(false);
            }
            Part::Head => self.part = Part::Body,
        }
        Ok(true)
    }

    /// True once after a line of the head was refused at the block after it.
    pub(super) fn take_refused_label(&mut self) -> bool {
        std::mem::take(&mut self.refused_label)
    }

    /// The program has ended.
    pub(super) fn end(&mut self) {
        self.part = Part::Ended;
    }

    fn tape_mark(&mut self) -> Result<(), Refused> {
        match self.part {
            Part::Head if !self.marked => {
                self.label = None;
                self.marked = true;
            }
            Part::Subprogram => return Err(cut_off("the last subprogram does not end")),
            Part::Head | Part::Body if self.has_end => {
                return Err(cut_off("the program ends without an end code"));
            }
            _ => self.part = Part::Closed,
        }
        Ok(())
    }

    fn after_end(&mut self, block: &Block) -> Result<(), Refused> {
        let returns = || block.words.iter().any(|w| w.letter == b'M' && w.number.digits == 99);
        match self.part {
            Part::Ended if is_program_number(block) => self.part = Part::Subprogram,
            Part::Ended => return Err(after_end().into()),
            _ if returns() => self.part = Part::Ended,
            _ => {}
        }
        Ok(())
    }

    /// Refuses a text that ends too early; `outside`: no subprogram is being run.
    pub(super) fn check_end(&mut self, outside: bool) -> Result<(), Refused> {
        if let Some(label) = self.label.take() {
            self.refused_label = true;
            return Err(label.into());
        }
        match self.part {
            Part::Ended | Part::Closed => Ok(()),
            Part::Head | Part::Body if !self.has_end && outside => Ok(()),
            Part::Subprogram => Err(cut_off("the last subprogram does not end")),
            _ => Err(cut_off("no end code was found")),
        }
    }
}

fn cut_off(message: &str) -> Refused {
    Fault::new(NcCode::CutOff, message).into()
}

fn after_end() -> Fault {
    Fault::new(NcCode::AfterEnd, "the program has ended before this block")
}

/// `O100` in a block of its own.
fn is_program_number(block: &Block) -> bool {
    let mut words = block.words.iter().filter(|word| word.letter != b'N');
    words.next().is_some_and(|word| word.letter == b'O') && words.next().is_none()
}
