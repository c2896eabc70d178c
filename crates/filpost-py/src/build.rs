//! Building a program from what Python gives.

use filpost::cl::ClDialect;
use filpost::cl::reader::Options;
use filpost::{Builder, Clock, Limits, Program, Unit};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::{diag, function};

/// Name and text of a file.
pub type NamedText = (String, String);

/// What a program is made of; the fields are those of `filpost.Program`.
#[derive(FromPyObject)]
pub struct Parts {
    ready: Option<String>,
    folder: Option<std::path::PathBuf>,
    machine: Option<NamedText>,
    option_file: Option<NamedText>,
    over: Vec<NamedText>,
    settings: Vec<String>,
    options: Vec<(String, String)>,
    fil: Vec<NamedText>,
    functions: Vec<(String, u16, Py<PyAny>)>,
    limits: Vec<(String, u64)>,
    compat: Option<NamedText>,
    strict: bool,
    allow: Vec<String>,
    levels: Vec<(String, String)>,
    clock: Option<String>,
    read: Option<std::path::PathBuf>,
    write: Option<std::path::PathBuf>,
}

/// Builds the program.
///
/// # Errors
/// `filpost.Error` with all that is wrong; ValueError for an unknown limit.
pub fn program(py: Python<'_>, parts: Parts) -> PyResult<Program> {
    let builder = builder(py, parts)?;
    py.detach(|| builder.build()).map_err(|error| diag::error(py, &error))
}

fn builder(py: Python<'_>, parts: Parts) -> PyResult<Builder> {
    let mut builder = Program::builder().limits(limits(&parts.limits)?).strict(parts.strict);
    if let Some(name) = &parts.ready {
        builder = builder.ready(name);
    }
    if let Some(folder) = &parts.folder {
        builder = builder.folder(folder).map_err(|wrong| diag::error(py, &wrong))?;
    }
    if let Some((name, text)) = &parts.machine {
        builder = builder.machine(name, text);
    }
    if let Some((name, text)) = &parts.option_file {
        builder = builder.option_file(name, text);
    }
    for (name, text) in &parts.over {
        builder = builder.lay_over(name, text);
    }
    for setting in &parts.settings {
        builder = builder.set(setting);
    }
    for (name, value) in &parts.options {
        builder = builder.option(name, value);
    }
    for (name, text) in &parts.fil {
        builder = builder.fil(name, text);
    }
    for (name, arity, callable) in parts.functions {
        builder = builder.function(&name, arity, function::body(callable));
    }
    if let Some((name, text)) = &parts.compat {
        let read = filpost::read_compat(name, text);
        builder = builder.compat(read.map_err(|wrong| diag::refused(py, &wrong))?);
    }
    for name in &parts.allow {
        let code = filpost::allowable(name).map_err(|wrong| diag::refused(py, &wrong))?;
        builder = builder.allow(code);
    }
    for (code, level) in &parts.levels {
        let named = filpost::level_named(code, level);
        let (of, level) = named.map_err(|wrong| diag::refused(py, &wrong))?;
        builder = builder.level(of, level);
    }
    if let Some(clock) = &parts.clock {
        builder = builder.clock(Clock::named(clock).ok_or_else(|| {
            PyValueError::new_err(format!("no clock `{clock}`; give \"system\" or a datetime"))
        })?);
    }
    if let Some(folder) = parts.read {
        builder = builder.grant_read(folder);
    }
    if let Some(folder) = parts.write {
        builder = builder.grant_write(folder);
    }
    Ok(builder)
}

/// The limits that are named, the others as they are without.
fn limits(given: &[(String, u64)]) -> PyResult<Limits> {
    let mut limits = Limits::default();
    for (name, value) in given {
        let size = usize::try_from(*value).unwrap_or(usize::MAX);
        match name.as_str() {
            "fuel" => limits.fuel = *value,
            "call_depth" => limits.call_depth = size,
            "array_elements" => limits.array_elements = size,
            "text_bytes" => limits.text_bytes = size,
            "output_bytes" => limits.output_bytes = *value,
            other => {
                return Err(PyValueError::new_err(format!(
                    "no limit `{other}`; there are fuel, call_depth, array_elements, text_bytes \
                     and output_bytes"
                )));
            }
        }
    }
    Ok(limits)
}

/// How CL text is read.
///
/// # Errors
/// ValueError for an unknown dialect.
pub fn reading(dialect: Option<&str>, raw: bool) -> PyResult<Options> {
    let known: Vec<_> = ClDialect::ALL.iter().map(|dialect| (dialect.name(), *dialect)).collect();
    let dialect = dialect.map(|name| diag::named("dialect", name, &known)).transpose()?;
    Ok(Options { dialect, raw, ..Options::default() })
}

/// A unit by its name.
///
/// # Errors
/// ValueError for another name than `mm` and `inch`.
pub fn unit(name: Option<&str>) -> PyResult<Option<Unit>> {
    let known = [("mm", Unit::Mm), ("inch", Unit::Inch)];
    name.map(|name| diag::named("unit", name, &known)).transpose()
}
