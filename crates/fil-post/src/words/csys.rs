//! CSYS, MSYS, CATMAT and CATIA's `$$*CATIA0`: the frame that the points behind it are of.
//!
//! A file that names one frame throughout has its points in it, and the word changes nothing. A
//! second frame may mean two things. PTC's help says of CSYS that the points stay those of the
//! machine's frame while the tool axis shows how the frame of the operation is turned, and so do
//! the files of SolidWorks CAM; NX and CATIA give the points in the frame they name. So a turned
//! CSYS that the tool axis behind it follows leaves the points alone, `input.csys = 1` moves
//! points and tool axes into the frame that was named first, and anything else is refused. What
//! a frame means is settled at the first motion behind it.

use fil_cl::record::motion;
use fil_cl::vocabulary::words as w;
use fil_cl::{Record, Word};
use fil_diag::{Diag, Result};
use fil_machine::locations::{self as loc, InputCsys};
use nalgebra::{Matrix3, Vector3};

use super::trans;
use crate::errors::PostCode;
use crate::path::Transformation;
use crate::path::named_frames::{Layout, Named, NamedFrames};
use crate::post::Post;

/// A tool axis this near to the Z of a frame follows it.
const ALONG: f64 = 1e-4;

/// Two turns this near are one.
const SAME: f64 = 1e-6;

/// Words that name a clamping of the part: the setup of SolidWorks CAM, the part operation of
/// CATIA.
const CLAMPINGS: [&str; 2] = ["SETUP", "PART_OPE"];

const HINT: &str = "Post each clamping from a file of its own. Where all points are those of one \
                    frame, list the word under words.without_effect in machine.toml; where each \
                    frame has its own points, input.csys = 1 moves them into the first.";

/// Takes the frame or the clamping that a record names; any other record changes nothing.
///
/// # Errors
/// A second clamping.
pub fn note(post: &mut Post, name: &str, record: &Record) -> Result<()> {
    // SETUP/END ends the clamping that SETUP/START has named.
    let ends = record.data.first() == Some(&Word::Minor(w::END));
    let is_clamping = CLAMPINGS.contains(&name) && !ends;
    let layout = Layout::of(name, record);
    if (layout.is_none() && !is_clamping)
        || post.control.commons.words_without_effect().iter().any(|word| word == name)
    {
        return Ok(());
    }
    let has_moved = post.path.last.has_moved;
    let frames = &mut post.path.named_frames;
    let Some(named) = frames.take(name, layout, record, has_moved) else { return Ok(()) };
    if !is_clamping {
        frames.waits = true;
        return Ok(());
    }
    if named.is_first() {
        return Ok(());
    }
    let message = format!("{name} of line {} names another clamping of the part", named.line);
    PostCode::OtherFrame.err_with(message, HINT)
}

/// Settles what the frames mean that came since the last motion, before one with this tool axis.
///
/// # Errors
/// A frame other than the first whose points may be those of the part or its own; frames of two
/// words that differ; beside another word that moves the points, or within an arc.
#[inline]
pub(crate) fn settle(post: &mut Post, axis: Vector3<f64>) -> Result<()> {
    if post.path.named_frames.waits { settle_new(post, axis) } else { Ok(()) }
}

/// Settles them before a tool axis that counts in the frame at hand, where points are moved.
///
/// # Errors
/// As [`settle`].
pub(crate) fn settle_moves(post: &mut Post) -> Result<()> {
    let moves = post.control.commons.read(loc::INPUT_CSYS) == InputCsys::PointsOfEachSystem;
    if moves && post.path.named_frames.waits {
        settle_new(post, post.path.axis.given)
    } else {
        Ok(())
    }
}

/// Settles them before a point without an axis of its own, which takes over the last one.
///
/// # Errors
/// As [`settle`]; a frame has turned under a leaning axis.
#[cold]
pub(crate) fn settle_axis(post: &mut Post, record: &Record) -> Result<()> {
    if record.sub == motion::FROM {
        return Ok(());
    }
    settle(post, post.path.axis.given)?;
    if post.path.axis.in_doubt {
        return PostCode::OtherFrame.err_with(
            "a point without a tool axis, after a coordinate system that was rotated under a tilted tool",
            "Give the tool axis with the first point in the frame (GOTO/x,y,z,i,j,k), or by TLAXIS.",
        );
    }
    Ok(())
}

