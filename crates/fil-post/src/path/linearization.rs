//! Feed motions in which a rotary axis turns, divided so that the tip stays on the
//! line that the CL file asks for.
//!
//! The parts end on that line, and the rotary axes go evenly from end to end. Each
//! part is looked at as the control will move it: between positions as the tape has
//! them. So rounding counts too.

use fil_diag::Result;
use fil_machine::axes::{AXES, Axis, AxisSet, Position};
use fil_machine::axis_chain::AxisChain;
use fil_machine::locations as loc;
use nalgebra::Point3;

use super::tip::{largest_distance, tip};
use super::turning_feed::TurningFeed;
use super::{mill_turn, rotary};
use crate::control::family;
use crate::control::word_address::motion::Motion;
use crate::errors::PostCode;
use crate::operation::Target;
use crate::post::Post;

/// Most parts of one motion.
const MOST_PARTS: u32 = 1_000;

/// Most lines of an arc.
const MOST_CHORDS: u32 = 20_000;

/// Parts are a little shorter than a first estimate asks for.
const MARGIN: f64 = 1.02;

/// What LINTOL has said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Straightness {
    /// LINTOL/t, in the unit of the program; `None` for that of the machine.
    pub tolerance: Option<f64>,
    /// LINTOL/OFF.
    pub off: bool,
}

/// A motion that is to be divided.
struct Turning<'a> {
    chain: &'a AxisChain,
    axes: [Axis; AXES],
    present: AxisSet,
    /// Where the axes stand, exactly, and where they go to.
    ends: [Position; 2],
    /// The line of the tip in the part frame.
    line: [Point3<f64>; 2],
}

/// How far the tip may leave its line, in the unit of the program; `None` for as far
/// as it does.
pub(super) fn tolerance(post: &Post) -> Result<Option<f64>> {
    let Straightness { tolerance, off } = post.path.straightness;
    if off {
        return Ok(None);
    }
    if tolerance.is_some() {
        return Ok(tolerance);
    }
    let mm = post.control.require_unit()?.in_mm();
    let setting = post.control.commons.dbl_opt(loc::ROTARY_TOLERANCE);
    Ok(setting.filter(|most| *most > 0.0).map(|most| most / mm))
}

/// Moves at feed to a position, while rotary axes turn from where they stood before.
///
/// # Errors
/// No feed; a tolerance that takes more parts than one motion may have; as
/// [`family::feed`].
#[cold]
pub(super) fn feed(post: &mut Post, before: [f64; 2], to: Position, target: Target) -> Result<()> {
    let from = stands(post, before);
    if post.control.tables.mills() {
        return mill_turn::turning_feed(post, from, to, target);
    }
    let word = rotary::word_of(post, target);
    let allowed = tolerance(post)?;
    let turning = Turning::new(post, from, to);
    let feed = TurningFeed::of(post)?;
    let least = feed.least_parts(turning.length())?;
    let parts = match allowed {
        Some(allowed) => turning.divided(allowed, least)?,
        None => turning.parts(least),
    };
    let tapes = parts.iter().map(|part| turning.on_tape(part)).collect::<Result<Vec<_>>>()?;
    let mut at = turning.on_tape(&from)?;
    let mut feeds = Vec::with_capacity(parts.len());
    let enough = allowed.map_or_else(|| usual(post), Ok)?;
    let mut worst: f64 = 0.0;
    let mut point = tip(turning.chain, &at);
    for tape in &tapes {
        worst = worst.max(turning.off(&at, tape, enough));
        let next = tip(turning.chain, tape);
        feeds.push(feed.between(&at, tape, (next - point).norm())?);
        (at, point) = (*tape, next);
    }
    if worst > enough {
        let ends = tapes.iter().map(|tape| turning.end_off(tape)).fold(0.0, f64::max);
        warn_of_deviation(post, allowed, ends);
    }
    if feeds.iter().any(|feed| feed.slowed) {
        feed.warn_slowed(post);
    }
    for (position, feed) in parts.into_iter().zip(feeds) {
        let motion = Motion { position, axes: AxisSet::ALL, word };
        family::feed(&mut post.control, &motion, Some(&feed.feed))?;
        let inverse = feed.after(&mut post.control);
        post.path.writes_inverse_time = inverse && !post.path.inverse_time;
    }
    Ok(())
}

/// How many even parts of a way, of which `at` gives the points, keep the tip within a
/// distance of the lines between them; `least` or more.
///
/// # Errors
/// Too many; a tool axis that the machine can't reach.
pub(super) fn count(
    post: &Post,
    least: u32,
    allowed: f64,
    at: impl Fn(f64) -> Target,
) -> Result<u32> {
    let Some(before) = post.path.rotary else { return Ok(least) };
    let start = stands(post, before);
    let mut count = least;
    while count <= MOST_CHORDS {
        if suffices(post, start, count, allowed, &at)? {
            return Ok(count);
        }
        count += count / 4 + 1;
    }
    PostCode::TooManyParts.err("an arc on which the machine turns needs too many motions")
}

/// True when so many even parts keep the tip within the distance.
///
/// # Errors
/// A tool axis that the machine can't reach.
fn suffices(
    post: &Post,
    start: Position,
    count: u32,
    allowed: f64,
    at: impl Fn(f64) -> Target,
) -> Result<bool> {
    let chain = post.control.tables.chain();
    let mut from = start;
    for number in 1..=count {
        let target = at(f64::from(number) / f64::from(count));
        let (point, axis) = rotary::transformed(post, target);
        let angles = chain.solve(axis, [from[3], from[4]])?;
        let linear = chain.linear(point, angles);
        let to = [linear.x, linear.y, linear.z, angles[0], angles[1]];
        if Turning::new(post, from, to).off(&from, &to, allowed) > allowed {
            return Ok(false);
        }
        from = to;
    }
    Ok(true)
}

