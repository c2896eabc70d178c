//! Feed motions in which a rotary axis turns: whether the machine may make them at all.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations as loc;
use nalgebra::Point3;

use super::pole::{SAMPLES, apart, most_off_its_plane, off_its_plane, spelled};
use super::{feed_rules, linearization, position, rotary};
use crate::control::{Control, family, full_turn};
use crate::control_state::Place;
use crate::errors::PostCode;
use crate::operation::Target;
use crate::operation::motion::Motion;
use crate::post::Post;

/// Refuses a motion at feed in which an axis would turn that can only index, or whose words the
/// control would read another way.
///
/// # Errors
/// One would.
pub(super) fn may_turn(post: &Post, before: [f64; 2], motion: &Motion) -> Result<()> {
    refuse_indexing(post, before, motion)?;
    if post.control.tables.within_a_turn {
        full_turn::check_feed(&post.control, before, &motion.position)?;
    }
    Ok(())
}

/// Looks at a motion at feed that turns the machine in a block of its own, as where it begins is
/// not known.
///
/// # Errors
/// As [`may_turn`].
#[cold]
pub(super) fn from_elsewhere(post: &Post, before: [f64; 2], motion: &Motion) -> Result<()> {
    if post.control.tables.mills() { Ok(()) } else { may_turn(post, before, motion) }
}

/// Where the rotary axes stand before the first motion that turns them: at zero, as far as anybody
/// knows.
pub(super) fn unsaid(post: &Post) -> Option<[f64; 2]> {
    let tables = &post.control.tables;
    (!tables.mills() && tables.chain().has_rotary()).then(|| position::on_tape(post))
}

/// Looks at a motion at feed that is the first one to turn the machine.
///
/// # Errors
/// As [`may_turn`].
#[cold]
pub(super) fn from_unsaid(post: &mut Post, motion: &Motion) -> Result<()> {
    refuse_indexing_from_anywhere(&post.control)?;
    let now = [motion.position[3], motion.position[4]];
    let Some(stands) = unsaid(post).filter(|stands| apart(*stands, now)) else { return Ok(()) };
    may_turn(post, stands, motion)?;
    rotary::warn_if_lost(post).map(drop)
}

/// Moves at feed to where no rotary axis turns past a limit, whether one turns or not.
///
/// # Errors
/// As [`feed`].
pub(super) fn on_the_way(
    post: &mut Post,
    before: [f64; 2],
    motion: &Motion,
    target: Target,
) -> Result<()> {
    if apart(before, [motion.position[3], motion.position[4]]) {
        may_turn(post, before, motion)?;
        return go(post, before, motion, target);
    }
    match feed_rules::apply(post) {
        true => feed_rules::line(post, motion, target, None),
        false => family::feed(&mut post.control, motion, post.path.feed.as_ref()),
    }
}

/// Refuses a motion at feed in which an axis would turn that can only index.
fn refuse_indexing(post: &Post, before: [f64; 2], motion: &Motion) -> Result<()> {
    let indexes = post.control.commons.read(loc::ROTARY_INDEX_ONLY);
    let (from, to) = (before[0], motion.position[3]);
    if !indexes || (to - from).abs() < post.control.tables.axis(3).resolution() {
        return Ok(());
    }
    let letter = post.control.tables.axis(3).letter;
    PostCode::Indexing.err(format!("{letter} would turn from {from:.3} to {to:.3} degrees at feed"))
}

/// Refuses the same of an axis that stands nobody knows where.
fn refuse_indexing_from_anywhere(control: &Control) -> Result<()> {
    let is_written = !control.tables.axis(3).is_off();
    let indexes = control.commons.read(loc::ROTARY_INDEX_ONLY) && is_written;
    if !indexes || matches!(control.place(3), Place::At(_) | Place::Clear) {
        return Ok(());
    }
    let letter = control.tables.axis(3).letter;
    PostCode::Indexing.err(format!("{letter} would move at feed from an unknown position"))
}

/// Moves at feed where no limit lies on the way.
///
/// # Errors
/// As [`feed`].
pub(super) fn go(post: &mut Post, before: [f64; 2], motion: &Motion, target: Target) -> Result<()> {
    let now = [motion.position[3], motion.position[4]];
    refuse_pole(post, before, now)?;
    if post.writes_tip() && post.control.tables.limits_travel() {
        check_on_the_way(post, before, now, target)?;
    }
    match () {
        () if !post.writes_tip() => linearization::feed(post, before, motion.position, target),
        () if feed_rules::apply(post) => feed_rules::line(post, motion, target, Some(before)),
        () => family::feed(&mut post.control, motion, post.path.feed.as_ref()),
    }
}

/// Under tool-tip control the axes go along curves while the tip goes straight: X, Y and Z
/// must stay within their travel there too.
///
/// # Errors
/// A position on the way lies outside.
fn check_on_the_way(post: &Post, from: [f64; 2], to: [f64; 2], target: Target) -> Result<()> {
    // The tape names the tip; the last point of the CL file may lie in another frame.
    let [Some(x), Some(y), Some(z)] = [0, 1, 2].map(|n| post.control.stands(n)) else {
        return Ok(());
    };
    let start = Point3::new(x, y, z);
    let (end, _) = position::transformed(post, target);
    let tables = &post.control.tables;
    for number in 1..SAMPLES {
        let share = f64::from(number) / f64::from(SAMPLES);
        let point = start + (end - start) * share;
        let angles = [0, 1].map(|n| from[n] + (to[n] - from[n]) * share);
        let at = tables.chain().linear(point, angles);
        tables.check_travel(&[at.x, at.y, at.z, 0.0, 0.0], AxisSet::LINEAR)?;
    }
    Ok(())
}

/// Refuses a motion on whose way the tool leaves the plane of its ends: beside a pole the
/// axes go round it, and the tool would cut into what lies there.
fn refuse_pole(post: &Post, from: [f64; 2], to: [f64; 2]) -> Result<()> {
    let chain = post.control.tables.chain();
    let most = post.control.commons.dbl_opt(loc::ROTARY_AXIS_TOLERANCE).unwrap_or(0.0);
    // One rotary axis has one way round, and no pole.
    let has_pole = chain.rotaries.iter().all(Option::is_some);
    if !has_pole || most <= 0.0 || most_off_its_plane(from, to) <= most {
        return Ok(());
    }
    let off = off_its_plane(chain, from, to);
    if off <= most {
        return Ok(());
    }
    let mut diag = PostCode::Pole.diag(format!(
        "the rotary axes turn from {} to {} degrees in a feed move, and the tool tilts {off:.3} degrees out of the plane of its end positions",
        spelled(from),
        spelled(to)
    ));
    if chain.is_pole(chain.axis_at(from)) && !post.control.commons.read(loc::REPOS_OPTIMISE) {
        diag.hint = Some(
            "The tool is along the pole at the start of the move: if it has been so since the last RAPID, repos.optimise = 1 positions the free axis there. Otherwise put RAPID before the tilt, or start with a tool axis slightly off the pole."
                .into(),
        );
    }
    Err(diag)
}
