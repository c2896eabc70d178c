//! Lints: FIL that would run but is most likely not meant.
//!
//! One file a lint; each looks at the trees and the graphs of their statements
//! and knows nothing of compiling. What they need to know of the machine the
//! caller says with [`MachineFacts`].

mod addresses;
mod call_in_text;
mod commons;
mod context;
mod early;
mod endless;
pub(crate) mod flow;
mod labels;
mod loose_else;
mod positions;
mod reals;
mod same_when;
mod storing;
mod swallow;
mod unreachable;
mod unset;
mod unused;
mod walk;
mod words;

use std::collections::HashSet;

use fil_cl::{Vocabulary, WordId};
use fil_diag::Diag;

use crate::compile::files::{Found, Unit};
use crate::host::CommonKind;
use crate::module::Module;
use crate::output::Edits;
use crate::resolve::{Names, Resolution};
use context::Context;

/// Gives the name of a common location, or `None` where nothing is known of it.
pub type NameOfCommon<'a> = &'a dyn Fn(CommonKind, u32) -> Option<String>;

/// What is wrong with storing a value in a common location: the value where it is
/// constant, `None` where only a run knows it. The finding has no place yet.
pub type StoringInCommon<'a> = &'a dyn Fn(CommonKind, u32, Option<f64>) -> Option<Diag>;

/// What the lints may ask about the machine; what is left out is not looked at.
#[derive(Clone, Copy, Default)]
pub struct MachineFacts<'a> {
    /// Names of common locations.
    pub name_of_common: Option<NameOfCommon<'a>>,
    /// Findings about stored values.
    pub storing: Option<StoringInCommon<'a>>,
    /// True for a letter, 1 to 26, that the machine writes.
    pub writes_letter: Option<&'a dyn Fn(u8) -> bool>,
    /// Sections take records that begin with `$$->`.
    pub takes_creo_records: bool,
    /// The macros that the post calls to edit what it writes.
    pub edits: Edits,
    /// True for a major word that the post carries out.
    pub carries_out: Option<&'a dyn Fn(WordId) -> bool>,
}

/// What a program is made of once it is compiled.
pub(crate) struct Program<'t> {
    /// Its files.
    pub units: &'t [Unit],
    /// Which files include which.
    pub found: &'t Found,
    /// Its code.
    pub module: &'t Module,
    /// Its names as the compiler sees them.
    pub names: &'t Names<'t>,
    /// Where they are defined and used.
    pub resolution: &'t Resolution,
}

/// The lints that look at trees, in the order of their findings.
const LINTS: &[fn(&mut Context<'_>)] = &[
    unset::look,
    call_in_text::look,
    positions::look,
    early::look,
    unreachable::look,
    same_when::look,
    loose_else::look,
    labels::look,
    commons::look,
    storing::look,
    reals::look,
    endless::look,
    addresses::look,
    unused::look,
    words::look,
];

/// The findings of all lints.
pub(crate) fn warnings(
    program: Program<'_>,
    vocabulary: &Vocabulary,
    facts: MachineFacts<'_>,
) -> Vec<Diag> {
    let mut context = Context::new(&program, vocabulary, facts);
    for look in LINTS {
        look(&mut context);
    }
    let mut diags = context.diags;
    diags.extend(swallow::warnings(program.module));
    // A file that two others include is looked at in both places.
    let mut seen = HashSet::new();
    diags.retain(|diag| {
        let place = diag.spans.first();
        let at = place.map(|place| (place.file.clone(), place.line, place.span.start));
        seen.insert((diag.code.number, at, diag.message.clone()))
    });
    diags
}
