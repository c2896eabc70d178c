//! G71 of an OSP: a whole thread in one block.
//!
//! X and Z are the end of the last pass, D the depth of the first one and H the height of the thread, as
//! diameters. Without B the tool goes straight in, whichever flank M32 and its sisters name, and
//! without U no pass follows the one at the root. With M32 and infeed pattern 3 of M75 pass i lies at
//! the root of i times D below the crest, until it comes to H (Okuma, manual 3277-E, pages 166 to
//! 170). The side is that on which the tool stands.

use fil_diag::Result;
use fil_machine::rounding::Rounding;
use fil_machine::{FunctionCode, Letter, letters};

use super::motion;
use super::thread::Line;
use crate::control::Control;
use crate::control_state::THREAD_OF_OSP;
use crate::errors::PostCode;
use crate::operation::Thread;
use crate::operation::thread_shape::Shape;

/// Depth of the first pass, height of the thread.
const DEPTHS: [Letter; 2] = [Letter::of(b'D'), Letter::of(b'H')];

/// Infeed along one flank, in pattern 3.
const INFEED: [FunctionCode; 2] = [FunctionCode::whole(32), FunctionCode::whole(75)];

/// Share of the first depth that its digits may change.
const FIRST: f64 = 0.01;

/// The root of a number of passes that comes so near the height has reached it, mm or inch.
const REACHED: f64 = 1e-9;

/// G71 can say all of the thread: straight in, along the axis, by the roots of the first depth, and no
/// pass more at the root. Where it goes in along a flank, from which point of the taper X counts and
/// with which sign, no manual at hand says.
pub fn says(control: &Control, thread: &Thread, shape: &Shape) -> bool {
    thread.angle == 0.0
        && thread.springs == 0
        && !shape.leans()
        && thread.crest[0].point.x > 0.0
        && shape.goes_by_roots(thread)
        && depths(control, thread, shape).is_some()
}

/// First depth and height as X counts, with the digits of their words, by which the control makes as
/// many passes as the thread has; `None` where it would make others.
fn depths(control: &Control, thread: &Thread, shape: &Shape) -> Option<[f64; 2]> {
    let axis = control.tables.axis(0);
    let factor = axis.value(1.0).ok()? - axis.value(0.0).ok()?;
    let cuts = shape.cuts(thread);
    let [first, height] = [cuts[0], thread.depth].map(|depth| (depth * factor).abs());
    let formats = DEPTHS.map(|letter| control.tables.addresses.format(letter));
    // A machine without the letters is refused when the block is written.
    let [Some(of_first), Some(of_height)] = formats else { return Some([first, height]) };
    let height = of_height.unscale(of_height.scale(height).ok()?);
    let nearest = of_first.scale(first).ok()?;
    let near = [nearest, nearest + 1, nearest - 1].map(|scaled| of_first.unscale(scaled));
    let reaches = |said: f64, passes: usize| said * (passes as f64).sqrt() >= height - REACHED;
    let fits = |said: &f64| {
        let is_near = (said - first).abs() <= FIRST * first;
        is_near && reaches(*said, cuts.len()) && !reaches(*said, cuts.len() - 1)
    };
    near.into_iter().find(fits).map(|first| [first, height])
}

/// The block, from where the tool stands clear, to a root that ends at X and Z of the machine.
///
/// # Errors
/// A value that does not fit its address.
pub fn text(control: &Control, thread: &Thread, shape: &Shape, [x, z]: [f64; 2]) -> Result<String> {
    let Some(depths) = depths(control, thread, shape) else {
        return PostCode::Thread.err("G71 makes other passes than the thread asks for");
    };
    let mut line = Line::new(control, THREAD_OF_OSP)?;
    line.axis(0, x)?;
    line.axis(2, z)?;
    for (letter, depth) in DEPTHS.into_iter().zip(depths) {
        line.word(char::from(letter.byte()), depth, Rounding::Nearest)?;
    }
    let lead = thread.lead.value;
    match motion::counted_threads(control, lead) {
        Some((letter, threads)) => {
            let threads = f64::from(threads);
            line.lead('F', lead * threads)?;
            line.word(char::from(letter.byte()), threads, Rounding::Exact)?;
        }
        None => line.lead('F', lead)?,
    }
    for code in INFEED {
        line.function(letters::M, code)?;
    }
    Ok(line.text)
}
