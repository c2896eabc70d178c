//! What the CL file has asked of the spindles of a machine; what the control knows of them is a
//! modal group.

use crate::operation::SpindleSpeed;

/// What SPINDL has said last.
#[derive(Clone, Debug, Default)]
pub struct SpindleAsked {
    /// The last spindle speed, as it was asked for.
    pub speed: Option<SpindleSpeed>,
    /// The spindle turns clockwise or not, as far as the program has said it.
    pub turning: Option<bool>,
    /// How it turned when it last did.
    pub turned: Option<bool>,
    /// The gear in force that the program has said, from 0.
    pub range: Option<usize>,
    /// The sub-spindle has been turned last, and not stopped.
    pub side_turns: bool,
    /// SPINDL speaks of the sub-spindle of a lathe, on a machine whose control has a master
    /// spindle.
    pub is_side: bool,
    /// The spindle that is not the master may turn still.
    pub other_turns: bool,
    /// The number of the author's block that has put the control in step with the spindle for a
    /// rigid tap (M29 S), and its speed.
    pub in_step: Option<(u64, f64)>,
    /// Highest speed of the spindle that is not the master, rev/min.
    pub limit_of_other: Option<f64>,
}

impl SpindleAsked {
    /// Another spindle is the master now: nothing that was said of one holds for the other.
    pub fn switch(&mut self) {
        (self.turning, self.turned, self.speed, self.range) = (None, None, None, None);
    }
}
