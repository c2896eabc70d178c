//! A block of an author, read once: INSERT, a text of the machine, a block that a macro has
//! edited. The reader of the family makes the value from the text alone; whoever asks what the
//! block does asks the value, and the control learns from the same one.

use fil_machine::{FunctionCode, Letter, letters};

use super::doubts::MachineSpot;
use super::modal::{Group, Modal, Of, Value};

/// In which frame the axis words of a block count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextFrame {
    /// In the one before it.
    #[default]
    Stays,
    /// In that of the machine, in this block.
    OfTheMachine,
    /// In one with another zero, which they may say.
    Shifted,
    /// In a frame that may be turned, which they may say.
    Turned,
    /// Nobody has read them all.
    Unread,
}

/// What a statement of the control's language does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effect {
    /// A modal group has this value.
    Set(Group, Value),
    /// A modal group may have any value.
    Forget(Group),
    /// The last output value of a letter is not what the control has.
    Doubt(Letter),
    /// The axes stand where they stood, and the next motion says them.
    DoubtAxes,
    /// The axes may have gone anywhere.
    LoseAxes,
    /// The axes count from another zero.
    ShiftAxes,
    /// An axis stands at a position of the machine, which may be known.
    Clears(Letter, Option<MachineSpot>),
    /// An axis stands at this value of the tape.
    Stands(Letter, f64),
    /// A tool change may have moved all axes.
    ToolChangeMoves,
    /// An auxiliary function by its number.
    Auxiliary(f64),
    /// Another cutting edge of the tool, or none (D).
    Edge(f64),
    /// The cycle that MCALL calls is another one.
    OtherCall,
    /// END PGM stands on the tape.
    EndsProgramText,
    /// What can't be read may have changed all.
    Unread,
    /// The tool was changed to the one of this number, or to the last one that was named
    /// (`[effects]`).
    ChangesTool(Option<f64>),
    /// The axes stand at positions of the machine that are clear of the part (`[effects]`).
    ReturnsClear,
    /// Modes may be others, and the axes stand where they stood (`[effects]`).
    KeepsPosition,
}

impl Effect {
    /// A modal group has a value.
    pub fn set<T: Modal>(of: Of<T>, value: T) -> Self {
        Effect::Set(of.group, value.value())
    }
}

/// A block of an author, as the reader of the control's family sees it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForeignBlock {
    /// What goes to the tape.
    pub text: String,
    /// The control may skip the block.
    pub skipped: bool,
    /// Letters and numbers in their order, as far as they can be read, the number of the block
    /// left out. A variable in place of a number is no number (NaN).
    pub words: Vec<(Letter, f64)>,
    /// The parts of a block in a language of statements, in upper case.
    pub items: Vec<String>,
    /// What statements do to the frame.
    pub frame: TextFrame,
    /// What they do besides, in their order.
    pub effects: Vec<Effect>,
    /// The first part that can't be read.
    pub unread: Option<String>,
    /// `[effects]` says what it does.
    pub is_said: bool,
    /// The pattern of `[effects]` that says what it does.
    pub pattern: Option<String>,
}

impl ForeignBlock {
    /// A part can't be read; the control may be in any state behind it.
    pub fn cannot_read(&mut self, part: &str) {
        self.unread.get_or_insert_with(|| part.to_string());
        self.effects.push(Effect::Unread);
    }

    /// The words of a block that was read whole; none of another.
    pub fn words(&self) -> &[(Letter, f64)] {
        if self.unread.is_none() { &self.words } else { &[] }
    }

    /// The words that certainly stand in it: of a block of items each one that is a word, whatever
    /// the others are; of a text of words those of one that was read whole.
    pub fn certain_words(&self) -> &[(Letter, f64)] {
        if self.items.is_empty() { self.words() } else { &self.words }
    }

    /// True where nothing but words stands in it, each of a letter and a number.
    pub fn is_words(&self) -> bool {
        let is_word = |item: &String| {
            let number = item.get(1..).map(str::parse::<f64>);
            item.starts_with(|c: char| c.is_ascii_alphabetic()) && matches!(number, Some(Ok(_)))
        };
        self.unread.is_none() && self.items.iter().all(is_word)
    }

    /// The first statement with one of these names, which may have arguments.
    pub fn named(&self, names: &[&str]) -> Option<&str> {
        let has_name = |item: &&String| names.contains(&item.split('(').next().unwrap_or(item));
        self.items.iter().find(has_name).map(String::as_str)
    }

    /// A function that is meant stands in it.
    pub fn has_function(&self, is_meant: impl Fn(Letter, FunctionCode) -> bool) -> bool {
        let of_words = self.words().iter().copied();
        let of_effects = self.effects.iter().filter_map(|effect| match effect {
            Effect::Auxiliary(number) => Some((letters::M, *number)),
            _ => None,
        });
        of_words.chain(of_effects).any(|(letter, value)| {
            FunctionCode::of_value(value).is_some_and(|code| is_meant(letter, code))
        })
    }

    /// True for `L400`, a call of a subprogram on some controls: L without a motion or cycle that
    /// it could repeat.
    pub fn calls_subprogram(&self) -> bool {
        let has = |letter: u8| self.words.iter().any(|(word, _)| word.byte() == letter);
        has(b'L') && !has(b'G') && !has(b'M')
    }
}

/// The preparatory functions among words.
pub fn functions(words: &[(Letter, f64)]) -> impl Iterator<Item = FunctionCode> {
    let of_g = words.iter().filter(|(letter, _)| *letter == letters::G);
    of_g.filter_map(|(_, value)| FunctionCode::of_value(*value))
}
