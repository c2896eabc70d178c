//! CYCLE/type,couplets… and CYCLE/OFF: canned cycles, one hole for each GOTO that
//! follows.
//!
//! The GOTO is the hole's start: the bottom lies DEPTH (or FEDTO) below it, the
//! R level CLEAR less RAPTO above it. RETURN,0 retracts to the level before the
//! cycle (G98), else the tool stays at R between holes (G99). On a machine
//! without the cycle's code each hole is written as single moves.

use fil_cl::WordId;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::locations::{self as loc, CycleRapto};
use fil_machine::modes::FeedMode;

use super::{fedrat, thread};
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::Feed;
use crate::operation::cycle::{Cycle, CycleFeed, CycleKind, CycleWords};
use crate::path::cycle;
use crate::post::Post;

/// The minor word of each kind.
const KINDS: &[(WordId, CycleKind)] = &[
    (w::BRKCHP, CycleKind::Brkchp),
    (w::DEEP, CycleKind::Deep),
    (w::DEEP2, CycleKind::Deep),
    (w::DRILL, CycleKind::Drill),
    (w::CSINK, CycleKind::Csink),
    (w::TAP, CycleKind::Tap),
    (w::BORE, CycleKind::Bore),
    (w::REAM, CycleKind::Ream),
    (w::FACE, CycleKind::Face),
    (w::THRU, CycleKind::Thru),
    (w::MILL, CycleKind::Mill),
];

/// What to do with words of cycles that only some controls have: ORIENT and NOREVR of BORE, TLANGL.
const OF_THE_CONTROL: &str = "Take CYCLE and its GOTOs with a FIL section that writes the control's own cycle, such as G76 for BORE with ORIENT; `filpost explain CYCLE` shows what the post writes.";

/// Takes the cycle, or ends it.
///
/// # Errors
/// A kind or couplet that is not known, a missing depth, feed or step.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if post.path.arc.is_some() {
        return PostCode::ArcEnd.err("CYCLE came between a CIRCLE and its GOTO");
    }
    if !items.has(w::PULBAC) && items.any_of(&[w::OFF, w::NOMORE]).is_some() {
        items.deny_rest()?;
        return cycle::replace(post, None);
    }
    // CYCLE/INIT and CYCLE/CLEAR alone announce the cycle that follows.
    if items.len() == 1 && items.any_of(&[w::INIT, w::CLEAR]).is_some() {
        return Ok(());
    }
    items.flag(w::INIT);
    let cycle = read(post, items)?;
    items.deny_rest().map_err(|mut diag| {
        diag.hint.get_or_insert_with(|| OF_THE_CONTROL.into());
        diag
    })?;
    // RAPID right before it is of the way to its first hole, which a cycle makes at rapid.
    post.path.rapid = None;
    cycle::replace(post, Some(cycle))
}

