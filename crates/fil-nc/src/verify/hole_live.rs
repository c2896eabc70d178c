//! Holes of a live tool square to the axis of the spindle: X goes along the hole, Z and C go to it.
//!
//! Their motions are said anew as those of a hole along Z: the first axis is Z of the machine, the
//! second Y of the machine and a millimetre for each radian that C stands beside the hole, the
//! third X.

use nalgebra::Vector3;

use super::ahead::Steps;
use super::expected_step::Hole;
use super::gap::REACHED;
use super::hole::Levels;
use super::hole_tip::{DUST, FromHole, Kept, MOST, doubt};
use super::verifier::Verifier;
use crate::motion::{Course, Event, Move, Position};

/// Which axes are known, in the order in which they are said for a hole.
fn along_hole([x, y, z, primary, secondary]: [bool; 5]) -> [bool; 5] {
    [z, y, x, primary, secondary]
}

/// The hole as the axes of the machine stand over it.
struct Live {
    /// Tip of the start of the hole in the machine's X, Y and Z, mm.
    start: [f64; 3],
    axis: Vector3<f64>,
    /// Where C stands exactly, degrees.
    rotary: [f64; 2],
    /// Heights above the start that the hole asks for, and the one before the cycle, mm.
    heights: Vec<f64>,
    before: f64,
    /// Way of Z in what is said for a way of Z of the machine, 1 or -1.
    sign: f64,
    /// Distance of the start from the axis of the spindle, mm.
    reach: f64,
}

impl<C: Steps> Verifier<'_, C> {
    /// Says the next motions as those of a hole along Z, until [`Verifier::say_again`]; `plunge` is
    /// the one that drills.
    pub(super) fn say_live(&mut self, hole: &Hole, levels: Levels, plunge: &Move) -> Kept {
        let live = self.live_hole(hole, levels, plunge);
        let frame = self.settings.forward.frame(live.rotary);
        let turn = frame.turn.transpose() * self.hole_frame(live.rotary, hole).turn;
        self.memory.from_hole = Some(FromHole { turn, slack: self.slack.linear });
        self.at = self.said_live(&self.at, &live, levels);
        let first = self.next;
        let (mut events, mut said) = (Vec::new(), Vec::new());
        for event in self.nc.from(first).take(MOST + 4 * live.heights.len()) {
            said.push(match &event {
                Event::Move(found) if found.course != Course::Machine && found.arc.is_none() => {
                    let to = self.said_live(&found.to, &live, levels);
                    Event::Move(Move { to, known: along_hole(found.known), ..*found })
                }
                Event::Dwell { .. } => event,
                _ => break,
            });
            events.push(event);
        }
        self.nc.replace(first, &said);
        let along = DUST + doubt(&live.heights, self.slack.linear[0]);
        let slack = std::mem::replace(&mut self.slack.linear, [DUST, DUST, along]);
        let known = self.known;
        self.known = along_hole(known);
        Kept::new(first, events, (slack, known))
    }

    fn live_hole(&self, hole: &Hole, levels: Levels, plunge: &Move) -> Live {
        let rotary = self.gap(&plunge.to, &hole.start).rotary;
        let start = self.settings.forward.frame(rotary).linear(hole.start.tip);
        let up = self.hole_frame(rotary, hole).turn.column(0).z;
        let live = Live {
            start,
            axis: hole.start.axis,
            rotary,
            heights: self.heights(hole, levels, self.plunges_in_cycle()),
            before: f64::NAN,
            sign: up.signum(),
            reach: libm::hypot(hole.start.tip.x, hole.start.tip.y),
        };
        let before = self.memory.initial.map(|level| level - levels.at[2]);
        Live { before: before.unwrap_or(self.at.linear[0] - start[0]), ..live }
    }

    /// A position said for the hole, exactly where the last digits can mean that.
    fn said_live(&self, at: &Position, live: &Live, levels: Levels) -> Position {
        let slack = &self.slack;
        let tool = self.settings.forward.with_tool_for(live.axis).axis(at.rotary);
        let turned = libm::atan2(live.axis.cross(&tool).z, live.axis.dot(&tool));
        let [height, beside, along] = [0, 1, 2].map(|n| at.linear[n] - live.start[n]);
        let half_digit = slack.rotary[0].to_radians();
        let is_turned = turned.abs() > half_digit + REACHED;
        // Without Y the tool stands beside the hole by what C is rounded by.
        let of_c = if self.limits.written[1] { 0.0 } else { half_digit * live.reach };
        let is_beside = is_turned || beside.abs() > slack.linear[1] + of_c + DUST;
        let is_along = along.abs() > slack.linear[2] + DUST;
        let near = |asked: &&f64| (**asked - height).abs() <= slack.linear[0] + DUST;
        let off = |asked: &f64| (*asked - height).abs();
        let asked = live.heights.iter().filter(near).min_by(|a, b| off(a).total_cmp(&off(b)));
        let height = asked.or(Some(&live.before).filter(near)).unwrap_or(&height);
        let linear = [
            levels.at[0] + if is_along { along * live.sign } else { 0.0 },
            levels.at[1] + if is_beside { beside + turned } else { 0.0 },
            levels.at[2] + height,
        ];
        let rotary = if is_turned { at.rotary } else { live.rotary };
        Position { linear, rotary, ..*at }
    }
}
