//! A program and its runs.

use std::ffi::{c_char, c_void};
use std::io::Cursor;
use std::path::Path;
use std::ptr;

use filpost::cl::ClDialect;
use filpost::cl::reader::Options as Reading;
use filpost::nc::verify::Allowed;
use filpost::verify::{NcProgram, as_json};
use filpost::{CancelToken, Run};

use crate::block::{TakeBlock, hand_out};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::error::{Error, Wrong};
use crate::guard::{guarded, guarded_or};
use crate::output::Output;
use crate::pointer;
use crate::text::{self, Text};

/// A machine with its compiled FIL. It never changes: any number of threads may use it at the
/// same time; it is freed when none does.
pub struct Program {
    program: filpost::Program,
    warnings: Diagnostics,
}

impl Program {
    pub fn new(program: filpost::Program) -> Self {
        let warnings = Diagnostics::new(program.warnings());
        Program { program, warnings }
    }
}

/// A switch that stops runs from another thread.
pub struct Cancel(CancelToken);

/// The options of a run; NULL in place of it, and NULL in its fields, are as without.
#[repr(C)]
pub struct Options {
    /// What messages call the CL file.
    pub cl_name: *const c_char,
    /// The dialect of the CL file where it is not recognized, `nx`.
    pub dialect: *const c_char,
    /// `mm` or `inch`, for a CL file that does not say it.
    pub units: *const c_char,
    /// A switch that stops the run.
    pub cancel: *const Cancel,
}

/// A run with its options.
///
/// # Safety
/// `program` and, where they are not NULL, `options` and its fields are live.
unsafe fn start<'a>(program: *const Program, options: *const Options) -> Result<Run<'a>, Wrong> {
    // SAFETY: the caller promises what `handle` asks for.
    let program = unsafe { pointer::handle(program, "program") }?;
    let mut run = program.program.start();
    // SAFETY: the caller promises what `handle` asks for; NULL is no mistake here.
    let Ok(options) = (unsafe { pointer::handle(options, "options") }) else { return Ok(run) };
    // SAFETY: the caller promises that the fields are live.
    if let Some(name) = unsafe { pointer::optional_text(options.cl_name, "cl_name") }? {
        run = run.cl_name(name);
    }
    // SAFETY: as above.
    if let Some(name) = unsafe { pointer::optional_text(options.dialect, "dialect") }? {
        let dialect = ClDialect::named(name)
            .ok_or_else(|| Wrong::usage(format!("there is no dialect {name}")))?;
        run = run.cl_options(Reading { dialect: Some(dialect), ..Reading::default() });
    }
    // SAFETY: as above.
    if let Some(name) = unsafe { pointer::optional_text(options.units, "units") }? {
        let unit = filpost::unit_named(name)
            .ok_or_else(|| Wrong::usage(format!("units is {name}, not mm or inch")))?;
        run = run.units(unit);
    }
    // SAFETY: as above.
    if let Ok(cancel) = unsafe { pointer::handle(options.cancel, "cancel") } {
        run = run.cancel(&cancel.0);
    }
    Ok(run)
}

/// Frees a program that no thread uses.
///
/// # Safety
/// `program` is NULL or live, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_program_free(program: *mut Program) {
    // SAFETY: the caller promises what `take` asks for.
    guarded_or((), || drop(unsafe { pointer::take(program) }));
}

/// Number of warnings of building.
///
/// # Safety
/// `program` is live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_program_warning_count(program: *const Program) -> usize {
    guarded_or(0, || {
        // SAFETY: the caller promises what `handle` asks for.
        let program = unsafe { pointer::handle(program, "program") };
        program.map_or(0, |program| program.warnings.list.len())
    })
}

/// Writes a warning of building, counted from 0, to `warning`; false where there is none.
///
/// # Safety
/// `program` is live; `warning` may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_program_warning(
    program: *const Program,
    index: usize,
    warning: *mut Diagnostic,
) -> bool {
    guarded_or(false, || {
        // SAFETY: the caller promises what `handle` asks for.
        let program = unsafe { pointer::handle(program, "program") };
        let found = program.ok().and_then(|program| program.warnings.get(index));
        // SAFETY: the caller promises that `warning` may be written to.
        found.is_some_and(|found| unsafe { pointer::put(warning, found, "") }.is_ok())
    })
}

/// Posts a CL file from memory into `output`.
///
/// # Safety
/// `program` is live, `cl` points to `cl_length` bytes, `options` is NULL or live, `output` may
/// be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_run(
    program: *const Program,
    cl: *const u8,
    cl_length: usize,
    options: *const Options,
    output: *mut *mut Output,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises that `output` may be written to.
        unsafe { pointer::put(output, ptr::null_mut(), "output") }?;
        // SAFETY: the caller promises what `start` asks for.
        let run = unsafe { start(program, options) }?;
        // SAFETY: the caller promises what `bytes` asks for.
        let cl = unsafe { pointer::bytes(cl, cl_length, "cl") }?;
        let mut nc = Vec::new();
        let report = run.stream_seekable(Cursor::new(cl), &mut nc)?;
        // SAFETY: as above.
        unsafe { pointer::put(output, pointer::give(Output::new(nc, &report)), "output") }
    })
}

