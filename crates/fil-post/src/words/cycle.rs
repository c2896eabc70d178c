//! CYCLE/type,couplets… and CYCLE/OFF: canned cycles G81 to G89, one hole for
//! each GOTO that follows.
//!
//! The GOTO is the hole's start: the bottom lies DEPTH (or FEDTO) below it, the
//! R level CLEAR (or RAPTO) above it. RETURN,0 retracts to the level before the
//! cycle (G98), else the tool stays at R between holes (G99). On a machine
//! without the cycle's code each hole is written as single moves.

use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_cl::{Record, Word, WordId};
use fil_diag::Diag;

use super::form::Form;
use super::{cycle_expand, delay, fedrat};
use crate::cause::Cause;
use crate::commons::{Dbl, EMPTY, Int};
use crate::errors::PostCode;
use crate::letters::R;
use crate::locations as loc;
use crate::motion::{Position, ROTARY, Target, XY, Z};
use crate::post::Post;
use crate::state::Feed;

/// A kind of cycle: minor word, location of its G code, of its dwell.
struct Kind {
    word: WordId,
    code: Int,
    dwell: Dbl,
    pecks: bool,
}

const KINDS: &[Kind] = &[
    Kind {
        word: w::DRILL,
        code: loc::CYCLE_DRILL_CODE,
        dwell: loc::DWELL_CYCLE_DRILL,
        pecks: false,
    },
    Kind {
        word: w::CSINK,
        code: loc::CYCLE_CSINK_CODE,
        dwell: loc::DWELL_CYCLE_CSINK,
        pecks: false,
    },
    Kind { word: w::DEEP, code: loc::CYCLE_DEEP_CODE, dwell: loc::DWELL_CYCLE_DEEP, pecks: true },
    Kind {
        word: w::BRKCHP,
        code: loc::CYCLE_BRKCHP_CODE,
        dwell: loc::DWELL_CYCLE_BRKCHP,
        pecks: true,
    },
    Kind { word: w::TAP, code: loc::CYCLE_TAP_CODE, dwell: loc::DWELL_CYCLE_TAP, pecks: false },
    Kind { word: w::BORE, code: loc::CYCLE_BORE_CODE, dwell: loc::DWELL_CYCLE_BORE, pecks: false },
    Kind { word: w::REAM, code: loc::CYCLE_REAM_CODE, dwell: loc::DWELL_CYCLE_REAM, pecks: false },
    Kind { word: w::FACE, code: loc::CYCLE_FACE_CODE, dwell: loc::DWELL_CYCLE_FACE, pecks: false },
    Kind { word: w::THRU, code: loc::CYCLE_THRU_CODE, dwell: loc::DWELL_CYCLE_THRU, pecks: false },
];

const UNITS: &[WordId] = &[w::MMPM, w::IPM, w::FPM, w::MMPR, w::IPR, w::FPR];

/// A cycle in force. Lengths in mm or inch.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// DRILL, DEEP, …
    pub word: WordId,
    /// Its G code; `None` when the machine has no such cycle.
    pub code: Option<i32>,
    /// Depth below the hole's start, positive.
    pub depth: f64,
    /// R level above the hole's start.
    pub clear: f64,
    /// Level above the hole's start to retract to; 0 is the level before the cycle.
    pub retract: Option<f64>,
    /// Peck.
    pub step: Option<f64>,
    /// Dwell at the bottom, seconds.
    pub dwell: f64,
    /// Feed.
    pub feed: Feed,
    /// Level of the tool before the cycle, machine Z.
    pub initial: Option<f64>,
    /// The CYCLE record.
    pub cause: Cause,
    /// Its words with values.
    pub words: CycleWords,
    /// Words of the last hole's block, when the control still has them.
    pub in_force: Option<HoleLevels>,
}

/// The words of a CYCLE record that hold a value; 0 for one that has none.
#[derive(Clone, Copy, Debug, Default)]
pub struct CycleWords {
    /// DEPTH
    pub depth: u16,
    /// CLEAR
    pub clear: u16,
    /// STEP
    pub step: u16,
    /// DWELL
    pub dwell: u16,
}

