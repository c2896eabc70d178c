//! Feed motions in which a rotary axis turns, divided so that the tip stays on the
//! line that the CL file asks for.
//!
//! The parts end on that line, and the rotary axes go evenly from end to end. Each
//! part is looked at as the control will move it: between positions as the tape has
//! them. So rounding counts too.

use fil_diag::Result;
use fil_machine::axes::{AXES, AxisSet, Position};
use fil_machine::axis_chain::{AxisChain, Turn};
use fil_machine::locations as loc;
use fil_machine::tables::MachineTables;
use nalgebra::Point3;

use super::mill_turn::live_tool;
use super::position;
use super::state::{Arrived, OnTape, Straightness};
use super::tip::{certain_distance, distance, largest_distance, tip, tip_beside};
use super::turning_feed::{PartFeed, STANDS, TurningFeed};
use crate::control::family;
use crate::errors::PostCode;
use crate::operation::Target;
use crate::operation::motion::Motion;
use crate::post::Post;

/// Most parts of one motion.
const MOST_PARTS: u32 = 1_000;

/// Most lines of an arc.
const MOST_CHORDS: u32 = 20_000;

/// Parts are a little shorter than a first estimate asks for.
const MARGIN: f64 = 1.02;

/// A motion that is to be divided.
struct Turning<'a> {
    tables: &'a MachineTables,
    chain: &'a AxisChain,
    /// Where the axes stand, exactly, and where they go to.
    ends: [Position; 2],
    /// The line of the tip in the part frame.
    line: [Point3<f64>; 2],
    /// The rotary axes at the end.
    turns: [Turn; 2],
    /// C is where the tip is over the face, and does not go evenly.
    by_radius: bool,
}

/// Where the axes stand before a motion.
pub(super) struct Start {
    pub position: Position,
    /// The tip in the part, where the axes stand as the CL file has brought them.
    tip: Option<Point3<f64>>,
    /// The position as the tape has it, where the motion before has found it.
    on_tape: Option<OnTape>,
}

/// The end of one part of a motion.
struct Part {
    position: Position,
    on_tape: OnTape,
}

/// How far the tip may leave its line, in the unit of the program; `None` for as far
/// as it does.
pub(super) fn tolerance(post: &Post) -> Result<Option<f64>> {
    let Straightness { tolerance, off } = post.path.turning.straightness;
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
pub(super) fn feed(post: &mut Post, before: [f64; 2], to: Position, target: Target) -> Result<()> {
    let allowed = tolerance(post)?;
    feed_within(post, before, to, target, allowed)
}

/// The same with the tip as near to its line as this; `None` for as far as it goes.
///
/// # Errors
/// As [`feed`].
#[inline(never)]
pub(super) fn feed_within(
    post: &mut Post,
    before: [f64; 2],
    to: Position,
    target: Target,
    allowed: Option<f64>,
) -> Result<()> {
    let start = stands(post, before);
    let enough = allowed.map_or_else(|| usual(post), Ok)?;
    let (end, _) = position::transformed(post, target);
    let turning = Turning::new(post, &start, to, end);
    let feed = TurningFeed::of(post)?;
    let least = feed.least_parts(turning.length())?;
    let from = match start.on_tape {
        Some(there) => there,
        None => turning.arrival(&start.position)?.0,
    };
    let (arrival, scaled) = turning.arrival(&to)?;
    if least > 1 || !turning.surely_stays_within(enough, &from.position, &arrival.position) {
        return divided(post, &start, to, (target, end), allowed, least);
    }
    let way = turning.way_of_tip(from.tip, arrival.tip);
    let part = feed.between(&from.position, &arrival.position, way);
    part.warn_if_limited(post);
    let word = position::word_of(post, target);
    let motion = Motion { scaled: Some(scaled), ..Motion::new(to, AxisSet::ALL, word) };
    write(post, &motion, &part)?;
    post.path.turning.arrived = Some(Arrived {
        settings: settings(post),
        target: (end, [to[3], to[4]]),
        position: to,
        on_tape: arrival,
        outputs: outputs(post),
    });
    Ok(())
}

/// The same in parts, for the ends of the motion.
///
/// # Errors
/// As [`feed`].
#[inline(never)]
fn divided(
    post: &mut Post,
    start: &Start,
    to: Position,
    (target, end): (Target, Point3<f64>),
    allowed: Option<f64>,
    least: u32,
) -> Result<()> {
    let word = position::word_of(post, target);
    let turning = Turning::new(post, start, to, end);
    let feed = TurningFeed::of(post)?;
    let (begin, _) = turning.arrival(&start.position)?;
    let parts = match allowed {
        Some(allowed) => turning.divided(&begin, allowed, least)?,
        None => turning.parts(least)?,
    };
    let enough = allowed.map_or_else(|| usual(post), Ok)?;
    let mut worst: f64 = 0.0;
    let mut feeds = Vec::with_capacity(parts.len());
    let mut at = &begin;
    for Part { on_tape: to, .. } in &parts {
        worst = worst.max(turning.off(at, to, enough));
        let way = turning.way_of_tip(at.tip, to.tip);
        feeds.push(feed.between(&at.position, &to.position, way));
        at = to;
    }
    if worst > enough {
        let ends = parts.iter().map(|part| turning.end_off(&part.on_tape)).fold(0.0, f64::max);
        warn_of_deviation(post, allowed, ends);
    }
    let slowed = feeds.iter().find(|feed| feed.slowed);
    let hastened = feeds.iter().find(|feed| feed.hastened && !feed.slowed);
    for limited in slowed.into_iter().chain(hastened) {
        limited.warn_if_limited(post);
    }
    for (Part { position, .. }, feed) in parts.into_iter().zip(feeds) {
        write(post, &Motion::new(position, AxisSet::ALL, word), &feed)?;
    }
    Ok(())
}

/// Writes one part with its feed.
fn write(post: &mut Post, motion: &Motion, part: &PartFeed) -> Result<()> {
    family::feed(&mut post.control, motion, Some(&part.feed))?;
    post.path.last.writes_inverse_time = part.is_inverse() && !post.path.inverse_time;
    Ok(())
}

/// The last output values of the axes.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn outputs(post: &Post) -> Position {
    // Each by its own name: an array written by numbers has to go through memory.
    [output(post, 0), output(post, 1), output(post, 2), output(post, 3), output(post, 4)]
}

