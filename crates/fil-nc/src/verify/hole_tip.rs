//! Holes under tool-tip control: single moves of the tip along the tool.
//!
//! The rotary axes stand while a hole is made, so its moves are said anew as those of the
//! machine's axes, whose Z goes along the tool where tables turn the part. A tip that is
//! on the hole's line to its last digits is said exactly, at one of the heights the hole
//! asks for when it can be that.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::ahead::Steps;
use super::expected_step::Hole;
use super::hole::Levels;
use super::report::FindingKind;
use super::verifier::{STILL, Verifier};
use crate::forward::Frame;
use crate::motion::{Course, Event, Move, Position};

/// The machine's Z and a tool this far apart are parallel.
const PARALLEL: f64 = 1e-6;

/// The same of a live tool of a mill-turn machine, radians.
const LIVE_PARALLEL: f64 = 1e-4;

/// Motions to and from a hole, at most.
pub(super) const MOST: usize = 12;

/// What binary fractions may add, mm.
pub(super) const DUST: f64 = 1e-7;

/// The line of a hole.
struct Line {
    start: Point3<f64>,
    axis: Vector3<f64>,
    /// From the part to the directions whose digits are on the tape: those of the machine,
    /// where no tool-tip control says them in the part.
    turn: Matrix3<f64>,
    /// What the last digits of the tip leave open, mm.
    slack: [f64; 3],
    /// Heights above the start that the hole asks for, mm.
    heights: Vec<f64>,
    /// Heights behind the hole before and before the cycle, to the last digits, mm: a tool that
    /// goes across stays on one of them.
    before: [f64; 2],
}

/// From the directions of a hole, in which its moves are said, to the tape.
#[derive(Clone, Copy)]
pub(super) struct FromHole {
    /// Turns directions into those of the axes.
    pub(super) turn: Matrix3<f64>,
    /// What the last digits of the tape leave open, mm.
    pub(super) slack: [f64; 3],
}

/// What stood there before the moves of a hole were said anew.
pub(super) struct Kept {
    /// Index of the first event.
    first: usize,
    events: Vec<Event>,
    slack: [f64; 3],
    known: [bool; 5],
}

impl Kept {
    pub(super) fn new(
        first: usize,
        events: Vec<Event>,
        (slack, known): ([f64; 3], [bool; 5]),
    ) -> Self {
        Kept { first, events, slack, known }
    }
}

/// The largest step between two heights asked for that the last digits can't tell from each
/// other, such as a last peck and the bottom, mm.
pub(super) fn doubt(heights: &[f64], digits: f64) -> f64 {
    let mut heights = heights.to_vec();
    heights.sort_unstable_by(f64::total_cmp);
    let steps = heights.windows(2).map(|pair| pair[1] - pair[0]);
    steps.filter(|step| *step <= 2.0 * (digits + DUST)).fold(0.0, f64::max)
}

impl Line {
    /// The height of a tip above the start, one of those asked for when it can be that;
    /// `None` beside the line.
    fn height(&self, tip: [f64; 3]) -> Option<f64> {
        let [low, high] = self.range(tip)?;
        let within = |height: f64, by: f64| (low - by..=high + by).contains(&height);
        let middle = 0.5 * (low + high);
        let off = |height: &f64| (height - middle).abs();
        let asked = self.heights.iter().copied().filter(|height| within(*height, DUST));
        let nearest = asked.min_by(|a, b| off(a).total_cmp(&off(b)));
        let before = || self.before.into_iter().find(|height| within(*height, self.digits()));
        Some(nearest.or_else(before).unwrap_or(middle))
    }

    /// What the last digits leave open along the line, mm.
    fn digits(&self) -> f64 {
        let axis = self.turn * self.axis;
        (0..3).map(|n| axis[n].abs() * self.slack[n]).sum()
    }

    /// The height asked for that a tip beside the line is at, to its last digits.
    fn level(&self, tip: [f64; 3]) -> Option<f64> {
        if self.range(tip).is_some() {
            return None;
        }
        let height = (Point3::from(tip) - self.start).dot(&self.axis);
        let digits = self.digits();
        self.heights.iter().copied().find(|asked| (asked - height).abs() <= digits + DUST)
    }

