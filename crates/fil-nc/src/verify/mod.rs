//! Back-check: does an NC program do what the CL file asks for?
//!
//! [`ClPath`] reads the CL file without the post, the interpreter reads the program
//! without the writer; `verifier` goes along both at once, `window` keeps what it looks
//! ahead, `align` finds where they part.
//! What the machine's settings lay down where the CL file leaves it open (when codes
//! stand, what the last digit is) comes from [`Settings`].

mod ahead;
mod align;
mod arc;
mod auxiliaries;
mod away;
mod beside;
mod between;
mod blocks;
mod cl_path;
mod clamps;
mod compensation_plane;
mod counted;
mod delayed;
mod departure;
mod division;
mod event_filter;
mod expected_step;
mod gap;
mod hole;
mod hole_live;
mod hole_out;
mod hole_tip;
mod inserted;
mod left_out;
mod lines;
mod machine_blocks;
mod machine_ends;
mod modes;
mod parts;
mod passing;
mod places;
mod programs;
mod rapid_lean;
mod rapid_order;
mod rate;
mod report;
mod reposition;
mod restart;
mod rotary_rules;
mod rules;
mod say;
mod settings;
mod statements;
mod thread;
mod thread_gauge;
mod thread_turns;
mod tip_end;
mod tools;
mod turning;
mod turning_settings;
mod unasked;
mod verifier;
mod window;
mod zones;

use fil_cl::Reader;
use fil_diag::Diag;
use fil_machine::locations::{self as loc, CycleRapto};
use fil_machine::{Commons, Unit};

use crate::dialect::Habit;
use crate::errors::NcCode;
use crate::events::Events;
use crate::interpret::PassedOver;
use crate::source::Source;
use crate::work_offsets::work_offset;
use between::Watch;
use blocks::OwnBlocks;

pub use between::{Between, Peak};
pub use cl_path::{ClPath, FrameWords, ignored_words, knows_word};
pub use expected_step::{
    Arc, CoolantKind, Effect, End, ExpectedStep, GivenOffset, Hole, Step, WholeThread,
};
pub use programs::{Programs, Unfollowed, compare_programs, compare_words};
pub use report::{Deviation, Finding, FindingKind, Report, Unverified, Verdict};
pub use settings::{Due, Quantity, Settings, Tolerances};

/// The inputs of a back-check.
pub struct Check<'a> {
    /// The CL file.
    pub cl: Reader<'a>,
    /// Its name in messages.
    pub cl_name: &'a str,
    /// Its unit, where it does not say it itself.
    pub unit: Option<Unit>,
    /// The text of the program.
    pub nc: &'a Source<'a>,
    /// Its name in messages.
    pub nc_name: &'a str,
    /// What the program does.
    pub events: &'a mut dyn Events,
    /// Its lines that the events were made without; each must be an author's.
    pub passed: &'a PassedOver,
    /// The machine.
    pub commons: &'a Commons,
    /// What is allowed.
    pub allowed: Allowed,
    /// The events are those with the blocks left out that may be skipped, so what stands
    /// between OPSKIP/ON and OPSKIP/OFF is not asked for.
    pub skips_blocks: bool,
}

/// What a program may be off by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Allowed {
    /// Besides the last digit of each address, mm and degrees; `None` for nothing.
    pub tolerance: Option<f64>,
    /// Of the tip between the ends of motions that turn the machine, mm; `None` for
    /// what LINTOL of the CL file says, or anything.
    pub between: Option<f64>,
    /// Work offsets that the program may choose where the CL file names none, by their numbers
    /// ([`work_offset`]: 54 for G54).
    pub offsets: Vec<u32>,
    /// Lines of the CL file whose records are not asked for, in order: no program without
    /// scripts can have them.
    pub without: Vec<u32>,
}

/// Compares a program with the CL file it should come from.
///
/// # Errors
/// A program that can't be followed, but for what an author wrote; a CL file that can't be read, a machine that makes no sense, a program that has
/// next to nothing in common with the CL file.
pub fn verify(check: Check<'_>) -> Result<Report, Box<Diag>> {
    let settings = Settings::new(check.commons, check.allowed.tolerance)?;
    let rapto_is_level = check.commons.read(loc::CYCLE_RAPTO) == CycleRapto::AboveTheHole;
    let path = ClPath::new(check.cl, check.cl_name, settings.input_shift())
        .with_rapto_as_level(rapto_is_level)
        .ending_by(settings.end_codes())
        .with_rigid_taps(check.commons.read(loc::CYCLE_TAP_RIGID));
    let path = path.on_machine(settings.shift_along(), settings.matrix_leaves_axis());
    let path = path.through(settings.input_matrix());
    let path = path.with_frame_words(settings.frame_words());
    let path = path.clear_of_threads_by(settings.thread_clearance());
    let path = path.turning(settings.is_lathe());
    let path = path.naming_tools(settings.dialect.has(Habit::NamesTools));
    let path = path.in_unit(check.unit).leaving_out(check.skips_blocks);
    let path = path.without(check.allowed.without.clone());
    let path = path.saying_signs(settings.has_texts_at_places());
    let nc = (check.nc, check.nc_name);
    let around = [settings.blocks_around_changes(), settings.blocks_at_places()].concat();
    let marks = &settings.dialect.text.marks;
    let own = OwnBlocks::new(nc, marks, &settings.own_blocks(), &around)?;
    let watch = Watch::new(check.allowed.between);
    let mut verifier = verifier::Verifier::new(path, check.events, own, &settings, watch);
    verifier.begin_with_blocks(check.skips_blocks);
    let of_machine = check.commons.allowed_offsets().iter().filter_map(|name| work_offset(name));
    verifier.expected.allow_offsets(check.allowed.offsets.into_iter().chain(of_machine).collect());
    let report = verifier.all(check.passed)?;
    refuse_another_part(&report)?;
    Ok(report)
}

/// Motions that must be compared before a program counts as one of another part.
const FEW: u64 = 6;

/// A program that makes next to none of the motions is one of another part.
///
/// # Errors
/// E0941 for such a program.
pub fn refuse_another_part(report: &Report) -> Result<(), Box<Diag>> {
    let compared = report.compared - report.left_out;
    if compared < FEW || report.matched * 10 >= compared {
        return Ok(());
    }
    let message = format!(
        "{} of the {} motions of the CL file are in the program",
        report.matched, report.compared
    );
    let mut diag = Diag::new(NcCode::AnotherPart, message);
    diag.notes.extend(report.findings.iter().take(3).map(ToString::to_string));
    Err(Box::new(diag))
}