/// Levels of a hole in machine Z, after all transformations but the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoleLevels {
    /// Bottom.
    pub bottom: f64,
    /// R level.
    pub clear: f64,
    /// Retract to the level before the cycle (G98).
    pub to_initial: bool,
}

impl Cycle {
    /// The CYCLE record at one of its words.
    pub fn due_to(&self, word: u16) -> Cause {
        Cause { word, ..self.cause }
    }
}

impl HoleLevels {
    /// Where the tool stands after the hole.
    pub fn rest(self, cycle: &Cycle) -> f64 {
        if self.to_initial { cycle.initial.unwrap_or(self.clear) } else { self.clear }
    }
}

/// Takes the cycle, or ends it.
///
/// # Errors
/// A kind or couplet that is not known, a missing depth, feed or step.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if form.any_of(&[w::OFF, w::NOMORE]).is_some() {
        form.finish(post);
        return off(post);
    }
    if record.data == [Word::Minor(w::INIT)] {
        return Ok(());
    }
    let cycle = read(post, &mut form)?;
    form.finish(post);
    if let Some(old) = post.state.cycle.take() {
        let differs = old.in_force.is_some();
        post.state.cycle = Some(Cycle { in_force: None, initial: old.initial, ..cycle });
        return if differs { cancel(post) } else { Ok(()) };
    }
    post.state.cycle = Some(cycle);
    Ok(())
}

fn read(post: &mut Post, form: &mut Form) -> Result<Cycle, Box<Diag>> {
    let word = form.any_of(&[w::BRKCHP, w::DEEP, w::DEEP2]).map(|word| match word {
        w::DEEP2 => w::DEEP,
        word => word,
    });
    form.flag(w::INIT);
    let kind = KINDS
        .iter()
        .find(|kind| Some(kind.word) == word || (word.is_none() && form.flag(kind.word)))
        .ok_or_else(|| form.error("the kind of cycle is not known"))?;
    form.flag(w::DRILL);
    let mut words = CycleWords::default();
    let depth = required(form, &[w::DEPTH, w::FEDTO], "DEPTH", &mut words.depth)?.abs();
    let clear = optional(form, &[w::RAPTO, w::CLEAR], &mut words.clear)?;
    form.couplet(w::CLEAR)?;
    let clear = clear.or(post.commons.dbl_opt(loc::CYCLE_AUTO_CLEARANCE)).unwrap_or(0.0);
    let step = optional(form, &[w::STEP, w::SUBPECK, w::INCR], &mut words.step)?;
    let first_peck = form.couplet(w::FIRST_PECK)?;
    if first_peck.is_some() && first_peck != step {
        post.warn(PostCode::IgnoredPart, "CYCLE: the first peck is as deep as the others".into());
    }
    let retract = optional(form, &[w::RETURN, w::RTRCTO], &mut 0)?;
    let dwell = optional(form, &[w::DWELL], &mut words.dwell)?;
    if depth == 0.0 || clear < 0.0 {
        return Err(cycle_error("DEPTH must not be zero and CLEAR not negative"));
    }
    if kind.pecks && !step.is_some_and(|step| step > 0.0) {
        return Err(cycle_error("STEP must be above zero"));
    }
    let code = post.commons.int_opt(kind.code);
    let feed = feed(post, form)?;
    Ok(Cycle {
        word: kind.word,
        code,
        depth,
        clear,
        retract,
        step: step.filter(|_| kind.pecks),
        dwell: dwell.or(post.commons.dbl_opt(kind.dwell)).unwrap_or(0.0),
        feed,
        initial: level(post),
        cause: post.block.cause.whole(),
        words,
        in_force: None,
    })
}

/// The cycle's own feed (unit word and number), else that of FEDRAT.
fn feed(post: &mut Post, form: &mut Form) -> Result<Feed, Box<Diag>> {
    for unit in UNITS {
        if let Some(value) = form.couplet(*unit)? {
            post.due_to(form);
            let feed = fedrat::in_output_units(value, Some(*unit), post);
            post.block.cause.word = 0;
            if feed.value <= 0.0 {
                return Err(cycle_error("the feed must be above zero"));
            }
            return Ok(fedrat::within_limits(post, feed));
        }
    }
    post.state.feed.ok_or_else(|| cycle_error("no feed in the cycle, and no FEDRAT before it"))
}

