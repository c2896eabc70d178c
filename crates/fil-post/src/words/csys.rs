//! CSYS, MSYS, CATMAT and CATIA's `$$*CATIA0`: the frame that the points behind it are of.
//!
//! A file that names one frame throughout has its points in it, and the word changes nothing. A
//! second frame may mean two things. PTC's help says of CSYS that the points stay those of the
//! machine's frame while the tool axis shows how the frame of the operation is turned, and so do
//! the files of SolidWorks CAM; NX and CATIA give the points in the frame they name. So a turned
//! frame that the tool axis behind it follows leaves the points alone, `input.csys = 1` moves
//! points and tool axes into the frame that was named first, and anything else is refused.

use fil_cl::Record;
use fil_cl::record::Word;
use fil_diag::Result;
use fil_machine::locations::{self as loc, InputCsys};
use nalgebra::{Matrix3x4, Vector3};

use super::trans;
use crate::errors::PostCode;
use crate::path::Transformation;
use crate::post::Post;

/// Two frames this near in each of their numbers are the same: CAM systems write 4 to 10 digits.
const SAME: f64 = 1e-6;

/// A tool axis this near to the Z of a frame follows it.
const ALONG: f64 = 1e-4;

/// A frame as a file gives it may be this far from a right-angled one.
const RIGID: f64 = 1e-4;

/// Words that name a clamping of the part: the setup of SolidWorks CAM, the part operation of
/// CATIA.
const CLAMPINGS: [&str; 2] = ["SETUP", "PART_OPE"];

/// The frames that the file has named so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct NamedFrames {
    /// Those of each word, which may count from a zero of its own.
    words: Vec<Named>,
    /// The word whose frame no motion has followed yet, as a place in `words`.
    waits: Option<(usize, Layout)>,
    /// A tool axis has followed a turned frame: the points are those of the part throughout.
    points_of_part: bool,
    /// The clamping that was named first: the items of its record, their text, and its line.
    clamping: Option<(Vec<Word>, String, u32)>,
}

/// The frames that one word has named.
#[derive(Clone, Debug)]
struct Named {
    word: String,
    /// Its numbers as they are written.
    first: Vec<f64>,
    now: Vec<f64>,
    /// Line of the record that named `now`.
    line: u32,
}

impl Named {
    /// What brings points and tool axes from the frame at hand into the first; `None` where it is
    /// the first.
    fn moved(&self, layout: Layout) -> Result<Option<Transformation>> {
        if is_same(&self.first, &self.now) {
            return Ok(None);
        }
        let frames = layout.read(&self.first).zip(layout.read(&self.now));
        let Some((first, now)) = frames else { return Err(no_frame(&self.word)) };
        let back = first.fixed_columns::<3>(0).transpose();
        let turn = back * now.fixed_columns::<3>(0);
        let shift = back * (now.column(3) - first.column(3));
        let columns = [turn.column(0).into(), turn.column(1).into(), turn.column(2).into(), shift];
        Ok(Some(Transformation { matrix: Matrix3x4::from_columns(&columns), turns_axis: true }))
    }
}

impl NamedFrames {
    /// Takes a frame; `None` when the word has named it last.
    fn take(&mut self, word: &str, line: u32, frame: Vec<f64>) -> Option<usize> {
        let Some(at) = self.words.iter().position(|named| named.word == word) else {
            let word = word.to_string();
            self.words.push(Named { word, first: frame.clone(), now: frame, line });
            return Some(self.words.len() - 1);
        };
        let named = &mut self.words[at];
        if is_same(&named.now, &frame) {
            return None;
        }
        (named.now, named.line) = (frame, line);
        Some(at)
    }
}

/// Takes the frame or the clamping that a record names; any other record changes nothing.
///
/// # Errors
/// A second clamping; with `input.csys = 1` a second frame that its numbers don't make, that comes
/// between a CIRCLE and its end, or beside another word that moves the points.
pub fn note(post: &mut Post, name: &str, record: &Record) -> Result<()> {
    let layout = Layout::of(name);
    if layout.is_none() && !CLAMPINGS.contains(&name) {
        return Ok(());
    }
    if post.control.commons.words_without_effect().iter().any(|word| word == name) {
        return Ok(());
    }
    let Some(layout) = layout else { return refuse_second_clamping(post, name, record) };
    let numbers = record.data.iter().filter_map(|word| match word {
        Word::Number(number) => Some(*number),
        _ => None,
    });
    let frames = &mut post.path.named_frames;
    let Some(at) = frames.take(name, record.line, numbers.collect()) else { return Ok(()) };
    if post.control.commons.read(loc::INPUT_CSYS) == InputCsys::PointsOfEachFrame {
        let named = &frames.words[at];
        let moved = named.moved(layout)?;
        return trans::csys(post, name, moved);
    }
    frames.waits = Some((at, layout));
    Ok(())
}