fn read(post: &mut Post, items: &mut Items) -> Result<Cycle> {
    let kind = kind(items)?;
    let mut words = CycleWords::default();
    // FEDTO,0 of NX feeds from the R level to the hole's start.
    let feeds_to_start = items.has(w::FEDTO);
    let depth = optional(items, &[w::DEPTH, w::FEDTO], &mut words.depth)?;
    let (depth, plates) = match depth {
        Some(first) if kind == CycleKind::Thru => plates(items, first)?,
        depth => (depth, Vec::new()),
    };
    let depth = match kind {
        CycleKind::Csink => depth_of_csink(items, depth, &mut words.depth)?,
        _ => depth,
    };
    let depth = depth.ok_or_else(|| PostCode::CycleForm.diag("DEPTH is missing"))?.abs();
    let Levels { clear, travel } = clearance(post, items, &mut words.clear)?;
    let step = step(post, items, kind, &mut words.step)?;
    let out_each = how_chips_break(post, items, kind)?;
    let retract = return_level(items)?.or(travel);
    let all_rigid = post.control.commons.read(loc::CYCLE_TAP_RIGID);
    let rigid = kind == CycleKind::Tap && (items.flag(w::HIGH) || all_rigid);
    if kind == CycleKind::Tap && !rigid {
        warn_of_mode(post);
    }
    let dwell = optional(items, &[w::DWELL], &mut words.dwell)?;
    if !plates.is_empty() && dwell.is_some_and(|dwell| dwell != 0.0) {
        return PostCode::CycleForm.err("DWELL of a hole through several plates");
    }
    if depth == 0.0 && !(feeds_to_start && clear > 0.0) || clear < 0.0 {
        return PostCode::CycleForm.err("DEPTH must not be zero and CLEAR not negative");
    }
    if dwell.is_some_and(|dwell| dwell < 0.0) || retract.is_some_and(|level| level < 0.0) {
        return PostCode::CycleForm.err("DWELL and RETURN must not be negative");
    }
    let own_feed = own_feed(post, items, kind)?;
    let feed = match own_feed {
        Some(feed) => {
            keep_as_first(post, kind, feed);
            feed
        }
        None => feed_of_fedrat(post, kind)?,
    };
    let usual_dwell = kind.dwell().and_then(|at| post.control.commons.dbl_opt(at));
    let cycle = Cycle {
        kind,
        depth,
        plates,
        came_from: None,
        clear,
        retract,
        step,
        out_each,
        dwell: dwell.or(usual_dwell).unwrap_or(0.0),
        feed,
        feed_of_fedrat: own_feed.is_none(),
        turns: None,
        rigid,
        initial: None,
        above: None,
        cause: post.control.block.cause.whole(),
        words,
        along: None,
        in_force: None,
    };
    warn_of_control_of_breaks(post, &cycle);
    Ok(cycle)
}

/// The depth of THRU and the gaps between its plates: DEPTH,a,b,c leads through a plate that ends at
/// a and one from b to c.
///
/// # Errors
/// A plate without its end, or depths that do not rise.
fn plates(items: &mut Items, first: f64) -> Result<(Option<f64>, Vec<[f64; 2]>)> {
    let mut depths = vec![first];
    depths.extend(items.further());
    let rises = depths.windows(2).all(|pair| pair[0].abs() < pair[1].abs());
    if depths.len().is_multiple_of(2) || !rises {
        return PostCode::CycleForm.err_with(
            "THRU with the depths of several plates: they are not ends and beginnings in turn",
            "Give the end of the first plate, then beginning and end of each further one, each \
             deeper than the one before: DEPTH, 10, 30, 45.",
        );
    }
    let gaps = depths.chunks_exact(2).map(|gap| [gap[0].abs(), gap[1].abs()]).collect();
    Ok((depths.last().copied(), gaps))
}

/// Warns of a tap that does not ask for the code of rigid taps.
fn warn_of_mode(post: &mut Post) {
    if let Some(mode) = post.control.code_if_any(loc::CYCLE_RIGID_TAP_MODE) {
        let message = format!("CYCLE/TAP: M{mode} of cycle.rigid_tap_mode is for CYCLE/TAP,HIGH");
        post.warn(PostCode::NotRigid, message);
    }
}

/// The depth of a countersink: DEPTH, or that of its cone.
///
/// # Errors
/// Both, and they differ.
fn depth_of_csink(items: &mut Items, depth: Option<f64>, at: &mut u16) -> Result<Option<f64>> {
    let mut at_cone = *at;
    let Some(cone) = depth_of_cone(items, &mut at_cone)? else { return Ok(depth) };
    let Some(depth) = depth else {
        *at = at_cone;
        return Ok(Some(cone));
    };
    if (depth.abs() - cone).abs() > SAME_DEPTH * cone {
        return PostCode::CycleForm.err_with(
            format!("CSINK goes to DEPTH {depth}, and DIAMET with TLANGL to {cone:.4}"),
            "Give only one of the two.",
        );
    }
    Ok(Some(depth))
}

/// Depths of a countersink are the same when they differ by less than this part of them.
const SAME_DEPTH: f64 = 0.01;

