//! Cycles of couplets, in Creo's order and with its words.

use fil_diag::Diag;

use super::Written;
use crate::errors::ClCode;
use crate::forms::FormError;
use crate::record::{Record, Word};
use crate::vocabulary::WordId;
use crate::words as w;

/// A couplet: what it may be called, and what Creo calls it. In Creo's order.
const COUPLETS: [(&[WordId], WordId); 11] = [
    (&[w::FEDTO, w::DEPTH], w::DEPTH),
    (&[w::STEP, w::SUBPECK, w::INCR], w::STEP),
    (&[w::FIRST_PECK], w::FIRST_PECK),
    (&[w::MMPM], w::MMPM),
    (&[w::IPM], w::IPM),
    (&[w::MMPR], w::MMPR),
    (&[w::IPR], w::IPR),
    (&[w::CLEAR], w::CLEAR),
    (&[w::RAPTO], w::RAPTO),
    (&[w::RTRCTO, w::RETURN], w::RETURN),
    (&[w::DWELL], w::DWELL),
];

/// Places in [`COUPLETS`] of the units of a feed: one takes the place of another.
const FEEDS: std::ops::Range<usize> = 3..7;

/// Place in [`COUPLETS`] of the clearance.
const CLEAR: usize = 7;

/// A cycle and its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cycle {
    kind: WordId,
    values: [Option<f64>; COUPLETS.len()],
}

/// Brings a cycle of couplets to Creo's form. `CYCLE/ON` changes values of the cycle in
/// force. A record with other items than those known stays as it is.
///
/// # Errors
/// A depth above the hole's start; CYCLE/ON without a cycle.
pub(crate) fn couplets(written: &mut Written<'_>) -> Result<(), FormError> {
    let data = one_value_each(written);
    let (base, rest) = match data[..] {
        [Word::Minor(w::ON), ref rest @ ..] => {
            let Some(cycle) = written.state.cycle else {
                let message = "ON changes a cycle, and none is in force that is understood";
                return Err(FormError::new(ClCode::MissingItem, 0, message).leaning());
            };
            (cycle, rest)
        }
        [Word::Minor(w::DRILL), Word::Minor(kind @ (w::DEEP | w::BRKCHP)), ref rest @ ..] => {
            (Cycle { kind, values: Default::default() }, rest)
        }
        [Word::Minor(kind), ref rest @ ..] if KINDS.contains(&kind) => {
            (Cycle { kind, values: Default::default() }, rest)
        }
        _ => {
            written.state.cycle = None;
            return Ok(());
        }
    };
    let skipped = data.len() - rest.len();
    let Some(cycle) = with(base, rest) else {
        written.state.cycle = None;
        return Ok(());
    };
    // The tool goes down from the hole's start.
    if cycle.values[0].is_some_and(|depth| depth > 0.0) {
        let message = "FEDTO lies above the start of the hole";
        return Err(FormError::new(ClCode::BadPoint, skipped, message));
    }
    written.state.cycle = Some(cycle);
    give(written, &cycle);
    Ok(())
}

/// The items of a cycle, without what adds nothing to a couplet: MANUAL behind the number of
/// RTRCTO, which says that a user typed it, and further STEPs of the same size.
fn one_value_each(written: &Written<'_>) -> Vec<Word> {
    let data = &written.record.data;
    let mut kept: Vec<Word> = Vec::with_capacity(data.len());
    for (at, item) in data.iter().enumerate() {
        let (before, word) = (kept.last(), kept.len().checked_sub(2).map(|at| kept[at]));
        let has_number = matches!(before, Some(Word::Number(_)));
        let is_manual = word == Some(Word::Minor(w::RTRCTO)) && written.name(at) == "MANUAL";
        let is_same_step = word == Some(Word::Minor(w::STEP)) && before == Some(item);
        if !(has_number && (is_manual || is_same_step)) {
            kept.push(*item);
        }
    }
    kept
}

