//! A straight way of the tip, and where X, Y and Z leave their travel on it.

use fil_machine::axes::AxisSet;
use fil_machine::tables::MachineTables;
use nalgebra::Point3;

/// Places between the ends at which the axes are looked at.
const SAMPLES: u32 = 32;

/// Halvings of the part in which an axis comes to the end of its travel.
const HALVINGS: u32 = 40;

/// A straight way of the tip while the rotary axes go evenly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Its ends in the part, behind TRANS.
    pub line: [Point3<f64>; 2],
    /// The rotary axes there, degrees.
    pub turn: [[f64; 2]; 2],
}

impl Way {
    /// Where the rotary axes stand at a share of the way, degrees.
    pub fn angles(&self, share: f64) -> [f64; 2] {
        let [from, to] = self.turn;
        [0, 1].map(|n| from[n] + (to[n] - from[n]) * share)
    }

    /// Which axes are outside of their travel at a share of the way.
    fn exceeded_at(&self, tables: &MachineTables, share: f64) -> AxisSet {
        let at = self.axes_at(tables, share);
        tables.exceeded([at.x, at.y, at.z])
    }

    /// Where X, Y and Z of the machine stand at a share of the way.
    fn axes_at(&self, tables: &MachineTables, share: f64) -> Point3<f64> {
        let [from, to] = self.line;
        tables.chain().linear(from + (to - from) * share, self.angles(share))
    }

    /// Which axes leave their travel on the way; where it begins they stand already.
    pub fn exceeded(&self, tables: &MachineTables) -> AxisSet {
        shares().map(|share| self.exceeded_at(tables, share)).fold(AxisSet::NONE, AxisSet::or)
    }

    /// Where an axis stands last outside of its travel, in words.
    pub fn told(&self, tables: &MachineTables, number: usize) -> Option<String> {
        let axis = AxisSet::of(number);
        let outside = |share: &f64| !self.exceeded_at(tables, *share).and(axis).is_empty();
        let share = shares().filter(outside).last()?;
        let at = self.axes_at(tables, share);
        Some(tables.check_travel(&[at.x, at.y, at.z, 0.0, 0.0], axis).err()?.message)
    }

    /// No axis leaves its travel, from the beginning on.
    pub fn is_inside(&self, tables: &MachineTables) -> bool {
        self.exceeded_at(tables, 0.0).is_empty() && self.exceeded(tables).is_empty()
    }

    /// The share of the way at which the first axis comes to the end of its travel.
    pub fn share_inside(&self, tables: &MachineTables) -> f64 {
        let leaves = |share: &f64| !self.exceeded_at(tables, *share).is_empty();
        let Some(mut outside) = shares().find(leaves) else { return 1.0 };
        let mut inside = outside - 1.0 / f64::from(SAMPLES);
        for _ in 0..HALVINGS {
            let middle = (inside + outside) / 2.0;
            if leaves(&middle) { outside = middle } else { inside = middle }
        }
        inside
    }
}

fn shares() -> impl Iterator<Item = f64> {
    (1..=SAMPLES).map(|number| f64::from(number) / f64::from(SAMPLES))
}
