//! G71 of an OSP, a thread of all passes.
//!
//! By the manuals: X and Z are where the last pass ends, D the depth of the first one and H the height
//! of the thread, both as X counts; F is the lead, or that of J threads. M32 and M34 follow one flank
//! of a tool of the angle B, and go straight in without B; behind M75 pass i lies at the root of i
//! times D below the crest, as deep as H at the most (infeed pattern 3). Anything else the block may
//! have is not followed: U, a taper by A or I, starts by Q, a lead that grows by E, a flank, the
//! passes of M33, M73 and M74, a way out behind M23.

use super::state::State;
use super::words::{Words, letter};
use super::{Fault, refuse};
use crate::dialect::{Auxiliary, Function, Group};
use crate::errors::NcCode;

const X: usize = 0;
const Z: usize = 2;

/// Infeed along one flank or the other, from side to side; and its patterns.
const FLANKS: [u32; 3] = [32, 33, 34];
const PATTERNS: [u32; 3] = [73, 74, 75];

/// Along both flanks in turn.
const ZIGZAG: u32 = 33;

/// Chips of the same area.
const EQUAL_CHIPS: u32 = 75;

/// An M word of a block belongs to its G71.
pub(super) fn takes(words: &Words, code: u32) -> bool {
    let cuts = words.peek(Group::Once) == Some(Function::ThreadPassesByHeight);
    cuts && (FLANKS.contains(&code) || PATTERNS.contains(&code))
}

impl State<'_> {
    /// Runs the cycle.
    pub(super) fn thread_by_height(&mut self, words: &mut Words) -> Result<(), Fault> {
        match (only(words, &FLANKS)?, only(words, &PATTERNS)?) {
            (ZIGZAG, _) => return refuse("the passes of M33 of G71 are not followed"),
            (_, EQUAL_CHIPS) => {}
            _ => return refuse("the passes of M73 and M74 of G71 are not followed"),
        }
        if words.take(letter(b'B'))?.is_some_and(|angle| angle != 0.0) {
            return refuse("B of G71: where a pass along a flank begins is not certain");
        }
        let missing =
            |what: &str| Fault::new(NcCode::MissingWord, format!("the thread needs {what}"));
        let first = words.take(letter(b'D'))?.ok_or_else(|| missing("its first depth (D)"))?;
        let height = words.take(letter(b'H'))?.ok_or_else(|| missing("its height (H)"))?;
        let (lead, _) = self.lead_of_pass(words, None)?;
        let axes = words.take_axes(self.dialect)?;
        let end = self.thread_end(&axes, None)?;
        if !(self.known[X] && self.known[Z]) {
            return Err(missing("to know where X and Z stand"));
        }
        if self.way_out(None)? > 0.0 {
            return refuse("the run-out of G71 with M23 is not supported");
        }
        let depths = [height, first].map(|depth| self.way(X, depth));
        self.thread_by_roots(end, depths, lead)
    }
}

/// The one M word of a block out of these.
fn only(words: &Words, codes: &[u32]) -> Result<u32, Fault> {
    let found = words.auxiliaries.iter().filter_map(|(auxiliary, _)| match auxiliary {
        Auxiliary::Other(code) if codes.contains(code) => Some(*code),
        _ => None,
    });
    let found: Vec<u32> = found.collect();
    match found[..] {
        [code] => Ok(code),
        _ => refuse("G71 needs one M word of its infeed and one of its pattern"),
    }
}
