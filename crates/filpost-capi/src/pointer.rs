//! Pointers that C gives, followed here and nowhere else.

use std::ffi::{CStr, CString, c_char};

use crate::error::Wrong;

/// A handle that C may read.
///
/// # Safety
/// `pointer` is NULL, or was given out by this library and not freed, and nobody writes to
/// it meanwhile.
///
/// # Errors
/// It is NULL.
pub unsafe fn handle<'a, T>(pointer: *const T, what: &str) -> Result<&'a T, Wrong> {
    // SAFETY: by the caller's promise a pointer that is not NULL is valid and unchanged.
    unsafe { pointer.as_ref() }.ok_or_else(|| Wrong::usage(format!("{what} is NULL")))
}

/// A handle that C lets this library change.
///
/// # Safety
/// As [`handle`], and no other thread uses it meanwhile.
///
/// # Errors
/// It is NULL.
pub unsafe fn handle_mut<'a, T>(pointer: *mut T, what: &str) -> Result<&'a mut T, Wrong> {
    // SAFETY: by the caller's promise a pointer that is not NULL is valid and used here alone.
    unsafe { pointer.as_mut() }.ok_or_else(|| Wrong::usage(format!("{what} is NULL")))
}

/// A text that ends with a NUL.
///
/// # Safety
/// `pointer` is NULL, or points to a text that ends with a NUL and stays as it is during
/// the call.
///
/// # Errors
/// It is NULL, or not UTF-8.
pub unsafe fn text<'a>(pointer: *const c_char, what: &str) -> Result<&'a str, Wrong> {
    if pointer.is_null() {
        return Err(Wrong::usage(format!("{what} is NULL")));
    }
    // SAFETY: it is not NULL, and by the caller's promise ends with a NUL and stays.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Wrong::usage(format!("{what} is not UTF-8")))
}

/// The same where NULL stands for nothing.
///
/// # Safety
/// As [`text`].
///
/// # Errors
/// It is not UTF-8.
pub unsafe fn optional_text<'a>(
    pointer: *const c_char,
    what: &str,
) -> Result<Option<&'a str>, Wrong> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise is that of `text`.
    unsafe { text(pointer, what) }.map(Some)
}

/// Bytes with their number.
///
/// # Safety
/// `pointer` points to `length` bytes that stay as they are during the call; with a length of
/// 0 it may be NULL.
///
/// # Errors
/// NULL with a length, or a length that no memory has.
pub unsafe fn bytes<'a>(pointer: *const u8, length: usize, what: &str) -> Result<&'a [u8], Wrong> {
    if length == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() || isize::try_from(length).is_err() {
        return Err(Wrong::usage(format!("{what} is NULL, or its length is none")));
    }
    // SAFETY: it is not NULL, the length fits, and by the caller's promise the bytes are there
    // and stay.
    Ok(unsafe { std::slice::from_raw_parts(pointer, length) })
}

/// Hands a value to C, which gives it back to [`free`].
pub fn give<T>(value: T) -> *mut T {
    Box::into_raw(Box::new(value))
}

/// Takes back what [`give`] gave; NULL is nothing.
///
/// # Safety
/// `pointer` is NULL or came from [`give`], was not taken back before, and is not used again.
pub unsafe fn take<T>(pointer: *mut T) -> Option<Box<T>> {
    if pointer.is_null() {
        return None;
    }
    // SAFETY: it is not NULL, and by the caller's promise from `give` and taken back once.
    Some(unsafe { Box::from_raw(pointer) })
}

/// Writes a result where C wants it.
///
/// # Safety
/// `to` is NULL or may be written to.
///
/// # Errors
/// It is NULL.
pub unsafe fn put<T>(to: *mut T, value: T, what: &str) -> Result<(), Wrong> {
    if to.is_null() {
        return Err(Wrong::usage(format!("{what} is NULL")));
    }
    // SAFETY: it is not NULL, and by the caller's promise may be written to.
    unsafe { to.write(value) };
    Ok(())
}

/// A text for C; a NUL inside becomes a blank.
pub fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}