/// `CYCLE/INIT` and `CYCLE/CLEAR` announce the cycle, whose couplets follow; true for one.
pub(crate) fn is_announced(written: &mut Written<'_>) -> bool {
    let announces = matches!(written.record.data[..], [Word::Minor(w::INIT | w::CLEAR)]);
    written.state.expects = announces.then_some("the values of the CYCLE");
    announces
}

/// Brings a cycle of SolidWorks CAM to Creo's form: its depth counts downwards. A record
/// with other items than those known stays as it is.
pub(crate) fn of_solidworks(written: &mut Written<'_>) {
    let [Word::Minor(kind @ (w::DRILL | w::DEEP | w::DEEP2 | w::BRKCHP)), ref rest @ ..] =
        written.record.data[..]
    else {
        return;
    };
    let kind = if kind == w::DEEP2 { w::DEEP } else { kind };
    if let Some(cycle) = with(Cycle { kind, values: Default::default() }, rest) {
        give(written, &cycle);
    }
}

/// Makes the items those of a cycle, in Creo's order. Without CLEAR the level of RAPTO is the
/// clearance.
fn give(written: &mut Written<'_>, cycle: &Cycle) {
    let has_clear = cycle.values[CLEAR].is_some();
    let values = COUPLETS.iter().zip(cycle.values);
    let couplets: Vec<(WordId, f64)> = values
        .filter_map(|((_, name), value)| {
            let value = value?;
            Some(match (*name, value) {
                (w::DEPTH, 0.0) => (w::FEDTO, 0.0),
                (w::DEPTH, value) => (w::DEPTH, value.abs()),
                (w::RAPTO, value) if !has_clear => (w::CLEAR, value),
                other => other,
            })
        })
        .collect();
    written.set_couplets(cycle.kind, &couplets);
}

/// `CYCLE/kind,z,f,unit[,t,r,i]` as couplets: depth, feed, threads an inch of a tap, distance
/// of the R level, peck. What a kind has no use for is left out, 0 or empty.
///
/// # Errors
/// Values whose meaning their number leaves open, or that no hole can have.
pub(crate) fn positional(written: &mut Written<'_>) -> Result<(), FormError> {
    if let Some((kind, couplets)) = by_position(&written.record.data)? {
        written.set_couplets(kind, &couplets);
    }
    Ok(())
}

/// Brings a CYCLE that a script has made by position to couplets, as the reader does with
/// those of a CL file; others stay as they are.
///
/// # Errors
/// As for a CL file: values whose meaning their number leaves open, or that no hole can
/// have.
pub fn keyed_cycle(record: &mut Record) -> Result<(), Box<Diag>> {
    let found = by_position(&record.data).map_err(|error| {
        let mut diag = Diag::new(error.code, format!("CYCLE: {}", error.message));
        diag.hint = error.hint.map(str::to_string);
        Box::new(diag)
    })?;
    if let Some((kind, couplets)) = found {
        let items =
            couplets.iter().flat_map(|(word, value)| [Word::Minor(*word), Word::Number(*value)]);
        record.data = std::iter::once(Word::Minor(kind)).chain(items).collect();
    }
    Ok(())
}

/// A cycle with its couplets.
type Couplets = (WordId, Vec<(WordId, f64)>);

fn by_position(data: &[Word]) -> Result<Option<Couplets>, FormError> {
    const UNITS: [WordId; 4] = [w::IPM, w::IPR, w::MMPM, w::MMPR];
    let [
        Word::Minor(kind),
        Word::Number(depth),
        Word::Number(feed),
        Word::Minor(unit),
        ref rest @ ..,
    ] = *data
    else {
        return Ok(None);
    };
    if !UNITS.contains(&unit) || !KINDS.contains(&kind) {
        return Ok(None);
    }
    let wrong = |item, message| Err(FormError::new(ClCode::BadPoint, item, message));
    if depth <= 0.0 {
        return wrong(1, "the depth counts down from the start of the hole and is above zero");
    }
    let [threads, clear, step] = tail(kind, rest)?;
    if clear.is_some_and(|clear| clear < 0.0) || step.is_some_and(|step| step <= 0.0) {
        return wrong(4, "the R plane must be above the start of the hole, and a peck above zero");
    }
    let mut couplets = vec![(w::DEPTH, depth)];
    couplets.extend(step.map(|step| (w::STEP, step)));
    match threads {
        Some(threads) => couplets.push((w::TPI, lead_of(threads, feed, unit)?)),
        None => couplets.push((unit, feed)),
    }
    couplets.extend(clear.map(|clear| (w::CLEAR, clear)));
    Ok(Some((kind, couplets)))
}

