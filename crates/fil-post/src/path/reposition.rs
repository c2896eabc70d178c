//! An axis at its limit in a feed motion, a rotary one or X, Y or Z: the tool retracts along its
//! axis, the machine turns to other positions for the same tool axis, the tool returns, and the
//! motion goes on.
//!
//! The change is made where the motion begins, if the machine can go on to its end from
//! there; else where an axis comes to its limit. So the part is cut where the CL file says,
//! and nowhere twice.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::AxisChain;
use fil_machine::commons::Commons;
use fil_machine::locations::{self as loc, ReposFeedMethod};
use fil_machine::modes::FeedMode;
use nalgebra::{Point3, Vector3};

use super::pole::{apart, spelled};
use super::turning::on_the_way;
use super::way::Way;
use super::{linearization, position, rapid};
use crate::control::needs::{self, Act};
use crate::control::word_address::spindle;
use crate::control::{Control, family};
use crate::editing::Ways;
use crate::errors::PostCode;
use crate::operation::motion::{Motion, RapidCode};
use crate::operation::{Coolant, Feed, Operation, Stop, Target};
use crate::post::Post;

/// A smaller part of a motion is none.
const NO_PART: f64 = 1e-9;

/// A smaller turn is none, degrees.
const STILL: f64 = 1e-6;

/// Most that an axis may turn from its new position to the end of the motion, degrees.
const HALF_TURN: f64 = 180.0 + 1e-6;

/// A turn, degrees.
const FULL_TURN: f64 = 360.0;

/// The axis C among A, B and C.
const C: usize = 2;

/// Where in a motion the rotary axes change their positions.
pub(super) struct Change {
    /// Share of the motion made before.
    pub share: f64,
    /// Where they stand where it begins, degrees.
    pub before: [f64; 2],
    /// Where they stand at the change.
    pub from: [f64; 2],
    /// Other positions for the same tool axis.
    pub to: [f64; 2],
    /// Where the motion ends then.
    pub end: [f64; 2],
}

/// The way out and back as it is made, lengths in the program's unit.
pub(super) struct Plan {
    /// How far the tool goes out along its axis.
    pub retract: f64,
    /// From where it comes back at feed.
    pub approach: f64,
    /// Its feed; `None` at rapid.
    pub feed_out: Option<Feed>,
    /// The same for the way back.
    pub feed_back: Option<Feed>,
    /// What was asked for.
    pub ways: Ways,
    /// The macro _REPOS asked for it: what is stopped starts again.
    by_macro: bool,
}

/// Moves at feed to a target that the rotary axes would reach at `free` if they had no
/// limits, from where they stood before.
///
/// # Errors
/// The machine is not to reposition; no other positions lead on; no retract is known; all
/// that the motions refuse.
pub(super) fn feed(
    post: &mut Post,
    before: [f64; 2],
    free: [f64; 2],
    target: Target,
) -> Result<()> {
    let Some(by_macro) = by_macro(post) else {
        return PostCode::Unwinding.err(format!(
            "the rotary axes would turn from {} to {} degrees in a feed motion, past a limit",
            spelled(before),
            spelled(free)
        ));
    };
    let (_, end_axis) = position::transformed(post, target);
    let start = start(post, before)?;
    let (from, _) = position::transformed(post, Target { point: start, ..target });
    let (to, _) = position::transformed(post, target);
    let way = Way { line: [from, to], turn: [before, free] };
    let limit = share_to_limit(post.control.tables.chain(), before, free);
    let Some(change) = find(post, &way, limit, end_axis) else {
        return PostCode::NoAlternative.err(format!(
            "the rotary axes would turn from {} to {} degrees in a feed move, past a limit, and no other solution for the same tool axis lets them continue",
            spelled(before),
            spelled(free)
        ));
    };
    by_way_of(post, &change, start, target, by_macro)
}

