//! The tool in the section of the groove: what each pass takes away, and what
//! is left.
//!
//! The section lies along the axis. A pass is the tool's outline, a trapezoid,
//! at the place its start has within a turn; the groove is a trapezoid too. What
//! is cut is kept exactly, as intervals along the axis, at many depths, those
//! right above each depth of the law of G76 among them.

use super::Thread;
use super::cycles::{Cycle, Pass, Program};

/// What may be wrong with a length: a Z on the tape is rounded by half of it.
pub const FINE: f64 = 0.001;
/// The same for the distance of two places.
const BETWEEN: f64 = 1.5 * FINE;
/// Depths looked at besides those of the law.
const DEPTHS: u32 = 150;

/// What a program cuts, when it is right.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cut {
    /// Farthest that the tool leaves the groove, square to its side.
    pub gouge: f64,
    /// Thickest stock left on a flank, square to it.
    pub stock: f64,
    /// Widest chip of a pass of G92, along the axis.
    pub chip: f64,
    /// Passes that take a chip.
    pub cutting: usize,
}

/// Cuts the thread.
///
/// # Errors
/// The first thing that is wrong: a cut below the profile, stock left above the
/// tolerance, a pass deeper or wider than its law.
pub fn cut(thread: &Thread, program: &Program) -> Result<Cut, String> {
    for (line, radius, _) in &program.rapids {
        if thread.inwards() * (radius - thread.crest) < FINE {
            return Err(format!("NC line {line}: rapid move within the stock"));
        }
    }
    let mut grooves = vec![Groove::new(thread); thread.starts as usize];
    let mut found = Cut::default();
    for pass in &program.passes {
        let at = |reason| format!("NC line {}: {reason}", pass.line);
        let (groove, place) = place(thread, pass).map_err(at)?;
        grooves[groove].pass(thread, pass, place, &mut found).map_err(at)?;
    }
    for groove in &grooves {
        groove.finished(thread, &mut found)?;
    }
    Ok(found)
}

/// The groove of a pass, and where in it the middle of the tool is, away from
/// the end of the thread.
fn place(thread: &Thread, pass: &Pass) -> Result<(usize, f64), String> {
    if (pass.lead - thread.lead()).abs() > 1e-6 {
        return Err(format!("lead {} for {}", pass.lead, thread.lead()));
    }
    if (pass.end - thread.end).abs() > FINE {
        return Err(format!("the pass ends at {}, the thread at {}", pass.end, thread.end));
    }
    let along = thread.away() * (pass.start - thread.start);
    // Unequal flanks lead the middle of the groove away from that of its root.
    let [end, away] = thread.outer(thread.inwards() * (thread.crest - pass.radius));
    let middle = (end + away) / 2.0;
    let beside = |groove: usize| {
        let rest = along - middle - groove as f64 * thread.pitch;
        rest - thread.lead() * (rest / thread.lead()).round()
    };
    let nearest = (0..thread.starts as usize)
        .map(|groove| (groove, beside(groove)))
        .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (groove, beside) = nearest.ok_or_else(|| "a thread without starts".to_string())?;
    Ok((groove, middle + beside))
}

/// One groove of the thread.
#[derive(Clone)]
struct Groove {
    levels: Vec<Level>,
    /// Passes of G92 along the root, at the outer positions.
    outer: [u32; 2],
}

/// What is cut at one depth: intervals along the axis, sorted and apart.
#[derive(Clone)]
struct Level {
    depth: f64,
    cut: Vec<[f64; 2]>,
}

impl Groove {
    fn new(thread: &Thread) -> Self {
        let height = thread.height();
        let mut depths: Vec<f64> =
            (0..DEPTHS).map(|i| height * (f64::from(i) + 0.5) / f64::from(DEPTHS)).collect();
        for (layer, top) in thread.layers.iter().zip(thread.floors()) {
            let mut number = 0;
            while law(thread, *layer, number) < *layer {
                number += 1;
                depths.push(top + law(thread, *layer, number) - FINE);
            }
            depths.push(top + FINE);
        }
        depths.retain(|depth| (0.0..height).contains(depth));
        depths.sort_by(f64::total_cmp);
        let level = |depth| Level { depth, cut: Vec::new() };
        Groove { levels: depths.into_iter().map(level).collect(), outer: [0; 2] }
    }

