//! What option files list of the rotary axes beside the axes that are given.
//!
//! They list it of the first axis alone, and which of two they call the first no source says: on a
//! machine with two it is refused where neither is like that.

use fil_diag::Diag;
use nalgebra::Vector3;

use crate::axes::SCALE;
use crate::axis_chain::{AxisChain, Rotary};
use crate::commons::{Commons, Int};
use crate::errors::MachineCode;
use crate::locations::{self as loc, RotaryEiaSense};

/// A direction that lies nearer than this across an axis has no sense along it.
const ACROSS: f64 = 1e-3;

/// Refuses what is listed of rotary axes and is so of none of them.
pub(super) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    let Ok(chain) = AxisChain::from_commons(commons) else { return };
    if !chain.has_rotary() {
        return;
    }
    let mut refuse = |message: String| found.push(*MachineCode::DescribedTwice.diag(message));
    listed_axis(commons, &chain, &mut refuse);
    sense(commons, &chain, &mut refuse);
    zero(commons, &chain, &mut refuse);
}

/// The axis that is listed as the first is one of those given.
fn listed_axis(commons: &Commons, chain: &AxisChain, refuse: &mut impl FnMut(String)) {
    let Some(listed) = commons.read(loc::ROTARY_LISTED_PRIMARY) else { return };
    let index = listed as usize - 1;
    if !chain.rotaries.iter().flatten().any(|rotary| rotary.axis == index) {
        refuse(format!(
            "rotary.listed_primary is {}, and no rotary axis is about {}",
            ['A', 'B', 'C'][index],
            ['X', 'Y', 'Z'][index]
        ));
    }
}

/// An axis turns as the standard says, or does not.
fn sense(commons: &Commons, chain: &AxisChain, refuse: &mut impl FnMut(String)) {
    let Some(listed) = commons.read(loc::ROTARY_EIA_SENSE) else { return };
    let asked = listed == RotaryEiaSense::Yes;
    let fits = |rotary: &Rotary| is_standard(commons, rotary).is_none_or(|is| is == asked);
    if !chain.rotaries.iter().flatten().any(fits) {
        let (listed, given) = if asked { (1, "against") } else { (0, "as") };
        refuse(format!(
            "rotary.eia_sense is {listed}, but the rotary axes turn {given} the standard, by their directions and output scales"
        ));
    }
}

/// True for an axis whose plus on the tape turns the tool about the part by the right-hand rule
/// about plus X, Y or Z; `None` for one that lies across its own.
fn is_standard(commons: &Commons, rotary: &Rotary) -> Option<bool> {
    let along = rotary.direction[rotary.axis];
    let scale = commons.dbl_opt(SCALE[rotary.axis + 3]).unwrap_or(1.0);
    (along.abs() > ACROSS).then_some(along * scale > 0.0)
}

/// The tool lies along Z with the rotary axes at zero, or does not.
fn zero(commons: &Commons, chain: &AxisChain, refuse: &mut impl FnMut(String)) {
    let listed = commons.int_opt(Int(loc::ROTARY_ZERO_AT_Z.number));
    let asked = match listed {
        Some(1 | 71) => true,
        Some(0 | 72) => false,
        _ => return,
    };
    let is_z = (chain.tool.into_inner() - Vector3::z()).norm() < ACROSS;
    if is_z != asked {
        let [x, y, z] = [0, 1, 2].map(|n| chain.tool[n]);
        refuse(format!(
            "rotary.zero_at_z is {}, and the tool axis with the rotary axes at zero is {x}, {y}, {z} \
             (tool.axis_i to tool.axis_k)",
            u8::from(asked)
        ));
    }
}
