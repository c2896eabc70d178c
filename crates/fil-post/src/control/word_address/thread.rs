//! The threading cycles of lathes: G92 once a pass, G76 in two blocks or in one.

use std::fmt::Write as _;

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations::{self as loc, ThreadCycle};
use fil_machine::modes::{FeedMode, Plane};
use fil_machine::number::NumberFormat;
use fil_machine::rounding::Rounding;
use fil_machine::{FunctionCode, Letter, letters};

use super::motion::{self, Motion};
use super::{modes, osp_thread};
use crate::control::{Control, program};
use crate::control_state::{Source, modal};
use crate::errors::PostCode;
use crate::operation::{Thread, ThreadPasses};
use crate::path::thread::{Shape, cycle_of, go_above, least_depth, on_machine};
use crate::post::Post;

/// L of LinuxCNC's G76: the passes lean at their end.
const EXIT: f64 = 2.0;

/// Lengths nearer to zero than this are zero, mm or inch.
const NOTHING: f64 = 1e-9;

/// Writes the cycle of one start, from where the tool stands clear; false where the machine
/// has none that says all of the thread.
///
/// # Errors
/// A value that does not fit its address; a frame that turns the thread out of X and Z.
pub fn cycle(post: &mut Post, thread: &Thread, shape: &Shape, start: u32) -> Result<bool> {
    let cycle = cycle_of(post, thread, shape);
    if matches!(cycle, ThreadCycle::SinglePasses | ThreadCycle::Cycle97OfASinumerik) {
        return Ok(false);
    }
    let code = post.control.code(loc::THREAD_CYCLE_CODE, "the cycle of a thread")?;
    let ends = Ends::of(post, thread, shape, start)?;
    motion::ready(&mut post.control)?;
    // The cycles of a lathe count in the plane in force, which a live tool or a text has left.
    let begins = program::state_at_start(&post.control.commons, None);
    let other = post.control.state.get(modal::PLANE).filter(|plane| *plane != Plane::Zx);
    if begins.get(modal::PLANE).or(other).is_some() {
        modes::plane_of_its_own(&mut post.control, Plane::Zx)?;
    }
    if cycle != ThreadCycle::CycleOfAllPassesOfLinuxcnc {
        motion::lead_mode(&mut post.control, thread.lead.cause)?;
    }
    // A lead is a way a turn.
    post.control.tables.format_feed(FeedMode::PerRevolution);
    post.control.flush_waiting()?;
    let leaves = shape.leaves();
    if cycle != ThreadCycle::CycleOfAllPassesOfLinuxcnc {
        switch_way_out(&mut post.control, thread, leaves > 0.0)?;
    }
    match cycle {
        ThreadCycle::SinglePasses | ThreadCycle::Cycle97OfASinumerik => return Ok(false),
        ThreadCycle::CycleOfOnePass => one_pass_each(post, thread, (shape, start), (&ends, code))?,
        ThreadCycle::CycleOfAllPassesInTwoBlocks => {
            let tenths = shape.chamfer_in_tenths(thread).unwrap_or(0);
            two_blocks(post, thread, tenths, (&ends, code))?;
        }
        ThreadCycle::CycleOfAllPassesInOneBlock => one_block(post, thread, &ends, code)?,
        ThreadCycle::CycleOfAllPassesOfLinuxcnc => linuxcnc(post, thread, leaves, (&ends, code))?,
        ThreadCycle::G71OfAnOsp => osp_thread::write(&mut post.control, thread, shape, ends.root)?,
    }
    let [x, z] = ends.begin;
    match cycle {
        ThreadCycle::SinglePasses | ThreadCycle::CycleOfOnePass => {}
        // LinuxCNC leaves the tool clear of the end of the thread.
        ThreadCycle::CycleOfAllPassesOfLinuxcnc => {
            stands_at(&mut post.control, [x, ends.root[1]])?;
        }
        _ => stands_at(&mut post.control, [x, z])?,
    }
    Ok(true)
}

/// Says whether the cycles leave a thread before its end, on a machine that switches it by M
/// codes. Each cycle has its own: what a text or a skipped block said before does not count.
fn switch_way_out(control: &mut Control, thread: &Thread, leaves: bool) -> Result<()> {
    let at = if leaves { loc::THREAD_CHAMFER_ON_CODE } else { loc::THREAD_CHAMFER_OFF_CODE };
    let Some(code) = control.code_if_any(at) else { return Ok(()) };
    control.because(thread.lead.cause, |control| {
        control.m(code);
        control.write_block()
    })
}

/// Where the thread lies in the machine, X and Z, X as a radius.
struct Ends {
    begin: [f64; 2],
    crest: [[f64; 2]; 2],
    root: [f64; 2],
    first: f64,
    least: f64,
    springs: u32,
    /// Radius at the start less that at the end, as the tape counts it.
    taper: f64,
}

