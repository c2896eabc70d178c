//! Drilling cycles, as the model reads them.

use crate::path::Point;

use super::expected::{Act, Hole, Rate, Turning, Want, WayOut};
use super::geometry::times;
use super::model::{Model, number};
use super::statement::{CycleKind, CycleShape};

/// A cycle that is on. Lengths in mm.
pub(super) struct Active {
    kind: CycleKind,
    depth: f64,
    clear: f64,
    step: Option<f64>,
    retract: Option<f64>,
    dwell: Option<f64>,
    /// Its own feed; `None` drills at that of the last FEDRAT before each hole.
    feed: Option<Want<Rate>>,
    /// Lowest and highest level the cycle may be said to begin from; unknown at
    /// the start of a program and after a tool change.
    initial: Option<[f64; 2]>,
}

impl Active {
    /// It taps.
    pub(super) fn taps(&self) -> bool {
        self.kind == CycleKind::Tap
    }

    /// A rapid motion inside the cycle ends at a height.
    pub(super) fn traversed(&mut self, z: f64) {
        let highest = self.initial.map_or(z, |[_, high]| high.max(z));
        self.initial = Some([z, highest]);
    }

    /// Lowest and highest Z the tool may come back to after a hole.
    fn back(&self, start: f64, clear: f64) -> [f64; 2] {
        let Some(above) = self.retract else { return [clear, clear] };
        let [low, high] = self.initial.unwrap_or([clear, f64::INFINITY]);
        let least = if above > 0.0 { clear.max(start + above) } else { clear.max(low) };
        [least, least.max(high)]
    }
}

impl Model<'_> {
    /// CYCLE with its couplets.
    pub(super) fn cycle(&mut self, shape: &CycleShape) {
        self.cycle_text(shape);
        let unit = self.mm();
        let feed = shape.feed.map(|feed| Want::only(self.rate(feed)));
        if feed.is_none() && self.no_feed() {
            self.must_refuse("a cycle without a feed");
        }
        if self.compensated() {
            self.may_refuse("a cycle under compensation");
        }
        if self.setup.expanded && shape.kind == CycleKind::Tap {
            self.must_refuse("tapping as single moves");
        }
        if let Some(seconds) = shape.dwell {
            let dwells = [CycleKind::Face, CycleKind::Csink, CycleKind::Bore];
            if !dwells.contains(&shape.kind) && !self.setup.expanded {
                self.may_refuse("a dwell in a cycle of the control that has none");
            }
            if self.setup.rounds_dwell(seconds) {
                self.may_refuse("a dwell that its format can't hold");
            }
        }
        let here = self.tape.map(|tape| [tape[2], tape[2]]);
        let before = self.cycle.as_ref().and_then(|cycle| cycle.initial);
        let initial = match (here, before) {
            (Some([z, _]), Some([low, high])) => Some([low.min(z), high.max(z)]),
            (here, before) => here.or(before),
        };
        self.cycle = Some(Active {
            kind: shape.kind,
            depth: shape.depth * unit,
            clear: shape.clear * unit,
            step: shape.step.map(|step| step * unit),
            retract: shape.retract.map(|above| above * unit),
            dwell: shape.dwell,
            feed,
            initial,
        });
    }

    fn cycle_text(&mut self, shape: &CycleShape) {
        let mut items = format!("{}, DEPTH, {}", shape.kind.word(), number(shape.depth));
        let mut couplet = |word: &str, value: Option<f64>| {
            if let Some(value) = value {
                items.push_str(&format!(", {word}, {}", number(value)));
            }
        };
        couplet("STEP", shape.step);
        if let Some(feed) = shape.feed {
            couplet(self.feed_unit(feed), Some(feed.value));
        }
        couplet("CLEAR", Some(shape.clear));
        couplet("RETURN", shape.retract);
        couplet("DWELL", shape.dwell);
        self.line(&format!("CYCLE / {items}"));
    }

    /// GOTO that is a hole.
    pub(super) fn hole(&mut self, at: Point) {
        self.goto(at);
        let target = times(at, self.mm());
        let Some(cycle) = &self.cycle else { return self.out.unpredictable = true };
        let machine = self.frame.apply(target);
        let clear = machine[2] + cycle.clear;
        let hole = Hole {
            at: [machine[0], machine[1]],
            clear,
            bottom: machine[2] - cycle.depth,
            step: cycle.step.filter(|_| cycle.kind.pecks()),
            back: cycle.back(machine[2], clear),
            dwell: self.dwell_at_bottom(cycle),
            out: match cycle.kind {
                CycleKind::Tap => WayOut::Tapped,
                CycleKind::Bore => WayOut::Bored,
                CycleKind::Ream => WayOut::Feed,
                _ => WayOut::Rapid,
            },
        };
        let feed = cycle.feed.clone().unwrap_or_else(|| self.feed.clone());
        let kind = cycle.kind;
        self.spindle_of(kind);
        if self.height_unknown {
            self.may_refuse("a hole from a height that is not known");
        }
        self.at = Some(target);
        self.is_left = false;
        self.settle(true, true);
        let outer = std::mem::replace(&mut self.feed, feed);
        self.push(Act::Hole(hole));
        self.feed = outer;
        let back = self.cycle.as_ref().map(|cycle| cycle.back(machine[2], clear));
        self.after_hole(machine, back);
    }

    /// The interpreter bores with the spindle turning, and taps with it clockwise.
    fn spindle_of(&mut self, kind: CycleKind) {
        let wrong = |turning: &Turning| match (kind, turning) {
            (CycleKind::Tap, Turning::At { ccw, .. }) => *ccw,
            (CycleKind::Tap | CycleKind::Bore, Turning::Stopped) => true,
            _ => false,
        };
        let asks = matches!(kind, CycleKind::Tap | CycleKind::Bore);
        if asks && (self.spindle.now == Want::Any || self.spindle.now.accepts(wrong)) {
            self.out.unpredictable = true;
        }
    }

    /// Where the tool stands after a hole, as far as the CL tells.
    fn after_hole(&mut self, machine: Point, back: Option<[f64; 2]>) {
        match back {
            Some([low, high]) if low == high => self.stands([machine[0], machine[1], low]),
            _ => {
                self.stands(machine);
                self.lost();
            }
        }
        // A later cycle, or a raise before a hole, may begin from here.
        if let (Some(cycle), Some([low, high])) = (&mut self.cycle, back)
            && let Some([_, highest]) = &mut cycle.initial
            && high.is_finite()
        {
            *highest = highest.max(low).max(high);
        }
    }

    /// Cycles that the control ends with a dwell as asked.
    fn dwell_at_bottom(&self, cycle: &Active) -> Option<f64> {
        (cycle.kind != CycleKind::Tap).then(|| cycle.dwell.unwrap_or(0.0))
    }
}
