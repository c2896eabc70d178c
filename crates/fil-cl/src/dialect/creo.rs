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
    circle: Some(CircleForm::new(&[4, 7], ArcSense::RightHand)),
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
    feeds_tell_unit: false,
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
        w::HEAD => return Ok(head(written)),
        w::SPINDL => return Ok(spindle_direction(written)),
        w::GOTO | w::FROM if written.state.spindle_along.is_some() => check_along(written)?,
        major if written.vocabulary.name(major) == "MOVNRB" => return nurbs(written),
        _ => {}
    }
    Ok(Outcome::Free)
}

/// HEAD/n names the head that the file is for; another one would be another program.
fn head(written: &mut Written<'_>) -> Outcome {
    if let [head @ Word::Number(_)] = written.record.data[..] {
        written.record.inert = *written.state.channel.get_or_insert(head) == head;
    }
    Outcome::Bound
}

/// SPINDL/PARLEL,XAXIS says along which axis the driven tool lies; the next point has its tool
/// axis, which must say the same.
fn spindle_direction(written: &mut Written<'_>) -> Outcome {
    let along = match written.record.data[..] {
        [Word::Minor(_), Word::Minor(w::XAXIS)] => 0,
        [Word::Minor(_), Word::Minor(w::YAXIS)] => 1,
        [Word::Minor(_), Word::Minor(w::ZAXIS)] => 2,
        _ => return Outcome::Free,
    };
    if written.name(0) != "PARLEL" {
        return Outcome::Free;
    }
    written.state.spindle_along = Some(along);
    written.record.inert = true;
    Outcome::Bound
}

/// The tool axis of a point after SPINDL/PARLEL.
///
/// # Errors
/// It lies along another axis, or is not written beside X or Y.
fn check_along(written: &mut Written<'_>) -> Result<(), FormError> {
    let Some(along) = written.state.spindle_along.take() else { return Ok(()) };
    let axis = [3, 4, 5].map(|item| written.number(item));
    let agrees = match axis[along] {
        Some(part) => (part.abs() - 1.0).abs() < 1e-3,
        None => along == 2,
    };
    if agrees {
        return Ok(());
    }
    let message = "the tool axis of this point is not that of SPINDL/PARLEL";
    let hint = "write the tool axis with each point: MULTAX/ON, GOTO/x,y,z,i,j,k";
    Err(FormError::new(ClCode::UnclearPoints, 0, message).hint(hint))
}

/// MOVNRB describes a curve besides the points: those between MOVNRB/NEXT and MOVNRB/OFF are
/// the motion point by point, as PTC documents it. The curve must end where they end.
///
/// # Errors
/// Other items than those documented; points that end elsewhere.
fn nurbs(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    let numbers = written.record.data.iter().skip(1);
    let has_numbers = numbers.clone().all(|word| matches!(word, Word::Number(_)));
    let count = numbers.count();
    let wrong = |message| Err(FormError::new(ClCode::BadSpline, 0, message));
    match written.record.data.first() {
        Some(Word::Number(which)) if has_numbers && count > 0 => {
            let is_poles = *which == 2.0 || *which == 3.0;
            if !(is_poles && count.is_multiple_of(3) || *which == 1.0) {
                return wrong("MOVNRB/1 has knots, MOVNRB/2 and 3 have points of three numbers");
            }
            if *which == 2.0 {
                let last = [count - 2, count - 1, count].map(|item| written.number(item));
                written.state.curve_end = Some(last.map(Option::unwrap_or_default));
            }
        }
        Some(Word::Minor(w::ON)) if has_numbers && count == 5 => {}
        Some(Word::Minor(w::NEXT)) if count == 0 => {}
        Some(Word::Minor(w::OFF)) if count == 0 => {
            let [end, point] = [written.state.curve_end.take(), written.point];
            let is_near = |(end, point): ([f64; 3], [f64; 3])| {
                end.iter().zip(point).all(|(a, b)| (a - b).abs() < 1e-3)
            };
            if !end.zip(point).is_some_and(is_near) {
                return wrong("the points before it do not end where the curve ends");
            }
        }
        _ if written.name(0) == "M3AXIS" && count == 0 => {}
        Some(Word::Text { .. }) if written.record.text.eq_ignore_ascii_case("5AXIS") => {}
        _ => return wrong("MOVNRB has other items than those that PTC documents"),
    }
    written.record.inert = true;
    Ok(Outcome::Bound)
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
