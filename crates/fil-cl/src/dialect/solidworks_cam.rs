//! SolidWorks CAM APT (`.apt`).
//!
//! A circle has no radius and turns by the right-hand rule: four files agree with the
//! programs that came with them. A GOTO writes its tool axis whenever it is not Z. INSERT holds
//! notes about tools and stock, and blocks that a user has added.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::forms::{FormError, Outcome, Written, cycle, free_text, table};
use crate::record::{Record, Word};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "solidworks-cam",
    title: "SolidWorks CAM APT (.apt)",
    signs: &[Sign::Word(w::TRNTYP), Sign::Prefix("CSI_SET_")],
    circle: Some(
        CircleForm::new(&[6, 7], ArcSense::RightHand)
            .proved_by("2021 of 2021 arcs of Heidenhain programs"),
    ),
    geometry: false,
    splines: false,
    axis: AxisRule::Upright,
    packed_points: false,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: false,
    blanks_in_cycles: false,
    comma_words: false,
    writes_units: true,
    feeds_tell_unit: false,
    writes_fini: true,
    rewrite: Some(rewrite),
    rewrite_text: Some(free_text::insert_or_note),
    without_effect: &[
        ("CSI_SET_FLUTE_LENGTH", "flute length, for information"),
        ("CSI_SET_EXTENSION_LENGTH", "tool length out of the holder, for information"),
    ],
};

fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.major {
        w::TRNTYP => {
            frame(written.record);
            Ok(Outcome::Free)
        }
        w::CYCLE => Ok(cycle(written)),
        w::ROTABL => table::turn(written),
        w::TLAXIS => Ok(table::tool_axis(written)),
        _ => Ok(Outcome::Free),
    }
}

/// TRNTYP/WORLD says that the points are those of the part, as in all other systems; what
/// another frame would mean is not public.
fn frame(record: &mut Record) {
    record.inert = record.data.first() == Some(&Word::Minor(w::WORLD))
        && record.data[1..].iter().all(|word| *word == Word::Number(0.0));
}

/// The couplets of a cycle, which may have been announced.
fn cycle(written: &mut Written<'_>) -> Outcome {
    if cycle::is_announced(written) {
        return Outcome::Nothing;
    }
    cycle::of_solidworks(written);
    Outcome::Bound
}
