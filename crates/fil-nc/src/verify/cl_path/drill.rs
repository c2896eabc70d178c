//! CYCLE: the holes at the points to come.

use std::collections::VecDeque;

use fil_cl::record::FIRST_DATA;
use fil_cl::{Record, Word, WordId, words as w};
use fil_machine::cycle_kind::CycleKind;
use nalgebra::{Point3, Vector3};

use super::super::expected_step::ExpectedStep;
use super::{Cycle, State};
use crate::motion::Rate;

const CYCLES: [(WordId, CycleKind); 11] = [
    (w::BRKCHP, CycleKind::Brkchp),
    (w::DEEP, CycleKind::Deep),
    (w::DEEP2, CycleKind::Deep),
    (w::DRILL, CycleKind::Drill),
    (w::CSINK, CycleKind::Csink),
    (w::TAP, CycleKind::Tap),
    (w::BORE, CycleKind::Bore),
    (w::REAM, CycleKind::Ream),
    (w::FACE, CycleKind::Face),
    (w::THRU, CycleKind::Thru),
    (w::MILL, CycleKind::Mill),
];

/// TIMES of BRKCHP: after so many pecks the tool leaves the hole.
fn out_each(record: &Record) -> Option<u32> {
    let each = record.number_after(w::TIMES)?;
    (each >= 1.0).then_some(each as u32)
}

impl State {
    /// The motions of a hole through several plates: at feed through each, at rapid over the gaps
    /// to CLEAR above the next one, and up.
    pub(super) fn hole_through_plates(
        &mut self,
        cycle: &Cycle,
        start: Point3<f64>,
        axis: Vector3<f64>,
    ) -> ExpectedStep {
        let along = axis.normalize();
        let came_from = *self.came_from.get_or_insert(self.tool.point.unwrap_or(start));
        let here = self.tool.point.map(|here| (here - start).dot(&along));
        let clear = cycle.clear.unwrap_or(0.0);
        let top = match cycle.retract {
            Some(0.0) => (came_from - start).dot(&along),
            level => level.unwrap_or(clear),
        };
        let mut levels: Vec<(f64, bool)> = Vec::new();
        levels.extend(here.filter(|here| *here > clear).map(|here| (here, true)));
        levels.push((clear, true));
        for gap in self.plates.chunks_exact(2) {
            levels.extend([(-gap[0], false), (clear - gap[1], true)]);
        }
        levels.extend([(-cycle.depth, false), (top.max(clear), true)]);
        let pose = |level: f64| self.pose(start + along * level, axis);
        let steps = levels.iter().map(|(level, rapid)| match rapid {
            true => ExpectedStep::Rapid(pose(*level)),
            false => ExpectedStep::Feed(pose(*level), cycle.rate),
        });
        let mut steps: VecDeque<ExpectedStep> = steps.collect();
        self.tool.point = Some(start + along * top.max(clear));
        self.tool.axis = axis;
        let first = steps.pop_front().unwrap_or(ExpectedStep::CycleEnd);
        self.further = steps;
        first
    }

    /// CYCLE; `None` for a form that leaves the path open.
    pub(super) fn cycle(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        let pulls_back = record.has(w::PULBAC);
        let by_itself = record.after(w::RTRCTO) == Some(Word::Minor(w::AUTO));
        let off = record.has(w::OFF);
        if !pulls_back && (off || record.has(w::NOMORE)) {
            self.cycle = None;
            self.came_from = None;
            return Some(vec![ExpectedStep::CycleEnd]);
        }
        if matches!(record.data[..], [Word::Minor(w::INIT | w::CLEAR)]) {
            return Some(Vec::new());
        }
        let number = |words: &[WordId]| words.iter().find_map(|word| record.number_after(*word));
        let kind = CYCLES.iter().find(|(word, _)| record.has(*word)).map(|(_, kind)| *kind);
        let kind = kind?;
        let of_cone = || cone_depth(record).filter(|_| kind == CycleKind::Csink);
        let depth = number(&[w::DEPTH, w::FEDTO]).or_else(of_cone)?;
        self.plates = plates(record).filter(|_| kind == CycleKind::Thru).unwrap_or_default();
        let depth = self.plates.last().copied().unwrap_or(depth);
        let rate = [w::MMPM, w::IPM, w::FPM, w::MMPR, w::IPR, w::FPR]
            .iter()
            .find_map(|unit| record.number_after(*unit))
            .map(|value| self.rate_of(record, value));
        let tapped = self.lead(record).filter(|_| kind == CycleKind::Tap && record.has(w::TPI));
        let rate = tapped.map(Rate::PerTurn).or(rate);
        // Without a FEDRAT before it the feed of the cycle holds on.
        self.rate = self.rate.or(rate.filter(|_| kind != CycleKind::Tap));
        let begins = self.cycle.is_none();
        // A RAPID that waits is that of the way to the first hole.
        self.rapid = false;
        let rigid = kind == CycleKind::Tap && (record.has(w::HIGH) || self.taps_are_rigid);
        let (rapto, clear) = (record.number_after(w::RAPTO), record.number_after(w::CLEAR));
        // RAPTO beside CLEAR counts from there; the tool travels at CLEAR.
        let travel = clear.filter(|_| !self.rapto_is_level && rapto.is_some_and(|it| it != 0.0));
        let level = match (rapto, clear) {
            (Some(rapto), Some(clear)) if !self.rapto_is_level => Some(clear - rapto),
            _ => rapto.or(clear),
        };
        self.cycle = Some(Cycle {
            kind,
            depth: depth.abs(),
            clear: level,
            retract: if by_itself || pulls_back && !off {
                Some(0.0)
            } else {
                number(&[w::RETURN, w::RTRCTO]).or(travel)
            },
            step: number(&[w::STEP, w::SUBPECK, w::INCR]).filter(|_| kind.pecks()),
            out_each: out_each(record).filter(|_| kind == CycleKind::Brkchp),
            dwell: record.number_after(w::DWELL),
            rate: rate.or(self.rate),
            turns: None,
            has_own_rate: rate.is_some(),
            rigid,
        });
        let begins = begins.then_some(ExpectedStep::CycleEnd);
        Some(begins.into_iter().collect())
    }
}

/// The depths of a hole through several plates.
fn plates(record: &Record) -> Option<Vec<f64>> {
    let first = record.find_minor(FIRST_DATA, w::DEPTH)? + 1;
    let number = |at| match record.data_word(at) {
        Some(Word::Number(depth)) => Some(depth.abs()),
        _ => None,
    };
    let depths: Vec<f64> = (first..=record.len()).map_while(number).collect();
    (depths.len() > 1).then_some(depths)
}

/// How deep a cone of the angle TLANGL goes to be DIAMET wide at the top.
fn cone_depth(record: &Record) -> Option<f64> {
    let half = record.number_after(w::TLANGL)? / 2.0;
    Some(record.number_after(w::DIAMET)? / (2.0 * libm::tan(half.to_radians())))
}
