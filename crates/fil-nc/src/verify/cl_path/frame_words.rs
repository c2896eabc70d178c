//! Words that move points and tool axes: TRANS, and ORIGIN and TRACUT as the machine reads
//! them.

use fil_cl::{Record, words as w};
use fil_machine::axis_chain::{Carries, Rotary};
use fil_machine::locations::{InputCsys, InputOrigin, InputTracut, RotaryTableWords};
use nalgebra::{Matrix3x4, Vector3};

use super::named_frame::NamedFrames;
use super::{State, own_words};
use crate::forward::Forward;
use crate::motion::Position;
use crate::text::read_block;
use crate::verify::expected_step::{Effect, ExpectedStep, TableWay};
use crate::verify::statements::{numbers, numbers_beside};

/// What a machine takes words that move the frame for.
#[derive(Clone, Debug, Default)]
pub struct FrameWords {
    /// What ORIGIN names.
    pub origin: InputOrigin,
    /// What TRACUT does.
    pub tracut: InputTracut,
    /// What a second frame of CSYS and its like does.
    pub csys: InputCsys,
    /// The first and the last function of the machine's own work offsets.
    pub offsets: Option<(u32, u32)>,
    /// Words that the machine lists as without effect.
    pub without_effect: Vec<String>,
    /// What ROTABL does to the points.
    pub table: RotaryTableWords,
    /// Which way positions of the only table count where it turns clockwise, 1 or -1; `None` where
    /// the machine does not say.
    pub clockwise: Option<f64>,
    /// A record that names no direction turns it clockwise.
    pub by_default: bool,
    /// The rotary axes; `None` for a machine without one.
    pub forward: Option<Forward>,
    /// Where ROTABL or a block of an author has turned them, degrees; `None` for one that neither
    /// has.
    pub turned: [Option<f64>; 2],
    /// The letters of tables that stay where a block of an author turns them.
    pub author_turns: [Option<u8>; 2],
}

impl FrameWords {
    /// The machine lists the word as without effect.
    pub(super) fn is_without_effect(&self, word: &str) -> bool {
        self.without_effect.iter().any(|listed| listed == word)
    }
}

/// TRANS with a matrix.
pub(super) struct Matrix {
    pub(super) rows: Matrix3x4<f64>,
    pub(super) turns_axis: bool,
    pub(super) of: Mover,
}

/// What moves the points by a matrix.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Mover {
    /// The settings of the machine: no word takes it away.
    Machine,
    /// A word of the CL file.
    Record,
    /// A block of an author that has turned a table: a tool axis of a point turns it elsewhere.
    Author,
}

/// The frame that points of the CL file are in; lengths in CL units.
#[derive(Default)]
pub(super) struct Frame {
    pub(super) matrix: Option<Matrix>,
    pub(super) shift: Vector3<f64>,
    /// The machine's shift along its tool axis, which no TRANS ends.
    pub(super) along: Vector3<f64>,
    /// A matrix without OPTION leaves the tool axis alone.
    pub(super) leaves_axis: bool,
    pub(super) words: FrameWords,
    pub(super) named: NamedFrames,
}

impl Frame {
    /// True where a matrix of this origin moves the points.
    pub(super) fn is_moved_by(&self, mover: Mover) -> bool {
        self.matrix.as_ref().is_some_and(|matrix| matrix.of == mover)
    }

    /// True for a preparatory function that chooses a work offset.
    pub(super) fn chooses_offset(&self, code: f64) -> bool {
        let is_own = |(first, last)| (f64::from(first)..=f64::from(last)).contains(&code);
        let is_named = code.fract() == 0.0 && self.words.offsets.is_some_and(is_own);
        is_named || own_words::WORK_OFFSETS.contains(&code)
    }
}

impl State {
    pub(super) fn trans(&mut self, record: &Record) -> Vec<ExpectedStep> {
        if self.frame.is_moved_by(Mover::Machine) {
            let what = "TRANS beside input.matrix".to_string();
            return vec![ExpectedStep::Unknown { what, effect: Effect::Path }];
        }
        if record.has(w::NOMORE) || record.has(w::OFF) {
            self.frame.matrix = None;
            self.frame.shift = Vector3::zeros();
            return Vec::new();
        }
        let option = record.number_after(w::OPTION);
        let values = numbers_beside(record, &[w::OPTION]);
        match values[..] {
            [x, y, z] => self.frame.shift = Vector3::new(x, y, z),
            _ if values.len() == 12 => {
                let rows = Matrix3x4::from_row_slice(&values);
                let turns_axis = option.is_none() && !self.frame.leaves_axis;
                self.frame.matrix = Some(Matrix { rows, turns_axis, of: Mover::Record });
            }
            _ => {
                return vec![ExpectedStep::Unknown {
                    what: "TRANS".to_string(),
                    effect: Effect::Path,
                }];
            }
        }
        Vec::new()
    }

    /// ORIGIN as the machine reads it; `None` where it does not.
    pub(super) fn origin(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        let sign = match self.frame.words.origin {
            InputOrigin::Refused => return None,
            InputOrigin::MachineZeroInThePart => -1.0,
            InputOrigin::PartZeroOnTheMachine => 1.0,
        };
        if record.has(w::NOMORE) || record.has(w::OFF) {
            self.frame.shift = Vector3::zeros();
            return Some(Vec::new());
        }
        let [x, y, z] = numbers(record)[..] else { return None };
        self.frame.shift = Vector3::new(x, y, z) * sign;
        Some(Vec::new())
    }

