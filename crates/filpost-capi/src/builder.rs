//! Building a program.

use std::ffi::{c_char, c_void};
use std::ptr;

use crate::error::{Error, Wrong};
use crate::function::{FreeUserData, Function, Hosted};
use crate::guard::{guarded, guarded_or};
use crate::pointer;
use crate::program::Program;

/// Collects what a program is made of. One thread at a time uses it.
pub struct Builder {
    builder: filpost::Builder,
    limits: filpost::Limits,
}

/// Changes a builder: the library's own takes and gives itself.
///
/// # Safety
/// `builder` is NULL or a live builder that no other thread uses.
unsafe fn change(
    builder: *mut Builder,
    with: impl FnOnce(filpost::Builder) -> filpost::Builder,
) -> Result<(), Wrong> {
    // SAFETY: the caller promises what `handle_mut` asks for.
    let held = unsafe { pointer::handle_mut(builder, "builder") }?;
    held.builder = with(std::mem::replace(&mut held.builder, filpost::Program::builder()));
    Ok(())
}

/// Changes a builder by a name and a text.
///
/// # Safety
/// As [`change`]; the texts end with a NUL.
unsafe fn change_named(
    builder: *mut Builder,
    [name, text]: [*const c_char; 2],
    with: impl FnOnce(filpost::Builder, &str, &str) -> filpost::Builder,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let name = unsafe { pointer::text(name, "name") }?;
        // SAFETY: as above.
        let text = unsafe { pointer::text(text, "text") }?;
        // SAFETY: the caller promises what `change` asks for.
        unsafe { change(builder, |builder| with(builder, name, text)) }
    })
}

/// Starts a program; the machine is the generic mill until another is chosen.
/// filpost_builder_build takes it, else filpost_builder_free frees it.
#[unsafe(no_mangle)]
pub extern "C" fn filpost_builder_new() -> *mut Builder {
    guarded_or(ptr::null_mut(), || {
        pointer::give(Builder {
            builder: filpost::Program::builder(),
            limits: filpost::Limits::default(),
        })
    })
}

/// Frees a builder that was not built.
///
/// # Safety
/// `builder` is NULL or live, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_free(builder: *mut Builder) {
    // SAFETY: the caller promises what `take` asks for.
    guarded_or((), || drop(unsafe { pointer::take(builder) }));
}

/// Chooses a post inside the library, `fanuc-mill`.
///
/// # Safety
/// `builder` is live; `name` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_ready(
    builder: *mut Builder,
    name: *const c_char,
) -> *mut Error {
    // SAFETY: the caller promises what `change_named` asks for.
    unsafe { change_named(builder, [name, name], |builder, name, _| builder.ready(name)) }
}

/// Takes the post in a folder: its `machine.toml` and, where there is one, `post.fil`. After an
/// error the builder is as new.
///
/// # Safety
/// `builder` is live; `folder` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_folder(
    builder: *mut Builder,
    folder: *const c_char,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let folder = unsafe { pointer::text(folder, "folder") }?;
        // SAFETY: the caller promises what `handle_mut` asks for.
        let held = unsafe { pointer::handle_mut(builder, "builder") }?;
        let taken = std::mem::replace(&mut held.builder, filpost::Program::builder());
        held.builder = taken.folder(folder.as_ref())?;
        Ok(())
    })
}

/// Takes the text of a `machine.toml`; messages show `name`.
///
/// # Safety
/// `builder` is live; `name` and `text` end with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_machine(
    builder: *mut Builder,
    name: *const c_char,
    text: *const c_char,
) -> *mut Error {
    // SAFETY: the caller promises what `change_named` asks for.
    unsafe { change_named(builder, [name, text], filpost::Builder::machine) }
}

/// Takes the text of an option file (UNCX01.Pnn); messages show `name`.
///
/// # Safety
/// `builder` is live; `name` and `text` end with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_option_file(
    builder: *mut Builder,
    name: *const c_char,
    text: *const c_char,
) -> *mut Error {
    // SAFETY: the caller promises what `change_named` asks for.
    unsafe { change_named(builder, [name, text], filpost::Builder::option_file) }
}

/// Lays the settings of a further `machine.toml` over the machine; the later one wins.
///
/// # Safety
/// `builder` is live; `name` and `text` end with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_over(
    builder: *mut Builder,
    name: *const c_char,
    text: *const c_char,
) -> *mut Error {
    // SAFETY: the caller promises what `change_named` asks for.
    unsafe { change_named(builder, [name, text], filpost::Builder::lay_over) }
}

/// Lays one more setting on top, `rapid.split=0`.
///
/// # Safety
/// `builder` is live; `setting` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_set(
    builder: *mut Builder,
    setting: *const c_char,
) -> *mut Error {
    // SAFETY: the caller promises what `change_named` asks for.
    unsafe { change_named(builder, [setting, setting], |builder, setting, _| builder.set(setting)) }
}

/// Adds a FIL file; several are read in this order into one name space.
///
/// # Safety
/// `builder` is live; `name` and `text` end with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_fil(
    builder: *mut Builder,
    name: *const c_char,
    text: *const c_char,
) -> *mut Error {
    // SAFETY: the caller promises what `change_named` asks for.
    unsafe { change_named(builder, [name, text], filpost::Builder::fil) }
}

