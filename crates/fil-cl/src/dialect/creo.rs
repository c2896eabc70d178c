//! PTC Creo and Pro/ENGINEER (`.ncl`).
//!
//! PTC documents CIRCLE with the right-hand rule and its radius, and a GOTO with many points
//! for an arc that is written as points. The file that Creo hands to G-POST says the same in
//! statements: REMARK in place of `$$`, CAMERA in place of `$$-> CSYS`, and the word codes.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::errors::ClCode;
use crate::forms::{FormError, Outcome, Written, cycle};
use crate::record::Word;
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "creo",
    title: "PTC Creo, Pro/ENGINEER (.ncl)",
    signs: &[
        Sign::Comment("*PRO/CLFILE"),
        Sign::Pseudo,
        Sign::Word(w::PPWORD),
        Sign::Text(w::REMARK, "PRO/CLFILE"),
    ],
    circle: Some(CircleForm { counts: &[4, 7], sense: ArcSense::RightHand, proof: None }),
    geometry: true,
    splines: false,
    axis: AxisRule::AsWritten,
    packed_points: true,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: false,
    blanks_in_cycles: false,
    comma_words: false,
    writes_units: true,
    writes_fini: true,
    rewrite: Some(rewrite),
    rewrite_text: None,
    without_effect: &[],
};

/// The configuration option cycle_format writes cycles by position. A file that Creo hands to
/// its post has a table of word codes and CAMERA in place of `$$-> CSYS`.
fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.major {
        w::CYCLE => cycle::positional(written)?,
        w::PPWORD => return word_code(written),
        w::CAMERA if written.record.data.len() == FRAME => written.record.major = w::CSYS,
        _ => {}
    }
    Ok(Outcome::Free)
}

/// Numbers of a frame: three rows of four.
const FRAME: usize = 12;

/// Word codes have at most six digits; larger ones are our own.
const LARGEST_CODE: f64 = 999_999.0;

/// `PPWORD/WORD,code`: the code of the word in this file.
fn word_code(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.data[..] {
        [Word::Minor(word), Word::Number(code)]
            if code.fract() == 0.0 && (1.0..=LARGEST_CODE).contains(&code) =>
        {
            written.vocabulary.set_code(word, code as u32);
            Ok(Outcome::Bound)
        }
        _ => {
            let message = "PPWORD takes a word and its code, a whole number";
            Err(FormError::new(ClCode::BadPoint, 1, message))
        }
    }
}
