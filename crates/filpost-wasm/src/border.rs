//! The border to the host: two buffers of the module's memory.
//!
//! The host asks for room with [`filpost_request`], writes a request there, calls
//! [`filpost_answer`] with its length, and reads the answer of that length at
//! [`filpost_answered`]. One request at a time: the next one takes the place of the last. While it
//! posts, it tells the host how far it has come (`filpost.progress`).
#![allow(unsafe_code)] // Exported names can clash with others; these begin with `filpost_`.

use std::cell::RefCell;

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

#[cfg(feature = "post")]
mod host {
    #[link(wasm_import_module = "filpost")]
    unsafe extern "C" {
        /// How much of the CL text was read, 0 to 1.
        pub safe fn progress(share: f64);
    }
}

#[cfg(feature = "post")]
pub(crate) use host::progress;

/// Room for a request of `length` bytes.
#[unsafe(no_mangle)]
extern "C" fn filpost_request(length: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(length, 0);
        request.as_mut_ptr()
    })
}

/// Answers the request and gives the length of the answer.
#[unsafe(no_mangle)]
extern "C" fn filpost_answer() -> usize {
    let answer = REQUEST.with_borrow(|request| crate::answer(request));
    let length = answer.len();
    ANSWER.set(answer);
    length
}

/// Where the answer lies.
#[unsafe(no_mangle)]
extern "C" fn filpost_answered() -> *const u8 {
    ANSWER.with_borrow(Vec::as_ptr)
}
