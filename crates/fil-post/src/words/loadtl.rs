//! LOADTL/n\[,LENGTH,l]\[,OSETNO,o]\[,AUTO|MANUAL], LOAD/TOOL,n\[,ADJUST,o], TURRET/n: tool change;
//! LOADTL/n,ADJUST,c,TOOL with the number of one of the tool's own compensations;
//! SELCTL/n and SELECT/TOOL,n: the next tool.

use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations as loc;

use super::cutter;
use crate::cause::Cause;
use crate::control::sinumerik::tool_names;
use crate::items::Items;
use crate::operation::{OffsetFrom, Operation, ToolChange};
use crate::path::{Since, carry_out, thread};
use crate::post::Post;

/// Most a tool or offset number may be.
const MOST: f64 = 1e9;

/// Changes the tool and calls its length offset.
///
/// # Errors
/// No tool number, or one that does not fit; a tool change in cutter compensation.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    let of_tool = (1..items.len()).any(|at| items.word_at(at, w::TOOL));
    let takes_compensation = post.control.can().cutting_edges
        || post.control.commons.read(loc::TOOL_COMPENSATION_OFFSET);
    let offset = match items.couplet(w::OSETNO)? {
        Some(offset) => Some(offset),
        // The compensations of a tool have numbers of their own where the control has them so.
        None => items.couplet(w::ADJUST)?.filter(|_| !of_tool || takes_compensation),
    };
    let offset = offset.map(|offset| (offset, items.last_word()));
    let by_hand = items.flag(w::MANUAL);
    // The usual change, as without the word.
    items.flag(w::AUTO);
    gauge_length(post, items)?;
    let tool = tool_number(items)?;
    post.due_to(items);
    items.deny_rest()?;
    if tool == 0 {
        return refuse_none(items, "tool 0 is an empty spindle");
    }
    let cause = post.control.block.cause;
    let from_record = if of_tool { OffsetFrom::Compensation } else { OffsetFrom::Record };
    let (offset, offset_from, offset_cause) = match offset {
        Some((offset, word)) => (whole(items, offset)?, from_record, Cause { word, ..cause }),
        None => (tool, OffsetFrom::Tool, cause),
    };
    if offset == 0 {
        return refuse_none(items, "offset 0 cancels the tool length offset");
    }
    thread::end(post)?;
    post.path.interrupt();
    post.path.last.since = Since::ToolChange;
    post.path.last.in_cut = false;
    cutter::forget(post);
    tool_names::load(&mut post.control, tool)?;
    let causes = [cause, offset_cause];
    let next = std::mem::take(&mut post.path.ahead.tool.next);
    let speed = post.path.ahead.tool.speed.take();
    let change = ToolChange { tool, offset, offset_from, by_hand, next, speed, causes };
    carry_out(post, Operation::ToolChange(change))
}

/// Refuses a number that stands for none: the motions behind it would bring the spindle nose
/// to where the tip belongs.
fn refuse_none(items: &Items, message: &str) -> Result<()> {
    let mut diag = items.error(message);
    diag.hint = Some(
        "Give the number of the tool or offset; INSERT T0 M6 empties the spindle where no motion follows."
            .into(),
    );
    Err(diag)
}

/// LENGTH is the tool's length in the CAM system. The control measures its tools
/// itself; only positions of the axes of a head that turns about a pivot would need it, unless
/// the machine says that it is passed over.
fn gauge_length(post: &Post, items: &mut Items) -> Result<()> {
    let length = items.couplet(w::LENGTH)?;
    let tables = &post.control.tables;
    let holds_positions = tables.chain().pivot.is_some() && !tables.tip_output;
    if length.is_some() && holds_positions && !post.control.commons.read(loc::TOOL_IGNORE_LENGTH) {
        let mut diag = items.error("LENGTH would change the pivot distance of the head");
        diag.hint = Some(
            "Post with TCPC (rotary.tip_output = 1), where the control knows the length; set tool.ignore_length = 1 if all tools have the same length."
                .into(),
        );
        return Err(diag);
    }
    Ok(())
}

/// Names the next tool, on a machine that prepares it.
///
/// # Errors
/// No tool number, or one that does not fit.
pub fn select(post: &mut Post, items: &mut Items) -> Result<()> {
    let tool = tool_number(items)?;
    post.due_to(items);
    items.deny_rest()?;
    carry_out(post, Operation::SelectTool(tool))
}

fn tool_number(items: &mut Items) -> Result<i64> {
    items.flag(w::TOOL);
    let number = items.required("the tool number")?;
    whole(items, number)
}

fn whole(items: &Items, number: f64) -> Result<i64> {
    if number.fract() == 0.0 && (0.0..MOST).contains(&number) {
        return Ok(number as i64);
    }
    Err(items.error(format!("{number} is not a tool or offset number")))
}
