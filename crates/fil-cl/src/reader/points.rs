//! GOTO and FROM: values to points and tool axes.

use fil_diag::Result;

use super::{Meaning, Reader, plain};
use crate::dialect::AxisRule;
use crate::errors::ClCode;
use crate::layout::{is_unit, length};
use crate::record::{Record, Word};
use crate::words;

/// The tool axis of three axes.
const UPRIGHT: [f64; 3] = [0.0, 0.0, 1.0];

/// The points of a GOTO not yet handed out.
#[derive(Default)]
pub(super) struct Pending {
    values: Vec<f64>,
    next: usize,
    /// Values of one point: 3 or 6.
    group: usize,
    line: u32,
}

impl Pending {
    /// True when all points are handed out.
    pub(super) fn is_empty(&self) -> bool {
        self.next == self.values.len()
    }

    pub(super) fn clear(&mut self) {
        self.values.clear();
        self.next = 0;
    }

    /// Points to be handed out, all of one line and with one tool axis, if there is one.
    pub(super) fn give(&mut self, points: &[[f64; 3]], axis: Option<[f64; 3]>, line: u32) {
        self.clear();
        for point in points {
            self.values.extend_from_slice(point);
            self.values.extend(axis.into_iter().flatten());
        }
        (self.group, self.line) = (if axis.is_some() { 6 } else { 3 }, line);
    }

    /// The next point, with its tool axis.
    fn next(&mut self) -> ([f64; 3], Option<[f64; 3]>) {
        let mut point = [0.0; 6];
        point[..self.group].copy_from_slice(&self.values[self.next..self.next + self.group]);
        self.next += self.group;
        let [x, y, z, i, j, k] = point;
        ([x, y, z], (self.group == 6).then_some([i, j, k]))
    }
}