impl Ends {
    fn of(post: &mut Post, thread: &Thread, shape: &Shape, start: u32) -> Result<Ends> {
        let begin = on_machine(post, shape.shifted(start))?;
        let crest = [on_machine(post, shape.crest_of(start))?, on_machine(post, shape.crest[1])?];
        let root = on_machine(post, shape.root_end(thread.depth))?;
        let [across, along] = [root[0] - crest[1][0], root[1] - crest[1][1]];
        if along.abs() > 1e-6 || (across.abs() - thread.depth).abs() > 1e-6 {
            return PostCode::Thread.err("TRANS turns the thread out of the plane of X and Z");
        }
        // The control itself makes a pass no shallower than the least depth, if it has one.
        let first = match thread.passes {
            ThreadPasses::First(first) => first.min(thread.depth),
            ThreadPasses::Count(_) => shape.depths.first().copied().unwrap_or(thread.depth),
        };
        let least = least_depth(post);
        let taper = post.control.tables.axis(0).length(crest[0][0] - crest[1][0]);
        Ok(Ends { begin, crest, root, first, least, springs: thread.springs, taper })
    }
}

/// G92 X Z R F for each pass.
fn one_pass_each(
    post: &mut Post,
    thread: &Thread,
    (shape, start): (&Shape, u32),
    (ends, code): (&Ends, FunctionCode),
) -> Result<()> {
    let taper = Some(ends.taper).filter(|taper| taper.abs() > NOTHING);
    let letter = match taper {
        Some(_) => Some(post.control.letter(loc::THREAD_TAPER_ADDRESS, "the taper of a thread")?),
        None => None,
    };
    for depth in &shape.depths {
        go_above(post, thread, shape.above(start, *depth))?;
        let end = on_machine(post, shape.root_end(*depth))?;
        let control = &mut post.control;
        let position = [end[0], 0.0, end[1], 0.0, 0.0];
        let at = Motion::new(position, AxisSet::LINEAR, 0);
        control.because(thread.lead.cause, |control| {
            control.g_of_record(code);
            motion::axis_word(control, 0, &at)?;
            motion::axis_word(control, 2, &at)?;
            if let (Some(letter), Some(taper)) = (letter, taper) {
                control.word_rounded(letter, taper, Rounding::Nearest)?;
                control.state.doubt(letter);
            }
            motion::lead_word(control, &thread.lead)?;
            control.write_block()
        })?;
        // Each pass comes back to where it began.
        let begin = on_machine(post, shape.above(start, *depth))?;
        stands_at(&mut post.control, begin)?;
    }
    Ok(())
}

/// G76 P(springs, run-out, angle) Q(least) R(allowance), G76 X Z R P Q F.
fn two_blocks(
    post: &mut Post,
    thread: &Thread,
    chamfer: u32,
    (ends, code): (&Ends, FunctionCode),
) -> Result<()> {
    let control = &mut post.control;
    let unit = if control.is_metric() { 1e3 } else { 1e4 };
    let springs = ends.springs.clamp(1, 99);
    if springs != ends.springs.max(1) {
        return PostCode::Thread
            .err(format!("{} passes at full depth, and G76 has 99", ends.springs));
    }
    let mut setup = Line::new(control, code)?;
    setup.raw('P', &format!("{springs:02}{chamfer:02}{:02}", thread.angle as u32));
    setup.raw('Q', &steps(ends.least, unit, false)?);
    setup.raw('R', "0");
    let mut cut = Line::new(control, code)?;
    cut.axis(0, ends.root[0])?;
    cut.axis(2, ends.root[1])?;
    if ends.taper.abs() > NOTHING {
        cut.word('R', ends.taper, Rounding::Nearest)?;
    }
    cut.raw('P', &steps(thread.depth, unit, true)?);
    cut.raw('Q', &steps(ends.first, unit, true)?);
    cut.lead('F', thread.lead.value)?;
    let (setup, cut) = (setup.text, cut.text);
    control.because(thread.lead.cause, |control| {
        control.write_own_text(&setup)?;
        control.write_own_text(&cut)
    })
}

/// G76 X Z I K D A F.
fn one_block(post: &mut Post, thread: &Thread, ends: &Ends, code: FunctionCode) -> Result<()> {
    let control = &mut post.control;
    let mut line = Line::new(control, code)?;
    line.axis(0, ends.root[0])?;
    line.axis(2, ends.root[1])?;
    if ends.taper.abs() > NOTHING {
        line.word('I', ends.taper, Rounding::Nearest)?;
    }
    line.word('K', thread.depth, Rounding::Lead)?;
    line.word('D', ends.first, Rounding::Rate)?;
    line.word('A', thread.angle, Rounding::Nearest)?;
    line.lead('F', thread.lead.value)?;
    let text = line.text;
    control.because(thread.lead.cause, |control| control.write_own_text(&text))
}

