//! What needs no program: codes, checks, comparisons, pictures of CL files.

use filpost::CodePage;
use filpost::nc::diff::{self as nc_diff, Ignore, sentence};
use filpost::nc::plot::{html, svg};
use filpost::plot::{self, ClText, Text};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyDict, PyTuple};

use crate::build::{self, NamedText};
use crate::input::Given;
use crate::{diag, path, post};

/// Names of the posts inside the package.
#[pyfunction]
pub fn ready_posts() -> Vec<&'static str> {
    filpost::ready::READY.iter().map(|post| post.name).collect()
}

/// What a subject means: a code, a setting, a word, a function, a location, a G or M code, a
/// ready post.
#[pyfunction]
pub fn explain(subject: &str) -> PyResult<String> {
    filpost::explain::explain(subject, &[]).ok_or_else(|| {
        let near = filpost::explain::nearest(subject);
        let near = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        PyKeyError::new_err(format!("no help for `{subject}`{near}"))
    })
}

/// What a run would refuse or warn of in FIL files, and lints.
#[pyfunction]
pub fn check<'py>(
    py: Python<'py>,
    files: Vec<NamedText>,
    strict: bool,
) -> PyResult<Bound<'py, PyTuple>> {
    let files: Vec<(&str, &str)> =
        files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    let found = py.detach(|| {
        let options = filpost::check::Options { strict, ..Default::default() };
        filpost::check::check(&files, options)
    });
    diag::diagnostics(py, &found)
}

type Differences = Vec<(Option<u32>, Option<u32>, String)>;

/// Line of the first program, line of the second, and a sentence, for each difference.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "names and order are those of Python's side")]
pub fn diff(
    py: Python<'_>,
    first: PyBackedBytes,
    second: PyBackedBytes,
    names: (String, String),
    tolerance: f64,
    ignore: Vec<String>,
    modal: bool,
    diameter: bool,
    encoding: &str,
) -> PyResult<Differences> {
    if !tolerance.is_finite() || tolerance < 0.0 {
        return Err(PyValueError::new_err("tolerance must be 0 or more"));
    }
    let mut ignored = Ignore::default();
    for entry in &ignore {
        ignored.add(entry).map_err(|entry| {
            PyValueError::new_err(format!(
                "`{entry}` can't be ignored: n, comments, dates, points, spaces or a letter can"
            ))
        })?;
    }
    let options = nc_diff::Options {
        tolerance,
        ignore: ignored,
        modal,
        diameter,
        page: page_named(encoding)?,
    };
    let compared = py.detach(|| {
        let first = nc_diff::read(&first, &names.0, &options)?;
        let second = nc_diff::read(&second, &names.1, &options)?;
        let found = nc_diff::compare(&first, &second, &options)?;
        let told = found.differences.iter().map(|difference| {
            let [one, two] = difference.lines;
            (one, two, sentence(difference, &first, &second))
        });
        Ok(told.collect())
    });
    compared.map_err(|wrong: Box<filpost::Diag>| diag::refused(py, &wrong))
}

/// A picture of a CL file.
#[pyfunction]
pub fn plot_cl(
    py: Python<'_>,
    cl: Given,
    name: Option<String>,
    dialect: Option<&str>,
    unit: Option<&str>,
    page: bool,
    views: Vec<String>,
) -> PyResult<String> {
    let views = post::views_named(&views)?;
    let drawing = draw(py, cl, name, dialect, unit)?;
    Ok(py.detach(|| if page { html(&drawing) } else { svg(&drawing, &views) }))
}

/// Fields of a `filpost.Path`.
#[pyfunction]
pub fn cl_path<'py>(
    py: Python<'py>,
    cl: Given,
    name: Option<String>,
    dialect: Option<&str>,
    unit: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    path::arrays(py, draw(py, cl, name, dialect, unit)?.path)
}

fn draw(
    py: Python<'_>,
    cl: Given,
    name: Option<String>,
    dialect: Option<&str>,
    unit: Option<&str>,
) -> PyResult<filpost::nc::plot::Drawing<'static>> {
    let (options, unit) = (build::reading(dialect, false)?, build::unit(unit)?);
    let (bytes, name) = cl.read(py, name)?;
    let text = Text { name: &name, bytes: &bytes };
    let drawn = py.detach(|| plot::cl_file(ClText { text, options, unit }));
    Ok(drawn.map_err(|error| diag::error(py, &error))?.into_owned())
}

/// The text of an NC program.
#[pyfunction]
pub fn decode(nc: &[u8], encoding: &str) -> PyResult<String> {
    Ok(page_named(encoding)?.decode_all(nc).into_owned())
}

/// The bytes of an NC program.
#[pyfunction]
pub fn encode<'py>(py: Python<'py>, nc: &str, encoding: &str) -> PyResult<Bound<'py, PyBytes>> {
    let page = page_named(encoding)?;
    let bytes = page.encode(nc);
    let bytes = bytes.map_err(|letter| {
        PyValueError::new_err(format!("`{letter}` of the NC program is no letter of {page}"))
    })?;
    Ok(PyBytes::new(py, &bytes))
}

fn page_named(label: &str) -> PyResult<CodePage> {
    CodePage::named(label).ok_or_else(|| {
        PyValueError::new_err(format!("no encoding of NC programs is called `{label}`"))
    })
}