/// Refuses a clamping other than the first: it needs a stop, and its points count from a zero of
/// their own.
fn refuse_second_clamping(post: &mut Post, name: &str, record: &Record) -> Result<()> {
    let first = &mut post.path.named_frames.clamping;
    let (items, text, line) =
        first.get_or_insert_with(|| (record.data.clone(), record.text.clone(), record.line));
    if *items == record.data && *text == record.text {
        return Ok(());
    }
    let mut diag = PostCode::OtherFrame
        .diag(format!("{name}: another clamping of the part than that of line {line}"));
    diag.hint = Some(format!(
        "Post each clamping from a file of its own, or list {name} under words.without_effect in \
         machine.toml where the part stays as it is."
    ));
    Err(diag)
}

/// Looks at the tool axis of the first motion behind a frame.
///
/// # Errors
/// A frame other than the first whose points may be those of the part or its own.
#[inline]
pub(crate) fn judge(post: &mut Post, axis: Vector3<f64>) -> Result<()> {
    if post.path.named_frames.waits.is_some() { judge_first(post, axis) } else { Ok(()) }
}

#[cold]
fn judge_first(post: &mut Post, axis: Vector3<f64>) -> Result<()> {
    let NamedFrames { words, waits, points_of_part, .. } = &mut post.path.named_frames;
    let Some((at, layout)) = waits.take() else { return Ok(()) };
    let (named, name) = (&words[at], words[at].word.as_str());
    let is_first = is_same(&named.first, &named.now);
    let Some(frame) = layout.read(&named.now) else {
        return if is_first { Ok(()) } else { Err(no_frame(name)) };
    };
    let normal = frame.column(2).into_owned();
    let is_turned = (normal - Vector3::z()).norm() > ALONG;
    let follows = (axis.normalize() - normal).norm() <= ALONG;
    *points_of_part |= name == "CSYS" && is_turned && follows;
    if is_first || (*points_of_part && (follows || !is_turned)) {
        return Ok(());
    }
    let mut diag = PostCode::OtherFrame.diag(format!(
        "{name} of line {} names another frame than the first one, and the points may be those of \
         the part or of the frame",
        named.line
    ));
    diag.hint = Some(format!(
        "Post each clamping from a file of its own. Where all points are those of one frame, list \
         {name} under words.without_effect in machine.toml; where each frame has its own points, \
         input.csys = 1 moves them into the first."
    ));
    Err(diag)
}

/// How a word gives its frame.
#[derive(Clone, Copy, Debug)]
enum Layout {
    /// Twelve numbers: the rows of a 3x4 matrix, the origin in the fourth column.
    Rows,
    /// Origin, X and Y axis, and perhaps Z: nine or twelve numbers.
    Axes,
}

impl Layout {
    fn of(name: &str) -> Option<Self> {
        match name {
            "CSYS" | "CATIA0" => Some(Layout::Rows),
            "MSYS" | "CATMAT" => Some(Layout::Axes),
            _ => None,
        }
    }

    /// The frame, 3x4: its axes and its origin as columns. `None` where the numbers make none.
    fn read(self, numbers: &[f64]) -> Option<Matrix3x4<f64>> {
        let frame = match (self, numbers) {
            (Layout::Rows, rows) if rows.len() == 12 => Matrix3x4::from_row_slice(rows),
            (Layout::Axes, values) if matches!(values.len(), 9 | 12) => {
                let column = |at: usize| Vector3::from_column_slice(&values[at..at + 3]);
                let (x, y) = (column(3), column(6));
                let z = if values.len() == 12 { column(9) } else { x.cross(&y) };
                Matrix3x4::from_columns(&[x, y, z, column(0)])
            }
            _ => return None,
        };
        let turn = frame.fixed_columns::<3>(0);
        let off = (turn.transpose() * turn - nalgebra::Matrix3::identity()).amax();
        (off <= RIGID && turn.determinant() > 0.0).then_some(frame)
    }
}

fn is_same(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len()
        && one.iter().zip(other).all(|(one, other)| (one - other).abs() <= SAME)
}

fn no_frame(name: &str) -> Box<fil_diag::Diag> {
    PostCode::WordForm
        .diag(format!("{name}: twelve numbers of a right-handed frame are needed (of MSYS nine)"))
}
