//! Compares the path a CL file asks for with the path of an NC program.
//!
//! A post may split a rapid in two (X and Y above, then Z, or Z first on the way
//! up), drop a motion to where the tool already is, and go to a fixed point of
//! the machine. All else must agree: order, kind and end of each motion, plane,
//! sense and center of arcs, feed rates, tools, and the holes.

mod holes;
#[cfg(test)]
mod tests;

use std::fmt;

use crate::path::{Action, Arc, Point, Step, ToolPath, Unit};

/// How far two values may be apart, in the unit of the NC program.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Coordinates of an end point.
    pub end: f64,
    /// Coordinates of a center: start point and I J K are both rounded.
    pub center: f64,
    /// Feed rate.
    pub rate: f64,
}

/// A difference between the two paths.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Line of the CL file.
    pub cl_line: Option<u32>,
    /// Line of the NC program.
    pub nc_line: Option<u32>,
    /// What differs, in words.
    pub what: String,
}

/// After so many differences the rest is not looked at.
const ENOUGH: usize = 50;

/// How far to look for the place where the paths agree again.
const LOOK_AHEAD: usize = 8;

impl Tolerance {
    /// Half of the last decimal usual in this unit (3 for mm, 4 for inch), and a bit.
    pub fn of(unit: Unit) -> Tolerance {
        match unit {
            Unit::Mm => Tolerance { end: 0.0006, center: 0.0012, rate: 0.06 },
            Unit::Inch => Tolerance { end: 0.00006, center: 0.00012, rate: 0.006 },
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = |line: Option<u32>| line.map_or("end".to_string(), |line| line.to_string());
        write!(f, "CL {}, NC {}: {}", line(self.cl_line), line(self.nc_line), self.what)
    }
}

/// The differences between a CL path and an NC path; none when they agree.
pub fn compare(cl: &ToolPath, nc: &ToolPath) -> Vec<Difference> {
    let unit = nc.unit.unwrap_or(Unit::Mm);
    let factor = cl.unit.unwrap_or(unit).in_mm() / unit.in_mm();
    let scale = |step: &Step| Step { action: step.action.scaled(factor), ..*step };
    let expected: Vec<Step> = cl.steps.iter().map(scale).collect();
    let mut walk = Walk::new(&expected, &nc.steps, Tolerance::of(unit));
    walk.all();
    walk.differences
}

/// Walks along both paths.
struct Walk<'a> {
    expected: &'a [Step],
    nc: &'a [Step],
    /// Next step of each.
    next_cl: usize,
    next_nc: usize,
    /// Where the NC program is.
    position: Point,
    /// False at the start and after a motion to a fixed point of the machine,
    /// when the height in work coordinates means nothing.
    height_known: bool,
    tolerance: Tolerance,
    differences: Vec<Difference>,
}

impl<'a> Walk<'a> {
    fn new(expected: &'a [Step], nc: &'a [Step], tolerance: Tolerance) -> Self {
        Walk {
            expected,
            nc,
            next_cl: 0,
            next_nc: 0,
            position: [0.0; 3],
            height_known: false,
            tolerance,
            differences: Vec::new(),
        }
    }

    fn all(&mut self) {
        while let Some(step) = self.expected.get(self.next_cl) {
            if self.differences.len() >= ENOUGH {
                self.report("more differences are not listed".to_string());
                return;
            }
            match step.action {
                Action::Hole(hole, rate) => self.hole(&hole, rate),
                _ => self.step(&step.action),
            }
            self.next_cl += 1;
        }
        while let Some(action) = self.peek() {
            self.report(format!("the CL file asks for no {}", name(&action)));
            self.consume(&action);
        }
    }

    /// Compares one step of the CL path.
    fn step(&mut self, wanted: &Action) {
        while let Some(found) = self.peek() {
            if self.agrees(wanted, &found) {
                self.details(wanted, &found);
                self.consume(&found);
                self.height_known |= wanted.end().is_some();
                return;
            }
            if self.is_part_of_rapid(wanted, &found) {
                self.consume(&found);
                continue;
            }
            if self.is_there(wanted) {
                return;
            }
            if self.same_end(wanted, &found) {
                self.report(format!("{} in place of {}", name(&found), name(wanted)));
                self.consume(&found);
                return;
            }
            match self.detour(wanted, &found) {
                Detour::Missing => return self.report(format!("no {}", name(wanted))),
                Detour::Extra(count) => self.extra(count),
                Detour::None => {
                    self.report(format!("{}, should be {}", name(&found), name(wanted)));
                    return self.consume(&found);
                }
            }
        }
        if !self.is_there(wanted) {
            self.report(format!("no {}", name(wanted)));
        }
    }

    /// Reports steps of the NC program that the CL path does not have.
    fn extra(&mut self, count: usize) {
        for _ in 0..count {
            if let Some(action) = self.peek() {
                self.report(format!("the CL file asks for no {} here", name(&action)));
                self.consume(&action);
            }
        }
    }

    /// The next step of the NC program, past motions to fixed points.
    fn peek(&mut self) -> Option<Action> {
        while let Some(step) = self.nc.get(self.next_nc) {
            let Action::Reference(to) = step.action else { return Some(step.action) };
            self.position = to;
            self.height_known = false;
            self.next_nc += 1;
        }
        None
    }

    fn consume(&mut self, action: &Action) {
        self.position = action.end().unwrap_or(self.position);
        self.next_nc += 1;
    }

    /// Notes a difference at the next step of the NC program.
    fn report(&mut self, what: String) {
        self.report_at(self.next_nc, what);
    }

