//! Owned errors.

use std::ffi::{CString, c_char};
use std::ptr;

use crate::diagnostic::{Diagnostic, Diagnostics, Held};
use crate::guard::guarded_or;
use crate::pointer::{self, c_text};

/// What went wrong inside a function that C called.
pub enum Wrong {
    /// A wrong call.
    Usage(String),
    /// A fault of this library.
    Fault(String),
    /// The library refuses.
    Refused(filpost::Error),
}

impl Wrong {
    pub fn usage(message: String) -> Self {
        Wrong::Usage(message)
    }

    pub fn fault(message: String) -> Self {
        Wrong::Fault(message)
    }

    pub fn diag(diag: filpost::Diag) -> Self {
        Wrong::Refused(filpost::Error::Run(Box::new(diag)))
    }
}

impl From<filpost::Error> for Wrong {
    fn from(error: filpost::Error) -> Self {
        Wrong::Refused(error)
    }
}

/// What went wrong, with all its diagnostics. The caller owns it.
pub struct Error {
    pub message: CString,
    pub diagnostics: Diagnostics,
    cancelled: bool,
}

impl Error {
    pub fn new(wrong: Wrong) -> Self {
        let own = |code, title, message: &str, hint| Error {
            message: c_text(&format!("{code}: {message}")),
            diagnostics: Diagnostics::of(vec![Held::own(code, title, message, hint)]),
            cancelled: false,
        };
        match wrong {
            Wrong::Usage(message) => {
                own("USAGE", "wrong call", &message, "See the comments of filpost.h.")
            }
            Wrong::Fault(message) => {
                own("FAULT", "internal fault", &message, "This is a fault of filpost: report it.")
            }
            Wrong::Refused(error) => Error {
                message: c_text(&error.to_string()),
                diagnostics: Diagnostics::new(error.diags()),
                cancelled: error.is_cancelled(),
            },
        }
    }
}

/// All that is wrong, a line for each diagnostic.
///
/// # Safety
/// `error` comes from this library and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_error_message(error: *const Error) -> *const c_char {
    guarded_or(ptr::null(), || {
        // SAFETY: the caller promises what `handle` asks for.
        let error = unsafe { pointer::handle(error, "error") };
        error.map_or(ptr::null(), |error| error.message.as_ptr())
    })
}

/// Number of diagnostics, 1 or more.
///
/// # Safety
/// `error` comes from this library and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_error_count(error: *const Error) -> usize {
    guarded_or(0, || {
        // SAFETY: the caller promises what `handle` asks for.
        let error = unsafe { pointer::handle(error, "error") };
        error.map_or(0, |error| error.diagnostics.list.len())
    })
}

/// Writes a diagnostic, counted from 0, to `diagnostic`; false where there is none.
///
/// # Safety
/// `error` comes from this library and was not freed; `diagnostic` may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_error_diagnostic(
    error: *const Error,
    index: usize,
    diagnostic: *mut Diagnostic,
) -> bool {
    guarded_or(false, || {
        // SAFETY: the caller promises what `handle` asks for.
        let error = unsafe { pointer::handle(error, "error") };
        let found = error.ok().and_then(|error| error.diagnostics.get(index));
        // SAFETY: the caller promises that `diagnostic` may be written to.
        found.is_some_and(|found| unsafe { pointer::put(diagnostic, found, "") }.is_ok())
    })
}

/// The diagnostics as JSON, as `filpost check --format json` writes them.
///
/// # Safety
/// `error` comes from this library and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_error_json(error: *const Error) -> *const c_char {
    guarded_or(ptr::null(), || {
        // SAFETY: the caller promises what `handle` asks for.
        let error = unsafe { pointer::handle(error, "error") };
        error.map_or(ptr::null(), |error| error.diagnostics.json())
    })
}

/// True for a run that `filpost_cancel_cancel` or a callback has stopped.
///
/// # Safety
/// `error` comes from this library and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_error_is_cancelled(error: *const Error) -> bool {
    guarded_or(false, || {
        // SAFETY: the caller promises what `handle` asks for.
        unsafe { pointer::handle(error, "error") }.is_ok_and(|error| error.cancelled)
    })
}

/// Frees an error.
///
/// # Safety
/// `error` is NULL or comes from this library, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_error_free(error: *mut Error) {
    // SAFETY: the caller promises what `take` asks for.
    guarded_or((), || drop(unsafe { pointer::take(error) }));
}
