//! Functions of the host for FIL.

use std::ffi::{CString, c_char, c_void};
use std::ptr;

use filpost::{Argument, Returned};

use crate::guard::guarded_or;
use crate::pointer::{self, c_text};

/// The number that is EMPTY in FIL.
const EMPTY: f64 = 999_999.0;

/// What a value is.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// EMPTY.
    Empty,
    /// A number.
    Number,
    /// A text.
    Text,
}

/// An argument of a function. Its text lives during the call.
#[repr(C)]
pub struct Value {
    /// What it is.
    pub kind: ValueKind,
    /// The number; 0 of anything else.
    pub number: f64,
    /// The text; NULL of anything else.
    pub text: *const c_char,
}

/// What a function answers; EMPTY until it is told.
#[derive(Default)]
pub struct Reply {
    value: Option<Returned>,
    error: Option<String>,
}

/// A function for FIL: gives its answer by `filpost_reply_number` or `filpost_reply_text` and
/// returns 0; anything else stops the run, with the sentence of `filpost_reply_error`. Threads
/// that share the program call it at the same time, each with the same `user_data`. It must
/// not throw and not jump out.
pub type Function = Option<
    unsafe extern "C" fn(
        user_data: *mut c_void,
        arguments: *const Value,
        count: usize,
        reply: *mut Reply,
    ) -> i32,
>;

/// Frees user data; called once, when the last program with the function is freed.
pub type FreeUserData = Option<unsafe extern "C" fn(user_data: *mut c_void)>;

/// A function of the host with its data.
pub struct Hosted {
    pub function: unsafe extern "C" fn(*mut c_void, *const Value, usize, *mut Reply) -> i32,
    pub user_data: *mut c_void,
    pub free: FreeUserData,
}

// SAFETY: the header says that the function is called from any thread, several at a time, so
// that what the data points to is the host's to guard.
unsafe impl Send for Hosted {}
// SAFETY: as above.
unsafe impl Sync for Hosted {}

impl Drop for Hosted {
    fn drop(&mut self) {
        if let Some(free) = self.free {
            // SAFETY: the host gave both together, and this is the one call of it.
            unsafe { free(self.user_data) };
        }
    }
}

impl Hosted {
    /// Calls the function.
    pub fn call(&self, arguments: &[Argument<'_>]) -> Result<Returned, String> {
        let texts: Vec<Option<CString>> =
            arguments.iter().map(|argument| argument.text().map(c_text)).collect();
        let values: Vec<Value> = arguments
            .iter()
            .zip(&texts)
            .map(|(argument, text)| Value {
                kind: match argument {
                    Argument::Text(_) => ValueKind::Text,
                    Argument::Number(_) if argument.number().is_none() => ValueKind::Empty,
                    Argument::Number(_) => ValueKind::Number,
                },
                number: argument.number().unwrap_or(0.0),
                text: text.as_ref().map_or(ptr::null(), |text| text.as_ptr()),
            })
            .collect();
        let mut reply = Reply::default();
        // SAFETY: the host promises a function of this kind; values and reply live during
        // the call.
        let status = unsafe {
            (self.function)(self.user_data, values.as_ptr(), values.len(), &raw mut reply)
        };
        if status == 0 && reply.error.is_none() {
            return Ok(reply.value.unwrap_or(Returned::Number(EMPTY)));
        }
        Err(reply.error.unwrap_or_else(|| format!("the function returned the status {status}")))
    }
}

/// Answers with a number, which must be finite.
///
/// # Safety
/// `reply` is that of the call that goes on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_reply_number(reply: *mut Reply, number: f64) {
    guarded_or((), || {
        // SAFETY: the caller promises what `handle_mut` asks for.
        if let Ok(reply) = unsafe { pointer::handle_mut(reply, "reply") } {
            reply.value = Some(Returned::Number(number));
        }
    });
}

/// Answers with a text, which is copied; one that is NULL or not UTF-8 stops the run.
///
/// # Safety
/// `reply` is that of the call that goes on; `text` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_reply_text(reply: *mut Reply, text: *const c_char) {
    guarded_or((), || {
        // SAFETY: the caller promises what `handle_mut` asks for.
        let Ok(reply) = (unsafe { pointer::handle_mut(reply, "reply") }) else { return };
        // SAFETY: the caller promises what `text` asks for.
        match unsafe { pointer::text(text, "the text") } {
            Ok(text) => reply.value = Some(Returned::Text(text.to_string())),
            Err(_) => reply.error = Some("the text of the answer is NULL or not UTF-8".into()),
        }
    });
}

/// Says why the run must stop; the text is copied.
///
/// # Safety
/// `reply` is that of the call that goes on; `message` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_reply_error(reply: *mut Reply, message: *const c_char) {
    guarded_or((), || {
        // SAFETY: the caller promises what `handle_mut` asks for.
        let Ok(reply) = (unsafe { pointer::handle_mut(reply, "reply") }) else { return };
        // SAFETY: the caller promises what `text` asks for.
        let message = unsafe { pointer::text(message, "the message") };
        reply.error = Some(message.unwrap_or("without a message").to_string());
    });
}
