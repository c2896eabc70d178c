//! Points at which a post divides a line that turns the machine.
//!
//! The CL file says where a line begins and ends. Between, tip and tool go in step: at a share of
//! the line the machine has made that share of its turn, or the tool that share of its angle, or
//! of the line between the tips of both directions. A post may divide where it likes and in
//! each of these ways, in one of them along a whole line. So the turn that the tape has at
//! a point says where on the line the tip is.

use nalgebra::{Point3, Vector3};

use super::settings::Tolerances;
use crate::forward::{Forward, Pose};
use crate::motion::Position;

/// How the machine turns along a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turning {
    /// Each rotary axis evenly.
    Axes,
    /// The tool evenly in the plane of its directions.
    Tool,
    /// The tip of its direction evenly along a straight line.
    Chord,
}

impl Turning {
    pub(super) const ALL: [Turning; 3] = [Turning::Axes, Turning::Tool, Turning::Chord];
}

/// An end of a line that turns the machine.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub(super) pose: Pose,
    /// Positions of the rotary axes, degrees.
    pub(super) rotary: [f64; 2],
    /// How far from that the post may have seen it: the tip, mm.
    pub(super) rough: f64,
    /// The same of the rotary axes, degrees.
    pub(super) rough_turn: [f64; 2],
}

impl End {
    /// The same with the machine turned as the tape has it, which a post may count from.
    pub(super) fn on_tape(self, forward: &Forward, at: &Position) -> End {
        let pose = Pose { axis: forward.axis(at.rotary), ..self.pose };
        End { pose, rotary: at.rotary, rough: self.rough, rough_turn: [0.0; 2] }
    }
}

/// A line of the CL file, as a program divides it.
pub(super) struct Division<'a> {
    pub(super) forward: &'a Forward,
    pub(super) ends: [End; 2],
}

/// What last digits do where the tool lies along an axis, whose position then is any.
struct Pole {
    /// To X, Y and Z, mm.
    linear: [f64; 3],
    /// To the tool, from a share of the line to one a step beside it, as the distance of the tips
    /// of directions.
    tool: f64,
}

/// Step of a share by which slopes are found.
const STEP: f64 = 1e-3;

/// Times that a share is looked for.
const ROUNDS: u32 = 4;

/// A tool that leans out of an axis by less, in last digits of both, lies along it.
const POLE: f64 = 3.0;

/// A direction this near to the one asked for, as the distance of the tips, is reached.
const REACHED: f64 = 1e-9;

/// What counting may add to a last digit, mm or degrees.
const COUNTED: f64 = 1e-7;

