//! The threading cycles of lathes: G92 once a pass, G76 in two blocks or in one.

use std::fmt::Write as _;

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations::{self as loc, ThreadCycle};
use fil_machine::modes::{FeedMode, Plane};
use fil_machine::number::NumberFormat;
use fil_machine::rounding::Rounding;
use fil_machine::{FunctionCode, Letter, letters};

use super::motion;
use super::{modes, osp_thread};
use crate::control::thread_cycle::least_depth;
use crate::control::{Control, program};
use crate::control_state::{Source, modal};
use crate::errors::PostCode;
use crate::operation::motion::Motion;
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Thread, ThreadPasses};

/// L of LinuxCNC's G76: the passes lean at their end.
const EXIT: f64 = 2.0;

/// Lengths nearer to zero than this are zero, mm or inch.
const NOTHING: f64 = 1e-9;

/// True for the cycles of this family.
pub fn has_cycle(cycle: ThreadCycle) -> bool {
    !matches!(cycle, ThreadCycle::SinglePasses | ThreadCycle::Cycle97OfASinumerik)
}

/// Writes the cycle of one start, from where the tool stands clear; of a cycle of one pass what
/// comes before the passes.
///
/// # Errors
/// A value that does not fit its address.
pub fn cycle(
    control: &mut Control,
    thread: &Thread,
    shape: &Shape,
    cycle: ThreadCycle,
    ends: &Ends,
) -> Result<()> {
    let code = control.code(loc::THREAD_CYCLE_CODE, "the cycle of a thread")?;
    motion::ready(control)?;
    // The cycles of a lathe count in the plane in force, which a live tool or a text has left.
    let begins = program::state_at_start(&control.commons, None);
    let other = control.state.get(modal::PLANE).filter(|plane| *plane != Plane::Zx);
    if begins.get(modal::PLANE).or(other).is_some() {
        modes::plane_of_its_own(control, Plane::Zx)?;
    }
    let of_linuxcnc = cycle == ThreadCycle::CycleOfAllPassesOfLinuxcnc;
    if !of_linuxcnc {
        motion::lead_mode(control, thread.lead.cause)?;
    }
    // A lead is a way a turn.
    control.tables.format_feed(FeedMode::PerRevolution);
    control.flush_waiting()?;
    let leaves = shape.leaves();
    if !of_linuxcnc {
        switch_way_out(control, thread, leaves > 0.0)?;
    }
    let cuts = Cuts::of(control, thread, shape, ends);
    let lines = match cycle {
        ThreadCycle::SinglePasses
        | ThreadCycle::Cycle97OfASinumerik
        | ThreadCycle::CycleOfOnePass => return Ok(()),
        ThreadCycle::CycleOfAllPassesInTwoBlocks => {
            let tenths = shape.chamfer_in_tenths(thread).unwrap_or(0);
            two_blocks(control, thread, tenths, (ends, &cuts, code))?
        }
        ThreadCycle::CycleOfAllPassesInOneBlock => {
            vec![one_block(control, thread, (ends, &cuts, code))?]
        }
        ThreadCycle::CycleOfAllPassesOfLinuxcnc => {
            vec![linuxcnc(control, thread, leaves, (ends, &cuts, code))?]
        }
        ThreadCycle::G71OfAnOsp => vec![osp_thread::text(control, thread, shape, ends.root)?],
    };
    control.because(thread.lead.cause, |control| {
        lines.iter().try_for_each(|line| control.write_own_text(line))
    })?;
    let [x, z] = ends.begin;
    // LinuxCNC leaves the tool clear of the end of the thread.
    stands_at(control, [x, if of_linuxcnc { ends.root[1] } else { z }])
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

/// What the words of the cycles say of the passes.
struct Cuts {
    first: f64,
    least: f64,
    springs: u32,
    /// Radius at the start less that at the end, as the tape counts it.
    taper: f64,
}

impl Cuts {
    fn of(control: &Control, thread: &Thread, shape: &Shape, ends: &Ends) -> Cuts {
        // The control itself makes a pass no shallower than the least depth, if it has one.
        let first = match thread.passes {
            ThreadPasses::First(first) => first.min(thread.depth),
            ThreadPasses::Count(_) => shape.depths.first().copied().unwrap_or(thread.depth),
        };
        let least = least_depth(control);
        Cuts { first, least, springs: thread.springs, taper: taper(control, ends) }
    }
}

fn taper(control: &Control, ends: &Ends) -> f64 {
    control.tables.axis(0).length(ends.crest[0][0] - ends.crest[1][0])
}

/// G92 X Z R F: one pass of a start, from where the tool stands to an end in X and Z of the
/// machine, and back.
///
/// # Errors
/// A value that does not fit its address.
pub fn one_pass(
    control: &mut Control,
    thread: &Thread,
    ends: &Ends,
    [begin, end]: [[f64; 2]; 2],
) -> Result<()> {
    let code = control.code(loc::THREAD_CYCLE_CODE, "the cycle of a thread")?;
    let taper = Some(taper(control, ends)).filter(|taper| taper.abs() > NOTHING);
    let letter = match taper {
        Some(_) => Some(control.letter(loc::THREAD_TAPER_ADDRESS, "the taper of a thread")?),
        None => None,
    };
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
    stands_at(control, begin)
}

/// G76 P(springs, run-out, angle) Q(least) R(allowance), G76 X Z R P Q F.
fn two_blocks(
    control: &Control,
    thread: &Thread,
    chamfer: u32,
    (ends, cuts, code): (&Ends, &Cuts, FunctionCode),
) -> Result<Vec<String>> {
    let unit = if control.is_metric() { 1e3 } else { 1e4 };
    let springs = cuts.springs.clamp(1, 99);
    if springs != cuts.springs.max(1) {
        return PostCode::Thread
            .err(format!("{} passes at full depth, and G76 has 99", cuts.springs));
    }
    let mut setup = Line::new(control, code)?;
    setup.raw('P', &format!("{springs:02}{chamfer:02}{:02}", thread.angle as u32));
    setup.raw('Q', &steps(cuts.least, unit, false)?);
    setup.raw('R', "0");
    let mut cut = Line::new(control, code)?;
    cut.axis(0, ends.root[0])?;
    cut.axis(2, ends.root[1])?;
    if cuts.taper.abs() > NOTHING {
        cut.word('R', cuts.taper, Rounding::Nearest)?;
    }
    cut.raw('P', &steps(thread.depth, unit, true)?);
    cut.raw('Q', &steps(cuts.first, unit, true)?);
    cut.lead('F', thread.lead.value)?;
    Ok(vec![setup.text, cut.text])
}

/// G76 X Z I K D A F.
fn one_block(
    control: &Control,
    thread: &Thread,
    (ends, cuts, code): (&Ends, &Cuts, FunctionCode),
) -> Result<String> {
    let mut line = Line::new(control, code)?;
    line.axis(0, ends.root[0])?;
    line.axis(2, ends.root[1])?;
    if cuts.taper.abs() > NOTHING {
        line.word('I', cuts.taper, Rounding::Nearest)?;
    }
    line.word('K', thread.depth, Rounding::Rate)?;
    line.word('D', cuts.first, Rounding::Rate)?;
    line.word('A', thread.angle, Rounding::Nearest)?;
    line.lead('F', thread.lead.value)?;
    Ok(line.text)
}

/// LinuxCNC's G76 P Z I J R K Q H: I, J and K count as X does. E is the way along Z on which each
/// pass rises by the whole height, L2 that it does so at the end.
fn linuxcnc(
    control: &Control,
    thread: &Thread,
    leaves: f64,
    (ends, cuts, code): (&Ends, &Cuts, FunctionCode),
) -> Result<String> {
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
    line.word('J', (cuts.first * factor).abs(), Rounding::Rate)?;
    line.word('R', 2.0, Rounding::Nearest)?;
    line.word('K', (root - crest).abs(), Rounding::Rate)?;
    line.word('Q', thread.angle / 2.0, Rounding::Nearest)?;
    line.word('H', f64::from(cuts.springs), Rounding::Exact)?;
    if leaves > 0.0 {
        line.word('E', leaves, Rounding::Rate)?;
        line.word('L', EXIT, Rounding::Exact)?;
    }
    Ok(line.text)
}

/// A length in smallest steps, without a point.
///
/// # Errors
/// One that rounding would change too much, or make zero.
fn steps(length: f64, unit: f64, exact: bool) -> Result<String> {
    let steps = (length * unit).round();
    if exact && ((steps / unit - length).abs() > 0.01 * length || steps < 1.0) {
        return PostCode::Thread.err(format!("{length} is not a whole number of control steps"));
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
