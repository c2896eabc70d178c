//! Siemens NX cutter location source files (`.cls`, `.clsf`).
//!
//! The axis of a circle is opposite to the right-hand rule: read so, all arcs of the files
//! seen but one are the shorter way round, and read the other way none. The tool axis is
//! written when it changes. FEDTO of a cycle is counted upwards from the hole's start,
//! RTRCTO,AUTO goes back to where the tool was before the cycle, and CYCLE/ON changes values.
//! TLDATA holds the tool's diameter.

use super::{ArcSense, AxisRule, CircleForm, DialectRules, Sign};
use crate::forms::{FormError, Outcome, Written, cycle};
use crate::record::{Record, Word};
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "nx",
    title: "Siemens NX CLSF (.cls, .clsf)",
    signs: &[
        Sign::Word(w::TOOL_PATH),
        Sign::Word(w::TLDATA),
        Sign::Word(w::MSYS),
        Sign::Word(w::PAINT),
        Sign::Word(w::END_OF_PATH),
    ],
    circle: Some(CircleForm::new(&[11], ArcSense::LeftHand).with_exact_turns()),
    geometry: false,
    splines: true,
    axis: AxisRule::Modal,
    packed_points: false,
    break_column: None,
    frame_in_comments: false,
    trailing_comma: false,
    blanks_in_cycles: false,
    comma_words: false,
    writes_units: false,
    feeds_tell_unit: true,
    writes_fini: false,
    rewrite: Some(rewrite),
    rewrite_text: None,
    without_effect: &[
        ("PAINT", "colors and speed of the display"),
        ("TLDATA", "measures of the tool, for information"),
        ("MSYS", "frame of the points; the post looks for a second one"),
        ("TOOL PATH", "name of the operation and of its tool"),
        ("END-OF-PATH", "end of the operation"),
    ],
};

fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    match written.record.major {
        w::CYCLE => cycle::couplets(written)?,
        w::TLDATA => cutter(written),
        // Absolute coordinates are what all CL data have.
        w::SET => {
            written.record.inert =
                written.record.data == [Word::Minor(w::MODE), Word::Minor(w::ABSOL)];
        }
        _ => return Ok(Outcome::Free),
    }
    Ok(Outcome::Bound)
}

/// `TLDATA/MILL,d,…` and `TLDATA/DRILL,MILL,d,…`: the diameter comes as CUTTER, too.
fn cutter(written: &mut Written<'_>) {
    let diameter = match written.record.data[..] {
        [Word::Minor(_), Word::Number(diameter), ..] => diameter,
        [Word::Minor(w::DRILL), Word::Minor(_), Word::Number(diameter), ..] => diameter,
        _ => return,
    };
    let turns = ["MILL", "DRILL", "TCUTTER", "BARREL"].contains(&written.name(0));
    let made = Record::builder(w::CUTTER).item(diameter).build();
    if let (true, Ok(record)) = (turns && diameter > 0.0, made) {
        written.made.push(Record { line: written.record.line, ..record });
    }
}
