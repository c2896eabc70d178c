//! LOADTL that a section takes and carries out by blocks of its own: a macro of the control, a code of
//! the shop, a manual change.

use fil_diag::Result;

use crate::control_state::{Length, Place, Source, modal};
use crate::errors::PostCode;
use crate::post::Post;

/// What was written before a section began to run at LOADTL.
#[derive(Clone, Copy, Debug)]
pub struct BeforeSection {
    /// Blocks of authors.
    blocks: u64,
    changes: u32,
    /// When M6 and a length were last written, as counts of writes.
    written: [u32; 2],
}

impl BeforeSection {
    /// At the start of the section.
    pub fn new(post: &Post) -> Self {
        let (control, groups) = (&post.control, post.control.state.groups());
        BeforeSection {
            blocks: control.warnings.author_blocks,
            changes: control.tools.changes,
            written: [groups.written(modal::TOOL_CHANGED), groups.written(modal::LENGTH_WORD)],
        }
    }
}

/// A section has taken LOADTL of a tool and its length offset, and wrote blocks in its place: they
/// change the tool. Axes that they may have moved anywhere are at the change position, and the
/// length of the tool is called with the next motion unless the blocks name one.
///
/// # Errors
/// The doubt about the axes, by its level.
pub fn is_taken(post: &mut Post, before: BeforeSection, tool: i64, offset: i64) -> Result<()> {
    let now = BeforeSection::new(post);
    let control = &mut post.control;
    let has_changed = now.written[0] != before.written[0];
    // What `[effects]` names a tool change is one to this tool, where its block names none.
    let is_said = has_changed
        && control.state.length() == Length::Ended
        && control.state.get(modal::LENGTH_OFFSET).is_none();
    let is_known = now.changes != before.changes || has_changed && !is_said;
    let is_same = control.state.get(modal::TOOL) == Some(tool);
    if now.blocks == before.blocks || is_known || is_same || !control.calls_lengths() {
        return Ok(());
    }
    let present = control.tables.present();
    if present.numbers().any(|number| control.place(number) == Place::Unknown) {
        let diag = PostCode::UnknownLevel.diag(
            "a section changes the tool with blocks that the post can't read, so the position of the axes is not known",
        );
        control.mild_doubt(diag, "taken to be the change position")?;
    }
    for number in present.numbers() {
        let letter = control.tables.axis(number).letter;
        // Where the section has written a position, the axis is there.
        if control.state.has_last(letter) || control.place(number) == Place::Unknown {
            control.state.tool_change_moves(letter);
        }
    }
    control.state.forget(modal::MOTION, Source::Author);
    control.state.has_tool(Some(tool));
    if is_said {
        control.state.set(modal::LENGTH_OFFSET, offset);
    } else if now.written[1] == before.written[1] {
        control.state.set(modal::NAMED_TOOL, offset);
        control.state.set(modal::LENGTH, Length::OfAnotherTool);
        control.state.doubt(control.tables.axis(2).letter);
    }
    Ok(())
}
