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

/// The value first; PERMIN is a minute in the unit of the file.
fn feed(written: &mut Written<'_>) {
    let is_permin = written.name(0) == "PERMIN";
    let unit = match &written.state {
        state if state.is_metric => w::MMPM,
        state if state.is_inch => w::IPM,
        _ => w::UPM,
    };
    if let [Word::Minor(word), value @ Word::Number(_)] = written.record.data[..] {
        let word = if is_permin { unit } else { word };
        written.record.data = vec![value, Word::Minor(word)];
    }
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