/// The depth at which a countersink of the angle TLANGL has the diameter DIAMET at the start of
/// the hole; `None` without them.
///
/// # Errors
/// One without the other; no diameter, or no angle of a cone.
fn depth_of_cone(items: &mut Items, at: &mut u16) -> Result<Option<f64>> {
    let angle = items.couplet(w::TLANGL)?;
    let diameter = optional(items, &[w::DIAMET], at)?;
    match (diameter, angle) {
        (Some(diameter), Some(angle)) if diameter > 0.0 && angle > 0.0 && angle < 180.0 => {
            Ok(Some(diameter / 2.0 / libm::tan((angle / 2.0).to_radians())))
        }
        (None, None) => Ok(None),
        _ => PostCode::CycleForm
            .err("CSINK takes DEPTH, or DIAMET above zero and TLANGL below 180 degrees"),
    }
}

/// The kind of the cycle. DEEP and BRKCHP may stand beside DRILL.
fn kind(items: &mut Items) -> Result<CycleKind> {
    let found = KINDS.iter().find(|(word, _)| items.flag(*word));
    let Some((_, kind)) = found else {
        return Err(items.error("the kind of cycle is not known"));
    };
    if kind.pecks() {
        items.flag(w::DRILL);
    }
    Ok(*kind)
}

/// The level to retract to: RETURN or RTRCTO, or PULBAC or RTRCTO,AUTO for that before the cycle.
///
/// # Errors
/// PULBAC beside a level that is another one.
fn return_level(items: &mut Items) -> Result<Option<f64>> {
    // RTRCTO,AUTO, which files of NX have, is the level before the cycle.
    let level = if items.pair(w::RTRCTO, w::AUTO) {
        Some(0.0)
    } else {
        optional(items, &[w::RETURN, w::RTRCTO], &mut 0)?
    };
    if !items.flag(w::PULBAC) {
        return Ok(level);
    }
    let off = items.flag(w::OFF);
    if !off {
        items.flag(w::ON);
    }
    match level {
        Some(level) if off || level != 0.0 => {
            PostCode::CycleForm.err(format!("PULBAC with the return plane {level}"))
        }
        _ if off => Ok(None),
        _ => Ok(Some(0.0)),
    }
}

/// Levels above the start of a hole.
struct Levels {
    /// Where the feed begins: the R level.
    clear: f64,
    /// Where the tool travels between holes, if not there.
    travel: Option<f64>,
}

/// The R level above the hole's start: CLEAR, less RAPTO; RAPTO alone; else the machine's.
///
/// # Errors
/// A RAPTO that leads below the start of the hole, or with `cycle.rapto = 1` below CLEAR, at which
/// the tool stays between holes.
fn clearance(post: &mut Post, items: &mut Items, at: &mut u16) -> Result<Levels> {
    let rapto = optional(items, &[w::RAPTO], at)?;
    let clear = items.couplet(w::CLEAR)?;
    let from_clear = post.control.commons.read(loc::CYCLE_RAPTO) == CycleRapto::FromClear;
    match (rapto, clear) {
        (Some(rapto), Some(clear)) if from_clear && rapto != 0.0 => {
            return below_clear(post, rapto, clear);
        }
        (Some(rapto), Some(clear)) if !from_clear && rapto < clear => {
            return PostCode::CycleForm.err_with(
                format!(
                    "RAPTO {rapto} is the R plane, and the tool would move between the holes below CLEAR {clear}"
                ),
                "Give a RAPTO above CLEAR, or set cycle.rapto = 0, by which it counts down from \
                 CLEAR.",
            );
        }
        (Some(rapto), Some(clear)) if !from_clear && rapto > clear => {
            let message = format!("CYCLE: CLEAR {clear}; RAPTO {rapto} is the R plane");
            post.warn(PostCode::IgnoredPart, message);
        }
        (None, Some(_)) => *at = items.last_word(),
        _ => {}
    }
    let level = if from_clear { clear.or(rapto) } else { rapto.or(clear) };
    let usual = post.control.commons.dbl_opt(loc::CYCLE_AUTO_CLEARANCE).unwrap_or(0.0);
    if level.is_none() && usual == 0.0 {
        let message = "CYCLE: neither CLEAR nor RAPTO; the tool goes at rapid to where holes start";
        post.warn(PostCode::NoClearance, message.into());
    }
    Ok(Levels { clear: level.unwrap_or(usual), travel: None })
}