/// Kinds of cycles.
const KINDS: [WordId; 9] =
    [w::DRILL, w::DEEP, w::BRKCHP, w::THRU, w::FACE, w::CSINK, w::TAP, w::BORE, w::REAM];

/// Threads an inch, R level and peck behind the unit: all three, or only those that the kind
/// has.
fn tail(kind: WordId, rest: &[Word]) -> Result<[Option<f64>; 3], FormError> {
    let unclear = || {
        let message = "these values may be threads per inch, R plane or peck";
        let hint = "write the cycle with couplets: DEPTH, STEP, CLEAR and their like";
        FormError::new(ClCode::MissingItem, 4, message).hint(hint)
    };
    let value = |word: &Word| match word {
        Word::Number(value) => Some(Some(*value)),
        Word::Empty => Some(None),
        _ => None,
    };
    let values: Vec<Option<f64>> = rest.iter().map_while(value).collect();
    if values.len() < rest.len() {
        return Err(unclear());
    }
    let has_gaps = values.contains(&None);
    let used = |value: Option<f64>| value.filter(|value| *value != 0.0);
    let found = match (kind, &values[..]) {
        (_, []) => [None; 3],
        (_, [threads, clear, step]) => [used(*threads), *clear, used(*step)],
        (_, [None, clear]) => [None, *clear, None],
        _ if has_gaps => return Err(unclear()),
        (w::TAP, [threads, clear]) => [used(*threads), *clear, None],
        (w::DEEP | w::BRKCHP, [clear, step]) => [None, *clear, *step],
        (w::TAP | w::DEEP | w::BRKCHP, _) => return Err(unclear()),
        (_, [clear]) => [None, *clear, None],
        _ => return Err(unclear()),
    };
    let has_more = found[0].is_some() && kind != w::TAP
        || found[2].is_some() && !matches!(kind, w::DEEP | w::BRKCHP);
    if has_more { Err(unclear()) } else { Ok(found) }
}

/// Threads an inch that agree with the feed of a tap.
fn lead_of(threads: f64, feed: f64, unit: WordId) -> Result<f64, FormError> {
    const INCH: f64 = 25.4;
    const AGREE: f64 = 0.01;
    let lead = match unit {
        w::IPR => feed,
        w::MMPR => feed / INCH,
        _ => {
            let message =
                "a tap with threads per inch and feed per minute: the spindle speed is not known";
            let hint = "write CYCLE/TAP with couplets, TPI or the feed";
            return Err(FormError::new(ClCode::MissingItem, 3, message).hint(hint));
        }
    };
    if threads <= 0.0 || (lead * threads - 1.0).abs() > AGREE {
        let message = "the feed is not the lead of these threads";
        return Err(FormError::new(ClCode::BadPoint, 2, message));
    }
    Ok(threads)
}

/// The cycle with these values; `None` for an item that is not known.
fn with(mut cycle: Cycle, mut items: &[Word]) -> Option<Cycle> {
    while let [Word::Minor(word), value, rest @ ..] = items {
        let at = COUPLETS.iter().position(|(names, _)| names.contains(word))?;
        // AUTO: back to where the tool stood before the cycle.
        let value = match value {
            Word::Number(value) => *value,
            Word::Minor(w::AUTO) if *word == w::RTRCTO => 0.0,
            _ => return None,
        };
        if FEEDS.contains(&at) {
            cycle.values[FEEDS].fill(None);
        }
        cycle.values[at] = Some(value);
        items = rest;
    }
    items.is_empty().then_some(cycle)
}