/// Moves at feed to a target on a way that leaves the travel of X, Y or Z; false where the
/// machine does not reposition, and nothing is moved.
///
/// # Errors
/// No other positions keep within the travel; no retract is known; all that the motions refuse.
pub(super) fn at_travel(post: &mut Post, way: &Way, target: Target) -> Result<bool> {
    let Some(by_macro) = by_macro(post) else { return Ok(false) };
    let (_, end_axis) = position::transformed(post, target);
    let start = start(post, way.turn[0])?;
    let limit = way.share_inside(&post.control.tables);
    let Some(change) = find(post, way, limit, end_axis) else {
        return PostCode::NoAlternative.err(
            "X, Y or Z would leave its travel in a feed motion, and no other positions of the \
             rotary axes for the same tool axis keep within it",
        );
    };
    by_way_of(post, &change, start, target, by_macro)?;
    Ok(true)
}

/// Whether the macro _REPOS is asked for the way out and back; `None` where the machine makes
/// none.
fn by_macro(post: &Post) -> Option<bool> {
    match post.control.commons.read(loc::REPOS_FEED_METHOD) {
        ReposFeedMethod::RetractAndApproach => Some(false),
        ReposFeedMethod::CallTheMacroRepos => has_macro(post).then_some(true),
        ReposFeedMethod::Nothing => None,
    }
}

/// Where the motion begins, as the CL file says it.
fn start(post: &Post, before: [f64; 2]) -> Result<Point3<f64>> {
    let known = !post.path.long_arc.in_chords && linearization::is_where_the_path_is(post, before);
    post.path.point.filter(|_| known).ok_or_else(|| {
        PostCode::NoAlternative
            .diag("an axis limit is on an arc, or the tool position is not known")
    })
}

/// Moves at feed from the start to a target, with the change of positions on the way.
fn by_way_of(
    post: &mut Post,
    change: &Change,
    start: Point3<f64>,
    target: Target,
    by_macro: bool,
) -> Result<()> {
    let (end, end_axis) = position::transformed(post, target);
    let middle = Target { point: start + (target.point - start) * change.share, ..target };
    let (place, _) = position::transformed(post, middle);
    let plan = Plan::settle(post, place, change, by_macro)?;
    if change.share > NO_PART {
        let position = position::words_at(post, place, change.from)?;
        let motion = Motion::new(position, AxisSet::ALL, 0);
        on_the_way(post, change.before, &motion, Target { word: 0, ..middle })?;
        post.path.point = Some(middle.point);
    }
    out_and_back(post, place, change, &plan, end_axis)?;
    let position = position::words_at(post, end, change.end)?;
    post.path.rotary = Some(change.end);
    let word = position::word_of(post, target);
    on_the_way(post, change.to, &Motion::new(position, AxisSet::ALL, word), target)
}

/// Where the positions change: at the beginning of the motion or at a limit; to those that
/// leave most travel beyond the end of the motion, and of such to the nearest.
fn find(post: &Post, way: &Way, limit: f64, end_axis: Vector3<f64>) -> Option<Change> {
    let tables = &post.control.tables;
    let chain = tables.chain();
    let [before, _] = way.turn;
    let to_zero = post.control.commons.read(loc::ROTARY_C_TO_ZERO);
    let looks_at_travel = !tables.travel_rules.reposition.is_empty();
    [0.0, limit].into_iter().find_map(|share| {
        let from = way.angles(share);
        let start = way.line[0] + (way.line[1] - way.line[0]) * share;
        let others = chain.positions(chain.axis_at(from), from).into_iter();
        let others = others.map(|to| if to_zero { unwound(chain, to) } else { to });
        let leads_on = others.filter(|to| apart(*to, from)).filter_map(|to| {
            let end = chain.nearest_anywhere(end_axis, to)?;
            let short = (0..2).all(|n| (end[n] - to[n]).abs() <= HALF_TURN);
            let rest = Way { line: [start, way.line[1]], turn: [to, end] };
            let fits = !looks_at_travel || rest.is_inside(tables);
            (short && chain.goes(to, end) && fits).then_some(Change {
                share,
                before,
                from,
                to,
                end,
            })
        });
        leads_on.max_by(|a, b| {
            let (room, other) = (room(chain, a), room(chain, b));
            let nearer = off_zero(chain, b.to).total_cmp(&off_zero(chain, a.to));
            let most = room.total_cmp(&other).then(turn_of(b).total_cmp(&turn_of(a)));
            if to_zero { nearer.then(most) } else { most }
        })
    })
}