/// RAPTO counts from CLEAR toward the hole: the tool travels at CLEAR, and its rapid ends lower.
///
/// # Errors
/// It would end below the start of the hole, or above CLEAR.
fn below_clear(post: &mut Post, rapto: f64, clear: f64) -> Result<Levels> {
    let level = clear - rapto;
    if level < 0.0 || rapto < 0.0 {
        return PostCode::CycleForm.err_with(
            format!(
                "RAPTO {rapto} is measured from CLEAR {clear} toward the hole: the rapid would end {level} above its start"
            ),
            "Give a RAPTO from 0 to CLEAR, or set cycle.rapto = 1 if it is the R plane above the hole.",
        );
    }
    let message = "CYCLE: RAPTO counts from CLEAR toward the hole, and the rapid ends at the \
                   difference above its start";
    post.warn(PostCode::RaptoFromClear, message.into());
    Ok(Levels { clear: level, travel: Some(clear) })
}

/// The peck of the cycles that have one; the control's cycles have one depth for all
/// pecks.
fn step(post: &mut Post, items: &mut Items, kind: CycleKind, at: &mut u16) -> Result<Option<f64>> {
    if !kind.pecks() {
        return Ok(None);
    }
    let step = optional(items, &[w::STEP, w::SUBPECK, w::INCR], at)?;
    let first = items.couplet(w::FIRST_PECK)?;
    if !step.is_some_and(|step| step > 0.0) {
        let what = if step.is_some() { "STEP must be above zero" } else { "STEP is missing" };
        return PostCode::CycleForm.err(what);
    }
    if let Some(first) = first.filter(|first| Some(*first) != step) {
        let message = format!("CYCLE: the first peck is as deep as the others, and not {first}");
        post.warn(PostCode::IgnoredPart, message);
    }
    Ok(step)
}

/// BACK and REV of BRKCHP say how its chips are broken, which each control does in its own way;
/// TIMES after how many pecks the tool leaves the hole.
///
/// # Errors
/// TIMES that is no number of pecks.
fn how_chips_break(post: &mut Post, items: &mut Items, kind: CycleKind) -> Result<Option<u32>> {
    if kind != CycleKind::Brkchp {
        return Ok(None);
    }
    for word in [w::BACK, w::REV] {
        let Some(value) = items.couplet(word)? else { continue };
        let gap = post.control.commons.dbl_opt(loc::CYCLE_PECK_GAP);
        if word == w::BACK && gap == Some(value) {
            continue;
        }
        let name = items.name(word);
        let message = format!(
            "CYCLE/BRKCHP: {name} {value}; the control breaks chips in its own way, going back by \
             cycle.peck_gap where the program says how far"
        );
        post.warn(PostCode::IgnoredPart, message);
    }
    match items.couplet(w::TIMES)? {
        // No peck leaves the hole.
        None | Some(0.0) => Ok(None),
        Some(each) if (1.0..=MOST_BREAKS).contains(&each) && each.fract() == 0.0 => {
            Ok(Some(each as u32))
        }
        Some(each) => PostCode::CycleForm
            .err(format!("CYCLE/BRKCHP: TIMES {each} is no whole number of pecks")),
    }
}

/// Largest number of TIMES in BRKCHP.
const MOST_BREAKS: f64 = 99999.0;

/// Warns of TIMES in a cycle of the control that has no word for it.
fn warn_of_control_of_breaks(post: &mut Post, cycle: &Cycle) {
    let control = &post.control;
    let is_left_out =
        !control.can().cycles_count_breaks && control.family().cycle_code(control, cycle).is_some();
    if let Some(each) = cycle.out_each.filter(|_| is_left_out) {
        let message = format!(
            "CYCLE/BRKCHP: TIMES {each}; the cycle of the control has no word for the pecks that \
             leave the hole"
        );
        post.warn(PostCode::IgnoredPart, message);
    }
}

