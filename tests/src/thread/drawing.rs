//! The picture of a thread: layers and passes in the section of the groove.

use super::Thread;
use super::cycles::{Cycle, Program};
use crate::picture::{Pen, Picture};

const STOCK: &str = "#e8e8e8";
const PROFILE: Pen = Pen::full("#202020", 2.0);
const FLOOR: Pen = Pen::dashed("#707070", 1.0);
const ROUGH: Pen = Pen::full("#c05020", 1.0);
const WIDEN: Pen = Pen::full("#2060c0", 1.0);

/// Draws the groove of the first start with all passes of a program. The end of
/// the thread is on the left.
pub fn section(thread: &Thread, program: &Program) -> Picture {
    let mut picture = Picture::default();
    let (height, crest, root) =
        (thread.height(), thread.half_width(0.0), thread.half_width(thread.height()));
    let edge = thread.pitch / 2.0;
    let groove = [[-crest, 0.0], [-root, -height], [root, -height], [crest, 0.0]];
    let mut stock = vec![[-edge, 0.0]];
    stock.extend(groove);
    stock.extend([[edge, 0.0], [edge, -1.25 * height], [-edge, -1.25 * height]]);
    picture.area(&stock, Pen::full("none", 0.0), STOCK);
    for pass in &program.passes {
        let place = thread.away() * (pass.start - thread.start);
        if place.abs() > edge {
            continue;
        }
        let depth = thread.inwards() * (thread.crest - pass.radius);
        let (nose, top) = (thread.nose / 2.0, thread.nose / 2.0 + depth * thread.edge());
        let tool = [
            [place - top, 0.0],
            [place - nose, -depth],
            [place + nose, -depth],
            [place + top, 0.0],
        ];
        picture.line(&tool, if pass.cycle == Cycle::G92 { WIDEN } else { ROUGH });
    }
    for (index, floor) in thread.floors().iter().enumerate().skip(1) {
        picture.line(&[[-edge, -floor], [edge, -floor]], FLOOR);
        let middle = floor - thread.layers[index - 1] / 2.0;
        picture.text([-0.93 * edge, -middle], &format!("K({index})"));
    }
    picture.line(&[[-edge, 0.0], [-crest, 0.0]], PROFILE);
    picture.line(&groove, PROFILE);
    picture.line(&[[crest, 0.0], [edge, 0.0]], PROFILE);
    picture.text([0.0, 0.08 * height], "G76: brown, G92: blue");
    picture.text([-0.8 * edge, 0.08 * height], "to the end of the thread");
    picture.text([0.8 * edge, 0.08 * height], "to its start");
    picture
}
