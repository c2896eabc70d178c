//! No panic unwinds into C.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;

use crate::error::{Error, Wrong};
use crate::pointer;

/// Runs the body of a function that C calls; NULL when all went well. A panic, which would be a
/// fault of this library, becomes an error with the code `FAULT`.
///
/// What a body leaves half done when it panics is only ever freed: handles are written to when
/// their functions succeed.
pub fn guarded(body: impl FnOnce() -> Result<(), Wrong>) -> *mut Error {
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => ptr::null_mut(),
        Ok(Err(wrong)) => pointer::give(Error::new(wrong)),
        Err(panic) => {
            let told = panic.downcast_ref::<&str>().map(ToString::to_string);
            let told = told.or_else(|| panic.downcast_ref::<String>().cloned());
            let told = told.unwrap_or_else(|| "without a message".to_string());
            // A panic's value may itself panic when it is dropped.
            std::mem::forget(panic);
            pointer::give(Error::new(Wrong::fault(told)))
        }
    }
}

/// The same for a function that gives a value and cannot fail; `otherwise` after a panic.
pub fn guarded_or<T>(otherwise: T, body: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|panic| {
        std::mem::forget(panic);
        otherwise
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error() {
        for (panic, told) in [
            ((|| panic!("at {}", 7)) as fn() -> Result<(), Wrong>, "at 7"),
            (|| panic!("plain"), "plain"),
            (|| std::panic::panic_any(3), "without a message"),
        ] {
            let error = guarded(panic);
            // SAFETY: `guarded` gave it, and it is taken back once.
            let error = unsafe { pointer::take(error) }.expect("an error");
            assert_eq!(error.diagnostics.list[0].code.to_str(), Ok("FAULT"));
            assert!(error.message.to_string_lossy().contains(told));
        }
        assert_eq!(guarded_or(5, || panic!("no value")), 5);
        assert!(guarded(|| Ok(())).is_null());
    }
}
