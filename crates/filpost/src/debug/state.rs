//! What a debugger sees of the post and may set, while the run stands still.

use fil_diag::Diag;
use fil_machine::commons::EMPTY;
use fil_machine::locations::TABLE;
use fil_machine::{Commons, Kind, Letter, Unit};
use fil_vm::View;

use super::modes;
use crate::error::RunCode;

/// The post behind the machine that stands still.
pub(crate) enum World<'s> {
    /// A record or a section is at work.
    Post(&'s mut fil_post::Post),
    /// A macro edits what is on its way to the tape: the settings can be read only.
    Writing(&'s Commons),
}

/// A run that stands still.
pub struct DebugState<'s, 'v> {
    /// Names, calls and the current record.
    pub fil: &'s mut View<'v>,
    pub(crate) world: World<'s>,
}

impl DebugState<'_, '_> {
    /// The settings of the machine as they are at this moment.
    pub fn commons(&self) -> &Commons {
        match &self.world {
            World::Post(post) => &post.control.commons,
            World::Writing(commons) => commons,
        }
    }

    /// The unit of the CL file, where it is known; `None` while a macro edits what is written.
    pub(crate) fn unit(&self) -> Option<Unit> {
        match &self.world {
            World::Post(post) => post.unit(),
            World::Writing(_) => None,
        }
    }

    /// Sets a location, as POSTF(2) does.
    ///
    /// # Errors
    /// A location or a value that there is not; a macro edits what is written.
    pub fn set_common(&mut self, kind: Kind, location: u32, value: f64) -> Result<(), Box<Diag>> {
        let World::Post(post) = &mut self.world else {
            return RunCode::WhileWriting.err("nothing can be set while a block is being written");
        };
        post.control.check_setting(kind, location, value)?;
        post.control.commons.set(kind, location, value)
    }

    /// The named settings that differ from their default, with their values.
    pub fn changed_settings(&self) -> Vec<(&'static str, Kind, u32, f64)> {
        let commons = self.commons();
        let rows = TABLE.iter().filter_map(|row| {
            let number = u32::from(row.number);
            let value = commons.get(row.kind, number).ok()?;
            (value != row.default_value()).then_some((row.name, row.kind, number, value))
        });
        rows.collect()
    }

    /// Blocks written so far; 0 while a macro edits what is written.
    pub fn blocks(&self) -> u64 {
        match &self.world {
            World::Post(post) => post.control.tape.count,
            World::Writing(_) => 0,
        }
    }

    /// The last blocks on the tape, the newest last; those that have gone to the writer
    /// already are not among them.
    pub fn last_blocks(&self, most: u64) -> Vec<String> {
        let World::Post(post) = &self.world else { return Vec::new() };
        let text = String::from_utf8_lossy(&post.control.tape.text);
        let lines: Vec<&str> = text.lines().collect();
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        let first = lines.len().saturating_sub(most);
        lines[first..].iter().map(|line| (*line).to_string()).collect()
    }

    /// The words of the block under construction: letter and value.
    pub fn pending_block(&self) -> Vec<(char, f64)> {
        let World::Post(post) = &self.world else { return Vec::new() };
        let words = post.control.block.words(&post.control.tables.addresses);
        words.into_iter().map(|(letter, value, _)| (char::from(letter.byte()), value)).collect()
    }

    /// The last value written for each letter, and whether the control is sure to have it.
    pub fn last_words(&self) -> Vec<(char, f64, bool)> {
        let letters = (b'A'..=b'Z').map(Letter::of);
        let words = letters.filter_map(|letter| {
            let value = self.commons().last_output(letter);
            let sure = match &self.world {
                World::Post(post) => post.control.state.has_last(letter),
                World::Writing(_) => true,
            };
            (value != EMPTY).then_some((char::from(letter.byte()), value, sure))
        });
        words.collect()
    }

    /// The modes that the control is known to be in: a name and a value in words each.
    pub fn modes(&self) -> Vec<(&'static str, String)> {
        let World::Post(post) = &self.world else { return Vec::new() };
        let mut modes = modes::of(&post.control.state, &post.control.commons);
        if let Some([x, y, z]) = post.point() {
            modes.push(("CL point", format!("{x}, {y}, {z}")));
        }
        modes
    }
}
