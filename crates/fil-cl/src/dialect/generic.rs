//! A text without a sign of a CAM system: the words of APT and ISO 4343.
//!
//! A circle turns by the right-hand rule, as PTC documents it for its own files; the form of
//! NX, whose rule is the opposite one, is told by its eleven numbers and refused here.

use super::{ArcSense, AxisRule, CircleForm, DialectRules};
use crate::errors::ClCode;
use crate::forms::{FormError, Outcome, Written, common, cycle};
use crate::record::{Record, Word};
use crate::vocabulary::WordId;
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "generic",
    title: "APT and ISO 4343, no CAM system recognized",
    signs: &[],
    circle: Some(CircleForm::new(&[4, 6, 7], ArcSense::RightHand)),
    geometry: true,
    splines: false,
    axis: AxisRule::ModalInMultax,
    packed_points: false,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: false,
    blanks_in_cycles: false,
    comma_words: false,
    writes_units: false,
    feeds_tell_unit: false,
    writes_fini: true,
    rewrite: Some(rewrite),
    rewrite_text: None,
    without_effect: &[],
};

pub(super) fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.major {
        w::CYCLE => cycle::positional(written)?,
        w::FEDRAT if ["PERMIN", "PERREV"].contains(&written.name(0)) => {
            common::feed(written);
            return Ok(Outcome::Bound);
        }
        w::AUTOPS => {
            written.state.normal = None;
            written.record.inert = true;
            return Ok(Outcome::Bound);
        }
        w::MODE => return Ok(plane(written)),
        w::MACHIN => return Ok(unit_of_machin(written)),
        major if written.vocabulary.name(major) == "MOVARC" => return arc(written),
        _ => {}
    }
    Ok(Outcome::Free)
}

/// `MOVARC/x,y,z,i,j,k,r,ANGLE,a` of ISO 4343 as a CIRCLE; the GOTO to its end must agree with
/// the angle.
///
/// # Errors
/// Other items; more than a whole turn.
fn arc(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    let is_told = written.record.data.len() == MOVARC
        && (0..7).all(|item| written.number(item).is_some())
        && written.name(7) == "ANGLE";
    let degrees = written.number(8).filter(|_| is_told);
    let Some(degrees) = degrees.filter(|degrees| *degrees > 0.0 && *degrees <= 360.0) else {
        let message = "MOVARC is read with center, axis, radius and an ANGLE to a whole turn";
        return Err(FormError::new(ClCode::UncomputedMotion, 0, message));
    };
    written.record.major = w::CIRCLE;
    written.record.data.truncate(7);
    written.state.sweep = Some(degrees);
    Ok(Outcome::Bound)
}

/// Items of MOVARC.
const MOVARC: usize = 9;

/// `MACHIN/name,UNITS,INCHES,OUT,INCHES` gives the unit of the file, where the program is to have
/// the same one: UNITS comes after it.
fn unit_of_machin(written: &mut Written<'_>) -> Outcome {
    let data = &written.record.data;
    let unit_after = |word: WordId| {
        let at = data.iter().position(|item| *item == Word::Minor(word))?;
        data.get(at + 1).filter(|unit| [w::MM, w::INCHES].map(Word::Minor).contains(unit)).copied()
    };
    let (unit, out) = (unit_after(w::UNITS), unit_after(w::OUT));
    let Some(Word::Minor(unit)) = unit.filter(|_| out.is_none() || out == unit) else {
        return Outcome::Free;
    };
    let Ok(record) = Record::builder(w::UNITS).item(unit).build() else { return Outcome::Free };
    written.made.push(Record { line: written.record.line, ..record });
    Outcome::Bound
}

/// MODE/XYPLAN names the plane of the arcs by geometry that follow.
fn plane(written: &mut Written<'_>) -> Outcome {
    let normal = match written.record.data[..] {
        [Word::Minor(w::XYPLAN)] => [0.0, 0.0, 1.0],
        [Word::Minor(w::YZPLAN)] => [1.0, 0.0, 0.0],
        [Word::Minor(w::ZXPLAN | w::XZPLAN)] => [0.0, 1.0, 0.0],
        _ => return Outcome::Free,
    };
    written.state.normal = Some(normal);
    written.record.inert = true;
    Outcome::Bound
}
