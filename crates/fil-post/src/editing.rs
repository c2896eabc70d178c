//! The door for whoever edits blocks before they go to the tape.

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

    /// Takes the warnings of the edits away.
    fn take_warnings(&mut self) -> Vec<Diag>;
}

/// The editor of a run. It belongs to that run alone, so a clone has none.
#[derive(Default)]
pub struct EditorSlot(pub Option<Box<dyn Editor>>);

impl Clone for EditorSlot {
    fn clone(&self) -> Self {
        EditorSlot(None)
    }
}
