//! Which threading cycle of the machine can say all of a thread.

use fil_machine::Letter;
use fil_machine::locations::{self as loc, ThreadCycle};
use fil_machine::modes::INCH;

use super::Control;
use super::word_address::osp_thread;
use crate::operation::thread_shape::Shape;
use crate::operation::{Thread, ThreadPasses};

/// Where LinuxCNC's G76 says how its passes leave the thread.
const WAY_OUT: [Letter; 2] = [Letter::of(b'E'), Letter::of(b'L')];

/// What each pass goes deeper at least, mm or inch.
pub fn least_depth(control: &Control) -> f64 {
    let least = control.commons.dbl_opt(loc::THREAD_LEAST_DEPTH).unwrap_or(0.0).max(0.0);
    if control.is_metric() { least } else { least / INCH }
}

/// The way on which a pass leaves the thread, in leads.
pub fn chamfer(control: &Control) -> f64 {
    control.commons.dbl_opt(loc::THREAD_CHAMFER).unwrap_or(0.0).max(0.0)
}

/// The machine's cycle, where it can say all of the thread; else it is written as single passes, which
/// are a cycle on an OSP.
pub fn cycle_of(control: &Control, thread: &Thread, shape: &Shape) -> ThreadCycle {
    let cycle = control.commons.read(loc::THREAD_CYCLE);
    let cycles = match cycle {
        ThreadCycle::G71OfAnOsp => [cycle, ThreadCycle::CycleOfOnePass],
        _ => [cycle, ThreadCycle::SinglePasses],
    };
    let says = |cycle: &ThreadCycle| says_thread(control, thread, shape, *cycle);
    cycles.into_iter().find(says).unwrap_or(ThreadCycle::SinglePasses)
}

/// A cycle can say all of the thread.
fn says_thread(control: &Control, thread: &Thread, shape: &Shape, cycle: ThreadCycle) -> bool {
    let straight = thread.angle == 0.0;
    match cycle {
        ThreadCycle::SinglePasses => true,
        _ if !says_way_out(control, thread, shape, cycle) => false,
        _ if shape.is_on_face() => false,
        ThreadCycle::CycleOfOnePass => straight || !shape.leans(),
        ThreadCycle::CycleOfAllPassesInTwoBlocks => {
            let angles = [0.0, 29.0, 30.0, 55.0, 60.0, 80.0];
            angles.contains(&thread.angle) && (straight || !shape.leans()) && is_by_first(thread)
        }
        // It has no word for the passes at full depth.
        ThreadCycle::CycleOfAllPassesInOneBlock => {
            (straight || !shape.leans()) && shape.follows_roots(thread) && thread.springs <= 1
        }
        ThreadCycle::CycleOfAllPassesOfLinuxcnc => !shape.leans() && shape.follows_roots(thread),
        // Where a pass of it begins along the flank its manual leaves open, and so the unit of
        // its lead in inches.
        ThreadCycle::Cycle97OfASinumerik => {
            let of_positive_x = thread.crest[0].point.x > 0.0;
            straight
                && !shape.leans()
                && of_positive_x
                && control.is_metric()
                && shape.divides_evenly(thread)
        }
        ThreadCycle::G71OfAnOsp => osp_thread::says(control, thread, shape),
    }
}

/// The cycle leaves the thread as asked: by the tenths of G76 in two blocks, by E and L of
/// LinuxCNC, which rise by the height of the thread, or by a parameter of the control that the
/// machine file tells (`thread.chamfer_tenths`) and an M code switches.
fn says_way_out(control: &Control, thread: &Thread, shape: &Shape, cycle: ThreadCycle) -> bool {
    if shape.leaves() == 0.0 {
        return true;
    }
    let tenths = shape.chamfer_in_tenths(thread).filter(|tenths| *tenths > 0);
    match cycle {
        ThreadCycle::CycleOfAllPassesInTwoBlocks => tenths.is_some(),
        ThreadCycle::CycleOfAllPassesOfLinuxcnc => {
            let is_there = |letter| control.tables.addresses.position(letter).is_some();
            shape.leaves_by_its_height(thread) && WAY_OUT.into_iter().all(is_there)
        }
        ThreadCycle::CycleOfOnePass | ThreadCycle::CycleOfAllPassesInOneBlock => {
            let commons = &control.commons;
            let is_switched = commons.read(loc::THREAD_CHAMFER_ON_CODE).is_some();
            let of_control = commons.int_opt(loc::THREAD_CHAMFER_TENTHS);
            is_switched && of_control.is_some() && of_control == tenths.map(u32::cast_signed)
        }
        ThreadCycle::SinglePasses | ThreadCycle::Cycle97OfASinumerik | ThreadCycle::G71OfAnOsp => {
            false
        }
    }
}

/// The cycles of all passes count them from the depth of the first.
fn is_by_first(thread: &Thread) -> bool {
    matches!(thread.passes, ThreadPasses::First(_))
}
