//! What all systems write a little differently from Creo: the order of values and units, and
//! the words of a tool change.

use super::Written;
use crate::record::Word;
use crate::words as w;

/// Brings FEDRAT, SPINDL, UNIT, LOAD and SELECT to Creo's words and order.
pub(crate) fn to_creo(written: &mut Written<'_>) {
    match written.record.major {
        w::FEDRAT => feed(written),
        w::SPINDL => {
            let data = &mut written.record.data;
            if let [Word::Number(_), Word::Minor(w::RPM | w::SFM | w::SMM), ..] = data[..] {
                data.swap(0, 1);
            }
        }
        w::UNIT => written.record.major = w::UNITS,
        w::LOAD => tool(written),
        w::SELECT => {
            if let [Word::Minor(w::TOOL), number @ Word::Number(_)] = written.record.data[..] {
                written.record.major = w::SELCTL;
                written.record.data = vec![number];
            }
        }
        _ => {}
    }
    if written.record.major == w::UNITS {
        written.state.is_metric |= written.record.has(w::MM);
        written.state.is_inch |= written.record.has(w::INCHES);
    }
}

/// The value first; PERMIN is a minute and PERREV a turn in the unit of the file.
pub(crate) fn feed(written: &mut Written<'_>) {
    let state = &written.state;
    let by_file = |metric, inch, other| match () {
        () if state.is_metric => metric,
        () if state.is_inch => inch,
        () => other,
    };
    let named = |item| match written.name(item) {
        "PERMIN" => Some(by_file(w::MMPM, w::IPM, w::UPM)),
        "PERREV" => Some(by_file(w::MMPR, w::IPR, w::UPR)),
        _ => None,
    };
    let (value, word, item) = match written.record.data[..] {
        [Word::Minor(word), value @ Word::Number(_)] => (value, word, 0),
        [value @ Word::Number(_), Word::Minor(word)] => (value, word, 1),
        _ => return,
    };
    let word = named(item).unwrap_or(word);
    written.record.data.clear();
    written.record.data.extend([value, Word::Minor(word)]);
}

/// `LOAD/TOOL,n[,ADJUST,m]` as LOADTL/n,OSETNO,m.
fn tool(written: &mut Written<'_>) {
    let data = match written.record.data[..] {
        [Word::Minor(w::TOOL), number @ Word::Number(_)] => vec![number],
        [
            Word::Minor(w::TOOL),
            number @ Word::Number(_),
            Word::Minor(w::ADJUST),
            offset @ Word::Number(_),
        ] => vec![number, Word::Minor(w::OSETNO), offset],
        _ => return,
    };
    written.record.major = w::LOADTL;
    written.record.data = data;
}
