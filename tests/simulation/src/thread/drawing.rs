//! The picture of a thread: layers and passes in the section of the groove.

use super::Thread;
use super::cycles::{Cycle, Pass, Program};
use filpost_tests::picture::{Pen, Picture};

const STOCK: &str = "#e4e4e4";
const CHIP: &str = "#cfe0f4";
const PROFILE: Pen = Pen::full("#202020", 2.0);
const FLOOR: Pen = Pen::dashed("#707070", 1.0);
const ROUGH: Pen = Pen::full("#c05020", 1.5);
const WIDEN: Pen = Pen::full("#2060c0", 1.5);
const TOOL: Pen = Pen::dashed("#202020", 1.5);

/// Draws the groove of the first start: in each layer what the passes of G76
/// reach, and the chips of G92 with their numbers. The end of the thread is on
/// the left; the dashed tool stands where the first layer begins.
pub fn section(thread: &Thread, program: &Program) -> Picture {
    let mut picture = Picture::default();
    let (height, edge) = (thread.height(), thread.pitch / 2.0);
    let [crest, root] = [0.0, height].map(|depth| thread.reach(depth)[0]);
    let groove = [[-crest, 0.0], [-root, -height], [root, -height], [crest, 0.0]];
    let mut stock = vec![[-edge, 0.0]];
    stock.extend(groove);
    stock.extend([[edge, 0.0], [edge, -1.2 * height], [-edge, -1.2 * height], [-edge, 0.0]]);
    picture.area(&stock, Pen::full("none", 0.0), STOCK);
    passes(&mut picture, thread, program);
    for (index, floor) in thread.floors().iter().enumerate().skip(1) {
        let middle = floor - thread.layers[index - 1] / 2.0;
        picture.line(&[[-edge, -floor], [edge, -floor]], FLOOR);
        picture.text([-0.9 * edge, -middle], &format!("K({index})"));
    }
    picture.line(&[[-edge, 0.0], [-crest, 0.0]], PROFILE);
    picture.line(&groove, PROFILE);
    picture.line(&[[crest, 0.0], [edge, 0.0]], PROFILE);
    tool(&mut picture, thread);
    picture.text([-0.75 * edge, 0.15 * height], "end of the thread");
    picture.text([0.78 * edge, 0.15 * height], "start of the thread");
    picture
}

/// The passes of the first start, each within its layer.
fn passes(picture: &mut Picture, thread: &Thread, program: &Program) {
    let mut before: Option<(f64, &Pass)> = None;
    let mut number = 0;
    for pass in &program.passes {
        let place = thread.away() * (pass.start - thread.start);
        if place.abs() > thread.pitch / 2.0 {
            continue;
        }
        let depth = |radius: f64| thread.inwards() * (thread.crest - radius);
        let floor = depth(pass.floor);
        let top = thread.floors().into_iter().rfind(|top| *top < floor - 1e-6).unwrap_or(0.0);
        let outline = |place: f64| flanks(thread, place, depth(pass.radius), top);
        let [left, right] = outline(place);
        match (pass.cycle, before) {
            (Cycle::G76(_), _) => {
                number = 0;
                picture.line(&[left[0], left[1], right[1], right[0]], ROUGH);
            }
            (Cycle::G92, Some((last, of))) if of.floor == pass.floor && place > last => {
                let [_, behind] = outline(last);
                number += 1;
                picture.area(&[behind[0], behind[1], right[1], right[0]], WIDEN, CHIP);
                let middle = (behind[0][0] + behind[1][0] + right[0][0] + right[1][0]) / 4.0;
                picture.text([middle, -(top + floor) / 2.0], &number.to_string());
            }
            (Cycle::G92, _) => {}
        }
        before = Some((place, pass));
    }
}

/// The tool above the groove, where it stands for the first layer.
fn tool(picture: &mut Picture, thread: &Thread) {
    let clear = 0.1 * thread.height();
    let [place, _] = thread.outer(thread.layers[0]);
    let [left, right] = flanks(thread, place, 0.0, -0.3 * thread.height())
        .map(|side| side.map(|[x, y]| [x, y + clear]));
    picture.line(&[left[0], left[1], right[1], right[0]], TOOL);
    picture.text([place, 2.5 * clear], "tool");
}

/// The two edges of the tool from a depth above its nose down to the nose.
fn flanks(thread: &Thread, place: f64, depth: f64, top: f64) -> [[[f64; 2]; 2]; 2] {
    let nose = thread.nose / 2.0;
    let wide = nose + (depth - top) * thread.edges()[0];
    [-1.0, 1.0].map(|side| [[place + side * wide, -top], [place + side * nose, -depth]])
}