/// LinuxCNC's G76 P Z I J R K Q H: I, J and K count as X does. E is the way along Z on which each
/// pass rises by the whole height, L2 that it does so at the end.
fn linuxcnc(
    post: &mut Post,
    thread: &Thread,
    leaves: f64,
    (ends, code): (&Ends, FunctionCode),
) -> Result<()> {
    let control = &mut post.control;
    let axis = *control.tables.axis(0);
    let x = |radius: f64| axis.value(radius);
    let drive = x(ends.begin[0])?;
    let crest = x(ends.crest[0][0])?;
    let root = x(ends.root[0])?;
    let factor = (root - crest) / (ends.root[0] - ends.crest[0][0]);
    let mut line = Line::new(control, code)?;
    line.lead('P', thread.lead.value)?;
    line.axis(2, ends.root[1])?;
    line.word('I', crest - drive, Rounding::Nearest)?;
    line.word('J', (ends.first * factor).abs(), Rounding::Rate)?;
    line.word('R', 2.0, Rounding::Nearest)?;
    line.word('K', (root - crest).abs(), Rounding::Lead)?;
    line.word('Q', thread.angle / 2.0, Rounding::Nearest)?;
    line.word('H', f64::from(ends.springs), Rounding::Exact)?;
    if leaves > 0.0 {
        line.word('E', leaves, Rounding::Lead)?;
        line.word('L', EXIT, Rounding::Exact)?;
    }
    let text = line.text;
    control.because(thread.lead.cause, |control| control.write_own_text(&text))
}

/// A length in smallest steps, without a point.
///
/// # Errors
/// One that rounding would change too much, or make zero.
fn steps(length: f64, unit: f64, exact: bool) -> Result<String> {
    let steps = (length * unit).round();
    if exact && ((steps / unit - length).abs() > 0.01 * length || steps < 1.0) {
        return PostCode::Thread
            .err(format!("{length} can't be said in whole steps of the control"));
    }
    Ok(format!("{steps:.0}"))
}

/// A block whose words follow each other in the order of the cycle.
pub(super) struct Line<'c> {
    control: &'c Control,
    pub(super) text: String,
}

impl<'c> Line<'c> {
    pub(super) fn new(control: &'c Control, code: FunctionCode) -> Result<Self> {
        let mut line = Line { control, text: String::new() };
        line.function(letters::G, code)?;
        Ok(line)
    }

    /// A function, preparatory or auxiliary.
    pub(super) fn function(&mut self, letter: Letter, code: FunctionCode) -> Result<()> {
        let addresses = &self.control.tables.addresses;
        let Some(position) = addresses.position(letter) else {
            return PostCode::NoCode.err(format!("{letter} is off the tape"));
        };
        let slot = addresses.slot(position);
        self.put(slot.character, |out| code.write(&slot.format, out));
        Ok(())
    }

    fn put(&mut self, character: u8, write: impl FnOnce(&mut Vec<u8>)) {
        let mut word = vec![character];
        write(&mut word);
        self.blank();
        self.text.push_str(&String::from_utf8_lossy(&word));
    }

    fn blank(&mut self) {
        if self.control.tables.addresses.blank && !self.text.is_empty() {
            self.text.push(' ');
        }
    }

    /// Digits as they are.
    fn raw(&mut self, letter: char, digits: &str) {
        self.blank();
        let _ = write!(self.text, "{letter}{digits}");
    }

    /// A value in the format of its letter.
    pub(super) fn word(&mut self, letter: char, value: f64, rounding: Rounding) -> Result<()> {
        let letter = Letter::of(letter as u8);
        self.control.require_letter(letter)?;
        let format = self.control.tables.addresses.format(letter).copied();
        self.formatted(letter, value, rounding, format)
    }

    /// A lead, in the format of leads.
    pub(super) fn lead(&mut self, letter: char, value: f64) -> Result<()> {
        let letter = Letter::of(letter as u8);
        self.control.require_letter(letter)?;
        let format = self.control.tables.lead_format(letter);
        self.formatted(letter, value, Rounding::Lead, format).map_err(motion::of_lead)
    }

    fn formatted(
        &mut self,
        letter: Letter,
        value: f64,
        rounding: Rounding,
        format: Option<NumberFormat>,
    ) -> Result<()> {
        let addresses = &self.control.tables.addresses;
        let (Some(position), Some(format)) = (addresses.position(letter), format) else {
            return Ok(());
        };
        let character = addresses.slot(position).character;
        let scaled = rounding.scale(value, &format);
        let scaled = scaled.map_err(|diag| crate::block::named(diag, letter))?;
        self.put(character, |out| format.write(scaled, out));
        Ok(())
    }

    /// An axis word.
    pub(super) fn axis(&mut self, number: usize, position: f64) -> Result<()> {
        let axis = self.control.tables.axis(number);
        let letter = char::from(axis.letter.byte());
        let scaled = axis.value(position)?;
        self.word(letter, scaled, Rounding::Nearest)
    }
}

/// After the cycle the tool is here.
fn stands_at(control: &mut Control, [x, z]: [f64; 2]) -> Result<()> {
    for (number, position) in [(0, x), (2, z)] {
        let axis = *control.tables.axis(number);
        control.commons.set_last_output(axis.letter, axis.value(position)?);
        control.state.trust(axis.letter);
    }
    control.state.forget(modal::MOTION, Source::Post);
    motion::end_lead(control);
    Ok(())
}
