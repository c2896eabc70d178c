//! LOADTL/n\[,LENGTH,l]\[,OSETNO,o], LOAD/TOOL,n\[,ADJUST,o], TURRET/n: tool change;
//! SELCTL/n and SELECT/TOOL,n: the next tool.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::axes::AXES;
use crate::cause::Cause;
use crate::commons::EMPTY;
use crate::letters::{G, H, T};
use crate::locations as loc;
use crate::motion::{AxisSet, Position};
use crate::post::Post;

/// Changes the tool and calls its length offset.
///
/// # Errors
/// No tool number, or one that does not fit.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let offset = match form.couplet(w::OSETNO)? {
        Some(offset) => Some(offset),
        None => form.couplet(w::ADJUST)?,
    };
    let offset = offset.map(|offset| (offset, form.last_word()));
    form.couplet(w::LENGTH)?;
    let tool = tool_number(&mut form)?;
    post.due_to(&form);
    let tool_cause = post.block.cause;
    let (offset, offset_cause) = match offset {
        Some((offset, word)) => (whole(&form, offset)?, Cause { word, ..tool_cause }),
        None => (tool, tool_cause),
    };
    form.finish(post);
    super::cycle::cancel(post)?;
    post.flush_pending()?;
    post.state.thread = None;
    if post.commons.flag(loc::TOOL_MODAL) && post.state.tool == Some(tool) {
        return Ok(());
    }
    post.because(tool_cause.whole(), change_position)?;
    if post.commons.int(loc::TOOL_FORMAT) == 2 {
        post.word(T, (tool * 100 + offset) as f64)?;
        post.write_block()?;
        restate(post);
    } else {
        change(post, tool)?;
        restate(post);
        post.because(offset_cause, |post| length_offset(post, offset))?;
    }
    post.state.tool = Some(tool);
    Ok(())
}

/// Forgets where the tape stands: the change may have moved the machine.
fn restate(post: &mut Post) {
    if !post.commons.flag(loc::TOOL_RESTATE) {
        return;
    }
    for number in (0..AXES).filter(|number| post.machine.present() & 1 << number != 0) {
        post.commons.set_last_output(post.machine.axis(number).letter, EMPTY);
    }
    post.commons.set_last_output(G, EMPTY);
}

/// Names the next tool, on a machine that prepares it.
///
/// # Errors
/// No tool number, or one that does not fit.
pub fn select(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let tool = tool_number(&mut form)?;
    post.due_to(&form);
    form.finish(post);
    if !post.commons.flag(loc::TOOL_PRESELECT) {
        return Ok(());
    }
    post.word(T, tool as f64)?;
    post.write_block()
}

fn tool_number(form: &mut Form) -> Result<i64, Box<Diag>> {
    form.flag(w::TOOL);
    let number = form.required("the tool number")?;
    whole(form, number)
}

fn whole(form: &Form, number: f64) -> Result<i64, Box<Diag>> {
    if number.fract() == 0.0 && (0.0..1e9).contains(&number) {
        return Ok(number as i64);
    }
    Err(form.error(format!("{number} is no tool or offset number")))
}

/// Goes to the machine's change position before the change (INTCOM 1872,
/// DBLCOM 604–609); coordinates that are absent stay where they are.
fn change_position(post: &mut Post) -> Result<(), Box<Diag>> {
    let axes = match post.commons.int(loc::TOOL_CHANGE_BLOCK) {
        1 => &loc::CHANGE_POSITION[..3],
        2 => &loc::CHANGE_POSITION[..],
        _ => return Ok(()),
    };
    let mut position: Position = Default::default();
    let mut moving: AxisSet = 0;
    for (common, location) in axes.iter().enumerate() {
        let Some(value) = post.commons.dbl_opt(*location) else { continue };
        if let Some(number) = post.machine.axis_of_common(common) {
            position[number] = value;
            moving |= 1 << number;
        }
    }
    post.rapid_to(&position, moving)
}

/// Writes T and the change code, in one block or two.
fn change(post: &mut Post, tool: i64) -> Result<(), Box<Diag>> {
    post.word(T, tool as f64)?;
    if post.commons.flag(loc::TOOL_SEPARATE_BLOCKS) {
        post.write_block()?;
    }
    match post.commons.int_opt(loc::TOOL_CHANGE_CODE) {
        Some(code) => post.because(post.block.cause.whole(), |post| post.block.m(code)),
        None => post.warn_no_code("a tool change"),
    }
    post.write_block()
}

/// Calls the length offset: with the Z position of the machine (own location
/// `tool.length_z`) in a block of its own, else with the next Z motion.
fn length_offset(post: &mut Post, offset: i64) -> Result<(), Box<Diag>> {
    let Some(code) = post.commons.int_opt(loc::TOOL_LENGTH_CODE) else { return Ok(()) };
    if !post.commons.flag(loc::TOOL_LENGTH_FROM_TOOL) {
        return Ok(());
    }
    if let Some(cancel) = post.commons.int_opt(loc::TOOL_LENGTH_CANCEL_CODE) {
        post.block.g_of_record(cancel);
        post.write_block()?;
    }
    let Some(z) = post.commons.dbl_opt(loc::TOOL_LENGTH_Z) else {
        post.state.length_offset = Some((offset, post.block.cause));
        post.commons.set_last_output(post.machine.axis(2).letter, EMPTY);
        return Ok(());
    };
    post.block.g_of_record(code);
    post.axis_word(2, z, true)?;
    post.word(H, offset as f64)?;
    post.write_block()?;
    post.commons.set_last_output(G, EMPTY);
    Ok(())
}