/// Positions without the whole turns of an axis C that has no travel.
fn unwound(chain: &AxisChain, to: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|n| match &chain.rotaries[n] {
        Some(rotary) if rotary.axis == C && !rotary.is_limited() => {
            to[n] - FULL_TURN * (to[n] / FULL_TURN).round()
        }
        _ => to[n],
    })
}

/// How far the axis C stands off zero, degrees.
fn off_zero(chain: &AxisChain, at: [f64; 2]) -> f64 {
    let is_c = |n: &usize| chain.rotaries[*n].as_ref().is_some_and(|rotary| rotary.axis == C);
    (0..2).filter(is_c).map(|n| at[n].abs()).sum()
}

/// The largest share of an even turn at which no axis is past its limit.
fn share_to_limit(chain: &AxisChain, from: [f64; 2], to: [f64; 2]) -> f64 {
    let shares = chain.rotaries.iter().enumerate().filter_map(|(n, rotary)| {
        let rotary = rotary.as_ref()?;
        let limit = rotary.limit(from[n], to[n] > from[n])?;
        (!rotary.goes(from[n], to[n]))
            .then(|| ((limit - from[n]) / (to[n] - from[n])).clamp(0.0, 1.0))
    });
    shares.fold(1.0, f64::min)
}

/// How far the limited axes can still turn beyond the end of the motion, degrees.
fn room(chain: &AxisChain, change: &Change) -> f64 {
    let rooms = chain.rotaries.iter().enumerate().filter_map(|(n, rotary)| {
        let rotary = rotary.as_ref()?;
        let turn = change.end[n] - change.to[n];
        let limit = rotary.limit(change.end[n], turn > 0.0)?;
        (turn.abs() > STILL).then(|| (limit - change.end[n]).abs())
    });
    rooms.fold(f64::INFINITY, f64::min)
}

fn turn_of(change: &Change) -> f64 {
    (0..2).map(|n| (change.to[n] - change.from[n]).abs()).sum()
}

/// The script has the macro _REPOS.
pub(super) fn has_macro(post: &Post) -> bool {
    post.control.tape.editor.0.as_ref().is_some_and(|editor| editor.repositions())
}

impl Plan {
    /// The way out and back of the settings, and of the macro _REPOS where it is asked.
    ///
    /// # Errors
    /// No retract is known; no feed; what the macro refuses, and a way shorter than that of the
    /// settings.
    pub fn settle(
        post: &mut Post,
        place: Point3<f64>,
        change: &Change,
        by_macro: bool,
    ) -> Result<Plan> {
        let control = &mut post.control;
        let mut ways = ways_of(&control.commons);
        let least = ways;
        if by_macro && let Some(editor) = &mut control.tape.editor.0 {
            let axis = control.tables.chain().axis_at(change.from);
            let ([a, b], [to_a, to_b]) = (change.from, change.to);
            let given = [a, b, to_a, to_b, place.x, place.y, place.z, axis.x, axis.y, axis.z];
            editor.reposition(&given, &mut ways, &control.commons)?;
            let warnings = editor.take_warnings();
            control.warnings.extend(warnings);
        }
        let Some(retract) = ways.retract.filter(|length| *length > 0.0) else {
            return PostCode::NoAlternative.err(
                "a rotary axis is at its limit, and how far the tool shall retract is not known \
                 (repos.retract_distance)",
            );
        };
        if let Some(feed) =
            [ways.retract_feed, ways.approach_feed].into_iter().flatten().find(|feed| *feed < 0.0)
        {
            return PostCode::NoAlternative.err(format!("_REPOS gives {feed} for a feed"));
        }
        let approach = ways.approach.filter(|length| *length > 0.0).unwrap_or(retract).min(retract);
        let shorter = |own: f64, least: Option<f64>| least.filter(|least| own < *least);
        if let Some(least) = shorter(retract, least.retract) {
            return PostCode::NoAlternative.err(format!(
                "_REPOS retracts by {retract}, less than repos.retract_distance = {least}: the tool may not be clear of the part"
            ));
        }
        if let Some(least) = shorter(approach, least.approach.map(|least| least.min(retract))) {
            return PostCode::NoAlternative.err(format!(
                "_REPOS returns at feed from {approach}, less than repos.approach_distance = {least}"
            ));
        }
        Ok(Plan {
            retract,
            approach,
            feed_out: feed_of(post, ways.retract_feed)?,
            feed_back: feed_of(post, ways.approach_feed)?,
            ways,
            by_macro,
        })
    }
}