/// Refuses extensions of filpost, so that scripts stay portable.
///
/// # Safety
/// `builder` is live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_strict(builder: *mut Builder, strict: bool) -> *mut Error {
    // SAFETY: the caller promises what `change` asks for.
    guarded(|| unsafe { change(builder, |builder| builder.strict(strict)) })
}

/// Allows a code in all FIL files, `W0151`.
///
/// # Safety
/// `builder` is live; `code` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_allow(
    builder: *mut Builder,
    code: *const c_char,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let name = unsafe { pointer::text(code, "code") }?;
        let code = filpost::allowable(name).map_err(|diag| Wrong::diag(*diag))?;
        // SAFETY: the caller promises what `change` asks for.
        unsafe { change(builder, |builder| builder.allow(code)) }
    })
}

/// Gives an option of the post its value, as `filpost post --option preload=no` does; an option
/// that the post lacks is refused when the program is built.
///
/// # Safety
/// `builder` is live; `name` and `value` end with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_option(
    builder: *mut Builder,
    name: *const c_char,
    value: *const c_char,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let (name, value) = unsafe { (pointer::text(name, "name")?, pointer::text(value, "value")?) };
        // SAFETY: the caller promises what `change` asks for.
        unsafe { change(builder, |builder| builder.option(name, value)) }
    })
}

/// Sets the level of a code, `E0532` or `all`: `allow`, `warn` or `deny`. Levels of single codes
/// win over that of all, and both over those of the machine.
///
/// # Safety
/// `builder` is live; `code` and `level` end with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_level(
    builder: *mut Builder,
    code: *const c_char,
    level: *const c_char,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let (code, level) = unsafe { (pointer::text(code, "code")?, pointer::text(level, "level")?) };
        let (of, level) = filpost::level_named(code, level).map_err(|diag| Wrong::diag(*diag))?;
        // SAFETY: the caller promises what `change` asks for.
        unsafe { change(builder, |builder| builder.level(of, level)) }
    })
}

/// Sets what DATEF and TIMEF give: `system` for the time of the run in UTC, or a moment such as
/// `2026-01-31T12:00:00`. A script that asks for the time is refused without.
///
/// # Safety
/// `builder` is live; `clock` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_clock(
    builder: *mut Builder,
    clock: *const c_char,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let name = unsafe { pointer::text(clock, "clock") }?;
        let Some(clock) = filpost::Clock::named(name) else {
            return Err(Wrong::usage(format!("there is no clock {name}")));
        };
        // SAFETY: the caller promises what `change` asks for.
        unsafe { change(builder, |builder| builder.clock(clock)) }
    })
}

/// Bounds what a run may use up: `fuel` (steps of a section), `call_depth`, `array_elements`,
/// `text_bytes` or `output_bytes`.
///
/// # Safety
/// `builder` is live; `name` ends with a NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_limit(
    builder: *mut Builder,
    name: *const c_char,
    most: u64,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let name = unsafe { pointer::text(name, "name") }?;
        // SAFETY: the caller promises what `handle_mut` asks for.
        let held = unsafe { pointer::handle_mut(builder, "builder") }?;
        let size = usize::try_from(most).unwrap_or(usize::MAX);
        let limits = &mut held.limits;
        match name {
            "fuel" => limits.fuel = most,
            "call_depth" => limits.call_depth = size,
            "array_elements" => limits.array_elements = size,
            "text_bytes" => limits.text_bytes = size,
            "output_bytes" => limits.output_bytes = most,
            other => return Err(Wrong::usage(format!("there is no limit {other}"))),
        }
        Ok(())
    })
}

/// Adds a function to FIL. `free_user_data`, where there is one, is called when no program
/// needs `user_data` any more; after an error it is not called.
///
/// # Safety
/// `builder` is live; `name` ends with a NUL; `function` and `user_data` may be used from any
/// thread until `free_user_data` is called.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_function(
    builder: *mut Builder,
    name: *const c_char,
    arguments: u16,
    function: Function,
    user_data: *mut c_void,
    free_user_data: FreeUserData,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `text` asks for.
        let name = unsafe { pointer::text(name, "name") }?;
        // SAFETY: the caller promises what `handle_mut` asks for.
        unsafe { pointer::handle_mut(builder, "builder") }?;
        let Some(function) = function else {
            return Err(Wrong::usage("function is NULL".into()));
        };
        let hosted = Hosted { function, user_data, free: free_user_data };
        // SAFETY: the caller promises what `change` asks for.
        unsafe {
            change(builder, |builder| {
                builder.function(name, arguments, move |arguments| hosted.call(arguments))
            })
        }
    })
}

/// Builds the program into `program`, and frees the builder whether it goes well or not.
///
/// # Safety
/// `builder` is live and not used again; `program` may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn filpost_builder_build(
    builder: *mut Builder,
    program: *mut *mut Program,
) -> *mut Error {
    guarded(|| {
        // SAFETY: the caller promises what `take` asks for.
        let taken = unsafe { pointer::take(builder) };
        // SAFETY: the caller promises that `program` may be written to.
        unsafe { pointer::put(program, ptr::null_mut(), "program") }?;
        let Builder { builder, limits } =
            *taken.ok_or_else(|| Wrong::usage("builder is NULL".into()))?;
        let built = pointer::give(Program::new(builder.limits(limits).build()?));
        // SAFETY: as above.
        unsafe { pointer::put(program, built, "program") }
    })
}