    fn report_at(&mut self, nc: usize, what: String) {
        let line = |steps: &[Step], at: usize| steps.get(at).map(|step| step.line);
        self.differences.push(Difference {
            cl_line: line(self.expected, self.next_cl),
            nc_line: line(self.nc, nc),
            what,
        });
    }

    fn near(&self, a: f64, b: f64) -> bool {
        (a - b).abs() <= self.tolerance.end
    }

    fn same_point(&self, a: Point, b: Point) -> bool {
        (0..3).all(|axis| self.near(a[axis], b[axis]))
    }

    fn same_end(&self, a: &Action, b: &Action) -> bool {
        matches!((a.end(), b.end()), (Some(a), Some(b)) if self.same_point(a, b))
    }

    /// True when both are of one kind and end at one point: details may differ.
    fn agrees(&self, wanted: &Action, found: &Action) -> bool {
        let same_kind = std::mem::discriminant(wanted) == std::mem::discriminant(found);
        let both_tools = matches!((wanted, found), (Action::Tool(_), Action::Tool(_)));
        same_kind && (both_tools || self.same_end(wanted, found))
    }

    /// True when a straight motion ends where the tool already is.
    fn is_there(&self, wanted: &Action) -> bool {
        match wanted {
            Action::Rapid(to) | Action::Feed(to, _) => self.same_point(*to, self.position),
            _ => false,
        }
    }

    /// True when `found` is a first part of a rapid that is split: each axis
    /// stays or is at its end, and the height is the safe one of the two.
    fn is_part_of_rapid(&self, wanted: &Action, found: &Action) -> bool {
        let (Action::Rapid(to), Action::Rapid(part)) = (wanted, found) else { return false };
        let stays_or_ends = |axis: usize| {
            self.near(part[axis], self.position[axis]) || self.near(part[axis], to[axis])
        };
        let is_high = self.near(part[2], self.position[2].max(to[2]));
        (0..3).all(stays_or_ends) && (is_high || !self.height_known)
    }

    /// Tells whether the paths agree again after leaving out steps of one of them.
    fn detour(&self, wanted: &Action, found: &Action) -> Detour {
        let later_cl = self.expected.iter().skip(self.next_cl + 1).take(LOOK_AHEAD);
        let later_nc = self.nc.iter().skip(self.next_nc + 1).take(LOOK_AHEAD);
        let missing = later_cl.map(|step| &step.action).position(|later| self.agrees(later, found));
        let extra = later_nc.map(|step| &step.action).position(|later| self.agrees(wanted, later));
        match (missing, extra) {
            (Some(missing), Some(extra)) if extra < missing => Detour::Extra(extra + 1),
            (Some(_), _) => Detour::Missing,
            (None, Some(extra)) => Detour::Extra(extra + 1),
            (None, None) => match (wanted, found) {
                (Action::Tool(_), _) => Detour::Missing,
                (_, Action::Tool(_)) => Detour::Extra(1),
                _ => Detour::None,
            },
        }
    }

    /// Compares what two steps of one kind and end still can differ in.
    fn details(&mut self, wanted: &Action, found: &Action) {
        match (wanted, found) {
            (Action::Tool(a), Action::Tool(b)) if a != b => {
                self.report(format!("tool {b}, should be tool {a}"));
            }
            (Action::Feed(_, a), Action::Feed(_, b)) => self.rates(*a, *b),
            (Action::Arc(arc, a), Action::Arc(other, b)) => {
                self.arcs(arc, other);
                self.rates(*a, *b);
            }
            _ => {}
        }
    }

    fn arcs(&mut self, wanted: &Arc, found: &Arc) {
        if wanted.normal != found.normal {
            self.report(format!(
                "arc about {:?}, should be about {:?}",
                found.normal, wanted.normal
            ));
            return;
        }
        if wanted.ccw != found.ccw {
            self.report(format!("arc {}, should be {}", sense(found), sense(wanted)));
        }
        if wanted.turns != found.turns {
            self.report(format!("arc of {} turns, should be {}", found.turns, wanted.turns));
        }
        let off = |axis: usize| (wanted.center[axis] - found.center[axis]).abs();
        if wanted.normal.plane().into_iter().any(|axis| off(axis) > self.tolerance.center) {
            let (found, wanted) = (spell(found.center), spell(wanted.center));
            self.report(format!("arc with center {found}, should be {wanted}"));
        }
    }

    /// Compares feed rates where both are known.
    fn rates(&mut self, wanted: Option<f64>, found: Option<f64>) {
        if let (Some(wanted), Some(found)) = (wanted, found)
            && (wanted - found).abs() > self.tolerance.rate
        {
            self.report(format!("feed rate {found}, should be {wanted}"));
        }
    }
}

/// How the paths come together again.
enum Detour {
    /// The NC program lacks the wanted step.
    Missing,
    /// The NC program has so many steps too many.
    Extra(usize),
    /// They do not.
    None,
}

fn name(action: &Action) -> String {
    match action {
        Action::Tool(number) => format!("change to tool {number}"),
        Action::Rapid(to) => format!("rapid to {}", spell(*to)),
        Action::Feed(to, _) => format!("feed to {}", spell(*to)),
        Action::Arc(arc, _) => format!("arc {} to {}", sense(arc), spell(arc.to)),
        Action::Hole(hole, _) => format!("hole at X{:.4} Y{:.4}", hole.at[0], hole.at[1]),
        Action::Reference(to) => format!("motion to machine point {}", spell(*to)),
    }
}

fn sense(arc: &Arc) -> &'static str {
    if arc.ccw { "counterclockwise (G3)" } else { "clockwise (G2)" }
}

fn spell([x, y, z]: Point) -> String {
    format!("X{x:.4} Y{y:.4} Z{z:.4}")
}
