//! Makino FFCAM (`.cldata`).
//!
//! PPRINT statements give the structure of the file. Circles have the eleven numbers of NX,
//! and their axis is opposite to the right-hand rule as there.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::errors::ClCode;
use crate::forms::{FormError, Outcome, Written, cycle};
use crate::record::{Record, Word};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "ffcam",
    title: "Makino FFCAM (.cldata)",
    signs: &[Sign::Text(w::PPRINT, "APTCL-SPEC")],
    circle: Some(CircleForm::new(&[11], ArcSense::LeftHand)),
    geometry: false,
    splines: false,
    axis: AxisRule::Modal,
    packed_points: false,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: false,
    blanks_in_cycles: false,
    comma_words: false,
    writes_units: true,
    feeds_tell_unit: false,
    writes_fini: false,
    rewrite: Some(rewrite),
    rewrite_text: Some(rewrite_text),
    without_effect: &[],
};

/// First words of the PPRINT statements that tell the structure of the file.
const STRUCTURE: [&str; 7] = [
    "APTCL-SPEC",
    "TOOL-POSITION",
    "BEGIN-SECTION",
    "END-SECTION",
    "PART-LEAST",
    "MOTION",
    "ESCAPE-HEIGHT",
];

fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.major {
        w::CYCLE => {
            cycle::couplets(written)?;
            Ok(Outcome::Bound)
        }
        w::SET => {
            // Absolute coordinates are what all CL data have.
            written.record.inert =
                written.record.data == [Word::Minor(w::MODE), Word::Minor(w::ABSOL)];
            Ok(Outcome::Free)
        }
        _ => Ok(Outcome::Free),
    }
}

/// Structure is no message. The points must be those of the tool's nose.
fn rewrite_text(record: &mut Record) -> Result<(), FormError> {
    let mut words = record.text.split(',').map(str::trim);
    let first = words.next().unwrap_or("").to_ascii_uppercase();
    if first == "TOOL-POSITION" && words.next() != Some("TOOL-NOSE") {
        let message = "the points are not those of the tool's nose";
        return Err(FormError::new(ClCode::UnclearPoints, 0, message));
    }
    record.inert |= record.major == w::PPRINT && STRUCTURE.contains(&first.as_str());
    Ok(())
}