impl Division<'_> {
    /// The shares of the line at which the tape may have a position; `None` when its tip is
    /// elsewhere than its turn says.
    pub(super) fn shares(
        &self,
        turning: Turning,
        at: &Position,
        slack: &Tolerances,
    ) -> Option<[f64; 2]> {
        self.shares_by(turning, at, slack, None).or_else(|| {
            let at_pole = turning != Turning::Axes && self.is_at_pole(at.rotary, slack);
            let pole = at_pole.then(|| self.digits_at_pole(at, slack))?;
            self.shares_by(turning, at, slack, Some(&pole))
        })
    }

    /// The same where the turn of the tool says that of the axes, or at a pole.
    fn shares_by(
        &self,
        turning: Turning,
        at: &Position,
        slack: &Tolerances,
        pole: Option<&Pole>,
    ) -> Option<[f64; 2]> {
        let mut share = self.first_guess(turning, at, slack);
        let mut range = [0.0, 1.0];
        for _ in 0..ROUNDS {
            range = self.shares_near(turning, at, (slack, pole), share)?;
            share = (0.5 * (range[0] + range[1])).clamp(0.0, 1.0);
        }
        (range[0] <= range[1]).then_some(range)
    }

    /// The same, by slopes at a share; the first is more than the second where there is none.
    /// `None` where the tool can't turn so.
    fn shares_near(
        &self,
        turning: Turning,
        at: &Position,
        (slack, pole): (&Tolerances, Option<&Pole>),
        share: f64,
    ) -> Option<[f64; 2]> {
        let shares = [share, share - STEP, share + STEP];
        let [here, behind, ahead] = shares.map(|share| self.place(turning, at, share, pole));
        let (here, behind, ahead) = (here?, behind?, ahead?);
        let [from, to] = &self.ends;
        let (of_from, of_to) = ((1.0 - share).clamp(0.0, 1.0), share.clamp(0.0, 1.0));
        let rough = from.rough * of_from + to.rough * of_to;
        let (mut low, mut high, mut stays_beside) = (0.0_f64, 1.0_f64, false);
        for n in 0..5 {
            let (stands, allowed) = match n {
                0..3 => {
                    let before_scale = slack.rounded[n].map_or(0.0, |digit| 0.5 * digit);
                    let of_turn = pole.map_or(0.0, |pole| pole.linear[n]);
                    (at.linear[n], slack.linear[n] + before_scale + rough + of_turn)
                }
                _ => {
                    let [a, b] = [from, to].map(|end| end.rough_turn[n - 3]);
                    (at.rotary[n - 3], slack.rotary[n - 3] + a * of_from + b * of_to)
                }
            };
            let (off, allowed) = (stands - here[n], allowed + COUNTED);
            let slope = (ahead[n] - behind[n]) / (2.0 * STEP);
            if slope.abs() < COUNTED {
                stays_beside |= off.abs() > allowed;
                continue;
            }
            let [a, b] = [off - allowed, off + allowed].map(|off| share + off / slope);
            (low, high) = (low.max(a.min(b)), high.min(a.max(b)));
        }
        // The empty range keeps its middle, from which it is looked for on.
        let middle = 0.5 * (low + high);
        Some(if stays_beside { [middle + STEP, middle - STEP] } else { [low, high] })
    }

    /// A share to begin with: of the turn or of the way, whichever the last digits say better.
    fn first_guess(&self, turning: Turning, at: &Position, slack: &Tolerances) -> f64 {
        let [from, to] = &self.ends;
        let way = to.pose.tip - from.pose.tip;
        let tip = self.forward.pose(at).tip;
        let digits = slack.linear.iter().copied().fold(0.0, f64::max);
        let of_way = (way.dot(&(tip - from.pose.tip)) / way.norm_squared(), digits / way.norm());
        let of_axis = |n: usize| {
            let turn = to.rotary[n] - from.rotary[n];
            ((at.rotary[n] - from.rotary[n]) / turn, slack.rotary[n] / turn.abs())
        };
        let whole = from.pose.axis.angle(&to.pose.axis);
        let turned = from.pose.axis.angle(&self.forward.axis(at.rotary));
        let of_tool = (turned / whole, slack.rotary[0].to_radians() / whole);
        let of_turn = match turning {
            Turning::Axes => [of_axis(0), of_axis(1)],
            Turning::Tool | Turning::Chord => [of_tool; 2],
        };
        let guesses = [of_way, of_turn[0], of_turn[1]].into_iter();
        let guesses = guesses.filter(|(share, digits)| share.is_finite() && digits.is_finite());
        guesses.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0.5, |(share, _)| share.clamp(0.0, 1.0))
    }

    /// The tool lies along an axis that turns it so little that any position of it will do.
    fn is_at_pole(&self, at: [f64; 2], slack: &Tolerances) -> bool {
        let least = POLE * (slack.rotary[0] + slack.rotary[1]).to_radians();
        let turned = |n: usize| {
            let mut by_a_degree = at;
            by_a_degree[n] += 1.0;
            (self.forward.axis(by_a_degree) - self.forward.axis(at)).norm() / 1.0_f64.to_radians()
        };
        (0..2).any(|n| self.forward.rotaries()[n].is_some() && turned(n) < least)
    }

    /// What the last digits of the rotary axes do there.
    fn digits_at_pole(&self, at: &Position, slack: &Tolerances) -> Pole {
        let [from, to] = &self.ends;
        let tip = self.forward.pose(at).tip;
        let mut linear = [0.0; 3];
        for index in 0..2 {
            let mut turned = *at;
            turned.rotary[index] += slack.rotary[index];
            let stands = self.forward.frame_of(&turned).linear(tip);
            for (n, moved) in linear.iter_mut().enumerate() {
                *moved += (stands[n] - at.linear[n]).abs();
            }
        }
        let digits = (slack.rotary[0] + slack.rotary[1]).to_radians();
        Pole { linear, tool: digits + STEP * from.pose.axis.angle(&to.pose.axis) }
    }

    /// Where the axes stand at a share of the line, near a position.
    fn place(
        &self,
        turning: Turning,
        near: &Position,
        share: f64,
        pole: Option<&Pole>,
    ) -> Option<[f64; 5]> {
        let [from, to] = &self.ends;
        let (one, other) = (from.pose.axis, to.pose.axis);
        let rotary = match turning {
            Turning::Axes => {
                [0, 1].map(|n| from.rotary[n] + (to.rotary[n] - from.rotary[n]) * share)
            }
            Turning::Tool => self.turned_to(slerp(one, other, share)?, near.rotary, pole)?,
            Turning::Chord => {
                let chord = (one + (other - one) * share).try_normalize(REACHED)?;
                self.turned_to(chord, near.rotary, pole)?
            }
        };
        let tip: Point3<f64> = from.pose.tip + (to.pose.tip - from.pose.tip) * share;
        let [x, y, z] = self.forward.frame_of(&Position { rotary, ..*near }).linear(tip);
        Some([x, y, z, rotary[0], rotary[1]])
    }

    /// The rotary axes with the tool along a direction.
    fn turned_to(
        &self,
        axis: Vector3<f64>,
        near: [f64; 2],
        pole: Option<&Pole>,
    ) -> Option<[f64; 2]> {
        if let Some(pole) = pole {
            return ((self.forward.axis(near) - axis).norm() <= pole.tool).then_some(near);
        }
        let rotary = self.forward.refine(near, axis);
        ((self.forward.axis(rotary) - axis).norm() < REACHED).then_some(rotary)
    }

    /// Tip and tool at a share of the line, with each axis turned evenly.
    pub(super) fn pose(&self, share: f64) -> Pose {
        let [from, to] = &self.ends;
        let tip = from.pose.tip + (to.pose.tip - from.pose.tip) * share;
        let rotary = [0, 1].map(|n| from.rotary[n] + (to.rotary[n] - from.rotary[n]) * share);
        Pose { tip, axis: self.forward.axis(rotary) }
    }

    /// How far the tip is from where the turn of the tape has it, mm.
    pub(super) fn off(&self, at: &Position) -> f64 {
        let [from, to] = &self.ends;
        let turn = |n: usize| to.rotary[n] - from.rotary[n];
        let most = if turn(0).abs() > turn(1).abs() { 0 } else { 1 };
        let share = if turn(most) == 0.0 {
            0.0
        } else {
            (at.rotary[most] - from.rotary[most]) / turn(most)
        };
        let tip = from.pose.tip + (to.pose.tip - from.pose.tip) * share;
        (self.forward.pose(at).tip - tip).norm()
    }
}

/// A direction on the way from one to another in their plane; `None` for opposite ones.
fn slerp(from: Vector3<f64>, to: Vector3<f64>, share: f64) -> Option<Vector3<f64>> {
    let whole = from.angle(&to);
    let across = (to - from * from.dot(&to)).try_normalize(REACHED);
    match across {
        Some(across) => {
            let angle = whole * share;
            Some(from * libm::cos(angle) + across * libm::sin(angle))
        }
        None => (from.dot(&to) > 0.0).then_some(from),
    }
}
