//! Paths of a tool as arrays.

use filpost::nc::plot::{Stroke, Trace};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The arrays of a path. The points move into their array without a copy.
///
/// # Errors
/// numpy is not there.
pub fn arrays<'py>(py: Python<'py>, trace: Trace) -> PyResult<Bound<'py, PyDict>> {
    let Trace { points, pieces, inch, .. } = trace;
    let count = points.len();
    let points = PyArray1::from_vec(py, points.into_flattened());
    let points: Bound<'py, PyArray2<f64>> = points.reshape([count, 3])?;
    let dict = PyDict::new(py);
    let code = |stroke| Stroke::ALL.iter().position(|known| *known == stroke).unwrap_or(0) as u8;
    let starts: Vec<u64> = pieces.iter().map(|piece| piece.start.into()).collect();
    let ends: Vec<u64> = pieces.iter().map(|piece| piece.end.into()).collect();
    let strokes: Vec<u8> = pieces.iter().map(|piece| code(piece.stroke)).collect();
    let lines: Vec<u32> = pieces.iter().map(|piece| piece.line).collect();
    dict.set_item("points", points)?;
    dict.set_item("strokes", PyArray1::from_vec(py, strokes))?;
    dict.set_item("lines", PyArray1::from_vec(py, lines))?;
    dict.set_item("starts", PyArray1::from_vec(py, starts))?;
    dict.set_item("ends", PyArray1::from_vec(py, ends))?;
    dict.set_item("unit", if inch { "inch" } else { "mm" })?;
    Ok(dict)
}
