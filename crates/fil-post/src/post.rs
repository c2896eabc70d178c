//! The post: takes CL records one after the other and writes blocks.

use std::collections::HashSet;

use fil_cl::vocabulary::Vocabulary;
use fil_cl::{Record, WordId, record::kind};
use fil_diag::{Code, Diag};

use crate::axes::Machine;
use crate::block::Block;
use crate::cause::Cause;
use crate::commons::{Commons, EMPTY, Int};
use crate::errors::PostCode;
use crate::letters::G;
use crate::noted::Noted;
use crate::state::{Placement, State};
use crate::tape::Tape;
use crate::words::form::Form;
use crate::words::{self, Handler};

/// Most warnings of one run.
const MAX_WARNINGS: usize = 1000;

/// The generalized post of one run.
///
/// Finished blocks lie in [`Post::tape`]; whoever drives the post takes them
/// away from time to time, so that memory does not grow with the CL file.
#[derive(Clone)]
pub struct Post {
    /// The settings.
    pub commons: Commons,
    /// The output.
    pub tape: Tape,
    /// Warnings not yet taken away.
    pub warnings: Vec<Diag>,
    pub(crate) state: State,
    pub(crate) machine: Machine,
    pub(crate) block: Block,
    handlers: Vec<Option<Handler>>,
    warned: HashSet<(u16, String)>,
}

impl Post {
    /// A post for a machine.
    ///
    /// # Errors
    /// Settings that make no machine.
    pub fn new(commons: Commons) -> Result<Self, Box<Diag>> {
        let mut machine = Machine::default();
        machine.refresh(&commons, true)?;
        let mut handlers = Vec::new();
        for (word, handler) in words::HANDLERS {
            if handlers.len() <= word.index() {
                handlers.resize(word.index() + 1, None);
            }
            handlers[word.index()] = Some(*handler);
        }
        Ok(Post {
            commons,
            tape: Tape::default(),
            warnings: Vec::new(),
            state: State::default(),
            machine,
            block: Block::default(),
            handlers,
            warned: HashSet::new(),
        })
    }

    /// Keeps what blocks and words are due to from now on.
    pub fn observe(&mut self) {
        self.tape.noted = Some(Noted::default());
        self.block.noting = true;
    }

    /// Carries out one record.
    ///
    /// # Errors
    /// Whatever the record's post word refuses; nothing of the run may be
    /// used after an error.
    pub fn process(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        self.machine.refresh(&self.commons, self.state.metric)?;
        if self.tape.noted.is_some() {
            self.block.cause = Cause { made_by_fil: record.line == 0, ..self.tape.cause };
            self.state.point_word = 0;
        }
        if record.kind == kind::PSEUDO {
            return words::pseudo::handle(self, record, vocabulary);
        }
        match self.handlers.get(record.major.index()).copied().flatten() {
            Some(handler) => handler(self, record, vocabulary),
            None => {
                self.warn_unknown_word(record.major, vocabulary);
                Ok(())
            }
        }
    }

    /// Ends the program if no FINI did.
    ///
    /// # Errors
    /// A record that waits for its continuation (a CIRCLE without end point).
    pub fn finish(&mut self) -> Result<(), Box<Diag>> {
        words::fini::finish(self)
    }

    /// Extents and counts for the summary are the tape's; this is the last CL
    /// point, in CL units.
    pub fn point(&self) -> Option<[f64; 3]> {
        self.state.point.map(|p| [p.x, p.y, p.z])
    }

    /// True when the CL file is in mm, false when it is in inches.
    pub fn is_metric(&self) -> bool {
        self.state.metric
    }

    /// Diameter of the cutter as the CL file names it, in CL units.
    pub fn cutter_diameter(&self) -> Option<f64> {
        self.state.cutter
    }

    /// Warns once per code and subject; a run that warns without end stops at
    /// [`MAX_WARNINGS`], so that memory does not grow with the CL file.
    pub(crate) fn warn(&mut self, code: PostCode, message: String) {
        self.warn_with(code, message, || None);
    }

    /// The same with a hint made for this case when the warning is a new one.
    pub(crate) fn warn_with(
        &mut self,
        code: PostCode,
        message: String,
        hint: impl FnOnce() -> Option<String>,
    ) {
        let code: &'static Code = code.into();
        if self.warned.len() < MAX_WARNINGS && self.warned.insert((code.number, message.clone())) {
            let last = self.warned.len() == MAX_WARNINGS;
            let note = if last { "; further warnings are not listed" } else { "" };
            self.warnings.push(Diag { hint: hint(), ..Diag::new(code, message + note) });
        }
    }