/// The last output value of an axis.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn output(post: &Post, number: usize) -> f64 {
    post.control.commons.last_output(post.control.tables.axis(number).letter)
}

/// What the positions of the machine hang on besides the point.
fn settings(post: &Post) -> (u64, bool) {
    (post.control.commons.generation(), post.control.is_metric())
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
    let start = stands(post, before).position;
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
        let (point, axis) = position::transformed(post, target);
        let angles = chain.solve(axis, [from[3], from[4]])?;
        let linear = chain.linear(point, angles);
        let to = [linear.x, linear.y, linear.z, angles[0], angles[1]];
        let start = Start { position: from, tip: None, on_tape: None };
        let turning = Turning::new(post, &start, to, point);
        let [begin, end] = [from, to].map(|at| OnTape { position: at, tip: tip(chain, &at) });
        if turning.off(&begin, &end, allowed) > allowed {
            return Ok(false);
        }
        from = to;
    }
    Ok(true)
}

/// True where the machine stands as the last point of the CL file says, under the present
/// transformation: TRANS between two points moves the one against the other.
pub(super) fn is_where_the_path_is(post: &Post, before: [f64; 2]) -> bool {
    if !post.writes_tip() {
        return stands(post, before).tip.is_some();
    }
    let point = post.path.point.unwrap_or_default();
    let (tip, _) =
        position::transformed(post, Target { point, axis: post.path.axis.stands, word: 0 });
    AxisSet::LINEAR.numbers().all(|n| {
        let least = post.control.tables.axis(n).resolution();
        post.control.stands(n).is_none_or(|at| (at - tip[n]).abs() <= least)
    })
}

/// Where the axes stand: exactly where the CL file has brought them, unless the tape
/// says that something else has moved them since.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(super) fn stands(post: &Post, before: [f64; 2]) -> Start {
    let tables = &post.control.tables;
    let point = post.path.point.unwrap_or_default();
    let target = Target { point, axis: post.path.axis.stands, word: 0 };
    let (point, _) = position::transformed(post, target);
    let arrived = post.path.turning.arrived.as_ref();
    let arrived =
        arrived.filter(|there| there.target == (point, before) && there.settings == settings(post));
    // A text moves axes that keep their last output values.
    let in_doubt = post.path.point.is_none() || post.control.state.has_doubts();
    let has_moved = |there: &Arrived| in_doubt || there.outputs != outputs(post);
    if let Some(there) = arrived.filter(|there| !has_moved(there)) {
        return Start { position: there.position, tip: Some(point), on_tape: Some(there.on_tape) };
    }
    let exact = match arrived {
        Some(there) => there.position,
        None => {
            let linear = tables.chain().linear(point, before);
            // C is rounded first: what it leaves beside the axis is no position of a slide.
            let y = if live_tool::is_cut_by_c(&post.control) { 0.0 } else { linear.y };
            [linear.x, y, linear.z, before[0], before[1]]
        }
    };
    let (mut tape, mut moved) = (exact, post.path.point.is_none());
    for n in tables.present().numbers() {
        let axis = tables.axis(n);
        if let (false, Some(stands)) = (axis.is_off(), post.control.stands(n)) {
            tape[n] = axis.near(stands, exact[n]);
            moved |= (tape[n] - exact[n]).abs() > axis.resolution();
        }
    }
    if moved {
        return Start { position: tape, tip: None, on_tape: None };
    }
    Start { position: exact, tip: Some(point), on_tape: arrived.map(|there| there.on_tape) }
}