/// The value of the first of these words, and where in the record it stands.
fn optional(form: &mut Form, words: &[WordId], at: &mut u16) -> Result<Option<f64>, Box<Diag>> {
    for word in words {
        if let Some(value) = form.couplet(*word)? {
            *at = form.last_word();
            return Ok(Some(value));
        }
    }
    Ok(None)
}

fn required(form: &mut Form, words: &[WordId], name: &str, at: &mut u16) -> Result<f64, Box<Diag>> {
    optional(form, words, at)?.ok_or_else(|| cycle_error(&format!("{name} is missing")))
}

fn cycle_error(message: &str) -> Box<Diag> {
    Box::new(Diag::new(PostCode::CycleForm, message))
}

/// Machine Z the tape stands at.
fn level(post: &Post) -> Option<f64> {
    let axis = post.machine.axis(2);
    let value = post.commons.last_output(axis.letter);
    (value != EMPTY).then(|| axis.position(value))
}

/// Carries out the cycle at a hole.
///
/// # Errors
/// A value that does not fit; a tool axis that is not the machine's Z.
pub fn hole(post: &mut Post, target: Target) -> Result<(), Box<Diag>> {
    let Some(cycle) = post.state.cycle.clone() else { return Ok(()) };
    let offset = |by: f64| Target { point: target.point + target.axis * by, ..target };
    let at = post.position_of(target)?;
    let bottom = post.position_of(offset(-cycle.depth))?;
    let clear = post.position_of(offset(cycle.clear))?;
    let sideways = (0..5).any(|axis| axis != 2 && (at[axis] - bottom[axis]).abs() > 1e-6);
    if sideways {
        return Err(cycle_error("the hole does not run along the machine's Z axis"));
    }
    post.state.point = Some(target.point);
    post.state.axis = target.axis;
    let levels = HoleLevels {
        bottom: bottom[2],
        clear: clear[2],
        to_initial: raise(post, &cycle, at[2], clear[2])?,
    };
    // Raising the tool sets the level to return to.
    let cycle = post.state.cycle.clone().unwrap_or(cycle);
    if cycle.code.is_some() {
        block(post, &cycle, &at, levels)?;
    } else {
        cycle_expand::hole(post, &cycle, &at, levels)?;
    }
    let rest = levels.rest(&cycle);
    let axis = *post.machine.axis(2);
    post.commons.set_last_output(axis.letter, axis.value(rest)?);
    if let Some(cycle) = &mut post.state.cycle {
        cycle.in_force = Some(levels);
    }
    Ok(())
}

/// Brings the tool up before it goes to the hole, when it stands below the
/// hole's R level or below the level to return to. Says whether the cycle
/// returns to the level before it.
fn raise(post: &mut Post, cycle: &Cycle, z: f64, clear: f64) -> Result<bool, Box<Diag>> {
    let Some(mut here) = level(post) else { return Ok(false) };
    let want = match cycle.retract {
        Some(above) if above > 0.0 => clear.max(z + above),
        _ => clear,
    };
    if here < want - 1e-9 {
        cancel(post)?;
        let mut position = Position::default();
        position[2] = want;
        post.because(cycle.cause, |post| post.rapid_to(&position, Z))?;
        here = want;
        if let Some(cycle) = &mut post.state.cycle {
            cycle.initial = Some(want);
        }
    }
    let initial = post.state.cycle.as_ref().and_then(|cycle| cycle.initial).unwrap_or(here);
    Ok(match cycle.retract {
        None => false,
        Some(above) if above > 0.0 => initial >= want && want > clear + 1e-9,
        Some(_) => true,
    })
}

