//! Values set by hand, with the moment they were set: a replay sets them again.

use filpost::Diag;
use filpost::Kind;
use filpost::cl::Word;
use filpost::debug::{DebugState, Held};

/// Where a run stands: statements and records begun so far, and whether the last of them is
/// over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Tick {
    /// Statements, records, sections and macros begun, from 1.
    pub number: u64,
    /// It has been carried out.
    pub is_over: bool,
}

/// A word of a record as it is set.
#[derive(Clone, Debug, PartialEq)]
pub enum NewWord {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// A vocabulary word.
    Minor(String),
}

/// A value set by hand.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// A name of FIL.
    Name(String, Held),
    /// An element of an array.
    Element(String, usize, Held),
    /// A word of the current record.
    Word(usize, NewWord),
    /// A location.
    Common(Kind, u32, f64),
}

impl Edit {
    /// Sets it.
    ///
    /// # Errors
    /// What can't be set.
    pub fn apply(&self, state: &mut DebugState<'_, '_>) -> Result<(), String> {
        let told = |done: Result<(), Box<Diag>>| done.map_err(|diag| diag.message.clone());
        match self {
            Edit::Name(name, value) => told(state.fil.set(name, value)),
            Edit::Element(name, index, value) => told(state.fil.set_element(name, *index, value)),
            Edit::Common(kind, number, value) => told(state.set_common(*kind, *number, *value)),
            Edit::Word(n, word) => set_word(*n, word, state),
        }
    }
}

fn set_word(n: usize, word: &NewWord, state: &mut DebugState<'_, '_>) -> Result<(), String> {
    let Some(record) = state.fil.record.as_deref_mut() else {
        return Err("there is no current record".to_string());
    };
    let word = match word {
        NewWord::Number(number) => Word::Number(*number),
        NewWord::Text(text) => record.store_text(text),
        NewWord::Minor(name) => Word::Minor(state.fil.vocabulary.intern(name)),
    };
    match record.set(n, word) {
        true => Ok(()),
        false => Err(format!("word {n} of the record can't be set")),
    }
}

/// All that was set by hand, in order.
#[derive(Clone, Debug, Default)]
pub struct Edits(Vec<(Tick, Edit)>);

impl Edits {
    /// Notes what was set.
    pub fn note(&mut self, at: Tick, edit: Edit) {
        self.0.push((at, edit));
    }

    /// Forgets what was set behind a moment.
    pub fn forget_behind(&mut self, at: Tick) {
        self.0.retain(|(tick, _)| *tick <= at);
    }

    /// What was set at a moment.
    pub fn at(&self, at: Tick) -> Vec<Edit> {
        self.0.iter().filter(|(tick, _)| *tick == at).map(|(_, edit)| edit.clone()).collect()
    }

    /// True when nothing was set.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
