//! The frames that words of the CL file have named, each word by itself.

use fil_cl::Record;
use fil_cl::record::{Word, kind};
use nalgebra::{Matrix3, Matrix3x4, Vector3};

use super::{Statement, Transformation};
use fil_diag::Result;

/// Two frames this near in each of their numbers are the same: CAM systems write 4 to 10 digits.
const SAME: f64 = 1e-6;

/// A frame as a file gives it may be this far from a right-angled one.
const RIGID: f64 = 1e-4;

/// The frames that the file has named so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct NamedFrames {
    /// Those of each word, which may count from a zero of its own.
    pub words: Vec<Named>,
    /// A frame came that no motion has followed yet.
    pub waits: bool,
    /// A tool axis has followed a turned CSYS: the points are those of the part throughout.
    pub points_of_part: bool,
    /// Number of the record that has named the last frame behind another, or behind a motion.
    pub since: u32,
}

impl NamedFrames {
    /// Takes what a record names; `None` when its word has named that last.
    pub fn take(
        &mut self,
        word: &str,
        layout: Option<Layout>,
        record: &Record,
        has_moved: bool,
    ) -> Option<&mut Named> {
        let known = self.words.iter().position(|named| named.word == word);
        if known.is_some_and(|at| self.words[at].now.is_of(record)) {
            return None;
        }
        let now = Frame::new(layout, record);
        let at = known.unwrap_or_else(|| {
            self.words.push(Named {
                word: word.to_string(),
                first: now.clone(),
                now: now.clone(),
                line: record.line,
                is_new: true,
                is_behind_motions: has_moved,
            });
            self.words.len() - 1
        });
        let named = &mut self.words[at];
        if known.is_some() && named.now.is_same(&now) {
            return None;
        }
        (named.now, named.line, named.is_new) = (now, record.line, true);
        if has_moved || known.is_some() {
            self.since = record.number;
        }
        Some(named)
    }
}

/// The frames that one word has named.
#[derive(Clone, Debug)]
pub(crate) struct Named {
    pub word: String,
    first: Frame,
    pub now: Frame,
    /// Line of the record that named `now`.
    pub line: u32,
    /// No motion has followed it.
    pub is_new: bool,
    /// Motions came before the first.
    is_behind_motions: bool,
}

impl Named {
    /// The word names a frame of points, and not a clamping.
    pub fn is_of_points(&self) -> bool {
        self.now.layout.is_some()
    }

    /// The frame at hand is the one that all motions before were in.
    pub fn is_first(&self) -> bool {
        self.first.is_same(&self.now) && !self.is_late()
    }

    /// Motions came before the first frame, and it is not the one that a file without any has.
    pub fn is_late(&self) -> bool {
        let is_plain = |frame: Matrix3x4<f64>| (frame - Matrix3x4::identity()).amax() <= SAME;
        self.is_behind_motions && !self.first.matrix().is_some_and(is_plain)
    }

    /// What brings points and tool axes from the frame at hand into the first; `None` where it is
    /// the first.
    ///
    /// # Errors
    /// The numbers of one of the two make no frame.
    pub fn moved(&self) -> Result<Option<Transformation>, ()> {
        if self.first.is_same(&self.now) {
            return Ok(None);
        }
        let (first, now) = self.first.matrix().zip(self.now.matrix()).ok_or(())?;
        let back = first.fixed_columns::<3>(0).transpose();
        let turn = back * now.fixed_columns::<3>(0);
        let shift = back * (now.column(3) - first.column(3));
        let columns = [turn.column(0).into(), turn.column(1).into(), turn.column(2).into(), shift];
        let matrix = Matrix3x4::from_columns(&columns);
        Ok(Some(Transformation { matrix, turns_axis: true, of: Statement::NamedFrame }))
    }
}

/// What a record has named.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    layout: Option<Layout>,
    items: Vec<Word>,
    text: String,
}

impl Frame {
    fn new(layout: Option<Layout>, record: &Record) -> Self {
        Frame { layout, items: record.data.clone(), text: record.text.clone() }
    }

    /// A record names it by the same items, as most files do at each operation.
    fn is_of(&self, record: &Record) -> bool {
        self.items == record.data && self.text == record.text
    }

    /// 3x4: its axes and its origin as columns; `None` where the items make none.
    pub fn matrix(&self) -> Option<Matrix3x4<f64>> {
        self.layout?.read(&numbers(&self.items))
    }

    /// The same frame; by its numbers where it has any, as its name may be that of an operation.
    fn is_same(&self, other: &Frame) -> bool {
        match (self.matrix(), other.matrix()) {
            (Some(one), Some(other)) => (one - other).amax() <= SAME,
            (None, None) => self.items == other.items && self.text == other.text,
            _ => false,
        }
    }
}

/// How a word gives its frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Layout {
    /// Twelve numbers: the rows of a 3x4 matrix, the origin in the fourth column.
    Rows,
    /// Origin, X and Y axis, and perhaps Z: nine or twelve numbers.
    Axes,
    /// A note with the numbers of some frame, in an order that is not known.
    Unknown,
}

impl Layout {
    /// That of the frame which a record names; `None` for any other record.
    pub fn of(name: &str, record: &Record) -> Option<Self> {
        match name {
            "CSYS" | "CATIA0" => Some(Layout::Rows),
            // A name without numbers is that of an operation.
            "CATMAT" if numbers(&record.data).is_empty() => None,
            "MSYS" | "CATMAT" => Some(Layout::Axes),
            _ if record.kind == kind::PSEUDO => {
                let numbers = numbers(&record.data);
                let is_frame = |layout: Layout| layout.read(&numbers).is_some();
                (is_frame(Layout::Rows) || is_frame(Layout::Axes)).then_some(Layout::Unknown)
            }
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
        let off = (turn.transpose() * turn - Matrix3::identity()).amax();
        (off <= RIGID && turn.determinant() > 0.0).then_some(frame)
    }
}

fn numbers(items: &[Word]) -> Vec<f64> {
    let number = |word: &Word| match word {
        Word::Number(number) => Some(*number),
        _ => None,
    };
    items.iter().filter_map(number).collect()
}