impl Reader<'_> {
    /// The short way for the most frequent statement: `GOTO / x, y, z[, i, j, k]`
    /// in one line, with numbers in fixed point. Anything else is left to the
    /// long way, which gives the same record.
    #[inline]
    pub(super) fn read_plain_goto(&mut self, record: &mut Record) -> bool {
        let (text, numbers) = (self.lines.unread(), &mut self.known_numbers);
        let Some((point, behind)) = plain::plain_point(text, numbers) else { return false };
        let (axis, rest) = if let Some(rest) = plain::line_end(behind) {
            (None, rest)
        } else if let Some((axis, rest)) = plain::plain_axis(behind, numbers, &mut self.known_axis)
            && is_unit(axis)
        {
            (Some(axis), rest)
        } else {
            return false;
        };
        let length = text.len() - rest.len();
        if self.modal.forms.watches_motions() || !self.follows_arc(point) {
            return false;
        }
        record.line = self.take_lines(length, 1);
        self.give_point(record, point, axis);
        true
    }

    /// Makes `record` a GOTO; a tool axis left out is the one the dialect means.
    #[inline]
    fn give_point(&mut self, record: &mut Record, point: [f64; 3], axis: Option<[f64; 3]>) {
        if axis.is_some() {
            self.keep(axis, record.line);
        }
        self.modal.in_arc = false;
        self.modal.point = Some(point);
        let axis = if self.modal.axis.is_none() { None } else { self.whole_axis(point, axis) };
        record.fill_goto(&point, axis.as_ref());
        self.count(record);
    }

    /// The tool axis of a point, with the one that the dialect means where it has none.
    fn whole_axis(&mut self, point: [f64; 3], axis: Option<[f64; 3]>) -> Option<[f64; 3]> {
        let whole = axis.or(self.axis_left_out());
        if whole != axis && self.keeps_meaning() {
            self.keep_meaning(Meaning::Records(vec![Record::goto(point, whole)]));
            return axis;
        }
        whole
    }

    /// Hands out the next point of a GOTO with several.
    pub(super) fn next_pending(&mut self, record: &mut Record) {
        let (point, axis) = self.pending.next();
        record.line = self.pending.line;
        self.give_point(record, point, axis);
    }

    /// All points not yet handed out, as GOTO records.
    pub(super) fn take_pending(&mut self) -> Vec<Record> {
        let mut records = Vec::new();
        while !self.pending.is_empty() {
            let (point, axis) = self.pending.next();
            let record = Record::goto(point, axis.or(self.axis_left_out()));
            records.push(Record { line: self.pending.line, ..record });
            self.modal.point = Some(point);
        }
        records
    }

    /// Takes all points but the first out of a GOTO with several.
    ///
    /// Six values are a point and a tool axis, which has length 1. Two points in one GOTO
    /// look the same, so six other values are refused. More than six are points where the
    /// dialect documents that, and points with tool axes while MULTAX is on.
    pub(super) fn split_points(&mut self, record: &mut Record) -> Result<()> {
        self.pending.clear();
        let group = self.points_of(record);
        let Ok(Some(group)) = group else {
            // What is refused, here or when the record is arranged, leaves no point behind.
            self.pending.clear();
            return group.map(|_| ());
        };
        record.data.truncate(group);
        self.pending.next = group;
        self.pending.group = group;
        self.pending.line = record.line;
        Ok(())
    }

    /// Collects the values of a GOTO and tells how many make a point; `None` for one point, or
    /// for what is no list of points.
    fn points_of(&mut self, record: &Record) -> Result<Option<usize>> {
        for word in &record.data {
            let Word::Number(value) = word else { return Ok(None) };
            self.pending.values.push(*value);
        }
        let count = self.pending.values.len();
        let group = match count {
            6 => {
                self.check_axis(record)?;
                6
            }
            _ if count <= 3 || !self.rules().packed_points => count,
            _ if self.modal.multax && count.is_multiple_of(6) => {
                self.check_axes()?;
                6
            }
            _ if !self.modal.multax && count.is_multiple_of(3) => {
                self.check_points()?;
                3
            }
            _ => count,
        };
        Ok(Some(group).filter(|group| *group != count))
    }

    /// Refuses a tool axis or a circle's axis that is no unit vector.
    pub(super) fn check_axis(&self, record: &Record) -> Result<()> {
        let Err(error) = record.check_axis() else { return Ok(()) };
        Err(self.diag(error.code, &error.message, self.three_items(error.item)))
    }

    /// Refuses a tool axis of another length than 1.
    fn check_axes(&self) -> Result<()> {
        let values = &self.pending.values;
        let axis = |at: &usize| [values[*at], values[*at + 1], values[*at + 2]];
        let mut places = (3..values.len()).step_by(6);
        let Some(at) = places.find(|at| !is_unit(axis(at))) else { return Ok(()) };
        let length = length(axis(&at));
        let message = format!("a tool axis of length {length:.4}, not 1");
        Err(self.diag(ClCode::UnclearPoints, &message, self.three_items(at)))
    }

    /// Refuses a list of points that could be points with tool axes, or that lie on an arc.
    fn check_points(&self) -> Result<()> {
        let values = &self.pending.values;
        let axes = values.chunks(6).all(|six| six.len() == 6 && is_unit([six[3], six[4], six[5]]));
        let message = match () {
            () if axes => "points, or points with tool axes while MULTAX is off",
            () if self.modal.in_arc => "several points after a CIRCLE whose start is not known",
            () => return Ok(()),
        };
        Err(self.diag(ClCode::UnclearPoints, message, self.all_items()))
    }

    fn three_items(&self, first: usize) -> std::ops::Range<usize> {
        self.item_range(first).start..self.item_range(first + 2).end
    }

    fn all_items(&self) -> std::ops::Range<usize> {
        self.item_range(0).start..self.item_range(usize::MAX).end
    }

    /// Keeps the tool axis of a motion, or adds the one that the dialect means.
    pub(super) fn keep_axis(&mut self, record: &mut Record) {
        self.modal.in_arc = false;
        self.modal.point = record.point();
        match record.axis() {
            Some(axis) => self.keep(Some(axis), record.line),
            None => {
                if let Some(axis) = self.axis_left_out() {
                    record.data.extend_from_slice(&axis.map(Word::Number));
                }
            }
        }
    }

    /// GOHOME/x,y,z\[,i,j,k]: where it leads is a matter of the post; its tool axis stays.
    pub(super) fn keep_home(&mut self, record: &Record) {
        self.modal.point = None;
        if let [.., Word::Number(i), Word::Number(j), Word::Number(k)] = record.data[..]
            && record.data.len() == 6
        {
            self.keep(Some([i, j, k]), record.line);
        }
    }

    #[inline]
    fn keep(&mut self, axis: Option<[f64; 3]>, line: u32) {
        self.modal.axis = axis;
        if self.recognition.used.axis == 0 {
            self.recognition.used.axis = line;
        }
    }

    /// MULTAX and TLAXIS: the axis of motions that give none. Off brings it back to Z, and on
    /// begins there, as in the post.
    pub(super) fn set_mode(&mut self, record: &Record) {
        if record.major == words::TLAXIS {
            let takes = matches!(self.rules().axis, AxisRule::Modal | AxisRule::ModalInMultax);
            if takes && let [Word::Number(i), Word::Number(j), Word::Number(k)] = record.data[..] {
                self.modal.axis = Some([i, j, k]).filter(|axis| is_unit(*axis));
            }
            return;
        }
        self.modal.multax = !record.has(words::OFF);
        if self.rules().axis == AxisRule::ModalInMultax {
            let kept = self.modal.axis.filter(|_| self.modal.multax);
            self.modal.axis = Some(kept.unwrap_or(UPRIGHT));
        }
    }

    /// The tool axis of a motion that gives none.
    pub(super) fn axis_left_out(&self) -> Option<[f64; 3]> {
        match self.rules().axis {
            AxisRule::AsWritten => None,
            AxisRule::Modal => self.modal.axis,
            AxisRule::ModalInMultax if self.modal.multax => self.modal.axis,
            AxisRule::ModalInMultax => None,
            // A file of three axes shows none, so that its records stay as short as they were.
            AxisRule::Upright => self.modal.axis.map(|_| UPRIGHT),
        }
    }
}
