//! What the machine does against what the CL program asks for, step by step.
//! The first difference is the verdict.

use crate::path::{Point, Unit};

use super::compare_arc::Sweep;
use super::expected::{Act, Hole, Modes, Rate, Step, Turning, WayOut};
use super::geometry::distance;
use super::machine::{NcAct, NcStep};
use super::setup::{CenterForm, Setup};

/// What the rounding of the ends of a leaning thread may change its lead by, as a part of it.
const SHARE: f64 = 2e-5;

/// A difference; two of one kind have the same name.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// What differs, in a word or two.
    pub kind: &'static str,
    /// The sentence.
    pub what: String,
    /// Line of the CL text.
    pub cl_line: Option<u32>,
    /// Line of the NC program.
    pub nc_line: Option<usize>,
}

impl Difference {
    /// What is the same in all differences with one cause: the kind, and what the
    /// interpreter or the post says, without the numbers of this case.
    pub fn class(&self) -> String {
        if !matches!(self.kind, "interpreter" | "refused" | "not refused") {
            return self.kind.to_string();
        }
        let said = self.what.split("lines: ").last().unwrap_or_default();
        let sentence = said.split([';', ':']).next().unwrap_or_default();
        let words: String = sentence.chars().filter(|c| !c.is_ascii_digit()).collect();
        format!("{}: {words}", self.kind)
    }
}

/// What rounding may change, mm.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// A coordinate of an end.
    pub end: f64,
    /// The way of an arc.
    pub curve: f64,
    /// The way of a chord.
    pub chord: f64,
    /// A feed.
    pub rate: f64,
    /// The lead of a thread.
    pub lead: f64,
}

impl Tolerance {
    /// Half of the last digit of the address and of the interpreter's output.
    pub fn new(setup: &Setup, unit: Unit) -> Self {
        const PRINTED: f64 = 1e-4;
        let (decimals, of_feed) = setup.decimals(unit);
        let digit = 10f64.powi(-decimals);
        let radius_form = if setup.center == CenterForm::Radius { 0.005 } else { 0.0 };
        Tolerance {
            end: (0.5 * digit + 0.6 * PRINTED) * unit.in_mm(),
            curve: (2.5 * digit + 2.0 * PRINTED) * unit.in_mm() + radius_form,
            chord: (1.5 * digit + PRINTED) * unit.in_mm() + 0.0055,
            rate: (0.51 * 10f64.powi(-of_feed) + 0.6 * PRINTED) * unit.in_mm(),
            lead: 0.51 * 10f64.powi(-of_feed) * unit.in_mm(),
        }
    }
}

/// Compares a program's steps with the expected ones.
///
/// # Errors
/// The first difference.
pub fn compare(
    setup: &Setup,
    tolerance: Tolerance,
    expected: &[Step],
    found: &[NcStep],
) -> Result<(), Difference> {
    let mut comparer = Comparer { setup, tolerance, found, next: 0, at: [0.0; 3], cl_line: None };
    for step in expected {
        comparer.cl_line = Some(step.line);
        comparer.step(step)?;
    }
    match comparer.peek() {
        Some(step) => comparer.fail("surplus", format!("{:?} too many", step.act)),
        None => Ok(()),
    }
}

pub(super) struct Comparer<'a> {
    setup: &'a Setup,
    pub(super) tolerance: Tolerance,
    found: &'a [NcStep],
    next: usize,
    /// Where the machine is.
    pub(super) at: Point,
    cl_line: Option<u32>,
}

type Outcome = Result<(), Difference>;

impl<'a> Comparer<'a> {
    pub(super) fn fail<T>(&self, kind: &'static str, what: String) -> Result<T, Difference> {
        let nc_line = self.peek().map(|step| step.line);
        Err(Difference { kind, what, cl_line: self.cl_line, nc_line })
    }