/// The way out and back of the settings.
fn ways_of(commons: &Commons) -> Ways {
    Ways {
        retract: commons.dbl_opt(loc::REPOS_RETRACT_DISTANCE),
        retract_feed: commons.dbl_opt(loc::REPOS_RETRACT_FEED),
        approach: commons.dbl_opt(loc::REPOS_APPROACH_DISTANCE),
        approach_feed: commons.dbl_opt(loc::REPOS_APPROACH_FEED),
        along_next: commons.read(loc::REPOS_NEW_TOOL_AXIS),
        spindle_stands: commons.read(loc::REPOS_RETRACT_SPINDLE),
        coolant_off: commons.read(loc::REPOS_RETRACT_COOLANT),
        optional_stop: commons.read(loc::REPOS_RETRACT_OPSTOP),
        stop: commons.read(loc::REPOS_RETRACT_STOP),
    }
}

/// A feed of the settings or of the macro: absent is the present one, 0 is rapid.
fn feed_of(post: &Post, value: Option<f64>) -> Result<Option<Feed>> {
    let present = *needs::feed(post.path.feed.as_ref())?;
    Ok(match value {
        None => Some(present),
        Some(value) if value > 0.0 => Some(Feed { value, mode: FeedMode::PerMinute, ..present }),
        Some(_) => None,
    })
}

/// Takes the tool out, turns the machine and brings the tool back to the same point.
fn out_and_back(
    post: &mut Post,
    place: Point3<f64>,
    change: &Change,
    plan: &Plan,
    next_axis: Vector3<f64>,
) -> Result<()> {
    post.control.ready_for(Act::Reposition)?;
    let commons = &post.control.commons;
    if commons.read(loc::REPOS_FEED_WARNING) {
        let (from, to) = (spelled(change.from), spelled(change.to));
        let message = format!("the tool retracts, and the rotary axes go from {from} to {to}");
        post.warn(PostCode::Repositioned, message);
    }
    let own = post.control.tables.chain().axis_at(change.from);
    let out = if plan.ways.along_next { next_axis.normalize() } else { own };
    let away = position::words_at(post, place + out * plan.retract, change.from)?;
    straight(post, away, plan.feed_out)?;
    let flows = stop_around(post, plan)?;
    turn(post, place + own * plan.retract, change)?;
    if plan.approach < plan.retract {
        let near = position::words_at(post, place + own * plan.approach, change.to)?;
        straight(post, near, None)?;
    }
    start_again(post, flows)?;
    let back = position::words_at(post, place, change.to)?;
    straight(post, back, plan.feed_back)?;
    post.path.rotary = Some(change.to);
    Ok(())
}

