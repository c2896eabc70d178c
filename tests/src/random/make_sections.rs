//! Stretches of a random program that are more than a motion: holes, contours
//! under compensation, frames, skipped blocks.

use crate::path::{Axis, Unit};

use super::features::Feature;
use super::make::Maker;
use super::statement::{
    CutcomCommand, CycleKind, CycleShape, Feedrate, SpindleCommand, Statement, Trans,
};

impl Maker {
    pub(super) fn holes(&mut self) {
        let level = self.high_point();
        self.rapid(level);
        let shape = self.cycle_shape();
        if shape.kind == CycleKind::Tap || shape.kind == CycleKind::Bore {
            let speed = 200.0 + self.dice.below(500) as f64;
            self.turns = true;
            self.say(Statement::Spindle(SpindleCommand::Turn { speed, ccw: false }));
        }
        self.say(Statement::Cycle(shape));
        for _ in 0..1 + self.dice.below(5) {
            self.in_cycle();
            let [x, y, _] = self.point();
            let z = if self.dice.once_in(3) { self.length(-5.0, 15.0) } else { 0.0 };
            let again = self.dice.once_in(8);
            let hole = if again { [self.at[0], self.at[1], z] } else { [x, y, z] };
            self.say(Statement::Hole(hole));
            self.at = hole;
        }
        self.say(Statement::CycleOff);
        if self.rapids(6) {
            let to = self.high_point();
            self.rapid(to);
        }
    }

    /// What may cross a cycle.
    fn in_cycle(&mut self) {
        if !self.has(Feature::CycleCrossings) {
            return;
        }
        match self.dice.below(12) {
            0..=3 => {
                let mut to = self.high_point();
                if self.dice.once_in(2) {
                    to[2] = self.length(16.0, 30.0);
                }
                self.rapid(to);
            }
            4 => {
                let shape = self.cycle_shape();
                self.say(Statement::Cycle(shape));
            }
            5 => self.aside(),
            6 if self.has(Feature::Arcs) => self.arc(),
            7 if self.has(Feature::Tools) => self.change_tool(),
            8 => self.spindle(true),
            9 if self.has(Feature::Cutcom) => self.say(Statement::Cutcom(CutcomCommand::Off)),
            _ => {}
        }
    }

    fn cycle_shape(&mut self) -> CycleShape {
        const KINDS: [CycleKind; 9] = [
            CycleKind::Drill,
            CycleKind::Thru,
            CycleKind::Face,
            CycleKind::Csink,
            CycleKind::Deep,
            CycleKind::Brkchp,
            CycleKind::Ream,
            CycleKind::Bore,
            CycleKind::Tap,
        ];
        let kind = KINDS[self.dice.below(KINDS.len())];
        let kind =
            if self.setup.expanded && kind == CycleKind::Tap { CycleKind::Deep } else { kind };
        let depth = self.length(1.0, 18.0);
        // The interpreter takes G82 and G86 with a dwell only.
        let always = matches!(kind, CycleKind::Face | CycleKind::Csink | CycleKind::Bore);
        let sometimes = self.has(Feature::CycleDwells) && self.dice.once_in(3);
        CycleShape {
            kind,
            depth,
            clear: if self.dice.once_in(10) { 0.0 } else { self.length(0.5, 6.0) },
            feed: (!self.dice.once_in(4)).then(|| self.feed()),
            step: kind.pecks().then(|| depth / (1.5 + self.dice.below(5) as f64)),
            retract: match self.dice.below(4) {
                0 => Some(0.0),
                1 => Some(self.length(5.0, 30.0)),
                _ => None,
            },
            dwell: (sometimes || always).then(|| 0.25 * (1 + self.dice.below(8)) as f64),
        }
    }

    /// A contour under cutter compensation.
    pub(super) fn contour(&mut self) {
        let to = self.high_point();
        self.rapid(to);
        let down = [to[0], to[1], self.length(-5.0, 0.0)];
        self.cut(down);
        let offset = self.dice.once_in(3).then(|| 20 + self.dice.below(9) as u32);
        let left = self.dice.once_in(2);
        self.say(Statement::Cutcom(CutcomCommand::On { left, offset }));
        self.compensated = true;
        let crossing = self.has(Feature::CutcomCrossings);
        if !(crossing && self.dice.once_in(3)) {
            self.level_cut();
        }
        for _ in 0..1 + self.dice.below(4) {
            self.aside();
            if self.has(Feature::Arcs) && self.dice.once_in(2) {
                let radius = self.length(1.0, 40.0);
                self.arc_of(radius);
            } else {
                self.level_cut();
            }
        }
        if crossing && self.dice.once_in(3) {
            self.change_tool();
        }
        self.say(Statement::Cutcom(CutcomCommand::Off));
        if !(crossing && self.dice.once_in(3)) {
            self.level_cut();
        }
        self.compensated = false;
    }

    /// A cut at the height of the tool.
    fn level_cut(&mut self) {
        let [x, y, _] = self.point();
        self.cut([x, y, self.at[2]]);
    }

    pub(super) fn frame(&mut self) {
        let to = self.high_point();
        self.rapid(to);
        let shift = [self.length(-9.0, 9.0), self.length(-9.0, 9.0), self.length(-2.0, 2.0)];
        let angle = if self.dice.once_in(2) { 90.0 } else { self.dice.between(0.0, 360.0) };
        let trans = match self.dice.below(4) {
            0 => Trans::Shift(shift),
            1 => Trans::Matrix {
                about: if self.dice.once_in(2) { Axis::X } else { Axis::Y },
                angle: 90.0,
                mirror: self.dice.once_in(3),
                shift,
                points_only: true,
            },
            _ => Trans::Matrix {
                about: Axis::Z,
                angle,
                mirror: self.dice.once_in(3),
                shift,
                points_only: self.dice.once_in(2),
            },
        };
        let across = matches!(trans, Trans::Matrix { about: Axis::X | Axis::Y, .. });
        self.say(Statement::Trans(trans));
        if self.rapids(5) {
            let to = self.high_point();
            self.rapid(to);
        }
        for _ in 0..1 + self.dice.below(4) {
            self.aside();
            self.motion();
        }
        if self.has(Feature::Cycles) && !across && self.dice.once_in(2) {
            self.holes();
        }
        self.say(Statement::TransOff);
        if self.rapids(5) {
            let to = self.high_point();
            self.rapid(to);
        }
    }

    pub(super) fn change_unit(&mut self) {
        let metric = self.size == 1.0;
        let unit = if metric { Unit::Inch } else { Unit::Mm };
        self.size = 1.0 / unit.in_mm();
        self.say(Statement::Units(unit));
        let feed = Feedrate { value: 0.5, per_revolution: false };
        self.per_revolution = false;
        self.say(Statement::Feedrate(feed));
        let to = self.high_point();
        self.rapid(to);
    }

    pub(super) fn skipped(&mut self) {
        self.say(Statement::Skip(true));
        for _ in 0..1 + self.dice.below(3) {
            match self.dice.below(5) {
                0 if self.has(Feature::Cycles) => self.holes(),
                1 => self.aside(),
                2 => {
                    let to = self.high_point();
                    self.rapid(to);
                }
                _ => self.motion(),
            }
        }
        self.say(Statement::Skip(false));
        match self.dice.below(4) {
            0 => self.motion(),
            1 => {
                let to = self.point();
                self.cut(to);
            }
            _ => {
                let to = self.high_point();
                self.rapid(to);
            }
        }
    }
}