#[cold]
fn settle_new(post: &mut Post, axis: Vector3<f64>) -> Result<()> {
    post.path.named_frames.waits = false;
    if post.control.commons.read(loc::INPUT_CSYS) == InputCsys::PointsOfEachSystem {
        return move_points(post);
    }
    let NamedFrames { words, points_of_part, .. } = &mut post.path.named_frames;
    for named in words.iter_mut() {
        if !std::mem::take(&mut named.is_new) {
            continue;
        }
        let normal = named.now.matrix().map(|frame| frame.column(2).into_owned());
        let is_turned = normal.is_some_and(|normal| (normal - Vector3::z()).norm() > ALONG);
        let follows = normal.is_some_and(|normal| (axis.normalize() - normal).norm() <= ALONG);
        *points_of_part |= named.word == "CSYS" && is_turned && follows;
        let is_of_part = *points_of_part && named.word == "CSYS" && (follows || !is_turned);
        if !(named.is_first() || is_of_part && normal.is_some()) {
            return Err(another(named));
        }
    }
    Ok(())
}

/// Refuses a record that is read again behind a frame that was named after it: its points would
/// be taken for those of that frame.
///
/// # Errors
/// It is.
#[cold]
pub(crate) fn refuse_read_again(post: &Post) -> Result<()> {
    let since = post.path.named_frames.since;
    PostCode::OtherFrame.err_with(
        format!("a move is read again, after a coordinate system that was named after it (record {since})"),
        "Go back only to records after the last coordinate system.",
    )
}

/// Brings what follows from the frame at hand into the first.
fn move_points(post: &mut Post) -> Result<()> {
    let mut moved: Option<(&str, u32, Option<Transformation>)> = None;
    for named in post.path.named_frames.words.iter().filter(|named| named.is_of_points()) {
        if named.is_late() {
            return Err(another(named));
        }
        let by = named.moved().map_err(|()| no_frame(&named.word))?;
        match &moved {
            Some((word, line, other)) if !is_same_move(other.as_ref(), by.as_ref()) => {
                let message = format!(
                    "{word} of line {line} and {} of line {} differ",
                    named.word, named.line
                );
                return PostCode::OtherFrame.err_with(message, HINT);
            }
            _ => moved = Some((&named.word, named.line, by)),
        }
    }
    let Some((word, _, moved)) = moved.map(|(word, line, by)| (word.to_string(), line, by)) else {
        return Ok(());
    };
    let turn =
        |trans: Option<&Transformation>| trans.map_or_else(Matrix3::identity, |it| it.linear());
    let turns = (turn(post.path.transformation.as_ref()) - turn(moved.as_ref())).amax() > SAME;
    trans::csys(post, &word, moved)?;
    // Whether a leaning axis stays in space or in numbers is not in the file.
    post.path.axis.in_doubt =
        turns && (post.path.axis.given.normalize() - Vector3::z()).norm() > ALONG;
    Ok(())
}

fn is_same_move(one: Option<&Transformation>, other: Option<&Transformation>) -> bool {
    match (one, other) {
        (None, None) => true,
        (Some(one), Some(other)) => (one.matrix - other.matrix).amax() <= SAME,
        _ => false,
    }
}

fn another(named: &Named) -> Box<Diag> {
    let (word, line) = (&named.word, named.line);
    let message = match named.is_late() {
        true => format!(
            "{word} of line {line} names a coordinate system, but the moves before it have an unknown one"
        ),
        false => format!(
            "{word} of line {line} names another frame than the first one, and the points may be \
             those of the part or of the frame"
        ),
    };
    let mut diag = PostCode::OtherFrame.diag(message);
    diag.hint = Some(HINT.to_string());
    diag
}

fn no_frame(name: &str) -> Box<Diag> {
    PostCode::WordForm
        .diag(format!("{name}: twelve numbers of a right-handed frame are needed (of MSYS nine)"))
}