/// The feed of a cycle holds on behind it where no FEDRAT came before: Creo writes none then, and
/// the control holds it, too.
fn keep_as_first(post: &mut Post, kind: CycleKind, feed: CycleFeed) {
    if let (CycleFeed::Feed(feed), false) = (feed, kind == CycleKind::Tap) {
        post.path.feed.get_or_insert(feed);
    }
}

/// FEDRAT between two holes: a cycle without a feed of its own takes it.
///
/// # Errors
/// A tap's feed above that of Z.
pub fn take_feed(post: &mut Post) -> Result<()> {
    let takes = post.path.cycle.as_ref().filter(|cycle| cycle.feed_of_fedrat);
    let Some(kind) = takes.map(|cycle| cycle.kind) else { return Ok(()) };
    let feed = feed_of_fedrat(post, kind)?;
    if let Some(cycle) = &mut post.path.cycle
        && !cycle.feed.is_as_fast_as(&feed)
    {
        cycle.feed = feed;
        cycle.turns = None;
        cycle.in_force = None;
    }
    Ok(())
}

/// The feed of FEDRAT for a cycle without its own.
fn feed_of_fedrat(post: &mut Post, kind: CycleKind) -> Result<CycleFeed> {
    let missing = || PostCode::CycleForm.diag("no feed in the cycle, and no FEDRAT before it");
    let feed = post.path.feed.ok_or_else(missing)?;
    if kind == CycleKind::Tap && feed.mode == FeedMode::PerMinute {
        let message = format!("CYCLE/TAP: the feed {} of FEDRAT is that of the tap", feed.value);
        post.warn(PostCode::TapOfFedrat, message);
    }
    if kind == CycleKind::Tap {
        return Ok(CycleFeed::Feed(feed));
    }
    Ok(CycleFeed::Feed(within_that_of_z(post, feed)))
}

/// The cycle's own feed: unit word and number, or TPI of a tap.
fn own_feed(post: &mut Post, items: &mut Items, kind: CycleKind) -> Result<Option<CycleFeed>> {
    let cause = post.control.block.cause;
    if kind == CycleKind::Tap && items.has(w::TPI) {
        let lead = thread::lead(post, items)?;
        post.control.block.cause = cause;
        return Ok(Some(CycleFeed::Lead(lead)));
    }
    for unit in fedrat::UNITS {
        let Some(value) = items.couplet(*unit)? else { continue };
        if value <= 0.0 {
            return PostCode::CycleForm.err("the feed must be above zero");
        }
        post.due_to(items);
        let feed = fedrat::in_output_units(post, value, Some(*unit))?;
        post.control.block.cause = cause;
        fedrat::warn_beside_second_spindle(post, feed);
        if kind == CycleKind::Tap {
            return Ok(Some(CycleFeed::Feed(fedrat::in_unit_of_control(post, feed))));
        }
        let feed = fedrat::within_limits(post, feed);
        return Ok(Some(CycleFeed::Feed(within_that_of_z(post, feed))));
    }
    Ok(None)
}

/// A feed per minute within what Z may do.
fn within_that_of_z(post: &mut Post, feed: Feed) -> Feed {
    let Some(largest) = post.control.tables.motion.largest_of[1] else { return feed };
    let largest = largest * post.control.commons.dbl_opt(loc::FEED_UPM_FACTOR).unwrap_or(1.0);
    if feed.mode != FeedMode::PerMinute || feed.value <= largest {
        return feed;
    }
    post.warn(PostCode::Clamped, format!("feed {} of a cycle became {largest}", feed.value));
    Feed { value: largest, ..feed }
}

/// The value of the first of these words, and where in the record it stands.
fn optional(items: &mut Items, words: &[WordId], at: &mut u16) -> Result<Option<f64>> {
    for word in words {
        if let Some(value) = items.couplet(*word)? {
            *at = items.last_word();
            return Ok(Some(value));
        }
    }
    Ok(None)
}
