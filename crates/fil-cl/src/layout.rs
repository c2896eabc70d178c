//! From the items of a statement to the words of a record.
//!
//! The same for a statement of the CL file and for one a script makes, so that
//! both look alike to whoever counts words.

use fil_diag::Diag;

use crate::errors::ClCode;
use crate::reader::reads_as_text;
use crate::record::{CIRCLE_SURFACE, CUTTER_SUB, Circle, Record, Word, kind, mode, motion};
use crate::vocabulary::{Vocabulary, WordId};
use crate::words;

/// How far the length of a tool axis or of a circle's axis may be from 1: CL files round to
/// three decimals at the coarsest, which changes the length by less.
const UNIT_TOLERANCE: f64 = 1e-3;

/// The words of a CIRCLE before its center: modifier, surface type, count, the name slots.
const CIRCLE_HEAD: [Word; 5] = [
    Word::Number(0.0),
    Word::Number(CIRCLE_SURFACE as f64),
    Word::Number(7.0),
    Word::Empty,
    Word::Empty,
];

/// Why items do not make a record.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeError {
    /// The code to report.
    #[doc(hidden)]
    pub code: ClCode,
    /// What is wrong, in a sentence.
    pub message: String,
    /// Index of the item at fault; the number of items when one is missing.
    pub item: usize,
}

impl std::fmt::Display for ShapeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "item {}: {}", self.item + 1, self.message)
    }
}

impl std::error::Error for ShapeError {}

impl From<ShapeError> for Box<Diag> {
    fn from(error: ShapeError) -> Self {
        error.code.diag(error.message)
    }
}

/// True for a vector of length 1, as far as CL files are exact.
#[inline]
pub(crate) fn is_unit(vector: [f64; 3]) -> bool {
    (length(vector) - 1.0).abs() <= UNIT_TOLERANCE
}

/// The length of a vector.
#[inline]
pub(crate) fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
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

/// True for the known words whose statement says nothing without items.
pub(crate) fn needs_items(major: WordId) -> bool {
    matches!(
        major,
        words::CUTTER
            | words::TLAXIS
            | words::FEDRAT
            | words::SPINDL
            | words::COOLNT
            | words::LOADTL
            | words::LOAD
            | words::SELCTL
            | words::SELECT
            | words::TURRET
            | words::TOOLNO
            | words::CYCLE
            | words::CUTCOM
            | words::DELAY
            | words::MACHIN
            | words::UNITS
            | words::UNIT
            | words::PREFUN
            | words::AUXFUN
            | words::SEQNO
            | words::MODE
            | words::OP
            | words::THREAD
            | words::TRANS
            | words::TRACUT
            | words::REPEAT
            | words::REPLAC
            | words::POSTN
            | words::ROTATE
            | words::ROTABL
            | words::ROTHED
            | words::HEAD
            | words::OPSKIP
            | words::SET
            | words::LINTOL
            | words::ARCSLP
            | words::CALSUB
            | words::ORIGIN
            | words::COUPLE
            | words::PITCH
            | words::CLEARP
            | words::TLDATA
            | words::MSYS
            | words::TRNTYP
            | words::INTOL
            | words::OUTTOL
    )
}

/// True for a record of an NC alias, `NAME : text`: a word of nobody with one text that is no item.
pub fn is_alias(record: &Record, vocab: &Vocabulary) -> bool {
    match record.data[..] {
        [word @ Word::Text { .. }] if takes_texts_as_items(record.major) => {
            record.kind == kind::POST && !reads_as_text(vocab, record.text_of(word))
        }
        _ => false,
    }
}

/// True for the words whose items may be texts: names of a machine, and words that are not
/// in the vocabulary of this crate.
pub(crate) fn takes_texts_as_items(major: WordId) -> bool {
    major == words::MACHIN || major.index() >= words::NAMES_AND_CLASSES.len()
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

    /// A GOTO to a point in the unit of the program and the coordinates of the part, with the tool axis (a
    /// vector of length 1 from the tip into the holder) if there is one. What is wrong with it is
    /// told when it is posted; [`Record::motion`] tells at once.
    pub fn goto(point: [f64; 3], axis: Option<[f64; 3]>) -> Self {
        let mut record = Record::default();
        record.fill_goto(&point, axis.as_ref());
        record
    }

    /// A CIRCLE record.
    pub fn arc(circle: Circle) -> Self {
        let mut record = Record::default();
        record.fill_arc(circle);
        record
    }

    /// Makes this record a CIRCLE, keeping its buffers and its line.
    pub(crate) fn fill_arc(&mut self, circle: Circle) {
        self.kind = kind::SURFACE;
        self.sub = CIRCLE_SURFACE;
        self.major = words::CIRCLE;
        self.inert = false;
        self.text.clear();
        self.data.clear();
        self.data.extend_from_slice(&CIRCLE_HEAD);
        self.data.extend_from_slice(&circle.center.map(Word::Number));
        self.data.extend_from_slice(&circle.axis.map(Word::Number));
        self.data.push(circle.radius.map_or(Word::Empty, Word::Number));
    }

    /// Makes this record a GOTO, keeping its buffers.
    #[inline(always)]
    pub(crate) fn fill_goto(&mut self, point: &[f64; 3], axis: Option<&[f64; 3]>) {
        self.kind = kind::MOTION;
        self.sub = motion::GOTO;
        self.major = words::GOTO;
        self.inert = false;
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

    /// Checks three values that must be a tool axis or the axis of a circle; to be called on
    /// the items, before [`Record::arrange`].
    pub(crate) fn check_axis(&self) -> Result<(), ShapeError> {
        let is_axis = match self.major {
            words::GOTO | words::FROM => self.leading_numbers() == 6,
            words::CIRCLE => self.leading_numbers() >= 6,
            _ => false,
        };
        let [_, _, _, Word::Number(i), Word::Number(j), Word::Number(k), ..] = self.data[..] else {
            return Ok(());
        };
        if !is_axis || is_unit([i, j, k]) {
            return Ok(());
        }
        let length = length([i, j, k]);
        Err(match self.major {
            words::CIRCLE => {
                bad_point(format!("the axis of the circle has length {length:.4}, not 1"), 3)
            }
            _ => ShapeError {
                code: ClCode::UnclearPoints,
                message: format!(
                    "the last three values are no tool axis: length {length:.4}, not 1"
                ),
                item: 3,
            },
        })
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
        self.data.splice(0..0, CIRCLE_HEAD);
    }

    /// How many items from the first on are numbers.
    fn leading_numbers(&self) -> usize {
        self.data.iter().take_while(|word| matches!(word, Word::Number(_))).count()
    }
}

fn bad_point(message: String, item: usize) -> ShapeError {
    ShapeError { code: ClCode::BadPoint, message, item }
}
