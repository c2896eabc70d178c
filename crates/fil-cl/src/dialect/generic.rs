//! A text without a sign of a CAM system: the words of APT and ISO 4343.
//!
//! A circle turns by the right-hand rule, as PTC documents it for its own files; the form of
//! NX, whose rule is the opposite one, is told by its eleven numbers and refused here.

use super::{ArcSense, AxisRule, CircleForm, DialectRules};
use crate::forms::{FormError, Outcome, Written, common, cycle};
use crate::record::Word;
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "generic",
    title: "APT and ISO 4343, no CAM system recognized",
    signs: &[],
    circle: Some(CircleForm { counts: &[4, 6, 7], sense: ArcSense::RightHand }),
    geometry: true,
    splines: false,
    axis: AxisRule::ModalInMultax,
    packed_points: false,
    break_column: None,
    trailing_comma: false,
    comma_words: false,
    writes_units: false,
    writes_fini: true,
    rewrite: Some(rewrite),
    rewrite_text: None,
    without_effect: &[],
};

fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
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
        _ => {}
    }
    Ok(Outcome::Free)
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