    /// TRACUT as the machine reads it; `None` where it does not.
    pub(super) fn tracut(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        if self.frame.is_moved_by(Mover::Machine) || self.frame.words.tracut == InputTracut::Refused
        {
            return None;
        }
        if record.has(w::NOMORE) || record.has(w::OFF) {
            self.frame.matrix = None;
            return Some(Vec::new());
        }
        let values = numbers(record);
        let rows = (values.len() == 12).then(|| Matrix3x4::from_row_slice(&values))?;
        self.frame.matrix = Some(Matrix { rows, turns_axis: true, of: Mover::Record });
        Some(Vec::new())
    }

    /// ROTABL and ROTATE/TABLE as the machine reads them; `None` where it does not, or where
    /// the angle hangs on motions before.
    pub(super) fn table(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        if self.frame.words.table == RotaryTableWords::Refused {
            return None;
        }
        let forward = self.frame.words.forward.as_ref()?;
        let named = [w::AAXIS, w::BAXIS, w::CAXIS].iter().position(|axis| record.has(*axis));
        let is_meant = |rotary: &Rotary| {
            rotary.carries == Carries::Table && named.is_none_or(|named| named == rotary.axis)
        };
        let index =
            forward.rotaries().iter().position(|rotary| rotary.as_ref().is_some_and(is_meant))?;
        let [angle] = numbers(record)[..] else { return None };
        let rotary = forward.rotaries()[index].as_ref()?;
        let is_limited = rotary.is_limited();
        let way = self.way_of_table(record);
        let stood = self.frame.words.turned[index].or_else(|| self.zero_of(forward, index));
        let by = angle * way.unwrap_or(1.0);
        let (angle, way) = match (record.has(w::INCR), way) {
            (true, None) => (stood? + by, TableWay::Number),
            (true, Some(_)) => (stood? + by, TableWay::By(by)),
            (false, Some(way)) if !is_limited => {
                // Whole turns of the table are no matter to the points.
                let ahead =
                    stood.map(|stood| stood + way * ((angle - stood) * way).rem_euclid(360.0));
                (ahead.unwrap_or(angle), TableWay::Direction(way))
            }
            (false, _) => (angle, TableWay::Number),
        };
        self.frame.words.turned[index] = Some(angle);
        let turned = self.frame.words.turned.map(Option::unwrap_or_default);
        let unit = self.unit();
        match self.frame.words.table {
            RotaryTableWords::PointsStay => {
                let rows = slides(forward, turned, unit);
                self.frame.matrix = Some(Matrix { rows, turns_axis: true, of: Mover::Record });
            }
            _ => {
                self.tool.axis = forward.axis(turned);
                self.tool.point = None;
            }
        }
        Some(vec![ExpectedStep::Turn { index, angle, way }])
    }

    /// Zero for a rotary axis that no record has turned and that holds the tool as the points
    /// have it at zero alone; `None` for one that may be at any angle then.
    fn zero_of(&self, forward: &Forward, index: usize) -> Option<f64> {
        let mut quarter = [0.0; 2];
        quarter[index] = 90.0;
        let is_upright = |angles| (forward.axis(angles) - self.tool.axis).norm() < 1e-9;
        (!self.tool.multax && is_upright([0.0; 2]) && !is_upright(quarter)).then_some(0.0)
    }

    /// INSERT: a table that its block turns stays there, and points without a tool axis are
    /// positions of the slides.
    pub(super) fn insert(&mut self, record: &Record) -> Vec<ExpectedStep> {
        let text = record.text.trim().to_string();
        if !self.tool.multax && self.tool.axis == Vector3::z() {
            self.turn_by_text(&text);
        }
        vec![ExpectedStep::Insert { text, may_be_skipped: false }]
    }

    fn turn_by_text(&mut self, text: &str) {
        let Ok(block) = read_block(text.as_bytes(), "INSERT", 1) else { return };
        let unit = self.unit();
        let words = &mut self.frame.words;
        let before = words.turned;
        for (letter, turned) in words.author_turns.into_iter().zip(&mut words.turned) {
            let word = block.words.iter().find(|word| Some(word.letter) == letter);
            *turned = word.map(|word| word.number.value()).or(*turned);
        }
        let by_other = self.frame.matrix.as_ref().is_some_and(|matrix| matrix.of != Mover::Author);
        let (Some(forward), false) = (&words.forward, by_other || words.turned == before) else {
            return;
        };
        let angles = words.turned.map(Option::unwrap_or_default);
        let rows = slides(forward, angles, unit);
        self.frame.matrix = Some(Matrix { rows, turns_axis: true, of: Mover::Author });
    }

    /// Which way positions count as a record turns the table, 1 or -1; `None` where either will do.
    fn way_of_table(&self, record: &Record) -> Option<f64> {
        let clockwise = match (record.has(w::CLW), record.has(w::CCLW)) {
            (false, false) => self.frame.words.by_default,
            (clockwise, _) => clockwise,
        };
        let sense = self.frame.words.clockwise.filter(|_| !self.tool.multax)?;
        Some(if clockwise { sense } else { -sense })
    }
}

/// Brings positions of the slides, with the rotary axes at these angles, into the part; lengths in
/// CL units of `unit` mm.
fn slides(forward: &Forward, rotary: [f64; 2], unit: f64) -> Matrix3x4<f64> {
    let at = |linear: [f64; 3]| {
        let at = Position { linear, rotary, ..Position::default() };
        forward.pose(&at).tip / unit
    };
    let zero = at([0.0; 3]);
    let along = |n: usize| {
        let mut linear = [0.0; 3];
        linear[n] = unit;
        at(linear) - zero
    };
    Matrix3x4::from_columns(&[along(0), along(1), along(2), zero.coords])
}