impl<'a> Turning<'a> {
    /// From where the axes stand to a position with the tip at `end`, in the part.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn new(post: &'a Post, start: &Start, to: Position, end: Point3<f64>) -> Self {
        let tables = &post.control.tables;
        let chain = tables.chain();
        let from = start.position;
        let begin = start.tip.unwrap_or_else(|| tip(chain, &from));
        let turns = post.path.turning.turns;
        let by_radius = live_tool::is_cut_by_c(&post.control);
        Turning { tables, chain, ends: [from, to], line: [begin, end], turns, by_radius }
    }

    /// How far the tip goes.
    fn length(&self) -> f64 {
        (self.line[1] - self.line[0]).norm()
    }

    /// How far the tip goes between two points on the tape. One that stands goes nowhere: what
    /// its rounded ends lie apart is no way that a feed counts along.
    fn way_of_tip(&self, from: Point3<f64>, to: Point3<f64>) -> f64 {
        if self.length() > STANDS { (to - from).norm() } else { 0.0 }
    }

    /// The ends of so many parts; the last is that of the motion.
    ///
    /// # Errors
    /// A position that its address can't hold.
    fn parts(&self, count: u32) -> Result<Vec<Part>> {
        let [from, to] = self.ends;
        let mut parts = Vec::with_capacity(count as usize);
        for number in 1..=count {
            let mut position = to;
            if number < count {
                let share = f64::from(number) / f64::from(count);
                let mut angles = [3, 4].map(|n| from[n] + (to[n] - from[n]) * share);
                let tip = self.line[0] + (self.line[1] - self.line[0]) * share;
                if self.by_radius {
                    angles[0] = live_tool::angle(tip, angles[0]);
                }
                let linear = self.chain.linear(tip, angles);
                position = [linear.x, linear.y, linear.z, angles[0], angles[1]];
            }
            parts.push(Part { position, on_tape: self.arrival(&position)?.0 });
        }
        Ok(parts)
    }

    /// As few parts of one length as keep the tip on its line, and no fewer than
    /// `least`.
    ///
    /// # Errors
    /// It would take too many.
    fn divided(&self, begin: &OnTape, allowed: f64, least: u32) -> Result<Vec<Part>> {
        let mut count = least.max(1);
        loop {
            let parts = self.parts(count)?;
            let Some(off) = self.beyond(begin, &parts, allowed) else { return Ok(parts) };
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
    fn beyond(&self, begin: &OnTape, parts: &[Part], allowed: f64) -> Option<f64> {
        let mut at = begin;
        for Part { on_tape: to, .. } in parts {
            let rounding = self.end_off(at).max(self.end_off(to));
            let spare = if rounding > 0.5 * allowed { rounding + 0.5 * allowed } else { allowed };
            let off = self.off(at, to, spare);
            if off > spare {
                return Some(allowed * off / spare);
            }
            at = to;
        }
        None
    }

    /// The largest distance of the tip from its line between two positions, at most this
    /// much; exact enough to compare with `enough`.
    fn off(&self, from: &OnTape, to: &OnTape, enough: f64) -> f64 {
        let ends = self.end_off(from).max(self.end_off(to));
        largest_distance(self.chain, [&from.position, &to.position], self.line, ends, enough)
    }

    /// The distance of the tip from its line where the axes stand.
    fn end_off(&self, at: &OnTape) -> f64 {
        distance(self.line, at.tip)
    }

    /// True where no measuring is needed to know that the tip stays within a distance of its
    /// line between two positions on the tape, as in most motions.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn surely_stays_within(&self, most: f64, from: &Position, to: &Position) -> bool {
        certain_distance(self.chain, from, to, self.tables.last_digits()) <= most
    }

    /// A position as the tape has it, with the tip there, and the scaled integers of its words.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn arrival(&self, position: &Position) -> Result<(OnTape, [i64; AXES])> {
        // Each by its own name: an array written by numbers has to go through memory.
        let (x, of_x) = self.word_on_tape(0, position)?;
        let (y, of_y) = self.word_on_tape(1, position)?;
        let (z, of_z) = self.word_on_tape(2, position)?;
        let (primary, of_primary) = self.word_on_tape(3, position)?;
        let (secondary, of_secondary) = self.word_on_tape(4, position)?;
        let position = [x, y, z, primary, secondary];
        let scaled = [of_x, of_y, of_z, of_primary, of_secondary];
        Ok((OnTape { tip: tip_beside(self.chain, &position, self.turns), position }, scaled))
    }

    /// The same for one axis; one that is not written stands where it stands.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn word_on_tape(&self, number: usize, position: &Position) -> Result<(f64, i64)> {
        match self.tables.written().has(number) {
            true => self.tables.axis(number).scaled_on_tape(position[number]),
            false => Ok((position[number], 0)),
        }
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
pub(super) fn usual(post: &Post) -> Result<f64> {
    const USUAL: f64 = 0.01;
    Ok(USUAL / post.control.require_unit()?.in_mm())
}