    /// The next step of the machine.
    pub(super) fn peek(&self) -> Option<&'a NcStep> {
        self.found.get(self.next)
    }

    pub(super) fn consume(&mut self) {
        if let Some(step) = self.peek() {
            self.at = step.act.end().unwrap_or(self.at);
            self.next += 1;
        }
    }

    pub(super) fn near(&self, a: Point, b: Point) -> bool {
        (0..3).all(|axis| (a[axis] - b[axis]).abs() <= self.tolerance.end)
    }

    fn step(&mut self, step: &Step) -> Outcome {
        match &step.act {
            Act::Rapid(to) => self.rapid(*to, step),
            Act::Feed(to) => self.feed(*to, step),
            Act::Arc(arc) => {
                let mut sweep = Sweep::new(arc);
                while let Some(found) = sweep.next(self)? {
                    if let Err(difference) = self.modes(&step.modes, found, true) {
                        return if sweep.is_doubtful(self) { Ok(()) } else { Err(difference) };
                    }
                    self.consume();
                }
                Ok(())
            }
            Act::Thread { to, lead } => self.thread(*to, *lead, step),
            Act::Hole(hole) => self.hole(hole, step),
            Act::Tool(tool) => self.exactly(&NcAct::Tool(*tool), "tool"),
            Act::Dwell(seconds) => self.dwell(*seconds),
            Act::Stop => self.exactly(&NcAct::Stop, "stop"),
            Act::OptionalStop => self.exactly(&NcAct::OptionalStop, "stop"),
        }
    }

    fn exactly(&mut self, act: &NcAct, kind: &'static str) -> Outcome {
        if self.peek().is_none_or(|found| found.act != *act) {
            return self.fail(kind, format!("{:?} in place of {act:?}", self.act()));
        }
        self.consume();
        Ok(())
    }

    fn act(&self) -> Option<&NcAct> {
        self.peek().map(|step| &step.act)
    }

    fn dwell(&mut self, seconds: f64) -> Outcome {
        match self.act() {
            Some(NcAct::Dwell(found)) if (found - seconds).abs() < 0.0011 => {
                self.consume();
                Ok(())
            }
            other => self.fail("dwell", format!("{other:?} in place of a dwell of {seconds} s")),
        }
    }

    /// Rapid in one go, or in parts: XY at the higher of the two levels, Z by itself.
    fn rapid(&mut self, to: Point, step: &Step) -> Outcome {
        while !self.near(self.at, to) {
            let Some(found) = self.peek() else {
                return self.fail("rapid", format!("no rapid to {}", spell(to)));
            };
            let NcAct::Rapid(part) = found.act else {
                let what = format!("{:?} in place of a rapid to {}", found.act, spell(to));
                return self.fail("rapid", what);
            };
            if !self.is_part(part, to, step.height_unknown) {
                let (from, part) = (spell(self.at), spell(part));
                let what = format!("rapid from {from} to {part} on the way to {}", spell(to));
                return self.fail("rapid", what);
            }
            self.modes(&step.modes, found, false)?;
            self.consume();
        }
        self.last_digit(to);
        Ok(())
    }

    /// A rapid of less than the tolerance that ends where another has ended.
    fn last_digit(&mut self, to: Point) {
        while let Some(NcAct::Rapid(end)) = self.act()
            && self.near(*end, to)
        {
            self.consume();
        }
    }

    fn is_part(&self, part: Point, to: Point, height_unknown: bool) -> bool {
        let same = |a: f64, b: f64| (a - b).abs() <= self.tolerance.end;
        let stays_or_ends =
            |axis: usize| same(part[axis], self.at[axis]) || same(part[axis], to[axis]);
        if !(0..3).all(stays_or_ends) {
            return false;
        }
        if !self.setup.split {
            return self.near(part, to);
        }
        let across = (0..2).any(|axis| !same(part[axis], self.at[axis]));
        let along = !same(part[2], self.at[2]);
        let high = part[2] >= to[2].max(self.at[2]) - self.tolerance.end;
        !across || !along && (high || height_unknown)
    }

    fn feed(&mut self, to: Point, step: &Step) -> Outcome {
        let there = self.near(self.at, to);
        // Rounding to the nearest digit never leads away from the point.
        // LinuxCNC's calls have radii, which hide the last digit of a diameter.
        let hidden = if self.setup.ready == "linuxcnc-lathe" { 1.5e-4 } else { 0.0 };
        let leads_there = |end: Point| {
            self.near(end, to) && (!there || distance(end, to) <= distance(self.at, to) + hidden)
        };
        match self.peek() {
            Some(found) if matches!(found.act, NcAct::Feed(end) if leads_there(end)) => {
                if !there {
                    self.modes(&step.modes, found, true)?;
                }
                self.consume();
                Ok(())
            }
            _ if there => Ok(()),
            found => {
                let found = found.map(|step| &step.act);
                self.fail("feed", format!("{found:?} in place of a feed to {}", spell(to)))
            }
        }
    }

    fn thread(&mut self, to: Point, lead: f64, step: &Step) -> Outcome {
        match self.peek() {
            Some(NcStep { act: NcAct::Thread { to: end, lead: found }, .. })
                if self.near(*end, to)
                    // A lead along the path is counted on its longer axis, whose share is that
                    // of rounded ends.
                    && (found - lead).abs() <= self.tolerance.lead + SHARE * lead =>
            {
                self.modes(&step.modes, &self.found[self.next], false)?;
                self.consume();
                Ok(())
            }
            _ if self.near(self.at, to) => Ok(()),
            found => {
                let found = found.map(|step| &step.act);
                let what = format!("{found:?} in place of a thread of {lead} to {}", spell(to));
                self.fail("thread", what)
            }
        }
    }

    fn hole(&mut self, hole: &Hole, step: &Step) -> Outcome {
        self.approach(hole, step)?;
        self.bore(hole, step)?;
        self.back(hole, step)
    }

    /// XY at or above the R level and the level before, then Z to the R level.
    fn approach(&mut self, hole: &Hole, step: &Step) -> Outcome {
        let end = self.tolerance.end;
        let target = [hole.at[0], hole.at[1], hole.clear];
        while !self.near(self.at, target) {
            let Some(NcStep { act: NcAct::Rapid(part), .. }) = self.peek() else {
                let what = format!("{:?} on the way to the hole at {}", self.act(), spell(target));
                return self.fail("hole approach", what);
            };
            let (part, from) = (*part, self.at);
            let across = (0..2).any(|axis| (part[axis] - from[axis]).abs() > end);
            let low = part[2] < hole.clear - end || from[2] < hole.clear - end;
            let flat = (part[2] - from[2]).abs() <= end;
            let over = (0..2).all(|axis| (part[axis] - hole.at[axis]).abs() <= end);
            let wrong = if across {
                !flat || !over || low && !step.height_unknown
            } else {
                part[2] < hole.clear - end
            };
            if wrong {
                let (from, part) = (spell(from), spell(part));
                let what = format!("rapid from {from} to {part} before {}", spell(target));
                return self.fail("hole approach", what);
            }
            self.hole_modes(hole, step, false)?;
            self.consume();
        }
        self.last_digit(target);
        Ok(())
    }

    fn hole_modes(&mut self, hole: &Hole, step: &Step, feeding: bool) -> Outcome {
        let Some(found) = self.peek() else { return Ok(()) };
        let mut modes = step.modes.clone();
        if matches!(hole.out, WayOut::Tapped | WayOut::Bored) {
            modes.spindle = super::expected::Want::Any;
        }
        self.modes(&modes, found, feeding)
    }

    /// Down to the bottom, in pecks or at once.
    fn bore(&mut self, hole: &Hole, step: &Step) -> Outcome {
        let end = self.tolerance.end;
        let mut reached = self.at[2];
        while reached > hole.bottom + end {
            let over = |to: &Point| (0..2).all(|axis| (to[axis] - hole.at[axis]).abs() <= end);
            match self.act() {
                Some(NcAct::Feed(to)) if over(to) && to[2] < reached - 1e-9 => {
                    let deepest = to[2];
                    let cut = reached - deepest;
                    if hole.step.is_none() && (deepest - hole.bottom).abs() > end
                        || hole.step.is_some_and(|step| cut > step + 4.0 * end)
                        || deepest < hole.bottom - end
                    {
                        let bottom = hole.bottom;
                        let what = format!("feed to Z{deepest:.4}, bottom Z{bottom:.4}");
                        return self.fail("hole depth", what);
                    }
                    self.hole_modes(hole, step, true)?;
                    reached = deepest;
                }
                Some(NcAct::Rapid(to))
                    if hole.step.is_some() && over(to) && to[2] >= reached - end =>
                {
                    self.hole_modes(hole, step, false)?;
                }
                found => return self.fail("hole", format!("{found:?} on the way down")),
            }
            self.consume();
        }
        self.last_peck(hole, step)
    }

    /// Dwell, then up to where the next motion begins.
    fn back(&mut self, hole: &Hole, step: &Step) -> Outcome {
        let end = self.tolerance.end;
        let dwells = matches!(self.act(), Some(NcAct::Dwell(_)));
        match hole.dwell {
            Some(seconds) if seconds > 0.0 => self.dwell(seconds)?,
            Some(_) if dwells => return self.fail("dwell", "a dwell in a hole without".into()),
            None if dwells => self.consume(),
            _ => {}
        }
        let mut out = false;
        while self.at[2] < hole.back[0] - end {
            let (to, feeds) = match self.act() {
                Some(NcAct::Rapid(to)) => (*to, false),
                Some(NcAct::Feed(to)) if hole.out != WayOut::Rapid => (*to, true),
                found => return self.fail("hole", format!("{found:?} on the way up")),
            };
            let beside = (0..2).any(|axis| (to[axis] - hole.at[axis]).abs() > end);
            if beside || to[2] < self.at[2] - end || to[2] > hole.back[1] + end {
                let (to, [low, high]) = (spell(to), hole.back);
                let what = format!("the tool comes back to {to}, not to Z{low:.4} to Z{high:.4}");
                return self.fail("hole return", what);
            }
            let stands = self.peek().is_some_and(|step| step.spindle == Turning::Stopped);
            let first = !out;
            out = true;
            let may = match hole.out {
                WayOut::Rapid => true,
                WayOut::Feed | WayOut::Tapped => feeds,
                WayOut::Bored => feeds || stands,
            };
            if first && !may {
                return self.fail("hole", "the tool comes out at rapid".to_string());
            }
            self.hole_modes(hole, step, feeds)?;
            self.consume();
        }
        while self.goes_higher(hole) && self.hole_modes(hole, step, false).is_ok() {
            self.consume();
        }
        Ok(())
    }

    /// Where the CL leaves open how far the tool comes back, it may go on straight up.
    fn goes_higher(&self, hole: &Hole) -> bool {
        let end = self.tolerance.end;
        matches!(self.act(), Some(NcAct::Rapid(to))
            if hole.back[0] < hole.back[1]
                && (0..2).all(|axis| (to[axis] - hole.at[axis]).abs() <= end)
                && to[2] > self.at[2]
                && to[2] <= hole.back[1] + end)
    }

    /// A further peck of less than a digit, which rounding of the peck makes: up,
    /// down again, and to the bottom.
    fn last_peck(&mut self, hole: &Hole, step: &Step) -> Outcome {
        let end = self.tolerance.end;
        let over = |to: &Point| (0..2).all(|axis| (to[axis] - hole.at[axis]).abs() <= end);
        let ahead = self.found.get(self.next..).unwrap_or_default();
        let rapids = ahead
            .iter()
            .take_while(|step| matches!(&step.act, NcAct::Rapid(to) if over(to)))
            .count();
        let cuts = matches!(ahead.get(rapids).map(|step| &step.act), Some(NcAct::Feed(to))
            if over(to) && (to[2] - hole.bottom).abs() <= end);
        if hole.step.is_some() && (1..=2).contains(&rapids) && cuts {
            for _ in 0..rapids {
                self.consume();
            }
            self.hole_modes(hole, step, true)?;
            self.consume();
        }
        Ok(())
    }

    /// The modes in force at a step of the machine.
    fn modes(&self, wanted: &Modes, found: &NcStep, feeding: bool) -> Outcome {
        let same_turn = |turning: &Turning| match (turning, found.spindle) {
            (Turning::Stopped, Turning::Stopped) => true,
            (Turning::At { speed, ccw }, Turning::At { speed: other, ccw: way }) => {
                (speed - other).abs() <= 0.5001 && *ccw == way
            }
            (Turning::Surface { speed, ccw }, Turning::Surface { speed: other, ccw: way }) => {
                (speed - other).abs() <= 0.5001 && *ccw == way
            }
            _ => false,
        };
        if !wanted.spindle.accepts(same_turn) {
            let what = format!("spindle {:?}, should be {:?}", found.spindle, wanted.spindle);
            return self.fail("spindle", what);
        }
        let surface = matches!(found.spindle, Turning::Surface { .. });
        if surface && !wanted.limit.accepts(|limit| *limit == found.limit) {
            let what = format!("spindle limit {}, should be {:?}", found.limit, wanted.limit);
            return self.fail("spindle limit", what);
        }
        if !wanted.coolant.accepts(|coolant| *coolant == found.coolant) {
            let what = format!("{:?}, should be {:?}", found.coolant, wanted.coolant);
            return self.fail("coolant", what);
        }
        if !wanted.compensation.accepts(|side| *side == found.compensation) {
            let what = format!("{:?}, should be {:?}", found.compensation, wanted.compensation);
            return self.fail("compensation", what);
        }
        // A lathe takes its offset with the tool, a mill with the first motion in Z.
        let counts = feeding || self.setup.turns();
        if counts && !wanted.length.accepts(|length| *length == found.length) {
            let what = format!("length offset {}, should be {:?}", found.length, wanted.length);
            return self.fail("length offset", what);
        }
        if !feeding {
            return Ok(());
        }
        let same_rate = |rate: &Rate| {
            (rate.value - found.feed.value).abs() <= self.tolerance.rate
                && rate.per_revolution == found.feed.per_revolution
        };
        if !wanted.feed.accepts(same_rate) {
            let what = format!("{:?}, should be {:?}", found.feed, wanted.feed);
            return self.fail("feed rate", what);
        }
        Ok(())
    }
}

pub(super) fn spell([x, y, z]: Point) -> String {
    format!("X{x:.4} Y{y:.4} Z{z:.4}")
}