/// Posts a CL file into an NC file. After an error there is no file under the name of the
/// NC file; an older one stays as it was. `output` has no NC program, and may be NULL.
///
/// # Safety
/// `program` is live, `cl` and `nc` end with a NUL, `options` is NULL or live, `output` is NULL
/// or may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_run_files(
    program: *const Program,
    cl: *const c_char,
    nc: *const c_char,
    options: *const Options,
    output: *mut *mut Output,
) -> *mut Error {
    guarded(|| {
        if !output.is_null() {
            // SAFETY: the caller promises that `output` may be written to.
            unsafe { pointer::put(output, ptr::null_mut(), "output") }?;
        }
        // SAFETY: the caller promises what `start` asks for.
        let run = unsafe { start(program, options) }?;
        // SAFETY: the caller promises what `text` asks for.
        let cl = unsafe { pointer::text(cl, "cl") }?;
        // SAFETY: as above.
        let nc = unsafe { pointer::text(nc, "nc") }?;
        let report = run.post_files(Path::new(cl), Path::new(nc))?;
        if output.is_null() {
            return Ok(());
        }
        let told = pointer::give(Output::new(Vec::new(), &report));
        // SAFETY: as above.
        unsafe { pointer::put(output, told, "output") }
    })
}

/// Hands out the blocks of a CL file one by one, each with what made it. A `take` that returns
/// other than 0 stops the run, which is an error that filpost_error_is_cancelled knows. The CL
/// file is read once, so FIL that asks for totals of the program is refused.
///
/// # Safety
/// As filpost_run; `take` must not throw and not jump out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_blocks(
    program: *const Program,
    cl: *const u8,
    cl_length: usize,
    options: *const Options,
    take: TakeBlock,
    user_data: *mut c_void,
) -> *mut Error {
    guarded(|| {
        let Some(take) = take else { return Err(Wrong::usage("take is NULL".into())) };
        // SAFETY: the caller promises what `start` asks for.
        let run = unsafe { start(program, options) }?;
        // SAFETY: as above.
        let fil = unsafe { pointer::handle(program, "program") }?.program.fil_files();
        // SAFETY: the caller promises what `bytes` asks for.
        let cl = unsafe { pointer::bytes(cl, cl_length, "cl") }?;
        for block in run.blocks(cl) {
            // SAFETY: the caller promises a callback of this kind.
            if unsafe { hand_out(&block?, &fil, take, user_data) } != 0 {
                let code = filpost::RunCode::Cancelled;
                let message = "the callback has stopped the run";
                return Err(Wrong::diag(filpost::Diag::new(code, message)));
            }
        }
        Ok(())
    })
}

/// Compares an NC program with the CL file that it should come from. `report` is JSON, as
/// `filpost verify --report json` writes it: its `verdict` is `agrees`, `partly` or `differs`.
/// `tolerance` is what lengths (mm) and angles (degrees) may be off by besides their last digit.
///
/// # Safety
/// As filpost_run; `nc` points to `nc_length` bytes.
#[unsafe(no_mangle)]
#[expect(clippy::too_many_arguments, reason = "C has no slices")]
pub unsafe extern "C" fn filpost_verify(
    program: *const Program,
    cl: *const u8,
    cl_length: usize,
    nc: *const u8,
    nc_length: usize,
    tolerance: f64,
    options: *const Options,
    report: *mut *mut Text,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises that `report` may be written to.
        unsafe { pointer::put(report, ptr::null_mut(), "report") }?;
        // SAFETY: the caller promises what `start` asks for.
        let run = unsafe { start(program, options) }?;
        // SAFETY: the caller promises what `bytes` asks for.
        let cl = unsafe { pointer::bytes(cl, cl_length, "cl") }?;
        // SAFETY: as above.
        let nc = unsafe { pointer::bytes(nc, nc_length, "nc") }?;
        if !tolerance.is_finite() || tolerance < 0.0 {
            return Err(Wrong::usage("tolerance must be 0 or more".into()));
        }
        let tolerance = (tolerance > 0.0).then_some(tolerance);
        let allowed = Allowed { tolerance, ..Allowed::default() };
        let (found, reference) = run.verify(cl, NcProgram { text: nc, name: "NC" }, allowed)?;
        let told = text::give(&as_json(&found, reference).to_string());
        // SAFETY: as above.
        unsafe { pointer::put(report, told, "report") }
    })
}

/// A switch that stops runs from another thread.
#[unsafe(no_mangle)]
pub extern "C" fn filpost_cancel_new() -> *mut Cancel {
    guarded_or(ptr::null_mut(), || pointer::give(Cancel(CancelToken::new())))
}

/// Stops the runs that have this switch. Any thread may call it.
///
/// # Safety
/// `cancel` is NULL or live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_cancel_cancel(cancel: *const Cancel) {
    guarded_or((), || {
        // SAFETY: the caller promises what `handle` asks for.
        if let Ok(cancel) = unsafe { pointer::handle(cancel, "cancel") } {
            cancel.0.cancel();
        }
    });
}

/// Frees a switch that no run has any more.
///
/// # Safety
/// `cancel` is NULL or live, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_cancel_free(cancel: *mut Cancel) {
    // SAFETY: the caller promises what `take` asks for.
    guarded_or((), || drop(unsafe { pointer::take(cancel) }));
}
