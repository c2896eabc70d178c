//! The door for whoever edits blocks before they go to the tape, or says how rotary axes
//! are repositioned.

use fil_diag::{Diag, Result};
use fil_machine::{Commons, Letter};

/// Edits blocks on their way to the tape. The post asks it where the settings of the
/// machine say so (INTCOM 4667 and 1920).
pub trait Editor: Send + Sync {
    /// Edits the words of a block, in their order: changes values, leaves words out, adds
    /// words at the end. False when there is nobody to edit words.
    ///
    /// # Errors
    /// Whatever stops the run.
    fn words(&mut self, words: &mut Vec<(Letter, f64)>, commons: &Commons) -> Result<bool>;

    /// Edits a line of the tape; an empty line is left out. False when there is nobody to
    /// edit lines.
    ///
    /// # Errors
    /// Whatever stops the run.
    fn line(&mut self, line: &mut String, commons: &Commons) -> Result<bool>;

    /// True when there is somebody to say how rotary axes are repositioned.
    fn repositions(&self) -> bool;

    /// Decides on the way out and back at the limit of a rotary axis. Given are the positions
    /// of the two rotary axes before and after (degrees), the tip, and the tool axis, both in
    /// the part and in the program's unit.
    ///
    /// # Errors
    /// Whatever stops the run.
    fn reposition(&mut self, given: &[f64; 10], ways: &mut Ways, commons: &Commons) -> Result<()>;

    /// Takes the warnings of the edits away.
    fn take_warnings(&mut self) -> Vec<Diag>;
}

/// The way out and back at the limit of a rotary axis, as the settings have it; lengths in the
/// program's unit, feeds a minute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ways {
    /// How far the tool goes out.
    pub retract: Option<f64>,
    /// Its feed; 0 is rapid, absent the present one.
    pub retract_feed: Option<f64>,
    /// From where it comes back at feed; absent is all the way.
    pub approach: Option<f64>,
    /// The feed of the way back.
    pub approach_feed: Option<f64>,
    /// Out along the tool axis of the next point.
    pub along_next: bool,
    /// The spindle stands while the machine turns.
    pub spindle_stands: bool,
    /// Coolant is off then.
    pub coolant_off: bool,
    /// The optional stop after the way out.
    pub optional_stop: bool,
    /// The stop after the way out.
    pub stop: bool,
}

/// The editor of a run. It belongs to that run alone, so a clone has none.
#[derive(Default)]
pub struct EditorSlot(pub Option<Box<dyn Editor>>);

impl Clone for EditorSlot {
    fn clone(&self) -> Self {
        EditorSlot(None)
    }
}
