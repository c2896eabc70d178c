//! CAMWorks CLT (`.clt`).
//!
//! The axis of a circle is the same for both senses; CLOCKWISE or COUNTERCLOCKWISE after the
//! radius decides: APT files of the same operations have the axis turned where it says
//! CLOCKWISE. A cycle gives most of its values by their positions, some with a blank between
//! them; the points of an operation turn with the table.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::errors::ClCode;
use crate::forms::{FormError, Outcome, Written, free_text, table};
use crate::record::Word;
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "camworks",
    title: "CAMWorks CLT (.clt)",
    signs: &[Sign::Name("BOX"), Sign::Name("OPFEATSTART"), Sign::Name("OPFEATEND")],
    circle: Some(
        CircleForm::new(&[7], ArcSense::ByWord)
            .proved_by("20 of 20 arcs that CLT and APT files of the same operations give"),
    ),
    geometry: false,
    splines: false,
    axis: AxisRule::ModalInMultax,
    packed_points: false,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: true,
    blanks_in_cycles: true,
    comma_words: false,
    writes_units: true,
    feeds_tell_unit: false,
    writes_fini: true,
    rewrite: Some(rewrite),
    rewrite_text: Some(free_text::insert_or_note),
    without_effect: &[
        ("BOX", "size of the stock, for information"),
        ("OPFEATSTART", "name of the operation"),
        ("OPFEATEND", "end of the operation"),
    ],
};

fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    written.record.data.pop_if(|last| *last == Word::Empty);
    match written.record.major {
        w::CUTCOM => Ok(compensation(written)),
        w::CYCLE => cycle(written),
        w::ROTABL => table::turn(written),
        w::TLAXIS => Ok(table::tool_axis(written)),
        _ => Ok(Outcome::Free),
    }
}

/// CUTCOM/ON announces CUTCOM/LEFT or RIGHT.
fn compensation(written: &mut Written<'_>) -> Outcome {
    if written.record.data == [Word::Minor(w::ON)] {
        written.state.expects = Some("CUTCOM/LEFT or CUTCOM/RIGHT");
        return Outcome::Nothing;
    }
    written.state.expects = None;
    Outcome::Bound
}

/// Numbers of a cycle behind its feed: R level, and the level to return to twice.
const LEVELS: usize = 3;

/// `CYCLE/ON` announces the cycle. `DRILL,G98,depth,PECKING,first,next,MMPM,f,r,level,level,
/// DWELL,t` becomes couplets.
fn cycle(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    if written.record.data == [Word::Minor(w::ON)] {
        written.state.expects = Some("the values of the CYCLE");
        return Ok(Outcome::Nothing);
    }
    written.state.expects = None;
    let returns = match written.name(1) {
        "G98" => true,
        "G99" => false,
        _ => return Ok(Outcome::Bound),
    };
    let unclear = |item| {
        FormError::new(ClCode::MissingItem, item, "this cycle has other values than those known")
    };
    let number = |item: usize| written.number(item).ok_or_else(|| unclear(item));
    let depth = number(2)?;
    let pecks = if written.name(3) == "PECKING" { Some((number(4)?, number(5)?)) } else { None };
    let unit = if pecks.is_some() { 6 } else { 3 };
    let Some(Word::Minor(unit_word @ (w::MMPM | w::IPM))) = written.record.data.get(unit).copied()
    else {
        return Err(unclear(unit));
    };
    let feed = number(unit + 1)?;
    let first_level = unit + 2;
    let levels = [first_level, first_level + 1, first_level + 2].map(|item| written.number(item));
    let [Some(clear), Some(level), Some(again)] = levels else { return Err(unclear(first_level)) };
    let rest = &written.record.data[first_level + LEVELS..];
    let dwell = match rest {
        [] => 0.0,
        [Word::Minor(w::DWELL), Word::Number(dwell)] => *dwell,
        _ => return Err(unclear(first_level + LEVELS)),
    };
    if level != again || written.record.data.first() != Some(&Word::Minor(w::DRILL)) {
        return Err(unclear(first_level + 2));
    }
    let mut couplets = vec![(w::DEPTH, depth)];
    if let Some((first, next)) = pecks {
        couplets.push((w::STEP, next));
        if first != next {
            couplets.push((w::FIRST_PECK, first));
        }
    }
    couplets.extend([(unit_word, feed), (w::CLEAR, clear)]);
    if returns {
        couplets.push((w::RETURN, level));
    }
    if dwell != 0.0 {
        couplets.push((w::DWELL, dwell));
    }
    let kind = if pecks.is_some() { w::DEEP } else { w::DRILL };
    written.set_couplets(kind, &couplets);
    Ok(Outcome::Bound)
}
