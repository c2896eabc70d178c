//! OPSKIP: what of the records between ON and OFF is asked for.

use fil_cl::record::kind;
use fil_cl::{Record, words as w};

use crate::verify::expected_step::ExpectedStep;

/// Where a CL file stands with OPSKIP.
#[derive(Default)]
pub struct Opskip {
    /// The operator leaves out what stands between ON and OFF.
    pub leaves_out: bool,
    is_on: bool,
    /// Records were left out, and nothing is done behind them yet.
    unfollowed: bool,
    /// What is done was left out, and that was told.
    is_told: bool,
}

impl Opskip {
    /// The records at hand are left out.
    #[inline]
    pub fn leaves_out_now(&self) -> bool {
        self.leaves_out && self.is_on
    }

    /// A motion that is not left out.
    #[inline]
    pub fn goes_on(&mut self) {
        (self.unfollowed, self.is_told) = (false, false);
    }

    /// The steps of a record as they are asked for: of one that is left out, what holds on.
    pub fn asked_of(&mut self, record: &Record, mut steps: Vec<ExpectedStep>) -> Vec<ExpectedStep> {
        if record.kind == kind::POST && record.major == w::OPSKIP {
            self.is_on = record.has(w::ON);
        }
        if self.is_on {
            steps.iter_mut().for_each(ExpectedStep::mark_as_skipped);
        }
        if self.leaves_out {
            steps.retain(|step| !step.has_block_delete());
        }
        if self.leaves_out_now() {
            let leaves_out = steps.iter().any(ExpectedStep::is_done_once);
            steps = steps.into_iter().filter_map(ExpectedStep::left_out).collect();
            if leaves_out && !std::mem::replace(&mut self.is_told, true) {
                steps.push(ExpectedStep::LeftOut);
            }
            self.unfollowed = true;
        }
        self.unfollowed &= !steps.iter().any(ExpectedStep::is_done_once);
        let end = steps.iter().position(|what| matches!(what, ExpectedStep::End(_)));
        if let Some(end) = end.filter(|_| self.unfollowed) {
            steps.insert(end, ExpectedStep::Unfollowed);
        }
        steps
    }
}