    /// Cuts with one pass.
    fn pass(
        &mut self,
        thread: &Thread,
        pass: &Pass,
        place: f64,
        found: &mut Cut,
    ) -> Result<(), String> {
        let depth = thread.inwards() * (thread.crest - pass.radius);
        found.gouge = found.gouge.max(gouge(thread, place, depth));
        if found.gouge > FINE {
            return Err(format!("{:.4} below the profile", found.gouge));
        }
        let floors = thread.floors();
        let floor = thread.inwards() * (thread.crest - pass.floor);
        let layer = (1..floors.len())
            .find(|layer| (floors[*layer] - floor).abs() < FINE)
            .ok_or_else(|| format!("depth {floor} is the floor of no layer"))?;
        let mut stroke =
            Stroke { place, depth, top: floors[layer - 1], floor: floors[layer], chip: 0.0 };
        let roughed = match pass.cycle {
            Cycle::G76(number) => stroke.roughed(thread, number - 1),
            Cycle::G92 => stroke.top,
        };
        stroke.chip = self.take(thread, place, depth, [stroke.top, roughed])?;
        found.cutting += usize::from(stroke.chip > BETWEEN);
        if let Cycle::G76(number) = pass.cycle {
            return stroke.roughs(thread, number);
        }
        found.chip = found.chip.max(stroke.chip);
        stroke.widens(thread)?;
        if layer == thread.layers.len() {
            for (passes, outer) in self.outer.iter_mut().zip(thread.outer(stroke.floor)) {
                *passes += u32::from((place - outer).abs() < FINE);
            }
        }
        Ok(())
    }

    /// Takes the tool's outline away; the widest chip at one depth. Nothing may
    /// be left above the first depth given, and nothing under the nose above the
    /// second: the edges of the tool widen what is roughed on their way down.
    ///
    /// # Errors
    /// A chip where this pass has none to take.
    fn take(
        &mut self,
        thread: &Thread,
        place: f64,
        depth: f64,
        [top, roughed]: [f64; 2],
    ) -> Result<f64, String> {
        let mut widest: f64 = 0.0;
        let nose = thread.nose / 2.0;
        for level in self.levels.iter_mut().filter(|level| level.depth <= depth) {
            let wide = thread.edges().map(|edge| nose + (depth - level.depth) * edge);
            let under = length(&level.left([place - nose, place + nose]));
            let chip = level.take([place - wide[0], place + wide[1]]);
            let due = if under > BETWEEN { roughed } else { top };
            if chip > BETWEEN && level.depth < due - BETWEEN {
                return Err(format!("deeper than its law: it meets stock {:.4} deep", level.depth));
            }
            widest = widest.max(chip);
        }
        Ok(widest)
    }

    /// Looks at what is left.
    fn finished(&self, thread: &Thread, found: &mut Cut) -> Result<(), String> {
        let square = thread.flanks().map(|angle| angle.to_radians().cos());
        for level in &self.levels {
            let [end, away] = thread.reach(level.depth);
            for [from, to] in level.left([-end, away]) {
                let on_flank = from <= -end || to >= away;
                if !on_flank && to - from > BETWEEN {
                    return Err(format!("a ridge of {:.4} at depth {:.4}", to - from, level.depth));
                }
                let square = if from <= -end { square[0] } else { square[1] };
                found.stock = found.stock.max((to - from) * square);
            }
        }
        if found.stock > thread.tolerance + FINE {
            return Err(format!("{:.4} left on the flank", found.stock));
        }
        // Passes that lie closer than the tape can tell are not told apart.
        let span = thread.span(thread.height());
        let cleaned = u32::from(span > 1e-6);
        if (span > BETWEEN || cleaned == 0) && self.outer != [cleaned + thread.finish; 2] {
            return Err(format!("{:?} passes at the outer positions of the root", self.outer));
        }
        Ok(())
    }
}

/// A pass in its layer.
struct Stroke {
    /// Where the middle of the tool is, and how deep its nose.
    place: f64,
    depth: f64,
    /// The layer.
    top: f64,
    floor: f64,
    /// Its chip along the axis.
    chip: f64,
}