    /// From where to where a tip can be above the start; `None` when it is beside the line.
    fn range(&self, tip: [f64; 3]) -> Option<[f64; 2]> {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let off = self.turn * (Point3::from(tip) - self.start);
        let axis = self.turn * self.axis;
        for n in 0..3 {
            let (off, slope, slack) = (off[n], axis[n], self.slack[n]);
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

impl FromHole {
    /// What the last digits of the tape leave open in the directions of the hole, mm.
    pub(super) fn digits(&self) -> [f64; 3] {
        [0, 1, 2].map(|n| (0..3).map(|axis| self.turn[(axis, n)].abs() * self.slack[axis]).sum())
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// A motion over a hole in positions of the machine's axes, with the rotary axes
    /// where the tool exactly lies along the hole.
    pub(super) fn in_axes(&self, found: &Move, hole: &Hole) -> Move {
        if !self.is_said_anew(found, hole) {
            return *found;
        }
        let rotary = self.gap(&found.to, &hole.start).rotary;
        let linear = self.hole_frame(rotary, hole).linear(self.tip_over(found, hole));
        Move { to: Position { linear, rotary, ..Position::default() }, ..*found }
    }

    /// The tip of a motion over a hole, with the tool exactly along it.
    fn tip_over(&self, found: &Move, hole: &Hole) -> Point3<f64> {
        let rotary = self.gap(&found.to, &hole.start).rotary;
        self.settings.forward.pose(&Position { rotary, ..found.to }).tip
    }

    /// Motions over a hole are said in its own directions: under tool-tip control, and
    /// where a head turns the tool away from the machine's Z.
    fn is_said_anew(&self, found: &Move, hole: &Hole) -> bool {
        if found.to.tip_control {
            return true;
        }
        let in_frame = found.to.tilt.is_some();
        if in_frame || found.course == Course::Machine {
            return false;
        }
        let rotary = self.gap(&found.to, &hole.start).rotary;
        let up = self.settings.forward.frame(rotary).turn.column(2).into_owned();
        if self.settings.is_mill_turn() {
            // A live tool square to Z; C is rounded on the tape.
            let tool = self.settings.forward.with_tool_for(hole.start.axis);
            let along = (tool.axis(rotary) - hole.start.axis).norm() < LIVE_PARALLEL;
            return along && (up - hole.start.axis).norm() > LIVE_PARALLEL;
        }
        let along = (self.settings.forward.axis(rotary) - hole.start.axis).norm() < PARALLEL;
        along && (up - hole.start.axis).norm() > PARALLEL
    }

    /// Takes a way up along the tool before it turns to a hole of another direction.
    pub(super) fn goes_up_before_turning(&mut self, cl_line: u32, hole: &Hole) {
        let (Some(found), Some(plunge)) = (self.next_move(), self.plunge(self.next)) else {
            return;
        };
        let forward = &self.settings.forward;
        let stands = forward.pose(&self.at);
        let way = forward.pose(&found.to).tip - stands.tip;
        let along = way.dot(&stands.axis);
        let in_tip = [found.to, self.at].map(|at| at.tip_control);
        let in_axes = in_tip == [false; 2] && self.is_said_anew(&plunge, hole);
        let goes_up = found.course == Course::Rapid
            && !found.in_cycle
            && (in_tip == [true; 2] || in_axes)
            && found.to.rotary == self.at.rotary
            && self.gap(&self.at, &hole.start).turned.is_some()
            && along > 0.0
            && (way - stands.axis * along).norm() <= 2.0 * self.tip_slack(&found.to);
        if goes_up {
            // X, Y and Z stay when the machine turns to the hole, the tip under tool-tip control.
            let rotary = if in_axes { self.rotary_over(&plunge, hole) } else { found.to.rotary };
            let to = Position { rotary, ..found.to };
            let level = self.check_way_up(cl_line, hole, &Move { to, ..found });
            if in_axes {
                // A cycle that begins there comes back to it.
                let start = self.hole_frame(rotary, hole).linear(hole.start.tip)[2];
                let level = self.slack.before_scale(2, start + level);
                self.memory.initial = self.memory.initial.map(|initial| initial.max(level));
            }
            self.take(cl_line, &found);
            self.next += 1;
        }
    }

    /// The way up ends on the level over the hole to which the tool then goes across; gives its
    /// height over the hole.
    fn check_way_up(&mut self, cl_line: u32, hole: &Hole, found: &Move) -> f64 {
        let tip = self.settings.forward.pose(&found.to).tip;
        let height = (tip - hole.start.tip).dot(&hole.start.axis);
        let clear = hole.clear.unwrap_or_else(|| self.settings.cycle_clearance(self.limits.metric));
        let level = match hole.retract {
            None => clear,
            Some(above) if above > 0.0 => above.max(clear),
            // The level before the cycle is that of another direction.
            Some(_) => return clear,
        };
        if (height - level).abs() > 2.0 * self.tip_slack(&found.to) {
            let message = self.spell_level("the plane over the hole", height, level);
            self.find(FindingKind::Cycle, Some(cl_line), Some(found.line), message);
        }
        level
    }

    /// The machine's directions, turned so that Z goes along the hole.
    pub(super) fn hole_frame(&self, rotary: [f64; 2], hole: &Hole) -> Frame {
        self.frame_along(rotary, hole.start.axis)
    }

    /// Where the tip stands along the tool, in the machine's directions turned so that Z does.
    fn height_along_tool(&self, at: &Position) -> f64 {
        let pose = self.settings.forward.pose(at);
        self.frame_along(at.rotary, pose.axis).linear(pose.tip)[2]
    }

    /// The tool lies along another direction than Z of the axes, in which no frame says it.
    pub(super) fn leans_from_z(&self) -> bool {
        if self.at.tilt.is_some() || self.settings.is_mill_turn() {
            return false;
        }
        let forward = &self.settings.forward;
        let up = forward.frame(self.at.rotary).turn.column(2).into_owned();
        (up - forward.pose(&self.at).axis).norm() > PARALLEL
    }

    /// The tool goes back along itself to the level before a cycle that has ended; true where it
    /// does, or stands there.
    pub(super) fn returns_along_tool(&mut self, cl_line: u32, level: f64) -> bool {
        let is_there = |walk: &Self, at: &Position| {
            walk.height_along_tool(at) >= level - 2.0 * walk.tip_slack(at)
        };
        if is_there(self, &self.at) {
            return true;
        }
        let Some(found) = self.next_move() else { return false };
        let forward = &self.settings.forward;
        let stands = forward.pose(&self.at);
        let way = forward.pose(&found.to).tip - stands.tip;
        let beside = (way - stands.axis * way.dot(&stands.axis)).norm();
        let slack = 2.0 * self.tip_slack(&found.to);
        let goes_back = found.course == Course::Rapid
            && found.to.tip_control == self.at.tip_control
            && found.to.rotary == self.at.rotary
            && beside <= slack
            && (self.height_along_tool(&found.to) - level).abs() <= slack;
        if goes_back {
            self.take(cl_line, &found);
            self.next += 1;
        }
        goes_back
    }

    fn frame_along(&self, rotary: [f64; 2], axis: Vector3<f64>) -> Frame {
        let frame = self.settings.forward.frame(rotary);
        let up = frame.turn.column(2).into_owned();
        if (up - axis).norm() <= PARALLEL {
            return frame;
        }
        let turn = Rotation3::rotation_between(&up, &axis)
            .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), PI));
        Frame { turn: turn.matrix() * frame.turn, ..frame }
    }

    /// A motion ends over a hole, or in it.
    pub(super) fn ends_over(&self, found: &Move, hole: &Hole, over: [f64; 3]) -> bool {
        // Behind another work offset, or polar interpolation, nobody knows where the axes stand
        // before their next words.
        if !self.is_known(&found.known) {
            return false;
        }
        if self.is_said_anew(found, hole) {
            return self
                .line_of(hole, found)
                .range(self.tip_over(found, hole).coords.into())
                .is_some();
        }
        (0..2).all(|n| (found.to.linear[n] - over[n]).abs() <= self.slack.linear[n])
    }

    fn line_of(&self, hole: &Hole, found: &Move) -> Line {
        let mut slack = self.slack.linear;
        let mut turn = Matrix3::identity();
        if self.settings.is_mill_turn() {
            // X of a hole at any C, which is rounded on the tape.
            let most = slack.into_iter().fold(0.0, f64::max);
            let reach = libm::hypot(hole.start.tip.x, hole.start.tip.y);
            slack = [most + self.slack.rotary[0].to_radians() * reach; 3];
        } else if !found.to.tip_control {
            let rotary = self.gap(&found.to, &hole.start).rotary;
            turn = self.settings.forward.frame(rotary).turn.transpose();
        }
        Line {
            start: hole.start.tip,
            axis: hole.start.axis,
            slack,
            turn,
            heights: Vec::new(),
            before: [f64::NAN; 2],
        }
    }

    /// Says the next motions under tool-tip control in axes, until [`Verifier::say_again`].
    pub(super) fn say_in_axes(&mut self, hole: &Hole, levels: Levels) -> Option<Kept> {
        if self.settings.is_mill_turn() {
            let plunge = self.plunge(self.next).filter(|to| self.is_said_anew(to, hole))?;
            return Some(self.say_live(hole, levels, &plunge));
        }
        let next = self.next_move().filter(|next| self.is_said_anew(next, hole))?;
        let mut line = self.line_of(hole, &next);
        line.heights = self.heights(hole, levels, self.plunges_in_cycle());
        let stands = Move { to: self.at, ..next };
        let stood = self.at;
        let turns = self.gap(&self.at, &hole.start).turned.is_some();
        let mut tip = self.tip_over(&stands, hole);
        self.at = self.said(&stands, hole, levels, &line).to;
        if turns {
            // The tool stands in the direction of another hole, and turns on the way to this one:
            // its tip stays under tool-tip control, else X, Y and Z do.
            let rotary = self.gap(&next.to, &hole.start).rotary;
            let turned = if stood.tip_control { stood } else { Position { rotary, ..stood } };
            tip = self.settings.forward.pose(&turned).tip;
            self.at.linear = self.hole_frame(rotary, hole).linear(tip);
        }
        let known = self.known[..3].iter().all(|known| *known);
        if let Some(height) = line.level(tip.coords.into()).filter(|_| known) {
            self.at.linear[2] = levels.at[2] + height;
        }
        // The way up to the level comes before the way across: along the tool where it stands.
        let twice = line.slack.map(|digit| 2.0 * digit);
        let here = Line { start: tip, slack: twice, heights: Vec::new(), ..line };
        let rests = self.at.linear[2];
        // Without RETURN the tool goes across where the hole before has left it.
        let initial = self.memory.initial.filter(|_| hole.retract.is_some()).unwrap_or(rests);
        let is_rounded = known && (rests - initial).abs() <= line.digits() + DUST;
        let rests = if is_rounded { initial } else { rests };
        self.at.linear[2] = rests;
        let mut before = [rests, initial];
        if hole.retract == Some(0.0) {
            before.reverse();
        }
        line.before = before.map(|level| level - levels.at[2]);
        let rotary = self.gap(&next.to, &hole.start).rotary;
        let machine = self.settings.forward.frame(rotary);
        let from_hole = machine.turn.transpose() * self.hole_frame(rotary, hole).turn;
        self.memory.from_hole = Some(FromHole { turn: from_hole, slack: self.slack.linear });
        let first = self.next;
        let (mut events, mut said) = (Vec::new(), Vec::new());
        for event in self.nc.from(first).take(MOST + 4 * line.heights.len()) {
            said.push(match &event {
                Event::Move(found) if self.is_said_anew(found, hole) && found.arc.is_none() => {
                    let mut said = self.said(found, hole, levels, &line);
                    if known {
                        self.lifted(&mut said, self.tip_over(found, hole), &here, (&line, levels));
                    }
                    Event::Move(said)
                }
                Event::Dwell { .. } => event,
                _ => break,
            });
            events.push(event);
        }
        self.nc.replace(first, &said);
        let along = DUST + doubt(&line.heights, line.digits());
        let slack = std::mem::replace(&mut self.slack.linear, [DUST, DUST, along]);
        Some(Kept::new(first, events, (slack, self.known)))
    }

    /// Says a motion straight up from where the tool stands exactly: its last digits lean, and
    /// the level is one of those that the hole asks for.
    fn lifted(
        &self,
        said: &mut Move,
        tip: Point3<f64>,
        here: &Line,
        (line, levels): (&Line, Levels),
    ) {
        let tip = tip.coords.into();
        if line.range(tip).is_some() || here.range(tip).is_none() {
            return;
        }
        said.to.linear[..2].copy_from_slice(&self.at.linear[..2]);
        if let Some(height) = line.level(tip) {
            said.to.linear[2] = levels.at[2] + height;
        }
    }

    fn said(&self, found: &Move, hole: &Hole, levels: Levels, line: &Line) -> Move {
        let mut said = self.in_axes(found, hole);
        if !self.is_said_anew(found, hole) {
            return said;
        }
        if let Some(height) = line.height(self.tip_over(found, hole).coords.into()) {
            said.to.linear = [levels.at[0], levels.at[1], levels.at[2] + height];
        }
        said
    }

    /// Says the motions again as they stand in the program.
    pub(super) fn say_again(&mut self, kept: Option<Kept>) {
        let Some(kept) = kept else { return };
        self.memory.from_hole = None;
        self.slack.linear = kept.slack;
        let end = kept.first + kept.events.len();
        self.nc.replace(kept.first, &kept.events);
        let mut taken = kept.events[..self.next.min(end) - kept.first].iter().rev();
        let last = taken.find_map(|event| match event {
            Event::Move(found) => Some((found.to, found.known)),
            _ => None,
        });
        (self.at, self.known) = last.unwrap_or((self.at, kept.known));
    }
}
