//! Diagnostics and errors as Python sees them.

use filpost::{Diag, TextSpan};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyTuple, PyType};

use crate::{function, input};

static DIAGNOSTIC: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static ERROR: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// A `filpost.Diagnostic`.
pub fn diagnostic<'py>(py: Python<'py>, diag: &Diag) -> PyResult<Bound<'py, PyAny>> {
    let place = diag.spans.first();
    let fields = (
        diag.code.name(),
        diag.severity().name(),
        diag.code.title,
        &diag.message,
        place.map(|place| &place.file),
        place.map(|place| place.line),
        place.map(TextSpan::column),
        diag.hint.as_deref().unwrap_or(diag.code.hint),
        PyTuple::new(py, &diag.notes)?,
    );
    DIAGNOSTIC.import(py, "filpost._data", "Diagnostic")?.call1(fields)
}

/// A tuple of them.
pub fn diagnostics<'py>(py: Python<'py>, diags: &[Diag]) -> PyResult<Bound<'py, PyTuple>> {
    let diags: PyResult<Vec<_>> = diags.iter().map(|diag| diagnostic(py, diag)).collect();
    PyTuple::new(py, diags?)
}

/// The `filpost.Error` of an error; what a callable of the run in this thread has raised is
/// its cause. What a signal has raised comes out instead.
pub fn error(py: Python<'_>, error: &filpost::Error) -> PyErr {
    if let Some(signalled) = input::take_signalled() {
        return signalled;
    }
    let made = || -> PyResult<PyErr> {
        let diags = diagnostics(py, error.diags())?;
        let value = ERROR.import(py, "filpost._data", "Error")?.call1((
            error.to_string(),
            diags,
            error.is_cancelled(),
        ))?;
        let raised = PyErr::from_value(value);
        raised.set_cause(py, function::take_raised(py, error));
        Ok(raised)
    };
    made().unwrap_or_else(|error| error)
}

/// The same for a single diagnostic.
pub fn refused(py: Python<'_>, diag: &Diag) -> PyErr {
    error(py, &filpost::Error::Run(Box::new(diag.clone())))
}

/// The value of a name that is given as an argument.
///
/// # Errors
/// ValueError that lists the known names.
pub fn named<T: Copy>(what: &str, name: &str, known: &[(&str, T)]) -> PyResult<T> {
    let found = known.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        PyValueError::new_err(format!("no {what} `{name}`; there are {}", names.join(", ")))
    })
}
