//! What a run gives.

use std::ffi::c_char;
use std::ptr;

use filpost::Report;

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::guard::guarded_or;
use crate::pointer;

/// An NC program and what its run has to tell. The caller owns it.
pub struct Output {
    nc: Vec<u8>,
    records: u64,
    blocks: u64,
    warnings: Diagnostics,
}

impl Output {
    pub fn new(mut nc: Vec<u8>, report: &Report) -> Self {
        // Behind its length, for those who print it.
        nc.push(0);
        let warnings = Diagnostics::new(&report.warnings);
        Output { nc, records: report.records, blocks: report.blocks, warnings }
    }
}

/// A field of an output; `otherwise` for NULL.
///
/// # Safety
/// `output` is NULL or live.
unsafe fn field<T>(output: *const Output, otherwise: T, of: impl FnOnce(&Output) -> T) -> T {
    // SAFETY: the caller promises what `handle` asks for.
    match unsafe { pointer::handle(output, "output") } {
        Ok(output) => of(output),
        Err(_) => otherwise,
    }
}

/// The bytes of the NC program, with a NUL behind them; `length`, where it is not NULL, gets
/// their number.
///
/// # Safety
/// `output` is live; `length` is NULL or may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_output_nc(
    output: *const Output,
    length: *mut usize,
) -> *const c_char {
    guarded_or(ptr::null(), || {
        // SAFETY: the caller promises that `output` is live.
        let (bytes, count) = unsafe {
            field(output, (ptr::null(), 0), |output| {
                (output.nc.as_ptr().cast::<c_char>(), output.nc.len() - 1)
            })
        };
        if !length.is_null() {
            // SAFETY: the caller promises that `length` may be written to.
            let _ = unsafe { pointer::put(length, count, "length") };
        }
        bytes
    })
}

/// Number of CL records that were read.
///
/// # Safety
/// `output` is live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_output_records(output: *const Output) -> u64 {
    // SAFETY: the caller promises that `output` is live.
    guarded_or(0, || unsafe { field(output, 0, |output| output.records) })
}

/// Number of blocks that were written.
///
/// # Safety
/// `output` is live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_output_blocks(output: *const Output) -> u64 {
    // SAFETY: the caller promises that `output` is live.
    guarded_or(0, || unsafe { field(output, 0, |output| output.blocks) })
}

/// Number of warnings.
///
/// # Safety
/// `output` is live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_output_warning_count(output: *const Output) -> usize {
    // SAFETY: the caller promises that `output` is live.
    guarded_or(0, || unsafe { field(output, 0, |output| output.warnings.list.len()) })
}

/// Writes a warning, counted from 0, to `warning`; false where there is none.
///
/// # Safety
/// `output` is live; `warning` may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_output_warning(
    output: *const Output,
    index: usize,
    warning: *mut Diagnostic,
) -> bool {
    guarded_or(false, || {
        // SAFETY: the caller promises that `output` is live.
        let found = unsafe { field(output, None, |output| output.warnings.get(index)) };
        // SAFETY: the caller promises that `warning` may be written to.
        found.is_some_and(|found| unsafe { pointer::put(warning, found, "") }.is_ok())
    })
}

/// The warnings as JSON, as `filpost check --format json` writes them.
///
/// # Safety
/// `output` is live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_output_warnings_json(output: *const Output) -> *const c_char {
    // SAFETY: the caller promises that `output` is live.
    guarded_or(ptr::null(), || unsafe {
        field(output, ptr::null(), |output| output.warnings.json())
    })
}

/// Frees an output.
///
/// # Safety
/// `output` is NULL or live, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_output_free(output: *mut Output) {
    // SAFETY: the caller promises what `take` asks for.
    guarded_or((), || drop(unsafe { pointer::take(output) }));
}
