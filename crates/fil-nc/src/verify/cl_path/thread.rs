//! Threads of a CL file: passes of their own, and whole threads that the machine divides.

use fil_cl::{Record, Word, words as w};
use nalgebra::{Point3, Vector3};

use super::State;
use crate::motion::{INCH, Rate};
use crate::verify::expected_step::{Effect, ExpectedStep, WholeThread};

/// Where TO stands among the items of THREAD/AUTO,x,y,z,TO,x,y,z.
const TO: usize = 4;

/// OP/THREAD with depth and passes, before its two points. Lengths in CL units.
#[derive(Clone, Copy)]
pub(super) struct Awaited {
    on_face: bool,
    lead: f64,
    starts: u32,
    depth: f64,
    passes: u32,
    springs: Option<u32>,
    from: Option<Point3<f64>>,
    start: Option<Point3<f64>>,
}

/// Threads and their leads.
#[derive(Default)]
pub(super) struct Threads {
    /// The lead of the motions at hand.
    pub(super) lead: Option<Rate>,
    /// The lead of PITCH, for a thread that names none.
    pub(super) pitch: Option<Rate>,
    /// OP/THREAD that waits for the ends of its crest.
    pub(super) awaited: Option<Awaited>,
    /// How far from the crest the tool goes back from a thread that does not name it, mm.
    pub(super) clearance: f64,
}

impl State {
    /// OP/THREAD and THREAD; `None` for forms that leave the passes open.
    pub(super) fn thread(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        self.end_thread();
        if record.has(w::NOMORE) || record.has(w::OFF) {
            return Some(Vec::new());
        }
        if record.has(w::AUTO) {
            return Some(vec![ExpectedStep::WholeThread(Box::new(self.automatic(record)?))]);
        }
        if record.major == w::OP && !record.has(w::THREAD) {
            return None;
        }
        let says_lead = [w::TPI, w::MMPR, w::IPR].into_iter().any(|word| record.has(word));
        if let Some(pitch) = self.threads.pitch.filter(|_| record.major == w::THREAD && !says_lead)
        {
            self.threads.lead = Some(pitch);
            return Some(vec![ExpectedStep::ThreadBegins]);
        }
        let lead = self.lead(record)?;
        let given = |word| record.number_after(word).filter(|value| *value != 0.0);
        match (given(w::DEPTH), given(w::CUTS)) {
            (Some(depth), Some(passes)) => {
                let starts = record.number_after(w::MULTRD).unwrap_or(1.0).max(1.0) as u32;
                self.threads.awaited = Some(Awaited {
                    on_face: record.has(w::FACE),
                    lead: lead * f64::from(starts),
                    starts,
                    depth,
                    passes: passes as u32,
                    springs: record.number_after(w::FINCUT).map(|count| count as u32),
                    from: self.tool.point,
                    start: None,
                });
            }
            (None, None) => self.threads.lead = Some(Rate::PerTurn(lead)),
            _ => return None,
        }
        Some(vec![ExpectedStep::ThreadBegins])
    }

    /// PITCH: threads in a unit of the CL file or in an inch, or a lead that may change.
    pub(super) fn pitch(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        let belongs = |before: Option<&Word>| {
            let of_couplet = [w::INCR, w::DECR, w::MULTRD].map(Word::Minor);
            before.is_some_and(|word| of_couplet.contains(word))
        };
        let number = record.data.iter().enumerate().find_map(|(at, word)| match word {
            Word::Number(number) if !belongs(at.checked_sub(1).map(|at| &record.data[at])) => {
                Some(*number)
            }
            _ => None,
        })?;
        let (lead, unit) = match () {
            () if record.has(w::TPI) => (INCH / number, INCH),
            () if record.has(w::MMPR) => (number, 1.0),
            () if record.has(w::IPR) => (number * INCH, INCH),
            () => (self.unit() / number, self.unit()),
        };
        let gains = record.number_after(w::INCR).unwrap_or(0.0);
        let change = (gains - record.number_after(w::DECR).unwrap_or(0.0)) * unit;
        let rate = if change == 0.0 { Rate::PerTurn(lead) } else { Rate::Varying(lead, change) };
        self.threads.pitch = Some(rate);
        Some(Vec::new())
    }

    /// Ends a thread.
    pub(super) fn end_thread(&mut self) {
        self.threads.lead = None;
        self.threads.awaited = None;
    }

    /// The lead of a thread or tap in mm: TPI counts threads an inch.
    pub(super) fn lead(&self, record: &Record) -> Option<f64> {
        let after = |word| record.number_after(word);
        let lead = match (after(w::TPI), after(w::MMPR), after(w::IPR)) {
            (Some(threads), ..) => INCH / threads,
            (_, Some(millimetres), _) => millimetres,
            (.., Some(inches)) => inches * INCH,
            _ => return None,
        };
        Some(lead).filter(|lead| lead.is_finite() && *lead > 0.0)
    }

