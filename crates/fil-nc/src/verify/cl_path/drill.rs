//! CYCLE: the holes at the points to come.

use fil_cl::{Record, Word, WordId, words as w};
use fil_machine::cycle_kind::CycleKind;

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

impl State {
    /// CYCLE; `None` for a form that leaves the path open.
    pub(super) fn cycle(&mut self, record: &Record) -> Option<Vec<ExpectedStep>> {
        let pulls_back = record.has(w::PULBAC);
        let by_itself = record.after(w::RTRCTO) == Some(Word::Minor(w::AUTO));
        let off = record.has(w::OFF);
        if !pulls_back && (off || record.has(w::NOMORE)) {
            self.cycle = None;
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
            dwell: record.number_after(w::DWELL),
            rate: rate.or(self.rate),
            turns: None,
            has_own_rate: rate.is_some(),
            rigid,
        });
        let begins = begins.then_some(ExpectedStep::CycleEnd);
        Some(begins.into_iter().chain(rigid.then_some(ExpectedStep::RigidTap)).collect())
    }
}

/// How deep a cone of the angle TLANGL goes to be DIAMET wide at the top.
fn cone_depth(record: &Record) -> Option<f64> {
    let half = record.number_after(w::TLANGL)? / 2.0;
    Some(record.number_after(w::DIAMET)? / (2.0 * libm::tan(half.to_radians())))
}
