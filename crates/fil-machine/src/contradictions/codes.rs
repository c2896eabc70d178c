//! Codes that are not there where others need them.

use fil_diag::Diag;

use super::contradiction;
use crate::commons::Commons;
use crate::locations as loc;

/// Finds codes without the one that ends what they begin.
pub(super) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    turns_behind_surface_speed(commons, found);
    way_out_of_threads(commons, found);
}

/// The way out of threads has two codes, and a length only with them.
fn way_out_of_threads(commons: &Commons, found: &mut Vec<Diag>) {
    let codes = [loc::THREAD_CHAMFER_ON_CODE, loc::THREAD_CHAMFER_OFF_CODE];
    let [on, off] = codes.map(|at| commons.read(at).is_some());
    let tenths = commons.int_opt(loc::THREAD_CHAMFER_TENTHS);
    if on != off {
        found.push(contradiction(
            "thread.chamfer_on_code or thread.chamfer_off_code is missing, so the control would stay in the other state"
                .into(),
        ));
    } else if tenths.is_some() && !on {
        found.push(contradiction(
            "thread.chamfer_tenths is what M codes switch, and thread.chamfer_on_code is not there"
                .into(),
        ));
    } else if tenths.is_some_and(|tenths| !(1..=99).contains(&tenths)) {
        found.push(contradiction("thread.chamfer_tenths is none of 1 to 99".into()));
    }
}

/// What ends a surface speed: without a code for it, S would go on as one.
fn turns_behind_surface_speed(commons: &Commons, found: &mut Vec<Diag>) {
    let Some(code) = commons.read(loc::SPINDLE_CSS_CODE) else { return };
    if commons.read(loc::SPINDLE_RPM_CODE).is_none() {
        found.push(contradiction(format!(
            "spindle.css_code G{code} makes S a surface speed, but no spindle.rpm_code switches S back to rpm"
        )));
    }
}