/// Where the axes stand: exactly where the CL file has brought them, unless the tape
/// says that something else has moved them since.
fn stands(post: &Post, before: [f64; 2]) -> Position {
    let tables = &post.control.tables;
    let point = post.path.point.unwrap_or_default();
    let target = Target { point, axis: post.path.axis, word: 0 };
    let (point, _) = rotary::transformed(post, target);
    let linear = tables.chain().linear(point, before);
    let exact = [linear.x, linear.y, linear.z, before[0], before[1]];
    let tape: [Option<f64>; AXES] = std::array::from_fn(|n| {
        let axis = tables.axis(n);
        let written = tables.present().has(n) && !axis.is_off();
        let stands = post.control.axis_position(n).filter(|_| written)?;
        Some(axis.near(stands, exact[n]))
    });
    let moved = |n: usize| {
        tape[n].is_some_and(|tape| (tape - exact[n]).abs() > tables.axis(n).resolution())
    };
    if (0..AXES).any(moved) || post.path.point.is_none() {
        return std::array::from_fn(|n| tape[n].unwrap_or(exact[n]));
    }
    exact
}

impl<'a> Turning<'a> {
    fn new(post: &'a Post, from: Position, to: Position) -> Self {
        let tables = &post.control.tables;
        let chain = tables.chain();
        Turning {
            chain,
            axes: std::array::from_fn(|n| *tables.axis(n)),
            present: tables.present(),
            ends: [from, to],
            line: [tip(chain, &from), tip(chain, &to)],
        }
    }

    /// How far the tip goes.
    fn length(&self) -> f64 {
        (self.line[1] - self.line[0]).norm()
    }

    /// The ends of so many parts; the last is that of the motion.
    fn parts(&self, count: u32) -> Vec<Position> {
        let [from, to] = self.ends;
        let inner = (1..count).map(|number| {
            let share = f64::from(number) / f64::from(count);
            let angles = [3, 4].map(|n| from[n] + (to[n] - from[n]) * share);
            let tip = self.line[0] + (self.line[1] - self.line[0]) * share;
            let linear = self.chain.linear(tip, angles);
            [linear.x, linear.y, linear.z, angles[0], angles[1]]
        });
        inner.chain([to]).collect()
    }

    /// As few parts of one length as keep the tip on its line, and no fewer than
    /// `least`.
    ///
    /// # Errors
    /// It would take too many.
    fn divided(&self, allowed: f64, least: u32) -> Result<Vec<Position>> {
        let start = self.on_tape(&self.ends[0])?;
        let mut count = least.max(1);
        loop {
            let parts = self.parts(count);
            let Some(off) = self.beyond(start, &parts, allowed)? else { return Ok(parts) };
            let more = f64::from(count) * (off / allowed).sqrt() * MARGIN;
            count = (more.ceil() as u32).max(count + 1);
            if count > MOST_PARTS {
                return PostCode::TooManyParts.err(format!(
                    "to stay within {allowed:.4} of its line the tip needs more than {MOST_PARTS} \
                     motions"
                ));
            }
        }
    }

    /// The distance of the tip from its line in the first part in which it is too
    /// large, less what rounding of the ends alone brings.
    fn beyond(&self, start: Position, parts: &[Position], allowed: f64) -> Result<Option<f64>> {
        let mut at = start;
        for part in parts {
            let tape = self.on_tape(part)?;
            let rounding = self.end_off(&at).max(self.end_off(&tape));
            let spare = if rounding > 0.5 * allowed { rounding + 0.5 * allowed } else { allowed };
            let off = self.off(&at, &tape, spare);
            if off > spare {
                return Ok(Some(allowed * off / spare));
            }
            at = tape;
        }
        Ok(None)
    }

    /// The largest distance of the tip from its line between two positions.
    fn off(&self, from: &Position, to: &Position, enough: f64) -> f64 {
        largest_distance(self.chain, from, to, self.line, enough)
    }

    /// The distance of the tip from its line where the axes stand.
    fn end_off(&self, at: &Position) -> f64 {
        largest_distance(self.chain, at, at, self.line, f64::INFINITY)
    }

    /// The position as the tape has it.
    fn on_tape(&self, position: &Position) -> Result<Position> {
        let mut tape = *position;
        for n in self.present.numbers().filter(|n| !self.axes[*n].is_off()) {
            tape[n] = self.axes[n].on_tape(position[n])?;
        }
        Ok(tape)
    }
}

/// Says that the tip leaves its line by more than it may, or by more than the machine
/// would let it. `ends`: what rounding of the axis words alone brings.
#[cold]
fn warn_of_deviation(post: &mut Post, allowed: Option<f64>, ends: f64) {
    let (code, message) = match allowed {
        Some(allowed) => (
            PostCode::CoarseDigits,
            format!(
                "rounding of the axis words alone brings the tip up to {ends:.4} off its line, \
                 {allowed:.4} is allowed"
            ),
        ),
        None => (
            PostCode::Undivided,
            "motions that turn the machine are not divided, and in one of them the tip leaves \
             its line"
                .to_string(),
        ),
    };
    post.warn(code, message);
}

/// A deviation that is worth a word where nothing limits it, in the unit of the program.
fn usual(post: &Post) -> Result<f64> {
    const USUAL: f64 = 0.01;
    Ok(USUAL / post.control.require_unit()?.in_mm())
}
