//! From the items of a statement to the words of a record.
//!
//! The same for a statement of the CL file and for one a script makes, so that
//! both look alike to whoever counts words.

use crate::errors::ClCode;
use crate::record::{CIRCLE_SURFACE, CUTTER_SUB, Circle, Record, Word, kind, mode, motion};
use crate::vocabulary::WordId;
use crate::words;

/// Why items do not make a record.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeError {
    /// The code to report.
    pub code: ClCode,
    /// What is wrong, in a sentence.
    pub message: String,
    /// Index of the item at fault; the number of items when one is missing.
    pub item: usize,
}

/// True for the words whose statement is free text to its end.
pub fn takes_text(major: WordId) -> bool {
    matches!(
        major,
        words::PARTNO
            | words::PPRINT
            | words::INSERT
            | words::LETTER
            | words::REMARK
            | words::TITLES
            | words::TPRINT
            | words::TOOL_PATH
    )
}

/// What is said of motion that is given by geometry.
pub(crate) const UNCOMPUTED: &str = "this motion is given by geometry, not by points";

/// True for motion that is given by geometry, so that its points are unknown.
pub(crate) fn is_uncomputed(major: WordId) -> bool {
    matches!(
        major,
        words::INDIRV
            | words::INDIRP
            | words::TLON
            | words::TLLFT
            | words::TLRGT
            | words::GO
            | words::GOFWD
            | words::GOBACK
            | words::GOLFT
            | words::GORGT
            | words::GOUP
            | words::GODOWN
            | words::PSIS
            | words::NURBS
            | words::KNOT
            | words::CNTRL
    )
}

impl Record {
    /// The record a statement `major / items` makes; text items point into `text`.
    ///
    /// # Errors
    /// Coordinates of a wrong number or kind, or a motion without points.
    pub fn statement(major: WordId, items: Vec<Word>, text: String) -> Result<Self, ShapeError> {
        let mut record = Record { major, data: items, text, ..Record::default() };
        record.arrange()?;
        Ok(record)
    }

    /// A post command with one text word: PPRINT, INSERT, PARTNO and so on.
    pub fn text_command(major: WordId, text: &str) -> Self {
        let mut record = Record { kind: kind::POST, major, ..Record::default() };
        let word = record.store_text(text);
        record.data.push(word);
        record
    }

    /// A post command without items; push them on `data`.
    pub fn command(major: WordId) -> Self {
        Record { kind: kind::POST, major, ..Record::default() }
    }

    /// A GOTO to a point, with the tool axis if there is one.
    pub fn goto(point: [f64; 3], axis: Option<[f64; 3]>) -> Self {
        let mut record = Record::default();
        record.fill_goto(&point, axis.as_ref());
        record
    }

    /// A CIRCLE record.
    pub fn arc(circle: Circle) -> Self {
        let mut record = Record { major: words::CIRCLE, ..Record::default() };
        record.data.extend(circle.center.iter().chain(&circle.axis).map(|v| Word::Number(*v)));
        record.data.push(circle.radius.map_or(Word::Empty, Word::Number));
        record.wrap_circle();
        record
    }

    /// Makes this record a GOTO, keeping its buffers.
    pub(crate) fn fill_goto(&mut self, point: &[f64; 3], axis: Option<&[f64; 3]>) {
        self.kind = kind::MOTION;
        self.sub = motion::GOTO;
        self.major = words::GOTO;
        self.text.clear();
        self.data.clear();
        let [x, y, z] = point.map(Word::Number);
        self.data.extend_from_slice(&[Word::Empty, Word::Empty, x, y, z]);
        if let Some(axis) = axis {
            self.data.extend_from_slice(&axis.map(Word::Number));
        }
    }

    /// Sets type and subtype by the major word and turns the items in `data`
    /// into words.
    pub(crate) fn arrange(&mut self) -> Result<(), ShapeError> {
        (self.kind, self.sub) = match self.major {
            words::GOTO => return self.arrange_motion(motion::GOTO, &[3, 6]),
            words::FROM => return self.arrange_motion(motion::FROM, &[3, 6]),
            words::GODLTA => return self.arrange_motion(motion::GODLTA, &[1, 3]),
            words::CIRCLE => return self.arrange_circle(),
            words::CUTTER => (kind::CUTTER, CUTTER_SUB),
            words::TLAXIS => (kind::MODE, mode::TLAXIS),
            words::MULTAX => (kind::MODE, mode::MULTAX),
            words::FINI => (kind::FINI, 0),
            major if is_uncomputed(major) => {
                let message = UNCOMPUTED.to_string();
                return Err(ShapeError { code: ClCode::UncomputedMotion, message, item: 0 });
            }
            _ => (kind::POST, 0),
        };
        Ok(())
    }

    fn arrange_motion(&mut self, sub: u32, counts: &[usize]) -> Result<(), ShapeError> {
        let numbers = self.leading_numbers();
        if numbers < self.data.len() {
            return Err(bad_point("a coordinate must be a number".to_string(), numbers));
        }
        if !counts.contains(&numbers) {
            let allowed: Vec<String> = counts.iter().map(usize::to_string).collect();
            let message = format!("{numbers} values where {} are due", allowed.join(" or "));
            return Err(bad_point(message, numbers));
        }
        self.kind = kind::MOTION;
        self.sub = sub;
        self.data.splice(0..0, [Word::Empty, Word::Empty]);
        Ok(())
    }

    /// x,y,z,r; x,y,z,i,j,k; x,y,z,i,j,k,r and anything after it, which is kept
    /// as words 16 and up.
    fn arrange_circle(&mut self) -> Result<(), ShapeError> {
        match self.leading_numbers() {
            // Without an axis the arc lies in the XY plane, counterclockwise.
            4 => {
                self.data.splice(3..3, [0.0, 0.0, 1.0].map(Word::Number));
            }
            6 if self.data.get(6) == Some(&Word::Empty) => {}
            6 => self.data.insert(6, Word::Empty),
            numbers if numbers >= 7 => {}
            numbers => {
                let message = format!("{numbers} numbers where 4, 6 or 7 are due");
                return Err(bad_point(message, numbers));
            }
        }
        self.wrap_circle();
        Ok(())
    }

    /// Puts the canonical head before x, y, z, i, j, k, r.
    fn wrap_circle(&mut self) {
        self.kind = kind::SURFACE;
        self.sub = CIRCLE_SURFACE;
        let head = [0.0, f64::from(CIRCLE_SURFACE), 7.0].map(Word::Number);
        self.data.splice(0..0, head.into_iter().chain([Word::Empty, Word::Empty]));
    }

    /// How many items from the first on are numbers.
    fn leading_numbers(&self) -> usize {
        self.data.iter().take_while(|word| matches!(word, Word::Number(_))).count()
    }
}

fn bad_point(message: String, item: usize) -> ShapeError {
    ShapeError { code: ClCode::BadPoint, message, item }
}
