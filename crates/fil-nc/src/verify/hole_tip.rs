//! Holes under tool-tip control: single moves of the tip along the tool.
//!
//! The rotary axes stand while a hole is made, so its moves are said anew as those of the
//! machine's axes, whose Z goes along the tool where tables turn the part. A tip that is
//! on the hole's line to its last digits is said exactly, at one of the heights the hole
//! asks for when it can be that.

use nalgebra::{Point3, Vector3};

use super::ahead::Steps;
use super::hole::{Levels, heights};
use super::walk::{STILL, Walk};
use super::wanted::Hole;
use crate::motion::{Event, Move, Position};

/// The machine's Z and a tool this far apart are parallel.
const PARALLEL: f64 = 1e-6;

/// Motions to and from a hole, at most.
const MOST: usize = 12;

/// What binary fractions may add, mm.
const DUST: f64 = 1e-7;

/// The line of a hole.
struct Line {
    start: Point3<f64>,
    axis: Vector3<f64>,
    /// What the last digits of the tip leave open, mm.
    slack: [f64; 3],
}

/// What stood there before the moves of a hole were said anew.
pub(super) struct Kept {
    /// Index of the first event.
    first: usize,
    events: Vec<Event>,
    slack: [f64; 3],
}

impl Line {
    /// From where to where a tip can be above the start; `None` when it is beside the line.
    fn heights(&self, tip: [f64; 3]) -> Option<[f64; 2]> {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for n in 0..3 {
            let (off, slope, slack) = (tip[n] - self.start[n], self.axis[n], self.slack[n]);
            if slope.abs() < STILL {
                if off.abs() > slack {
                    return None;
                }
                continue;
            }
            let ends = [(off - slack) / slope, (off + slack) / slope];
            low = low.max(ends[0].min(ends[1]));
            high = high.min(ends[0].max(ends[1]));
        }
        (low <= high).then_some([low, high])
    }
}

impl<C: Steps> Walk<'_, C> {
    /// A motion over a hole in positions of the machine's axes, with the rotary axes
    /// where the tool exactly lies along the hole.
    pub(super) fn in_axes(&self, found: &Move, hole: &Hole) -> Move {
        if !found.to.tip_control {
            return *found;
        }
        let rotary = self.gap(&found.to, &hole.start).rotary;
        let to = self.settings.forward.restated(&Position { rotary, ..found.to }, false);
        Move { to, ..*found }
    }

    /// A motion ends over a hole, or in it.
    pub(super) fn ends_over(&self, found: &Move, hole: &Hole, over: [f64; 3]) -> bool {
        if found.to.tip_control {
            return self.line_of(hole).heights(found.to.linear).is_some();
        }
        (0..2).all(|n| (found.to.linear[n] - over[n]).abs() <= self.slack.linear[n])
    }

    fn line_of(&self, hole: &Hole) -> Line {
        Line { start: hole.start.tip, axis: hole.start.axis, slack: self.slack.linear }
    }

    /// Says the next motions under tool-tip control in axes, until [`Walk::say_again`].
    pub(super) fn say_in_axes(&mut self, hole: &Hole, levels: Levels) -> Option<Kept> {
        let heights = heights(hole, levels);
        let first = self.next;
        let (mut events, mut said) = (Vec::new(), Vec::new());
        for event in self.nc[first..].iter().take(MOST + 4 * heights.len()) {
            said.push(match event {
                Event::Move(found) if found.to.tip_control => {
                    Event::Move(self.said(found, hole, levels, &heights))
                }
                Event::Dwell { .. } => *event,
                _ => break,
            });
            events.push(*event);
        }
        let Some(Event::Move(next)) = events.first() else { return None };
        self.at = self.said(&Move { to: self.at, ..*next }, hole, levels, &heights).to;
        self.nc.to_mut()[first..first + said.len()].copy_from_slice(&said);
        let slack = std::mem::replace(&mut self.slack.linear, [DUST; 3]);
        Some(Kept { first, events, slack })
    }

    fn said(&self, found: &Move, hole: &Hole, levels: Levels, heights: &[f64]) -> Move {
        let mut said = self.in_axes(found, hole);
        let up = self.settings.forward.frame(said.to.rotary).turn.column(2).into_owned();
        if !found.to.tip_control || (up - hole.start.axis).norm() > PARALLEL {
            return said;
        }
        let line = self.line_of(hole);
        let Some([low, high]) = line.heights(found.to.linear) else { return said };
        let within = |height: f64, by: f64| (low - by..=high + by).contains(&height);
        let exact = heights.iter().copied().find(|height| within(*height, DUST));
        // Where the cycle began is known to the last digits only.
        let before = self.initial.map(|initial| initial - levels.at[2]);
        let before = before.filter(|height| within(*height, line.slack.iter().sum()));
        let height = exact.or(before).unwrap_or(0.5 * (low + high));
        said.to.linear = [levels.at[0], levels.at[1], levels.at[2] + height];
        said
    }

    /// Says the motions again as they stand in the program.
    pub(super) fn say_again(&mut self, kept: Option<Kept>) {
        let Some(kept) = kept else { return };
        self.slack.linear = kept.slack;
        let end = kept.first + kept.events.len();
        self.nc.to_mut()[kept.first..end].copy_from_slice(&kept.events);
        let mut taken = kept.events[..self.next.min(end) - kept.first].iter().rev();
        let last = taken.find_map(|event| match event {
            Event::Move(found) => Some(found.to),
            _ => None,
        });
        self.at = last.unwrap_or(self.at);
    }
}
