//! Cycles of couplets, in Creo's order and with its words.

use super::Written;
use crate::errors::ClCode;
use crate::forms::FormError;
use crate::record::Word;
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
    let data = written.record.data.clone();
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
        [Word::Minor(kind @ (w::DRILL | w::TAP | w::BORE | w::REAM)), ref rest @ ..] => {
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
            Some(match *name {
                w::DEPTH => (w::DEPTH, value.abs()),
                w::RAPTO if !has_clear => (w::CLEAR, value),
                name => (name, value),
            })
        })
        .collect();
    written.set_couplets(cycle.kind, &couplets);
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
