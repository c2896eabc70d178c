//! Lengths of tools on an Okuma OSP: `G54 H` to `G59 H` call one, each along its axis, and `G53`
//! takes it off. On other controls these functions choose work offsets, and `G53` names the frame
//! of the machine.

use crate::commons::Commons;
use crate::function_code::FunctionCode;
use crate::locations as loc;

/// The function that takes the length off.
pub const CANCEL: FunctionCode = FunctionCode::whole(53);

/// Functions that call a length, along X, Y, Z and further axes.
const CALLS: std::ops::RangeInclusive<u16> = 54..=59;

/// True for a machine that calls lengths so.
pub fn are_meant(commons: &Commons) -> bool {
    let code = commons.read(loc::TOOL_LENGTH_CODE);
    code.is_some_and(|code| CALLS.map(i32::from).any(|call| call == code))
}

/// All functions of these lengths.
pub fn codes() -> impl Iterator<Item = FunctionCode> {
    CALLS.map(FunctionCode::whole).chain([CANCEL])
}
