//! Owned texts, and what needs no program.

use std::ffi::{CStr, CString, c_char};
use std::ptr;

use filpost::nc::diff::{self, sentence};
use serde_json::{Value, json};

use crate::error::{Error, Wrong};
use crate::guard::{guarded, guarded_or};
use crate::pointer::{self, c_text};

/// A text that the caller owns.
pub struct Text(CString);

/// Hands a text to C.
pub fn give(text: &str) -> *mut Text {
    pointer::give(Text(c_text(text)))
}

/// The characters of a text.
///
/// # Safety
/// `text` is live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_text_get(text: *const Text) -> *const c_char {
    guarded_or(ptr::null(), || {
        // SAFETY: the caller promises what `handle` asks for.
        let text = unsafe { pointer::handle(text, "text") };
        text.map_or(ptr::null(), |text| text.0.as_ptr())
    })
}

/// Frees a text.
///
/// # Safety
/// `text` is NULL or live, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_text_free(text: *mut Text) {
    // SAFETY: the caller promises what `take` asks for.
    guarded_or((), || drop(unsafe { pointer::take(text) }));
}

/// The version of the library, `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn filpost_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => panic!("a version without a NUL"),
        };
    VERSION.as_ptr()
}

/// Explains a code (`E0501`), a setting, a CL or FIL word, a function, a location
/// (`INTCOM 1861`), a G or M code or a ready post; NULL where there is no help.
///
/// # Safety
/// `subject` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_explain(subject: *const c_char) -> *mut Text {
    guarded_or(ptr::null_mut(), || {
        // SAFETY: the caller promises what `text` asks for.
        let subject = unsafe { pointer::text(subject, "subject") };
        let text = subject.ok().and_then(|subject| filpost::explain::explain(subject, &[]));
        text.map_or(ptr::null_mut(), |text| give(&text))
    })
}

/// Compares two NC programs as a control reads them. `differences` is a JSON array of
/// `{"lines":[5,5],"message":"…"}`, empty when they say the same. `tolerance` is in the unit of
/// the programs and in degrees.
///
/// # Safety
/// `first` and `second` point to so many bytes; `differences` may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_diff(
    first: *const u8,
    first_length: usize,
    second: *const u8,
    second_length: usize,
    tolerance: f64,
    differences: *mut *mut Text,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises that `differences` may be written to.
        unsafe { pointer::put(differences, ptr::null_mut(), "differences") }?;
        // SAFETY: the caller promises what `bytes` asks for.
        let first = unsafe { pointer::bytes(first, first_length, "first") }?;
        // SAFETY: as above.
        let second = unsafe { pointer::bytes(second, second_length, "second") }?;
        if !tolerance.is_finite() || tolerance < 0.0 {
            return Err(Wrong::usage("tolerance must be 0 or more".into()));
        }
        let told = give(&compare(first, second, tolerance)?.to_string());
        // SAFETY: as above.
        unsafe { pointer::put(differences, told, "differences") }
    })
}

fn compare(first: &[u8], second: &[u8], tolerance: f64) -> Result<Value, Wrong> {
    let refused = |diag: Box<filpost::Diag>| Wrong::diag(*diag);
    let options = diff::Options { tolerance, ..diff::Options::default() };
    let first = diff::read(first, "the first", &options).map_err(refused)?;
    let second = diff::read(second, "the second", &options).map_err(refused)?;
    let found = diff::compare(&first, &second, &options).map_err(refused)?;
    let one = |difference: &diff::Difference| json!({ "lines": difference.lines, "message": sentence(difference, &first, &second) });
    Ok(found.differences.iter().map(one).collect())
}