/// A straight way out or back, in which no rotary axis turns. At rapid only along one axis of
/// the machine, since controls need not go straight in others.
pub(super) fn straight(post: &mut Post, to: Position, feed: Option<Feed>) -> Result<()> {
    let motion = Motion::new(to, AxisSet::ALL, 0);
    let control = &mut post.control;
    let moves = |n: &usize| {
        let least = control.tables.axis(*n).resolution();
        control.axis_position(*n).is_none_or(|stands| (stands - to[*n]).abs() > least)
    };
    let along_one = AxisSet::LINEAR.numbers().filter(moves).count() <= 1;
    match feed.or(post.path.feed.filter(|_| !along_one)) {
        Some(feed) => family::feed(control, &motion, Some(&feed)),
        None => {
            let cause = control.block.cause.whole();
            family::rapid(control, &motion, RapidCode::Along, cause)
        }
    }
}

/// Turns the rotary axes where the tool is out.
fn turn(post: &mut Post, place: Point3<f64>, change: &Change) -> Result<()> {
    let position = position::words_at(post, place, change.to)?;
    let motion = Motion::new(position, AxisSet::ALL, 0);
    let of_tip = post.writes_tip();
    let control = &mut post.control;
    let cause = control.block.cause.whole();
    if of_tip || control.commons.read(loc::REPOS_SKIP_ROTARY) {
        return family::rapid(control, &motion, RapidCode::Across, cause);
    }
    rapid::turn_away(control, &motion, cause)
}

/// What is switched on before the way back.
pub(super) struct Restart {
    /// Which way the spindle turns: clockwise or not.
    spindle: Option<bool>,
    coolant: Option<fil_machine::setting::CodeAt>,
}

/// Stops the spindle and the coolant, and the program, where the machine asks for it. A stop
/// of the program stops both on many machines, so they are switched on again behind it.
///
/// # Errors
/// What stops would not start again.
pub(super) fn stop_around(post: &mut Post, plan: &Plan) -> Result<Restart> {
    let control = &mut post.control;
    let starts = |at| plan.by_macro || control.commons.read(at);
    let stands = plan.ways.spindle_stands;
    if stands && !starts(loc::REPOS_APPROACH_SPINDLE) {
        return PostCode::NoAlternative
            .err("repos.retract_spindle stops the spindle, and nothing starts it for the return");
    }
    let (ends, flows_again) = (plan.ways.coolant_off, starts(loc::REPOS_APPROACH_COOLANT));
    let (optional, always) = (plan.ways.optional_stop, plan.ways.stop);
    let halts = optional || always;
    let spindle = match spindle::may_turn(control) && (stands || halts) {
        true => Some(way_round(control)?),
        false => None,
    };
    if stands && spindle.is_some() {
        spindle::stand(control)?;
    }
    let coolant = control.coolant;
    if ends && coolant.is_some() {
        control.family().write(control, Operation::Coolant(Coolant::Off))?;
    }
    let coolant = coolant.filter(|_| if ends { flows_again } else { halts });
    for (asked, stop) in [(optional, Stop::Optional), (always, Stop::Always)] {
        if asked {
            control.family().write(control, Operation::Stop(stop))?;
        }
    }
    Ok(Restart { spindle, coolant })
}

/// Which way the spindle turns that is to turn again.
///
/// # Errors
/// It is not known.
fn way_round(control: &Control) -> Result<bool> {
    spindle::clockwise(control).ok_or_else(|| {
        PostCode::NoAlternative.diag(
            "the spindle would be stopped while the machine turns, and which way it turns is not \
             known: a text may have changed it",
        )
    })
}

pub(super) fn start_again(post: &mut Post, restart: Restart) -> Result<()> {
    let control = &mut post.control;
    if let Some(clockwise) = restart.spindle {
        spindle::turn_on(control, clockwise)?;
    }
    if let Some(at) = restart.coolant {
        let code = control.code(at, "the coolant that flows again")?;
        control.coolant = Some(at);
        control.m(code);
        control.write_block()?;
    }
    Ok(())
}