impl Stroke {
    /// How deep a number of passes of G76 has cut the layer.
    fn roughed(&self, thread: &Thread, number: u32) -> f64 {
        self.top + law(thread, self.floor - self.top, number)
    }

    /// Looks at a pass of G76.
    fn roughs(&self, thread: &Thread, number: u32) -> Result<(), String> {
        let wanted = self.roughed(thread, number);
        if (self.depth - wanted).abs() > FINE {
            return Err(format!("pass {number} of G76 at {:.4} for {wanted:.4}", self.depth));
        }
        let added = wanted - self.roughed(thread, number - 1);
        if added > 2.0 * BETWEEN && self.chip < thread.nose - BETWEEN {
            return Err(format!("pass {number} of G76 cuts air"));
        }
        let [outer, _] = thread.outer(self.floor);
        if (self.place - outer).abs() > FINE {
            return Err(format!("G76 at {:.4} for {outer:.4}", self.place));
        }
        Ok(())
    }

    /// Looks at a pass of G92.
    fn widens(&self, thread: &Thread) -> Result<(), String> {
        let law = thread.cut_offset(self.floor);
        if self.chip > law + BETWEEN {
            return Err(format!("a chip of {:.4} for a CUT_OFFSET of {law:.4}", self.chip));
        }
        let shifts = (self.place - thread.outer(self.floor)[0]) / law;
        if law > FINE && (shifts - shifts.round()).abs() * law > FINE {
            return Err(format!("G92 at {:.4} is {shifts:.3} shifts from G76", self.place));
        }
        Ok(())
    }
}

impl Level {
    /// The parts of an interval that are not cut yet.
    fn left(&self, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
        let mut left = Vec::new();
        let mut at = from;
        for [low, high] in &self.cut {
            if *low > at && *low < to {
                left.push([at, *low]);
            }
            at = at.max(*high);
        }
        if at < to {
            left.push([at, to]);
        }
        left.retain(|[low, high]| high - low > 1e-9);
        left
    }

    /// Cuts an interval; how much of it was stock.
    fn take(&mut self, [mut from, mut to]: [f64; 2]) -> f64 {
        let chip = length(&self.left([from, to]));
        self.cut.retain(|[low, high]| {
            let apart = *high < from || *low > to;
            if !apart {
                (from, to) = (from.min(*low), to.max(*high));
            }
            apart
        });
        let position = self.cut.partition_point(|[low, _]| *low < from);
        self.cut.insert(position, [from, to]);
        chip
    }
}

fn length(pieces: &[[f64; 2]]) -> f64 {
    pieces.iter().map(|[low, high]| high - low).sum()
}

/// Depth of a pass of G76 below the top of its layer: D1*sqrt(i), the layer's
/// height at last.
fn law(thread: &Thread, layer: f64, number: u32) -> f64 {
    let depth = thread.first * f64::from(number).sqrt();
    if depth > layer - 1e-6 { layer } else { depth }
}

/// How far the tool leaves the groove. Both are convex, so its corners and its
/// edges at the crest tell.
fn gouge(thread: &Thread, place: f64, depth: f64) -> f64 {
    let nose = thread.nose / 2.0;
    let mut gouge = depth - thread.height();
    for (side, aside) in [-place, place].into_iter().enumerate() {
        let square = thread.flanks()[side].to_radians().cos();
        let beside = |half: f64, at: f64| (aside + half - thread.reach(at)[side]) * square;
        let at_crest = beside(nose + depth * thread.edges()[side], 0.0);
        gouge = gouge.max(beside(nose, depth)).max(at_crest);
    }
    gouge
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_cut_grows_together() {
        let mut level = Level { depth: 0.0, cut: Vec::new() };
        assert_eq!(level.take([0.0, 1.0]), 1.0);
        assert_eq!(level.take([2.0, 3.0]), 1.0);
        assert_eq!(level.left([-1.0, 4.0]), [[-1.0, 0.0], [1.0, 2.0], [3.0, 4.0]]);
        assert_eq!(level.take([0.5, 2.5]), 1.0);
        assert_eq!(level.cut, [[0.0, 3.0]]);
    }
}
