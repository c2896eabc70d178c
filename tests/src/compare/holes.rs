//! A drilled hole against the motions the interpreter makes of a cycle.

use super::{Walk, name};
use crate::path::{Action, Hole, Point};

/// What has been seen of a hole.
struct Drilled {
    /// Lowest Z so far; the clearance at first.
    deepest: f64,
    /// True once the tool has fed at the hole.
    fed: bool,
    /// First step of the NC program looked at, then the last stroke.
    step: usize,
}

impl Walk<'_> {
    /// Takes the motions of one hole: travel to it above the clearance, any
    /// number of strokes along Z, and the way out.
    pub(super) fn hole(&mut self, hole: &Hole, rate: Option<f64>) {
        if self.drilled_before(hole) {
            return;
        }
        let before = self.differences.len();
        let mut drilled = Drilled { deepest: hole.clearance, fed: false, step: self.next_nc };
        while let Some(found) = self.peek() {
            let goes_on = match found {
                Action::Rapid(to) => self.traverse(hole, &mut drilled, to),
                Action::Feed(to, found_rate) => {
                    let strokes = self.stroke(hole, &mut drilled, to);
                    if strokes && self.differences.len() == before {
                        self.rates(rate, found_rate);
                    }
                    strokes
                }
                _ => false,
            };
            if !goes_on {
                break;
            }
            self.consume(&found);
            if drilled.fed && self.is_out(hole) {
                break;
            }
        }
        self.judge(hole, &drilled);
    }

    /// A point given twice may be drilled once.
    fn drilled_before(&self, hole: &Hole) -> bool {
        let before = self.next_cl.checked_sub(1).map(|index| self.expected[index].action);
        matches!(before, Some(Action::Hole(other, _)) if other == *hole)
    }

    /// A traverse to or at the hole; false when it leads away.
    fn traverse(&mut self, hole: &Hole, drilled: &mut Drilled, to: Point) -> bool {
        if self.at_hole(hole, to) {
            if self.at_hole(hole, self.position) && self.below(to[2], drilled.deepest) {
                self.report(format!("rapid into the hole, down to Z{:.4}", to[2]));
            } else if self.below(to[2], hole.clearance) && !drilled.fed {
                self.report(format!("rapid below the clearance, to Z{:.4}", to[2]));
            }
            return true;
        }
        let stays_or_ends = |axis: usize| {
            self.near(to[axis], self.position[axis]) || self.near(to[axis], hole.at[axis])
        };
        !drilled.fed && stays_or_ends(0) && stays_or_ends(1) && !self.below(to[2], hole.clearance)
    }

    /// A feed along Z at the hole; false for any other.
    fn stroke(&mut self, hole: &Hole, drilled: &mut Drilled, to: Point) -> bool {
        if !self.at_hole(hole, self.position) || !self.at_hole(hole, to) {
            return false;
        }
        if !drilled.fed && !self.near(self.position[2], hole.clearance) {
            let (from, clearance) = (self.position[2], hole.clearance);
            self.report(format!(
                "drilling feed begins at Z{from:.4}, should be at Z{clearance:.4}"
            ));
        }
        drilled.fed = true;
        drilled.step = self.next_nc;
        drilled.deepest = drilled.deepest.min(to[2]);
        true
    }

    /// True when the tool is above the hole and does not go in again.
    fn is_out(&mut self, hole: &Hole) -> bool {
        if self.below(self.position[2], hole.clearance) {
            return false;
        }
        let next = self.peek().and_then(|action| action.end());
        !next.is_some_and(|to| self.at_hole(hole, to) && self.below(to[2], hole.clearance))
    }

    fn judge(&mut self, hole: &Hole, drilled: &Drilled) {
        if !drilled.fed {
            self.report_at(drilled.step, format!("no {}", name(&Action::Hole(*hole, None))));
            return;
        }
        if !self.near(drilled.deepest, hole.bottom) {
            let (found, wanted) = (drilled.deepest, hole.bottom);
            self.report_at(
                drilled.step,
                format!("hole down to Z{found:.4}, should be Z{wanted:.4}"),
            );
        }
        if self.below(self.position[2], hole.clearance) {
            let z = self.position[2];
            self.report_at(drilled.step, format!("the tool leaves the hole at Z{z:.4}"));
        }
        self.height_known = true;
    }

    fn at_hole(&self, hole: &Hole, point: Point) -> bool {
        self.near(point[0], hole.at[0]) && self.near(point[1], hole.at[1])
    }

    fn below(&self, z: f64, level: f64) -> bool {
        z < level - self.tolerance.end
    }
}
