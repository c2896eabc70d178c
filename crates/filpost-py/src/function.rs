//! Python callables as functions of FIL.

use std::cell::RefCell;

use filpost::{Argument, Returned};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyString};

/// The number that is EMPTY in FIL.
const EMPTY: f64 = 999_999.0;

thread_local! {
    /// What a callable has raised last in this thread, and what FIL was told of it. A run
    /// calls its functions in the thread it was started in.
    static RAISED: RefCell<Option<(String, PyErr)>> = const { RefCell::new(None) };
}

/// The body of a function: calls a Python callable with numbers, texts, and None for EMPTY.
pub fn body(
    callable: Py<PyAny>,
) -> impl Fn(&[Argument<'_>]) -> Result<Returned, String> + Send + Sync + 'static {
    move |arguments| {
        Python::attach(|py| {
            call(callable.bind(py), arguments).map_err(|raised| {
                let told = raised.value(py).str().map(|text| text.to_string()).unwrap_or_default();
                let kind = raised.get_type(py).name();
                let kind = kind.map(|name| name.to_string()).unwrap_or_default();
                let told = if told.is_empty() { kind } else { format!("{kind}: {told}") };
                RAISED.set(Some((told.clone(), raised)));
                told
            })
        })
    }
}

fn call(callable: &Bound<'_, PyAny>, arguments: &[Argument<'_>]) -> PyResult<Returned> {
    let py = callable.py();
    let given = arguments.iter().map(|argument| match argument {
        Argument::Text(text) => PyString::new(py, text).into_any(),
        Argument::Number(number) if *number == EMPTY => py.None().into_bound(py),
        Argument::Number(number) => PyFloat::new(py, *number).into_any(),
    });
    let given = pyo3::types::PyTuple::new(py, given.collect::<Vec<_>>())?;
    returned(&callable.call1(given)?)
}

/// A number, a text, or None for EMPTY.
fn returned(value: &Bound<'_, PyAny>) -> PyResult<Returned> {
    if value.is_none() {
        return Ok(Returned::Number(EMPTY));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Returned::Text(text.to_str()?.to_string()));
    }
    let is_number = value.is_instance_of::<PyInt>() || value.is_instance_of::<PyFloat>();
    // Numbers of numpy have no common class with Python's, but a method.
    if !value.is_instance_of::<PyBool>() && (is_number || value.hasattr("__float__")?) {
        return Ok(Returned::Number(value.extract()?));
    }
    let kind = value.get_type().name()?;
    Err(PyTypeError::new_err(format!("a FIL function returned {kind}, not a number or a str")))
}

/// What was raised in this thread, where it is what an error tells of; anything else is
/// forgotten.
pub fn take_raised(py: Python<'_>, error: &filpost::Error) -> Option<PyErr> {
    let (told, raised) = RAISED.take()?;
    let tells = error.diags().iter().any(|diag| diag.message.contains(&told));
    tells.then(|| raised.clone_ref(py))
}