    /// THREAD/AUTO: the threads beside each other are a pitch apart.
    fn automatic(&mut self, record: &Record) -> Option<WholeThread> {
        if record.data.get(TO) != Some(&Word::Minor(w::TO)) {
            return None;
        }
        let value = |at: usize| match record.data.get(at) {
            Some(Word::Number(value)) => Some(*value),
            _ => None,
        };
        let begin = Point3::new(value(1)?, value(2)?, value(3)?);
        let end = Point3::new(value(5)?, value(6)?, value(7)?);
        let kind = record.data.iter().position(|word| *word == Word::Minor(w::TYPE))?;
        let (depth, angle) = (value(kind + 2)?, value(kind + 3)?);
        let starts = record.number_after(w::TIMES).unwrap_or(1.0).max(1.0);
        let from = self.tool.point;
        let word = [w::IN, w::OUT, w::FACE].into_iter().find(|word| record.has(*word));
        let out = match word {
            Some(w::FACE) => self.out_of_face(from, begin),
            Some(w::IN) => inwards(begin, end),
            Some(_) => -inwards(begin, end),
            None if from?.x.abs() < begin.x.abs() => inwards(begin, end),
            None => -inwards(begin, end),
        };
        let springs = record.number_after(w::LAST).map(|count| count as u32);
        let thread = WholeThread {
            crest: [begin, end],
            out,
            lead: self.lead(record)? * starts,
            starts: starts as u32,
            depth,
            first: record.number_after(w::DEEP)?,
            passes: None,
            springs,
            clearance: record.number_after(w::FEDTO),
            angle,
        };
        self.tool.point = self.stands_behind(&thread);
        Some(self.on_machine(&thread))
    }

    /// Out of a face, which looks to +Z, but for one of a part in the second spindle.
    fn out_of_face(&self, from: Option<Point3<f64>>, begin: Point3<f64>) -> Vector3<f64> {
        let is_behind = from.is_some_and(|from| from.z < begin.z);
        if self.spindle.is_side && is_behind { -Vector3::z() } else { Vector3::z() }
    }

    /// A point behind OP/THREAD: the first begins the crest, the second ends it.
    pub(super) fn point_of_thread(&mut self, point: Point3<f64>) -> Option<ExpectedStep> {
        let mut awaited = self.threads.awaited.take()?;
        let Some(begin) = awaited.start else {
            awaited.start = Some(point);
            self.threads.awaited = Some(awaited);
            return None;
        };
        let open = ExpectedStep::Unknown { what: "OP/THREAD".to_string(), effect: Effect::Path };
        let Some(from) = awaited.from else { return Some(open) };
        let out = match awaited.on_face {
            true => self.out_of_face(Some(from), begin),
            false if from.x.abs() < begin.x.abs() => inwards(begin, point),
            false => -inwards(begin, point),
        };
        let first = awaited.depth / f64::from(awaited.passes).sqrt();
        let thread = WholeThread {
            crest: [begin, point],
            out,
            lead: awaited.lead,
            starts: awaited.starts,
            depth: awaited.depth,
            first,
            passes: Some(awaited.passes),
            springs: awaited.springs,
            clearance: Some((from - begin).dot(&out).abs()),
            angle: 0.0,
        };
        self.tool.point = self.stands_behind(&thread);
        Some(ExpectedStep::WholeThread(Box::new(self.on_machine(&thread))))
    }

    /// Where the tool stands behind a whole thread, its lengths in CL units: clear of the crest,
    /// where its last start begins. `None` for a crest without length.
    fn stands_behind(&self, thread: &WholeThread) -> Option<Point3<f64>> {
        let [begin, end] = thread.crest;
        let way = end - begin;
        let axis = thread.axis();
        if way[axis] == 0.0 {
            return None;
        }
        let away = thread.lead / self.unit() * (1.0 - 1.0 / f64::from(thread.starts));
        let rise = way.dot(&thread.out);
        let rises = rise.max(-rise * away / way[axis].abs()).max(0.0);
        let clearance = thread.clearance.unwrap_or(self.threads.clearance / self.unit());
        let mut at = begin + thread.out * (clearance + rises);
        at[axis] -= way[axis].signum() * away;
        Some(at)
    }

    /// The thread as TRANS places it, in mm; its lead is in mm already.
    fn on_machine(&self, thread: &WholeThread) -> WholeThread {
        let place = |point: Point3<f64>| self.pose(point, Vector3::z()).tip;
        let crest = thread.crest.map(place);
        let out = place(thread.crest[0] + thread.out) - crest[0];
        let unit = self.unit();
        WholeThread {
            crest,
            out: out.try_normalize(1e-9).unwrap_or(thread.out),
            depth: thread.depth * unit,
            first: thread.first * unit,
            clearance: thread.clearance.map(|clearance| clearance * unit),
            ..*thread
        }
    }
}

/// Towards the axis of the spindle.
fn inwards(begin: Point3<f64>, end: Point3<f64>) -> Vector3<f64> {
    if begin.x + end.x < 0.0 { Vector3::x() } else { -Vector3::x() }
}
