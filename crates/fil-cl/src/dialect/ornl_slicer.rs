//! ORNL Slicer 2 (`_output.apt`), which slices parts that are built up in layers.
//!
//! It writes pseudo-comments as Creo does, three axes with the tool axis 0,0,0, the unit of a
//! feed before its value, and no FINI. Deposition is switched by CALSUB with a name, which a
//! FIL section must take. The source of the slicer is public.

use super::{AxisRule, DialectRules, Sign, generic};
use crate::forms::{FormError, Outcome, Written};
use crate::record::Word;
use crate::words as w;

pub(super) const RULES: DialectRules = DialectRules {
    name: "ornl-slicer",
    title: "ORNL Slicer 2 APT (_output.apt)",
    signs: &[Sign::Comment("ORNLSLICER"), Sign::Pseudo],
    circle: None,
    geometry: false,
    axis: AxisRule::ModalInMultax,
    writes_units: true,
    writes_fini: false,
    rewrite: Some(rewrite),
    without_effect: &[
        ("SEQUENCE", "name of the path that begins"),
        ("WIREFEED SPEED", "a heading without a value"),
        ("VOLTAGE", "a heading without a value"),
        ("POWER", "a heading without a value"),
        ("TRIM", "a heading without a value"),
        ("FREQUENCY", "a heading without a value"),
        ("ULTIMARC", "a heading without a value"),
    ],
    ..generic::RULES
};

fn rewrite(written: &mut Written<'_>) -> Result<Outcome, FormError> {
    let record = &mut written.record;
    match record.major {
        // An axis of no length is none: the path has three axes.
        w::GOTO if record.data.get(3..) == Some(&[Word::Number(0.0); 3]) => {
            record.data.truncate(3);
        }
        // A heading with a value would ask for something.
        _ if !record.data.is_empty() && written.vocabulary.name(record.major) != "SEQUENCE" => {
            record.inert = false;
        }
        _ => {}
    }
    Ok(Outcome::Free)
}
