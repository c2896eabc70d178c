//! Sets of groups, and which values of a group are those that motions need.

use super::{Group, Modal, Value};
use crate::control_state::{Compensation, CutterPath, Distance, Rotation};

/// True for a value of a group beside which motions have nothing to say or to refuse.
#[inline]
pub(super) fn is_usual(group: Group, value: Value) -> bool {
    use Group::{
        AxisClamp, CutterComp, CutterPath as Path, Cycle, DiameterMode, Distance as Counts,
        PlaneIsTemporary, ProgramEnd, Spindle, SpindleHalted, Tool,
    };
    match group {
        Counts => value == Distance::Absolute.value(),
        DiameterMode => value == true.value(),
        PlaneIsTemporary | Cycle | AxisClamp | SpindleHalted | ProgramEnd => value == false.value(),
        CutterComp => value == Compensation::Off.value(),
        Path => value != CutterPath::Leaving.value(),
        Spindle => ![Rotation::Standing, Rotation::Unsaid].map(Modal::value).contains(&value),
        Tool => true,
        _ => false,
    }
}

/// A set of groups.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GroupSet(u64);

impl GroupSet {
    /// Of some groups.
    pub const fn of(groups: &[Group]) -> Self {
        let mut set = 0;
        let mut at = 0;
        while at < groups.len() {
            set |= 1 << groups[at] as u32;
            at += 1;
        }
        GroupSet(set)
    }

    /// The same with one more.
    pub const fn and(self, group: Group) -> Self {
        GroupSet(self.0 | 1 << group as u32)
    }

    /// True if all of the others are in it.
    #[inline(always)]
    pub(super) fn has_all(self, others: GroupSet) -> bool {
        self.0 & others.0 == others.0
    }

    #[inline]
    pub(super) fn put(&mut self, group: usize, is_in: bool) {
        self.0 = self.0 & !(1 << group) | u64::from(is_in) << group;
    }
}
