//! What single statements of a CL file say, whatever came before them.

use fil_cl::{Record, Vocabulary, Word, WordId, words as w};

use super::expected_step::{CoolantKind, ExpectedStep, SpindleRange};
use crate::motion::{Compensation, FOOT, Speed, Spindle};

pub(super) fn spindle(record: &Record) -> Vec<ExpectedStep> {
    let is_side = record.has(w::SIDE);
    let counts = [ExpectedStep::Counts(is_side)].into_iter();
    if !is_side {
        return counts.chain(of_spindle(record)).collect();
    }
    let of_side = of_spindle(record).into_iter().map(|one| ExpectedStep::OfSide(Box::new(one)));
    counts.chain(side_spindle(record)).chain(of_side).collect()
}

/// What the spindle does that a record speaks of.
fn of_spindle(record: &Record) -> Vec<ExpectedStep> {
    if record.has(w::OFF) {
        return vec![ExpectedStep::Spindle(Some(Spindle::Off))];
    }
    if record.has(w::ORIENT) {
        return vec![ExpectedStep::Orient(numbers(record).first().copied())];
    }
    let speed = numbers_beside(record, &[w::MAXRPM, w::RANGE]).first().copied();
    if speed == Some(0.0) {
        return vec![ExpectedStep::Spindle(Some(Spindle::Off))];
    }
    let mut wanted: Vec<ExpectedStep> =
        range(record).map(ExpectedStep::SpindleRange).into_iter().collect();
    wanted.extend(record.number_after(w::MAXRPM).map(ExpectedStep::SpeedLimit));
    wanted.extend(speed.map(|speed| {
        ExpectedStep::Speed(match () {
            () if record.has(w::SFM) => Speed::Surface(speed * FOOT),
            () if record.has(w::SMM) => Speed::Surface(speed),
            () => Speed::Turns(speed),
        })
    }));
    let turn = match () {
        () if record.has(w::CLW) => Some(Spindle::Clockwise),
        () if record.has(w::CCLW) => Some(Spindle::Counterclockwise),
        () => None,
    };
    // A highest speed, or a range, turns nothing.
    let stays = speed.is_none() && turn.is_none() && !record.has(w::ON) && !wanted.is_empty();
    let turn = match (speed, turn) {
        (None, None) => ExpectedStep::SpindleAgain,
        _ => ExpectedStep::Spindle(turn),
    };
    wanted.extend((!stays).then_some(turn));
    wanted
}

/// The second spindle; S is the same word for both.
fn side_spindle(record: &Record) -> Vec<ExpectedStep> {
    if record.has(w::OFF) {
        return vec![ExpectedStep::SideSpindle(None)];
    }
    let speed = numbers(record).first().map(|speed| ExpectedStep::Speed(Speed::Turns(*speed)));
    let turn = ExpectedStep::SideSpindle(Some(record.has(w::CLW)));
    speed.into_iter().chain([turn]).collect()
}

/// RANGE with a number or a word.
fn range(record: &Record) -> Option<SpindleRange> {
    if let Some(number) = record.number_after(w::RANGE) {
        return Some(SpindleRange::Number(number));
    }
    let named = [
        (w::LOW, SpindleRange::Low),
        (w::MEDIUM, SpindleRange::Medium),
        (w::HIGH, SpindleRange::High),
    ];
    let found = named.iter().find(|(word, _)| record.has(w::RANGE) && record.has(*word));
    found.map(|(_, range)| *range)
}

pub(super) fn coolant(record: &Record) -> Option<ExpectedStep> {
    let (low, medium) = (record.has(w::LOW), record.has(w::MEDIUM));
    Some(ExpectedStep::Coolant(match () {
        () if record.has(w::OFF) => CoolantKind::Off,
        () if record.has(w::ON) && low => CoolantKind::OnLow,
        () if record.has(w::ON) && medium => CoolantKind::OnMedium,
        () if record.has(w::ON) && record.has(w::HIGH) => CoolantKind::OnHigh,
        () if record.has(w::ON) => CoolantKind::On,
        () if record.has(w::MIST) => CoolantKind::Mist,
        () if record.has(w::FLOOD) && low => CoolantKind::FloodLow,
        () if record.has(w::FLOOD) && medium => CoolantKind::FloodMedium,
        () if record.has(w::FLOOD) && record.has(w::HIGH) => CoolantKind::FloodHigh,
        () if record.has(w::FLOOD) => CoolantKind::Flood,
        () if record.has(w::THRU) && low => CoolantKind::ThroughLow,
        () if record.has(w::THRU) && medium => CoolantKind::ThroughMedium,
        () if record.has(w::THRU) => CoolantKind::Through,
        () if record.has(w::TAP) => CoolantKind::Tap,
        () if record.has(w::AIR) => CoolantKind::Air,
        () => return None,
    }))
}

pub(super) fn compensation(record: &Record) -> Option<ExpectedStep> {
    let side = match () {
        () if record.has(w::OFF) => Compensation::Off,
        () if record.has(w::LEFT) => Compensation::Left,
        () if record.has(w::RIGHT) => Compensation::Right,
        () => return None,
    };
    Some(ExpectedStep::Compensation(
        side,
        numbers(record).first().and_then(|offset| whole(*offset)),
    ))
}

/// The plane that CUTCOM names.
pub(super) fn plane_of_compensation(record: &Record) -> Option<ExpectedStep> {
    Some(ExpectedStep::Plane(match () {
        () if record.has(w::XYPLAN) => 2,
        () if record.has(w::ZXPLAN) || record.has(w::XZPLAN) => 1,
        () if record.has(w::YZPLAN) => 0,
        () => return None,
    }))
}

/// All numbers of a record in order.
pub(super) fn numbers(record: &Record) -> Vec<f64> {
    let number = |word: &Word| match word {
        Word::Number(value) => Some(*value),
        _ => None,
    };
    record.data.iter().filter_map(number).collect()
}

/// The numbers that are not the value of one of these couplets.
pub(super) fn numbers_beside(record: &Record, couplets: &[WordId]) -> Vec<f64> {
    let of_couplet = |at: usize| match at.checked_sub(1).map(|before| record.data[before]) {
        Some(Word::Minor(word)) => couplets.contains(&word),
        _ => false,
    };
    let number = |(at, word): (usize, &Word)| match word {
        Word::Number(value) if !of_couplet(at) => Some(*value),
        _ => None,
    };
    record.data.iter().enumerate().filter_map(number).collect()
}

pub(super) fn whole(number: f64) -> Option<u32> {
    (number.fract() == 0.0 && (0.0..1e9).contains(&number)).then_some(number as u32)
}

/// The major word and the first minor word of a record: `THREAD/AUTO`.
pub(super) fn statement(record: &Record, vocabulary: &Vocabulary) -> String {
    let minor = record.data.iter().find_map(|word| match word {
        Word::Minor(word) => Some(vocabulary.name(*word)),
        _ => None,
    });
    let major = vocabulary.name(record.major);
    minor.map_or(major.to_string(), |minor| format!("{major}/{minor}"))
}
