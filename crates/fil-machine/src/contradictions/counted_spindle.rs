//! The second spindle of a lathe, where the control is told which of the two it counts.

use fil_diag::Diag;

use super::contradiction;
use crate::commons::Commons;
use crate::locations::{self as loc, ControlFamily};
use crate::mill_turn;

/// Finds a second spindle that can't be chosen, or that is chosen in two ways.
pub(super) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    let number = commons.int_opt(loc::SPINDLE_SIDE_NUMBER);
    let choices = [loc::SPINDLE_SIDE_MASTER_CODE, loc::SPINDLE_MAIN_MASTER_CODE];
    let [side, main] = choices.map(|at| commons.read(at));
    let turns =
        [loc::SPINDLE_SIDE_CW_CODE, loc::SPINDLE_SIDE_CCW_CODE, loc::SPINDLE_SIDE_STOP_CODE];
    let own = turns.iter().filter(|at| commons.read(**at).is_some()).count();
    let of_sinumerik = commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik;
    let mut find = |what: &str| found.push(contradiction(what.to_string()));
    if number.is_none() && side.is_none() && main.is_none() {
        return;
    }
    if !commons.read(loc::LATHE_DIAMETER) || mill_turn::mode(commons).is_some() {
        find(
            "spindle.side_number and spindle.side_master_code are those of a lathe \
             (lathe.diameter) whose main spindle is no axis (mill_turn.milling_code)",
        );
    }
    if number.is_some_and(|_| !of_sinumerik) || (side.is_some() || main.is_some()) && of_sinumerik {
        find(
            "a SINUMERIK chooses the spindle by its number (spindle.side_number), another control \
             by M codes (spindle.side_master_code, spindle.main_master_code)",
        );
    }
    if number.is_some_and(|number| !(2..=99).contains(&number)) {
        find("spindle.side_number is the number of another spindle than the first");
    }
    if number.is_some() && (own > 0 || commons.int_opt(loc::CONTROL_SPINDLE_INDEX).is_some()) {
        find(
            "spindle.side_number needs S and M without a number, but spindle.side_cw_code or control.spindle_index adds one",
        );
    }
    if side.is_some() != main.is_some() || side.is_some() && side == main {
        find(
            "spindle.side_master_code and spindle.main_master_code must both be set: one selects the sub-spindle, the other the main spindle",
        );
    }
    if side.is_some() && !(own == 0 || own == turns.len()) {
        find(
            "spindle.side_cw_code, spindle.side_ccw_code and spindle.side_stop_code: all of them \
             turn the sub-spindle, or none where those of the main one do",
        );
    }
}
