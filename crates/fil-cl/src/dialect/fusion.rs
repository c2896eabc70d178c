//! APT of Autodesk Fusion and HSM (`.apt`): what their public posts for ISO 4343 and for
//! Generative Machining write.
//!
//! Texts stand in quotes. Arcs are MOVARC with their angle, which proves their sense. What the
//! posts leave open is refused: whether the points of a cycle are the tops or the bottoms of the
//! holes differs between them, and both write ON where the spindle stops.

use super::{DialectRules, Sign, generic};
use crate::errors::ClCode;
use crate::forms::{FormError, Outcome, Written};
use crate::record::{Record, Word};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "fusion",
    title: "Autodesk Fusion, HSM APT (.apt)",
    signs: &[Sign::TextBegin(w::PARTNO, "'")],
    writes_units: true,
    rewrite: Some(rewrite),
    rewrite_text: Some(rewrite_text),
    ..generic::RULES
};

fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.major {
        w::MODE => {
            // The posts name the kind of the operation, and the machine is known.
            let data = &written.record.data[..];
            written.record.inert = matches!(data, [Word::Minor(w::MILL | w::TURN)]);
            Ok(Outcome::Free)
        }
        w::LOADTL => {
            tool(written.record);
            Ok(Outcome::Free)
        }
        w::CUTCOM => Ok(compensation(written)),
        w::SPINDL => spindle(written),
        w::CYCLE => cycle(written),
        w::ORIGIN => {
            let is_zero = written.record.data.iter().all(|word| *word == Word::Number(0.0));
            written.record.inert = is_zero;
            Ok(Outcome::Free)
        }
        _ => generic::rewrite(written),
    }
}

/// `LOADTL/n,pocket,length,offset` and `LOADTL/n,IN,pocket,LENGTH,length,OSETNO,offset` as
/// LOADTL/n,OSETNO,offset: the length is that of the tool's body, and the pocket is always 0.
fn tool(record: &mut Record) {
    let data = match record.data[..] {
        [tool @ Word::Number(_), Word::Number(0.0), Word::Number(_), offset @ Word::Number(_)]
        | [
            tool @ Word::Number(_),
            Word::Minor(w::IN),
            Word::Number(0.0),
            Word::Minor(w::LENGTH),
            Word::Number(_),
            Word::Minor(w::OSETNO),
            offset @ Word::Number(_),
        ] => vec![tool, Word::Minor(w::OSETNO), offset],
        _ => return,
    };
    record.data = data;
}

/// `CUTCOM/ON` announces the side; `CUTCOM/ON,LEFT,n` is CUTCOM/LEFT,n.
fn compensation(written: &mut Written<'_>) -> Outcome {
    let data = &mut written.record.data;
    if *data == [Word::Minor(w::ON)] {
        written.state.expects = Some("CUTCOM/LEFT or CUTCOM/RIGHT");
        return Outcome::Nothing;
    }
    if let [Word::Minor(w::ON), Word::Minor(w::LEFT | w::RIGHT), ..] = data[..] {
        data.remove(0);
    }
    written.state.expects = None;
    Outcome::Bound
}

/// Refuses ON and OFF: the public posts write ON for a stop of the spindle and OFF for its start.
fn spindle(written: &Written<'_>) -> Result<Outcome, FormError> {
    match written.record.data[..] {
        [Word::Minor(w::ON | w::OFF)] => {
            let message = "the public posts of this system write SPINDL/ON to stop the spindle, and SPINDL/OFF to start it";
            let hint = "restate the speed with SPINDL/RPM, or stop the spindle by STOP; if the words are right, choose --dialect generic";
            Err(FormError::new(ClCode::MissingItem, 0, message).hint(hint))
        }
        _ => Ok(Outcome::Free),
    }
}

/// Refuses the cycles of the posts: `CYCLE/kind,depth,unit,feed,clearance,…`.
fn cycle(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    if let [Word::Minor(_), Word::Number(_), Word::Minor(_), Word::Number(_), ..] =
        written.record.data[..]
    {
        let message = "whether the points of this cycle are the tops or the bottoms of the holes, \
                       and what its clearance counts from, is not in the file";
        let hint = "let a FIL section take CYCLE, or write the holes as single motions in the CAM \
                    system";
        return Err(FormError::new(ClCode::UnclearPoints, 0, message).hint(hint));
    }
    generic::rewrite(written)
}

/// Texts stand in quotes, which do not belong to them.
fn rewrite_text(record: &mut Record) -> Result<(), FormError> {
    let text = record.text.trim();
    if let Some(bare) = text.strip_prefix('\'').and_then(|text| text.strip_suffix('\'')) {
        record.text = bare.to_string();
        record.data.clear();
        record.data.push(Word::Text { start: 0, len: record.text.len() as u32 });
    }
    Ok(())
}
