//! CUTCOM/LEFT|RIGHT\[,n]\[,XYPLAN|YZPLAN|ZXPLAN], CUTCOM/OFF: cutter compensation.

use fil_cl::Record;
use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_diag::Diag;

use super::form::Form;
use crate::locations as loc;
use crate::post::Post;
use crate::state::Placement;

/// Puts the compensation code, and the offset number when it is switched on,
/// with the next XY motion or in a block of their own.
///
/// # Errors
/// A form that is not known, a code the machine lacks.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    let side = form.any_of(&[w::LEFT, w::RIGHT, w::OFF]);
    let side_word = form.last_word();
    let plane = form.any_of(&[w::XYPLAN, w::YZPLAN, w::ZXPLAN]);
    let plane_word = form.last_word();
    let number = form.number();
    let number_word = if number.is_some() { form.last_word() } else { 0 };
    let location = match side {
        Some(w::LEFT) => loc::CUTCOM_LEFT_CODE,
        Some(w::RIGHT) => loc::CUTCOM_RIGHT_CODE,
        Some(_) => loc::CUTCOM_OFF_CODE,
        None => return Err(form.error("LEFT, RIGHT or OFF is needed")),
    };
    if let Some(plane) = plane {
        let location = match plane {
            w::YZPLAN => loc::CIRCLE_PLANE_YZ,
            w::ZXPLAN => loc::CIRCLE_PLANE_ZX,
            _ => loc::CIRCLE_PLANE_XY,
        };
        let code = post.code(location, "this plane")?;
        post.begin()?;
        post.block.cause.word = plane_word;
        post.plane_code(code);
        post.write_block()?;
    }
    let code = post.code(location, "cutter compensation")?;
    post.block.cause.word = side_word;
    post.block.g(code);
    if side != Some(w::OFF) {
        let from_tool = post.commons.flag(loc::TOOL_DIAMETER_FROM_TOOL);
        let offset = number.or(post.state.tool.filter(|_| from_tool).map(|tool| tool as f64));
        if from_tool && offset.is_none() {
            return Err(form.error("no offset number, and no tool is loaded"));
        }
        if let Some(offset) = offset {
            let letter = post.letter(loc::CUTCOM_ADDRESS, "the offset's address")?;
            post.block.cause.word = number_word;
            post.word(letter, offset)?;
        }
    }
    form.end()?;
    let with_motion = post.commons.flag(loc::CUTCOM_WITH_MOTION);
    post.place_block(if with_motion { Placement::NextXY } else { Placement::OwnBlock })
}
