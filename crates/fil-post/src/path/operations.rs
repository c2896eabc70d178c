//! Each operation of a post word brought to the machine, the moment it is made.

use super::{
    arc, compensation_side, counted_spindle, frame, frame_end, hole, index, lead_in, linear,
    machine_position, mill_turn, places, position, rotary, skip, tip_control, tool_change,
    way_home, whole_thread,
};
use crate::control::length_plane;
use crate::control::needs::Act;
use crate::control::word_address::motion;
use crate::operation::Operation;
use crate::post::Post;
use fil_diag::Result;

/// Carries out an operation: its blocks are on the tape when this returns, of an arc in very many
/// blocks the first ones.
///
/// # Errors
/// Whatever the machine or the control can't do.
pub fn carry_out(post: &mut Post, operation: Operation) -> Result<()> {
    if post.places.are_on {
        places::before(post, &operation)?;
    }
    match operation {
        Operation::Linear(target, kind) => linear::carry_out(post, &target, kind),
        Operation::Arc(arc, target) => {
            arc::refuse_nearly_full(post, &arc, target)?;
            lead_in::end(&mut post.control)?;
            if post.control.tables.mills() {
                mill_turn::before_arc(post, &arc, target)?;
            }
            arc::carry_out(post, &arc, target)
        }
        other => {
            if std::mem::take(&mut post.path.last.writes_inverse_time) {
                motion::leave_inverse_time(&mut post.control)?;
            }
            carry_out_other(post, other)
        }
    }
}

/// What is asked and done before an operation that is no motion of the path.
type Before = fn(&mut Post, &Operation) -> Result<()>;

/// In this order: nothing comes between a thread and its points; tool-tip control or a tilted frame
/// ends, out of which the tool goes up along itself first; then a mill-turn machine leaves its planes
/// of lengths; what an author's function may not change is what is in force then. A surface speed
/// that waits for the first cut begins before what depends on it.
const BEFORE: [Before; 8] = [
    |post, _| post.require(Act::Word),
    |post, operation| lead_in::before_operation(&mut post.control, operation),
    tip_control::before,
    frame_end::go_up,
    |post, operation| frame::before(&mut post.control, operation),
    mill_turn::before,
    |post, operation| counted_spindle::refuse_choices_of_others(&post.control, operation),
    |post, operation| length_plane::refuse_repeated(&post.control, operation),
];

fn carry_out_other(post: &mut Post, operation: Operation) -> Result<()> {
    BEFORE.iter().try_for_each(|before| before(post, &operation))?;
    skip::note(post, &operation);
    match operation {
        Operation::Text(_) | Operation::Words(_) => write_of_others(post, operation),
        Operation::Function(..) => {
            write_other(post, operation)?;
            compensation_side::refuse_of_others(post)
        }
        operation => write_other(post, operation),
    }
}

/// Writes a text or words of an author, and takes the machine to stand where they have brought it.
///
/// # Errors
/// They turn what is clamped, past its travel or in a tilted frame.
fn write_of_others(post: &mut Post, operation: Operation) -> Result<()> {
    let by_words = matches!(operation, Operation::Words(_));
    let stood = position::stands(&post.control);
    write_other(post, operation)?;
    compensation_side::refuse_of_others(post)?;
    let stands = position::stands(&post.control);
    if stands != stood {
        rotary::refuse_past_travel(&post.control, stood, stands)?;
        frame::refuse_turned(&post.control, [stood[3], stood[4]])?;
        post.path.leave_point();
        post.path.last.in_cut = false;
        post.path.last.turned_by_words = by_words;
        if !by_words {
            rotary::follow(post);
        }
        index::stay_turned(post, stood);
    }
    Ok(())
}

fn write_other(post: &mut Post, operation: Operation) -> Result<()> {
    match operation {
        Operation::Skip(on) => skip::switch(post, on),
        Operation::MachinePosition(to) => machine_position::carry_out(post, to),
        Operation::Turn(index, to) => index::turn(post, index, to),
        Operation::Hole(target) => hole::carry_out(post, target),
        Operation::Thread(thread) => whole_thread::carry_out(post, &thread),
        Operation::ToolChange(change) => tool_change::change(post, change),
        Operation::WorkOffset(number) => way_home::take_work_offset(post, number),
        Operation::End(end) => {
            way_home::before_end(post)?;
            post.control.family().write(&mut post.control, Operation::End(end))
        }
        other => post.control.family().write(&mut post.control, other),
    }
}