/// Writes the cycle's block: all words at the first hole, later only what has
/// changed.
fn block(
    post: &mut Post,
    cycle: &Cycle,
    at: &Position,
    levels: HoleLevels,
) -> Result<(), Box<Diag>> {
    let repeats = post.state.cycle.as_ref().and_then(|now| now.in_force) == Some(levels)
        && post.commons.int(loc::CYCLE_DATA_MODAL) != 1;
    if repeats {
        if post.axis_words(at, XY | ROTARY)? {
            return post.write_motion();
        }
        for axis in [0, 1] {
            post.axis_word(axis, at[axis], true)?;
        }
        return post.write_motion();
    }
    let Some(code) = cycle.code else { return Ok(()) };
    if post.commons.int(loc::CYCLE_RETURN_CODES) == 2 {
        let location = if levels.to_initial {
            loc::CYCLE_RETURN_INITIAL_CODE
        } else {
            loc::CYCLE_RETURN_CLEAR_CODE
        };
        let code = post.code(location, "the return level")?;
        post.because(cycle.cause, |post| post.block.g(code));
    }
    post.because(cycle.cause, |post| post.block.g(code));
    for axis in [0, 1] {
        post.axis_word(axis, at[axis], true)?;
    }
    for axis in [3, 4] {
        if post.machine.has_rotary(axis) {
            post.axis_word(axis, at[axis], false)?;
        }
    }
    depth_words(post, cycle, levels)?;
    data_words(post, cycle)?;
    post.write_motion()?;
    post.state.motion = None;
    Ok(())
}

/// Z and R: absolute, or as increments from the level before and from R.
fn depth_words(post: &mut Post, cycle: &Cycle, levels: HoleLevels) -> Result<(), Box<Diag>> {
    let start = cycle.initial.unwrap_or(levels.clear);
    let axis = *post.machine.axis(2);
    let (bottom, clear) = (axis.value(levels.bottom)?, axis.value(levels.clear)?);
    let (z, r) = match post.commons.int(loc::CYCLE_DEPTH_OUTPUT) {
        2 => (bottom - clear, clear - axis.value(start)?),
        3 => ((bottom - clear).abs(), (clear - axis.value(start)?).abs()),
        _ => (bottom, clear),
    };
    post.because(cycle.due_to(cycle.words.depth), |post| post.word(axis.letter, z))?;
    post.because(cycle.due_to(cycle.words.clear), |post| post.word(R, r))
}

/// Peck, dwell and feed.
fn data_words(post: &mut Post, cycle: &Cycle) -> Result<(), Box<Diag>> {
    if let Some(step) = cycle.step {
        let letter = post.letter(loc::CYCLE_STEP_ADDRESS, "the peck")?;
        post.because(cycle.due_to(cycle.words.step), |post| post.word(letter, step))?;
    }
    if cycle.dwell > 0.0 {
        let letter = post.letter(loc::CYCLE_DWELL_ADDRESS, "the dwell of a cycle")?;
        let value = delay::in_seconds(post, cycle.dwell);
        post.because(cycle.due_to(cycle.words.dwell), |post| post.word(letter, value))?;
    }
    with_feed(post, cycle.feed, |post| {
        post.state.force_feed = true;
        post.feed_words()
    })
}

/// Runs `write` with the cycle's feed in place of that of FEDRAT.
pub fn with_feed(
    post: &mut Post,
    feed: Feed,
    write: impl FnOnce(&mut Post) -> Result<(), Box<Diag>>,
) -> Result<(), Box<Diag>> {
    let outer = post.state.feed.replace(feed);
    let result = write(post);
    post.state.feed = outer;
    result
}

/// Ends the cycle.
///
/// # Errors
/// The machine has no code that cancels a cycle.
pub fn off(post: &mut Post) -> Result<(), Box<Diag>> {
    cancel(post)?;
    post.state.cycle = None;
    Ok(())
}

/// Writes the code that cancels the control's cycle, if one is in force; the
/// next hole says the whole cycle again.
///
/// # Errors
/// As [`off`].
pub fn cancel(post: &mut Post) -> Result<(), Box<Diag>> {
    let in_force = post.state.cycle.as_mut().and_then(|cycle| {
        let code = cycle.code;
        cycle.in_force.take().and(code)
    });
    if in_force.is_none() {
        return Ok(());
    }
    let code = post.code(loc::CYCLE_OFF_CODE, "CYCLE/OFF")?;
    post.block.g_of_record(code);
    post.state.motion = None;
    post.write_block()
}