    fn warn_unknown_word(&mut self, word: WordId, vocabulary: &Vocabulary) {
        let message = format!("no handler for {}", vocabulary.name(word));
        self.warn_with(PostCode::UnknownWord, message, || vocabulary.perhaps_meant(word));
    }

    /// Warns that the machine has no code for something it may do by other means.
    pub(crate) fn warn_no_code(&mut self, what: &str) {
        let message = format!("the machine has no code for {what}; nothing is written");
        self.warn(PostCode::IgnoredPart, message);
    }

    /// An integer code of the machine.
    ///
    /// # Errors
    /// The code is absent.
    pub(crate) fn code(&self, location: Int, what: &str) -> Result<i32, Box<Diag>> {
        self.commons.int_opt(location).ok_or_else(|| {
            Box::new(Diag::new(
                PostCode::NoCode,
                format!("the machine has no code for {what} (INTCOM {})", location.0),
            ))
        })
    }

    /// The letter a setting names, 1 to 26.
    ///
    /// # Errors
    /// The setting is absent.
    pub(crate) fn letter(&self, location: Int, what: &str) -> Result<u8, Box<Diag>> {
        Ok(self.code(location, what)?.clamp(1, 26) as u8)
    }

    /// Writes the block under construction and empties it.
    ///
    /// # Errors
    /// As [`Tape::block`]; and what the start of the program refuses.
    pub(crate) fn write_block(&mut self) -> Result<(), Box<Diag>> {
        if !self.block.is_empty() {
            self.begin()?;
        }
        let result = self.tape.block(&self.block, &self.machine.addresses, &mut self.commons);
        self.block.clear();
        result
    }

    /// Writes the start of the program if it is still due. Whoever asks for the
    /// modes the control stands at calls it first.
    ///
    /// # Errors
    /// As [`program::start`](crate::program::start).
    pub(crate) fn begin(&mut self) -> Result<(), Box<Diag>> {
        if self.state.started {
            return Ok(());
        }
        let block = self.block.take();
        crate::program::start(self)?;
        self.block = block;
        Ok(())
    }

    /// Writes a text as a block.
    ///
    /// # Errors
    /// As [`Post::write_block`].
    pub(crate) fn write_line(&mut self, text: &str, numbered: bool) -> Result<(), Box<Diag>> {
        crate::program::start(self)?;
        if !text.is_ascii() {
            self.warn(PostCode::TapeText, format!("`{text}`"));
        }
        let cause = self.block.cause;
        self.tape.line(text, cause, numbered, &self.machine.addresses, &mut self.commons)
    }

    /// Writes the block under construction at once, or keeps its words for a
    /// motion to come.
    ///
    /// # Errors
    /// As [`Post::write_block`].
    pub(crate) fn place_block(&mut self, placement: Placement) -> Result<(), Box<Diag>> {
        if placement == Placement::OwnBlock {
            return self.write_block();
        }
        let block = self.block.take();
        self.state.pending.push((placement, block));
        Ok(())
    }

    /// Writes the words that still wait for a motion, each in a block of its own.
    ///
    /// # Errors
    /// As [`Post::write_block`].
    pub(crate) fn flush_pending(&mut self) -> Result<(), Box<Diag>> {
        let cause = self.block.cause;
        for (_, words) in std::mem::take(&mut self.state.pending) {
            self.block = words;
            self.write_block()?;
        }
        self.block.cause = cause;
        Ok(())
    }

    /// Does something whose words are due to another cause than the record that
    /// is carried out.
    pub(crate) fn because<T>(&mut self, cause: Cause, act: impl FnOnce(&mut Post) -> T) -> T {
        let record = std::mem::replace(&mut self.block.cause, cause);
        let point_word = std::mem::take(&mut self.state.point_word);
        let result = act(self);
        self.block.cause = record;
        self.state.point_word = point_word;
        result
    }

    /// What is put next is due to the item that the form gave last.
    pub(crate) fn due_to(&mut self, form: &Form) {
        self.block.cause.word = form.last_word();
    }

    /// Adds a word to the block under construction.
    ///
    /// # Errors
    /// As [`Block::word`].
    pub(crate) fn word(&mut self, letter: u8, value: f64) -> Result<(), Box<Diag>> {
        self.block.word(letter, value, &self.machine.addresses)
    }

    /// Adds a plane selection unless the control stands at it.
    pub(crate) fn plane_code(&mut self, code: i32) {
        if self.state.plane != Some(code) {
            self.block.g(code);
            self.state.plane = Some(code);
        }
    }

    /// Forgets the motion code when FIL has emptied the last output of G.
    pub(crate) fn check_forgotten(&mut self) {
        if self.commons.last_output(G) == EMPTY {
            self.state.motion = None;
        }
    }
}
